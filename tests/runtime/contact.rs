//! What the hand feels when something fails while it leans on a ball of a running game.

use super::hearing::Hears;
use glam::DVec3;
use hapticbillard::events::{Event, Health, Topic};
use hapticbillard::haptic::{Device, DeviceSpec, DeviceState, DeviceStatus, Force};
use hapticbillard::tick::{Finished, FrameSource, Inflow, Pace};
use hapticbillard::units::Tick;
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::crew::{Crew, Fault, Roster};
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{Asked, Core, Opened, Plan, Seat, Signs, Started};
use hapticbillard_actors::pacer::{StopFlag, Tempo};
use hapticbillard_actors::runtime::{self, Felt, InputPort, Setup};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The device goes down until it is pushed back with this [N], and rests there: less than what
/// the ramp after an interruption waits for.
const LEAN_N: f64 = 0.15;
/// How fast it goes down [m/s].
const DOWN_M_S: f64 = 0.02;
/// It waits until the start ramp is over [s].
const START_S: f64 = 3.0;
/// The ramp after an interruption takes half a second [s].
const RAMP_S: f64 = 0.5;

/// What test and device know of each other.
#[derive(Default)]
struct Wires {
    signs: OnceLock<Arc<Signs>>,
    says_nan: AtomicBool,
    is_lost: AtomicBool,
    panics: AtomicBool,
    is_gone: AtomicBool,
    /// It leans on something.
    leans: AtomicBool,
    /// Force of the last tick [N], as bits.
    force: AtomicU64,
    /// The most that it was ever pushed with [N], as bits.
    most: AtomicU64,
    /// Ticks in which it was pushed although it had said that it is lost, or no numbers.
    pushed_broken: AtomicU64,
    /// The most ticks in a row in which it was pushed although nobody held the dead man's switch.
    pushed_alone: AtomicU64,
    /// The steepest that the force ever rose from zero [N/s], as bits.
    steepest: AtomicU64,
}

impl Wires {
    fn force_n(&self) -> f64 {
        f64::from_bits(self.force.load(Ordering::SeqCst))
    }

    /// The force never rose faster than a ramp to the most of it does. (A loop that comes late
    /// carries less stiffness for a while: the time until there is most of the force says nothing.)
    #[track_caller]
    fn rose_softly(&self) {
        let of = |bits: &AtomicU64| f64::from_bits(bits.load(Ordering::SeqCst));
        let (most, steepest) = (of(&self.most), of(&self.steepest));
        assert!(most > LEAN_N && steepest > 0.0, "{most} N, {steepest} N/s");
        assert!(steepest < 1.02 * most / RAMP_S, "{steepest} N/s up to {most} N");
    }
}

/// A device that leans on what is below it.
struct Leaning {
    wires: Arc<Wires>,
    position: DVec3,
    is_broken: bool,
    alone: u64,
    /// Time since the start [s].
    time_s: f64,
    /// Time since there was no force [s].
    since_s: f64,
    /// It leant already when the force went: what comes now is the same force again.
    has_leant: bool,
}

impl Device for Leaning {
    fn spec(&self) -> DeviceSpec {
        DeviceSpec::OMNI
    }

    fn read(&mut self, dt: f64) -> DeviceState {
        let wires = &self.wires;
        assert!(!wires.panics.load(Ordering::SeqCst), "the device is made to panic here");
        let (is_nan, is_lost) =
            (wires.says_nan.load(Ordering::SeqCst), wires.is_lost.load(Ordering::SeqCst));
        self.is_broken = is_nan || is_lost;
        self.since_s += dt;
        self.time_s += dt;
        let leans = wires.leans.load(Ordering::SeqCst);
        if !leans && self.time_s > START_S {
            self.position.y -= DOWN_M_S * dt.min(0.002);
        }
        DeviceState {
            position: if is_nan { DVec3::NAN } else { self.position },
            velocity: if leans { DVec3::ZERO } else { DVec3::NEG_Y * DOWN_M_S },
            status: if is_lost { DeviceStatus::Lost } else { DeviceStatus::Ready },
            ..DeviceState::default()
        }
    }

    fn write(&mut self, force: Force) {
        let (wires, force_n) = (&self.wires, force.0.length());
        wires.force.store(force_n.to_bits(), Ordering::SeqCst);
        if force_n > LEAN_N {
            wires.leans.store(true, Ordering::SeqCst);
        }
        if force_n > 0.0 && self.is_broken {
            wires.pushed_broken.fetch_add(1, Ordering::SeqCst);
        }
        let is_held = wires.signs.get().is_none_or(|signs| signs.is_held());
        self.alone = if force_n > 0.0 && !is_held { self.alone + 1 } else { 0 };
        wires.pushed_alone.fetch_max(self.alone, Ordering::SeqCst);
        raise(&wires.most, force_n);
        if force_n == 0.0 {
            (self.since_s, self.has_leant) = (0.0, wires.leans.load(Ordering::SeqCst));
        } else if self.has_leant {
            raise(&wires.steepest, force_n / self.since_s);
        }
    }
}

/// Nobody else writes it.
fn raise(most: &AtomicU64, to: f64) {
    if to > f64::from_bits(most.load(Ordering::SeqCst)) {
        most.store(to.to_bits(), Ordering::SeqCst);
    }
}

impl Drop for Leaning {
    fn drop(&mut self) {
        self.wires.is_gone.store(true, Ordering::SeqCst);
    }
}

/// Holds the game up while somebody wants it.
struct Stalling(Arc<AtomicBool>);

impl FrameSource for Stalling {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        while self.0.load(Ordering::SeqCst) {
            std::thread::sleep(Duration::from_millis(1));
        }
        Inflow { next: Some(tick.after(1)), ..Inflow::default() }
    }
}

/// A game of `haptic_touch` in real time, in which the device leans on a ball.
struct Game {
    wires: Arc<Wires>,
    stall: Arc<AtomicBool>,
    roster: Roster,
    listener: Hears,
    stop: StopFlag,
    thread: Option<JoinHandle<Result<Finished, RunError>>>,
}

impl Game {
    fn start() -> Self {
        let stage = Stage::new(&load_scene("haptic_touch").unwrap(), "haptic_touch").unwrap();
        let wires = Arc::new(Wires::default());
        let device = Leaning {
            wires: wires.clone(),
            position: DVec3::new(0.0, 0.055, 0.0),
            is_broken: false,
            alone: 0,
            time_s: 0.0,
            since_s: 0.0,
            has_leant: false,
        };
        let plan = Plan {
            opened: Opened::new(device),
            asked: Asked { core: Core::Any, lock_memory: false, ..Asked::default() },
            ..stage.haptic().unwrap().unwrap()
        };
        let Started { seat, world, .. } = Seat::start(plan).unwrap();
        assert!(wires.signs.set(seat.signs().clone()).is_ok());
        let (crew, roster) = Crew::watched();
        let (stop, stall) = (StopFlag::default(), Arc::new(AtomicBool::new(false)));
        let listener = Hears::of(Topic::Health);
        let setup = Setup {
            pace: Pace::EveryTick,
            tempo: Tempo::RealTime(1.0),
            input: InputPort::StandIn(Box::new(Stalling(stall.clone()))),
            observers: vec![Box::new(listener.clone())],
            haptic: Some(Felt { seat, world }),
            stop: stop.clone(),
            crew,
            workers: 2,
            ..Setup::headless(Tick(600_000))
        };
        let cast = stage.cast().unwrap();
        let thread = std::thread::spawn(move || runtime::run(cast, setup));
        let game = Game { wires, stall, roster, listener, stop, thread: Some(thread) };
        game.wait_for_lean();
        game
    }

    #[track_caller]
    fn wait_for(&self, what: &str, is_so: impl Fn(&Wires) -> bool) {
        let start = Instant::now();
        while !is_so(&self.wires) {
            let force = self.wires.force_n();
            let is_late = start.elapsed() > Duration::from_secs(60);
            assert!(!is_late, "in vain: {what}; {force} N");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Waits until the ball pushes as it will.
    #[track_caller]
    fn wait_for_lean(&self) {
        self.wait_for("a ball", |wires| wires.leans.load(Ordering::SeqCst));
        self.wait_for("a steady force", |wires| {
            let before = wires.force_n();
            std::thread::sleep(Duration::from_millis(300));
            let now = wires.force_n();
            // A busy machine lets the servo come late, which takes the force away for a while.
            before > 0.1 * LEAN_N && (now - before).abs() < 1e-3 * now
        });
    }

    #[track_caller]
    fn wait_for_nothing(&self) {
        self.wait_for("no force", |wires| wires.force_n() == 0.0);
    }

    /// Waits until the player was told of a failure for this reason.
    #[track_caller]
    fn wait_for_word(&self, of: &str) {
        let heard = || {
            self.listener.heard(|event| match event {
                Event::Health(health) => match &**health {
                    Health::ActorFailed { reason, .. } => Some(reason.clone()),
                    _ => None,
                },
                _ => None,
            })
        };
        self.wait_for(of, |_| heard().iter().any(|reason| reason.contains(of)));
    }

    /// The force comes back, and slowly.
    #[track_caller]
    fn comes_back_softly(&self) {
        self.wait_for_lean();
        self.wires.rose_softly();
    }

    fn end(mut self) {
        self.stop.set();
        let finished = self.thread.take().unwrap().join().unwrap();
        assert!(finished.is_ok(), "{finished:?}");
        assert!(self.wires.is_gone.load(Ordering::SeqCst) && self.wires.force_n() == 0.0);
    }
}

#[test]
fn a_killed_control_takes_the_force_away_and_the_next_one_brings_it_back_softly() {
    let game = Game::start();
    assert_eq!(game.roster.strike("haptic", Fault::Kill), 1);
    game.wait_for_nothing();
    game.wait_for_word("its control stopped");
    game.comes_back_softly();
    // A tick that had begun when the switch was let go may end with its force, and no other.
    assert!(game.wires.pushed_alone.load(Ordering::SeqCst) <= 1);
    game.end();
}

#[test]
fn a_device_that_is_lost_or_says_nan_has_no_force_at_the_same_tick_and_gets_it_back_softly() {
    let game = Game::start();
    for (switch, told) in
        [(&game.wires.is_lost, "is not ready"), (&game.wires.says_nan, "no numbers")]
    {
        switch.store(true, Ordering::SeqCst);
        game.wait_for_nothing();
        game.wait_for_word(told);
        switch.store(false, Ordering::SeqCst);
        game.comes_back_softly();
    }
    assert_eq!(game.wires.pushed_broken.load(Ordering::SeqCst), 0);
    game.end();
}

#[test]
fn a_world_that_stalls_fades_out_of_the_hand_and_comes_back_softly() {
    let game = Game::start();
    game.stall.store(true, Ordering::SeqCst);
    // 20 ms of patience and 50 ms of fading; a busy machine takes its time to look.
    let start = Instant::now();
    game.wait_for_nothing();
    assert!(start.elapsed() < Duration::from_secs(2), "{:?}", start.elapsed());
    game.stall.store(false, Ordering::SeqCst);
    game.wait_for_word("the world stands still");
    game.wait_for_lean();
    game.end();
}

#[test]
fn a_servo_that_panics_leaves_no_force_and_the_game_goes_on_and_says_so() {
    let game = Game::start();
    game.wires.panics.store(true, Ordering::SeqCst);
    game.wait_for_nothing();
    game.wait_for_word("the servo ended");
    game.end();
}
