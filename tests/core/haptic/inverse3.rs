//! The messages of a Haply service, old and new, whole and broken.

use glam::{DQuat, DVec3};
use hapticbillard::haptic::{
    Buttons, DeviceState, DeviceStatus, Force, Format, Inverse3, Inverse3Trouble,
};
use serde_json::Value;

/// The first message of a service 3.1.
pub const OLD: &str = r#"{"session_id":176,"inverse3":[{"device_id":"04C3","config":{
"type":"inverse3","device_info":{"major_version":7,"id":"04C3","device_type":4},"port":"COM15",
"gravity_compensation":{"enabled":true,"scaling_factor":0.75},"handedness":"right",
"coordinate_origin":"device_base","basis":{"permutation":"XYZ"}},
"state":{"angular_position":{"a0":-89.6,"a1":222.8,"a2":-22.7},
"body_orientation":{"x":0.0,"y":0.7071068,"z":0.0,"w":0.7071068},
"cursor_position":{"x":0.02,"y":-0.13,"z":0.22},
"cursor_velocity":{"x":0.1,"y":0.2,"z":0.3},"mode":"idle"},
"status":{"calibrated":true,"in_use":false,"power_supply":true,"ready":true,"started":true}}],
"verse_grip":[],"wireless_verse_grip":[]}"#;

/// The first message of a service 3.5.
pub const NEW: &str = r#"{"session_id":7,"inverse3":[{"device_id":"049D","config":{
"type":"inverse3","port":"COM12","handedness":"right","preset":"defaults",
"basis":{"permutation":"XYZ"},"mount":{"position":{"x":0,"y":0,"z":0}},
"filters":{"force_gate":{"gain":0.3},"damping":{"scalar":0.0}}},
"state":{"cursor_position":{"x":0.0,"y":-0.12,"z":0.15},
"cursor_velocity":{"x":0.0,"y":0.0,"z":0.0},"body_orientation":{"w":1,"x":0,"y":0,"z":0},
"current_cursor_force":{"x":0,"y":0,"z":0},"control_mode":"idle"},
"status":{"calibrated":true,"in_use":false,"power_supply":true,"ready":true,"started":true}}],
"wireless_verse_grip":[{"device_id":"1102","state":{"orientation":{"w":1,"x":0,"y":0,"z":0},
"buttons":{"a":false,"b":false,"c":false},"hall":16,"battery_level":0.6},
"status":{"ready":true,"connected":true,"awake":true}}]}"#;

/// A later message about the arm of [`NEW`].
fn later(state: &str, rest: &str) -> String {
    format!(r#"{{"inverse3":[{{"device_id":"049D","state":{{{state}}}}}]{rest}}}"#)
}

const PLACE: &str = r#""cursor_position":{"x":0.01,"y":0.02,"z":0.03}"#;

fn greeted(text: &str) -> Inverse3 {
    Inverse3::greeted(text).unwrap()
}

#[track_caller]
fn hear(arm: &mut Inverse3, text: &str) -> DeviceState {
    arm.hear(text, 0.001).unwrap()
}

#[test]
fn the_first_message_tells_the_format() {
    assert_eq!(greeted(OLD).format(), Format::Values);
    assert_eq!(greeted(NEW).format(), Format::Vector);
    assert_eq!((greeted(OLD).name(), greeted(NEW).name()), ("04C3", "049D"));
    assert!(!greeted(OLD).spec().senses_orientation && greeted(NEW).spec().senses_orientation);
}

#[test]
fn an_older_service_counts_from_the_base_unless_it_says_otherwise() {
    // Haply: 20 mm to the right, 30 mm nearer than the middle, 40 mm above it.
    let state = hear(&mut greeted(OLD), OLD);
    assert!((state.position - DVec3::new(0.02, 0.04, 0.03)).length() < 1e-12, "{state:?}");
    assert_eq!(state.velocity, DVec3::new(0.1, 0.3, -0.2));
    let centred = OLD.replace("device_base", "workspace_center");
    let state = hear(&mut greeted(&centred), OLD);
    assert_eq!(state.position, DVec3::new(0.02, 0.22, 0.13));
    // A newer one is asked to put the origin into the middle.
    let state = hear(&mut greeted(NEW), &later(PLACE, ""));
    assert_eq!(state.position, DVec3::new(0.01, 0.03, -0.02));
}

#[test]
fn a_force_goes_out_along_the_axis_that_it_came_in_along() {
    for (text, key) in [(OLD, "values"), (NEW, "vector")] {
        let arm = greeted(text);
        let mut out = String::new();
        arm.push(Force(DVec3::new(1.0, 2.0, 3.0)), &mut out);
        let sent: Value = serde_json::from_str(&out).unwrap();
        let device = &sent["inverse3"][0];
        assert_eq!(device["device_id"], arm.name());
        let vector = &device["commands"]["set_cursor_force"][key];
        // Right, away from the user, up.
        let numbers = ["x", "y", "z"].map(|axis| vector[axis].as_f64().unwrap());
        assert_eq!(numbers, [1.0, -3.0, 2.0]);
        for nothing in [DVec3::NAN, DVec3::INFINITY] {
            arm.push(Force(nothing), &mut out);
            let sent: Value = serde_json::from_str(&out).unwrap();
            assert_eq!(sent["inverse3"][0]["commands"]["set_cursor_force"][key]["y"], 0.0);
        }
    }
}

#[test]
fn only_a_new_service_is_asked_for_a_session_and_its_first_force_is_none() {
    let mut out = String::new();
    greeted(NEW).greeting(&mut out);
    let sent: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(sent["session"]["configure"]["profile"]["name"], "hapticbillard");
    assert_eq!(sent["session"]["configure"]["basis"]["permutation"], "XYZ");
    assert_eq!(sent["inverse3"][0]["configure"]["preset"]["preset"], "arm_front_centered");
    assert_eq!(sent["inverse3"][0]["commands"]["set_cursor_force"]["vector"]["x"], 0);
    greeted(OLD).greeting(&mut out);
    let sent: Value = serde_json::from_str(&out).unwrap();
    assert!(sent.get("session").is_none());
    assert_eq!(sent["inverse3"][0]["commands"]["set_cursor_force"]["values"]["x"], 0.0);
}

#[test]
fn a_name_in_quotes_stays_one() {
    let mut out = String::new();
    greeted(&OLD.replace("\"04C3\"", r#""0\"4\u0001""#)).push(Force::ZERO, &mut out);
    let sent: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(sent["inverse3"][0]["device_id"], "0\"4\u{1}");
}

#[test]
fn the_grip_points_and_strikes_and_without_one_the_body_does() {
    let mut arm = greeted(NEW);
    // A quarter to the left about Haply's up.
    let turn = r#""orientation":{"x":0,"y":0,"z":0.70710678,"w":0.70710678}"#;
    let grip = |rest: &str, status: &str| {
        later(PLACE, &format!(r#","wireless_verse_grip":[{{"state":{{{turn}{rest}}}{status}}}]"#))
    };
    let state = hear(&mut arm, &grip(r#","buttons":{"a":true,"b":false,"c":true}"#, ""));
    assert!((state.pointing() - DVec3::NEG_X).length() < 1e-6, "{state:?}");
    assert_eq!(state.buttons, Buttons::FRONT);
    let state = hear(&mut arm, &grip(r#","buttons":{"b":true}"#, ""));
    assert_eq!(state.buttons, Buttons::REAR);
    // Gone: its buttons are let go, and the body's direction counts.
    let body = r#","body_orientation":{"x":0,"y":0,"z":0,"w":1}"#;
    let gone = r#","status":{"connected":false}"#;
    let text = grip(r#","buttons":{"a":true}"#, gone).replace(PLACE, &format!("{PLACE}{body}"));
    let state = hear(&mut arm, &text);
    assert_eq!((state.pointing(), state.buttons), (DVec3::NEG_Z, Buttons::default()));
    // One with a cable has one button.
    let wired = later(PLACE, r#","verse_grip":[{"state":{"button":true}}]"#);
    assert_eq!(hear(&mut arm, &wired).buttons, Buttons::FRONT);
    // What is no rotation changes nothing.
    let before = hear(&mut arm, &grip("", "")).orientation;
    for broken in [r#""w":7.0"#, r#""w":null"#, r#""v":0"#] {
        let text = grip("", "").replace(r#""w":0.70710678"#, broken);
        assert_eq!(hear(&mut arm, &text).orientation, before);
    }
    // The body of this one lies on its side, and points away from the user none the less.
    let state = hear(&mut greeted(OLD), OLD);
    assert!((state.pointing() - DVec3::NEG_Z).length() < 1e-6, "{state:?}");
    assert!(state.orientation.angle_between(DQuat::IDENTITY) > 1.5);
}

#[test]
fn a_speed_that_is_not_said_is_computed() {
    let mut arm = greeted(NEW);
    assert_eq!(hear(&mut arm, &later(PLACE, "")).velocity, DVec3::ZERO);
    let moved = later(r#""cursor_position":{"x":0.01,"y":0.02,"z":0.031}"#, "");
    let state = arm.hear(&moved, 0.002).unwrap();
    assert!((state.velocity - DVec3::Y * 0.5).length() < 1e-9, "{state:?}");
}

#[test]
fn what_is_wrong_with_the_arm_is_said_and_passes() {
    let mut arm = greeted(NEW);
    let status = |status: &str| {
        format!(
            r#"{{"inverse3":[{{"device_id":"049D","state":{{{PLACE}}},"status":{{{status}}}}}]}}"#
        )
    };
    let mut check = |text: &str, expected: DeviceStatus, says: &str| {
        assert_eq!(hear(&mut arm, text).status, expected, "{says}");
        let trouble = arm.trouble().map(|trouble| trouble.to_string()).unwrap_or_default();
        assert!(trouble.contains(says) && trouble.is_empty() == says.is_empty(), "{trouble}");
    };
    check(&later(PLACE, ""), DeviceStatus::Ready, "");
    check(&status(r#""power_supply":false"#), DeviceStatus::Warm, "plug in its power supply");
    // What is not said has not changed.
    check(&status(r#""calibrated":true"#), DeviceStatus::Warm, "have no power");
    check(&status(r#""power_supply":true"#), DeviceStatus::Ready, "");
    check(&status(r#""calibrated":false"#), DeviceStatus::Lost, "put its grip on the inkwell");
    check(&status(r#""calibrated":true,"ready":false"#), DeviceStatus::Warm, "is not ready");
    check(&status(r#""ready":true"#), DeviceStatus::Ready, "");
    check(r#"{"inverse3":[]}"#, DeviceStatus::Lost, "049D is gone");
    check(r#"{"inverse3":[{"device_id":"0000"}]}"#, DeviceStatus::Lost, "049D is gone");
    check(&later(PLACE, ""), DeviceStatus::Ready, "");
}

#[test]
fn an_arm_that_cannot_be_used_is_refused_with_what_to_do() {
    #[track_caller]
    fn check(text: &str, says: &str) {
        let error = Inverse3::greeted(text).unwrap_err().to_string();
        assert!(error.contains(says) && !error.contains('\n'), "{error}");
    }
    check("{}", "its service sees no Inverse3; plug it in");
    check(r#"{"inverse3":null}"#, "sees no Inverse3");
    check(r#"{"inverse3":{"049D":{}}}"#, "port 10001");
    check("hello", "not understood (expected value at line 1 column 1)");
    check(&OLD[..200], "not understood (EOF");
    check(&NEW.replace("\"inverse3\",", "\"minverse\","), "049D is a Minverse");
    check(&OLD.replace("XYZ", "XZY"), "set the basis to XYZ");
}

#[test]
fn half_messages_change_nothing_and_numbers_that_are_none_reach_the_servo_as_such() {
    let mut arm = greeted(NEW);
    let before = hear(&mut arm, &later(PLACE, ""));
    for half in ["", "{\"inverse3\":[{\"device", "1e999", "{\"inverse3\":[{\"state\":1}]}"] {
        let error = arm.hear(half, 0.001).unwrap_err();
        assert!(matches!(error, Inverse3Trouble::NotUnderstood(_)), "{error:?}");
    }
    let nowhere = arm.hear(&later("", ""), 0.001).unwrap_err();
    assert_eq!(nowhere, Inverse3Trouble::NoPlace("049D".into()));
    assert_eq!(hear(&mut arm, r#"{"inverse3":[]}"#).position, before.position);
    for none in [r#""z":null"#, r#""w":1"#] {
        let state = hear(&mut arm, &later(PLACE, "").replace(r#""z":0.03"#, none));
        assert!(!state.is_finite() && state.status == DeviceStatus::Ready);
    }
    assert!(hear(&mut arm, &later(PLACE, "")).is_finite());
}
