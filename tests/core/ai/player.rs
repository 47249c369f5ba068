//! The turn of a computer player against a scripted table.

use super::{BED, R, clearance, pockets, random_view};
use glam::{DQuat, DVec2, DVec3};
use hapticbillard::ai::{Player, PlayerSettings, Stroke, TableView2d};
use hapticbillard::ball::{BallPlace, BallState, Motion};
use hapticbillard::cue::{CuePath, CuePose};
use hapticbillard::events::{
    BallInHand, Call, CallKind, Calls, Choice, Command, Event, Fact, FactKind, PlayerState,
    ShotKind, Source, Stamp, Stamped, Turn, Verdict,
};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::physics::{Profile, Snapshot};
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use smallvec::smallvec;
use std::sync::Arc;

const ME: PlayerId = PlayerId::ONE;

fn player(seed: u64) -> Player {
    let settings = PlayerSettings::paper(seed, Profile::Standard);
    Player::new(ME, settings, BED, pockets(), R, clearance())
}

/// What a world would do with the player's commands, as far as a script needs it.
struct Script {
    player: Player,
    now: Tick,
    table: Snapshot,
    mail: Vec<Event>,
    cue: Option<Arc<CuePath>>,
    /// How many placements are refused.
    refuse: u32,
    /// How many strokes pass through the ball.
    misses: u32,
    /// The states it reported, with their ticks.
    states: Vec<(PlayerState, Tick)>,
    placed: Vec<DVec2>,
    strokes: Vec<Stroke>,
    hashes: Vec<Digest>,
    cue_lifted: u32,
    chosen: Vec<(Choice, Tick)>,
    called: Vec<(Call, Tick)>,
}

fn ball(id: BallId, position: DVec2, place: BallPlace) -> BallState {
    BallState {
        id,
        position: position.extend(R),
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        motion: Motion::Rest,
        place,
    }
}

fn snapshot(view: &TableView2d, cue_place: BallPlace) -> Snapshot {
    let mut balls = vec![ball(BallId::CUE, view.cue_ball.unwrap_or_default(), cue_place)];
    balls.extend(view.balls.iter().map(|b| ball(b.id, b.position, BallPlace::OnTable)));
    Snapshot { time_s: 0.0, balls, cue: None }
}

fn turn(player: PlayerId, view: &TableView2d, ball_in_hand: BallInHand) -> Event {
    let on_table = view.balls.iter().map(|ball| ball.id);
    Event::Turn(Arc::new(Turn {
        player,
        shot: ShotKind::Normal,
        ball_in_hand,
        groups: None,
        on_table: on_table.clone().collect(),
        legal_first: on_table.collect(),
        shot_number: 1,
        ..Turn::default()
    }))
}

impl Script {
    fn new(seed: u64, table: Snapshot) -> Self {
        let mut player = player(seed);
        assert_eq!(player.start(&table), Outcome::default());
        Script {
            player,
            now: Tick(10),
            table,
            mail: Vec::new(),
            cue: None,
            refuse: 0,
            misses: 0,
            states: vec![],
            placed: vec![],
            strokes: vec![],
            hashes: vec![],
            cue_lifted: 0,
            chosen: vec![],
            called: vec![],
        }
    }

    /// Delivers the mail of one tick, does what the player commands, and goes to the next tick in
    /// which something happens. False if the player waits for mail.
    fn step(&mut self) -> bool {
        let mail = std::mem::take(&mut self.mail);
        let stamp = Stamp { tick: self.now, source: Source::Physics, sequence: 0 };
        let events: Vec<_> = mail.into_iter().map(|event| Stamped { stamp, event }).collect();
        let end_s = self.now.end_s();
        self.table.time_s = end_s;
        self.table.cue = self.cue.as_ref().and_then(|path| {
            let piece = path.piece_at(end_s)?;
            let (tip, velocity) = piece.at(end_s.min(piece.end_s()));
            let direction = piece.direction_at(end_s);
            Some(CuePose { tip, velocity, direction, solid: path.solid })
        });
        let delivered = Delivered {
            tick: self.now,
            events: events.into(),
            table: Arc::new(self.table.clone()),
        };
        let outcome = self.player.collect(&delivered);
        let mut hash = StateHash::new();
        self.player.hash(&mut hash);
        self.hashes.push(hash.finish());

        let mut next = outcome.wake;
        for publication in &outcome.publish {
            assert_eq!((publication.delay_ticks, publication.label), (0, None));
            if let Some(at) = self.obey(&publication.event) {
                next = Some(next.map_or(at, |wake: Tick| wake.min(at)));
            }
        }
        let Some(next) = next else { return !self.mail.is_empty() };
        assert!(next > self.now, "woken in the past");
        self.now = if self.mail.is_empty() { next } else { self.now.after(1) };
        // A stroke that meets the ball is reported in the tick that contains the contact.
        if let (Some(path), Some(stroke)) = (&self.cue, self.strokes.last())
            && path.solid
        {
            let contact_s = path.pieces[0].start_s + stroke.contact_after_s();
            if self.now >= Tick::containing(contact_s) && self.misses == 0 {
                self.now = Tick::containing(contact_s);
                self.fact(FactKind::CueBallStruck {
                    ball: BallId::CUE,
                    push: false,
                    moving: false,
                    player: None,
                    miscue: false,
                    position_m: stroke.contact,
                    normal_speed_m_s: stroke.speed_m_s,
                });
            }
        }
        true
    }

    /// Does what an event asks for; answers when something comes of it.
    fn obey(&mut self, event: &Event) -> Option<Tick> {
        match event {
            Event::Player(report) => {
                assert_eq!(report.player, ME);
                self.states.push((report.state, self.now));
            }
            Event::Command(Command::MoveCue(path)) => {
                assert_eq!(path.pieces[0].start_s, self.now.end_s(), "a path begins when due");
                if path.solid {
                    self.strokes.extend(self.player.stroke());
                } else {
                    self.end_stroke();
                }
                self.cue = Some(path.clone());
            }
            Event::Command(Command::LiftCue) => {
                self.end_stroke();
                self.cue = None;
                self.cue_lifted += 1;
            }
            Event::Command(Command::Choose(choice)) => self.chosen.push((*choice, self.now)),
            Event::Command(Command::Call(call)) => self.called.push((call.clone(), self.now)),
            Event::Command(Command::PlaceBall { ball, position_m, zone }) => {
                let ok = self.refuse == 0;
                self.refuse = self.refuse.saturating_sub(1);
                self.placed.push(*position_m);
                if ok {
                    self.table.balls[0].position = position_m.extend(R);
                    self.table.balls[0].place = BallPlace::OnTable;
                }
                self.fact(FactKind::BallPlaced { ball: *ball, zone: *zone, ok });
                return Some(self.now.after(1));
            }
            _ => {}
        }
        None
    }

    /// A stroke that was let through is over.
    fn end_stroke(&mut self) {
        if self.cue.as_ref().is_some_and(|path| path.solid) {
            self.misses = self.misses.saturating_sub(1);
        }
    }

    fn fact(&mut self, kind: FactKind) {
        self.mail.push(Event::Fact(Fact { time_s: self.now.end_s(), kind }));
    }

    /// Runs until the player watches the balls.
    #[track_caller]
    fn run_to(&mut self, state: PlayerState) {
        for _ in 0..200 {
            if self.player.state() == state {
                return;
            }
            self.step();
        }
        panic!("never {state:?}: {:?}", self.states);
    }

    fn names(&self) -> Vec<PlayerState> {
        self.states.iter().map(|(state, _)| *state).collect()
    }
}

use PlayerState::{Aiming, Analyzing, Done, Idle, Lazing, Shooting};

#[test]
fn a_turn_goes_through_its_states_in_order() {
    let view = random_view(5, 6);
    let mut script = Script::new(7, snapshot(&view, BallPlace::OnTable));
    script.mail.push(turn(ME, &view, BallInHand::None));
    script.run_to(Analyzing);
    let lazed = script.states[1].1.0 - script.states[0].1.0;
    assert!((400..=1200).contains(&lazed), "{lazed} ticks of pause");
    assert_eq!(script.states[2].1.0 - script.states[1].1.0, 800, "ticks of aiming");
    assert!(!script.cue.as_ref().unwrap().solid, "the cue is withdrawn at once");
    script.fact(FactKind::Settled { snookered: false, cue_in_rack: false });
    script.run_to(Idle);
    assert_eq!(script.names(), [Lazing, Aiming, Shooting, Analyzing, Done, Idle]);
    assert_eq!((script.strokes.len(), script.cue_lifted), (1, 1));
    assert!(script.placed.is_empty());
    assert!(!script.step(), "no wake while idle");
}

#[test]
fn a_verdict_or_the_next_turn_ends_the_watching_too() {
    let view = random_view(5, 6);
    let mut verdict = Script::new(7, snapshot(&view, BallPlace::OnTable));
    verdict.mail.push(turn(ME, &view, BallInHand::None));
    verdict.run_to(Analyzing);
    verdict.mail.push(Event::Verdict(Arc::new(Verdict::default())));
    verdict.run_to(Idle);
    assert_eq!(verdict.names()[4..], [Done, Idle]);

    let mut next = Script::new(7, snapshot(&view, BallPlace::OnTable));
    next.mail.push(turn(ME, &view, BallInHand::None));
    next.run_to(Analyzing);
    next.mail.push(turn(ME, &view, BallInHand::None));
    next.step();
    assert_eq!(next.names()[4..], [Done, Idle, Lazing]);
}

#[test]
fn ball_in_hand_is_placed_elsewhere_until_it_is_accepted() {
    let view = random_view(9, 5);
    for refusals in [0, 1, 30] {
        let mut script = Script::new(3, snapshot(&view, BallPlace::InHand));
        script.refuse = refusals;
        script.mail.push(turn(ME, &view, BallInHand::Kitchen));
        script.run_to(Analyzing);
        assert_eq!(script.placed.len(), refusals as usize + 1);
        assert!(script.placed.windows(2).all(|pair| pair[0] != pair[1]), "elsewhere");
        assert!(script.placed.iter().all(|spot| spot.x < BED.head_string_x()));
        let cue_ball = script.placed.last().unwrap().extend(R);
        let stroke = script.strokes[0];
        let wanted = stroke.aim.tip_at_contact(cue_ball, R);
        assert!(stroke.contact.distance(wanted) < 1e-12, "plays from where it lies");
    }
}

#[test]
fn a_turn_that_is_called_again_does_not_begin_again() {
    let view = random_view(9, 5);
    let mut script = Script::new(3, snapshot(&view, BallPlace::InHand));
    script.refuse = 1;
    script.mail.push(turn(ME, &view, BallInHand::Kitchen));
    // Refused, answered with the next spot; the referee's call comes with that spot's acceptance.
    script.step();
    script.step();
    script.mail.push(turn(ME, &view, BallInHand::Kitchen));
    script.run_to(Analyzing);
    assert_eq!((script.placed.len(), script.strokes.len()), (2, 1));
    assert_eq!(script.names(), [Lazing, Aiming, Shooting, Analyzing]);
}

#[test]
fn a_stroke_that_meets_nothing_is_tried_again_and_never_stalls() {
    let view = random_view(11, 4);
    for (misses, lazes) in [(1, 1), (3, 1), (5, 2)] {
        let mut script = Script::new(3, snapshot(&view, BallPlace::OnTable));
        script.misses = misses;
        script.mail.push(turn(ME, &view, BallInHand::None));
        script.run_to(Analyzing);
        let count = |state| script.names().iter().filter(|s| **s == state).count();
        assert_eq!(count(Shooting), misses as usize + 1);
        assert_eq!(count(Lazing), lazes, "{misses} misses: {:?}", script.names());
    }
}

#[test]
fn the_other_players_turn_is_none_of_its_business() {
    let view = random_view(5, 6);
    let mut script = Script::new(7, snapshot(&view, BallPlace::OnTable));
    script.mail.push(turn(PlayerId::TWO, &view, BallInHand::None));
    assert!(!script.step());
    assert!(script.states.is_empty());
    // Taken away in the middle of aiming: it leaves the table.
    script.mail.push(turn(ME, &view, BallInHand::None));
    script.run_to(Aiming);
    script.mail.push(turn(PlayerId::TWO, &view, BallInHand::None));
    script.step();
    assert_eq!(script.names(), [Lazing, Aiming, Idle]);
    assert!(script.cue.is_none());
}

/// A turn with changes.
fn turn_with(view: &TableView2d, change: impl FnOnce(&mut Turn)) -> Event {
    let Event::Turn(turn) = turn(ME, view, BallInHand::None) else { unreachable!() };
    let mut turn = (*turn).clone();
    change(&mut turn);
    Event::Turn(Arc::new(turn))
}

#[test]
fn a_choice_is_taken_after_a_pause_before_anything_else_and_said_until_it_is_heard() {
    let view = random_view(5, 6);
    let mut script = Script::new(7, snapshot(&view, BallPlace::OnTable));
    let options = smallvec![Choice::Accept, Choice::RerackAndBreak, Choice::RerackOpponentBreaks];
    let choosing = turn_with(&view, |turn| {
        turn.options = options;
        turn.ball_in_hand = BallInHand::Kitchen;
    });
    script.mail.push(choosing);
    let begun = script.now;
    for _ in 0..3 {
        while script.chosen.is_empty() {
            assert!(script.step());
        }
        let (choice, at) = script.chosen.remove(0);
        assert_eq!(choice, Choice::RerackAndBreak);
        assert!(at.0 >= begun.0 + 400, "nobody decides at once");
    }
    assert!(script.placed.is_empty() && script.strokes.is_empty());
    // Heard: the turn that follows is played.
    script.mail.push(turn_with(&view, |turn| turn.shot = ShotKind::Break));
    script.run_to(Analyzing);
    assert!(script.chosen.is_empty() && script.strokes.len() == 1);
}

#[test]
fn what_is_planned_is_called_long_before_the_stroke_as_far_as_it_may_be() {
    let pool = Calls { ball: true, pocket: true, safety: true, push_out: false };
    let mut kinds = std::collections::BTreeSet::new();
    for seed in 0..40 {
        let view = random_view(seed, 6);
        let play = |calls: Calls| {
            let mut script = Script::new(seed, snapshot(&view, BallPlace::OnTable));
            script.mail.push(turn_with(&view, |turn| {
                turn.calls = calls;
                turn.legal_first.truncate(1);
            }));
            script.run_to(Analyzing);
            script
        };
        let script = play(pool);
        let plan = script.player.plan().unwrap();
        let (call, at) = script.called[0].clone();
        let shooting = script.states.iter().find(|(state, _)| *state == Shooting).unwrap().1;
        assert!(at.0 + 100 < shooting.0, "called at {}, struck at {}", at.0, shooting.0);
        kinds.insert(matches!(call, Call::Ball { .. }));
        match call {
            Call::Ball { ball, pocket } => {
                assert_eq!((Some(ball), pocket), (plan.target, plan.pocket));
                assert!(pocket.is_some());
            }
            Call::Kind(kind) => assert_eq!((kind, plan.pocket), (CallKind::Safety, None)),
        }
        assert!(play(Calls::default()).called.is_empty(), "nobody asked");
        let named = play(Calls { ball: true, ..Calls::default() }).called[0].0.clone();
        assert_eq!(named, Call::Ball { ball: plan.target.unwrap(), pocket: None });
    }
    assert_eq!(kinds.len(), 2, "pots and safeties");
}

#[test]
fn every_state_but_idle_has_a_wake() {
    let view = random_view(5, 6);
    let mut script = Script::new(7, snapshot(&view, BallPlace::OnTable));
    script.mail.push(turn(ME, &view, BallInHand::None));
    // Nothing is ever answered after the stroke: the player still comes back.
    script.run_to(Analyzing);
    script.run_to(Idle);
    assert!(script.now.0 > 100_000);
}

#[test]
fn the_same_seed_gives_the_same_turn_and_another_seed_another() {
    let run = |seed| {
        let view = random_view(21, 8);
        let mut script = Script::new(seed, snapshot(&view, BallPlace::InHand));
        script.mail.push(turn(ME, &view, BallInHand::Anywhere));
        script.run_to(Analyzing);
        (script.hashes, script.strokes, script.states)
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1).0, run(2).0);
    assert_ne!(run(1).1, run(2).1);
}

#[test]
fn noise_spoils_the_stroke_but_not_the_plan() {
    let run = |noise| {
        let view = random_view(5, 6);
        let settings = PlayerSettings { noise, ..PlayerSettings::paper(7, Profile::Standard) };
        let mut script = Script::new(7, snapshot(&view, BallPlace::OnTable));
        script.player = Player::new(ME, settings, BED, pockets(), R, clearance());
        script.mail.push(turn(ME, &view, BallInHand::None));
        script.run_to(Analyzing);
        let plan = script.player.plan().unwrap().clone();
        (plan.direction, script.strokes[0].aim)
    };
    let ((exact, aimed), (planned, struck)) = (run(0.0), run(1.0));
    assert_eq!(exact, planned);
    let off = (aimed.azimuth_rad - struck.azimuth_rad).abs().to_degrees();
    assert!(0.0 < off && off < 0.6, "{off} degrees");
    assert!(struck.side_offset != 0.0 && struck.side_offset.abs() < 0.1);
}
