//! A rigid cushion with the cloth under the ball: the published model, integrated over the impulse.

use super::mathavan_2014::{Bed, share_of_step};
use super::{Impact, Mover};
use crate::physics::Contact;
use glam::DVec3;

/// Steps of the cushion's impulse. The error falls with their square; 500 leave 1e-5 of the speeds.
const STEPS: u32 = 500;
/// Slip below this has no direction [m/s].
const SLIP_M_S: f64 = 1e-12;

/// The parameters that belong to this law, from the same source; not to be mixed with those of
/// [`super::cushion`].
pub const CUSHION: Contact = Contact { restitution: 0.98, friction: 0.14 };

/// Resolves the contact of a carried ball with a cushion; `normal` points from the nose to the
/// centre. Returns what the cushion and what the bed did.
///
/// Over the cushion's normal impulse P:
/// ```text
/// dJ   = (n − μ_w û) dP
/// dJ_s = (s − μ_s û_s) max(0, −dJ·s)
/// compression until v·n = 0, restitution until the normal work of it is e² that of compression
/// ```
/// The ball stays on the bed. Mathavan, Jackson, Parkin, Proc. IMechE C 224 (2010) 1863.
///
/// | | value |
/// |---|---|
/// | e (energetic) | 0.98 |
/// | μ ball, cushion | 0.14 |
/// | μ ball, cloth | 0.212 |
/// | nose height | 1.4 R |
///
/// Limits: rigid cushion, valid up to 2.5 m/s; above, measured rebounds are 7 to 12 % slower. A
/// rolling ball comes back from a perpendicular hit with 0.9107 of its speed, whatever that was.
pub fn bounce(ball: &mut Mover, normal: DVec3, bed: Bed, law: Contact) -> (Impact, Impact) {
    let mut impacts = (Impact::default(), Impact::default());
    let approach = ball.velocity.dot(normal);
    if approach >= 0.0 || ball.inverse_mass == 0.0 {
        return impacts;
    }
    // The bed takes the part of n along s, so the ball yields to P like one of mass m/(1 − n_s²).
    let along = 1.0 - normal.dot(bed.normal) * normal.dot(bed.normal);
    let total = -(1.0 + law.restitution) * approach / (ball.inverse_mass * along.max(1e-6));
    let step = total / f64::from(STEPS);
    let nose = Nose { normal, bed, friction: law.friction };

    let (mut work, mut goal): (f64, Option<f64>) = (0.0, None);
    for _ in 0..4 * STEPS {
        let before = ball.velocity.dot(normal);
        let rates = nose.midpoint(ball, step);
        let after = nose.pushed(ball, rates, step).velocity.dot(normal);
        let left = goal.map(|goal| (goal - work) / step);
        let share = share_of_step(before, after, left);
        let next = nose.pushed(ball, rates, step * share);
        work += 0.5 * (before + next.velocity.dot(normal)).abs() * step * share;
        for (impact, rate, contact) in
            [(&mut impacts.0, rates.0, normal), (&mut impacts.1, rates.1, bed.normal)]
        {
            let impulse = rate * (step * share);
            let surface = ball.surface_velocity(contact) + next.surface_velocity(contact);
            impact.impulse += impulse;
            impact.loss_j -= 0.5 * impulse.dot(surface);
        }
        *ball = next;
        match goal {
            None if after >= 0.0 => {
                goal = Some(law.restitution * law.restitution * work);
                work = 0.0;
            }
            Some(_) if share < 1.0 => break,
            _ => {}
        }
    }
    impacts.0.sticks = nose.slip(ball, normal).length() < 1e-9 * approach.abs();
    impacts
}

struct Nose {
    normal: DVec3,
    bed: Bed,
    friction: f64,
}

impl Nose {
    fn slip(&self, ball: &Mover, normal: DVec3) -> DVec3 {
        let surface = ball.surface_velocity(normal);
        surface - normal * surface.dot(normal)
    }

    /// Impulses of cushion and bed per normal impulse of the cushion.
    fn rates(&self, ball: &Mover) -> (DVec3, DVec3) {
        let direction = |slip: DVec3| {
            let size = slip.length();
            if size > SLIP_M_S { slip / size } else { DVec3::ZERO }
        };
        let cushion = self.normal - direction(self.slip(ball, self.normal)) * self.friction;
        let support = self.bed.normal;
        let pressed = -cushion.dot(support);
        let cloth = direction(self.slip(ball, support)) * (self.bed.friction * pressed.max(0.0));
        (cushion, support * pressed - cloth)
    }

    fn pushed(&self, ball: &Mover, rates: (DVec3, DVec3), step: f64) -> Mover {
        let mut next = *ball;
        next.push(self.normal, rates.0 * step);
        next.push(self.bed.normal, rates.1 * step);
        next
    }

    fn midpoint(&self, ball: &Mover, step: f64) -> (DVec3, DVec3) {
        self.rates(&self.pushed(ball, self.rates(ball), 0.5 * step))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;

    fn rolls_into_the_cushion(speed: f64) -> (Mover, f64) {
        let snooker = Ball { mass_kg: 0.1406, radius_m: 0.02625, ..Ball::pool(BallId(1)) };
        let mut ball = Mover::new(&snooker, DVec3::X * speed, DVec3::Y * (speed / 0.02625));
        let before = ball.kinetic_j();
        let normal = DVec3::new(-(1.0_f64 - 0.16).sqrt(), 0.0, -0.4);
        let bed = Bed { normal: DVec3::Z, friction: 0.212 };
        let (cushion, cloth) = bounce(&mut ball, normal, bed, CUSHION);
        let lost = before - ball.kinetic_j();
        assert!((cushion.loss_j + cloth.loss_j - lost).abs() < 1e-12);
        (ball, lost)
    }

    #[test]
    fn a_perpendicular_rebound_keeps_the_published_share_of_any_speed() {
        for speed in [0.3, 1.0, 2.5] {
            let (ball, lost) = rolls_into_the_cushion(speed);
            assert!((-ball.velocity.x / speed - 0.910659).abs() < 1e-4, "{}", ball.velocity);
            assert!(ball.velocity.z.abs() < 1e-12 && 0.0 < lost);
        }
    }
}
