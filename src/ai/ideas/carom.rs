//! The cue ball off a first ball to another.

use super::chance::{CAROM_RAD, gain};
use super::pot::{chance, meeting};
use super::second::{Second, by_another};
use super::trace;
use super::way::window;
use super::{CHANCE_LEAST, Idea, IdeaKind, Position, line};
use crate::ai::geometry::signed_angle;
use crate::ai::plan::LineEnd;
use crate::ai::speed::{BALL_PER_TIP_SPEED, before_meeting, launch_speed, launch_to_pocket};
use crate::ids::BallId;
use glam::DVec2;
use smallvec::smallvec;

/// Of the cue ball's speed at a first ball, at least this share must be left across it.
const SHARE_LEAST: f64 = 0.25;

/// With pockets an own ball by the cue ball that comes off another; without, both others.
pub(super) fn caroms(position: &Position<'_>, found: &mut Vec<Idea>) {
    if position.view.pockets.is_empty() {
        trace::both_balls(position, found);
        return;
    }
    for (second, first, first_at) in by_another(position) {
        found.extend([1.0, -1.0].into_iter().filter_map(|side| {
            carom(position, first, first_at, &second, side)
                .filter(|idea| idea.chance >= CHANCE_LEAST)
        }));
    }
}

/// A sliding cue ball leaves along the tangent: its ghost at the first ball is where a tangent from
/// the ghost at the second touches the circle of ghosts. `side` tells which of both tangents.
fn carom(
    position: &Position<'_>,
    first: BallId,
    first_at: DVec2,
    second: &Second,
    side: f64,
) -> Option<Idea> {
    let apart = 2.0 * position.radius();
    let ghost_2 = second.at - apart * second.entry.way;
    let from_first = ghost_2 - first_at;
    let distance_sq = from_first.length_squared();
    if distance_sq <= apart * apart * 1.01 || !position.view.bed.holds(ghost_2, position.radius()) {
        return None;
    }
    let tangent_m = (distance_sq - apart * apart).sqrt();
    let ghost_1 = first_at
        + from_first * (apart * apart / distance_sq)
        + from_first.perp() * (side * apart * tangent_m / distance_sq);
    let normal = (first_at - ghost_1).try_normalize()?;
    let direction = (ghost_1 - position.cue).try_normalize()?;
    let glance = (ghost_2 - ghost_1).try_normalize()?;
    let (fullness, share) = (direction.dot(normal), direction.dot(glance));
    if fullness < 0.1 || share < SHARE_LEAST || !position.view.bed.holds(ghost_1, position.radius())
    {
        return None;
    }
    let cut_2 = signed_angle(glance, second.entry.way);
    meeting(position, ghost_1, second.at, second.entry.way)?;
    let free = window(position, position.cue, ghost_1, &[first])?;
    let between = window(position, ghost_1, ghost_2, &[first, second.ball])?;

    let to_ball_m = position.cue.distance(ghost_1);
    let cut_rad = signed_angle(direction, normal);
    let gain_1 = gain(to_ball_m, cut_rad, position.radius());
    let gain_2 = gain(tangent_m, cut_2, position.radius());
    let glance_allowed = between.and(free.passed_on(gain_1));
    let allowed = second.entry.window.and(glance_allowed.passed_on(gain_2));
    let to_pocket_m = second.at.distance(second.entry.target);
    let glance_m_s =
        launch_speed(tangent_m, before_meeting(cut_2, launch_to_pocket(&[to_pocket_m])));
    let tip_m_s = launch_speed(to_ball_m, glance_m_s / share) / BALL_PER_TIP_SPEED;
    let sigma_rad = gain_1 * gain_2 * position.sigma_rad;
    Some(Idea {
        kind: IdeaKind::Carom,
        first: Some(first),
        ball: Some(second.ball),
        pocket: Some(second.pocket),
        direction,
        ghost: ghost_1,
        first_way: Some(normal),
        cut_rad,
        to_ball_m,
        to_end_m: tangent_m + to_pocket_m,
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: tip_m_s,
        chance: chance(sigma_rad, gain_2 * CAROM_RAD, allowed),
        lines: smallvec![
            line(position.cue, ghost_1, LineEnd::Ball(first)),
            line(ghost_1, ghost_2, LineEnd::Ball(second.ball)),
            line(second.at, second.entry.target, LineEnd::Pocket(second.ball, second.pocket)),
        ],
    })
}
