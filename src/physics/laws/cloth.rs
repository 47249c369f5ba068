//! A ball on what carries it: sliding, rolling, spinning.
//!
//! The closed forms hold between contacts on a level bed; [`carry`] is the same law over one step,
//! for any direction of the surface.

use super::{Impact, Mover};
use crate::units::Seconds;
use glam::DVec3;

/// Relative velocity of the touching surfaces at a contact, in m/s.
///
/// u = P (v + ω × r): `P` removes the part along the unit `normal`, r = −R n points from the ball's
/// centre to the contact. Zero means rolling. Limits: ω = 0 gives plain sliding; a spin about
/// `normal` gives 0 and is damped elsewhere. Paper, section 2.4.
pub fn slip_velocity(
    velocity: DVec3,
    angular_velocity: DVec3,
    radius_m: f64,
    normal: DVec3,
) -> DVec3 {
    let u = velocity - radius_m * angular_velocity.cross(normal);
    u - normal * u.dot(normal)
}

/// How long a ball slides until it rolls [s]: t = |u| / (μ g k), with k = 1 + m R²/I, 7/2 for a
/// solid sphere. On a level bed the slip keeps its direction, so the path is a parabola.
pub fn sliding_time(
    slip_m_s: f64,
    friction: f64,
    gravity_m_s2: f64,
    inertia_factor: f64,
) -> Seconds {
    slip_m_s / (friction * gravity_m_s2 * (1.0 + 1.0 / inertia_factor))
}

/// Velocity and angular velocity of a ball that slides on a level bed, after `dt` of sliding
/// (dt ≤ [`sliding_time`]): a = −μ g û, α = −(m R/I) ẑ × a.
pub fn slide(
    velocity: DVec3,
    angular_velocity: DVec3,
    radius_m: f64,
    inertia_factor: f64,
    deceleration_m_s2: f64,
    dt: Seconds,
) -> (DVec3, DVec3) {
    let slip = slip_velocity(velocity, angular_velocity, radius_m, DVec3::Z);
    let change = -slip.normalize_or_zero() * (deceleration_m_s2 * dt);
    (velocity + change, angular_velocity - DVec3::Z.cross(change) / (inertia_factor * radius_m))
}

/// Slip over the speeds that it is the difference of, below which it is rounding.
const ROUNDING: f64 = 1e-13;

/// What a surface does to a ball that it carries, over one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Carrying {
    /// Sliding friction coefficient.
    pub friction: f64,
    /// Deceleration of a rolling ball over the normal acceleration.
    pub rolling_resistance: f64,
    /// Deceleration of the spin about the normal [rad/s²].
    pub spin_deceleration_rad_s2: f64,
}

/// Carries a ball for one step of length `h`: its normal velocity, which the step's forces have
/// just made, becomes zero, and what that takes is the normal impulse that friction lives on.
///
/// Friction is Coulomb's with the slip stopping at zero: a ball that has stopped slipping rolls. It
/// then loses μ_r Jn/m of its speed for the part of the step in which it rolled, keeping ω = n ×
/// v/R. The spin about the normal falls by α h. Limits: a ball at rest stays exactly at rest; on a
/// slope steeper than the rolling resistance it rolls down with 5/7 of gravity's part.
pub fn carry(ball: &mut Mover, normal: DVec3, law: &Carrying, h: Seconds) -> Impact {
    let before = ball.surface_velocity(normal);
    let approach = before.dot(normal);
    if ball.inverse_mass == 0.0 {
        return Impact::default();
    }
    let normal_impulse = (-approach / ball.inverse_mass).max(0.0);
    ball.velocity -= normal * approach.min(0.0);

    // Sliding friction, no further than to the end of the slip.
    let tangential = before - normal * approach;
    let slip = tangential.length();
    let stopping = slip / ball.tangential_compliance();
    let available = law.friction * normal_impulse;
    // A slip of rounding is rolling, on cloth without friction too.
    let skin = ball.velocity.length() + ball.radius_m * ball.angular_velocity.length();
    let sticks = stopping <= available || slip <= ROUNDING * skin;
    let size = if sticks { stopping } else { available };
    let friction = if slip > 0.0 { tangential * (-size / slip) } else { DVec3::ZERO };
    if slip > 0.0 {
        ball.push(normal, friction);
    }
    let mut impulse = friction + normal * normal_impulse;
    let mut loss_j = -0.5 * impulse.dot(before + ball.surface_velocity(normal));

    let rolled = match (sticks, available > 0.0) {
        (true, true) => (1.0 - stopping / available).max(0.0),
        (true, false) => 1.0,
        (false, _) => 0.0,
    };
    let slid = ball.velocity;
    loss_j += resist(ball, normal, normal_impulse, rolled, law, h);
    impulse += (ball.velocity - slid) / ball.inverse_mass;
    Impact { impulse, sticks, loss_j }
}

/// Rolling resistance for the part `rolled` of a step, and the decay of the spin about `normal`.
/// Returns the energy lost [J].
pub fn resist(
    ball: &mut Mover,
    normal: DVec3,
    normal_impulse: f64,
    rolled: f64,
    law: &Carrying,
    h: Seconds,
) -> f64 {
    if normal_impulse <= 0.0 {
        return 0.0;
    }
    let before = *ball;

    let lost = law.rolling_resistance * normal_impulse * ball.inverse_mass * rolled;
    let off = normal * ball.velocity.dot(normal);
    let along = ball.velocity - off;
    let speed = along.length();
    let mut spin = ball.angular_velocity.dot(normal);
    if lost > 0.0 && ball.velocity.length() <= lost {
        ball.velocity = DVec3::ZERO;
        ball.angular_velocity = normal * spin;
    } else if lost > 0.0 && lost < speed {
        let along = along * (1.0 - lost / speed);
        ball.velocity = off + along;
        ball.angular_velocity = normal * spin + normal.cross(along) / ball.radius_m;
    }

    let slower = law.spin_deceleration_rad_s2 * h;
    if spin != 0.0 {
        let kept = if spin.abs() <= slower { 0.0 } else { spin - slower * spin.signum() };
        ball.angular_velocity += normal * (kept - spin);
        spin = kept;
    }
    // What neither rolls nor spins is at rest to the last bit.
    if spin == 0.0 && ball.velocity == DVec3::ZERO && rolled > 0.0 {
        ball.angular_velocity = DVec3::ZERO;
    }
    // Work of the resistance: impulse and angular impulse, each times the mean of its velocity.
    let part = |change: DVec3, sum: DVec3, inverse: f64| {
        if inverse > 0.0 { change.dot(sum) / inverse } else { 0.0 }
    };
    let (v, v_after) = (before.velocity, ball.velocity);
    let (w, w_after) = (before.angular_velocity, ball.angular_velocity);
    -0.5 * (part(v_after - v, v_after + v, ball.inverse_mass)
        + part(w_after - w, w_after + w, ball.inverse_inertia))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::{Ball, POOL_RADIUS_M, SOLID_SPHERE};
    use crate::ids::BallId;

    const CLOTH: Carrying =
        Carrying { friction: 0.2, rolling_resistance: 0.01, spin_deceleration_rad_s2: 10.0 };

    #[test]
    fn a_sliding_ball_ends_up_rolling_at_five_sevenths() {
        let time = sliding_time(2.0, 0.2, 9.81, SOLID_SPHERE);
        let (v, w) =
            slide(DVec3::X * 2.0, DVec3::ZERO, POOL_RADIUS_M, SOLID_SPHERE, 0.2 * 9.81, time);
        assert!((v.x - 10.0 / 7.0).abs() < 1e-15);
        assert!(slip_velocity(v, w, POOL_RADIUS_M, DVec3::Z).length() < 1e-14);
    }

    #[test]
    fn a_ball_at_rest_stays_at_rest_to_the_last_bit() {
        let h = 0.004;
        let mut ball = Mover::new(&Ball::pool(BallId(1)), DVec3::Z * (-9.81 * h), DVec3::ZERO);
        carry(&mut ball, DVec3::Z, &CLOTH, h);
        assert_eq!(ball.velocity, DVec3::ZERO);
        assert_eq!(ball.angular_velocity, DVec3::ZERO);
    }

    #[test]
    fn a_ball_that_rolls_up_to_rounding_is_slowed_without_sliding_friction_too() {
        let (h, speed) = (0.004, 1.0);
        let law = Carrying { friction: 0.0, ..CLOTH };
        let velocity = DVec3::new(speed, 0.0, -9.81 * h);
        let spin = DVec3::Y * (speed / POOL_RADIUS_M * (1.0 + 4.0 * f64::EPSILON));
        let mut ball = Mover::new(&Ball::pool(BallId(1)), velocity, spin);
        carry(&mut ball, DVec3::Z, &law, h);
        assert!((ball.velocity.x - (speed - 0.01 * 9.81 * h)).abs() < 1e-14);
    }

    #[test]
    fn sliding_loses_exactly_mu_g_and_rolling_mu_r_g() {
        let h = 0.004;
        let mut ball =
            Mover::new(&Ball::pool(BallId(1)), DVec3::new(2.0, 0.0, -9.81 * h), DVec3::ZERO);
        carry(&mut ball, DVec3::Z, &CLOTH, h);
        assert!((ball.velocity.x - (2.0 - 0.2 * 9.81 * h)).abs() < 1e-15);
        let mut ball = Mover::new(
            &Ball::pool(BallId(1)),
            DVec3::new(2.0, 0.0, -9.81 * h),
            DVec3::new(0.0, 2.0 / POOL_RADIUS_M, 0.0),
        );
        carry(&mut ball, DVec3::Z, &CLOTH, h);
        assert!((ball.velocity.x - (2.0 - 0.01 * 9.81 * h)).abs() < 1e-14);
        assert!((ball.angular_velocity.y - ball.velocity.x / POOL_RADIUS_M).abs() < 1e-12);
    }
}
