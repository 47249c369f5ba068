//! OpenHaptics through the real backend, in front of a stub library with scripted faults: what is
//! read, what the player is told, and that no force is left.

use crate::cli::{folder, lines, text};
use crate::counting::calls;
use crate::servo::{Heart, PUSH_N, tokio, wait_for};
use crate::stub_hd::{StubHd, lacking_one, whole};
use glam::DVec3;
use hapticbillard::events::Health;
use hapticbillard::haptic::{
    Buttons, Device, DeviceSpec, DeviceState, Effect, EffectSet, Force, SafetyFlags, ServoReport,
};
use hapticbillard_actors::haptic::openhaptics::{NoOpenHaptics, look, open};
use hapticbillard_actors::haptic::{
    Asked, Grant, Haptic, Look, NoServo, Opened, Plan, Seat, Started, keep,
};
use kameo::prelude::*;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Less than this is felt as a push, whatever a busy machine's lateness leaves of the stiffness.
const FELT_N: f64 = 0.1 * PUSH_N;

fn plan(opened: Opened) -> Plan {
    Plan {
        opened,
        asked: Asked::default(),
        mesh: None,
        effects: EffectSet::of(1, &[Effect::Constant { force: DVec3::X * PUSH_N }]),
        reach: None,
        lay: None,
        bodies: Vec::new(),
    }
}

/// A servo at the stub, its world alive, its control at work.
struct Game {
    stub: StubHd,
    seat: Arc<Seat>,
    control: ActorRef<Haptic>,
    runtime: tokio::runtime::Runtime,
    heart: Heart,
}

impl Game {
    fn start(test: &str, script: &str) -> Self {
        let stub = StubHd::new(test, script);
        let opened = open(Some(stub.path()), None).unwrap();
        Game::with(stub, opened)
    }

    fn with(stub: StubHd, opened: Opened) -> Self {
        let Started { seat, .. } = Seat::start(plan(opened)).unwrap();
        let heart = Heart::of(seat.signs());
        let runtime = tokio();
        let control = {
            let _inside = runtime.enter();
            Haptic::spawn(Haptic::new(&seat).unwrap())
        };
        Game { stub, seat, control, runtime, heart }
    }

    fn report(&self) -> ServoReport {
        self.runtime.block_on(self.control.ask(Look).send()).unwrap().report
    }

    /// Waits until the player is told this. A busy machine may have other news meanwhile.
    #[track_caller]
    fn wait_for_news(&self, expected: &str) {
        let mut told = Vec::new();
        let start = Instant::now();
        while !told.iter().any(|told: &String| told.contains(expected)) {
            assert!(start.elapsed() < Duration::from_secs(60), "'{expected}' not in {told:?}");
            let looked = self.runtime.block_on(self.control.ask(Look).send()).unwrap();
            told.extend(looked.news.into_iter().filter_map(|health| match health {
                Health::ActorFailed { reason, .. } => Some(reason),
                _ => None,
            }));
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    #[track_caller]
    fn wait_for_push(&self) {
        wait_for("a push", || self.stub.force_n() > FELT_N && self.stub.pushes());
    }

    #[track_caller]
    fn wait_for_nothing(&self) {
        wait_for("no force", || self.stub.force_n() == 0.0);
    }

    #[track_caller]
    fn wait_for_well(&self) {
        wait_for("the news that it is well", || {
            let looked = self.runtime.block_on(self.control.ask(Look).send()).unwrap();
            looked.news.iter().any(|health| matches!(health, Health::ActorRestarted { .. }))
        });
    }

    /// Ends it all; what was called since the beginning.
    fn end(self) -> Vec<String> {
        let Game { stub, seat, control, runtime, heart } = self;
        runtime.block_on(async {
            let _ = control.stop_gracefully().await;
            control.wait_for_shutdown().await;
        });
        drop((runtime, seat, heart));
        assert_eq!(stub.force_n(), 0.0, "{:?}", stub.log());
        assert!(!stub.pushes());
        let log = stub.log();
        let wrong = ["second frame", "no frame", "outside"];
        assert!(!log.iter().any(|line| wrong.iter().any(|wrong| line.contains(wrong))), "{log:?}");
        log
    }
}

#[test]
fn the_library_turns_the_servo_and_is_left_in_order() {
    let game = Game::start("in_order", "");
    // The middle of its workspace is 10 mm above the library's origin.
    game.stub.place([20.0, 40.0, -10.0], 3);
    game.wait_for_push();
    wait_for("the reading", || game.report().sample.device.buttons == Buttons(3));
    let device = game.report().sample.device;
    assert!((device.position - DVec3::new(0.02, 0.03, -0.01)).length() < 1e-12, "{device:?}");
    assert!((device.pointing() - DVec3::NEG_X).length() < 1e-12, "{device:?}");
    assert!(game.seat.obtained().parts().iter().all(|(_, grant)| **grant == Grant::Vendors));
    assert!(game.seat.refusals().next().is_none() && game.seat.why().is_none());
    let ticks = game.seat.timing().ticks();
    wait_for("a thousand ticks", || game.seat.timing().ticks() > ticks + 1000);
    let log = game.end();
    let expected = [
        "init ''",
        "enable 0x4000",
        "enable 0x4002",
        "enable 0x4001",
        "schedule",
        "start",
        "callback done",
        "disable 0x4000",
        "stop",
        "unschedule",
        "close, last force 0 0 0",
    ];
    assert_eq!(log, expected);
}

#[test]
fn the_device_says_what_it_is_and_where_it_does_not_an_omni_stands_in() {
    let stub = StubHd::new("spec", "");
    let seen = look(Some(stub.path()), None).unwrap();
    let expected = DeviceSpec {
        model: "Stub Omni",
        workspace_m: DVec3::new(0.2, 0.14, 0.08),
        force_max_n: 2.5,
        force_continuous_n: 0.7,
        stiffness_max_n_m: 400.0,
        damping_max_ns_m: 3.0,
        has_own_scheduler: true,
        ..DeviceSpec::OMNI
    };
    assert!((seen.spec.workspace_m - expected.workspace_m).length() < 1e-12);
    assert_eq!(DeviceSpec { workspace_m: expected.workspace_m, ..seen.spec }, expected);
    for part in ["libHD_spec", "Nobody", "serial number S-7", "driver 2.1", "library 3.4.0"] {
        assert!(seen.about.contains(part), "{}", seen.about);
    }
    let log = stub.log();
    assert!(!log.iter().any(|line| line.contains("enable") || line.contains("start")), "{log:?}");
    assert!(log.last().unwrap().starts_with("close"), "{log:?}");

    let stub = StubHd::new("spec_bare", "bare");
    let expected = DeviceSpec {
        model: "OpenHaptics",
        friction_n: 0.0,
        senses_orientation: false,
        has_own_scheduler: true,
        ..DeviceSpec::OMNI
    };
    assert_eq!(look(Some(stub.path()), None).unwrap().spec, expected);
}

#[track_caller]
fn refused(script: &str, name: Option<&str>, expected: &[&str]) {
    let stub = StubHd::new(&format!("refused_{}", script.len()), script);
    let error = open(Some(stub.path()), name).err().unwrap();
    let said = error.to_string();
    for part in expected.iter().copied().chain([stub.path().to_str().unwrap()]) {
        assert!(said.contains(part), "'{part}' is not in: {said}");
    }
    assert!(matches!(error, NoOpenHaptics::NoDevice { .. }));
}

#[test]
fn a_library_or_function_or_device_that_is_missing_is_named() {
    let file = Path::new("/nowhere/libHD.so");
    let said = open(Some(file), None).err().unwrap().to_string();
    for part in ["/nowhere/libHD.so (", "HAPTICBILLARD_LIBHD", "install OpenHaptics"] {
        assert!(said.contains(part), "{said}");
    }
    let error = open(Some(lacking_one()), None).err().unwrap();
    assert!(
        matches!(&error, NoOpenHaptics::NoFunction { function: "hdUnschedule", .. }),
        "{error}"
    );
    let said = error.to_string();
    assert!(
        said.contains(lacking_one().to_str().unwrap()) && said.contains("hdUnschedule"),
        "{said}"
    );
    refused(
        "no_init",
        None,
        &[
            "the default device: HD_COMM_ERROR (0x302), \"Default PHANToM\": HD_COMM_ERROR (0x302)",
            "\"Default Device\"",
            "cable and power",
            if cfg!(target_os = "linux") { "/dev/" } else { "plugged in" },
        ],
    );
    refused("only=Left", Some("Right"), &["(\"Right\": HD_DEVICE_FAULT (0x300))"]);
}

#[test]
fn every_usual_name_is_tried_and_a_given_one_alone() {
    let stub = StubHd::new("names", "only=Default PHANToM");
    drop(open(Some(stub.path()), None).unwrap());
    assert_eq!(stub.log()[..2], ["init ''", "init 'Default PHANToM'"]);
    let stub = StubHd::new("name", "only=Left");
    drop(open(Some(stub.path()), Some("Left")).unwrap());
    assert_eq!(stub.log(), ["init 'Left'", "close, last force 0 0 0"]);
}

#[test]
fn a_device_that_is_in_use_is_not_opened_twice() {
    let stub = StubHd::new("twice", "");
    let first = open(Some(stub.path()), None).unwrap();
    let said = open(Some(stub.path()), None).err().unwrap().to_string();
    assert!(said.contains("HD_DEVICE_ALREADY_INITIATED (0x301)"), "{said}");
    assert!(said.contains("another program has the device"), "{said}");
    drop(first);
    drop(open(Some(stub.path()), None).unwrap());
}

#[test]
fn a_loop_that_does_not_start_says_what_was_refused_and_closes_the_device() {
    for (script, what) in [
        ("no_force", "does not start force output (HD_FORCE_ERROR (0x204))"),
        ("no_callback", "does not start a callback (HD_SCHEDULER_FULL (0x501))"),
        ("no_start", "does not start the scheduler (HD_TIMER_ERROR (0x304))"),
        ("mute", "does not call"),
        ("reset=0", "could not calibrate the device (HD_CALIBRATION_NEEDS_MANUAL_INPUT (0x5002))"),
    ] {
        let stub = StubHd::new(script, script);
        let opened = open(Some(stub.path()), None).unwrap();
        let error = Seat::start(plan(opened)).err().unwrap();
        assert!(matches!(error, NoServo::Device(_)), "{error}");
        assert!(error.to_string().contains(what), "{error}");
        let log = stub.log();
        assert!(log.last().unwrap().starts_with("close, last force 0 0 0"), "{log:?}");
        assert!(!stub.pushes());
    }
}

#[test]
fn a_refused_rate_is_told_and_the_real_one_is_used() {
    let stub = StubHd::new("rate", "rate=500");
    let opened = open(Some(stub.path()), None).unwrap();
    assert_eq!(opened.device.spec().rate_hz, 500.0);
    let Started { seat, .. } = Seat::start(plan(opened)).unwrap();
    let (tell, news) = flume::unbounded();
    let runtime = tokio();
    let keeper = {
        let _inside = runtime.enter();
        keep(seat.clone(), tell)
    };
    let expected = "a rate of 1000 Hz was refused (HD_INVALID_VALUE (0x101)); the servo runs at \
                    500 Hz, with less stiffness";
    let told: Vec<Health> = news.try_iter().collect();
    assert!(
        told.iter().any(|health| matches!(health,
            Health::ActorFailed { reason, .. } if reason == expected)),
        "{told:?}"
    );
    // Half a second of ticks of 2 ms is not a second of missed ones.
    wait_for("250 ticks", || seat.timing().ticks() > 250);
    assert!(seat.timing().missed() < seat.timing().ticks(), "every other tick counts as missed");
    runtime.block_on(keeper.end());

    let stub = StubHd::new("grumble", "grumble");
    let seen = look(Some(stub.path()), None).unwrap();
    assert_eq!(seen.spec.rate_hz, 1000.0);
    assert!(!seen.about.contains("refused"), "{}", seen.about);
}

#[test]
fn a_device_calibrates_before_it_is_pushed() {
    let game = Game::start("inkwell", "inkwell@2000");
    game.wait_for_news("HD_CALIBRATION_NEEDS_MANUAL_INPUT (0x5002): put the stylus into");
    wait_for("ticks", || game.stub.ticks() > 1000);
    assert!(game.stub.ticks() > 2000 || game.stub.force_n() == 0.0);
    game.wait_for_push();
    assert!(game.stub.ticks() > 2000);
    game.end();

    let game = Game::start("reset", "reset=1");
    game.wait_for_push();
    let log = game.end();
    let place = |wanted: &str| log.iter().position(|line| line == wanted);
    assert!(place("calibrate 1").is_some() && place("calibrate 1") < place("start"), "{log:?}");
}

#[test]
fn lost_devices_get_no_force_and_the_player_is_told_which_error_it_was() {
    for (script, name) in [
        ("error=302@600", "HD_COMM_ERROR (0x302): check the device's cable and power"),
        ("error=300@600", "HD_DEVICE_FAULT (0x300): check"),
        ("error=304@600", "HD_TIMER_ERROR (0x304): end other programs"),
        ("frames@600", "HD_FRAME_ERROR (0x402)"),
    ] {
        let game = Game::start(&format!("lost_{}", script.replace('=', "_")), script);
        game.wait_for_news(&format!("no force; the OpenHaptics library says {name}"));
        game.wait_for_nothing();
        assert!(!game.stub.pushes(), "its motors are on");
        // It is not pushed again, but the game's ticks go on.
        let ticks = game.seat.timing().ticks();
        wait_for("further ticks", || game.seat.timing().ticks() > ticks + 500);
        assert_eq!(game.stub.force_n(), 0.0);
        assert!(game.seat.is_running() && game.report().flags.has(SafetyFlags::DISCONNECTED));
        game.end();
    }
}

#[test]
fn warm_motors_rest_and_are_pushed_again() {
    let game = Game::start("warm", "warm@1500");
    game.wait_for_push();
    game.wait_for_news("HD_WARM_MOTORS (0x200): its motors are warm");
    game.wait_for_nothing();
    assert!(!game.stub.pushes(), "its motors are on");
    let (warm, ticks) = (game.stub.ticks(), game.seat.timing().ticks());
    game.wait_for_well();
    // They are warm for 1500 ticks.
    assert!(game.stub.ticks() >= 3000, "from {warm} to {}", game.stub.ticks());
    assert!(game.seat.timing().ticks() > ticks + 100, "the ticks stood still");
    game.wait_for_push();
    let log = game.end();
    let switched: Vec<&String> = log.iter().filter(|line| line.contains("0x4000")).collect();
    assert_eq!(switched, ["enable 0x4000", "disable 0x4000", "enable 0x4000", "disable 0x4000"]);
}

#[test]
fn a_stall_of_50_ms_takes_the_force_away_and_it_comes_back_slowly() {
    let game = Game::start("stall", "stall=50@1500");
    game.wait_for_push();
    wait_for("the stall", || game.stub.ticks() > 1400);
    let stalls = game.report().counters.stalls;
    // The ramp after it takes half a second: no look at it can miss it.
    wait_for("the ramp", || {
        let report = game.report();
        report.counters.stalls > stalls && report.force.0.length() < FELT_N
    });
    assert!(game.seat.timing().lateness.most() >= 40_000_000);
    assert!(game.seat.timing().missed() >= 40);
    game.wait_for_push();
    game.end();
}

#[test]
fn late_ticks_halve_the_stiffness() {
    let game = Game::start("late", "slow=6x4@1500");
    game.wait_for_push();
    wait_for("half of the stiffness", || game.report().stiffness_factor <= 0.5);
    assert!(game.report().counters.late >= 3);
    game.end();
}

#[test]
fn a_position_that_is_no_number_is_no_force() {
    let game = Game::start("nan", "nan=300@1500");
    game.wait_for_push();
    game.wait_for_news("no numbers");
    game.wait_for_well();
    assert!(game.report().counters.not_finite >= 1);
    game.wait_for_push();
    game.end();
}

#[test]
fn a_scheduler_that_falls_silent_is_told_and_ended() {
    let game = Game::start("silent", "silent@1000");
    game.wait_for_push();
    game.wait_for_news("has ceased to call: switch the device off");
    assert!(!game.seat.is_running());
    let Game { stub, seat, runtime, control, heart } = game;
    drop((control, runtime, seat, heart));
    // Nobody calls who could set the force to zero; its motors are off, and it is closed.
    wait_for("the end", || stub.log().last().is_some_and(|line| line.starts_with("close")));
    assert!(!stub.pushes());
    let log = stub.log();
    assert!(
        log.iter().position(|line| line == "stop")
            < log.iter().position(|line| line == "unschedule")
    );
}

/// A device behind which another one is watched: it counts allocations, and may panic.
struct Watched {
    device: Box<dyn Device>,
    panics_at: u64,
    turns: u64,
    calls_before: u64,
    calls: Arc<AtomicU64>,
}

impl Watched {
    fn before(opened: Opened, panics_at: u64) -> (Opened, Arc<AtomicU64>) {
        let calls = Arc::new(AtomicU64::new(0));
        let Opened { device, scheduler, explains, .. } = opened;
        let watched =
            Watched { device, panics_at, turns: 0, calls_before: 0, calls: calls.clone() };
        (Opened { scheduler, explains, ..Opened::new(watched) }, calls)
    }
}

impl Device for Watched {
    fn spec(&self) -> DeviceSpec {
        self.device.spec()
    }

    fn read(&mut self, dt: f64) -> DeviceState {
        self.turns += 1;
        self.calls_before = calls();
        let state = self.device.read(dt);
        if self.turns == self.panics_at {
            // A panic that nobody prints.
            std::panic::resume_unwind(Box::new("a defect"));
        }
        state
    }

    fn write(&mut self, force: Force) {
        self.device.write(force);
        self.calls.fetch_add(calls() - self.calls_before, Ordering::SeqCst);
    }
}

#[test]
fn a_turn_in_the_callback_allocates_nothing() {
    let stub = StubHd::new("allocations", "warm@500,nan=50@600");
    let (opened, calls) = Watched::before(open(Some(stub.path()), None).unwrap(), 0);
    let game = Game::with(stub, opened);
    wait_for("3500 ticks", || game.stub.ticks() > 3500);
    assert_eq!(calls.load(Ordering::SeqCst), 0);
    game.wait_for_push();
    game.end();
}

#[test]
fn a_panic_does_not_unwind_into_the_library_and_leaves_no_force() {
    let stub = StubHd::new("panic", "");
    let (opened, _) = Watched::before(open(Some(stub.path()), None).unwrap(), 1500);
    let game = Game::with(stub, opened);
    game.wait_for_push();
    game.wait_for_news("the servo ended; the device is without force");
    game.wait_for_nothing();
    assert!(!game.seat.is_running());
    let ticks = game.stub.ticks();
    wait_for("the library to go on", || game.stub.ticks() > ticks + 100);
    let log = game.end();
    assert!(log.contains(&"callback done".to_string()), "{log:?}");
}

/// Runs the program with the stub as the vendor's library.
fn program(arguments: &[&str], library: &Path, script: &str, log: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .env("HAPTICBILLARD_LIBHD", library)
        .env("STUB_HD", script)
        .env("STUB_HD_LOG", log)
        .output()
        .unwrap()
}

#[test]
fn devices_shows_what_the_device_says_of_itself_or_why_it_is_not_there() {
    let log = folder("hd_devices").join("log");
    let listed = |library: &Path, script: &str| -> Value {
        let output = program(&["haptic", "devices", "--json"], library, script, &log);
        assert!(output.status.success(), "{output:?}");
        lines(&output.stdout).into_iter().find(|line| line["name"] == "openhaptics").unwrap()
    };
    let there = listed(whole(), "");
    assert_eq!(there["built_in"], true);
    assert_eq!(there["spec"]["model"], "Stub Omni");
    assert!(there["says"].as_str().unwrap().contains("serial number S-7"), "{there}");
    let calls = std::fs::read_to_string(&log).unwrap();
    assert!(!calls.contains("enable") && calls.contains("close"), "{calls}");
    let missing = listed(Path::new("/nowhere/libHD.so"), "");
    assert!(missing["spec"].is_null() && missing["built_in"] == true);
    assert!(missing["says"].as_str().unwrap().contains("/nowhere/libHD.so"), "{missing}");
    let plain = program(&["haptic", "devices"], whole(), "rate=500", &log);
    assert!(text(&plain.stdout).contains("the servo runs at 500 Hz"), "{plain:?}");
}

#[test]
fn check_runs_at_the_vendors_scheduler_and_tells_what_is_wrong() {
    let log = folder("hd_check").join("log");
    let check = ["haptic", "check", "--device", "openhaptics", "--seconds", "1", "--json"];
    let output = program(&check, whole(), "", &log);
    let summary = &lines(&output.stdout)[0]["summary"];
    assert_eq!(summary["device"]["model"], "Stub Omni", "{output:?}");
    assert_eq!(summary["priority"]["outcome"], "vendors");
    assert!(summary["ticks"].as_u64().unwrap() > 100, "{summary}");
    assert_eq!(summary["device"]["troubles"], serde_json::json!([]));
    let calls = std::fs::read_to_string(&log).unwrap();
    assert!(calls.ends_with("close, last force 0 0 0"), "{calls}");

    let output = program(&check, whole(), "error=302@200", &log);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let summary = &lines(&output.stdout)[0]["summary"];
    let trouble = summary["device"]["troubles"][0].as_str().unwrap();
    assert!(trouble.contains("HD_COMM_ERROR (0x302)"), "{summary}");

    let named = ["haptic", "check", "--device", "openhaptics:Left", "--seconds", "0.2"];
    let output = program(&named, whole(), "only=Left,nan=20@50", &log);
    let told = text(&output.stdout);
    assert!(
        told.contains("asked for real-time priority 80: the vendor's scheduler decides"),
        "{told}"
    );
    let output = program(&named, whole(), "only=Right", &log);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(text(&output.stderr).contains("(\"Left\": HD_DEVICE_FAULT (0x300))"), "{output:?}");
    let output = program(&check, Path::new("/nowhere/libHD.so"), "", &log);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(text(&output.stderr).contains("HAPTICBILLARD_LIBHD"), "{output:?}");
}
