//! Messages of a Haply service and recordings of devices, spoiled. Whatever stands in them, they
//! are taken or refused in one line, and what is taken can be felt without harm.

use super::generator::{cases, generator, seed, spoiled};
use hapticbillard::haptic::{
    Device, DeviceRecording, DeviceSpec, Force, HapticScene, INVERSE3, Inverse3, RecordedDevice,
    RecordingWriter, Servo, ServoSettings,
};
use std::sync::Arc;

const GREETING: &str = r#"{"session_id":7,
"inverse3":[{"device_id":"049D",
"config":{"type":"inverse3","preset":"defaults","coordinate_origin":"device_base",
"basis":{"permutation":"XYZ"}},
"state":{"cursor_position":{"x":0.01,"y":-0.12,"z":0.15},
"cursor_velocity":{"x":0.0,"y":0.25,"z":0.0},
"body_orientation":{"w":1,"x":0,"y":0,"z":0}},
"status":{"calibrated":true,"power_supply":true,"ready":true}}],
"wireless_verse_grip":[{"state":{"orientation":{"w":1,"x":0,"y":0,"z":0},
"buttons":{"a":false,"b":true}},"status":{"connected":true}}]}
"#;

const MESSAGE_WORDS: [&str; 8] = [
    "null",
    "\"inverse3\":null,",
    "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    "1e400",
    "\"x\":1,\"x\":2,",
    "\\ud800",
    "{\"device_id\":\"049D\"},",
    "\"power_supply\":false,",
];

/// What follows the first line of a recording.
const READINGS: &str = concat!(
    r#"{"dt":0.001,"position":[0,0,0],"velocity":[0,0,0],"orientation":[0,0,0,1],"#,
    r#""buttons":0,"status":"ready"}
{"position":[0,0,-0.0001],"velocity":[0,0,-0.1]}
{"buttons":1}
{"status":"lost"}
{"status":"ready","position":[0,null,1e300]}
{"dt":0.004,"orientation":[0,0.6,0,0.8]}
"#
);

const RECORDING_WORDS: [&str; 8] = [
    "{}\n",
    "{\"dt\":1e308}\n",
    "{\"position\":[1,2]}\n",
    "{\"buttons\":256}\n",
    "{\"position\":[null,null,null]}\n",
    "\"dt\":0,",
    "\\ud800",
    "null",
];

#[track_caller]
fn check_line(line: &str, place: &str) {
    assert!(!line.contains(char::is_control), "{place}: {line:?}");
    assert!(!line.is_empty() && line.len() < 1000, "{place}: {line:?}");
}

#[test]
fn spoiled_messages_of_a_service_are_read_or_refused_in_one_line() {
    let (mut greeted, mut heard, mut refused) = (0, 0, 0);
    for case in 0..cases(5_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        let mut servo = Servo::new(ServoSettings::of(&INVERSE3));
        let scene = HapticScene { live: true, ..HapticScene::default() };
        let mut out = String::new();
        match Inverse3::greeted(&spoiled(GREETING, &MESSAGE_WORDS, &mut random)) {
            Ok(arm) => {
                greeted += 1;
                arm.greeting(&mut out);
                assert!(serde_json::from_str::<serde_json::Value>(&out).is_ok(), "{place}: {out}");
            }
            Err(trouble) => check_line(&trouble.to_string(), &place),
        }
        let mut arm = Inverse3::greeted(GREETING).unwrap();
        for _ in 0..4 {
            match arm.hear(&spoiled(GREETING, &MESSAGE_WORDS, &mut random), 0.001) {
                Ok(state) => {
                    heard += 1;
                    let force = servo.tick(&state, &scene, 0.001);
                    assert!(force.0.length() <= INVERSE3.force_max_n, "{place}: {force:?}");
                    arm.push(Force(state.position), &mut out);
                    let sent = serde_json::from_str::<serde_json::Value>(&out);
                    assert!(sent.is_ok(), "{place}: {out}");
                }
                Err(trouble) => {
                    refused += 1;
                    check_line(&trouble.to_string(), &place);
                }
            }
        }
    }
    // The canary: a generator that only makes right texts, or only wrong ones, tests nothing.
    if cases(5_000) >= 1000 {
        assert!(greeted > 500 && heard > 1000 && refused > 1000, "{greeted} {heard} {refused}");
    }
}

#[test]
fn spoiled_recordings_of_devices_are_played_or_refused_in_one_line() {
    let text = format!("{}\n{READINGS}", RecordingWriter::head(&DeviceSpec::OMNI));
    let (mut played, mut refused) = (0, 0);
    for case in 0..cases(5_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        match DeviceRecording::parse(&spoiled(&text, &RECORDING_WORDS, &mut random)) {
            Ok(recording) => {
                played += 1;
                let mut servo = Servo::new(ServoSettings::of(&recording.spec));
                let scene = HapticScene { live: true, ..HapticScene::default() };
                let most_n = recording.spec.force_max_n;
                let mut device = RecordedDevice::new(Arc::new(recording));
                for _ in 0..20 {
                    let force = servo.tick(&device.read(0.001), &scene, 0.001);
                    assert!(force.0.length() <= most_n, "{place}: {force:?}");
                    device.write(force);
                }
            }
            Err(error) => {
                refused += 1;
                let said = error.to_string();
                check_line(&said, &place);
                assert!(said.starts_with("line "), "{place}: {said}");
            }
        }
    }
    if cases(5_000) >= 1000 {
        assert!(played > 300 && refused > 500, "{played} {refused}");
    }
}
