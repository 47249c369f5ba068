//! Recordings of devices as files: the tap, what it loses, what is wrong with a file.

use crate::cli::folder;
use crate::counting::calls;
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, SimulatedDevice};
use hapticbillard::haptic::{DeviceSpec, DeviceState, Force};
use hapticbillard::scene::HapticDevice;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{DeviceRecorder, NoDevice, Opened, open};
use std::fs;
use std::path::Path;

fn hand() -> Opened {
    let guide = Guide::Script(HandScript::stroke(1.0, 0.1));
    Opened::new(SimulatedDevice::new(DeviceSpec::OMNI, HandModel::GRIP, guide))
}

/// So many readings of a recorded device that is pushed now and then.
fn readings(opened: &mut Opened, n: u32) -> Vec<DeviceState> {
    let mut states = Vec::with_capacity(n as usize);
    let before = calls();
    for k in 0..n {
        states.push(opened.device.read(0.001));
        opened.device.write(Force(glam::DVec3::X * f64::from(k % 2)));
    }
    assert_eq!(calls() - before, 0, "the servo's side allocates");
    states
}

#[test]
fn what_is_recorded_is_said_again_and_the_servo_does_nothing_for_it() {
    let file = folder("tapped").join("hand.jsonl");
    let (mut opened, recorder) = DeviceRecorder::tap(hand(), file.clone()).unwrap();
    let said = readings(&mut opened, 3000);
    let recorded = recorder.finish().unwrap();
    assert_eq!((recorded.readings, recorded.lost), (3000, 0));
    // Whoever still holds the device is not harmed.
    readings(&mut opened, 10);
    drop(opened);
    let mut again = open(&HapticDevice::Recorded(file.to_str().unwrap().into())).unwrap().unwrap();
    assert_eq!(again.device.spec().rate_hz, 1000.0);
    assert_eq!(readings(&mut again, 3000), said);
}

#[test]
fn a_full_ring_loses_readings_and_no_time() {
    let file = folder("tapped_fast").join("hand.jsonl");
    let (mut opened, recorder) = DeviceRecorder::tap(hand(), file.clone()).unwrap();
    readings(&mut opened, 1);
    let _ = recorder.finish().unwrap();
    // A device at rest, read far faster than a thread can write.
    let rest = open(&HapticDevice::Recorded(file.to_str().unwrap().into())).unwrap().unwrap();
    let (mut opened, recorder) = DeviceRecorder::tap(rest, file.clone()).unwrap();
    let n = 400_000;
    readings(&mut opened, n);
    let recorded = recorder.finish().unwrap();
    assert!(recorded.lost > 0, "this machine writes fast");
    assert_eq!(recorded.readings + recorded.lost, u64::from(n));
    let (mut time_s, mut dt) = (0.0, 0.0);
    for line in fs::read_to_string(&file).unwrap().lines().skip(1) {
        let row: serde_json::Value = serde_json::from_str(line).unwrap();
        // Left out where it is as before.
        dt = row["dt"].as_f64().unwrap_or(dt);
        time_s += dt;
    }
    // What was lost last has no reading after it.
    assert!(time_s <= f64::from(n) * 0.001 + 1e-6, "{time_s}");
    assert!(time_s >= (f64::from(n) - recorded.lost as f64) * 0.001 - 1e-6, "{time_s}");
}

#[test]
fn a_file_that_is_no_recording_is_an_error_that_names_it_and_its_line() {
    #[track_caller]
    fn check(path: &Path, says: &str) {
        let name = path.to_str().unwrap().to_string();
        let error = open(&HapticDevice::Recorded(name.clone())).err().unwrap();
        assert!(matches!(error, NoDevice::Recording { .. }), "{error:?}");
        let told = error.to_string();
        assert!(told.starts_with(&name) && told.contains(says) && !told.contains('\n'), "{told}");
    }
    let folder = folder("no_recordings");
    let file = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    check(&folder.join("none.jsonl"), "cannot read");
    check(&folder, "is not a plain file");
    check(&file("empty.jsonl", b""), "line 1: the recording ends before the first reading");
    check(&file("text.jsonl", b"hello\n"), "line 1: no recording of a device");
    check(&file("long.jsonl", &[b'x'; 100_000]), "line 1: longer than 4096 bytes");
    check(&file("binary.jsonl", &[0xff; 100]), "UTF-8");
}

#[test]
fn a_scene_finds_its_recording_in_its_folder_and_nowhere_else() {
    let folder = folder("scene_with_recording");
    let (mut opened, recorder) =
        DeviceRecorder::tap(hand(), folder.join("hands/one.jsonl")).unwrap();
    readings(&mut opened, 10);
    let _ = recorder.finish().unwrap();
    let stage = |device: &str| {
        let file = folder.join("s.toml");
        let text = format!("[scene]\nname = \"x\"\n[physics]\n[haptic]\ndevice = \"{device}\"\n");
        fs::write(&file, text).unwrap();
        Stage::new(&load_scene(file.to_str().unwrap()).unwrap(), "s").unwrap()
    };
    let plan = stage("recorded:hands/one.jsonl").haptic().unwrap().unwrap();
    assert_eq!(plan.opened.device.spec().model, "recorded device");
    for outside in ["recorded:../one.jsonl", "recorded:/etc/hostname"] {
        let error = stage(outside).haptic().err().unwrap().to_string();
        assert!(error.contains("must lie in the scene's folder or below it"), "{error}");
    }
}
