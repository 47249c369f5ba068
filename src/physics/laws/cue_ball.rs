//! The tip and a ball: the law of the stroke.

use super::{Impact, Mover};
use crate::physics::{Contact, Parameters};
use glam::{DMat3, DVec3};

/// The cue as the stroke sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cue {
    /// Velocity of the tip [m/s].
    pub velocity: DVec3,
    /// Unit vector along the shaft, from butt to tip.
    pub direction: DVec3,
    /// Mass along the shaft [kg].
    pub mass_kg: f64,
    /// Effective mass of the end across the shaft [kg].
    pub end_mass_kg: f64,
    /// Restitution along the normal and friction of the tip.
    pub contact: Contact,
}

impl Cue {
    /// A cue with the masses and the tip of `parameters`.
    pub fn new(parameters: &Parameters, velocity: DVec3, direction: DVec3) -> Self {
        Cue {
            velocity,
            direction,
            mass_kg: parameters.cue_mass_kg,
            end_mass_kg: parameters.cue_end_mass_kg,
            contact: parameters.tip,
        }
    }

    /// M⁻¹ = d dᵀ/M + (1 − d dᵀ)/m_e: how the tip yields to an impulse.
    fn inverse_mass(&self) -> DMat3 {
        let along = outer(self.direction);
        along * (1.0 / self.mass_kg) + (DMat3::IDENTITY - along) * (1.0 / self.end_mass_kg)
    }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// Resolves the contact of the tip with a ball; `normal` is the unit vector from the tip's centre
/// to the ball's. Changes the ball and the cue's velocity; the impulse returned is the one on the
/// ball.
///
/// With r = −R n, u = v + ω × r − v_tip and the contact matrix
/// K = 1/m − \[r\]× (1/I) \[r\]× + M⁻¹:
/// ```text
/// stick   J = K⁻¹ (−e u_n n − u)
/// slip    J = Jn (n + μ t̂),  Jn = −(1 + e) u_n / (n·K (n + μ t̂)),  t̂ along the trial's Jt
/// ```
/// slip if the trial's |Jt| exceeds μ Jn: a miscue. The end mass makes squirt: the ball leaves a
/// little off the shaft's direction, away from the side that was hit. e = 0.75 and μ = 0.6 are
/// usual values for leather; m_e = m/30. Limits: rigid impulse; the bed under the ball acts
/// afterwards ([`super::ball_face`]), which is what makes a jump shot.
pub fn cue_contact(ball: &mut Mover, cue: &mut Cue, normal: DVec3) -> Impact {
    let before = ball.surface_velocity(normal) - cue.velocity;
    let approach = before.dot(normal);
    if approach >= 0.0 {
        return Impact::default();
    }
    let Contact { restitution, friction } = cue.contact;

    let radial = outer(normal);
    let spin = ball.radius_m * ball.radius_m * ball.inverse_inertia;
    let compliance = DMat3::IDENTITY * ball.inverse_mass
        + (DMat3::IDENTITY - radial) * spin
        + cue.inverse_mass();

    let trial = compliance.inverse() * (normal * (-restitution * approach) - before);
    let along = trial.dot(normal);
    let tangential = trial - normal * along;
    let sticks = tangential.length() <= friction * along;
    let impulse = if sticks {
        trial
    } else {
        let direction = normal + tangential.normalize_or_zero() * friction;
        direction * (-(1.0 + restitution) * approach / normal.dot(compliance * direction))
    };

    ball.push(normal, impulse);
    cue.velocity -= cue.inverse_mass() * impulse;
    let after = ball.surface_velocity(normal) - cue.velocity;
    Impact { impulse, sticks, loss_j: -0.5 * impulse.dot(before + after) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;

    fn stroke(offset: f64, end_mass_kg: f64) -> (Mover, Impact, f64) {
        let mut ball = Mover::new(&Ball::pool(BallId::CUE), DVec3::ZERO, DVec3::ZERO);
        let normal = DVec3::new((1.0 - offset * offset).sqrt(), -offset, 0.0);
        let mut cue = Cue::new(&Parameters::pool(), DVec3::X * 2.0, DVec3::X);
        cue.end_mass_kg = end_mass_kg;
        let impact = cue_contact(&mut ball, &mut cue, normal);
        (ball, impact, cue.velocity.x)
    }

    #[test]
    fn a_central_stroke_is_newtons_law_for_two_masses() {
        let (ball, _, cue) = stroke(0.0, 0.009);
        let expected = 1.75 * 2.0 * 0.54 / (0.54 + 0.17);
        assert!((ball.velocity.x - expected).abs() < 1e-12);
        assert!((ball.velocity.x - cue - 0.75 * 2.0).abs() < 1e-12);
    }

    #[test]
    fn off_centre_strokes_are_slower_spin_more_and_squirt_away_from_the_offset() {
        // Speeds 2.66 / 2.46 / 1.96 / 1.68 m/s and squirt 0 / 1.6 / 3.1 / 3.9° at 0, 0.2, 0.4, 0.5
        // R with an end mass of 9 g.
        for (offset, speed, squirt) in
            [(0.0, 2.66, 0.0), (0.2, 2.46, 1.6), (0.4, 1.96, 3.1), (0.5, 1.68, 3.9)]
        {
            let (ball, impact, _) = stroke(offset, 0.009);
            assert!(impact.sticks && 0.0 < impact.loss_j);
            assert!((ball.velocity.length() - speed).abs() < 0.02, "{offset}");
            let angle =
                libm::atan2(-ball.velocity.y, ball.velocity.x) * 180.0 / core::f64::consts::PI;
            assert!((angle.abs() - squirt).abs() < 0.15, "{offset}: {angle}");
        }
    }

    #[test]
    fn far_off_centre_the_tip_slips() {
        assert!(stroke(0.5, 0.009).1.sticks);
        assert!(!stroke(0.65, 0.009).1.sticks);
    }
}
