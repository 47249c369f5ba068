//! Several contacts at one instant: rounds of joint impulses.
//!
//! At 10 m/s billiard balls compress by most of a millimetre, so the contacts of a tight rack, or
//! of a ball that lies at a cushion, act at the same time. The rule: take all contacts that close
//! now, solve their impulses jointly with their restitution (projected Gauss-Seidel: normal
//! impulses ≥ 0, friction within its disc), and repeat until none closes. A blow then travels
//! through a cradle from pair to pair, and one ball that meets two sends both off symmetrically; a
//! plain loop over pairs fails the second, one global solve the first.
//!
//! Newton's restitution and friction together may add energy where impulses pass through several
//! contacts (Stronge 1990). A round that would is mixed with its own solution without restitution,
//! just so far that nothing is added; impulses that push and lie within their friction discs stay
//! so when mixed, and so do velocities that part.
//!
//! Limits: after [`tolerance::CLUSTER_ROUNDS`] rounds contacts lose their restitution. Compared
//! with elastic (Hertz) contacts the cue, corner and last-row balls of a break are within 1 to 15
//! %; the slow apex ball is not.

use super::{Mover, one_ball};
use crate::physics::tolerance;
use glam::DVec3;
use smallvec::SmallVec;

/// One contact of a cluster.
#[derive(Debug, Clone, Copy)]
pub struct Touch {
    /// The first ball: a place in the list of movers.
    pub a: usize,
    /// The second ball; none for a fixed surface.
    pub b: Option<usize>,
    /// Unit vector from the second body to the first.
    pub normal: DVec3,
    /// Restitution.
    pub restitution: f64,
    /// Approaches up to this speed have no restitution [m/s]: a round may close a contact that was
    /// open or at rest before, so each round decides anew.
    pub sticky_m_s: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// A surface that carries the ball: it acts in every round, without restitution.
    pub carries: bool,
    /// Energy lost here so far [J].
    pub loss_j: f64,
    /// Impulse on the first ball so far [N s].
    pub impulse: DVec3,
}

impl Touch {
    /// A contact that nothing has acted on yet.
    pub fn new(a: usize, b: Option<usize>, normal: DVec3, law: crate::physics::Contact) -> Self {
        Touch {
            a,
            b,
            normal,
            restitution: law.restitution,
            sticky_m_s: 0.0,
            friction: law.friction,
            carries: false,
            loss_j: 0.0,
            impulse: DVec3::ZERO,
        }
    }

    /// Normal speed at which the two bodies part [m/s]; negative while they close.
    pub fn parting_m_s(&self, movers: &[Mover]) -> f64 {
        self.slip(movers).dot(self.normal)
    }

    fn slip(&self, movers: &[Mover]) -> DVec3 {
        let own = movers[self.a].surface_velocity(self.normal);
        match self.b {
            Some(b) => own - movers[b].surface_velocity(-self.normal),
            None => own,
        }
    }

    fn push(&self, movers: &mut [Mover], impulse: DVec3) {
        movers[self.a].push(self.normal, impulse);
        if let Some(b) = self.b {
            movers[b].push(-self.normal, -impulse);
        }
    }

    fn compliance(&self, movers: &[Mover]) -> (f64, f64) {
        let (a, b) = (&movers[self.a], self.b.map(|b| &movers[b]));
        (
            a.inverse_mass + b.map_or(0.0, |b| b.inverse_mass),
            a.tangential_compliance() + b.map_or(0.0, Mover::tangential_compliance),
        )
    }
}

/// One contact within one round.
#[derive(Clone)]
struct Active {
    index: usize,
    slip: DVec3,
    target: f64,
    normal_compliance: f64,
    tangential_compliance: f64,
    normal_impulse: f64,
    tangential_impulse: DVec3,
}

impl Active {
    /// Impulse on the first ball [N s].
    fn impulse(&self, touches: &[Touch]) -> DVec3 {
        touches[self.index].normal * self.normal_impulse + self.tangential_impulse
    }

    /// Energy that it takes in this round [J].
    fn loss_j(&self, touches: &[Touch], movers: &[Mover]) -> f64 {
        -0.5 * self.impulse(touches).dot(self.slip + touches[self.index].slip(movers))
    }
}

/// The balls with a contact that closes.
#[derive(Default)]
struct Struck {
    any: bool,
    /// A bit for each of the first balls; one beyond them counts as struck.
    bits: u64,
}

impl Struck {
    fn note(&mut self, touch: &Touch) {
        self.any = true;
        let bit = |ball: usize| if ball < 64 { 1 << ball } else { 0 };
        self.bits |= bit(touch.a) | touch.b.map_or(0, bit);
    }

    fn has(&self, ball: usize) -> bool {
        64 <= ball || self.bits >> ball & 1 == 1
    }
}

/// Resolves all contacts of a cluster. Returns whether none closes any more.
pub fn resolve(movers: &mut [Mover], touches: &mut [Touch]) -> bool {
    let mut active: Vec<Active> = Vec::with_capacity(touches.len());
    let mut slips: Vec<DVec3> = Vec::with_capacity(touches.len());
    for round in 0..2 * tolerance::CLUSTER_ROUNDS {
        let elastic = round < tolerance::CLUSTER_ROUNDS;
        active.clear();
        slips.clear();
        slips.extend(touches.iter().map(|touch| touch.slip(movers)));
        let mut struck = Struck::default();
        for (touch, slip) in touches.iter().zip(&slips) {
            if slip.dot(touch.normal) < -tolerance::CLOSING_M_S {
                struck.note(touch);
            }
            // A ball that carries another passes on what strikes it.
            if touch.carries && touch.b.is_some() {
                struck.bits = u64::MAX;
            }
        }
        if !struck.any {
            return true;
        }
        for (index, (touch, slip)) in touches.iter().zip(&slips).enumerate() {
            let approach = slip.dot(touch.normal);
            let closing = approach < -tolerance::CLOSING_M_S;
            // What carries a ball that nothing strikes has nothing to answer.
            let acts = closing || touch.carries && struck.has(touch.a);
            let (normal_compliance, tangential_compliance) = touch.compliance(movers);
            if acts && normal_compliance > 0.0 {
                let bounces = elastic && touch.sticky_m_s < -approach;
                let restitution = if bounces { touch.restitution } else { 0.0 };
                let target = if touch.carries { 0.0 } else { -restitution * approach };
                active.push(Active {
                    index,
                    slip: *slip,
                    target,
                    normal_compliance,
                    tangential_compliance,
                    normal_impulse: 0.0,
                    tangential_impulse: DVec3::ZERO,
                });
            }
        }
        solve(movers, touches, &mut active);
        if active.len() > 1 && active.iter().any(|contact| contact.target > 0.0) {
            temper(movers, touches, &mut active);
        }

        // The work of an impulse is J·(u + u′)/2; summed over the contacts it is exact.
        for contact in &active {
            let impulse = contact.impulse(touches);
            let loss_j = contact.loss_j(touches, movers);
            let touch = &mut touches[contact.index];
            touch.loss_j += loss_j;
            touch.impulse += impulse;
        }
    }
    false
}

/// Finds the impulses of a round and applies them.
fn solve(movers: &mut [Mover], touches: &[Touch], active: &mut [Active]) {
    if !solve_one_ball(movers, touches, active) {
        solve_round(movers, touches, active);
    }
}

/// Takes back what a round adds to the energy, if it does: mixes its impulses with those without
/// restitution, which lose at least as much as they must.
///
/// The loss is quadratic in the share s of the elastic impulses: with w = J₁ − J₀ it is
/// L(s) = L(0) + b s + c s², known from L(0), L(1) and c = −½ w·(u₁ − u₀).
fn temper(movers: &mut [Mover], touches: &[Touch], active: &mut [Active]) {
    let loss = |movers: &[Mover], active: &[Active]| -> f64 {
        active.iter().map(|contact| contact.loss_j(touches, movers)).sum()
    };
    let elastic_loss = loss(movers, active);
    if elastic_loss >= 0.0 {
        return;
    }
    let elastic: Vec<Active> = active.to_vec();
    let slips: Vec<DVec3> = active.iter().map(|c| touches[c.index].slip(movers)).collect();
    for contact in active.iter_mut() {
        touches[contact.index].push(movers, -contact.impulse(touches));
        contact.target = 0.0;
        contact.normal_impulse = 0.0;
        contact.tangential_impulse = DVec3::ZERO;
    }
    solve(movers, touches, active);
    let soft_loss = loss(movers, active).max(0.0);
    let curve: f64 = elastic
        .iter()
        .zip(active.iter())
        .zip(&slips)
        .map(|((one, other), slip)| {
            let change = one.impulse(touches) - other.impulse(touches);
            -0.5 * change.dot(*slip - touches[one.index].slip(movers))
        })
        .sum();
    // The last share at which nothing is gained: L(s) = 0, and c ≤ 0 because kinetic energy is
    // convex.
    let slope = elastic_loss - soft_loss - curve;
    let share = if curve < 0.0 {
        let root = (slope * slope - 4.0 * curve * soft_loss).max(0.0).sqrt();
        (slope + root) / (-2.0 * curve)
    } else {
        soft_loss / (soft_loss - elastic_loss)
    };
    let share = share.clamp(0.0, 1.0);
    for (contact, one) in active.iter_mut().zip(&elastic) {
        let change = (one.impulse(touches) - contact.impulse(touches)) * share;
        touches[contact.index].push(movers, change);
        contact.normal_impulse += (one.normal_impulse - contact.normal_impulse) * share;
        contact.tangential_impulse += (one.tangential_impulse - contact.tangential_impulse) * share;
    }
}

/// A round of one ball among fixed surfaces, directly; false if it is no such round or there is no
/// answer.
fn solve_one_ball(movers: &mut [Mover], touches: &[Touch], active: &mut [Active]) -> bool {
    let [ball] = movers else { return false };
    if active.len() > one_ball::SURFACES_MAX {
        return false;
    }
    let surfaces: SmallVec<[one_ball::Surface; one_ball::SURFACES_MAX]> = active
        .iter()
        .map(|contact| {
            let Touch { normal, friction, .. } = touches[contact.index];
            one_ball::Surface { normal, target_m_s: contact.target, friction }
        })
        .collect();
    let Some(impulses) = one_ball::solve(ball, &surfaces) else { return false };
    for (contact, impulse) in active.iter_mut().zip(impulses) {
        let normal = touches[contact.index].normal;
        contact.normal_impulse = impulse.dot(normal);
        contact.tangential_impulse = impulse - normal * contact.normal_impulse;
        ball.push(normal, impulse);
    }
    true
}

/// Projected Gauss-Seidel over the contacts of a round.
fn solve_round(movers: &mut [Mover], touches: &[Touch], active: &mut [Active]) {
    for _ in 0..tolerance::CLUSTER_ITERATIONS {
        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for contact in active.iter_mut() {
            let touch = &touches[contact.index];

            let approach = touch.slip(movers).dot(touch.normal);
            let wanted =
                contact.normal_impulse + (contact.target - approach) / contact.normal_compliance;
            let step = wanted.max(0.0) - contact.normal_impulse;
            contact.normal_impulse += step;
            touch.push(movers, touch.normal * step);
            change = change.max(step.abs());
            size = size.max(contact.normal_impulse);

            if touch.friction > 0.0 {
                let slip = touch.slip(movers);
                let tangential = slip - touch.normal * slip.dot(touch.normal);
                let wanted =
                    contact.tangential_impulse - tangential / contact.tangential_compliance;
                let wanted = wanted.clamp_length_max(touch.friction * contact.normal_impulse);
                let step = wanted - contact.tangential_impulse;
                contact.tangential_impulse = wanted;
                touch.push(movers, step);
                change = change.max(step.length());
            }
        }
        if change <= tolerance::CLUSTER_RELATIVE * size {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::Ball;
    use crate::ids::BallId;
    use crate::physics::Contact;

    const SMOOTH: Contact = Contact { restitution: 1.0, friction: 0.0 };

    fn row(speeds: &[f64]) -> Vec<Mover> {
        let ball = Ball::pool(BallId(1));
        speeds.iter().map(|v| Mover::new(&ball, DVec3::X * *v, DVec3::ZERO)).collect()
    }

    #[test]
    fn one_ball_at_two_or_three_surfaces_is_solved_as_by_gauss_seidel() {
        // Cushion and bed, a corner, a corner and the bed; any spin, smooth to rough.
        let nose = DVec3::new(-(1.0_f64 - 0.0729).sqrt(), 0.0, -0.27);
        let side = DVec3::new(0.0, nose.x, -0.27);
        let mut compared = 0;
        for case in 0..3000_u32 {
            let random = |k: u32| {
                let x = case.wrapping_mul(2_654_435_761).wrapping_add(k.wrapping_mul(40_503));
                let x = (x ^ (x >> 15)).wrapping_mul(2_246_822_519);
                f64::from(x ^ (x >> 13)) / f64::from(u32::MAX)
            };
            let spin = DVec3::new(random(1), random(2), random(3)) * 300.0 - 150.0;
            let velocity = DVec3::new(0.1 + 4.0 * random(4), 4.0 * random(5) - 2.0, 0.0);
            let mut movers = [Mover::new(&Ball::pool(BallId(1)), velocity, spin)];
            let mut surfaces = vec![(nose, 0.85, 0.4 * random(6))];
            if case % 3 > 0 {
                surfaces.push((side, 0.85, 0.2));
            }
            if case % 3 != 1 {
                surfaces.push((DVec3::Z, 0.0, 0.4 * random(7)));
            }
            let touches: Vec<Touch> = surfaces
                .iter()
                .map(|(normal, restitution, friction)| {
                    let law = Contact { restitution: *restitution, friction: *friction };
                    Touch::new(0, None, *normal, law)
                })
                .collect();
            let start = movers;
            let round = |movers: &[Mover]| -> Vec<Active> {
                let active = |(index, touch): (usize, &Touch)| {
                    let slip = touch.slip(movers);
                    let (normal_compliance, tangential_compliance) = touch.compliance(movers);
                    Active {
                        index,
                        slip,
                        target: touch.restitution * (-slip.dot(touch.normal)).max(0.0),
                        normal_compliance,
                        tangential_compliance,
                        normal_impulse: 0.0,
                        tangential_impulse: DVec3::ZERO,
                    }
                };
                touches.iter().enumerate().map(active).collect()
            };
            let mut active = round(&movers);
            if !solve_one_ball(&mut movers, &touches, &mut active) {
                continue;
            }
            compared += 1;
            let mut swept = start;
            let mut active = round(&swept);
            solve_round(&mut swept, &touches, &mut active);
            let apart = (movers[0].velocity - swept[0].velocity).length();
            assert!(apart < 1e-9, "case {case}: {apart}");
            let apart = (movers[0].angular_velocity - swept[0].angular_velocity).length();
            assert!(apart < 1e-7, "case {case}: {apart}");
        }
        assert!(compared > 2900, "{compared}");
    }

    #[test]
    fn a_blow_travels_through_a_touching_cradle() {
        let mut movers = row(&[3.0, 0.0, 0.0]);
        let mut touches =
            [Touch::new(1, Some(0), DVec3::X, SMOOTH), Touch::new(2, Some(1), DVec3::X, SMOOTH)];
        assert!(resolve(&mut movers, &mut touches));
        let speeds: Vec<f64> = movers.iter().map(|m| m.velocity.x).collect();
        assert!(speeds[0].abs() < 1e-10 && speeds[1].abs() < 1e-10, "{speeds:?}");
        assert!((speeds[2] - 3.0).abs() < 1e-10);
    }

    #[test]
    fn one_ball_that_meets_two_comes_back_with_a_fifth() {
        // Elastic, symmetric at 30°: v0' = −v/5, the others 2√3/5 v along the lines of centres.
        let mut movers = row(&[3.0, 0.0, 0.0]);
        let (c, s) = (0.75_f64.sqrt(), 0.5);
        let mut touches = [
            Touch::new(1, Some(0), DVec3::new(c, s, 0.0), SMOOTH),
            Touch::new(2, Some(0), DVec3::new(c, -s, 0.0), SMOOTH),
        ];
        assert!(resolve(&mut movers, &mut touches));
        assert!((movers[0].velocity - DVec3::X * -0.6).length() < 1e-10);
        assert!((movers[1].velocity.length() - 3.0 * 2.0 * 3.0_f64.sqrt() / 5.0).abs() < 1e-10);
        assert!((movers[1].velocity.y + movers[2].velocity.y).abs() < 1e-10);
    }

    #[test]
    fn energy_lost_at_the_contacts_is_the_energy_the_balls_lost() {
        let law = Contact { restitution: 0.9, friction: 0.1 };
        let mut movers = row(&[3.0, 0.0, -1.0]);
        movers[0].angular_velocity = DVec3::new(30.0, 60.0, -80.0);
        let before: f64 = movers.iter().map(Mover::kinetic_j).sum();
        let mut touches = [
            Touch::new(1, Some(0), DVec3::new(0.8, 0.6, 0.0), law),
            Touch::new(2, Some(1), DVec3::X, law),
            Touch { carries: true, ..Touch::new(0, None, DVec3::Z, law) },
        ];
        assert!(resolve(&mut movers, &mut touches));
        let after: f64 = movers.iter().map(Mover::kinetic_j).sum();
        let lost: f64 = touches.iter().map(|t| t.loss_j).sum();
        assert!(0.0 < lost && (before - after - lost).abs() < 1e-12 * before);
    }

    /// The tight rack of fifteen, hit straight at 10 m/s.
    fn rack(law: Contact) -> (Vec<Mover>, Vec<Touch>) {
        let ball = Ball::pool(BallId(1));
        let d = 2.0 * ball.radius_m;
        let mut places = vec![DVec3::X * -d];
        for row in 0..5 {
            for k in 0..=row {
                let y = (f64::from(k) - 0.5 * f64::from(row)) * d;
                places.push(DVec3::new(f64::from(row) * d * 0.75_f64.sqrt(), y, 0.0));
            }
        }
        let mut movers: Vec<Mover> =
            places.iter().map(|_| Mover::new(&ball, DVec3::ZERO, DVec3::ZERO)).collect();
        movers[0].velocity = DVec3::X * 10.0;
        let mut touches = Vec::new();
        for a in 0..places.len() {
            for b in 0..a {
                let apart = places[a] - places[b];
                if apart.length() < d * 1.0001 {
                    touches.push(Touch::new(a, Some(b), apart.normalize(), law));
                }
            }
        }
        (movers, touches)
    }

    #[test]
    fn restitution_with_friction_adds_no_energy() {
        // Of 8.5 J Newton's restitution alone would make 8.9.
        for friction in [0.05, 0.2, 0.5] {
            let (mut movers, mut touches) = rack(Contact { restitution: 1.0, friction });
            let before: f64 = movers.iter().map(Mover::kinetic_j).sum();
            resolve(&mut movers, &mut touches);
            let after: f64 = movers.iter().map(Mover::kinetic_j).sum();
            assert!(after <= before + 1e-12, "{friction}: {before} {after}");
            assert!(after > 0.5 * before, "{friction}: {before} {after}");
        }
    }

    /// The tight rack of fifteen, hit straight at 10 m/s, without friction. Expected: the same
    /// rounds computed independently, which lie within 1 to 15 % of Hertz contacts but for the
    /// apex ball (cue -1.61, corners 5.21, apex 0.27, row two 1.18, middle of the last row 2.10
    /// m/s).
    #[test]
    fn a_break_drives_the_corner_balls_out() {
        let law = Contact { restitution: 0.95, friction: 0.0 };
        let (mut movers, mut touches) = rack(law);
        assert_eq!(touches.len(), 31);
        assert!(resolve(&mut movers, &mut touches));
        let speed = |i: usize| movers[i].velocity.length();
        assert!((movers[0].velocity.x + 1.61).abs() < 0.01, "cue {:?}", movers[0].velocity);
        assert!((speed(11) - 5.21).abs() < 0.01 && (speed(15) - 5.21).abs() < 0.01);
    }
}
