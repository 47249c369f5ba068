//! A person whose stylus strikes: turns, ball in hand, and who reads the mouse.

use super::desk::free_play;
use glam::DVec3;
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::cast::Cast;
use hapticbillard::cue::{CuePath, CuePiece, TIP_RADIUS_M};
use hapticbillard::event_manager::Publication;
use hapticbillard::events::{Command, Event, FactKind, Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::input::{Action, HandInput, Human, HumanMode, Led, LedHuman};
use hapticbillard::lockstep::{Lockstep, Setup};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, FrameSource, Inflow, Outcome, Pace, Participant};
use hapticbillard::units::{TICK_S, Tick};
use std::sync::{Arc, Mutex};

/// How fast the tip of the stylus goes [m/s].
const SPEED_M_S: f64 = 2.5;

struct Table {
    led: LedHuman,
    reports: Vec<HandInput>,
    /// The tip begins a stroke here, along this.
    stroke: Option<(DVec3, DVec3, Tick)>,
    last: Option<Led>,
    hand: Vec<HandInput>,
    begun: u32,
    strikes: u32,
    cue_lifted: u32,
    seen: Arc<Snapshot>,
}

struct Hand(Arc<Mutex<Table>>);

impl FrameSource for Hand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let table = &mut *self.0.lock().unwrap();
        let reports = std::mem::take(&mut table.reports);
        let led = table.led.inflow(tick, &reports, &mut table.hand);
        table.begun += u32::from(led.begins);
        let mut inflow = led.inflow.clone();
        for entered in &inflow.frame {
            assert!(!matches!(entered.event, Event::Command(Command::MoveCue(_))));
            table.cue_lifted += u32::from(entered.event == Event::Command(Command::LiftCue));
        }
        if let Some((from, way, begin)) = table.stroke
            && led.strikes
        {
            let start_s = tick.start_s();
            let piece = CuePiece {
                start_s,
                duration_s: 5.0 * TICK_S,
                position: from + way * (SPEED_M_S * (start_s - begin.start_s())),
                velocity: way * SPEED_M_S,
                acceleration: DVec3::ZERO,
                direction: way,
                direction_end: way,
            };
            let path = CuePath { solid: true, pieces: std::iter::once(piece).collect() };
            let event = Event::Command(Command::MoveCue(Arc::new(path)));
            inflow.frame.push(Publication { event, delay_ticks: 0, label: None });
        }
        table.last = Some(led);
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
        self.0.lock().unwrap().led.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let table = &mut *self.0.lock().unwrap();
        table.seen = delivered.table.clone();
        for stamped in delivered.events.iter() {
            if let Event::Fact(fact) = &stamped.event {
                table.strikes += u32::from(matches!(fact.kind, FactKind::CueBallStruck { .. }));
            }
        }
        table.led.collect(delivered)
    }

    fn hash(&self, _: &mut StateHash) {}
}

struct Game {
    game: Lockstep<'static>,
    table: Arc<Mutex<Table>>,
    now: Tick,
}

impl Game {
    fn new(balls: &[(u16, f64, f64)]) -> Self {
        let scene = free_play(balls);
        let table = Arc::new(scene.build_table(&mut |_| Err(String::new())).unwrap());
        let mut cast = Cast::new(&scene, table.clone()).unwrap();
        cast.human = None;
        let table = Arc::new(Mutex::new(Table {
            led: LedHuman::new(Human::new(vec![PlayerId::ONE], table)),
            reports: Vec::new(),
            stroke: None,
            last: None,
            hand: Vec::new(),
            begun: 0,
            strikes: 0,
            cue_lifted: 0,
            seen: Arc::default(),
        }));
        let mut setup = Setup::headless(Tick(10_000_000));
        setup.pace = Pace::EveryTick;
        setup.input = Some(Box::new(Hand(table.clone())));
        setup.observers.push(Box::new(Hand(table.clone())));
        Game { game: Lockstep::new(cast, setup).unwrap(), table, now: Tick(0) }
    }

    fn tick(&mut self, reports: &[HandInput]) {
        self.table.lock().unwrap().reports.extend_from_slice(reports);
        self.game.step().unwrap();
        self.now = self.now.after(1);
    }

    fn wait_until(&mut self, ticks: u32, is_so: impl Fn(&Table) -> bool) {
        for _ in 0..ticks {
            if is_so(&self.table.lock().unwrap()) {
                return;
            }
            self.tick(&[]);
        }
        panic!("not within {ticks} ticks");
    }

    fn mode(&self) -> HumanMode {
        self.table.lock().unwrap().led.view().mode
    }

    /// The stylus goes through the cue ball towards a place.
    fn strike(&self, towards: DVec3) {
        let table = &mut *self.table.lock().unwrap();
        let ball = table.seen.ball(BallId::CUE).unwrap().position;
        let way = (towards - ball).with_z(0.0).normalize();
        let from = ball - way * (POOL_RADIUS_M + TIP_RADIUS_M + 0.01);
        table.stroke = Some((from, way, self.now));
    }
}

const MOVED: HandInput = HandInput::Moved { right: 0.1, up: 0.05 };

fn left(down: bool) -> HandInput {
    HandInput::Act { action: Action::Stroke, down }
}

#[test]
fn the_stylus_strikes_in_its_turn_and_the_mouse_is_its_hands() {
    let mut game = Game::new(&[(0, -0.5, 0.0), (1, 0.5, 0.2)]);
    game.wait_until(20, |table| table.begun == 1);
    assert_eq!(game.mode(), HumanMode::Aiming);
    game.tick(&[MOVED, left(true), left(false)]);
    assert_eq!(game.table.lock().unwrap().hand, [MOVED, left(true), left(false)]);
    assert_eq!(game.mode(), HumanMode::Aiming, "no stroke of the mouse");

    game.strike(DVec3::new(1.0, 0.0, 0.0));
    game.wait_until(200, |table| table.strikes == 1);
    game.table.lock().unwrap().stroke = None;
    // Whoever waits for balls may hurry; whoever aims has time.
    game.wait_until(50, |table| table.seen.is_rolling());
    game.tick(&[HandInput::Act { action: Action::Hurry, down: true }]);
    assert!(game.table.lock().unwrap().last.as_ref().unwrap().inflow.hurried);
    game.wait_until(90_000, |table| table.begun == 2);
    let table = game.table.lock().unwrap();
    assert!(!table.last.as_ref().unwrap().inflow.hurried);
    assert_eq!(table.cue_lifted, 1);
}

#[test]
fn a_ball_in_hand_is_put_down_by_the_mouse_and_struck_by_the_stylus() {
    // Straight into the corner.
    let mut game = Game::new(&[(0, 1.0, 0.365), (1, -0.5, 0.0)]);
    game.wait_until(20, |table| table.begun == 1);
    game.strike(DVec3::new(1.27, 0.635, 0.0));
    game.wait_until(200, |table| table.strikes == 1);
    game.table.lock().unwrap().stroke = None;
    game.wait_until(20_000, |table| table.led.view().mode == HumanMode::Placing);
    game.tick(&[]);
    assert!(!game.table.lock().unwrap().last.as_ref().unwrap().strikes);

    let before = game.table.lock().unwrap().led.view().placing.unwrap();
    game.tick(&[MOVED]);
    let after = game.table.lock().unwrap().led.view().placing.unwrap();
    assert!(after.x > before.x && after.y > before.y);
    game.tick(&[left(true), left(false)]);
    assert_eq!(game.table.lock().unwrap().hand, []);
    game.wait_until(50, |table| table.begun == 2);
    assert!(game.table.lock().unwrap().last.as_ref().unwrap().strikes);
    game.strike(DVec3::ZERO);
    game.wait_until(200, |table| table.strikes == 2);
}
