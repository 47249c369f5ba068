//! A ball and something that does not move: landing on the bed, walls of pockets, obstacles.

use super::{Impact, Mover};
use glam::DVec3;

/// Resolves the contact of a ball and a fixed surface; `normal` points from the surface to the
/// ball's centre.
///
/// The law of [`super::ball_ball`] with k_n = 1/m and k_t = 1/m + R²/I (7/(2 m) for a solid
/// sphere): Jn = (1 + e) m |u_n|, Jt = −û_t min(μ Jn, |u_t|/k_t). Limits: one contact; a ball that
/// is carried by another surface as well needs [`super::cushion`].
pub fn bounce(ball: &mut Mover, normal: DVec3, restitution: f64, friction: f64) -> Impact {
    let before = ball.surface_velocity(normal);
    let approach = before.dot(normal);
    if approach >= 0.0 || ball.inverse_mass == 0.0 {
        return Impact::default();
    }
    let normal_impulse = -(1.0 + restitution) * approach / ball.inverse_mass;

    let tangential = before - normal * approach;
    let speed = tangential.length();
    let stopping = speed / ball.tangential_compliance();
    let available = friction * normal_impulse;
    let sticks = stopping <= available;
    let size = if sticks { stopping } else { available };
    let mut impulse = normal * normal_impulse;
    if speed > 0.0 {
        impulse -= tangential * (size / speed);
    }

    ball.push(normal, impulse);
    let loss_j = -0.5 * impulse.dot(before + ball.surface_velocity(normal));
    Impact { impulse, sticks, loss_j }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;

    #[test]
    fn backspin_on_a_gripping_wall_is_mostly_reversed() {
        // Full stick: Δv_t = −(2/7) u_t, whatever μ beyond that.
        let mut ball = Mover::new(
            &Ball::pool(BallId(1)),
            DVec3::new(1.0, 0.0, -2.0),
            DVec3::new(0.0, -70.0, 0.0),
        );
        let slip = ball.surface_velocity(DVec3::Z).x;
        let impact = bounce(&mut ball, DVec3::Z, 0.5, 10.0);
        assert!(impact.sticks);
        assert!((ball.velocity.x - (1.0 - 2.0 / 7.0 * slip)).abs() < 1e-14);
        assert!((ball.velocity.z - 1.0).abs() < 1e-15);
        assert!(ball.surface_velocity(DVec3::Z).x.abs() < 1e-14);
    }
}
