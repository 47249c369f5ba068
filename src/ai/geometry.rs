//! Plane geometry of shots (paper, section 5.4.1).

use super::view::TableView2d;
use crate::ids::BallId;
use glam::DVec2;

/// Whether a ball at `p` is in the way of another that moves from `a` to `b` in a straight line.
///
/// `k = (p − a)·(b − a)/|b − a|` is how far along the line `p` lies. It blocks if `0 < k < |b − a|`
/// and its distance to the line, `|a + k û − p|`, is below the sum of both radii `radii_m`
/// (paper, section 5.4.1). What lies behind `a` or beyond `b` never blocks.
pub fn is_blocked(a: DVec2, b: DVec2, p: DVec2, radii_m: f64) -> bool {
    let length = a.distance(b);
    if length == 0.0 {
        return false;
    }
    let unit = (b - a) / length;
    let k = (p - a).dot(unit);
    0.0 < k && k < length && (a + k * unit - p).length() < radii_m
}

/// Angle from `from` to `to`, anticlockwise positive [rad].
pub fn signed_angle(from: DVec2, to: DVec2) -> f64 {
    libm::atan2(from.perp_dot(to), from.dot(to))
}

/// `vector` turned anticlockwise by `angle_rad`.
pub(super) fn turned(vector: DVec2, angle_rad: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle_rad);
    DVec2::new(cos, sin).rotate(vector)
}

/// Whether a ball can go from `a` to `b` past all object balls but `ignored`, and has room at `b`.
///
/// The paper's test looks between the ends only; a ball right behind `b` would be hit as well.
pub(super) fn is_free(view: &TableView2d, a: DVec2, b: DVec2, ignored: Option<BallId>) -> bool {
    /// Touching balls do not overlap; rounding must not make them [m].
    const ROUNDING_M: f64 = 1e-9;
    let radii = 2.0 * view.ball_radius_m;
    view.balls.iter().filter(|ball| Some(ball.id) != ignored).all(|ball| {
        !is_blocked(a, b, ball.position, radii - ROUNDING_M)
            && b.distance(ball.position) >= radii - ROUNDING_M
    })
}
