//! Simpler laws of the stroke, as textbooks state them; for comparison with [`super::cue_ball`].

use super::cue_ball::Cue;
use super::{Impact, Mover};
use glam::{DMat3, DVec3};

/// A cue that is guided along its axis: the impulse acts along the shaft, restitution along it at
/// the point of contact, the cue has mass only along it, and there is no squirt.
///
/// ```text
/// J = (1 + e) V / (1/M + 1/m + |r × d|²/I)      V the closing speed along d, r = −R n
/// ```
/// Alciatore, TP A.30, for any e. Limits: for a hit of b R off the centre the spin is R ω = 5/2 b
/// v, so b = 0.4 makes natural roll. `sticks` says whether the tip's friction can give an impulse
/// in that direction; beyond it the real tip slips (a miscue) and this law is not to be used.
pub fn along_axis(ball: &mut Mover, cue: &mut Cue, normal: DVec3) -> Impact {
    let direction = cue.direction;
    let closing =
        |ball: &Mover, cue: &Cue| (ball.surface_velocity(normal) - cue.velocity).dot(direction);
    let before = closing(ball, cue);
    if before >= 0.0 {
        return Impact::default();
    }
    let lever = (normal * ball.radius_m).cross(direction);
    let compliance =
        1.0 / cue.mass_kg + ball.inverse_mass + lever.length_squared() * ball.inverse_inertia;
    let impulse = direction * (-(1.0 + cue.contact.restitution) * before / compliance);
    ball.push(normal, impulse);
    cue.velocity -= impulse / cue.mass_kg;
    let after = closing(ball, cue);
    let loss_j = -0.5 * impulse.dot(direction) * (before + after);
    Impact { impulse, sticks: holds(normal, direction, cue.contact.friction), loss_j }
}

/// Whether friction μ can give an impulse along `direction` at a contact with this normal: the
/// angle between the two is at most arctan μ.
pub fn holds(normal: DVec3, direction: DVec3, friction: f64) -> bool {
    normal.cross(direction).length() <= friction * normal.dot(direction)
}

/// Squirt: the tip sticks and the end of the cue, of mass m_e, is free across the shaft. Along the
/// shaft it acts as in [`along_axis`], with restitution e; across it ball and end move together.
///
/// ```text
/// d·(u′ − w′) = −e d·(u − w),   P (u′ − w′) = 0,   P = 1 − d dᵀ
/// ```
/// For a level hit of b R to the side the ball leaves by tan α = (5/2) b √(1 − b²) / (1 + m/m_e +
/// (5/2)(1 − b²)) off the shaft, away from that side (Alciatore, TP A.31); speed, mass and
/// restitution do not enter. Limits: the tip never slips.
pub fn with_end_mass(ball: &mut Mover, cue: &mut Cue, normal: DVec3) -> Impact {
    let direction = cue.direction;
    let before = ball.surface_velocity(normal) - cue.velocity;
    let approach = before.dot(direction);
    if approach >= 0.0 {
        return Impact::default();
    }
    let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
    let along = outer(direction);
    let end = along * (1.0 / cue.mass_kg) + (DMat3::IDENTITY - along) * (1.0 / cue.end_mass_kg);
    let spin = ball.radius_m * ball.radius_m * ball.inverse_inertia;
    let compliance =
        DMat3::IDENTITY * ball.inverse_mass + (DMat3::IDENTITY - outer(normal)) * spin + end;
    let wanted = direction * (-cue.contact.restitution * approach);
    let impulse = compliance.inverse() * (wanted - before);
    ball.push(normal, impulse);
    cue.velocity -= end * impulse;
    let after = ball.surface_velocity(normal) - cue.velocity;
    Impact { impulse, sticks: true, loss_j: -0.5 * impulse.dot(before + after) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;
    use crate::physics::{Contact, Parameters};

    fn stroke(offset: DVec3) -> (Mover, Cue, DVec3) {
        let ball = Mover::new(&Ball::pool(BallId::CUE), DVec3::ZERO, DVec3::ZERO);
        let mut cue = Cue::new(&Parameters::pool(), DVec3::X * 4.0, DVec3::X);
        cue.contact = Contact { restitution: 0.75, friction: 0.6 };
        cue.mass_kg = 0.54;
        let behind = (1.0 - offset.length_squared()).sqrt();
        (ball, cue, DVec3::X * behind - offset)
    }

    #[test]
    fn a_guided_cue_gives_spin_in_proportion_to_the_offset_and_no_squirt() {
        for b in [0.0, 0.2, 0.4] {
            let (mut ball, mut cue, normal) = stroke(DVec3::Z * b);
            let impact = along_axis(&mut ball, &mut cue, normal);
            let expected = 1.75 * 4.0 / (1.0 + 0.17 / 0.54 + 2.5 * b * b);
            assert!((ball.velocity - DVec3::X * expected).length() < 1e-12);
            let spin = ball.angular_velocity.y * ball.radius_m / ball.velocity.x;
            assert!((spin - 2.5 * b).abs() < 1e-12 && impact.sticks && 0.0 < impact.loss_j);
        }
        let (mut ball, mut cue, normal) = stroke(DVec3::Z * 0.52);
        assert!(!along_axis(&mut ball, &mut cue, normal).sticks);
    }

    #[test]
    fn squirt_is_the_published_angle_for_an_end_of_a_twentieth_of_the_ball() {
        let (mut ball, mut cue, normal) = stroke(DVec3::NEG_Y * 0.2);
        cue.end_mass_kg = 0.17 / 20.0;
        with_end_mass(&mut ball, &mut cue, normal);
        let angle = libm::atan2(ball.velocity.y, ball.velocity.x);
        assert!((angle * 180.0 / core::f64::consts::PI - 1.199_358).abs() < 1e-6);
    }
}
