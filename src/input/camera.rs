//! The player's eye: behind the cue, over the whole table, or a bird's.
//!
//! It belongs to the picture alone: nothing here is recorded or hashed.

use super::feel::{CAMERA_TICKS, PLACING_M_PER_HEIGHT, ZOOM};
use super::{CameraPose, Drive, Look};
use crate::cue::Aim;
use crate::units::TICK_S;
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
/// Where a free eye may be: over the floor, below the ceiling, not far from the table [m].
const ROOM: (DVec3, DVec3) = (DVec3::new(-4.0, -3.5, -0.6), DVec3::new(4.0, 3.5, 2.2));
/// How high the eye stays over the bed above the table [m], and how far it keeps from its side.
const OVER_BED_M: f64 = 0.1;
/// The steepest free look [rad].
const STEEP_RAD: f64 = 85.0 * DEGREE;
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

/// An eye that goes where it is led: five degrees of freedom, no roll.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Free {
    /// Where it is [m].
    eye: DVec3,
    /// Where it looks: horizontally, anticlockwise from +x, and upwards [rad].
    azimuth_rad: f64,
    rise_rad: f64,
}

impl Free {
    fn from(pose: &CameraPose) -> Self {
        let ahead = (pose.target - pose.eye).normalize_or(DVec3::X);
        Free {
            eye: pose.eye,
            azimuth_rad: libm::atan2(ahead.y, ahead.x),
            rise_rad: libm::asin(ahead.z.clamp(-1.0, 1.0)).clamp(-STEEP_RAD, STEEP_RAD),
        }
    }

    fn turn(&mut self, left_rad: f64, up_rad: f64) {
        self.azimuth_rad = libm::remainder(self.azimuth_rad + left_rad, std::f64::consts::TAU);
        self.rise_rad = (self.rise_rad + up_rad).clamp(-STEEP_RAD, STEEP_RAD);
    }

    /// Goes to its right, up and forwards [m]; it stays in the room and out of the table, whose bed
    /// is so large [m].
    fn go(&mut self, by: DVec3, table: DVec2) {
        let (sin, cos) = libm::sincos(self.azimuth_rad);
        let (right, ahead) = (DVec3::new(sin, -cos, 0.0), DVec3::new(cos, sin, 0.0));
        let wanted = self.eye + right * by.x + DVec3::Z * by.y + ahead * by.z;
        let wanted = wanted.clamp(ROOM.0, ROOM.1);
        let is_over = wanted.truncate().abs().cmplt(0.5 * table).all();
        self.eye = match is_over && wanted.z < OVER_BED_M {
            // From above it stays above; from the side it stays there.
            true if self.eye.truncate().abs().cmplt(0.5 * table).all() => wanted.with_z(OVER_BED_M),
            true => self.eye.with_z(wanted.z),
            false => wanted,
        };
    }

    fn pose(&self) -> CameraPose {
        let (sin_a, cos_a) = libm::sincos(self.azimuth_rad);
        let (sin_r, cos_r) = libm::sincos(self.rise_rad);
        let ahead = DVec3::new(cos_r * cos_a, cos_r * sin_a, sin_r);
        CameraPose { eye: self.eye, target: self.eye + ahead, ..CameraPose::default() }
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
    /// It is led by hand.
    free: Option<Free>,
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
            free: None,
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

    /// From here on it is led by hand; or goes back to where it would be.
    pub fn set_free(&mut self, is_free: bool) {
        if is_free && self.free.is_none() {
            self.free = Some(Free::from(&self.pose()));
        } else if !is_free && self.free.is_some() {
            self.from = self.pose();
            (self.free, self.left) = (None, CAMERA_TICKS);
        }
    }

    /// Whether it is led by hand.
    pub fn is_free(&self) -> bool {
        self.free.is_some()
    }

    /// One tick of being led, if it is, round a table with a bed of this size [m].
    pub fn drive(&mut self, drive: &Drive, table: DVec2) {
        let Some(free) = &mut self.free else { return };
        free.turn(drive.turn_rad_s * TICK_S, drive.rise_rad_s * TICK_S);
        free.go(drive.velocity * TICK_S, table);
    }

    /// Looks round.
    pub fn look(&mut self, left_rad: f64, up_rad: f64) {
        if let Some(free) = &mut self.free {
            free.turn(left_rad, -up_rad);
            return;
        }
        self.turn_rad += left_rad;
        self.rise_rad = (self.rise_rad + up_rad).clamp(-RISE.1, RISE.1);
    }

    /// Goes nearer or farther away, by this factor.
    pub fn zoom(&mut self, factor: f64) {
        self.zoom = (self.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
    }

    /// How the player looks round, from above or not.
    pub fn looking(&self, bird: bool) -> Look {
        let free = self.is_free();
        Look { turn_rad: self.turn_rad, rise_rad: self.rise_rad, zoom: self.zoom, bird, free }
    }

    /// A tick passes.
    pub fn step(&mut self) {
        self.left = self.left.saturating_sub(1);
    }

    /// Where the eye is now.
    pub fn pose(&self) -> CameraPose {
        if let Some(free) = &self.free {
            return free.pose();
        }
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
