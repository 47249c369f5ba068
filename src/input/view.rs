//! What a player at mouse and keyboard sees and does, for the picture.

use super::{BallWay, CallView};
use crate::cue::Aim;
use crate::ids::BallId;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// From where the picture is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraPose {
    /// The eye [m].
    pub eye: DVec3,
    /// What it looks at [m].
    pub target: DVec3,
    /// Vertical field of view [rad].
    pub field_of_view_rad: f64,
}

impl Default for CameraPose {
    /// The whole table from behind its head.
    fn default() -> Self {
        CameraPose {
            eye: DVec3::new(-2.6, -1.1, 1.5),
            target: DVec3::new(0.0, 0.0, -0.1),
            field_of_view_rad: 42.0 * std::f64::consts::PI / 180.0,
        }
    }
}

/// How far the eye above a table is off the vertical towards −y, so that it knows which way is up
/// [m].
const ASIDE_M: f64 = 0.02;
/// How high it is, in lengths of the bed: high enough for a picture that is wider than high.
const ABOVE_LENGTHS: f64 = 1.1;

impl CameraPose {
    /// The whole of a table with a bed of this length [m] from above; its head is on the left.
    pub fn above(length_m: f64) -> Self {
        let eye = DVec3::new(0.0, -ASIDE_M, ABOVE_LENGTHS * length_m);
        CameraPose { eye, target: DVec3::ZERO, ..CameraPose::default() }
    }

    /// The same, with everything so far to the left in the picture [m].
    #[must_use]
    pub fn aside(self, by_m: f64) -> Self {
        let ahead = (self.target - self.eye).normalize_or_zero();
        let by = ahead.cross(DVec3::Z).normalize_or_zero() * by_m;
        CameraPose { eye: self.eye + by, target: self.target + by, ..self }
    }

    /// The point at this height [m] that is seen at a place of the picture, in its heights from its
    /// middle, to the right and upwards [m]; none above the horizon.
    pub fn on_level(&self, at: DVec2, height_m: f64) -> Option<DVec2> {
        let ahead = (self.target - self.eye).normalize_or_zero();
        let right = ahead.cross(DVec3::Z).normalize_or_zero();
        let up = right.cross(ahead);
        let reach = 2.0 * libm::tan(0.5 * self.field_of_view_rad);
        let way = ahead + (right * at.x + up * at.y) * reach;
        let far = (height_m - self.eye.z) / way.z;
        (0.0 < far && far < 100.0).then(|| (self.eye + way * far).truncate())
    }

    /// Where a point of the world [m] is in a picture of this width by height: from its left and
    /// from its top, in shares of both; none if it is behind the eye.
    pub fn place_of(&self, point: DVec3, aspect: f64) -> Option<[f64; 2]> {
        let ahead = (self.target - self.eye).normalize_or_zero();
        let right = ahead.cross(DVec3::Z).normalize_or_zero();
        let up = right.cross(ahead);
        let way = point - self.eye;
        let depth = way.dot(ahead);
        let reach = depth * libm::tan(0.5 * self.field_of_view_rad);
        let place =
            [0.5 + 0.5 * way.dot(right) / (reach * aspect), 0.5 - 0.5 * way.dot(up) / reach];
        (depth > 1e-6).then_some(place)
    }
}

/// From where a player likes to look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum View {
    /// Behind the cue, over the stroke that was made, or over the table.
    #[default]
    Usual,
    /// From above.
    Bird,
    /// Round the cue ball, wherever it rolls.
    Round,
    /// Behind the cue ball, wherever it rolls.
    Follow,
    /// From the head of the table.
    Head,
    /// From its foot.
    Foot,
    /// From its long side.
    Side,
}

impl View {
    /// All, in the order in which they follow each other.
    pub const ALL: [View; 7] =
        [View::Usual, View::Bird, View::Round, View::Follow, View::Head, View::Foot, View::Side];

    /// The next.
    #[must_use]
    pub fn next(self) -> Self {
        let at = View::ALL.iter().position(|one| *one == self).unwrap_or(0);
        View::ALL[(at + 1) % View::ALL.len()]
    }

    /// The key of its name in the texts.
    pub fn name(self) -> &'static str {
        match self {
            View::Usual => "view_usual",
            View::Bird => "view_bird",
            View::Round => "view_round",
            View::Follow => "view_follow",
            View::Head => "view_head",
            View::Foot => "view_foot",
            View::Side => "view_side",
        }
    }
}

/// How the player looks round from the usual place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// To the left, and upwards [rad].
    pub turn_rad: f64,
    /// See above.
    pub rise_rad: f64,
    /// Distance over the usual one.
    pub zoom: f64,
    /// From where.
    pub view: View,
    /// The eye is led by hand.
    pub free: bool,
}

impl Default for Look {
    fn default() -> Self {
        Look { turn_rad: 0.0, rise_rad: 0.0, zoom: 1.0, view: View::Usual, free: false }
    }
}

/// What the player is doing.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum HumanMode {
    /// Somebody else is at the table, or balls roll.
    #[default]
    Watching,
    /// Puts a ball down.
    Placing,
    /// Must say how it goes on; the pointer is free.
    Choosing,
    /// Turns the cue, sets tip offset and elevation.
    Aiming,
    /// Calls a pocket by pointing at it.
    Pointing,
    /// Has the cue ball before a stylus, which strikes.
    HoldingStylus,
    /// Holds the cue for a stroke: pulling back and pushing moves the tip.
    Stroking,
    /// Time stands still.
    Paused,
}

/// What the picture shows of the player.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HumanView {
    /// The camera.
    pub camera: CameraPose,
    /// The camera goes with this ball: it is meant for where the ball was here [m].
    pub rides: Option<(BallId, DVec3)>,
    /// What the player is doing.
    pub mode: HumanMode,
    /// The ball that is struck.
    pub cue_ball: BallId,
    /// How the cue is held, while aiming and stroking.
    pub aim: Aim,
    /// How far the tip is from where it meets the ball [m], backwards, while stroking.
    pub pulled_back_m: f64,
    /// Speed of the tip at its last contact with the cue ball, or now while stroking [m/s].
    pub strength_m_s: f64,
    /// Where a ball would be put down [m], while placing.
    pub placing: Option<DVec2>,
    /// Which ball that is.
    pub placing_ball: BallId,
    /// It may be put there.
    pub placing_allowed: bool,
    /// What is pointed at on the bed [m], while a pocket is called so.
    pub pointing: Option<DVec2>,
    /// Where the cue ball's centre is when it meets the first ball or cushion on its straight way
    /// [m], while aiming; none if nothing is aimed at.
    pub ghost: Option<DVec3>,
    /// Which way the ball that is met there leaves, without friction: a unit vector; zero if it
    /// meets a cushion.
    pub object_heading: DVec2,
    /// Where the cue ball and the first ball that it meets will go, while aiming, if that is
    /// wanted.
    pub ways: Arc<Vec<BallWay>>,
    /// How hard the stroke is taken to be for that [m/s].
    pub expected_m_s: f64,
    /// What is announced with the stroke, while aiming.
    pub call: Option<CallView>,
    /// Any ball can be put anywhere, and shots can be taken back.
    pub is_practice: bool,
    /// Nobody plays here: the player only looks on.
    pub looks_on: bool,
    /// How the player looks round, for a camera that follows something else.
    pub look: Look,
    /// The panel of the haptic device is not as the scene begins with it: shown or hidden.
    pub overlay: bool,
}
