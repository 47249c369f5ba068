//! A ball into a pocket by another one.

use super::chance::{FROZEN_RAD, THROW_RAD};
use super::pot::{chance, meeting};
use super::second::{Second, by_another};
use super::way::window;
use super::{CHANCE_LEAST, Idea, IdeaKind, Position, line};
use crate::ai::geometry::{signed_angle, turned};
use crate::ai::plan::LineEnd;
use crate::ai::speed::{BALL_PER_TIP_SPEED, before_meeting, launch_speed, launch_to_pocket};
use crate::ids::BallId;
use glam::DVec2;
use smallvec::smallvec;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Largest cut at the second ball [rad].
const CUT_LIMIT_RAD: f64 = 60.0 * DEGREE;
/// Balls that are no farther apart touch for a player's purposes [m].
const TOUCHING_M: f64 = 0.0015;
/// Ways of the first of two touching balls, off the line through both [rad].
const FROZEN_WAYS_RAD: [f64; 5] =
    [0.0, 20.0 * DEGREE, -20.0 * DEGREE, 40.0 * DEGREE, -40.0 * DEGREE];

/// Own balls by any legal ball.
pub(super) fn combinations(position: &Position<'_>, found: &mut Vec<Idea>) {
    for (second, first, first_at) in by_another(position) {
        let apart = second.at.distance(first_at) - 2.0 * position.radius();
        if apart < TOUCHING_M {
            frozen(position, first, first_at, &second, found);
        } else {
            found.extend(combination(position, first, first_at, &second));
        }
    }
    found.retain(|idea| idea.kind != IdeaKind::Combination || idea.chance >= CHANCE_LEAST);
}

fn combination(
    position: &Position<'_>,
    first: BallId,
    first_at: DVec2,
    second: &Second,
) -> Option<Idea> {
    let hit = meeting(position, first_at, second.at, second.entry.way)?;
    if hit.cut_rad.abs() > CUT_LIMIT_RAD {
        return None;
    }
    let stroke = meeting(position, position.cue, first_at, hit.direction)?;
    let between = window(position, first_at, hit.ghost, &[first, second.ball])?;
    let free = window(position, position.cue, stroke.ghost, &[first])?;

    let (gain_1, gain_2) = (stroke.gain(position), hit.gain(position));
    let first_allowed = between.and(free.passed_on(gain_1));
    let allowed = second.entry.window.and(first_allowed.passed_on(gain_2));
    let to_pocket_m = second.at.distance(second.entry.target);
    let second_m_s = launch_to_pocket(&[to_pocket_m]);
    let first_m_s = launch_speed(hit.to_ghost_m, before_meeting(hit.cut_rad, second_m_s));
    let sigma_rad = gain_1 * gain_2 * position.sigma_rad;
    Some(Idea {
        kind: IdeaKind::Combination,
        first: Some(first),
        ball: Some(second.ball),
        pocket: Some(second.pocket),
        direction: stroke.direction,
        ghost: stroke.ghost,
        first_way: Some(hit.direction),
        cut_rad: stroke.cut_rad,
        to_ball_m: stroke.to_ghost_m,
        to_end_m: hit.to_ghost_m + to_pocket_m,
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: tip_speed(stroke.to_ghost_m, stroke.cut_rad, first_m_s),
        chance: chance(sigma_rad, gain_2 * THROW_RAD, allowed),
        lines: smallvec![
            line(position.cue, stroke.ghost, LineEnd::Ball(first)),
            line(first_at, hit.ghost, LineEnd::Ball(second.ball)),
            line(second.at, second.entry.target, LineEnd::Pocket(second.ball, second.pocket)),
        ],
    })
}

/// Of touching balls the second leaves along the line through both, however the first is pushed.
fn frozen(
    position: &Position<'_>,
    first: BallId,
    first_at: DVec2,
    second: &Second,
    found: &mut Vec<Idea>,
) {
    let Some(centres) = (second.at - first_at).try_normalize() else { return };
    let off = signed_angle(second.entry.way, centres);
    let allowed = second.entry.window.seen_from(off);
    let to_pocket_m = second.at.distance(second.entry.target);
    let second_m_s = launch_to_pocket(&[to_pocket_m]);
    found.extend(FROZEN_WAYS_RAD.into_iter().filter_map(|aside| {
        let way = turned(centres, aside);
        let stroke = meeting(position, position.cue, first_at, way)?;
        let free = window(position, position.cue, stroke.ghost, &[first])?;
        // Throw is the larger the more the first ball is pushed across.
        let thrown = FROZEN_RAD * (0.5 + aside.abs());
        let meets = chance(position.sigma_rad, 0.0, free);
        let first_m_s = before_meeting(aside, second_m_s);
        Some(Idea {
            kind: IdeaKind::Combination,
            first: Some(first),
            ball: Some(second.ball),
            pocket: Some(second.pocket),
            direction: stroke.direction,
            ghost: stroke.ghost,
            first_way: Some(way),
            cut_rad: stroke.cut_rad,
            to_ball_m: stroke.to_ghost_m,
            to_end_m: to_pocket_m,
            cushions: 0,
            height_offset: 0.0,
            speed_least_m_s: tip_speed(stroke.to_ghost_m, stroke.cut_rad, first_m_s),
            chance: meets * chance(thrown, 0.0, allowed),
            lines: smallvec![
                line(position.cue, stroke.ghost, LineEnd::Ball(first)),
                line(second.at, second.entry.target, LineEnd::Pocket(second.ball, second.pocket)),
            ],
        })
    }));
}

fn tip_speed(to_ghost_m: f64, cut_rad: f64, first_m_s: f64) -> f64 {
    launch_speed(to_ghost_m, before_meeting(cut_rad, first_m_s)) / BALL_PER_TIP_SPEED
}
