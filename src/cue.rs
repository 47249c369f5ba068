//! The cue: how it moves is a path in time, whoever holds it.
//!
//! A hand sends pieces of one tick, a computer its whole stroke. The tip is a sphere that follows
//! the path exactly until contact; the truth of the contact is physics'.

mod aim;

pub use aim::{Aim, OFFSET_LIMIT, elevation_over_balls};

use crate::units::Seconds;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

/// Radius of the tip's curvature [m]: a nickel.
pub const TIP_RADIUS_M: f64 = 0.0106;
/// Mass of the cue along its shaft [kg].
pub const CUE_MASS_KG: f64 = 0.54;
/// Effective mass of its end across the shaft [kg]; makes squirt.
pub const CUE_END_MASS_KG: f64 = 0.17 / 30.0;
/// Length of the cue [m].
pub const CUE_LENGTH_M: f64 = 1.47;
/// Radius of the shaft at the tip [m] (for display and clearance).
pub const SHAFT_RADIUS_M: f64 = 0.0065;
/// Radius of the butt [m].
pub const BUTT_RADIUS_M: f64 = 0.0145;

/// One polynomial piece of the tip's path: x(τ) = p + v τ + ½ a τ², τ from `start_s`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuePiece {
    /// When it begins [s].
    pub start_s: Seconds,
    /// How long it lasts [s].
    pub duration_s: Seconds,
    /// Centre of the tip sphere at its start [m].
    pub position: DVec3,
    /// Velocity at its start [m/s].
    pub velocity: DVec3,
    /// Acceleration [m/s²].
    pub acceleration: DVec3,
    /// Unit vector along the shaft, from butt to tip, at its start.
    pub direction: DVec3,
    /// The same at its end; turned linearly in between and normalised.
    pub direction_end: DVec3,
}

impl CuePiece {
    /// When it ends [s].
    pub fn end_s(&self) -> Seconds {
        self.start_s + self.duration_s
    }

    /// Tip centre [m] and velocity [m/s] at `time_s`.
    pub fn at(&self, time_s: Seconds) -> (DVec3, DVec3) {
        let tau = time_s - self.start_s;
        (
            self.position + self.velocity * tau + self.acceleration * (0.5 * tau * tau),
            self.velocity + self.acceleration * tau,
        )
    }

    /// Unit vector along the shaft at `time_s`.
    pub fn direction_at(&self, time_s: Seconds) -> DVec3 {
        if self.duration_s <= 0.0 {
            return self.direction_end;
        }
        let s = ((time_s - self.start_s) / self.duration_s).clamp(0.0, 1.0);
        self.direction.lerp(self.direction_end, s).normalize_or(self.direction)
    }
}

/// A path: pieces in time order without gaps. After its end the cue stands where it is; the next
/// path replaces what is left of this one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CuePath {
    /// Whether the tip touches balls. While aiming it does not: it is led past them.
    pub solid: bool,
    /// The pieces.
    pub pieces: SmallVec<[CuePiece; 4]>,
}

impl CuePath {
    /// The piece that holds at `time_s`: the last that has begun, or the first.
    pub fn piece_at(&self, time_s: Seconds) -> Option<&CuePiece> {
        self.pieces.iter().rev().find(|piece| piece.start_s <= time_s).or(self.pieces.first())
    }

    /// When the path ends [s].
    pub fn end_s(&self) -> Option<Seconds> {
        self.pieces.last().map(CuePiece::end_s)
    }
}

/// The cue at one time, for display and for whoever takes it over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuePose {
    /// Centre of the tip sphere [m].
    pub tip: DVec3,
    /// Velocity of the tip [m/s].
    pub velocity: DVec3,
    /// Unit vector along the shaft, from butt to tip.
    pub direction: DVec3,
    /// Whether the tip touches balls.
    pub solid: bool,
}

impl CuePose {
    /// Whether the shaft lies in a ball at `centre` [m].
    pub fn shaft_meets(&self, centre: DVec3, radius_m: f64) -> bool {
        let back = (self.tip - centre).dot(self.direction).clamp(0.0, CUE_LENGTH_M);
        let axis = self.tip - self.direction * back;
        back > 0.0 && axis.distance(centre) < radius_m + shaft_radius(back)
    }
}

/// Radius of the shaft so far behind the tip [m]: it widens evenly from tip to butt.
fn shaft_radius(back_m: f64) -> f64 {
    SHAFT_RADIUS_M + back_m / CUE_LENGTH_M * (BUTT_RADIUS_M - SHAFT_RADIUS_M)
}
