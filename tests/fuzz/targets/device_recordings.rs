use crate::bytes::{check_line, text};
use hapticbillard::haptic::{
    Device, DeviceRecording, HapticScene, RecordedDevice, RecordingWriter, Servo, ServoSettings,
};
use std::sync::Arc;

/// So much of a recording is felt [readings].
const FELT: usize = 50;

pub fn run(data: &[u8]) {
    let recording = match DeviceRecording::parse(&text(data)) {
        Ok(recording) => recording,
        Err(error) => {
            let said = error.to_string();
            check_line(&said);
            return assert!(said.starts_with(&format!("line {}: ", error.line)), "{said}");
        }
    };
    // Written again it says the same, number for number.
    let written = written(&recording);
    let again = DeviceRecording::parse(&written).expect("what was written is read");
    assert_eq!(written, self::written(&again));
    assert_eq!(recording.readings.len(), again.readings.len());
    feel(recording);
}

fn written(recording: &DeviceRecording) -> String {
    let mut writer = RecordingWriter::default();
    let lines = recording.readings.iter().map(|reading| writer.line(reading) + "\n");
    let lines: String = lines.collect();
    RecordingWriter::head(&recording.spec) + "\n" + &lines
}

/// Whatever the device said, no force is larger than the largest that it takes.
fn feel(recording: DeviceRecording) {
    let mut servo = Servo::new(ServoSettings::of(&recording.spec));
    let scene = HapticScene { live: true, ..HapticScene::default() };
    let (most_n, count) = (recording.spec.force_max_n, recording.readings.len().min(FELT));
    let mut device = RecordedDevice::new(Arc::new(recording));
    for _ in 0..count + 2 {
        let force = servo.tick(&device.read(0.001), &scene, 0.001);
        assert!(force.0.length() <= most_n, "{force:?}");
        device.write(force);
    }
}
