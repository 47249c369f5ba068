//! The commands of the program.

use crate::cli::{folder, lines, text};
use crate::stub_hd::whole;
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

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

    // `auto` takes a device that is there, and plays on where it does not open.
    for (script, model) in [("", "Stub Omni"), ("no_init", "PHANTOM Omni")] {
        let auto = ["haptic", "check", "--device", "auto", "--seconds", "0.2", "--json"];
        let output = program(&auto, whole(), script, &log);
        assert_eq!(lines(&output.stdout)[0]["summary"]["device"]["model"], model, "{output:?}");
    }

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
