//! Straight into a pocket.

use super::chance::{both, gain, within};
use super::mouth::{Entry, entries};
use super::way::{Window, window};
use super::{Idea, IdeaKind, Position, line};
use crate::ai::geometry::{signed_angle, turned};
use crate::ai::plan::LineEnd;
use crate::ai::speed::pot_tip_speed;
use crate::ids::BallId;
use glam::DVec2;
use smallvec::smallvec;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Largest cut [rad].
pub(super) const CUT_LIMIT_RAD: f64 = 78.0 * DEGREE;
/// Aim is taken so far off the line to where the ball shall go, over the cut: throw turns it back.
const THROW: f64 = 0.07;
/// Where in a gap a ball is sent, from its middle over half its width.
const AIMS: [f64; 5] = [0.0, -0.4, 0.4, -0.7, 0.7];

/// The cue ball's part of a shot: meet a ball so that it leaves along a way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    pub(super) ghost: DVec2,
    pub(super) direction: DVec2,
    pub(super) cut_rad: f64,
    pub(super) to_ghost_m: f64,
}

impl Meeting {
    /// How many times the met ball's way turns as far as the cue ball's.
    pub(super) fn gain(&self, position: &Position<'_>) -> f64 {
        gain(self.to_ghost_m, self.cut_rad, position.radius())
    }
}

/// How a ball from `from` must meet one at `ball` so that this leaves along `way`; none if the cut
/// is too thin or there is no room for the ghost.
pub(super) fn meeting(
    position: &Position<'_>,
    from: DVec2,
    ball: DVec2,
    way: DVec2,
) -> Option<Meeting> {
    let apart = 2.0 * position.radius();
    let mut ghost = ball - apart * way;
    let mut direction = (ghost - from).try_normalize()?;
    let mut cut_rad = signed_angle(direction, way);
    // The cut depends a little on where the ghost is, which depends on the cut.
    for _ in 0..5 {
        if cut_rad.abs() > CUT_LIMIT_RAD {
            return None;
        }
        ghost = ball - apart * turned(way, THROW * cut_rad);
        direction = (ghost - from).try_normalize()?;
        cut_rad = signed_angle(direction, way);
    }
    let is_possible =
        cut_rad.abs() <= CUT_LIMIT_RAD && position.view.bed.holds(ghost, position.radius() - 1e-6);
    is_possible.then(|| Meeting { ghost, direction, cut_rad, to_ghost_m: from.distance(ghost) })
}

/// Own balls into pockets.
pub(super) fn pots(position: &Position<'_>, found: &mut Vec<Idea>) {
    for &ball in &position.goal.own {
        let Some(at) = position.view.position(ball) else { continue };
        for pocket in &position.view.pockets {
            for entry in entries(position, at, pocket, &[ball]) {
                let best = AIMS
                    .iter()
                    .map(|aim| entry.aimed(at, 0.5 * aim * entry.window.width()))
                    .filter_map(|entry| pot(position, ball, at, pocket.id, &entry))
                    // Of equals the first: nearest to the middle.
                    .reduce(|best, next| if next.chance > best.chance { next } else { best });
                found.extend(best);
            }
        }
    }
}

/// This ball into this pocket through this gap.
pub(super) fn pot(
    position: &Position<'_>,
    ball: BallId,
    at: DVec2,
    pocket: crate::ids::PocketId,
    entry: &Entry,
) -> Option<Idea> {
    let meeting = meeting(position, position.cue, at, entry.way)?;
    let free = window(position, position.cue, meeting.ghost, &[ball])?;
    let gain = meeting.gain(position);
    let allowed = entry.window.and(free.passed_on(gain));
    let to_end_m = at.distance(entry.target);
    Some(Idea {
        kind: IdeaKind::Pot,
        first: Some(ball),
        ball: Some(ball),
        pocket: Some(pocket),
        direction: meeting.direction,
        ghost: meeting.ghost,
        first_way: Some(entry.way),
        cut_rad: meeting.cut_rad,
        to_ball_m: meeting.to_ghost_m,
        to_end_m,
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: pot_tip_speed(meeting.to_ghost_m, meeting.cut_rad, to_end_m),
        chance: chance(gain * position.sigma_rad, 0.0, allowed),
        lines: smallvec![
            line(position.cue, meeting.ghost, LineEnd::Ball(ball)),
            line(at, entry.target, LineEnd::Pocket(ball, pocket)),
        ],
    })
}

/// Probability that a way stays in its window whose error has two independent parts.
pub(super) fn chance(sigma_rad: f64, more_rad: f64, window: Window) -> f64 {
    within(both(sigma_rad, more_rad), window.right, window.left)
}
