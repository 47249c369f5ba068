//! The loop, and every fault in it.

use super::{FELT_N, Game};
use crate::counting::calls;
use crate::servo::wait_for;
use crate::stub_hd::StubHd;
use glam::DVec3;
use hapticbillard::haptic::{Buttons, Device, DeviceSpec, DeviceState, Force, SafetyFlags};
use hapticbillard_actors::haptic::openhaptics::open;
use hapticbillard_actors::haptic::{Grant, Opened};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

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
