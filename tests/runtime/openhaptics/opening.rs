//! What is found and said before anything is pushed.

use super::{Game, plan};
use crate::servo::{tokio, wait_for};
use crate::stub_hd::{StubHd, lacking_one};
use glam::DVec3;
use hapticbillard::events::Health;
use hapticbillard::haptic::DeviceSpec;
use hapticbillard_actors::haptic::openhaptics::{NoOpenHaptics, look, open};
use hapticbillard_actors::haptic::{NoServo, Seat, Started, keep};
use std::path::Path;

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
    if cfg!(target_os = "linux") {
        assert!(said.contains("No such file or directory"), "{said}");
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
            Health::Refused { asked, reason, remedy, .. }
                if format!("{asked} was refused ({reason}); {remedy}") == expected)),
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
