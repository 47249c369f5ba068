//! Two balls: Newton's restitution and Coulomb's friction at a point.

use super::{Impact, Mover};
use glam::DVec3;

/// Resolves the contact of two balls; `normal` is the unit vector from `b` to `a`.
///
/// ```text
/// u  = (v_a + ω_a × (−R_a n)) − (v_b + ω_b × R_b n)
/// Jn = (1 + e) |u·n| / k_n          k_n = 1/m_a + 1/m_b
/// Jt = −û_t min(μ Jn, |u_t|/k_t)    k_t = k_n + R_a²/I_a + R_b²/I_b  (7/2 k_n for solid spheres)
/// ```
/// The slip of two spheres keeps its direction during the impact, so for constant μ this is the
/// exact Coulomb result and needs no integration over the impulse. For μ = 0 it is the paper's
/// reflection in the frame of the centre of mass (section 2.2.2). Limits: e = 1 and μ = 0 conserve
/// energy; nothing else touches the balls (otherwise see [`super::cluster`]); balls that part
/// already are left alone.
pub fn collide(
    a: &mut Mover,
    b: &mut Mover,
    normal: DVec3,
    restitution: f64,
    friction: f64,
) -> Impact {
    let slip = |a: &Mover, b: &Mover| a.surface_velocity(normal) - b.surface_velocity(-normal);
    let before = slip(a, b);
    let approach = before.dot(normal);
    let normal_compliance = a.inverse_mass + b.inverse_mass;
    if approach >= 0.0 || normal_compliance == 0.0 {
        return Impact::default();
    }
    let normal_impulse = -(1.0 + restitution) * approach / normal_compliance;

    let tangential = before - normal * approach;
    let speed = tangential.length();
    let stopping = speed / (a.tangential_compliance() + b.tangential_compliance());
    let available = friction * normal_impulse;
    let sticks = stopping <= available;
    let size = if sticks { stopping } else { available };
    let mut impulse = normal * normal_impulse;
    if speed > 0.0 {
        impulse -= tangential * (size / speed);
    }

    a.push(normal, impulse);
    b.push(-normal, -impulse);
    let loss_j = -0.5 * impulse.dot(before + slip(a, b));
    Impact { impulse, sticks, loss_j }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;

    fn ball(velocity: DVec3, angular_velocity: DVec3) -> Mover {
        Mover::new(&Ball::pool(BallId(1)), velocity, angular_velocity)
    }

    #[test]
    fn unequal_balls_in_space_reflect_in_the_frame_of_their_centre_of_mass() {
        // Closed form at 40 digits, restitution 0.8.
        let mut a = ball(DVec3::new(2.0, -1.0, 0.5), DVec3::new(10.0, -20.0, 30.0));
        let small = Ball { mass_kg: 0.05, radius_m: 0.02, ..Ball::pool(BallId(2)) };
        let mut b = Mover::new(&small, DVec3::new(-0.5, 0.3, -0.2), DVec3::new(-5.0, 15.0, 40.0));
        let line = DVec3::new(0.029145, -0.023316, 0.031088).normalize();
        let impact = collide(&mut a, &mut b, -line, 0.8, 0.0);
        let expected = DVec3::new(1.368_690_909_09, -0.494_952_727_273, -0.173_396_363_636);
        assert!((a.velocity - expected).length() < 1e-11);
        assert!((impact.loss_j - 0.046_005_597_818_2).abs() < 1e-12);
    }

    #[test]
    fn throw_follows_the_published_formula() {
        // tan(throw) = min(μ, 2 tan φ/(7 (1 + e))): Alciatore TP A.14, eq. 15 to 17.
        for (degrees, restitution) in [(2.0, 1.0), (15.0, 0.93), (30.0, 1.0), (60.0, 0.93)] {
            let phi: f64 = degrees * core::f64::consts::PI / 180.0;
            let line = DVec3::new(libm::cos(phi), libm::sin(phi), 0.0);
            let (mut a, mut b) = (ball(DVec3::X, DVec3::ZERO), ball(DVec3::ZERO, DVec3::ZERO));
            collide(&mut a, &mut b, -line, restitution, 0.06);
            let along = b.velocity.dot(line);
            let across = (b.velocity - line * along).length();
            let expected = (2.0 * libm::tan(phi) / (7.0 * (1.0 + restitution))).min(0.06);
            assert!((across / along - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn the_loss_from_impulse_and_slip_is_the_loss_of_kinetic_energy() {
        let mut a = ball(DVec3::new(3.0, 0.4, 0.1), DVec3::new(5.0, 90.0, -40.0));
        let mut b = ball(DVec3::new(-0.5, 0.0, 0.0), DVec3::new(0.0, -20.0, 7.0));
        let before = a.kinetic_j() + b.kinetic_j();
        let impact = collide(&mut a, &mut b, DVec3::new(-0.96, 0.28, 0.0), 0.95, 0.05);
        let lost = before - a.kinetic_j() - b.kinetic_j();
        assert!(0.0 < lost && (impact.loss_j - lost).abs() < 1e-14);
    }
}
