//! Recordings of a device: what it said in every tick, as JSON lines.
//!
//! The first line says what the device is, in the units of [`DeviceSpec`]:
//!
//! ```json
//! {"format":"hapticbillard device","version":1,"device":{"model":"PHANTOM Omni","workspace_m":…}}
//! ```
//!
//! Every other line is a reading: the time since the one before [s], place [m] and velocity [m/s]
//! in the device frame, rotation (x, y, z, w), the mask of the buttons held, and whether it can be
//! felt (`ready`, `warm`, `lost`). What is left out is as in the line before; `null` is a number
//! that the device did not know.
//!
//! ```json
//! {"dt":1e-3,"position":[0,0,0],"velocity":[0,0,0],"orientation":[0,0,0,1],"buttons":0,"status":…}
//! {"position":[0,0,-0.0001],"velocity":[0,0,-0.1]}
//! ```
//!
//! Numbers are written so that reading gives the same bits.

use super::device::{Buttons, DeviceSpec, DeviceState, DeviceStatus};
use crate::one_line::without_place;
use crate::units::Seconds;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

const FORMAT: &str = "hapticbillard device";
const VERSION: u32 = 1;
/// The longest line [bytes]; longer ones are of another kind of file.
const LINE_MAX: usize = 4096;

/// The longest recording [readings]: an hour at 1 kHz.
pub const READINGS_MAX: usize = 3_600_000;

/// What a device said.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Time since the reading before [s].
    pub dt: Seconds,
    /// What it said.
    pub state: DeviceState,
}

/// A recording.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviceRecording {
    /// What the device was. Its model is in the file, but not here.
    pub spec: DeviceSpec,
    /// What it said, in order; at least one reading.
    pub readings: Vec<Reading>,
}

/// What is wrong with a recording.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}; record the device anew")]
pub struct DeviceRecordingError {
    /// Counted from 1; the one after the last if something is missing.
    pub line: usize,
    /// What is wrong.
    pub problem: RecordingProblem,
}

/// See [`DeviceRecordingError`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RecordingProblem {
    /// There is no first line, or nothing after it.
    #[error("the recording ends before the first reading")]
    Empty,
    /// Another kind of file.
    #[error("no recording of a device: the first line must begin {{\"format\":\"{FORMAT}\"")]
    Kind,
    /// A recording of another program.
    #[error("format version {0}; this program reads version {VERSION}")]
    Version(u32),
    /// No such line.
    #[error("{0}")]
    Line(String),
    /// A line that never ends.
    #[error("longer than {LINE_MAX} bytes")]
    Long,
    /// The first reading leaves something out.
    #[error("the first reading leaves out {0}")]
    Missing(&'static str),
    /// A number that cannot be.
    #[error("{key} = {value}: expected {expected}")]
    Number {
        /// Where.
        key: &'static str,
        /// Which.
        value: String,
        /// What is possible.
        expected: &'static str,
    },
    /// More than an hour.
    #[error("more than {READINGS_MAX} readings")]
    TooMany,
}

impl DeviceRecording {
    /// Reads a whole recording.
    ///
    /// # Errors
    /// [`DeviceRecordingError`] at the first line that is wrong.
    pub fn parse(text: &str) -> Result<Self, DeviceRecordingError> {
        let mut reader = RecordingReader::default();
        text.lines().try_for_each(|line| reader.take(line))?;
        reader.finish()
    }
}

/// Reads a recording line by line.
#[derive(Debug, Default)]
pub struct RecordingReader {
    lines: usize,
    spec: Option<DeviceSpec>,
    readings: Vec<Reading>,
}

impl RecordingReader {
    /// Takes the next line.
    ///
    /// # Errors
    /// [`DeviceRecordingError`] if it is wrong; the recording is of no use then.
    pub fn take(&mut self, line: &str) -> Result<(), DeviceRecordingError> {
        self.lines += 1;
        let taken = match (line.len() > LINE_MAX, self.spec) {
            (true, _) => Err(RecordingProblem::Long),
            (false, None) => head(line).map(|spec| self.spec = Some(spec)),
            (false, Some(_)) => self.reading(line),
        };
        taken.map_err(|problem| DeviceRecordingError { line: self.lines, problem })
    }

    /// The recording.
    ///
    /// # Errors
    /// [`RecordingProblem::Empty`].
    pub fn finish(self) -> Result<DeviceRecording, DeviceRecordingError> {
        match self.spec {
            Some(spec) if !self.readings.is_empty() => {
                Ok(DeviceRecording { spec, readings: self.readings })
            }
            _ => {
                Err(DeviceRecordingError { line: self.lines + 1, problem: RecordingProblem::Empty })
            }
        }
    }

    fn reading(&mut self, line: &str) -> Result<(), RecordingProblem> {
        if self.readings.len() == READINGS_MAX {
            return Err(RecordingProblem::TooMany);
        }
        let row: Row = serde_json::from_str(line)
            .map_err(|error| RecordingProblem::Line(without_place(&error)))?;
        let reading = row.after(self.readings.last())?;
        self.readings.push(reading);
        Ok(())
    }
}

/// Writes a recording line by line.
#[derive(Debug, Default)]
pub struct RecordingWriter {
    last: Option<Reading>,
}

impl RecordingWriter {
    /// The first line.
    pub fn head(spec: &DeviceSpec) -> String {
        let head = Head { format: FORMAT.into(), version: VERSION, device: Spec::of(spec) };
        json(&head)
    }

    /// The line of the next reading.
    pub fn line(&mut self, reading: &Reading) -> String {
        let row = Row::of(reading, self.last.as_ref());
        self.last = Some(*reading);
        json(&row)
    }
}

/// What this module writes has string keys and numbers, which JSON can always hold.
fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    format: String,
    version: u32,
    device: Spec,
}

/// Only enough to say what is wrong.
#[derive(Deserialize)]
struct Kind {
    format: String,
    version: u32,
}

fn head(line: &str) -> Result<DeviceSpec, RecordingProblem> {
    let kind: Kind = serde_json::from_str(line).map_err(|_| RecordingProblem::Kind)?;
    if kind.format != FORMAT {
        return Err(RecordingProblem::Kind);
    }
    if kind.version != VERSION {
        return Err(RecordingProblem::Version(kind.version));
    }
    let head: Head = serde_json::from_str(line)
        .map_err(|error| RecordingProblem::Line(without_place(&error)))?;
    head.device.checked()
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Spec {
    model: String,
    workspace_m: [f64; 3],
    force_max_n: f64,
    force_continuous_n: f64,
    stiffness_max_n_m: f64,
    damping_max_ns_m: f64,
    mass_kg: f64,
    damping_ns_m: f64,
    friction_n: f64,
    quantum_m: f64,
    rate_hz: f64,
    latency_s: f64,
    senses_orientation: bool,
}

impl Spec {
    fn of(spec: &DeviceSpec) -> Self {
        Spec {
            model: spec.model.into(),
            workspace_m: spec.workspace_m.to_array(),
            force_max_n: spec.force_max_n,
            force_continuous_n: spec.force_continuous_n,
            stiffness_max_n_m: spec.stiffness_max_n_m,
            damping_max_ns_m: spec.damping_max_ns_m,
            mass_kg: spec.mass_kg,
            damping_ns_m: spec.damping_ns_m,
            friction_n: spec.friction_n,
            quantum_m: spec.quantum_m,
            rate_hz: spec.rate_hz,
            latency_s: spec.latency_s,
            senses_orientation: spec.senses_orientation,
        }
    }

    fn checked(self) -> Result<DeviceSpec, RecordingProblem> {
        let positive = [
            ("workspace_m", self.workspace_m[0]),
            ("workspace_m", self.workspace_m[1]),
            ("workspace_m", self.workspace_m[2]),
            ("force_max_n", self.force_max_n),
            ("force_continuous_n", self.force_continuous_n),
            ("stiffness_max_n_m", self.stiffness_max_n_m),
            ("damping_max_ns_m", self.damping_max_ns_m),
            ("mass_kg", self.mass_kg),
        ];
        let not_negative = [
            ("damping_ns_m", self.damping_ns_m),
            ("friction_n", self.friction_n),
            ("quantum_m", self.quantum_m),
            ("latency_s", self.latency_s),
        ];
        for (key, value) in positive {
            number(key, value, "a number above 0", 0.0 < value && value < 1e9)?;
        }
        for (key, value) in not_negative {
            number(key, value, "a number from 0 on", (0.0..1e9).contains(&value))?;
        }
        let rate = self.rate_hz;
        number("rate_hz", rate, "a number from 100 to 10000", (100.0..=10_000.0).contains(&rate))?;
        let latency = self.latency_s;
        number("latency_s", latency, "at most 1", latency <= 1.0)?;
        Ok(DeviceSpec {
            model: "recorded device",
            workspace_m: DVec3::from_array(self.workspace_m),
            force_max_n: self.force_max_n,
            force_continuous_n: self.force_continuous_n,
            stiffness_max_n_m: self.stiffness_max_n_m,
            damping_max_ns_m: self.damping_max_ns_m,
            mass_kg: self.mass_kg,
            damping_ns_m: self.damping_ns_m,
            friction_n: self.friction_n,
            quantum_m: self.quantum_m,
            rate_hz: self.rate_hz,
            latency_s: self.latency_s,
            senses_orientation: self.senses_orientation,
            has_own_scheduler: false,
        })
    }
}

fn number(
    key: &'static str,
    value: f64,
    expected: &'static str,
    is_sound: bool,
) -> Result<(), RecordingProblem> {
    let value = value.to_string();
    if is_sound { Ok(()) } else { Err(RecordingProblem::Number { key, value, expected }) }
}

/// `null` for what is no number.
type Numbers<const N: usize> = Option<[Option<f64>; N]>;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    #[serde(skip_serializing_if = "Option::is_none")]
    dt: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    position: Numbers<3>,
    #[serde(skip_serializing_if = "Option::is_none")]
    velocity: Numbers<3>,
    #[serde(skip_serializing_if = "Option::is_none")]
    orientation: Numbers<4>,
    #[serde(skip_serializing_if = "Option::is_none")]
    buttons: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    status: Option<Status>,
}

#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Status {
    Ready,
    Warm,
    Lost,
}

impl Row {
    fn of(reading: &Reading, before: Option<&Reading>) -> Self {
        let state = &reading.state;
        let before_state = before.map(|before| &before.state);
        let (old_place, old_velocity) = (
            before_state.map(|state| state.position.to_array()),
            before_state.map(|state| state.velocity.to_array()),
        );
        let old_turn = before_state.map(|state| state.orientation.to_array());
        let new_buttons = before_state.is_none_or(|before| before.buttons != state.buttons);
        let new_status = before_state.is_none_or(|before| before.status != state.status);
        Row {
            dt: changed([reading.dt], before.map(|before| [before.dt])).and_then(|[dt]| dt),
            position: changed(state.position.to_array(), old_place),
            velocity: changed(state.velocity.to_array(), old_velocity),
            orientation: changed(state.orientation.to_array(), old_turn),
            buttons: new_buttons.then_some(state.buttons.0),
            status: new_status.then_some(match state.status {
                DeviceStatus::Ready => Status::Ready,
                DeviceStatus::Warm => Status::Warm,
                DeviceStatus::Lost => Status::Lost,
            }),
        }
    }

    fn after(&self, before: Option<&Reading>) -> Result<Reading, RecordingProblem> {
        let missing = RecordingProblem::Missing;
        let state = before.map(|before| before.state);
        let dt = self.dt.or(before.map(|before| before.dt)).ok_or(missing("dt"))?;
        number("dt", dt, "a number from 0 to 3600", (0.0..=3600.0).contains(&dt))?;
        let position = known(self.position).map(DVec3::from_array);
        let velocity = known(self.velocity).map(DVec3::from_array);
        let turned = known(self.orientation).map(DQuat::from_array);
        let status = self.status.map(|status| match status {
            Status::Ready => DeviceStatus::Ready,
            Status::Warm => DeviceStatus::Warm,
            Status::Lost => DeviceStatus::Lost,
        });
        let buttons = self.buttons.map(Buttons);
        let state = DeviceState {
            position: position.or(state.map(|s| s.position)).ok_or(missing("position"))?,
            velocity: velocity.or(state.map(|s| s.velocity)).ok_or(missing("velocity"))?,
            orientation: turned.or(state.map(|s| s.orientation)).ok_or(missing("orientation"))?,
            buttons: buttons.or(state.map(|s| s.buttons)).ok_or(missing("buttons"))?,
            status: status.or(state.map(|s| s.status)).ok_or(missing("status"))?,
        };
        Ok(Reading { dt, state })
    }
}

/// What is to be written of `now`: nothing if it has the same bits as `before`.
fn changed<const N: usize>(now: [f64; N], before: Option<[f64; N]>) -> Numbers<N> {
    let bits = |numbers: [f64; N]| numbers.map(f64::to_bits);
    if before.map(bits) == Some(bits(now)) {
        return None;
    }
    Some(now.map(|number| number.is_finite().then_some(number)))
}

fn known<const N: usize>(numbers: Numbers<N>) -> Option<[f64; N]> {
    numbers.map(|numbers| numbers.map(|number| number.unwrap_or(f64::NAN)))
}
