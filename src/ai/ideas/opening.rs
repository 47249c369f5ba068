//! The break: where the rack may be met.

use super::chance::within;
use super::contact::met;
use super::way::Window;
use super::{Idea, IdeaKind, Position};
use crate::ai::speed::pot_tip_speed;
use crate::ids::BallId;
use glam::DVec2;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Cuts at which a ball of the rack is met [rad]: full, a little off, half, a quarter, thin.
const CUTS_RAD: [f64; 11] = [
    0.0,
    4.0 * DEGREE,
    -4.0 * DEGREE,
    10.0 * DEGREE,
    -10.0 * DEGREE,
    30.0 * DEGREE,
    -30.0 * DEGREE,
    49.0 * DEGREE,
    -49.0 * DEGREE,
    64.0 * DEGREE,
    -64.0 * DEGREE,
];
/// How far the balls go at least [m].
const GOES_M: f64 = 2.5;

/// Every legal ball that can be seen, at several cuts: in a rack those of its front and its
/// corners. The chance is that of meeting it so within a tenth of a ball.
pub(super) fn breaks(position: &Position<'_>, found: &mut Vec<Idea>) {
    for (ball, at) in position.lying(&position.goal.legal) {
        for cut in CUTS_RAD {
            found.extend(one(position, ball, at, cut));
        }
    }
}

fn one(position: &Position<'_>, ball: BallId, at: DVec2, cut_rad: f64) -> Option<Idea> {
    let (contact, edges) = met(position, ball, at, cut_rad)?;
    let tenth = 0.1 * 2.0 * position.radius() / at.distance(position.cue);
    let near = Window { right: -tenth, left: tenth }.and(edges);
    Some(Idea {
        kind: IdeaKind::Break,
        to_end_m: GOES_M,
        speed_least_m_s: pot_tip_speed(contact.to_ball_m, cut_rad, GOES_M),
        chance: within(position.sigma_rad, near.right, near.left),
        ..contact
    })
}
