//! Recordings of devices: written and read, and what a servo makes of them.

use super::rig::{READY_TICKS, TICK_S, balls, stroke};
use glam::{DQuat, DVec3};
use hapticbillard::cue::Aim;
use hapticbillard::events::FactKind;
use hapticbillard::haptic::simulated::HandModel;
use hapticbillard::haptic::{
    Buttons, Device, DeviceRecording, DeviceSpec, DeviceState, DeviceStatus, Reading,
    RecordedDevice, RecordingWriter, Rehearsal,
};
use hapticbillard::table::Table;
use proptest::prelude::*;
use std::sync::Arc;

fn written(readings: &[Reading]) -> String {
    let mut writer = RecordingWriter::default();
    let mut text = RecordingWriter::head(&DeviceSpec::OMNI) + "\n";
    for reading in readings {
        text += &writer.line(reading);
        text.push('\n');
    }
    text
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![8 => -1.0..1.0_f64, 1 => Just(0.0), 1 => Just(-0.0), 1 => any::<f64>()]
}

fn any_reading() -> impl Strategy<Value = Reading> {
    let numbers = prop::array::uniform10(any_number());
    let status =
        prop_oneof![Just(DeviceStatus::Ready), Just(DeviceStatus::Warm), Just(DeviceStatus::Lost)];
    (0.0..0.1_f64, numbers, 0..4_u8, status).prop_map(|(dt, n, buttons, status)| Reading {
        dt,
        state: DeviceState {
            position: DVec3::new(n[0], n[1], n[2]),
            velocity: DVec3::new(n[3], n[4], n[5]),
            orientation: DQuat::from_xyzw(n[6], n[7], n[8], n[9]),
            buttons: Buttons(buttons),
            status,
        },
    })
}

/// What is read back: the same bits; what is no number is one of them.
fn bits(reading: &Reading) -> (Vec<u64>, u8, DeviceStatus) {
    let DeviceState { position, velocity, orientation, buttons, status } = reading.state;
    let numbers = position.to_array().into_iter().chain(velocity.to_array());
    let numbers = numbers.chain(orientation.to_array()).chain([reading.dt]);
    let bits = numbers.map(|x| if x.is_finite() { x } else { f64::NAN }.to_bits());
    (bits.collect(), buttons.0, status)
}

proptest! {
    #[test]
    fn what_is_written_is_read_with_the_same_bits(
        readings in prop::collection::vec(any_reading(), 1..20),
    ) {
        let read = DeviceRecording::parse(&written(&readings)).unwrap();
        prop_assert_eq!(read.readings.len(), readings.len());
        for (read, reading) in read.readings.iter().zip(&readings) {
            prop_assert_eq!(bits(read), bits(reading));
        }
        let spec = DeviceSpec { model: "recorded device", ..DeviceSpec::OMNI };
        prop_assert_eq!(read.spec, spec);
    }
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let first = concat!(
        r#"{"dt":0.001,"position":[0,0,0],"velocity":[0,0,0],"#,
        r#""orientation":[0,0,0,1],"buttons":0,"status":"ready"}"#
    );
    let head = RecordingWriter::head(&DeviceSpec::OMNI);
    #[track_caller]
    fn check(text: String, expected: &str) {
        let error = DeviceRecording::parse(&text).unwrap_err().to_string();
        assert_eq!(error, format!("{expected}; record the device anew"));
    }
    let empty = "the recording ends before the first reading";
    check(String::new(), &format!("line 1: {empty}"));
    check(head.clone(), &format!("line 2: {empty}"));
    let kind = "line 1: no recording of a device: the first line must begin \
                {\"format\":\"hapticbillard device\"";
    check("{\"format\":\"hapticbillard game\",\"version\":1}".into(), kind);
    check("tick,time_s".into(), kind);
    check(
        head.replace("\"version\":1", "\"version\":2"),
        "line 1: format version 2; this program reads version 1",
    );
    check(
        head.replace("\"rate_hz\":1000.0", "\"rate_hz\":0.0"),
        "line 1: rate_hz = 0: expected a number from 100 to 10000",
    );
    check(
        head.replace("\"mass_kg\":0.045", "\"mass_kg\":-1"),
        "line 1: mass_kg = -1: expected a number above 0",
    );
    check(
        format!("{head}\n{}", first.replace("\"buttons\":0,", "")),
        "line 2: the first reading leaves out buttons",
    );
    check(
        format!("{head}\n{first}\n{{\"dt\":-1}}"),
        "line 3: dt = -1: expected a number from 0 to 3600",
    );
    check(
        format!("{head}\n{first}\n{{}}\n{{\"status\":\"hot\"}}"),
        "line 4: unknown variant `hot`, expected one of `ready`, `warm`, `lost`",
    );
    check(format!("{head}\n{first}\n{}", "x".repeat(5000)), "line 3: longer than 4096 bytes");
    let parsed = DeviceRecording::parse(&format!("{head}\n{first}\n{{}}\n")).unwrap();
    assert_eq!(parsed.readings[0], parsed.readings[1]);
}

/// A recorded stroke, what it did to the hand, and what it did at the table.
fn struck() -> (String, Vec<[u64; 3]>, Vec<String>) {
    let table = Table::preset("pool-9ft").unwrap();
    let aim = Aim { elevation_rad: 0.06, ..Aim::default() };
    let script = stroke(1.0, 0.0);
    let ticks = (script.duration_s() / TICK_S) as u64;
    assert!(ticks > READY_TICKS);
    let spec = DeviceSpec::OMNI;
    let mut rig =
        Rehearsal::new(&table, balls(&table), spec, HandModel::GRIP, script, &aim).unwrap();
    let (mut readings, mut forces) = (Vec::new(), Vec::new());
    for _ in 0..ticks {
        let report = rig.tick().unwrap();
        readings.push(Reading { dt: report.sample.dt, state: report.sample.device });
        forces.push(report.force.0.to_array().map(f64::to_bits));
    }
    let facts = rig.facts.iter().map(|fact| format!("{fact:?}")).collect();
    assert!(rig.facts.iter().any(|fact| matches!(fact.kind, FactKind::CueBallStruck { .. })));
    (written(&readings), forces, facts)
}

#[test]
fn a_recorded_stroke_gives_the_same_forces_and_the_same_shot_bit_by_bit() {
    let (text, forces, facts) = struck();
    let recording = Arc::new(DeviceRecording::parse(&text).unwrap());
    let table = Table::preset("pool-9ft").unwrap();
    let aim = Aim { elevation_rad: 0.06, ..Aim::default() };
    let device = RecordedDevice::new(recording);
    let mut rig = Rehearsal::with(&table, balls(&table), device, &aim).unwrap();
    for (tick, force) in forces.iter().enumerate() {
        let report = rig.tick().unwrap();
        assert_eq!(report.force.0.to_array().map(f64::to_bits), *force, "tick {tick}");
    }
    assert!(forces.iter().any(|force| *force != [0; 3]));
    let replayed: Vec<String> = rig.facts.iter().map(|fact| format!("{fact:?}")).collect();
    assert_eq!(replayed, facts);
}

/// A device that moves on by a millimetre per millisecond; the buttons are down in every 50th.
fn marked() -> RecordedDevice {
    let reading = |k: u32| {
        let state = DeviceState {
            position: DVec3::X * (0.001 * f64::from(k)),
            velocity: DVec3::X,
            buttons: Buttons(u8::from(k % 50 == 49)),
            ..DeviceState::default()
        };
        Reading { dt: 0.001, state }
    };
    let readings = (0..1000).map(reading).collect();
    RecordedDevice::new(Arc::new(DeviceRecording { spec: DeviceSpec::OMNI, readings }))
}

#[test]
fn another_rhythm_gives_the_nearest_reading_and_every_edge() {
    for rhythm_s in [0.0004, 0.0013, 0.007] {
        let mut device = marked();
        let (mut time_s, mut presses, mut held) = (0.0, 0, Buttons::default());
        while time_s < 1.05 {
            let state = device.read(rhythm_s);
            let (pressed, _) = state.buttons.edges(held);
            presses += u32::from(pressed.has(Buttons::FRONT));
            held = state.buttons;
            // A press is a millisecond long; at 7 ms it and its release take a call each.
            let late_m = if rhythm_s > 0.005 { 0.016 } else { 0.0012 };
            let behind_m = f64::min(time_s, 0.999) - state.position.x;
            assert!(behind_m.abs() < late_m, "{time_s}: {behind_m}");
            time_s += rhythm_s;
        }
        assert_eq!(presses, 20, "{rhythm_s}");
    }
}

#[test]
fn at_its_end_a_recording_rests_and_lets_go() {
    let mut device = marked();
    let last = (0..1000).map(|_| device.read(0.001)).last().unwrap();
    assert_eq!((last.buttons, last.velocity), (Buttons::FRONT, DVec3::X));
    let rest = device.read(0.001);
    assert_eq!((rest.velocity, rest.buttons), (DVec3::ZERO, Buttons::default()));
    assert_eq!((rest.position, rest.status), (last.position, DeviceStatus::Ready));
    assert_eq!(device.read(100.0), rest);
}
