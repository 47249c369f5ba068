//! How the cue is held: over rails and balls, and not so hard that the cue ball jumps.

use super::speed::BALL_PER_TIP_SPEED;
use super::view::TableView2d;
use crate::cue::{Aim, elevation_over_balls};
use glam::DVec2;
use std::sync::Arc;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// The lowest butt [rad]: the hand needs room above the cloth.
const ELEVATION_MIN_RAD: f64 = 2.0 * DEGREE;
/// The highest [rad].
pub(super) const ELEVATION_MAX_RAD: f64 = 60.0 * DEGREE;
/// Restitution of a ball on the cloth that the player reckons with.
const CLOTH_RESTITUTION: f64 = 0.5;
/// Fastest upward speed of a cue ball that is struck with a raised cue [m/s]: it hops 18 mm, so it
/// does not jump over the ball that it shall meet.
const HOP_SPEED_M_S: f64 = 0.6;

/// How a player knows how steep the cue must be held to pass over the rails [rad], for a cue ball
/// at a place [m] and an azimuth [rad].
pub type Clearance = Arc<dyn Fn(DVec2, f64) -> f64 + Send + Sync>;

/// How steep the cue of `aim` is held over rails and balls [rad]; none if no hand can hold it so.
pub(super) fn elevation(
    view: &TableView2d,
    cue_ball: DVec2,
    aim: &Aim,
    over_rail_rad: f64,
) -> Option<f64> {
    let others = view.balls.iter().map(|ball| ball.position);
    let over_balls = elevation_over_balls(cue_ball, aim, others, view.ball_radius_m);
    let needed = over_balls.max(over_rail_rad).max(ELEVATION_MIN_RAD);
    (needed <= ELEVATION_MAX_RAD).then_some(needed)
}

/// Speed of a tip that drives the ball along the bed like a level cue of `level_m_s` would, as far
/// as the ball does not hop too high [m/s]: only the horizontal part drives it along.
pub(super) fn tip_speed(level_m_s: f64, elevation_rad: f64) -> f64 {
    let (sin, cos) = libm::sincos(elevation_rad);
    let hop_limit = HOP_SPEED_M_S / (CLOTH_RESTITUTION * BALL_PER_TIP_SPEED * sin);
    (level_m_s / cos).min(hop_limit)
}
