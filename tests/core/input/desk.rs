//! A desk: a game in lockstep with a script at mouse and keyboard.

use glam::DVec2;
use hapticbillard::cast::Cast;
use hapticbillard::events::{
    Command, Event, Fact, FactKind, Source, Topics, Turn, TurnAfter, Verdict,
};
use hapticbillard::haptic::Leads;
use hapticbillard::hash::StateHash;
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::input::feel::{ADDRESS_GAP_M, AIM_RAD_PER_HEIGHT, STROKE_M_PER_HEIGHT};
use hapticbillard::input::{
    Button, HandInput, Human, HumanMode, HumanView, Key, RawInput, StylusWord,
};
use hapticbillard::lockstep::{Lockstep, Setup};
use hapticbillard::menu::{Lobby, Order};
use hapticbillard::physics::Snapshot;
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use hapticbillard::tick::{
    Delivered, End, Finished, Frame, FrameSource, Inflow, Outcome, Pace, Participant,
};
use hapticbillard::units::Tick;
use std::sync::{Arc, Mutex};

/// How a mouse reports, in reports a second.
pub const RATES_HZ: [u32; 3] = [60, 125, 1000];

/// What both sides of the desk share.
struct Shared {
    human: Human,
    /// What the hand hears in the next tick.
    reports: Vec<HandInput>,
    /// What a stylus says in the next tick.
    word: Option<StylusWord>,
    frames: Vec<(Tick, Frame)>,
    asked: u64,
    last: Inflow,
    heard: Vec<Event>,
}

struct Hand(Arc<Mutex<Shared>>);

impl FrameSource for Hand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let mut shared = self.0.lock().unwrap();
        let reports = std::mem::take(&mut shared.reports);
        let word = shared.word.take();
        let inflow = shared.human.inflow_beside(tick, &reports, word.as_ref());
        if !inflow.frame.is_empty() {
            shared.frames.push((tick, inflow.frame.clone()));
        }
        shared.asked += 1;
        shared.last = inflow.clone();
        inflow
    }
}

impl Participant for Hand {
    fn source(&self) -> Source {
        Source::Input
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.0.lock().unwrap().human.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut shared = self.0.lock().unwrap();
        shared.heard.extend(delivered.events.iter().map(|stamped| stamped.event.clone()));
        let topics = shared.human.topics();
        let wanted = |topic| topics.contains(topic);
        let events = delivered.events.iter().filter(|stamped| wanted(stamped.event.topic()));
        let mail = Delivered { events: events.cloned().collect(), ..delivered.clone() };
        // Without mail nobody is called.
        if mail.events.is_empty() { Outcome::default() } else { shared.human.collect(&mail) }
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// A scene with the free-play rules and these balls (id, x, y); 0 is the cue ball.
pub fn free_play(balls: &[(u16, f64, f64)]) -> Scene {
    let mut text = "[scene]\nname = \"Desk\"\n[physics]\nsolver = \"fixed-step\"\nstep_ms = 1.0\n\
        [table]\npreset = \"pool-9ft\"\n[cue]\n[rules]\ngame = \"free-play\"\n\
        [[player]]\nname = \"You\"\nkind = \"human\"\n[input]\nprofile = \"default\"\n"
        .to_owned();
    for (id, x, y) in balls {
        text += &format!("[[ball]]\nid = {id}\nposition_m = [{x:?}, {y:?}]\n");
    }
    Scene::parse("desk.toml", &text).unwrap()
}

/// A shipped scene.
pub fn shipped(name: &str) -> Scene {
    Scene::parse(name, hapticbillard::shipped::scene(name).unwrap()).unwrap()
}

/// What of these reports the game hears, and what else is ordered.
pub fn heard(
    lobby: &mut Lobby,
    view: &HumanView,
    reports: &[RawInput],
) -> (Vec<HandInput>, Vec<Order>) {
    let mut orders = lobby.see(view);
    orders.extend(reports.iter().flat_map(|report| lobby.hear(*report, None)));
    let told = |order: &Order| match order {
        Order::Tell(input) => Some(*input),
        _ => None,
    };
    let heard = orders.iter().filter_map(told).collect();
    orders.retain(|order| told(order).is_none());
    (heard, orders)
}

/// A game with a person.
pub struct Desk {
    /// What stands between the devices and the game.
    pub lobby: Lobby,
    /// What it ordered, other than telling the game something.
    pub orders: Vec<Order>,
    game: Lockstep<'static>,
    shared: Arc<Mutex<Shared>>,
    pub finished: Option<Finished>,
}

impl Desk {
    /// Before the first tick of `scene`.
    pub fn new(scene: &Scene) -> Self {
        let mut load = |file: &str| {
            hapticbillard::shipped::mesh(file).map(String::from).ok_or("no such mesh".to_string())
        };
        let table = Arc::new(scene.build_table(&mut load).unwrap());
        Desk::at(scene, table, Pace::EveryTick)
    }

    /// The same for a person with a stylus.
    pub fn with_stylus(scene: &Scene) -> Self {
        let table = Arc::new(scene.build_table(&mut |_| Err(String::new())).unwrap());
        Desk::of(scene, table, Pace::EveryTick, Human::with_stylus)
    }

    pub fn at(scene: &Scene, table: Arc<Table>, pace: Pace) -> Self {
        Desk::of(scene, table, pace, |human| human)
    }

    fn of(scene: &Scene, table: Arc<Table>, pace: Pace, with: impl Fn(Human) -> Human) -> Self {
        let mut cast = Cast::new(scene, table).unwrap();
        let human = with(cast.human.take().unwrap());
        let shared = Arc::new(Mutex::new(Shared {
            human,
            reports: Vec::new(),
            word: None,
            frames: Vec::new(),
            asked: 0,
            last: Inflow::default(),
            heard: Vec::new(),
        }));
        let mut setup = Setup::headless(Tick(10_000_000));
        setup.pace = pace;
        setup.input = Some(Box::new(Hand(shared.clone())));
        setup.observers.push(Box::new(Hand(shared.clone())));
        let game = Lockstep::new(cast, setup).unwrap();
        let mut lobby = Lobby::new(None);
        lobby.began();
        Desk { lobby, orders: Vec::new(), game, shared, finished: None }
    }

    /// One tick in which the devices say this.
    pub fn tick(&mut self, reports: &[RawInput]) {
        let view = self.view();
        let (told, orders) = heard(&mut self.lobby, &view, reports);
        self.orders.extend(orders);
        self.hear(&told);
    }

    /// One tick in which the hand hears this.
    pub fn hear(&mut self, told: &[HandInput]) {
        self.shared.lock().unwrap().reports.extend_from_slice(told);
        let asked = self.shared.lock().unwrap().asked;
        while self.finished.is_none() && self.shared.lock().unwrap().asked == asked {
            self.finished = self.game.step().unwrap();
        }
    }

    /// One tick in which a stylus says this.
    pub fn say(&mut self, word: StylusWord) {
        self.shared.lock().unwrap().word = Some(word);
        self.tick(&[]);
    }

    /// One tick in which the hand hears this and a stylus says that.
    pub fn hear_beside(&mut self, told: &[HandInput], word: StylusWord) {
        self.shared.lock().unwrap().word = Some(word);
        self.hear(told);
    }

    /// What a stylus is for now.
    pub fn leads(&self) -> Leads {
        self.shared.lock().unwrap().human.stylus_leads_what()
    }

    /// How far the workspace of the stylus is to be turned and raised [rad].
    pub fn take_turn(&self) -> DVec2 {
        self.shared.lock().unwrap().human.take_turn()
    }

    /// Nobody touches anything for so long.
    pub fn wait(&mut self, ticks: u64) {
        (0..ticks).for_each(|_| self.tick(&[]));
    }

    /// Nobody touches anything until this is so, or the game ends.
    pub fn wait_until(&mut self, ticks_max: u64, is_so: impl Fn(&Desk) -> bool) {
        for _ in 0..ticks_max {
            if is_so(self) || self.finished.is_some() {
                return;
            }
            self.tick(&[]);
        }
        panic!("not within {ticks_max} ticks");
    }

    pub fn mode(&self) -> HumanMode {
        self.view().mode
    }

    pub fn view(&self) -> HumanView {
        self.shared.lock().unwrap().human.view()
    }

    pub fn table(&self) -> &Snapshot {
        self.game.table()
    }

    /// Everything that was delivered so far.
    pub fn heard(&self) -> Vec<Event> {
        self.shared.lock().unwrap().heard.clone()
    }

    /// The last turn that was called.
    pub fn turn(&self) -> Option<Arc<Turn>> {
        let turn = |event| match event {
            Event::Turn(turn) => Some(turn),
            _ => None,
        };
        self.heard().into_iter().filter_map(turn).next_back()
    }

    pub fn facts(&self) -> Vec<Fact> {
        let fact = |event| match event {
            Event::Fact(fact) => Some(fact),
            _ => None,
        };
        self.heard().into_iter().filter_map(fact).collect()
    }

    pub fn verdicts(&self) -> Vec<Arc<Verdict>> {
        let verdict = |event| match event {
            Event::Verdict(verdict) => Some(verdict),
            _ => None,
        };
        self.heard().into_iter().filter_map(verdict).collect()
    }

    /// The game was played to its end, and the first player has pocketed a ball legally.
    #[track_caller]
    pub fn assert_won_or_lost(&self) {
        assert_eq!(self.finished.as_ref().unwrap().end, End::Over);
        let verdicts = self.verdicts();
        let own = || verdicts.iter().filter(|verdict| verdict.player == Some(PlayerId::ONE));
        assert!(own().any(|verdict| verdict.legal && !verdict.pocketed.is_empty()), "a pot");
        assert_eq!(verdicts.last().unwrap().turn, TurnAfter::End);
    }

    /// How often the tip met the cue ball.
    pub fn tips(&self) -> usize {
        let is_tip = |fact: &Fact| matches!(fact.kind, FactKind::CueBallStruck { .. });
        self.facts().iter().filter(|fact| is_tip(fact)).count()
    }

    /// How many frames were asked for.
    pub fn frames_asked(&self) -> u64 {
        self.shared.lock().unwrap().asked
    }

    /// All frames that said anything.
    pub fn frames(&self) -> Vec<(Tick, Frame)> {
        self.shared.lock().unwrap().frames.clone()
    }

    /// The commands of all frames.
    pub fn commands(&self) -> Vec<Command> {
        let frames = self.frames().into_iter().flat_map(|(_, frame)| frame);
        let command = |event| match event {
            Event::Command(command) => Some(command),
            _ => None,
        };
        frames.filter_map(|publication| command(publication.event)).collect()
    }

    /// What was answered in the last tick.
    pub fn last(&self) -> Inflow {
        self.shared.lock().unwrap().last.clone()
    }

    pub fn key(&mut self, key: Key) {
        self.tick(&[RawInput::Key { key, down: true }]);
        self.tick(&[RawInput::Key { key, down: false }]);
    }

    pub fn hold(&mut self, key: Key, ticks: u64) {
        self.tick(&[RawInput::Key { key, down: true }]);
        self.wait(ticks - 1);
        self.tick(&[RawInput::Key { key, down: false }]);
    }

    pub fn button(&mut self, button: Button, down: bool) {
        self.tick(&[RawInput::Button { button, down }]);
    }

    pub fn moved(&mut self, right: f64, up: f64) {
        self.tick(&[RawInput::Moved { right, up }]);
    }

    /// Turns the cue to an azimuth, as a script computes it from the view and the gain.
    pub fn turn_to(&mut self, azimuth_rad: f64) {
        let off = azimuth_rad - self.view().aim.azimuth_rad;
        let turn = std::f64::consts::TAU;
        let shortest = off - turn * libm::round(off / turn);
        self.moved(-shortest / AIM_RAD_PER_HEIGHT, 0.0);
    }

    /// Presses, pulls the tip back to `pull_m` behind the ball, and pushes the hand forwards at a
    /// constant speed until the tip meets something, for two seconds at most. The mouse reports
    /// `rate_hz` times a second.
    pub fn stroke(&mut self, pull_m: f64, speed_m_s: f64, rate_hz: u32) {
        self.button(Button::Left, true);
        let way_m = pull_m - ADDRESS_GAP_M;
        let back_ticks = 200;
        self.sweep(-way_m / (back_ticks as f64 / 1000.0), back_ticks, rate_hz);
        self.wait(100);
        self.sweep(speed_m_s, 2000, rate_hz);
        if self.finished.is_none() {
            self.button(Button::Left, false);
        }
    }

    /// Moves the hand at a constant speed while the stroke lasts.
    pub fn sweep(&mut self, speed_m_s: f64, ticks: u64, rate_hz: u32) {
        let rate = u64::from(rate_hz);
        let up = speed_m_s / f64::from(rate_hz) / STROKE_M_PER_HEIGHT;
        for tick in 1..=ticks {
            if self.mode() != HumanMode::Stroking {
                return;
            }
            // Reports come at whole periods; a tick takes those within its millisecond.
            let reports = tick * rate / 1000 - (tick - 1) * rate / 1000;
            let report = RawInput::Moved { right: 0.0, up };
            self.tick(&vec![report; reports as usize]);
        }
    }

    pub fn cue_ball(&self) -> &hapticbillard::ball::BallState {
        self.table().ball(BallId::CUE).unwrap()
    }
}
