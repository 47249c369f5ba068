//! An eye that goes where it is led.

use super::{CameraPose, Room};
use glam::DVec3;

/// The steepest look [rad].
const STEEP_RAD: f64 = 85.0 * std::f64::consts::PI / 180.0;

/// An eye that goes where it is led: five degrees of freedom, no roll.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Free {
    /// Where it is [m].
    eye: DVec3,
    /// Where it looks: horizontally, anticlockwise from +x, and upwards [rad].
    azimuth_rad: f64,
    rise_rad: f64,
}

impl Free {
    /// One that is where this one is.
    pub fn from(pose: &CameraPose) -> Self {
        let ahead = (pose.target - pose.eye).normalize_or(DVec3::X);
        Free {
            eye: pose.eye,
            azimuth_rad: libm::atan2(ahead.y, ahead.x),
            rise_rad: libm::asin(ahead.z.clamp(-1.0, 1.0)).clamp(-STEEP_RAD, STEEP_RAD),
        }
    }

    /// Turns to the left and upwards [rad].
    pub fn turn(&mut self, left_rad: f64, up_rad: f64) {
        self.azimuth_rad = libm::remainder(self.azimuth_rad + left_rad, std::f64::consts::TAU);
        self.rise_rad = (self.rise_rad + up_rad).clamp(-STEEP_RAD, STEEP_RAD);
    }

    /// Goes to its right, up and forwards [m]; it stays in the room and out of what stands there.
    pub fn go(&mut self, by: DVec3, room: &Room) {
        let (sin, cos) = libm::sincos(self.azimuth_rad);
        let (right, ahead) = (DVec3::new(sin, -cos, 0.0), DVec3::new(cos, sin, 0.0));
        let wanted = self.eye + right * by.x + DVec3::Z * by.y + ahead * by.z;
        self.eye = room.under_ceiling(room.outside(wanted, DVec3::ZERO));
    }

    /// What it sees.
    pub fn pose(&self) -> CameraPose {
        let (sin_a, cos_a) = libm::sincos(self.azimuth_rad);
        let (sin_r, cos_r) = libm::sincos(self.rise_rad);
        let ahead = DVec3::new(cos_r * cos_a, cos_r * sin_a, sin_r);
        CameraPose { eye: self.eye, target: self.eye + ahead, ..CameraPose::default() }
    }
}
