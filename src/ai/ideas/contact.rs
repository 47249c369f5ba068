//! Meet a ball to pocket nothing: material for safeties.

use super::chance::within;
use super::way::{Window, window};
use super::{Idea, IdeaKind, Position, diagonally, line};
use crate::ai::geometry::turned;
use crate::ai::plan::LineEnd;
use crate::ai::speed::pot_tip_speed;
use crate::ids::BallId;
use glam::DVec2;
use smallvec::smallvec;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Cuts at which a ball is met [rad]: full, a quarter, thin, half, three quarters.
const CUTS_RAD: [f64; 9] = [
    0.0,
    49.0 * DEGREE,
    -49.0 * DEGREE,
    68.0 * DEGREE,
    -68.0 * DEGREE,
    30.0 * DEGREE,
    -30.0 * DEGREE,
    14.0 * DEGREE,
    -14.0 * DEGREE,
];
/// How far the met ball shall at least go [m]: to a rail, softly, across the table.
const GOES_M: [f64; 3] = [0.6, 0.15, 2.5];

/// Legal balls full and thin on either side, from soft to firm.
pub(super) fn contacts(position: &Position<'_>, found: &mut Vec<Idea>) {
    let balls = position.nearest_legal();
    for to_end_m in GOES_M {
        for (n, cut) in diagonally(balls.len(), CUTS_RAD.len()) {
            let ((ball, at), cut_rad) = (balls[n], CUTS_RAD[cut]);
            let Some((contact, edges)) = met(position, ball, at, cut_rad) else { continue };
            found.push(Idea {
                to_end_m,
                speed_least_m_s: pot_tip_speed(contact.to_ball_m, cut_rad, to_end_m),
                chance: within(position.sigma_rad, edges.right, edges.left),
                ..contact
            });
        }
    }
}

/// The cue ball straight to a ball at this cut, and how far it may turn until it does not meet that
/// ball first; none if another is in the way. How hard and how likely is left open.
pub(super) fn met(
    position: &Position<'_>,
    ball: BallId,
    at: DVec2,
    cut_rad: f64,
) -> Option<(Idea, Window)> {
    let (radius, distance) = (position.radius(), at.distance(position.cue));
    let full = (at - position.cue).try_normalize()?;
    let apart = 2.0 * radius;
    // A way that passes the ball's middle at 2 R sin β has the cut β.
    let aside = libm::asin((apart / distance.max(apart) * libm::sin(cut_rad)).clamp(-1.0, 1.0));
    let direction = turned(full, -aside);
    let way = turned(direction, cut_rad);
    let ghost = at - apart * way;
    if !position.view.bed.holds(ghost, radius - 1e-6) {
        return None;
    }
    let to_ball_m = position.cue.distance(ghost);
    // A touching cue ball has no way to go.
    let touches = to_ball_m < 1e-6;
    let free = if touches { Window::OPEN } else { window(position, position.cue, ghost, &[ball])? };
    let edge = libm::asin((apart / distance.max(apart)).min(1.0));
    let edges = Window { right: -edge, left: edge }.seen_from(-aside).and(free);
    let idea = Idea {
        kind: IdeaKind::Contact,
        first: Some(ball),
        ball: None,
        pocket: None,
        direction,
        ghost,
        first_way: Some(way),
        cut_rad,
        to_ball_m,
        to_end_m: 0.0,
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: 0.0,
        chance: 0.0,
        lines: smallvec![line(position.cue, ghost, LineEnd::Ball(ball))],
    };
    Some((idea, edges))
}

/// At the nearest legal ball, whatever is in the way; without one, up the table.
pub(super) fn desperate(position: &Position<'_>) -> Option<Idea> {
    let nearest = position
        .lying(&position.goal.legal)
        .chain(position.view.balls.iter().map(|ball| (ball.id, ball.position)))
        .map(|(ball, at)| (ball, at, position.cue.distance(at)))
        .reduce(|best, next| if next.2 < best.2 { next } else { best });
    let (ball, at, distance) = nearest?;
    let direction = (at - position.cue).normalize_or(DVec2::X);
    let apart = 2.0 * position.radius();
    let mut drawn = line(position.cue, at, LineEnd::Ball(ball));
    drawn.free = false;
    Some(Idea {
        kind: IdeaKind::Desperate,
        first: Some(ball),
        ball: None,
        pocket: None,
        direction,
        ghost: at - apart * direction,
        first_way: Some(direction),
        cut_rad: 0.0,
        to_ball_m: (distance - apart).max(0.0),
        to_end_m: GOES_M[0],
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: pot_tip_speed((distance - apart).max(0.0), 0.0, GOES_M[0]),
        chance: 0.0,
        lines: smallvec![drawn],
    })
}
