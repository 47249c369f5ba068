//! Balls that yield: a cluster of elastic contacts, followed in time.
//!
//! Rigid impulses must decide in which order the contacts of a tight rack act; elastic ones need no
//! such rule, because every contact has its duration. This is the reference for
//! [`super::cluster`], and can be chosen instead of it.

use super::Mover;
use super::cluster::Touch;
use crate::units::Seconds;
use glam::DVec3;

/// Young's modulus of phenolic resin [Pa]; assumed.
pub const YOUNGS_MODULUS_PA: f64 = 5.84e9;
/// Poisson's ratio of phenolic resin; assumed.
pub const POISSON_RATIO: f64 = 0.34;
/// The speed of approach at which a pair keeps the restitution that its law names [m/s]. Viscous
/// contacts keep more of a slower approach: 1 − e grows with the fifth root of the speed.
pub const REFERENCE_M_S: f64 = 5.0;
/// Step of the integration [s]: at 5 µs results agree with those at 0.1 µs to 0.1 % (1 % for the
/// slow apex ball of a rack); the contact of two pool balls at 1 m/s lasts 350 µs.
pub const STEP_S: Seconds = 2e-6;
/// A cluster that has not parted by then is handed back as it is [s].
const LONGEST_S: Seconds = 5e-3;

/// Lets the balls of a cluster collide; `gaps_m` are the distances of the surfaces of each touch at
/// the start. Returns whether all contacts have parted.
///
/// Each contact follows Hertz with the damping of Kuwabara and Kono 1987,
/// ```text
/// F = k δ^(3/2) + γ δ^(1/2) δ′ ≥ 0
/// k = 4/3 E* √R*     1/E* = 2 (1 − ν²)/E     1/R* = 1/R_a + 1/R_b
/// ```
/// γ such that a pair keeps the restitution of its touch at [`REFERENCE_M_S`]. Velocity Verlet at
/// [`STEP_S`]. Surfaces that carry a ball do not yield: they only keep it from being pressed in.
/// Limits: no friction; the normals are those of the start (a ball of a break moves by some
/// millimetres meanwhile); the balls themselves stay where they are, as in every impulse law.
pub fn resolve(movers: &mut [Mover], touches: &mut [Touch], gaps_m: &[f64]) -> bool {
    let before: Vec<Mover> = movers.to_vec();
    let mut viscous = Viscosities::default();
    let contacts: Vec<Contact> = touches
        .iter()
        .zip(gaps_m)
        .map(|(touch, gap_m)| Contact::new(touch, movers, *gap_m, &mut viscous))
        .collect();
    let mut way = vec![DVec3::ZERO; movers.len()];
    let mut push = vec![DVec3::ZERO; movers.len()];
    let (h, half) = (STEP_S, 0.5 * STEP_S);
    let steps = (LONGEST_S / STEP_S) as u32;

    let mut parted = false;
    for step in 0..steps {
        for (mover, push) in movers.iter_mut().zip(&push) {
            mover.velocity += *push * (half * mover.inverse_mass);
        }
        for (mover, way) in movers.iter().zip(&mut way) {
            *way += mover.velocity * h;
        }
        push.fill(DVec3::ZERO);
        let mut acts = false;
        for (contact, touch) in contacts.iter().zip(touches.iter_mut()) {
            let at = |list: &[DVec3]| list[touch.a] - touch.b.map_or(DVec3::ZERO, |b| list[b]);
            let depth = -contact.gap_m - at(&way).dot(touch.normal);
            let closing = -touch.parting_m_s(movers);
            // Whatever overlaps, or will: the cluster is not done with.
            acts |= depth > 0.0 || closing > 0.0 && depth + closing * LONGEST_S > 0.0;
            if depth <= 0.0 || contact.rigid {
                continue;
            }
            let root = depth.sqrt();
            let force = root * (contact.stiffness * depth + contact.damping * closing);
            let force = touch.normal * force.max(0.0);
            push[touch.a] += force;
            if let Some(b) = touch.b {
                push[b] -= force;
            }
            touch.impulse += force * h;
        }
        for (mover, push) in movers.iter_mut().zip(&push) {
            mover.velocity += *push * (half * mover.inverse_mass);
        }
        for (contact, touch) in contacts.iter().zip(touches.iter_mut()) {
            let into = touch.parting_m_s(movers);
            if contact.rigid && into < 0.0 && movers[touch.a].inverse_mass > 0.0 {
                movers[touch.a].velocity -= touch.normal * into;
                touch.impulse -= touch.normal * (into / movers[touch.a].inverse_mass);
            }
        }
        if !acts && step > 0 {
            parted = true;
            break;
        }
    }
    share_loss(&before, movers, touches);
    parted
}

/// One contact of the integration.
struct Contact {
    gap_m: f64,
    stiffness: f64,
    damping: f64,
    rigid: bool,
}

impl Contact {
    fn new(touch: &Touch, movers: &[Mover], gap_m: f64, viscous: &mut Viscosities) -> Self {
        let one = &movers[touch.a];
        let other = touch.b.map(|b| &movers[b]);
        let curvature = 1.0 / one.radius_m + other.map_or(0.0, |ball| 1.0 / ball.radius_m);
        let modulus = YOUNGS_MODULUS_PA / (2.0 * (1.0 - POISSON_RATIO * POISSON_RATIO));
        let stiffness = 4.0 / 3.0 * modulus / curvature.sqrt();
        let inverse = one.inverse_mass + other.map_or(0.0, |ball| ball.inverse_mass);
        let mut contact = Contact { gap_m, stiffness, damping: 0.0, rigid: touch.carries };
        if inverse > 0.0 {
            // Lengths in (m v²/k)^(2/5), times in that over v: one number says how viscous it is.
            let length = libm::pow(REFERENCE_M_S * REFERENCE_M_S / (inverse * stiffness), 0.4);
            contact.damping = viscous.of(touch.restitution) * stiffness * length / REFERENCE_M_S;
        }
        contact
    }
}

/// β of each restitution that was asked for: most contacts of a cluster have the same.
#[derive(Default)]
struct Viscosities(Vec<(f64, f64)>);

impl Viscosities {
    fn of(&mut self, restitution: f64) -> f64 {
        if let Some((_, beta)) = self.0.iter().find(|(known, _)| *known == restitution) {
            return *beta;
        }
        let beta = viscosity(restitution);
        self.0.push((restitution, beta));
        beta
    }
}

/// β of x″ = −x^(3/2) − β √x x′ at which a contact entered with speed 1 is left with speed
/// `restitution`.
fn viscosity(restitution: f64) -> f64 {
    if restitution >= 1.0 {
        return 0.0;
    }
    let left_with = |beta: f64| {
        let (mut x, mut v, h) = (0.0_f64, 1.0_f64, 2e-3);
        let pull = |x: f64, v: f64| -(x.max(0.0).sqrt() * (x + beta * v)).max(0.0);
        for _ in 0..20_000 {
            // Midpoint.
            let (xm, vm) = (x + 0.5 * h * v, v + 0.5 * h * pull(x, v));
            (x, v) = (x + h * vm, v + h * pull(xm, vm));
            if x <= 0.0 {
                break;
            }
        }
        -v
    };
    let (mut low, mut high) = (0.0, 20.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if left_with(middle) > restitution { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The energy that the cluster lost, shared by the contacts as their impulses are.
fn share_loss(before: &[Mover], after: &[Mover], touches: &mut [Touch]) {
    let sum = |movers: &[Mover]| movers.iter().map(Mover::kinetic_j).sum::<f64>();
    let lost = sum(before) - sum(after);
    let total: f64 = touches.iter().map(|touch| touch.impulse.length()).sum();
    for touch in touches.iter_mut().filter(|_| total > 0.0) {
        touch.loss_j += lost * touch.impulse.length() / total;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;
    use crate::physics::Contact as Law;

    const E95: Law = Law { restitution: 0.95, friction: 0.0 };

    fn at_rest(count: usize) -> Vec<Mover> {
        vec![Mover::new(&Ball::pool(BallId(1)), DVec3::ZERO, DVec3::ZERO); count]
    }

    #[test]
    fn a_pair_keeps_the_restitution_asked_for_at_the_reference_speed() {
        for restitution in [1.0, 0.95, 0.7] {
            let mut movers = at_rest(2);
            movers[0].velocity = DVec3::X * REFERENCE_M_S;
            let law = Law { restitution, friction: 0.0 };
            let mut touches = [Touch::new(1, Some(0), DVec3::X, law)];
            assert!(resolve(&mut movers, &mut touches, &[0.0]));
            let parts = (movers[1].velocity.x - movers[0].velocity.x) / REFERENCE_M_S;
            assert!((parts - restitution).abs() < 2e-3, "{restitution}: {parts}");
            let momentum = movers[0].velocity.x + movers[1].velocity.x;
            assert!((momentum - REFERENCE_M_S).abs() < 1e-12);
        }
    }

    #[test]
    fn a_cradle_of_three_and_one_ball_on_two_match_the_study() {
        // 3 m/s: −0.169 / 0.294 / 2.874 for the cradle; −0.5090 for one ball on two.
        let mut movers = at_rest(3);
        movers[0].velocity = DVec3::X * 3.0;
        let mut touches =
            [Touch::new(1, Some(0), DVec3::X, E95), Touch::new(2, Some(1), DVec3::X, E95)];
        assert!(resolve(&mut movers, &mut touches, &[0.0; 2]));
        for (mover, expected) in movers.iter().zip([-0.169, 0.294, 2.874]) {
            assert!((mover.velocity.x - expected).abs() < 5e-3, "{}", mover.velocity.x);
        }

        let mut movers = at_rest(3);
        movers[0].velocity = DVec3::X * 3.0;
        let c = 0.75_f64.sqrt();
        let mut touches = [
            Touch::new(1, Some(0), DVec3::new(c, 0.5, 0.0), E95),
            Touch::new(2, Some(0), DVec3::new(c, -0.5, 0.0), E95),
        ];
        assert!(resolve(&mut movers, &mut touches, &[0.0; 2]));
        assert!((movers[0].velocity.x + 0.509).abs() < 5e-3, "{}", movers[0].velocity.x);
        assert_eq!(movers[1].velocity.y, -movers[2].velocity.y);
    }
}
