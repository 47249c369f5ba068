//! The break: where the rack may be met.

use super::chance::within;
use super::way::{Window, window};
use super::{Idea, IdeaKind, Position, line};
use crate::ai::geometry::turned;
use crate::ai::plan::LineEnd;
use crate::ai::speed::pot_tip_speed;
use crate::ids::BallId;
use glam::DVec2;
use smallvec::smallvec;

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
    let apart = 2.0 * position.radius();
    let distance = at.distance(position.cue);
    let full = (at - position.cue).try_normalize()?;
    let aside = libm::asin((apart / distance.max(apart) * libm::sin(cut_rad)).clamp(-1.0, 1.0));
    let direction: DVec2 = turned(full, -aside);
    let way = turned(direction, cut_rad);
    let ghost = at - apart * way;
    let free = window(position, position.cue, ghost, &[ball])?;
    if !position.view.bed.holds(ghost, position.radius() - 1e-6) {
        return None;
    }
    let tenth = 0.1 * apart / distance;
    let near = Window { right: -tenth, left: tenth }.and(free);
    let to_ball_m = position.cue.distance(ghost);
    Some(Idea {
        kind: IdeaKind::Break,
        first: Some(ball),
        ball: None,
        pocket: None,
        direction,
        ghost,
        first_way: Some(way),
        cut_rad,
        to_ball_m,
        to_end_m: GOES_M,
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: pot_tip_speed(to_ball_m, cut_rad, GOES_M),
        chance: within(position.sigma_rad, near.right, near.left),
        lines: smallvec![line(position.cue, ghost, LineEnd::Ball(ball))],
    })
}
