//! A Haply Inverse3 at a service of our own: both formats, and everything that goes wrong.

use crate::counting::calls;
use crate::mocks::haply_service::{Arm, Fault, HaplyService};
use crate::servo::{Heart, control, tokio, wait_for};
use glam::DVec3;
use hapticbillard::events::Health;
use hapticbillard::haptic::{
    Buttons, DeviceStatus, Effect, EffectSet, Force, Format, INVERSE3, SafetyFlags, stiffness_for,
};
use hapticbillard::scene::HapticDevice;
use hapticbillard_actors::haptic::{
    Asked, Core, Look, NoDevice, Opened, Plan, Seat, Started, allowed, open,
};
use serde_json::json;
use std::net::TcpListener;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What the arm is pushed with [N]: less than what the start ramp waits for.
const PUSH_N: f64 = 0.1;

fn called(service: &HaplyService) -> Opened {
    open(&HapticDevice::Haply(Some(service.address()))).unwrap().unwrap()
}

fn seated(service: &HaplyService) -> Arc<Seat> {
    let push = Effect::Constant { force: DVec3::new(0.0, PUSH_N, 0.0) };
    let plan = Plan {
        opened: called(service),
        asked: Asked { core: Core::Any, lock_memory: false, ..Asked::default() },
        mesh: None,
        effects: EffectSet::of(1, &[push]),
        reach: None,
        lay: None,
        bodies: Vec::new(),
    };
    let Started { seat, .. } = Seat::start(plan).unwrap();
    seat
}

fn wait_for_push(service: &HaplyService) {
    // The observer may have softened it while the hand gave way.
    wait_for("a force", || service.force_n() > 0.3 * PUSH_N);
}

fn wait_for_nothing(service: &HaplyService) {
    wait_for("no force", || service.force_n() == 0.0);
}

#[test]
fn both_formats_are_spoken_and_the_arm_is_felt() {
    for arm in [Arm::OLD, Arm::NEW] {
        let service = HaplyService::start(arm.clone(), Fault::None);
        let mut opened = called(&service);
        let spec = opened.device.spec();
        assert_eq!((spec.model, spec.senses_orientation), (INVERSE3.model, arm.has_grip));
        assert!(0.0 < spec.latency_s && spec.latency_s < 0.2, "{spec:?}");
        let first = service.heard().remove(0);
        let profile = &first["session"]["configure"]["profile"]["name"];
        assert_eq!(profile == "hapticbillard", arm.format == Format::Vector, "{first}");

        let state = opened.device.read(0.001);
        assert!((state.position - DVec3::X * 0.03).length() < 1e-3, "{state:?}");
        assert_eq!(state.status, DeviceStatus::Ready);
        let held = if arm.has_grip { Buttons::FRONT } else { Buttons::default() };
        assert_eq!((state.buttons, state.pointing()), (held, DVec3::NEG_Z));

        // A push up and towards the user moves the hand there.
        let push = DVec3::new(0.0, 1.0, 0.5);
        opened.device.write(Force(push));
        wait_for("the push", || (service.force() - push).length() < 1e-5);
        wait_for("a hand that gives way", || {
            let moved = opened.device.read(0.001).position - state.position;
            moved.y > 5e-4 && moved.z > 2e-4
        });
        drop(opened);
        assert_eq!(service.force_n(), 0.0, "the arm is still pushed");
    }
}

#[test]
fn reading_and_writing_neither_allocate_nor_wait() {
    let service = HaplyService::start(Arm::NEW, Fault::None);
    let mut opened = called(&service);
    let before = calls();
    for _ in 0..100_000 {
        opened.device.read(1e-7);
        opened.device.write(Force(DVec3::X * 0.01));
    }
    assert_eq!(calls() - before, 0);
    // Nor does a service that says nothing hold it up.
    service.fault(Fault::Silent);
    let start = Instant::now();
    for _ in 0..1000 {
        opened.device.read(0.001);
        opened.device.write(Force::ZERO);
    }
    assert!(start.elapsed() < Duration::from_millis(500), "{:?}", start.elapsed());
    assert_eq!(opened.device.read(0.001).status, DeviceStatus::Lost);
    service.fault(Fault::None);
}

fn is_calm(flags: SafetyFlags) -> bool {
    let wrong = [SafetyFlags::DISCONNECTED, SafetyFlags::NOT_FINITE, SafetyFlags::STALE];
    wrong.iter().all(|wrong| !flags.has(*wrong))
}

fn says(news: &Health, told: &str) -> bool {
    matches!(news, Health::ActorFailed { reason, .. } if reason.contains(told))
}

/// Breaks something, and expects what the player is told, no force, and whether it passes.
fn break_and_mend(faults: &[(Fault, &str, bool)]) {
    for (fault, told, passes) in faults {
        let service = HaplyService::start(Arm::NEW, Fault::None);
        let seat = seated(&service);
        let runtime = tokio();
        let control = control(&runtime, &seat);
        let look = || runtime.block_on(control.ask(Look).send()).unwrap();
        let _heart = Heart::of(seat.signs());
        wait_for_push(&service);
        // A busy machine may have been silent for a while before.
        wait_for("calm", || is_calm(look().report.flags));
        service.fault(fault.clone());
        wait_for(told, || look().news.iter().any(|news| says(news, told)));
        let status = look().report.sample.device.status;
        let is_numbers = *fault == Fault::NoNumber;
        assert!(status != DeviceStatus::Ready || is_numbers, "{fault:?}: {status:?}");

        service.fault(Fault::None);
        if *passes {
            wait_for("the news that it is well", || {
                look().news.iter().any(|health| matches!(health, Health::ActorRestarted { .. }))
            });
            wait_for_push(&service);
        } else {
            let calls = service.counts()[0];
            std::thread::sleep(Duration::from_millis(300));
            assert_eq!(look().report.sample.device.status, DeviceStatus::Lost, "{fault:?}");
            assert_eq!(service.counts()[0], calls, "it was called again");
            assert_eq!(look().report.force, Force::ZERO);
        }
        runtime.block_on(control.stop_gracefully()).unwrap();
        runtime.block_on(control.wait_for_shutdown());
        drop(seat);
        if *passes {
            // Its control may hold it for a moment longer.
            wait_for_nothing(&service);
        }
        assert!(service.most_n() < 2.0 * PUSH_N, "{fault:?}: {} N", service.most_n());
    }
}

#[test]
fn an_arm_that_is_not_ready_is_not_pushed_until_it_is() {
    break_and_mend(&[
        (Fault::Status("power_supply"), "plug in its power supply", true),
        (Fault::Status("calibrated"), "is not calibrated", true),
        (Fault::Status("ready"), "look at the Haply Hub", true),
        (Fault::NoArm, "the Inverse3 049D is gone from its service", true),
    ]);
}

#[test]
fn messages_that_say_nothing_take_the_force_away_until_better_ones_come() {
    break_and_mend(&[
        (Fault::NoNumber, "the device says no numbers", true),
        (Fault::Half, "what is not understood (EOF", true),
        (Fault::Says("hello".into()), "what is not understood (expected value", true),
        (
            Fault::Says(json!({ "inverse3": [{ "device_id": "049D" }] }).to_string()),
            "does not say where the Inverse3 049D is",
            true,
        ),
    ]);
}

#[test]
fn a_connection_that_ends_is_not_made_again() {
    break_and_mend(&[
        (Fault::Cut, "is lost", false),
        (Fault::Closed, "start the service, then the game again", false),
    ]);
}

#[test]
fn a_silent_service_is_told_that_no_force_is_meant() {
    let service = HaplyService::start(Arm::NEW, Fault::None);
    let seat = seated(&service);
    let runtime = tokio();
    let control = control(&runtime, &seat);
    let look = || runtime.block_on(control.ask(Look).send()).unwrap();
    let _heart = Heart::of(seat.signs());
    wait_for_push(&service);
    wait_for("calm", || is_calm(look().report.flags));
    service.fault(Fault::Silent);
    let told = "is silent; restart it";
    wait_for(told, || look().news.iter().any(|news| says(news, told)));
    // The first that it takes in again is that nothing is meant.
    service.fault(Fault::None);
    wait_for_push(&service);
    // A silence that goes on ends the talk.
    service.fault(Fault::Silent);
    wait_for("the end of the talk", || {
        seat.why().is_some_and(|why| why.contains("silent for 2 s"))
    });
    service.fault(Fault::None);
    wait_for_nothing(&service);
    assert_eq!(look().report.sample.device.status, DeviceStatus::Lost);
}

#[test]
fn a_slow_service_is_felt_softer() {
    let service = HaplyService::start(Arm::NEW, Fault::None);
    let seat = seated(&service);
    let stiff = |seat: &Seat| stiffness_for(seat.spec(), seat.device_late_s());
    let _heart = Heart::of(seat.signs());
    let _held = seat.hold();
    wait_for("answers", || service.counts()[1] > 1500);
    service.fault(Fault::Late(Duration::from_millis(4)));
    // 4 ms and as much again until the next force.
    wait_for("lateness", || seat.device_late_s() > 0.006);
    let limit = 0.6 * 1.1 / 0.0065;
    assert!(stiff(&seat) < limit, "{} N/m", stiff(&seat));
    assert!(allowed(&seat) <= stiff(&seat), "the control does not know");
    // A service that is slow from the begin stands in the specification.
    drop(_held);
    drop(seat);
    let slow = called(&service).device.spec();
    assert!(slow.latency_s > 0.008 && stiffness_for(&slow, 0.0) < limit, "{slow:?}");
}

#[test]
fn an_arm_that_cannot_be_had_is_an_error_with_what_to_do() {
    #[track_caller]
    fn check(address: &str, says: &[&str]) {
        let error = open(&HapticDevice::Haply(Some(address.into()))).err().unwrap();
        assert!(matches!(error, NoDevice::Haply(_)), "{error:?}");
        let told = error.to_string();
        assert!(says.iter().all(|says| told.contains(says)), "{told}");
        assert!(told.contains(address) && !told.contains('\n'), "{told}");
    }
    // Nobody listens.
    let nobody = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    check(&nobody, &["no Haply Inverse service answers", "refused", "open the Haply Hub"]);
    check("no.such.host.invalid:10001", &["no Haply Inverse service answers"]);
    // Somebody listens and never says a word.
    let mute = TcpListener::bind("127.0.0.1:0").unwrap();
    check(&mute.local_addr().unwrap().to_string(), &["does not answer", "within 2000 ms"]);
    // Somebody listens who speaks another language.
    let other = TcpListener::bind("127.0.0.1:0").unwrap();
    let place = other.local_addr().unwrap().to_string();
    let web = std::thread::spawn(move || {
        use std::io::{Read, Write};
        let (mut stream, _) = other.accept().unwrap();
        let _ = stream.read(&mut [0; 1024]).unwrap();
        stream.write_all(b"HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\n\r\n").unwrap();
    });
    check(&place, &["is no Haply Inverse service", "404", "10001"]);
    web.join().unwrap();
    // A service without an arm, or with one that cannot be used.
    let greeting = |text: &str| Arm { greeting: Some(text.into()), ..Arm::NEW };
    for (arm, fault, says) in [
        (greeting("{}"), Fault::None, "its service sees no Inverse3"),
        (greeting("what?"), Fault::None, "port 10001 of a Haply Inverse service 3.1 or later"),
        (Arm::NEW, Fault::Status("power_supply"), "plug in its power supply"),
        (Arm::NEW, Fault::Status("calibrated"), "is not calibrated"),
        (Arm::NEW, Fault::Half, "not understood"),
        (Arm::NEW, Fault::Cut, "does not answer"),
        (Arm::NEW, Fault::Silent, "silent for 2 s"),
    ] {
        let service = HaplyService::start(arm, fault);
        check(&service.address(), &[says]);
        assert_eq!(service.force_n(), 0.0);
    }
}
