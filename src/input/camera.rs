//! The player's eye: behind the cue, over the whole table, or a bird's.
//!
//! It belongs to the picture alone: nothing here is recorded or hashed.

mod free;
use free::Free;

mod room;
pub use room::Room;

use super::feel::{CAMERA_TICKS, PLACING_M_PER_HEIGHT, ZOOM};
use super::{CameraPose, Drive, Look, View};
use crate::cue::Aim;
use crate::table::Bed;
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
/// The eye that goes round the cue ball: how far away, and how high [rad].
const ROUND_M: f64 = 1.1;
/// See [`ROUND_M`] [rad].
const ROUND_RISE_RAD: f64 = 28.0 * DEGREE;
/// The eye that follows the cue ball: how far behind, looking how far ahead [m], how high [rad].
const FOLLOW: (f64, f64, f64) = (0.9, 0.45, 24.0 * DEGREE);
/// An aim that turns by more at once is another one [rad].
const FOLLOW_TURN_RAD: f64 = 20.0 * DEGREE;
/// The eye at an end or a side of the table: how far beyond its bed, and how high over it [m].
const BESIDE_M: (f64, f64) = (1.05, 1.0);
/// No eye sets out faster than this [m/s]: what turns with the cue does.
const SET_OUT_M_S: f64 = 3.0;
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
    /// Round a ball, wherever it rolls.
    Round {
        /// Its middle [m].
        ball: DVec3,
    },
    /// Behind a ball, wherever it rolls.
    Follow {
        /// Its middle [m].
        ball: DVec3,
        /// How the cue was held.
        aim: Aim,
    },
    /// Beyond the table, this way from its middle.
    Beside(DVec2),
}

impl Viewpoint {
    /// Whether both are the same place, apart from how the cue is held. An eye that goes with a
    /// ball is where the ball is.
    fn is_like(&self, other: &Viewpoint) -> bool {
        match (self, other) {
            (Viewpoint::Round { .. }, Viewpoint::Round { .. }) => true,
            // A new turn begins with another aim.
            (Viewpoint::Follow { aim: a, .. }, Viewpoint::Follow { aim: b, .. }) => {
                let turned = a.azimuth_rad - b.azimuth_rad;
                libm::remainder(turned, std::f64::consts::TAU).abs() < FOLLOW_TURN_RAD
            }
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
    /// On its way from here, at this speed [m/s], so many ticks to go.
    from: CameraPose,
    set_out: DVec3,
    left: u64,
    /// Where it was a tick ago [m], and how fast it came there [m/s].
    last: DVec3,
    speed: DVec3,
    /// It is led by hand.
    free: Option<Free>,
    /// Half the bed [m].
    half_bed: DVec2,
    room: Room,
}

impl Camera {
    /// The eye over the whole of a table with this bed.
    pub fn new(bed: Option<&Bed>) -> Self {
        let pose = CameraPose::default();
        Camera {
            viewpoint: Viewpoint::Overview,
            turn_rad: 0.0,
            rise_rad: 0.0,
            zoom: 1.0,
            from: pose,
            set_out: DVec3::ZERO,
            left: 0,
            last: pose.eye,
            speed: DVec3::ZERO,
            free: None,
            half_bed: bed.map_or(DVec2::ONE, Bed::half),
            room: Room::round(bed),
        }
    }

    /// Goes to another place, unless it is there already.
    pub fn go_to(&mut self, viewpoint: Viewpoint) {
        if !self.viewpoint.is_like(&viewpoint) {
            self.set_out();
            self.turn_rad = 0.0;
        }
        self.viewpoint = viewpoint;
    }

    /// Leaves from where it is, as fast as it is.
    pub fn set_out(&mut self) {
        self.from = self.pose();
        self.set_out = self.speed.clamp_length_max(SET_OUT_M_S);
        self.left = CAMERA_TICKS;
    }

    /// From here on it is led by hand; or goes back to where it would be.
    pub fn set_free(&mut self, is_free: bool) {
        if is_free && self.free.is_none() {
            self.free = Some(Free::from(&self.pose()));
        } else if !is_free && self.free.is_some() {
            self.set_out();
            self.free = None;
        }
    }

    /// Whether it is led by hand.
    pub fn is_free(&self) -> bool {
        self.free.is_some()
    }

    /// One tick of being led, if it is.
    pub fn drive(&mut self, drive: &Drive) {
        let Some(free) = &mut self.free else { return };
        free.turn(drive.turn_rad_s * TICK_S, drive.rise_rad_s * TICK_S);
        free.go(drive.velocity * TICK_S, &self.room);
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

    /// How the player looks round, in this view.
    pub fn looking(&self, view: View) -> Look {
        let free = self.is_free();
        Look { turn_rad: self.turn_rad, rise_rad: self.rise_rad, zoom: self.zoom, view, free }
    }

    /// The place of the ball that it goes with [m], if it goes with one.
    pub fn rides(&self) -> Option<DVec3> {
        match self.viewpoint {
            _ if self.is_free() => None,
            Viewpoint::Round { ball } | Viewpoint::Follow { ball, .. } => Some(ball),
            _ => None,
        }
    }

    /// A tick passes.
    pub fn step(&mut self) {
        let eye = self.pose().eye;
        self.speed = (eye - self.last) / TICK_S;
        self.last = eye;
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
        // A cubic spline: it leaves as fast as the eye was, and arrives at rest.
        let s = 1.0 - self.left as f64 / CAMERA_TICKS as f64;
        let share = s * s * (3.0 - 2.0 * s);
        let way_s = CAMERA_TICKS as f64 * TICK_S;
        let ahead = self.set_out * (s * (1.0 - s) * (1.0 - s) * way_s);
        CameraPose {
            eye: self.from.eye.lerp(to.eye, share) + ahead,
            target: self.from.target.lerp(to.target, share),
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
            Viewpoint::Follow { ball, aim } => self.behind(ball, aim, FOLLOW),
            Viewpoint::Round { ball } => {
                let (sin, cos) = libm::sincos(ROUND_RISE_RAD);
                self.orbit(ball, DVec3::new(-cos, 0.0, sin) * ROUND_M, usual)
            }
            Viewpoint::Beside(way) => {
                let (beyond_m, height_m) = BESIDE_M;
                let at = way * (self.half_bed + DVec2::splat(beyond_m));
                self.orbit(usual.target, at.extend(height_m) - usual.target, usual)
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
