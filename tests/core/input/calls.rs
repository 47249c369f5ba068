//! Calls, options and training: what a person says, and when.

use super::desk::{Desk, heard, shipped};
use glam::{DVec2, DVec3};
use hapticbillard::ball::{BallPlace, BallState, POOL_RADIUS_M};
use hapticbillard::events::{
    Call, CallKind, Calls, Choice, Command, Event, Source, Stamp, Stamped, Turn,
};
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use hapticbillard::input::feel::{AIM_RAD_PER_HEIGHT, PLACING_M_PER_HEIGHT};
use hapticbillard::input::{Button, HandInput, Human, HumanMode, HumanView, Key, RawInput};
use hapticbillard::menu::Lobby;
use hapticbillard::physics::Snapshot;
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, Pace, Participant};
use hapticbillard::units::Tick;
use smallvec::smallvec;
use std::sync::{Arc, OnceLock};

fn table() -> Arc<Table> {
    static TABLE: OnceLock<Arc<Table>> = OnceLock::new();
    TABLE.get_or_init(|| Arc::new(Table::preset("pool-9ft").unwrap())).clone()
}

/// A person before three balls; nothing moves.
struct Seat {
    human: Human,
    lobby: Lobby,
    seen: Arc<Snapshot>,
    tick: u64,
}

impl Seat {
    fn new() -> Self {
        let lies = [(0, -0.6, 0.0), (1, 0.3, 0.0), (2, 0.3, 0.3), (9, 0.0, -0.3)];
        let ball = |(id, x, y): (u16, f64, f64)| {
            BallState::at_rest(BallId(id), DVec3::new(x, y, POOL_RADIUS_M))
        };
        let seen = Snapshot { balls: lies.map(ball).to_vec(), ..Snapshot::default() };
        let mut human = Human::new(vec![PlayerId::ONE], table());
        human.start(&seen);
        let mut lobby = Lobby::new(None);
        lobby.began();
        Seat { human, lobby, seen: Arc::new(seen), tick: 1 }
    }

    /// A seat in a turn with these calls; the first aim is at the 1.
    fn with(calls: Calls) -> Self {
        let mut seat = Seat::new();
        seat.hear(Turn { calls, ..turn() });
        seat.say(&[]);
        seat
    }

    fn hear(&mut self, turn: Turn) {
        let stamp = Stamp { tick: Tick(self.tick), source: Source::Rules, sequence: 0 };
        let event = Event::Turn(Arc::new(turn));
        let events = [Stamped { stamp, event }].into();
        let (tick, table) = (Tick(self.tick), self.seen.clone());
        self.human.collect(&Delivered { tick, events, table });
    }

    /// The commands of one tick, but those that only lead the cue.
    fn say(&mut self, raw: &[RawInput]) -> Vec<Command> {
        self.tick += 1;
        let (told, _) = heard(&mut self.lobby, &self.human.view(), raw);
        let frame = self.human.inflow(Tick(self.tick), &told).frame;
        let command = |event| match event {
            Event::Command(Command::MoveCue(_) | Command::LiftCue) => None,
            Event::Command(command) => Some(command),
            _ => None,
        };
        frame.into_iter().filter_map(|publication| command(publication.event)).collect()
    }

    fn key(&mut self, key: Key) -> Vec<Command> {
        let mut said = self.say(&[RawInput::Key { key, down: true }]);
        said.extend(self.say(&[RawInput::Key { key, down: false }]));
        said
    }

    /// Begins a stroke and gives it up.
    fn stroke(&mut self) -> Vec<Command> {
        let button = |down| RawInput::Button { button: Button::Left, down };
        let mut said = self.say(&[button(true)]);
        said.extend(self.say(&[button(false)]));
        said
    }

    fn view(&self) -> HumanView {
        self.human.view()
    }

    fn called(&self) -> Option<Call> {
        self.view().call.map(|view| view.call)
    }

    fn aim_at(&mut self, at: DVec2) {
        let way = at - self.seen.balls[0].position.truncate();
        let off = libm::atan2(way.y, way.x) - self.view().aim.azimuth_rad;
        self.say(&[RawInput::Moved { right: -off / AIM_RAD_PER_HEIGHT, up: 0.0 }]);
    }
}

fn turn() -> Turn {
    Turn {
        on_table: [1, 2, 9].map(BallId).into_iter().collect(),
        legal_first: [1, 2].map(BallId).into_iter().collect(),
        shot_number: 4,
        ..Turn::default()
    }
}

const POOL: Calls = Calls { ball: true, pocket: true, safety: true, push_out: false };

fn into(ball: u16, pocket: PocketId) -> Option<Call> {
    Some(Call::Ball { ball: BallId(ball), pocket: Some(pocket) })
}

#[test]
fn the_first_legal_ball_on_the_line_and_the_pocket_on_its_way_are_proposed() {
    let mut seat = Seat::with(POOL);
    // A little below the middle of the 1: it goes off to the left.
    seat.aim_at(DVec2::new(0.3, -0.012));
    assert_eq!(seat.called(), into(1, PocketId::Fl));
    seat.aim_at(DVec2::new(0.3, 0.012));
    assert_eq!(seat.called(), into(1, PocketId::Fr));
    seat.aim_at(DVec2::new(0.3, 0.3));
    assert_eq!(seat.called(), into(2, PocketId::Fl));
    // The 9 is on the line but is not legal.
    seat.aim_at(DVec2::new(0.0, -0.3));
    assert_eq!(seat.called(), None);
    let shown = {
        seat.aim_at(DVec2::new(0.3, 0.3));
        seat.view().call.unwrap()
    };
    assert_eq!(shown.ball_at, Some(DVec2::new(0.3, 0.3)));
    let pocket = table().pockets.iter().find(|pocket| pocket.id == PocketId::Fl).unwrap().centre;
    assert_eq!(shown.pocket_at.unwrap().0, pocket);
}

#[test]
fn a_call_is_said_when_a_stroke_begins_and_again_only_if_it_changed() {
    let mut seat = Seat::with(POOL);
    seat.aim_at(DVec2::new(0.3, -0.012));
    assert_eq!(seat.say(&[]), [], "nothing is said while aiming");
    let said = |call: Option<Call>| vec![Command::Call(call.unwrap())];
    assert_eq!(seat.stroke(), said(into(1, PocketId::Fl)));
    assert_eq!(seat.stroke(), []);
    seat.aim_at(DVec2::new(0.3, 0.3));
    assert_eq!(seat.stroke(), said(into(2, PocketId::Fl)));
    // Nothing is met: what was said is taken back.
    seat.aim_at(DVec2::new(0.0, -0.3));
    assert_eq!(seat.stroke(), said(Some(Call::Kind(CallKind::Nothing))));
    assert_eq!(seat.stroke(), []);
}

#[test]
fn keys_go_round_pockets_and_balls_until_the_aim_goes_to_another_ball() {
    let mut seat = Seat::with(POOL);
    seat.aim_at(DVec2::new(0.3, -0.012));
    let mut seen = Vec::new();
    for _ in 0..6 {
        seat.key(Key::Tab);
        match seat.called() {
            Some(Call::Ball { ball: BallId(1), pocket: Some(pocket) }) => seen.push(pocket),
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(seen.last(), Some(&PocketId::Fl), "round");
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), 6);
    seat.key(Key::Tab);
    seat.say(&[RawInput::Key { key: Key::Shift, down: true }]);
    seat.key(Key::Tab);
    assert_eq!(seat.called(), into(1, PocketId::Fl), "and back");
    seat.say(&[RawInput::Key { key: Key::Shift, down: false }]);

    // Another ball than the one that is met: a combination.
    seat.key(Key::Letter('b'));
    assert!(matches!(seat.called(), Some(Call::Ball { ball: BallId(2), .. })));
    seat.aim_at(DVec2::new(0.3, -0.010));
    assert!(matches!(seat.called(), Some(Call::Ball { ball: BallId(2), .. })), "the same aim");
    seat.aim_at(DVec2::new(0.3, 0.3));
    seat.aim_at(DVec2::new(0.3, -0.012));
    seat.key(Key::Letter('b'));
    seat.key(Key::Letter('b'));
    assert_eq!(seat.called(), into(1, PocketId::Fl));
}

#[test]
fn safety_and_push_out_are_called_where_the_rules_know_them_and_taken_back() {
    let mut seat = Seat::with(POOL);
    seat.aim_at(DVec2::new(0.3, -0.012));
    seat.key(Key::Letter('s'));
    assert_eq!(seat.called(), Some(Call::Kind(CallKind::Safety)));
    seat.key(Key::Letter('o'));
    assert_eq!(seat.called(), Some(Call::Kind(CallKind::Safety)), "no push-out here");
    assert_eq!(seat.stroke(), [Command::Call(Call::Kind(CallKind::Safety))]);
    seat.key(Key::Letter('s'));
    assert_eq!(seat.called(), into(1, PocketId::Fl));

    let mut seat = Seat::with(Calls { push_out: true, ..Calls::default() });
    assert_eq!(seat.called(), None);
    assert_eq!(seat.stroke(), []);
    seat.key(Key::Letter('o'));
    assert_eq!(seat.stroke(), [Command::Call(Call::Kind(CallKind::PushOut))]);
    seat.key(Key::Letter('o'));
    assert_eq!(seat.stroke(), [Command::Call(Call::Kind(CallKind::Nothing))]);

    // Snooker names no pocket.
    let mut seat = Seat::with(Calls { ball: true, ..Calls::default() });
    seat.aim_at(DVec2::new(0.3, 0.3));
    assert_eq!(seat.called(), Some(Call::Ball { ball: BallId(2), pocket: None }));
    seat.key(Key::Tab);
    assert_eq!(seat.called(), Some(Call::Ball { ball: BallId(2), pocket: None }));
    let mut seat = Seat::with(Calls::default());
    assert_eq!((seat.called(), seat.stroke()), (None, vec![]));
}

#[test]
fn an_option_is_taken_by_key_or_by_a_click_on_its_line() {
    let options = smallvec![Choice::Accept, Choice::RerackAndBreak, Choice::RerackOpponentBreaks];
    let choosing = Turn { options, ..turn() };
    let mut seat = Seat::new();
    seat.hear(choosing.clone());
    assert_eq!(seat.view().mode, HumanMode::Choosing);
    assert_eq!(seat.stroke(), [], "nobody strokes now");
    let digit = |digit| Key::Letter(digit);
    assert_eq!(seat.key(digit('2')), [Command::Choose(Choice::RerackAndBreak)]);
    assert_eq!(seat.key(digit('3')), [Command::Choose(Choice::RerackOpponentBreaks)]);
    let pick = |option| RawInput::Picked { option };
    assert_eq!(seat.say(&[pick(0)]), [Command::Choose(Choice::Accept)]);
    assert_eq!(seat.say(&[pick(3)]), []);
    // Answered, and the game goes on.
    seat.hear(turn());
    assert_eq!(seat.view().mode, HumanMode::Aiming);
    assert_eq!(seat.key(digit('1')), []);
    // There may be fewer.
    seat.hear(Turn { options: smallvec![Choice::Shoot, Choice::PassBack], ..turn() });
    assert_eq!(seat.key(digit('3')), []);
    assert_eq!(seat.key(digit('2')), [Command::Choose(Choice::PassBack)]);
    // Not in a pause.
    seat.key(Key::Escape);
    assert_eq!(seat.key(digit('1')), []);
}

#[test]
fn outside_of_training_nothing_is_taken_back_or_taken_up() {
    let mut seat = Seat::with(POOL);
    assert_eq!(seat.key(Key::Letter('u')), []);
    seat.key(Key::Letter('t'));
    assert_eq!(seat.view().mode, HumanMode::Aiming);
}

/// Training before three balls.
fn training(solver: &str) -> Desk {
    let mut text = format!(
        "[scene]\nname = \"Desk\"\n[physics]\nsolver = {solver:?}\nstep_ms = 4.0\n[table]\n\
         preset = \"pool-9ft\"\n[cue]\n[rules]\ngame = \"training\"\n[[player]]\nname = \"You\"\n\
         kind = \"human\"\n[input]\nprofile = \"default\"\n"
    );
    for (id, x, y) in [(0, -0.4, 0.0), (1, 0.4, 0.0), (2, 0.9, 0.5)] {
        text += &format!("[[ball]]\nid = {id}\nposition_m = [{x:?}, {y:?}]\n");
    }
    let scene = Scene::parse("desk.toml", &text).unwrap();
    let mut desk = Desk::at(&scene, table(), Pace::EveryTick);
    desk.wait(3);
    desk
}

fn place(desk: &Desk, ball: u16) -> (BallPlace, DVec3) {
    let ball = desk.table().ball(BallId(ball)).unwrap();
    (ball.place, ball.position)
}

fn shoot(desk: &mut Desk) {
    let shots = desk.verdicts().len();
    desk.stroke(0.3, 1.5, 125);
    desk.wait_until(30_000, |desk| desk.verdicts().len() > shots);
    desk.wait(3);
}

#[test]
fn in_training_shots_are_taken_back_one_by_one_and_the_cue_is_there() {
    for solver in ["event-driven", "fixed-step"] {
        let mut desk = training(solver);
        let balls = |desk: &Desk| [0, 1, 2].map(|ball| place(desk, ball));
        let start = balls(&desk);
        shoot(&mut desk);
        let second = balls(&desk);
        assert_ne!(start, second);
        shoot(&mut desk);
        for wanted in [&second, &start, &start] {
            desk.key(Key::Letter('u'));
            desk.wait(12);
            for (seen, wanted) in balls(&desk).iter().zip(wanted) {
                assert!(seen.0 == wanted.0 && seen.1.distance(wanted.1) < 1e-9, "{solver}");
            }
            assert_eq!(desk.mode(), HumanMode::Aiming);
            let tip = desk.table().cue.unwrap().tip;
            assert!(tip.distance(place(&desk, 0).1) < 0.1, "{solver}: the cue is at the ball");
        }
        // While balls roll, too.
        desk.stroke(0.3, 1.5, 125);
        desk.wait(300);
        assert_ne!(balls(&desk), start);
        desk.key(Key::Letter('u'));
        desk.wait(12);
        assert!(place(&desk, 1).1.distance(start[1].1) < 1e-9);
        assert_eq!(desk.mode(), HumanMode::Aiming);
    }
}

#[test]
fn in_training_any_ball_is_taken_up_and_put_anywhere() {
    let mut desk = training("event-driven");
    desk.key(Key::Letter('t'));
    assert_eq!((desk.mode(), desk.view().placing_ball), (HumanMode::Placing, BallId::CUE));
    desk.key(Key::Tab);
    desk.key(Key::Tab);
    assert_eq!(desk.view().placing_ball, BallId(2));
    desk.moved(-0.3, -0.2);
    assert!(desk.view().placing_allowed);
    let at = desk.view().placing.unwrap();
    desk.button(Button::Left, true);
    desk.button(Button::Left, false);
    desk.wait(5);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    assert!(place(&desk, 2).1.truncate().distance(at) < 1e-12);
    // And left alone again.
    let lies = place(&desk, 0);
    desk.key(Key::Letter('t'));
    desk.key(Key::Letter('t'));
    desk.wait(3);
    assert_eq!((desk.mode(), place(&desk, 0)), (HumanMode::Aiming, lies));
    shoot(&mut desk);
    assert!(desk.verdicts().last().unwrap().legal);
}

#[test]
fn a_person_chooses_after_a_soft_break_and_breaks_again() {
    let mut desk = Desk::at(&two_people("wpa_eight_ball"), table(), Pace::EveryTick);
    desk.wait(3);
    desk.button(Button::Left, true);
    desk.button(Button::Left, false);
    desk.wait(3);
    // Hardly: nothing falls and nothing reaches a rail.
    desk.stroke(0.2, 0.9, 125);
    desk.wait_until(30_000, |desk| !desk.verdicts().is_empty());
    desk.wait(3);
    assert_eq!(desk.verdicts()[0].options.len(), 3, "{:?}", desk.verdicts()[0]);
    assert_eq!(desk.mode(), HumanMode::Choosing);
    desk.tick(&[RawInput::Picked { option: 1 }]);
    desk.wait(5);
    assert_eq!(desk.mode(), HumanMode::Placing, "the chooser breaks a new rack");
    let apex = table().bed.unwrap().foot_spot();
    let is_near = |ball: &BallState| ball.position.truncate().distance(apex) < 0.25;
    assert_eq!(desk.table().on_table().filter(|ball| is_near(ball)).count(), 15);
}

fn two_people(name: &str) -> Scene {
    let text = hapticbillard::shipped::scene(name).unwrap();
    let text = text.replace("kind = \"computer\"\nstrength = 50", "kind = \"human\"");
    Scene::parse("two.toml", &text).unwrap()
}

#[test]
fn every_shipped_game_for_a_person_can_begin() {
    for name in ["wpa_eight_ball", "nine_ball", "straight", "training"] {
        let mut desk = Desk::at(&shipped(name), table(), Pace::EveryTick);
        desk.wait(3);
        let begins = [HumanMode::Placing, HumanMode::Aiming];
        assert!(begins.contains(&desk.mode()), "{name}: {:?}", desk.mode());
    }
}

#[test]
fn a_pocket_is_called_by_pointing_at_it() {
    let mut seat = Seat::with(POOL);
    seat.aim_at(DVec2::new(0.3, -0.012));
    let aim = seat.view().aim;
    assert_eq!(seat.called(), into(1, PocketId::Fl));
    seat.key(Key::Letter('k'));
    assert_eq!(seat.view().mode, HumanMode::Pointing);
    // It begins at the pocket that is called; each is found from there, from above.
    for pocket in &table().pockets {
        let from = seat.view().pointing.unwrap();
        let by = (pocket.centre - from) / PLACING_M_PER_HEIGHT;
        seat.say(&[RawInput::Moved { right: by.x, up: by.y }]);
        assert_eq!(seat.called(), into(1, pocket.id), "{:?}", pocket.id);
        let at = seat.view().pointing.unwrap();
        assert!(at.abs().cmple(DVec2::new(1.27, 0.635)).all(), "on the bed: {at}");
    }
    let last = table().pockets.last().unwrap().id;
    // A click ends it and is no stroke; the cue has not moved.
    let button = |down| RawInput::Button { button: Button::Left, down };
    assert_eq!(seat.say(&[button(true)]), []);
    assert_eq!(seat.say(&[button(false)]), []);
    assert_eq!((seat.view().mode, seat.view().aim), (HumanMode::Aiming, aim));
    assert_eq!(seat.called(), into(1, last));
    assert_eq!(seat.stroke(), vec![Command::Call(into(1, last).unwrap())]);
    // Keys and a stylus point as well.
    seat.key(Key::Letter('k'));
    let before = seat.view().pointing.unwrap();
    seat.say(&[RawInput::Key { key: Key::Left, down: true }]);
    (0..200).for_each(|_| drop(seat.say(&[])));
    seat.say(&[RawInput::Key { key: Key::Left, down: false }]);
    let after = seat.view().pointing.unwrap();
    assert!(after.x < before.x - 0.15 && after.y == before.y, "{before} {after}");
    seat.human.inflow(Tick(9_999), &[HandInput::Points { right: 0.0, up: 0.0 }]);
    assert!(seat.view().pointing.unwrap().length() < 0.05, "the middle of the picture");
    // Whoever goes away points at nothing.
    seat.say(&[RawInput::FocusLost]);
    assert_eq!(seat.view().mode, HumanMode::Aiming);
}

#[test]
fn where_no_pocket_is_called_nothing_is_pointed_at() {
    let mut seat = Seat::with(Calls::default());
    seat.key(Key::Letter('k'));
    assert_eq!(seat.view().mode, HumanMode::Aiming);
}
