//! The servo's thread and its control: rights refused, actors killed, devices and worlds that fail.

use crate::cli::folder;
use crate::counting::calls;
use crate::hearing::Hears;
use glam::{DVec2, DVec3};
use hapticbillard::cue::Aim;
use hapticbillard::events::{Event, Fact, FactKind, Health, Topic, Topics, Verdict};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{
    Buttons, Device, DeviceSpec, DeviceState, DeviceStatus, Effect, EffectSet, Force, HapticMesh,
    Reach, ReachSettings, SafetyFlags, Servo, ServoReport, ServoSettings, Touched,
};
use hapticbillard::ids::BallId;
use hapticbillard::physics::Snapshot;
use hapticbillard::scene::HapticDevice;
use hapticbillard::tick::{Delivered, FrameSource, Inflow, Pace};
use hapticbillard::units::{TICK_S, Tick};
use hapticbillard_actors::event_manager::Sink;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{
    AllPorts, Asked, Body, ControlPorts, Core, DeviceRecorder, Grant, Haptic, Look, Opened, Orders,
    Plan, Seat, Signs, Started, Stylus, Watch, WorldPort, keep, open,
};
use hapticbillard_actors::pacer::Tempo;
use hapticbillard_actors::runtime::{self, Felt, InputPort, Setup};
use kameo::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// What a test knows of a device, and what it makes it do.
#[derive(Default)]
pub struct Wires {
    /// Size of the last force that was written [N], as bits.
    force: AtomicU64,
    held: AtomicU8,
    says_nan: AtomicBool,
    is_lost: AtomicBool,
    is_gone: AtomicBool,
}

impl Wires {
    fn force_n(&self) -> f64 {
        f64::from_bits(self.force.load(Ordering::SeqCst))
    }
}

/// A device in nobody's hand: it rests in the middle.
struct Wired(Arc<Wires>);

impl Device for Wired {
    fn spec(&self) -> DeviceSpec {
        DeviceSpec::OMNI
    }

    fn read(&mut self, _: f64) -> DeviceState {
        let is_nan = self.0.says_nan.load(Ordering::SeqCst);
        let is_lost = self.0.is_lost.load(Ordering::SeqCst);
        DeviceState {
            position: if is_nan { DVec3::NAN } else { DVec3::ZERO },
            buttons: Buttons(self.0.held.load(Ordering::SeqCst)),
            status: if is_lost { DeviceStatus::Lost } else { DeviceStatus::Ready },
            ..DeviceState::default()
        }
    }

    fn write(&mut self, force: Force) {
        self.0.force.store(force.0.length().to_bits(), Ordering::SeqCst);
    }
}

impl Drop for Wired {
    fn drop(&mut self) {
        self.0.is_gone.store(true, Ordering::SeqCst);
    }
}

/// What the device is pushed with [N]: less than what the start ramp waits for.
pub const PUSH_N: f64 = 0.1;

fn wired() -> (Plan, Arc<Wires>) {
    let wires = Arc::new(Wires::default());
    let plan = Plan {
        opened: Opened::new(Wired(wires.clone())),
        asked: Asked { core: Core::Any, lock_memory: false, ..Asked::default() },
        mesh: None,
        effects: EffectSet::of(1, &[Effect::Constant { force: DVec3::X * PUSH_N }]),
        reach: None,
        lay: None,
        bodies: Vec::new(),
    };
    (plan, wires)
}

/// A world that does nothing but live, as long as this does.
pub struct Heart {
    beats: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Heart {
    pub fn of(signs: &Arc<Signs>) -> Self {
        let (signs, beats) = (signs.clone(), Arc::new(AtomicBool::new(true)));
        let go_on = beats.clone();
        let thread = std::thread::spawn(move || {
            while go_on.load(Ordering::SeqCst) {
                signs.beat();
                std::thread::sleep(Duration::from_millis(1));
            }
        });
        Heart { beats, thread: Some(thread) }
    }
}

impl Drop for Heart {
    fn drop(&mut self) {
        self.beats.store(false, Ordering::SeqCst);
        self.thread.take().unwrap().join().unwrap();
    }
}

#[track_caller]
pub fn wait_for(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "in vain: {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn wait_for_push(wires: &Wires) {
    wait_for("the full force", || wires.force_n() > 0.99 * PUSH_N);
}

fn wait_for_nothing(wires: &Wires) {
    wait_for("no force", || wires.force_n() == 0.0);
}

pub fn tokio() -> tokio::runtime::Runtime {
    tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_time().build().unwrap()
}

/// A control that holds a servo.
pub fn control(runtime: &tokio::runtime::Runtime, seat: &Arc<Seat>) -> ActorRef<Haptic> {
    let _inside = runtime.enter();
    Haptic::spawn(Haptic::new(seat).unwrap())
}

#[test]
fn a_turn_of_the_loop_allocates_nothing() {
    let stage = Stage::new(&load_scene("eight_ball").unwrap(), "eight_ball").unwrap();
    let balls = stage.scene.build_balls(&stage.table).unwrap();
    let table = stage.simulation().unwrap().snapshot(0.0);
    let aim = Aim { elevation_rad: 0.2, ..Aim::default() };
    let (parameters, settings) = (stage.scene.parameters(), ReachSettings::default());
    let reach = Reach::to_ball(1, balls[0].1.position, &aim, &settings, &parameters);
    let push = |generation| {
        let effects = [Effect::Constant { force: DVec3::X * (PUSH_N / 8.0) }; 8];
        EffectSet::of(generation, &effects)
    };
    let orders = Orders { effects: push(1), reach: Some(reach), stiffness_max_n_m: 500.0 };
    let bodies = balls.into_iter().map(|(ball, _)| ball).collect();
    // A window and a file look on.
    let (picture, mut shown) = triple_buffer::triple_buffer(&ServoReport::default());
    let (telemetry, mut rows) = rtrb::RingBuffer::new(64);
    let (picture, telemetry) = (Some(picture), Some(telemetry));
    let watch = Watch { picture, telemetry, ..Watch::default() };
    let AllPorts { servo, mut control, mut stylus, mut world, signs } =
        AllPorts::watched(orders, bodies, watch);
    let device = open(&HapticDevice::Simulated).unwrap().unwrap().device;
    let rendered = Servo::new(ServoSettings::of(&DeviceSpec::OMNI))
        .among(Arc::new(HapticMesh::of(&stage.table)));
    let mut body = Body::new(device, rendered, servo);
    signs.hold(true);
    let (mut felt_n, mut told) = (0.0_f64, 0_u64);
    for tick in 0_u32..5000 {
        if tick % 3 == 0 {
            world.show(&table);
        }
        if tick % 100 == 0 {
            let stiffness_max_n_m = if tick % 200 == 0 { 500.0 } else { 250.0 };
            control.orders.write(Orders { effects: push(tick), stiffness_max_n_m, ..orders });
        }
        // For a while nobody takes samples: the ring is full.
        if !(2000..3000).contains(&tick) {
            while stylus.samples.pop().is_ok() {}
            while let Ok(row) = rows.pop() {
                assert_eq!((row.report.sample.tick, row.late_ns), (told + 1, 7));
                told += 1;
            }
        }
        let before = calls();
        body.begin_late(7);
        let force = body.turn(0.001).force;
        assert_eq!(calls() - before, 0, "tick {tick}");
        felt_n = felt_n.max(force.0.length());
        assert_eq!(shown.read().sample.tick, u64::from(tick) + 1);
        if tick == 2999 {
            // What waited is told; what found no room is lost, and counted.
            assert_eq!(control.timing.lost_rows(), 1001 - 64);
            while rows.pop().is_ok() {
                told += 1;
            }
            told += control.timing.lost_rows();
        }
    }
    assert!(felt_n > 0.05, "nothing was felt");
    assert!(control.timing.lost_samples() > 500, "the ring was never full");
}

#[test]
fn a_softer_order_is_followed_without_a_step() {
    let (plan, wires) = wired();
    let point = Effect::Point { point: DVec3::X * 0.01, stiffness_n_m: 400.0, damping_ns_m: 0.0 };
    let order = |stiffness_max_n_m| Orders {
        effects: EffectSet::of(1, &[point]),
        reach: None,
        stiffness_max_n_m,
    };
    let AllPorts { servo, mut control, signs, .. } = AllPorts::new(order(10.0), Vec::new());
    let rendered = Servo::new(ServoSettings::of(&DeviceSpec::OMNI));
    let mut body = Body::new(plan.opened.device, rendered, servo);
    signs.hold(true);
    let mut turns = |n: u32, most_step_n: f64| {
        let mut last = wires.force_n();
        for _ in 0..n {
            signs.beat();
            body.turn(0.001);
            assert!((wires.force_n() - last).abs() < most_step_n, "{last} N");
            last = wires.force_n();
        }
        last
    };
    // 10 mm at 10 N/m, over the start ramp; then at 50 N/m; then at 20 N/m.
    assert!((turns(1000, 0.01) - 0.1).abs() < 1e-9);
    control.orders.write(order(50.0));
    assert!((turns(500, 0.01) - 0.5).abs() < 1e-9);
    control.orders.write(order(20.0));
    assert!((turns(500, 0.01) - 0.2).abs() < 1e-9);
}

/// The calling thread, and those that it starts, lose the right to real-time priority.
#[cfg(target_os = "linux")]
fn give_up_rights() {
    use rustix::thread::{CapabilitySet, capabilities, set_capabilities};
    let mut sets = capabilities(None).unwrap();
    let lost = CapabilitySet::SYS_NICE | CapabilitySet::IPC_LOCK;
    sets.effective -= lost;
    sets.permitted -= lost;
    sets.inheritable -= lost;
    set_capabilities(None, sets).unwrap();
}

#[cfg(target_os = "linux")]
#[test]
fn without_rights_the_servo_runs_says_what_would_help_and_ends_in_order() {
    use rustix::process::{Resource, getrlimit};
    give_up_rights();
    let (plan, wires) = wired();
    let asked =
        Asked { core: Core::Number(1023), priority: Some(80), lock_memory: true, spin_us: 0 };
    let Started { seat, .. } = Seat::start(Plan { asked, ..plan }).unwrap();
    let Grant::Refused(core) = &seat.obtained().core else { panic!("{:?}", seat.obtained()) };
    assert!(core.asked.contains("1023") && core.remedy.contains("[haptic]"), "{core}");
    // A user may have been given the right by other means.
    if getrlimit(Resource::Rtprio).current == Some(0) {
        let Grant::Refused(priority) = &seat.obtained().priority else {
            panic!("{:?}", seat.obtained())
        };
        assert!(priority.asked.contains("80") && priority.remedy.contains("rtprio"), "{priority}");
    }
    let heart = Heart::of(seat.signs());
    let mut held = seat.hold().unwrap();
    assert!(seat.hold().is_none(), "two hold it");
    let softer = Orders { stiffness_max_n_m: 123.0, ..*held.orders() };
    held.order(softer);
    drop(held);
    // Another one goes on with what was ordered last.
    let held = seat.hold().unwrap();
    assert_eq!(*held.orders(), softer);
    wait_for_push(&wires);
    assert!(seat.timing().ticks() > 400 && seat.is_running());
    drop(held);
    drop(seat);
    assert!(wires.is_gone.load(Ordering::SeqCst), "the device is still open");
    assert_eq!(wires.force_n(), 0.0);
    drop(heart);
}

#[test]
fn every_edge_of_a_button_is_told_in_order() {
    let (plan, wires) = wired();
    let (watch, mut heard) = Watch::default().with_buttons();
    let Started { seat, .. } = Seat::start_watched(plan, watch).unwrap();
    wait_for("a tick", || seat.timing().ticks() > 0);
    for held in [1, 3, 2, 0, 1, 0] {
        wires.held.store(held, Ordering::SeqCst);
        let ticks = seat.timing().ticks();
        wait_for("two ticks", || seat.timing().ticks() >= ticks + 2);
    }
    let edges: Vec<(u8, bool)> =
        std::iter::from_fn(|| heard.pop().ok()).map(|edge| (edge.button.0, edge.down)).collect();
    assert_eq!(edges, [(1, true), (2, true), (1, false), (2, false), (1, true), (1, false)]);
}

#[test]
fn a_killed_control_leaves_no_force_another_one_takes_over_and_the_end_is_quiet() {
    let (plan, wires) = wired();
    let Started { seat, .. } = Seat::start(plan).unwrap();
    let _heart = Heart::of(seat.signs());
    let (tell, news) = flume::unbounded();
    let runtime = tokio();
    let keeper = {
        let _inside = runtime.enter();
        keep(seat.clone(), tell)
    };
    wait_for_push(&wires);
    let first = keeper.control().unwrap();
    first.kill();
    runtime.block_on(first.wait_for_shutdown());
    wait_for_nothing(&wires);
    assert!(seat.is_running(), "the thread outlives its control");
    wait_for("another control", || keeper.control().is_some_and(|other| other.id() != first.id()));
    wait_for_push(&wires);
    let told: Vec<Health> = news.try_iter().collect();
    let failed = told.iter().position(
        |health| matches!(health, Health::ActorFailed { reason, .. } if reason.contains("stopped")),
    );
    let restarted = told.iter().rposition(|health| matches!(health, Health::ActorRestarted { .. }));
    assert!(failed.is_some() && failed < restarted, "{told:?}");
    runtime.block_on(keeper.end());
    wait_for_nothing(&wires);
    drop(seat);
    assert!(wires.is_gone.load(Ordering::SeqCst));
    assert_eq!(wires.force_n(), 0.0);
}

/// Asks until the control has news; returns the reason.
fn reason(runtime: &tokio::runtime::Runtime, control: &ActorRef<Haptic>) -> String {
    let mut reason = String::new();
    wait_for("news", || {
        let looked = runtime.block_on(control.ask(Look).send()).unwrap();
        looked.news.into_iter().any(|health| match health {
            Health::ActorFailed { reason: why, .. } => {
                reason = why;
                true
            }
            _ => false,
        })
    });
    reason
}

#[test]
fn a_device_that_says_nan_or_is_lost_and_a_world_that_stalls_leave_no_force_and_are_told() {
    let (plan, wires) = wired();
    let Started { seat, .. } = Seat::start(plan).unwrap();
    let runtime = tokio();
    let control = control(&runtime, &seat);
    let look = || runtime.block_on(control.ask(Look).send()).unwrap();
    let settle = || {
        wait_for_push(&wires);
        wait_for("calm", || look().report.flags == SafetyFlags::default());
    };
    let heart = Heart::of(seat.signs());
    for (switch, expected) in
        [(&wires.says_nan, "no numbers"), (&wires.is_lost, "the device is not ready")]
    {
        settle();
        switch.store(true, Ordering::SeqCst);
        wait_for_nothing(&wires);
        assert!(reason(&runtime, &control).contains(expected), "{expected}");
        switch.store(false, Ordering::SeqCst);
        wait_for("the news that it is well", || {
            look().news.iter().any(|health| matches!(health, Health::ActorRestarted { .. }))
        });
    }
    settle();
    drop(heart);
    assert!(reason(&runtime, &control).contains("the world stands still"));
    wait_for_nothing(&wires);
    // And back, softly.
    let _heart = Heart::of(seat.signs());
    wait_for_push(&wires);
}

#[test]
fn a_game_feels_its_balls_and_tells_the_player_what_is_wrong() {
    let stage = Stage::new(&load_scene("haptic_touch").unwrap(), "haptic_touch").unwrap();
    let (wired, wires) = wired();
    wires.says_nan.store(true, Ordering::SeqCst);
    let mut plan = stage.haptic().unwrap().unwrap();
    assert_eq!(plan.bodies.len(), 5);
    plan.opened = wired.opened;
    plan.asked = wired.asked;
    let Started { seat, world, .. } = Seat::start(plan).unwrap();
    let (mail, heard) = flume::unbounded::<Delivered>();
    let sink = Sink::new("test", Topics::of(&[Topic::Health]), mail);
    let setup = Setup {
        pace: Pace::EveryTick,
        tempo: Tempo::RealTime(1.0),
        sinks: vec![sink],
        haptic: Some(Felt { seat, world }),
        ..Setup::headless(Tick(600))
    };
    runtime::run(stage.cast().unwrap(), setup).unwrap();
    let told = heard.iter().any(|delivered| {
        delivered.events.iter().any(|stamped| {
            matches!(&stamped.event, Event::Health(health)
                if matches!(&**health, Health::ActorFailed { actor, reason }
                    if actor == "haptic" && reason.contains("no numbers")))
        })
    });
    assert!(told, "the player was not told");
    assert!(wires.is_gone.load(Ordering::SeqCst), "the game left its servo running");
    assert_eq!(wires.force_n(), 0.0);
}

/// Device, servo and stylus, a turn for every tick of the game: the thread without its clock.
struct InStep {
    body: Body,
    control: ControlPorts,
    table: triple_buffer::Output<Arc<Snapshot>>,
    world: WorldPort,
    stylus: Stylus,
    felt: Arc<Mutex<Vec<(f64, Touched)>>>,
}

impl FrameSource for InStep {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        if self.table.update() {
            self.world.show(self.table.output_buffer());
        }
        self.body.turn(TICK_S);
        let report = self.control.report.read();
        if let Some(contact) = report.contact {
            self.felt.lock().unwrap().push((report.force.0.length(), contact.touched));
        }
        self.stylus.inflow(tick)
    }
}

const TWO_HANDS: &str = r#"
[scene]
name = "Two hands at a stylus"
[physics]
solver = "event-driven"
[table]
preset = "pool-9ft"
[balls]
rack = "eight-ball"
[cue]
[rules]
game = "paper-eight-ball"
[[player]]
name = "One"
kind = "human"
[[player]]
name = "Two"
kind = "human"
[haptic]
device = "simulated"
"#;

/// What two hands at a table came to.
struct Broken {
    /// Every contact that was felt, with the force in its tick [N].
    felt: Vec<(f64, Touched)>,
    /// How fast the cue struck [m/s].
    speeds: Vec<f64>,
    verdicts: Vec<Verdict>,
}

/// Lets a device break, tick by tick with the game, in the scene at `file`.
fn broken(file: &Path, device: impl FnOnce(Opened) -> Opened) -> Broken {
    let stage = Stage::new(&load_scene(file.to_str().unwrap()).unwrap(), "two_hands").unwrap();
    let plan = stage.haptic().unwrap().unwrap();
    let (effects, reach) = (plan.effects, plan.reach);
    let orders = Orders { effects, reach, stiffness_max_n_m: 500.0 };
    let AllPorts { servo, control, stylus, world, signs } = AllPorts::new(orders, plan.bodies);
    let device = device(plan.opened).device;
    let rendered = Servo::new(ServoSettings::of(&device.spec())).among(plan.mesh.unwrap());
    let (shown, table) = triple_buffer::triple_buffer(&Arc::<Snapshot>::default());
    let felt = Arc::new(Mutex::new(Vec::new()));
    let body = Body::new(device, rendered, servo);
    let stylus = Stylus::new(stylus);
    signs.hold(true);
    let hand = InStep { body, control, table, world, stylus, felt: felt.clone() };
    let verdicts = Hears::of(Topic::Verdict);
    let (mail, facts) = flume::unbounded::<Delivered>();
    let sink = Sink::new("test", Topics::of(&[Topic::CueBallStruck]), mail);
    let setup = Setup {
        pace: Pace::EveryTick,
        input: InputPort::StandIn(Box::new(hand)),
        observers: vec![Box::new(verdicts.clone())],
        sinks: vec![sink],
        world: Some(shown),
        ..Setup::headless(Tick(20_000))
    };
    runtime::run(stage.cast().unwrap(), setup).unwrap();

    let told = facts.iter().flat_map(|delivered| delivered.events.to_vec());
    let speeds = told
        .filter_map(|stamped| match stamped.event {
            Event::Fact(Fact {
                kind: FactKind::CueBallStruck { normal_speed_m_s, .. }, ..
            }) => Some(normal_speed_m_s),
            _ => None,
        })
        .collect();
    let verdicts = verdicts.heard(|event| match event {
        Event::Verdict(verdict) => Some(Verdict::clone(verdict)),
        _ => None,
    });
    let felt = felt.lock().unwrap().clone();
    Broken { felt, speeds, verdicts }
}

/// The scene with two hands, and a hand that breaks.
fn two_hands(name: &str) -> (PathBuf, SimulatedDevice) {
    let file = folder(name).join("two_hands.toml");
    fs::write(&file, TWO_HANDS).unwrap();
    // The hand lets go and gets out of the way of what comes back.
    let aside = Leg::to(DVec3::new(0.0, 0.03, 0.02), 0.3);
    let guide = Guide::Script(HandScript::stroke(1.2, 0.3).then(aside));
    (file, SimulatedDevice::new(DeviceSpec::OMNI, HandModel::ARM, guide))
}

#[test]
fn a_hand_breaks_and_the_referee_judges_it() {
    let (file, hand) = two_hands("two_hands");
    let Broken { felt, speeds, verdicts } = broken(&file, |_| Opened::new(hand));
    let struck = felt.iter().filter(|(_, touched)| *touched == Touched::Struck(BallId::CUE));
    assert_eq!(struck.count(), 1, "{felt:?}");
    assert!(felt.iter().all(|(force_n, _)| *force_n <= 3.3), "{felt:?}");
    // Scale and gain make 6.6 m/s of an arm at 1.2 m/s.
    assert!((speeds[0] / 6.6 - 1.0).abs() < 0.03, "{speeds:?}");
    assert_eq!(verdicts.len(), 1, "{verdicts:?}");
}

#[test]
fn a_mouse_turns_and_raises_the_workspace() {
    let file = folder("turned_workspace").join("two_hands.toml");
    fs::write(&file, TWO_HANDS).unwrap();
    let stage = Stage::new(&load_scene(file.to_str().unwrap()).unwrap(), "two_hands").unwrap();
    let (wired, _) = wired();
    let Plan { opened, asked, .. } = wired;
    let plan = Plan { opened, asked, ..stage.haptic().unwrap().unwrap() };
    let Started { seat, .. } = Seat::start(plan).unwrap();
    let runtime = tokio();
    let control = control(&runtime, &seat);
    let look = || runtime.block_on(control.ask(Look).send()).unwrap().report;
    wait_for("a workspace", || look().elevation_rad > 0.0);
    let before = look();
    seat.signs().turn(DVec2::new(0.3, 0.1));
    seat.signs().turn(DVec2::new(-0.1, 0.1));
    let is_near = |angle: f64, expected: f64| (angle - expected).abs() < 1e-9;
    wait_for("the turn", || {
        let now = look();
        is_near(now.azimuth_rad, before.azimuth_rad + 0.2)
            && is_near(now.elevation_rad, before.elevation_rad + 0.2)
    });
}

#[test]
fn a_recorded_hand_breaks_as_it_did_bit_by_bit() {
    let (file, hand) = two_hands("recorded_hand");
    let mut recorder = None;
    let once = broken(&file, |_| {
        let path = file.with_file_name("hand.jsonl");
        let (opened, tapped) = DeviceRecorder::tap(Opened::new(hand), path).unwrap();
        recorder = Some(tapped);
        opened
    });
    let recorded = recorder.unwrap().finish().unwrap();
    assert!(recorded.readings >= 20_000 && recorded.lost == 0, "{recorded:?}");
    let scene = TWO_HANDS.replace("\"simulated\"", "\"recorded:hand.jsonl\"");
    fs::write(&file, scene).unwrap();
    let again = broken(&file, |opened| opened);
    assert_eq!(again.felt, once.felt);
    assert_eq!((again.speeds, again.verdicts), (once.speeds, once.verdicts));
    assert!(once.felt.iter().any(|(_, touched)| *touched == Touched::Struck(BallId::CUE)));
}

#[test]
fn a_scene_says_how_far_a_hand_reaches() {
    let speed = |name, keys: &str| {
        let (file, hand) = two_hands(name);
        fs::write(&file, TWO_HANDS.to_string() + keys).unwrap();
        broken(&file, |_| Opened::new(hand)).speeds[0]
    };
    let half = speed("half_the_reach", "stroke_gain = 1.375\n") / speed("the_reach", "");
    assert!((half - 0.5).abs() < 0.05, "{half}");
}
