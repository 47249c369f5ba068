//! How mouse, keyboard and gamepad feel: every gain and time constant of the hand, with its unit.
//!
//! Movements of the mouse come in heights of the window, so that a gain does not depend on the
//! window's size. Whoever computes movements for a script uses the same numbers.

use crate::units::{Seconds, TICK_S};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// How far the aim turns when the mouse crosses the window's height [rad]. A pixel of a window
/// 1080 high is then 1 mm at a distance of 1.1 m: as fine as a pot across the table needs.
pub const AIM_RAD_PER_HEIGHT: f64 = 1.0;
/// What holding Shift makes of aim, tip offset and elevation: a tenth, for the last bit of aim.
pub const FINE: f64 = 0.1;
/// How far the tip's offset goes when the mouse crosses the window's height, in ball radii: from
/// one end of its range to the other in half a window.
pub const OFFSET_PER_HEIGHT: f64 = 2.0;
/// How fast an arrow key moves the tip's offset [ball radii/s]: two seconds to the limit.
pub const OFFSET_PER_S: f64 = 0.25;
/// How fast Page up and Page down raise and lower the butt [rad/s].
pub const ELEVATION_RAD_PER_S: f64 = 15.0 * DEGREE;
/// How far one notch of the wheel does, with Control held [rad].
pub const ELEVATION_RAD_PER_NOTCH: f64 = 1.0 * DEGREE;
/// The lowest butt [rad]: the hand needs room above the cloth.
pub const ELEVATION_MIN_RAD: f64 = 2.0 * DEGREE;
/// The highest [rad]: beyond it nobody holds a cue with a bridge.
pub const ELEVATION_MAX_RAD: f64 = 60.0 * DEGREE;

/// How far the tip goes when the mouse crosses the window's height [m]. A swing across half a
/// window in 50 ms is a stroke of 6 m/s.
pub const STROKE_M_PER_HEIGHT: f64 = 0.6;
/// Gap between tip and ball before a stroke [m]: near, but never in the ball.
pub const ADDRESS_GAP_M: f64 = 0.03;
/// How far the tip can be pulled back from the ball [m]: the length of a bridge. What the mouse
/// goes beyond is forgotten, so that pushing acts at once.
pub const PULL_MAX_M: f64 = 0.40;
/// The rate of the filter between mouse and tip [rad/s]: critically damped, time constant
/// 1/60 s. The tip lags the hand by two time constants; a faster filter lets the bursts in which
/// windows hand on a mouse be felt as jerks of the tip's speed.
pub const STROKE_FILTER_RAD_S: f64 = 60.0;
/// The tip's greatest speed [m/s]: about that of the hardest break of a professional.
pub const STROKE_SPEED_MAX_M_S: f64 = 12.0;
/// The tip's greatest acceleration [m/s²]: the greatest speed within 0.18 m, faster than any arm.
pub const STROKE_ACCELERATION_MAX_M_S2: f64 = 400.0;
/// A movement is spread evenly over the time since the last one, and over this at most [ticks]: a
/// window that draws 25 pictures a second still moves the tip smoothly.
pub const SPREAD_MAX_TICKS: usize = 40;
/// Over which time the first movement after a rest is spread [ticks]: a picture at 60 Hz.
pub const SPREAD_FIRST_TICKS: usize = 17;
/// How long a piece of the tip's path holds [s]. The next tick's replaces it after 1 ms; what is
/// longer bridges solver steps that do not begin with a tick.
pub const PIECE_S: Seconds = 5.0 * TICK_S;

/// How far the camera turns and rises when the mouse crosses the window's height, while looking
/// round [rad].
pub const LOOK_RAD_PER_HEIGHT: f64 = 2.5;
/// How fast keys move an eye that is led by hand [m/s]: a walk.
pub const FLY_M_PER_S: f64 = 1.2;
/// How fast they turn it [rad/s].
pub const FLY_RAD_PER_S: f64 = 1.0;
/// What one notch of the wheel makes of the camera's distance.
pub const ZOOM_PER_NOTCH: f64 = 0.9;
/// Bounds of the zoom, as a factor of the usual distance.
pub const ZOOM: std::ops::RangeInclusive<f64> = 0.25..=2.5;
/// How long the camera takes from one place to another [ticks]: fast, but the eye can follow.
pub const CAMERA_TICKS: u64 = 350;
/// How far the cue ball goes over the bed when the mouse crosses the window's height, while it is
/// placed [m]: what the bird's eye sees over this height, so that the ball keeps to the pointer.
pub const PLACING_M_PER_HEIGHT: f64 = 1.842;

/// How fast `a` and `d` turn the cue [rad/s]; with Shift a tick turns it by 0.04 mrad.
pub const AIM_RAD_PER_S: f64 = 0.4;
/// How fast arrow keys move a ball in hand [m/s].
pub const PLACING_M_PER_S: f64 = 0.5;
/// How fast the tip is pulled back while Return is held [m/s]: a second and a half to the end.
pub const KEY_PULL_M_PER_S: f64 = 0.26;
/// Speed of the tip in the softest stroke by a key [m/s], and in the hardest.
pub const KEY_SPEED_LEAST_M_S: f64 = 0.3;
/// See above.
pub const KEY_SPEED_MOST_M_S: f64 = 8.0;

/// How much faster a stick that is pushed out fully turns the cue than a key does: half a turn in
/// under three seconds; its curve makes it finer than a key near the middle.
pub const STICK_TURN: f64 = 3.0;
/// The same for a ball in hand.
pub const STICK_PLACING: f64 = 2.0;
/// How fast a stick looks round [rad/s].
pub const LOOK_RAD_PER_S: f64 = 1.5;
/// How fast the tip follows a trigger, backwards and forwards [m/s]: a third of a second to the
/// end. The tip shows how far it is, so what is seen is what strikes.
pub const TRIGGER_PULL_M_PER_S: f64 = 1.2;
/// A trigger that is pressed no farther than this rests [share of its way].
pub const TRIGGER_BEGIN: f64 = 0.08;
