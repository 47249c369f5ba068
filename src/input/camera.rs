//! The player's eye: behind the cue, over the whole table, or a bird's.
//!
//! It belongs to the picture alone: nothing here is recorded or hashed.

use super::feel::{CAMERA_TICKS, PLACING_M_PER_HEIGHT, ZOOM};
use super::{CameraPose, Look};
use crate::cue::Aim;
use glam::{DVec2, DVec3};

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Usual distance of the eye behind the cue ball [m].
const BEHIND_M: f64 = 1.0;
/// How far before the cue ball it looks [m].
const AHEAD_M: f64 = 0.35;
/// How high the eye is over the cue ball, as an angle [rad].
const RISE_RAD: f64 = 16.0 * DEGREE;
/// The same while the balls roll: farther back, higher, and over more of the table.
const WATCH_BEHIND_M: f64 = 1.5;
/// See [`WATCH_BEHIND_M`] [m].
const WATCH_AHEAD_M: f64 = 0.75;
/// See [`WATCH_BEHIND_M`] [rad].
const WATCH_RISE_RAD: f64 = 34.0 * DEGREE;
/// How far it stays above the cue [rad].
const OVER_CUE_RAD: f64 = 12.0 * DEGREE;
/// Lowest and highest eye [rad]: above the rails, and never straight above what it looks at.
const RISE: (f64, f64) = (4.0 * DEGREE, 86.0 * DEGREE);
/// The bird is this much off the vertical towards −y, so that it knows which way is up [m].
const BIRD_ASIDE_M: f64 = 0.02;

/// From where the player looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Viewpoint {
    /// Over the table's head.
    Overview,
    /// From above; the head of the table is on the left.
    Bird,
    /// Behind a cue that is held to a ball.
    Cue {
        /// The ball's middle [m].
        ball: DVec3,
        /// How the cue is held.
        aim: Aim,
    },
    /// Over a stroke that was made: the cue is out of the way.
    Watch {
        /// Where the ball's middle was [m].
        ball: DVec3,
        /// How the cue was held.
        aim: Aim,
    },
}

impl Viewpoint {
    /// Whether both are the same place, apart from how the cue is held.
    fn is_like(&self, other: &Viewpoint) -> bool {
        match (self, other) {
            (Viewpoint::Cue { ball: a, .. }, Viewpoint::Cue { ball: b, .. })
            | (Viewpoint::Watch { ball: a, .. }, Viewpoint::Watch { ball: b, .. }) => a == b,
            _ => self == other,
        }
    }
}

/// The player's eye.
#[derive(Debug, Clone)]
pub(super) struct Camera {
    viewpoint: Viewpoint,
    /// Looking round: to the left, upwards [rad].
    turn_rad: f64,
    rise_rad: f64,
    zoom: f64,
    /// On its way from here, so many ticks to go.
    from: CameraPose,
    left: u64,
}

impl Camera {
    /// The eye over the whole table.
    pub fn new() -> Self {
        Camera {
            viewpoint: Viewpoint::Overview,
            turn_rad: 0.0,
            rise_rad: 0.0,
            zoom: 1.0,
            from: CameraPose::default(),
            left: 0,
        }
    }

    /// Goes to another place, unless it is there already.
    pub fn go_to(&mut self, viewpoint: Viewpoint) {
        if !self.viewpoint.is_like(&viewpoint) {
            self.from = self.pose();
            self.left = CAMERA_TICKS;
            self.turn_rad = 0.0;
        }
        self.viewpoint = viewpoint;
    }

    /// Looks round.
    pub fn look(&mut self, left_rad: f64, up_rad: f64) {
        self.turn_rad += left_rad;
        self.rise_rad = (self.rise_rad + up_rad).clamp(-RISE.1, RISE.1);
    }

    /// Goes nearer or farther away, by this factor.
    pub fn zoom(&mut self, factor: f64) {
        self.zoom = (self.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
    }

    /// How the player looks round, from above or not.
    pub fn looking(&self, bird: bool) -> Look {
        Look { turn_rad: self.turn_rad, rise_rad: self.rise_rad, zoom: self.zoom, bird }
    }

    /// A tick passes.
    pub fn step(&mut self) {
        self.left = self.left.saturating_sub(1);
    }

    /// Where the eye is now.
    pub fn pose(&self) -> CameraPose {
        let to = self.destination();
        if self.left == 0 {
            return to;
        }
        let s = 1.0 - self.left as f64 / CAMERA_TICKS as f64;
        let s = s * s * (3.0 - 2.0 * s);
        CameraPose {
            eye: self.from.eye.lerp(to.eye, s),
            target: self.from.target.lerp(to.target, s),
            ..to
        }
    }

    fn destination(&self) -> CameraPose {
        let usual = CameraPose::default();
        match self.viewpoint {
            Viewpoint::Overview => self.orbit(usual.target, usual.eye - usual.target, usual),
            Viewpoint::Bird => {
                let tan = libm::tan(0.5 * usual.field_of_view_rad);
                let height_m = 0.5 * PLACING_M_PER_HEIGHT / tan * self.zoom;
                let eye = DVec3::new(0.0, -BIRD_ASIDE_M, height_m);
                CameraPose { eye, target: DVec3::ZERO, ..usual }
            }
            Viewpoint::Cue { ball, aim } => {
                let rise = RISE_RAD.max(aim.elevation_rad + OVER_CUE_RAD);
                self.behind(ball, aim, (BEHIND_M, AHEAD_M, rise))
            }
            Viewpoint::Watch { ball, aim } => {
                self.behind(ball, aim, (WATCH_BEHIND_M, WATCH_AHEAD_M, WATCH_RISE_RAD))
            }
        }
    }

    /// The eye so far behind a ball, looking so far ahead of it, so high above it.
    fn behind(
        &self,
        ball: DVec3,
        aim: Aim,
        (back_m, ahead_m, rise): (f64, f64, f64),
    ) -> CameraPose {
        let (sin_a, cos_a) = libm::sincos(aim.azimuth_rad);
        let ahead = DVec2::new(cos_a, sin_a);
        let (sin, cos) = libm::sincos(rise);
        let back = (-ahead * cos).extend(sin) * back_m;
        let pose = self.orbit(ball, back, CameraPose::default());
        let aside = (ball - pose.eye).truncate().normalize_or(ahead);
        CameraPose { target: ball + (aside * ahead_m).extend(0.0), ..pose }
    }

    /// The eye at `pivot + offset`, turned, raised and zoomed about the pivot.
    fn orbit(&self, pivot: DVec3, offset: DVec3, usual: CameraPose) -> CameraPose {
        let level = offset.truncate();
        let rise = libm::atan2(offset.z, level.length()) + self.rise_rad;
        let (sin, cos) = libm::sincos(rise.clamp(RISE.0, RISE.1));
        let (turn_sin, turn_cos) = libm::sincos(self.turn_rad);
        let way = DVec2::new(turn_cos, turn_sin).rotate(level.normalize_or(DVec2::X));
        let eye = pivot + (way * cos).extend(sin) * (offset.length() * self.zoom);
        CameraPose { eye, target: pivot, ..usual }
    }
}
