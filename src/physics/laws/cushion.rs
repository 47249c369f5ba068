//! A cushion and the bed under the ball: two contacts at once.
//!
//! The nose lies above the ball's centre, so the contact normal n points a little downwards and the
//! cushion presses the ball into the bed. Resolving the cushion alone and the bed afterwards with
//! the restitution of a landing would throw the ball up, which no table does.

use super::cluster::{self, Touch};
use super::one_ball::Surface;
use super::{Impact, Mover, wedge};
use crate::physics::{Contact, tolerance};
use glam::DVec3;

/// Resolves the contact of a carried ball with a cushion, or with any other fixed surface.
///
/// `normal` points from the cushion to the centre, `support` is the unit normal of what carries the
/// ball. Without friction this is, with θ the angle of n below the horizontal,
/// ```text
/// Jn = (1 + e_c) m |u_n| / (1 − n_z²)      Js = −Jn n_z
/// ```
/// that is: the velocity along the bed and into the cushion reverses by e_c, and the ball neither
/// jumps nor sinks. Friction is Coulomb's at both contacts, solved jointly with the normal parts.
/// Parameters e_c = 0.85, μ_c = 0.2 (pooltool). Not to be mixed with those of Mathavan, Jackson,
/// Parkin 2010 (e = 0.98, μ = 0.14), which belong to a law integrated over the impulse. Limits:
/// rigid cushion; real cushions yield above about 2.5 m/s.
pub fn bounce(
    ball: &mut Mover,
    normal: DVec3,
    support: DVec3,
    cushion: Contact,
    cloth: Contact,
) -> (Impact, Impact) {
    let mut touches = [
        Touch::new(0, None, normal, cushion),
        Touch { carries: true, ..Touch::new(0, None, support, cloth) },
    ];
    cluster::resolve(core::slice::from_mut(ball), &mut touches);
    let impact = |t: &Touch| Impact { impulse: t.impulse, sticks: false, loss_j: t.loss_j };
    (impact(&touches[0]), impact(&touches[1]))
}

/// The same law, directly where [`wedge`] knows the answer: equal but for rounding, and quicker.
pub fn bounce_directly(
    ball: &mut Mover,
    normal: DVec3,
    support: DVec3,
    cushion: Contact,
    cloth: Contact,
) -> (Impact, Impact) {
    let before = *ball;
    let approach = -ball.surface_velocity(normal).dot(normal);
    if approach > tolerance::CLOSING_M_S {
        let target_m_s = cushion.restitution * approach;
        let struck = Surface { normal, target_m_s, friction: cushion.friction };
        let bed = Surface { normal: support, target_m_s: 0.0, friction: cloth.friction };
        if let Some([own, carried]) = wedge::solve(ball, &struck, &bed) {
            ball.push(normal, own);
            ball.push(support, carried);
            let impact = |normal: DVec3, impulse: DVec3| {
                let slips = before.surface_velocity(normal) + ball.surface_velocity(normal);
                Impact { impulse, sticks: false, loss_j: -0.5 * impulse.dot(slips) }
            };
            let both = (impact(normal, own), impact(support, carried));
            // What would add energy is tempered there.
            if both.0.loss_j + both.1.loss_j >= 0.0 {
                return both;
            }
            *ball = before;
        }
    }
    bounce(ball, normal, support, cushion, cloth)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;

    /// Nose at 0.635 of the ball's diameter.
    fn nose() -> DVec3 {
        let sine = 2.0 * 0.635 - 1.0;
        DVec3::new(-(1.0_f64 - sine * sine).sqrt(), 0.0, -sine)
    }

    #[test]
    fn without_friction_the_ball_keeps_to_the_bed_and_turns_back_with_the_restitution() {
        let mut ball = Mover::new(&Ball::pool(BallId(1)), DVec3::new(3.0, 1.0, 0.0), DVec3::ZERO);
        let smooth = |restitution| Contact { restitution, friction: 0.0 };
        let (cushion, bed) = bounce(&mut ball, nose(), DVec3::Z, smooth(0.85), smooth(0.5));
        assert!((ball.velocity - DVec3::new(-2.55, 1.0, 0.0)).length() < 1e-10);
        let jn = 1.85 * 0.17 * 3.0 / nose().x.abs();
        assert!((cushion.impulse.length() - jn).abs() < 1e-10);
        assert!((bed.impulse.z - jn * 0.27).abs() < 1e-10);
    }

    #[test]
    fn side_spin_bends_the_rebound_and_no_energy_appears() {
        let law = |restitution, friction| Contact { restitution, friction };
        for spin in [-60.0, 0.0, 60.0] {
            let mut ball = Mover::new(
                &Ball::pool(BallId(1)),
                DVec3::new(2.0, 0.0, 0.0),
                DVec3::new(0.0, 2.0 / 0.028575, spin),
            );
            let before = ball.kinetic_j();
            let (a, b) = bounce(&mut ball, nose(), DVec3::Z, law(0.85, 0.2), law(0.5, 0.2));
            let lost = before - ball.kinetic_j();
            assert!(0.0 < lost && (a.loss_j + b.loss_j - lost).abs() < 1e-12);
            // The skin at the cushion moves with ω_z R along y; friction drives the other way.
            assert!(spin * ball.velocity.y <= 0.0, "{spin}: {}", ball.velocity);
            assert!(ball.velocity.z.abs() < 0.3 && ball.velocity.x < 0.0);
        }
    }
}
