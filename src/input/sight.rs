//! What a player sees along the cue: which ball is met, how steep the cue must be held.

use super::feel::{ELEVATION_MAX_RAD, ELEVATION_MIN_RAD};
use crate::cue::{Aim, elevation_over_balls};
use crate::events::{ShotKind, Turn};
use crate::ids::BallId;
use crate::physics::Snapshot;
use crate::table::{Bed, Table};
use glam::{DVec2, DVec3};

/// Where a ball's middle is on the bed, if it is in play [m].
pub(super) fn place_of(table: &Snapshot, ball: BallId) -> Option<DVec3> {
    table.on_table().find(|other| other.id == ball).map(|ball| ball.position)
}

/// The middles of the balls in play but this one [m].
pub(super) fn others(table: &Snapshot, ball: BallId) -> impl Iterator<Item = DVec3> + '_ {
    table.on_table().filter(move |other| other.id != ball).map(|ball| ball.position)
}

/// How far the cue ball goes from `centre` along a unit vector until it meets a ball of its size at
/// `place` [m]; none if it passes.
pub(super) fn meets(centre: DVec3, direction: DVec2, place: DVec2) -> Option<f64> {
    let to = place - centre.truncate();
    let (along, beside) = (to.dot(direction), to.perp_dot(direction));
    let rest = 4.0 * centre.z * centre.z - beside * beside;
    (along > 0.0 && rest > 0.0).then(|| along - rest.sqrt())
}

/// Where a turn's first aim points: at the rack's apex on a break, else (or if nobody racked) at
/// the nearest ball that may be met first, and along the table if there is none.
pub(super) fn first_aim(turn: &Turn, table: &Snapshot, bed: Option<&Bed>, from: DVec2) -> DVec2 {
    let is_racked = |apex: &DVec2| {
        others(table, turn.cue_ball).any(|ball| ball.truncate().distance(*apex) < ball.z)
    };
    let apex = bed.map(Bed::foot_spot).filter(|_| turn.shot == ShotKind::Break).filter(is_racked);
    let nearest = || {
        let may_be_met = |id: &BallId| turn.legal_first.contains(id);
        let balls = table.on_table().filter(|ball| may_be_met(&ball.id));
        balls
            .map(|ball| ball.position.truncate())
            .min_by(|a, b| a.distance_squared(from).total_cmp(&b.distance_squared(from)))
    };
    let target = apex.or_else(nearest).unwrap_or(from + DVec2::X);
    (target - from).normalize_or(DVec2::X)
}

/// Smallest elevation at which the cue of `aim` clears hand, rails and balls behind the cue ball
/// [rad].
pub(super) fn elevation_needed(
    aim: Aim,
    centre: DVec3,
    cue_ball: BallId,
    seen: &Snapshot,
    table: &Table,
) -> f64 {
    let places = others(seen, cue_ball).map(DVec3::truncate);
    let over_balls = elevation_over_balls(centre.truncate(), &aim, places, centre.z);
    let over_rail = table.clearance_elevation(centre.truncate(), &aim);
    over_balls.max(over_rail).clamp(ELEVATION_MIN_RAD, ELEVATION_MAX_RAD)
}

/// Where the cue ball's middle is when it meets the first ball or cushion on its straight way
/// [m], and which way the ball that is met leaves; zero if it meets a cushion.
pub fn ghost(
    table: &Snapshot,
    bed: Option<&Bed>,
    cue_ball: BallId,
    centre: DVec3,
    direction: DVec2,
) -> Option<(DVec3, DVec2)> {
    let radius_m = centre.z;
    let from = centre.truncate();
    let met = others(table, cue_ball).filter_map(|ball| {
        let ball = ball.truncate();
        Some((meets(centre, direction, ball)?, ball))
    });
    let first = met.min_by(|a, b| a.0.total_cmp(&b.0));
    let wall = bed.map(|bed| {
        let half = bed.half() - DVec2::splat(radius_m);
        let way = |from: f64, along: f64, half: f64| match along {
            0.0 => f64::INFINITY,
            _ => (half * along.signum() - from) / along,
        };
        way(from.x, direction.x, half.x).min(way(from.y, direction.y, half.y)).max(0.0)
    });
    let at = |way: f64| (from + direction * way).extend(radius_m);
    match (first, wall) {
        (Some((way, ball)), wall) if wall.is_none_or(|wall| way <= wall) => {
            let ghost = at(way.max(0.0));
            Some((ghost, (ball - ghost.truncate()).normalize_or_zero()))
        }
        (_, Some(wall)) => Some((at(wall), DVec2::ZERO)),
        _ => None,
    }
}
