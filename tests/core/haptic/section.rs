//! `[haptic]` in a scene: what it says, what is wrong in it, and what exists without it.

use hapticbillard::scene::{HapticDevice, PlanKind, Scene};
use hapticbillard::shipped;

fn parse(section: &str) -> Result<Scene, String> {
    let text = format!("[scene]\nname = \"x\"\n[physics]\n{section}");
    Scene::parse("s.toml", &text).map_err(|error| error.to_string())
}

#[test]
fn the_section_says_what_is_asked_for() {
    let haptic = parse("[haptic]\n").unwrap().haptic.unwrap();
    assert_eq!((haptic.device, haptic.core), (HapticDevice::Auto, None));
    let text = "[haptic]\ndevice = \"recorded:s.jsonl\"\ncore = 1\npriority = 80\nspin_us = 50\n";
    let haptic = parse(text).unwrap().haptic.unwrap();
    assert_eq!(haptic.device, HapticDevice::Recorded("s.jsonl".into()));
    assert_eq!((haptic.core, haptic.priority, haptic.spin_us), (Some(1), Some(80), Some(50)));
    assert!(
        !haptic.overlay && parse("[haptic]\noverlay = true\n").unwrap().haptic.unwrap().overlay
    );
    let text = "[haptic]\nscale = 1.5\nstroke_gain = 4.0\n";
    let haptic = parse(text).unwrap().haptic.unwrap();
    assert_eq!((haptic.scale, haptic.stroke_gain), (Some(1.5), Some(4.0)));
    for name in [
        "auto",
        "simulated",
        "mouse",
        "openhaptics",
        "openhaptics:Default PHANToM",
        "haply",
        "haply:192.168.0.7:10001",
        "none",
        "recorded:s.jsonl",
    ] {
        let scene = parse(&format!("[haptic]\ndevice = \"{name}\"\n")).unwrap();
        let device = scene.haptic.unwrap().device;
        assert_eq!(device.name(), name);
        assert_eq!(HapticDevice::named(name), Some(device));
    }
    for name in ["", ":", "phantom", "mouse:", "mouse:x", "openhaptics:", "recorded:", "haply:"] {
        assert_eq!(HapticDevice::named(name), None, "{name}");
    }
}

#[test]
fn what_is_wrong_in_it_is_said_in_one_exact_line() {
    #[track_caller]
    fn check(section: &str, expected: &str) {
        assert_eq!(parse(section).unwrap_err(), format!("s.toml:5: haptic.{expected}"));
    }
    check(
        "[haptic]\ndevice = \"phantom\"\n",
        "device = \"phantom\": this build knows \"auto\", \"simulated\", \"mouse\", \
         \"openhaptics\", \"haply\", \"none\"; write for example device = \"auto\"",
    );
    check(
        "[haptic]\ndevice = \"recorded:\"\n",
        "device = \"recorded:\": names no recording; write for example device = \
         \"recorded:stylus.jsonl\"",
    );
    check(
        "[haptic]\ndevice = \"openhaptics:\"\n",
        "device = \"openhaptics:\": names no device; write device = \"openhaptics\" for the only \
         one",
    );
    for address in ["", "localhost", ":10001", "localhost:0", "localhost:65536"] {
        check(
            &format!("[haptic]\ndevice = \"haply:{address}\"\n"),
            &format!(
                "device = \"haply:{address}\": names no HOST:PORT; write for example device = \
                 \"haply:localhost:10001\""
            ),
        );
    }
    check(
        "[haptic]\npriority = 0\n",
        "priority = 0: expected a whole number from 1 to 99; write for example priority = 1",
    );
    check(
        "[haptic]\nstroke_gain = 0.5\n",
        "stroke_gain = 0.5: expected a number from 1 to 20 (along the shaft); write for example \
         stroke_gain = 2.75",
    );
    check(
        "[haptic]\nforce = 9\n",
        "force = 9: haptic has the keys device, core, priority, spin_us, scale, stroke_gain, \
         overlay; remove this key",
    );
}

#[test]
fn only_a_scene_with_the_section_speaks_of_a_device() {
    for (name, text) in shipped::SCENES {
        let scene = Scene::parse(name, text).unwrap();
        let plan = scene.plan();
        let line = plan.iter().find(|line| line.name == "haptic").unwrap();
        let expected = scene.haptic.is_none();
        assert_eq!(line.kind == PlanKind::LeftOut, expected, "{name}");
        assert_eq!(line.detail == "the scene has no [haptic]", expected, "{name}");
        assert_eq!(expected, *name != "haptic_touch");
    }
}
