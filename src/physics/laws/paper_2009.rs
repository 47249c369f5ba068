//! The contact laws of the paper (sections 2.2 and 2.4), with their known faults.
//!
//! They are here to be measured against and to reproduce what the paper reports. Two things differ
//! from the impulse laws: friction acts on each ball as if the other were fixed, which stops twice
//! as much slip between balls as it should (the aiming factor 0.45 of section 5.4.3 comes from
//! that), and the normal force counts gravity besides the collision that gravity causes.

use super::Mover;
use crate::units::Seconds;
use glam::DVec3;

/// The paper's friction coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// μ_G, while the surfaces slide.
    pub sliding: f64,
    /// μ_H, when the force is enough to stop the slip within the step.
    pub static_: f64,
}

/// Change of velocity and angular velocity by the paper's friction during one step (section 2.4).
///
/// F_R = −μ |F_N| v_diff/|v_diff| acts for the whole step h; v′_diff is the slip after it, with the
/// partner held. If it has reversed, the force is reduced by |v_diff|/(|v_diff| + |v′_diff|), which
/// ends the slip exactly. Static friction holds what it can stop within the step, sliding friction
/// acts otherwise. `slip` is the relative velocity of the touching surfaces.
pub fn friction(
    ball: &Mover,
    normal: DVec3,
    slip: DVec3,
    normal_force_n: f64,
    law: Friction,
    h: Seconds,
) -> (DVec3, DVec3) {
    let speed = slip.length();
    if speed == 0.0 || ball.inverse_mass == 0.0 {
        return (DVec3::ZERO, DVec3::ZERO);
    }
    let integrate = |force: DVec3| {
        let mut moved = Mover { velocity: DVec3::ZERO, angular_velocity: DVec3::ZERO, ..*ball };
        moved.push(normal, force * h);
        moved
    };
    let direction = slip / speed;
    let reversal = |force: DVec3| {
        let after = slip + integrate(force).surface_velocity(normal);
        if after.dot(slip) < 0.0 { after.length() } else { 0.0 }
    };

    let holding = -direction * (law.static_ * normal_force_n);
    let reversed = reversal(holding);
    let force = if reversed > 0.0 {
        holding * (speed / (speed + reversed))
    } else {
        -direction * (law.sliding * normal_force_n)
    };
    let moved = integrate(force);
    (moved.velocity, moved.angular_velocity)
}

/// The paper's reflection of two balls in the frame of their centre of mass (section 2.2.2): the
/// normal velocities after the contact.
pub fn reflect(a: &Mover, b: &Mover, normal: DVec3, restitution: f64) -> (f64, f64) {
    let (ua, ub) = (a.velocity.dot(normal), b.velocity.dot(normal));
    let total = a.inverse_mass + b.inverse_mass;
    if total == 0.0 {
        return (ua, ub);
    }
    // (m_a u_a + m_b u_b)/(m_a + m_b), which also holds for a ball that does not move.
    let common = (ua * b.inverse_mass + ub * a.inverse_mass) / total;
    (common - restitution * (ua - common), common - restitution * (ub - common))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;

    #[test]
    fn the_clamp_ends_the_slip_against_a_fixed_partner_with_two_sevenths() {
        let ball = Mover::new(&Ball::pool(BallId(1)), DVec3::X, DVec3::ZERO);
        let slip = DVec3::Y * 0.4;
        let law = Friction { sliding: 0.3, static_: 0.35 };
        let (dv, _) = friction(&ball, DVec3::X, slip, 1e4, law, 0.004);
        assert!((dv + slip * (2.0 / 7.0)).length() < 1e-14);
        // Too weak to stop it: sliding friction for the whole step.
        let (dv, _) = friction(&ball, DVec3::X, slip, 1.0, law, 0.004);
        assert!((dv.y + 0.3 * 0.004 / 0.17).abs() < 1e-15);
    }

    #[test]
    fn reflection_keeps_momentum_and_newtons_restitution() {
        let a = Mover::new(&Ball::pool(BallId(1)), DVec3::X * 3.0, DVec3::ZERO);
        let heavy = Ball { mass_kg: 0.4, ..Ball::pool(BallId(2)) };
        let b = Mover::new(&heavy, DVec3::X * -1.0, DVec3::ZERO);
        let (ua, ub) = reflect(&a, &b, DVec3::X, 0.9);
        assert!((0.17 * ua + 0.4 * ub - (0.51 - 0.4)).abs() < 1e-15);
        assert!((ub - ua - 0.9 * 4.0).abs() < 1e-14);
    }
}
