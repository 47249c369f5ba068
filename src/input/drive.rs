//! A stylus that leads the camera: how far it is from where it began becomes how fast the eye
//! moves and turns (paper, section 3.3.3).
//!
//! | | [`Steering::ByPlace`] | with the front button | [`Steering::ByPointing`] |
//! |---|---|---|---|
//! | pushed forwards, drawn back | forwards, backwards | the same | the same |
//! | to the left and right | turns | moves sideways | moves sideways |
//! | up and down | looks up and down | rises and sinks | rises and sinks |
//! | pointing aside, up, down | – | – | turns, looks up and down |
//!
//! Below a threshold, which is felt, nothing moves; beyond it everything begins at zero.

use crate::haptic::{Buttons, DeviceState, THRESHOLD_M};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Speed of the eye per metre of the stylus [1/s]: 1.5 cm beyond the threshold are a walk.
const MOVE_PER_S: f64 = 60.0;
/// How fast it turns per metre of the stylus [rad/(s m)].
const TURN_RAD_PER_S_M: f64 = 60.0;
/// How far the stylus is turned before the eye turns [rad].
const THRESHOLD_RAD: f64 = 10.0 * std::f64::consts::PI / 180.0;
/// How fast it turns per angle of the stylus [1/s].
const TURN_PER_S: f64 = 2.0;

/// Which of the paper's two ways to lead a camera.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Steering {
    /// The place of the stylus alone; its front button chooses between turning and moving. The
    /// paper's choice: no device pushes back against turning.
    #[default]
    ByPlace,
    /// The place moves the eye, and where the stylus points turns it.
    ByPointing,
}

impl Steering {
    /// All, in the order in which they are offered.
    pub const ALL: [Steering; 2] = [Steering::ByPlace, Steering::ByPointing];
}

/// A stylus that leads the camera, in the device frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraHand {
    /// How far it is from where it began [m].
    pub moved: DVec3,
    /// Unit vector that it points along.
    pub pointing: DVec3,
    /// The front button is held.
    pub front: bool,
}

/// How fast the eye goes and turns.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct Drive {
    /// To its right, up the vertical, and forwards along the ground [m/s].
    pub velocity: DVec3,
    /// To the left [rad/s].
    pub turn_rad_s: f64,
    /// Upwards [rad/s].
    pub rise_rad_s: f64,
}

impl Drive {
    /// The same, faster by this factor.
    #[must_use]
    pub fn faster(self, factor: f64) -> Self {
        Drive {
            velocity: self.velocity * factor,
            turn_rad_s: self.turn_rad_s * factor,
            rise_rad_s: self.rise_rad_s * factor,
        }
    }
}

impl CameraHand {
    /// What a device says that began at `from` [m].
    pub fn of(device: &DeviceState, from: DVec3) -> Self {
        CameraHand {
            moved: device.position - from,
            pointing: device.pointing(),
            front: device.buttons.has(Buttons::FRONT),
        }
    }

    /// What it makes the eye do.
    pub fn drive(&self, steering: Steering) -> Drive {
        // The device's z points towards the user.
        let [right, up, back] = self.moved.to_array().map(|x| beyond(x, THRESHOLD_M));
        let forwards = -back * MOVE_PER_S;
        let moves = DVec3::new(right * MOVE_PER_S, up * MOVE_PER_S, forwards);
        match (steering, self.front) {
            (Steering::ByPlace, false) => Drive {
                velocity: DVec3::Z * forwards,
                turn_rad_s: -right * TURN_RAD_PER_S_M,
                rise_rad_s: up * TURN_RAD_PER_S_M,
            },
            (Steering::ByPlace, true) => Drive { velocity: moves, ..Drive::default() },
            (Steering::ByPointing, _) => {
                let DVec3 { x, y, z } = self.pointing;
                let aside = beyond(libm::atan2(x, -z), THRESHOLD_RAD);
                let upwards = beyond(libm::asin(y.clamp(-1.0, 1.0)), THRESHOLD_RAD);
                Drive {
                    velocity: moves,
                    turn_rad_s: -aside * TURN_PER_S,
                    rise_rad_s: upwards * TURN_PER_S,
                }
            }
        }
    }
}

/// How far `x` is beyond ±`threshold`.
fn beyond(x: f64, threshold: f64) -> f64 {
    (x.abs() - threshold).max(0.0).copysign(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hand(moved: DVec3) -> CameraHand {
        CameraHand { moved, pointing: DVec3::NEG_Z, front: false }
    }

    #[test]
    fn nothing_moves_below_the_threshold_and_everything_begins_at_zero() {
        for steering in Steering::ALL {
            for front in [false, true] {
                let still = CameraHand { front, ..hand(DVec3::splat(0.0049)) };
                assert_eq!(still.drive(steering), Drive::default());
                let hardly = CameraHand { front, ..hand(DVec3::splat(0.00501)) }.drive(steering);
                assert!(hardly.velocity.length() < 2e-3 && hardly.turn_rad_s.abs() < 1e-3);
            }
        }
        let (sin, cos) = libm::sincos(9.9_f64.to_radians());
        let pointing = DVec3::new(sin, 0.0, -cos);
        let tilted = CameraHand { pointing, ..hand(DVec3::ZERO) };
        assert_eq!(tilted.drive(Steering::ByPointing), Drive::default());
    }

    #[test]
    fn the_front_button_chooses_between_turning_and_moving() {
        let to_the_right = hand(DVec3::new(0.015, 0.0, 0.0));
        let turns = to_the_right.drive(Steering::ByPlace);
        assert!(turns.velocity == DVec3::ZERO && turns.turn_rad_s < -0.5);
        let held = CameraHand { front: true, ..to_the_right };
        let moves = held.drive(Steering::ByPlace);
        assert!(moves.turn_rad_s == 0.0 && 0.5 < moves.velocity.x);
        let forwards = hand(DVec3::new(0.0, 0.0, -0.015)).drive(Steering::ByPlace);
        assert!(0.5 < forwards.velocity.z && forwards.turn_rad_s == 0.0);
    }

    #[test]
    fn pointing_turns_and_places_move() {
        let (sin, cos) = libm::sincos(30.0_f64.to_radians());
        let left = CameraHand { pointing: DVec3::new(-sin, 0.0, -cos), ..hand(DVec3::ZERO) };
        let drive = left.drive(Steering::ByPointing);
        assert!(0.5 < drive.turn_rad_s && drive.rise_rad_s == 0.0);
        let up = CameraHand { pointing: DVec3::new(0.0, sin, -cos), ..hand(DVec3::ZERO) };
        assert!(0.5 < up.drive(Steering::ByPointing).rise_rad_s);
    }
}
