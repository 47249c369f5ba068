//! Straight ways of balls: what is in them, how far they may turn, where they bounce.

use super::Position;
use crate::ai::geometry::signed_angle;
use crate::ids::BallId;
use glam::DVec2;

/// Touching balls do not overlap; rounding must not make them [m].
const ROUNDING_M: f64 = 1e-9;

/// How far a way may turn about its beginning: from `right` (clockwise, not positive) to `left`
/// (anticlockwise, not negative) [rad].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub(super) right: f64,
    pub(super) left: f64,
}

impl Window {
    /// Turned as far as a quarter to both sides.
    pub(super) const OPEN: Window =
        Window { right: -std::f64::consts::FRAC_PI_2, left: std::f64::consts::FRAC_PI_2 };

    /// What both allow.
    pub(super) fn and(self, other: Window) -> Window {
        Window { right: self.right.max(other.right), left: self.left.min(other.left) }
    }

    /// Of a ball that is met: it turns `gain` times as far to the other side.
    pub(super) fn passed_on(self, gain: f64) -> Window {
        Window { right: -gain * self.left, left: -gain * self.right }
    }

    /// Seen from a way that has turned by `angle_rad` within it.
    pub(super) fn seen_from(self, angle_rad: f64) -> Window {
        Window { right: self.right - angle_rad, left: self.left - angle_rad }
    }

    /// Its middle [rad].
    pub(super) fn middle(self) -> f64 {
        0.5 * (self.right + self.left)
    }

    /// Its width [rad]; not positive if it is empty.
    pub(super) fn width(self) -> f64 {
        self.left - self.right
    }
}

/// What a ball in the way hides: the middle and half the width of the directions in which a ball
/// from `from` would meet it within `length_m`.
fn shadow(
    position: &Position<'_>,
    from: DVec2,
    ball: DVec2,
    unit: DVec2,
    length_m: f64,
) -> Option<(f64, f64)> {
    let apart = 2.0 * position.radius() - ROUNDING_M;
    let to_ball = ball - from;
    let distance = to_ball.length();
    let tangent = (distance * distance - apart * apart).max(0.0).sqrt();
    if tangent >= length_m {
        return None;
    }
    let half = libm::asin((apart / distance.max(ROUNDING_M)).min(1.0));
    Some((signed_angle(unit, to_ball), half))
}

/// How far the way from `from` to `to` may turn until it meets a ball; none if one is in it, or
/// where it ends. The balls in `ignored` do not count.
pub(super) fn window(
    position: &Position<'_>,
    from: DVec2,
    to: DVec2,
    ignored: &[BallId],
) -> Option<Window> {
    let apart = 2.0 * position.radius() - ROUNDING_M;
    let unit = (to - from).try_normalize()?;
    let length_m = from.distance(to);
    let mut open = Window::OPEN;
    for ball in position.view.balls.iter().filter(|ball| !ignored.contains(&ball.id)) {
        if ball.position.distance(to) < apart {
            return None;
        }
        let Some((middle, half)) = shadow(position, from, ball.position, unit, length_m) else {
            continue;
        };
        if middle >= half {
            open.left = open.left.min(middle - half);
        } else if middle <= -half {
            open.right = open.right.max(middle + half);
        } else {
            return None;
        }
    }
    Some(open)
}

/// What is left of `whole` when all balls but `ignored` in ways from `from` of this length along
/// about `unit` are taken out, from right to left.
pub(super) fn gaps(
    position: &Position<'_>,
    from: DVec2,
    unit: DVec2,
    length_m: f64,
    whole: Window,
    ignored: &[BallId],
) -> Vec<Window> {
    /// A narrower gap is none [rad].
    const LEAST_RAD: f64 = 0.002;
    let mut gaps = vec![whole];
    for ball in position.view.balls.iter().filter(|ball| !ignored.contains(&ball.id)) {
        let Some((middle, half)) = shadow(position, from, ball.position, unit, length_m) else {
            continue;
        };
        gaps = gaps
            .into_iter()
            .flat_map(|gap| {
                [
                    Window { right: gap.right, left: gap.left.min(middle - half) },
                    Window { right: gap.right.max(middle + half), left: gap.left },
                ]
            })
            .filter(|gap| gap.width() > LEAST_RAD)
            .collect();
    }
    gaps
}
