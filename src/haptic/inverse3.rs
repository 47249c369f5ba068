//! Haply Inverse3: what its service says and wants to hear. No socket is here.
//!
//! The service speaks JSON over a WebSocket and says one state for every message that it hears, so
//! a force must be sent, if only zero, to learn where the handle is. Its first message, before it
//! has heard anything, lists all devices with their configuration; later ones hold states only.
//!
//! Two ways to send a force are in use, and [`Format`] tells them apart by what the first message
//! configures: up to service 3.1 `"values"`, from 3.5 on `"vector"`.
//!
//! | | Haply, basis XYZ | device frame here |
//! |---|---|---|
//! | right | +x | +x |
//! | up | +z | +y |
//! | away from the user | +y | −z |
//! | a grip points along its own | +y | −z |
//!
//! Service 3.5 is asked to put the origin into the middle of the workspace (preset
//! `arm_front_centered`); an older one counts from the device's base unless it says otherwise.
//! Source: Haply Inverse SDK documentation, service 3.1.1 and 3.5 (WebSocket protocol, basis
//! permutation, mount and workspace, control commands, tutorials 01 and 06).

mod message;

use super::device::{DeviceSpec, DeviceState, DeviceStatus, Force};
use crate::one_line::one_line;
use crate::units::Seconds;
use glam::DVec3;
use message::{ArmStatus, Grip, Message, Turn};
use std::fmt::Write;

/// The middle of the workspace seen from the device's base, in Haply's frame [m]: where the
/// vendor's examples put what is to be touched. It is published nowhere else.
const CENTRE_M: DVec3 = DVec3::new(0.0, -0.10, 0.18);

/// An Inverse3 (Haply). The workspace is the ball of 0.10 m that the vendor's tutorials stay in;
/// stiffness and damping are what they offer to choose from, at most what an Omni gets. Forces are
/// those of an Omni, which this game is made for, though the device can do more. Mass and damping
/// are not published and assumed; so is that there is no dry friction, which is the careful side.
pub const INVERSE3: DeviceSpec = DeviceSpec {
    model: "Haply Inverse3",
    workspace_m: DVec3::new(0.20, 0.20, 0.20),
    force_max_n: 3.3,
    force_continuous_n: 0.88,
    stiffness_max_n_m: 500.0,
    damping_max_ns_m: 3.0,
    mass_kg: 0.070,
    damping_ns_m: 0.1,
    friction_n: 0.0,
    quantum_m: 2e-5,
    rate_hz: 1000.0,
    latency_s: 0.0,
    senses_orientation: false,
    has_own_scheduler: false,
};

/// How a force is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Service 3.1: `"values"`.
    Values,
    /// Service 3.5: `"vector"`, and a session that is configured.
    Vector,
}

/// What is wrong with an Inverse3 or with what its service says.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Inverse3Trouble {
    /// Half a message, or none of this kind.
    #[error(
        "its service says what is not understood ({0}); port 10001 of a Haply Inverse service \
         3.1 or later is needed"
    )]
    NotUnderstood(String),
    /// The message lists no arm.
    #[error("its service sees no Inverse3; plug it in, switch it on, and look at the Haply Hub")]
    NoArm,
    /// The arm that was there is no longer listed.
    #[error("the Inverse3 {0} is gone from its service; plug it in again")]
    Gone(String),
    /// The arm is listed without its place.
    #[error("its service does not say where the Inverse3 {0} is; restart the service")]
    NoPlace(String),
    /// Its workspace is too small.
    #[error("{0} is a Minverse: its workspace of 80 mm is too small for the cue; use an Inverse3")]
    Minverse(String),
    /// The service turns the axes.
    #[error("its service turns the axes (basis {0}); set the basis to XYZ in the Haply Hub")]
    Axes(String),
    /// Its angles are not known.
    #[error(
        "the Inverse3 {0} is not calibrated; put its grip on the inkwell until the light is \
         steady, then take it off"
    )]
    NotCalibrated(String),
    /// Its motors have no power.
    #[error("the motors of the Inverse3 {0} have no power; plug in its power supply")]
    NoPower(String),
    /// It is not ready for another reason.
    #[error("the Inverse3 {0} is not ready; look at the Haply Hub")]
    NotReady(String),
}

/// What follows the messages of one arm.
#[derive(Debug, Clone)]
pub struct Inverse3 {
    id: String,
    /// The same as JSON, and as people are told.
    id_json: String,
    name: String,
    format: Format,
    centre_m: DVec3,
    has_grip: bool,
    known: Known,
    trouble: Option<Inverse3Trouble>,
    last: DeviceState,
    /// Where it was last [m]; NaN if that is not known.
    last_m: DVec3,
}

impl Inverse3 {
    /// Reads the first message of a service; the first arm in it is the one.
    ///
    /// # Errors
    /// [`Inverse3Trouble`] if there is none that can be used.
    pub fn greeted(text: &str) -> Result<Self, Inverse3Trouble> {
        let Message { inverse3, wireless_verse_grip, custom_verse_grip, verse_grip } = read(text)?;
        let arm = inverse3.unwrap_or_default().into_iter().next().ok_or(Inverse3Trouble::NoArm)?;
        let name = one_line(&arm.device_id, 60);
        let config = arm.config.unwrap_or_default();
        if config.kind.as_deref() == Some("minverse") {
            return Err(Inverse3Trouble::Minverse(name));
        }
        let is_new = config.preset.is_some() || config.mount.is_some() || config.filters.is_some();
        let format = if is_new { Format::Vector } else { Format::Values };
        let basis = config.basis.and_then(|basis| basis.permutation);
        if let (Format::Values, Some(basis)) = (format, basis.filter(|basis| basis != "XYZ")) {
            return Err(Inverse3Trouble::Axes(one_line(&basis, 20)));
        }
        let is_centred = is_new || config.coordinate_origin.as_deref() == Some("workspace_center");
        let mut known = Known::default();
        known.learn(arm.status);
        let grips = [wireless_verse_grip, custom_verse_grip, verse_grip];
        Ok(Inverse3 {
            id_json: serde_json::Value::from(arm.device_id.as_str()).to_string(),
            id: arm.device_id,
            name,
            format,
            centre_m: if is_centred { DVec3::ZERO } else { CENTRE_M },
            has_grip: grips.iter().flatten().flatten().any(Grip::is_there),
            known,
            trouble: None,
            last: DeviceState { status: DeviceStatus::Lost, ..DeviceState::default() },
            last_m: DVec3::NAN,
        })
    }

    /// What it is, without the latency of its service.
    pub fn spec(&self) -> DeviceSpec {
        DeviceSpec { senses_orientation: self.has_grip, ..INVERSE3 }
    }

    /// The name of the arm, in one line.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How forces are written.
    pub fn format(&self) -> Format {
        self.format
    }

    /// Why it cannot be felt, if that is so.
    pub fn trouble(&self) -> Option<&Inverse3Trouble> {
        self.trouble.as_ref()
    }

    /// The first message to send: no force, and what the session is to be like.
    pub fn greeting(&self, out: &mut String) {
        if self.format == Format::Values {
            return self.push(Force::ZERO, out);
        }
        out.clear();
        // Writing into a string does not fail.
        let _ = write!(
            out,
            "{{\"session\":{{\"configure\":{{\"profile\":{{\"name\":\"hapticbillard\"}},\
             \"basis\":{{\"permutation\":\"XYZ\"}}}}}},\"inverse3\":[{{\"device_id\":{},\
             \"configure\":{{\"preset\":{{\"preset\":\"arm_front_centered\"}}}},\
             \"commands\":{{\"set_cursor_force\":{{\"vector\":{{\"x\":0,\"y\":0,\"z\":0}}}}}}}}]}}",
            self.id_json
        );
    }

    /// The message that pushes the handle. What is no number is no force.
    pub fn push(&self, force: Force, out: &mut String) {
        let Force(force) = if force.0.is_finite() { force } else { Force::ZERO };
        let DVec3 { x, y, z } = to_haply(force);
        let key = match self.format {
            Format::Values => "values",
            Format::Vector => "vector",
        };
        out.clear();
        // Writing into a string does not fail.
        let _ = write!(
            out,
            "{{\"inverse3\":[{{\"device_id\":{},\"commands\":{{\"set_cursor_force\":\
             {{\"{key}\":{{\"x\":{x:.6},\"y\":{y:.6},\"z\":{z:.6}}}}}}}}}]}}",
            self.id_json
        );
    }

    /// Reads a later message, `dt` after the one before [s]. A number that is missing is read as
    /// none (NaN), which is for the servo to refuse.
    ///
    /// # Errors
    /// [`Inverse3Trouble::NotUnderstood`] and [`Inverse3Trouble::NoPlace`] if the message says
    /// nothing about the arm; what was known before still holds.
    pub fn hear(&mut self, text: &str, dt: Seconds) -> Result<DeviceState, Inverse3Trouble> {
        let message = read(text)?;
        let arms = message.inverse3.unwrap_or_default();
        let Some(arm) = arms.into_iter().find(|arm| arm.device_id == self.id) else {
            self.trouble = Some(Inverse3Trouble::Gone(self.name.clone()));
            self.last.status = DeviceStatus::Lost;
            return Ok(self.last);
        };
        let state = arm.state.unwrap_or_default();
        let place = state.cursor_position.ok_or(Inverse3Trouble::NoPlace(self.name.clone()))?;
        let position = to_device(place.numbers() - self.centre_m);
        let velocity = match state.cursor_velocity {
            Some(velocity) => to_device(velocity.numbers()),
            None if 0.0 < dt && self.last_m.is_finite() => (position - self.last_m) / dt,
            None => DVec3::ZERO,
        };
        let grips = [message.wireless_verse_grip, message.custom_verse_grip, message.verse_grip];
        let grip = grips.into_iter().flatten().flatten().find(Grip::is_there);
        let grip = grip.and_then(|grip| grip.state).unwrap_or_default();
        let turned = grip.orientation.as_ref().and_then(Turn::turned);
        let turned = turned.or_else(|| state.body_orientation.as_ref().and_then(Turn::turned));

        self.known.learn(arm.status);
        self.trouble = self.known.trouble(&self.name);
        let status = match &self.trouble {
            None => DeviceStatus::Ready,
            Some(Inverse3Trouble::NotCalibrated(_)) => DeviceStatus::Lost,
            Some(_) => DeviceStatus::Warm,
        };
        self.last_m = position;
        self.last = DeviceState {
            position,
            velocity,
            orientation: turned.unwrap_or(self.last.orientation),
            buttons: grip.held(),
            status,
        };
        Ok(self.last)
    }
}

/// From Haply's frame into the device's.
fn to_device(v: DVec3) -> DVec3 {
    DVec3::new(v.x, v.z, -v.y)
}

/// And back.
fn to_haply(v: DVec3) -> DVec3 {
    DVec3::new(v.x, -v.z, v.y)
}

fn read(text: &str) -> Result<Message, Inverse3Trouble> {
    let not_understood = |error: serde_json::Error| {
        Inverse3Trouble::NotUnderstood(one_line(&error.to_string(), 200))
    };
    serde_json::from_str(text).map_err(not_understood)
}

/// What was said last about an arm; what was never said is taken to be fine.
#[derive(Debug, Clone, Copy)]
struct Known {
    calibrated: bool,
    power_supply: bool,
    ready: bool,
}

impl Default for Known {
    fn default() -> Self {
        Known { calibrated: true, power_supply: true, ready: true }
    }
}

impl Known {
    fn learn(&mut self, said: Option<ArmStatus>) {
        let Some(said) = said else { return };
        self.calibrated = said.calibrated.unwrap_or(self.calibrated);
        self.power_supply = said.power_supply.unwrap_or(self.power_supply);
        self.ready = said.ready.unwrap_or(self.ready);
    }

    fn trouble(&self, id: &str) -> Option<Inverse3Trouble> {
        let id = id.to_string();
        match self {
            Known { power_supply: false, .. } => Some(Inverse3Trouble::NoPower(id)),
            Known { calibrated: false, .. } => Some(Inverse3Trouble::NotCalibrated(id)),
            Known { ready: false, .. } => Some(Inverse3Trouble::NotReady(id)),
            _ => None,
        }
    }
}
