//! The break: where the rack may be met.

use super::chance::within;
use super::contact::met;
use super::{Idea, IdeaKind, Position, diagonally};
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

/// Cuts that only brush a corner of the rack [rad].
const BRUSH_RAD: [f64; 2] = [64.0 * DEGREE, 49.0 * DEGREE];

/// Every legal ball that can be seen, at several cuts: in a rack those of its front and its
/// corners. The chance is that of meeting it first.
///
/// First the nearest in full, then the outermost on either side from outside, as snooker opens.
pub(super) fn breaks(position: &Position<'_>, found: &mut Vec<Idea>) {
    let balls = position.nearest_legal();
    let mut first: Vec<(BallId, DVec2, f64)> = Vec::new();
    first.extend(balls.first().map(|(ball, at)| (*ball, *at, 0.0)));
    let by_side = |a: &&(BallId, DVec2), b: &&(BallId, DVec2)| a.1.y.total_cmp(&b.1.y);
    for cut in BRUSH_RAD {
        first.extend(balls.iter().max_by(by_side).map(|(ball, at)| (*ball, *at, -cut)));
        first.extend(balls.iter().min_by(by_side).map(|(ball, at)| (*ball, *at, cut)));
    }
    let all = diagonally(balls.len(), CUTS_RAD.len())
        .map(|(n, cut)| (balls[n].0, balls[n].1, CUTS_RAD[cut]))
        .filter(|shot| !first.contains(shot));
    let wanted = first.iter().copied().chain(all);
    found.extend(wanted.filter_map(|(ball, at, cut)| one(position, ball, at, cut)));
}

fn one(position: &Position<'_>, ball: BallId, at: DVec2, cut_rad: f64) -> Option<Idea> {
    let (contact, edges) = met(position, ball, at, cut_rad)?;
    Some(Idea {
        kind: IdeaKind::Break,
        to_end_m: GOES_M,
        speed_least_m_s: pot_tip_speed(contact.to_ball_m, cut_rad, GOES_M),
        chance: within(position.sigma_rad, edges.right, edges.left),
        ..contact
    })
}
