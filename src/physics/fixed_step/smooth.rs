//! The smooth part of a step: gravity, springs, and what carries the balls.

use super::FixedStep;
use super::body::{Body, Path, Support};
use crate::ball::Motion;
use crate::physics::laws::cloth::{self, Carrying};
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::laws::{Impact, Mover};
use crate::physics::{Integrator, Profile, spring, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// A ball's motion under the smooth forces alone, after one step.
struct Free {
    displacement: DVec3,
    velocity: DVec3,
    angular_velocity: DVec3,
}

impl FixedStep {
    /// Gives every moving ball its velocity at the end of the step and its straight path there.
    pub(super) fn smooth(&mut self) {
        for index in 0..self.bodies.len() {
            if self.bodies[index].active() {
                self.smooth_ball(index);
            }
        }
    }

    fn smooth_ball(&mut self, index: usize) {
        self.work.force_evaluations += match self.settings.integrator {
            Integrator::EulerCromer => 1,
            Integrator::Verlet | Integrator::PositionVerlet => 2,
            Integrator::Rk4 => 4,
        };
        let h = self.h;
        let body = &self.bodies[index];
        let before = body.mover();
        let free = self.integrate(body);

        // Work of the smooth forces: impulse times mean velocity.
        let mass = body.ball.mass_kg;
        let weighs = body.ball.flags.gravity;
        let gravity =
            if weighs { DVec3::NEG_Z * (self.parameters.gravity_m_s2 * h) } else { DVec3::ZERO };
        let mean = 0.5 * (before.velocity + free.velocity);
        let force_kick = free.velocity - before.velocity;
        let spin_kick = free.angular_velocity - before.angular_velocity;
        let mean_spin = 0.5 * (before.angular_velocity + free.angular_velocity);
        self.ledger.integration_j += mass * gravity.dot(mean);
        if body.ball.spring.is_some() {
            self.ledger.spring_j += mass * (force_kick - gravity).dot(mean)
                + body.ball.inertia_kg_m2() * spin_kick.dot(mean_spin);
        }
        self.ledger.momentum.smooth += mass * force_kick;

        // What carries the ball takes the normal part and gives friction. The paper has no such
        // thing: there a lying ball falls into the bed and is thrown back, step by step.
        let mut mover =
            Mover { velocity: free.velocity, angular_velocity: free.angular_velocity, ..before };
        let carriers = if self.settings.profile == Profile::Standard {
            self.carriers(body, free.velocity, force_kick)
        } else {
            SmallVec::new()
        };
        let Impact { impulse, sticks, mut loss_j } = self.carry(&mut mover, &carriers);
        if let [support] = &carriers[..] {
            // What the step's forces press in comes from no height and is no loss.
            let pressed = force_kick.dot(support.normal).min(0.0);
            let pressed_j = 0.5 * mass * pressed * pressed;
            loss_j -= pressed_j;
            self.ledger.integration_j -= pressed_j;
        }
        self.ledger.cloth_j += loss_j;
        self.ledger.momentum.table += impulse;

        // The path. A force that acts during the whole step moves the ball by half of its kick; in
        // Euler-Cromer by all of it.
        let change = mover.velocity - free.velocity;
        let rests = before.velocity == DVec3::ZERO && mover.velocity == DVec3::ZERO;
        let mut path_velocity = match self.settings.integrator {
            _ if rests => DVec3::ZERO,
            Integrator::EulerCromer => mover.velocity,
            Integrator::Verlet | Integrator::Rk4 => free.displacement / h + 0.5 * change,
            // Its way is a velocity half a step ago, so that a force moves it by all of its kick.
            Integrator::PositionVerlet => free.displacement / h + change,
        };
        for Support { normal, .. } in &carriers {
            path_velocity -= *normal * path_velocity.dot(*normal).min(0.0);
            if self.settings.integrator == Integrator::PositionVerlet {
                // Its last way knows nothing of what carries the ball since.
                path_velocity += *normal * (mover.velocity - path_velocity).dot(*normal);
            }
        }
        // It would have fallen there within the step.
        let mut position = body.position;
        for support in &carriers {
            if support.gap_m > tolerance::PUSH_OUT_M && force_kick.dot(support.normal) < 0.0 {
                position -= support.normal * support.gap_m;
            }
        }

        let stops = mover.velocity == DVec3::ZERO && before.velocity != DVec3::ZERO;
        self.changes |= stops || (sticks && self.bodies[index].motion == Motion::Sliding);
        let mut way = None;
        if self.settings.integrator == Integrator::PositionVerlet {
            let slid = mover.velocity;
            let plain = position == self.bodies[index].position && carriers.len() < 2;
            if plain && mover.velocity != DVec3::ZERO {
                way = Some(path_velocity * h);
                mover.velocity = self.told_by_ways(index, path_velocity, &mover, change, &carriers);
            }
            let off = mover.velocity - slid;
            self.ledger.integration_j += mass * off.dot(slid + 0.5 * off);
            self.ledger.momentum.smooth += mass * off;
        }

        let body = &mut self.bodies[index];
        body.way = way;
        body.pushed = DVec3::ZERO;
        body.kick = mover.velocity - before.velocity;
        body.take(&mover);
        body.path = Path { position, velocity: path_velocity, ..Path::default() };
    }

    /// The velocity at the end of a step, as the position form of Verlet tells it from the way of
    /// the step: that of its middle, and half of what the forces do. What carries the ball has its
    /// say.
    fn told_by_ways(
        &self,
        index: usize,
        path_velocity: DVec3,
        mover: &Mover,
        change: DVec3,
        carriers: &[Support],
    ) -> DVec3 {
        let (h, body) = (self.h, &self.bodies[index]);
        let end = body.position + path_velocity * h;
        let (force, _) = self.acceleration(body, h, end, path_velocity, mover.angular_velocity);
        let mut velocity = path_velocity + 0.5 * (force * h + change);
        for support in carriers {
            velocity += support.normal * (mover.velocity - velocity).dot(support.normal);
        }
        velocity
    }

    /// The surfaces that carry a ball in this step: it touches them, or will within the step, and
    /// all that presses it into them is this step's force. A ball that comes faster is an impact;
    /// one that comes more slowly is in flight.
    fn carriers(&self, body: &Body, velocity: DVec3, kick: DVec3) -> SmallVec<[Support; 2]> {
        body.supports
            .iter()
            .filter(|support| {
                let approach = -velocity.dot(support.normal);
                let pressed = (-kick.dot(support.normal)).max(0.0);
                let near = support.gap_m <= (approach * self.h).max(tolerance::PUSH_OUT_M);
                let slow = approach <= (1.01 * pressed).max(tolerance::LANDING_M_S);
                0.0 <= approach && near && slow
            })
            .copied()
            .collect()
    }

    /// Friction and normal impulses of all that carries a ball.
    fn carry(&self, mover: &mut Mover, carriers: &[Support]) -> Impact {
        match carriers {
            [] => Impact::default(),
            [support] => {
                let law = self.carrying(support);
                cloth::carry(mover, support.normal, &law, self.h)
            }
            several => {
                let mut touches: SmallVec<[Touch; 4]> = several
                    .iter()
                    .map(|support| {
                        let law = self.parameters.surface(support.surface);
                        Touch { carries: true, ..Touch::new(0, None, support.normal, law) }
                    })
                    .collect();
                cluster::resolve(core::slice::from_mut(mover), &mut touches);
                let mut loss_j: f64 = touches.iter().map(|touch| touch.loss_j).sum();
                let mut impulse: DVec3 = touches.iter().map(|touch| touch.impulse).sum();

                // The one that carries most decides how the ball rolls.
                let pressed = |touch: &Touch| touch.impulse.dot(touch.normal);
                let main = (0..several.len())
                    .max_by(|a, b| pressed(&touches[*a]).total_cmp(&pressed(&touches[*b])));
                if let Some(main) = main {
                    let (touch, support) = (&touches[main], &several[main]);
                    let slip = mover.surface_velocity(touch.normal);
                    let slip = slip - touch.normal * slip.dot(touch.normal);
                    let rolls = slip.length() <= tolerance::ROLLING_SLIP_M_S;
                    let law = self.carrying(support);
                    let (normal, normal_impulse) = (touch.normal, pressed(touch));
                    let (rolled, slid) = (f64::from(rolls), mover.velocity);
                    loss_j += cloth::resist(mover, normal, normal_impulse, rolled, &law, self.h);
                    if mover.inverse_mass > 0.0 {
                        impulse += (mover.velocity - slid) / mover.inverse_mass;
                    }
                }
                Impact { impulse, sticks: false, loss_j }
            }
        }
    }

    fn carrying(&self, support: &Support) -> Carrying {
        self.parameters.carrying(self.parameters.surface(support.surface).friction)
    }

    /// One step of the chosen integrator under gravity and the ball's spring (paper, section 2.3).
    ///
    /// Contacts are the same for all; between them the forces are constant unless there is a
    /// spring, so a finer integrator gains little on a billiard table: what is lost lies in the
    /// steps that have a contact.
    fn integrate(&self, body: &Body) -> Free {
        let (h, v, w) = (self.h, body.velocity, body.angular_velocity);
        let start = (body.position, v, w);
        let force = |dt: Seconds, position: DVec3, velocity: DVec3, spin: DVec3| {
            self.acceleration(body, dt, position, velocity, spin)
        };
        let (x0, _, _) = start;
        match self.settings.integrator {
            Integrator::EulerCromer => {
                let (a, b) = force(0.0, x0, v, w);
                let velocity = v + a * h;
                Free { displacement: velocity * h, velocity, angular_velocity: w + b * h }
            }
            Integrator::Verlet => {
                let (a0, b0) = force(0.0, x0, v, w);
                let displacement = v * h + a0 * (0.5 * h * h);
                let (a1, b1) = force(h, x0 + displacement, v + a0 * h, w + b0 * h);
                Free {
                    displacement,
                    velocity: v + (a0 + a1) * (0.5 * h),
                    angular_velocity: w + (b0 + b1) * (0.5 * h),
                }
            }
            Integrator::PositionVerlet => {
                let (a0, b0) = force(0.0, x0, v, w);
                let way = body.way.unwrap_or(v * h - a0 * (0.5 * h * h) + body.pushed);
                let displacement = way + a0 * (h * h);
                let (a1, b1) = force(h, x0 + displacement, displacement / h, w + b0 * h);
                Free {
                    displacement,
                    velocity: v + (a0 + a1) * (0.5 * h),
                    angular_velocity: w + (b0 + b1) * (0.5 * h),
                }
            }
            Integrator::Rk4 => {
                let half = 0.5 * h;
                let (a1, b1) = force(0.0, x0, v, w);
                let (v2, w2) = (v + a1 * half, w + b1 * half);
                let (a2, b2) = force(half, x0 + v * half, v2, w2);
                let (v3, w3) = (v + a2 * half, w + b2 * half);
                let (a3, b3) = force(half, x0 + v2 * half, v3, w3);
                let (v4, w4) = (v + a3 * h, w + b3 * h);
                let (a4, b4) = force(h, x0 + v3 * h, v4, w4);
                Free {
                    displacement: (v + 2.0 * v2 + 2.0 * v3 + v4) * (h / 6.0),
                    velocity: v + (a1 + 2.0 * a2 + 2.0 * a3 + a4) * (h / 6.0),
                    angular_velocity: w + (b1 + 2.0 * b2 + 2.0 * b3 + b4) * (h / 6.0),
                }
            }
        }
    }

    /// Acceleration and angular acceleration of a ball in the given state, `dt` into the step.
    fn acceleration(
        &self,
        body: &Body,
        dt: Seconds,
        position: DVec3,
        velocity: DVec3,
        spin: DVec3,
    ) -> (DVec3, DVec3) {
        let weight = if body.ball.flags.gravity {
            DVec3::NEG_Z * self.parameters.gravity_m_s2
        } else {
            DVec3::ZERO
        };
        match &body.ball.spring {
            None => (weight, DVec3::ZERO),
            Some(spring) => {
                let orientation = spring::turned(body.orientation, body.angular_velocity, dt);
                let (linear, angular) =
                    spring::acceleration(&body.ball, spring, position, velocity, orientation, spin);
                (weight + linear, angular)
            }
        }
    }
}
