//! The paper's own treatment of contacts (sections 2.1, 2.2, 2.4): overlaps at the end of a step.
//!
//! All pairs that overlap are reflected and each ball is reflected at the face that it has entered
//! deepest; friction is the paper's. Known faults that are kept because they are what is to be
//! measured: lying balls fall and rise by fractions of a millimetre, balls that move farther than
//! their radius in a step may pass through faces, only the deepest face of several acts, and
//! without back-dating the contact normal is that at the end of the step.

use super::FixedStep;
use super::body::Support;
use super::narrow;
use super::spatial_hash::Bounds;
use crate::ball::BallPlace;
use crate::mesh::Surface;
use crate::physics::laws::Mover;
use crate::physics::laws::paper_2009::{self, Friction};
use crate::physics::{Contact as Law, roots, tolerance};
use crate::units::Seconds;
use glam::DVec3;

/// The face that a ball has entered deepest.
struct Deepest {
    depth: f64,
    normal: DVec3,
    surface: Surface,
    patch: u64,
}

impl FixedStep {
    /// All contacts of the step that begins at `start`.
    pub(super) fn paper_contacts(&mut self, start: Seconds) {
        let h = self.h;
        self.scratch.balls.clear();
        self.paper_tip(start);
        for index in 0..self.bodies.len() {
            if self.bodies[index].solid() {
                self.update_bounds(index);
            }
        }
        for index in 0..self.bodies.len() {
            if !self.bodies[index].solid() || !self.bodies[index].active() {
                continue;
            }
            let near = self.balls_near(index);
            let partners: smallvec::SmallVec<[usize; 8]> = near
                .iter()
                .copied()
                .filter(|other| *other > index || !self.bodies[*other].active())
                .collect();
            self.scratch.near = near;
            for other in partners {
                self.paper_pair(start, index.min(other), index.max(other));
            }
        }
        for index in 0..self.bodies.len() {
            if self.bodies[index].solid() && self.bodies[index].active() {
                self.paper_face(start, index);
            }
        }
        // Where the paths lead is where the balls are: overlaps are already put back.
        for body in &mut self.bodies {
            let end = body.path.at(h);
            body.path.position = end;
            body.path.velocity = DVec3::ZERO;
            body.path.start = 0.0;
        }
    }

    /// The tip is a ball in the paper; here it strikes as it does everywhere, or a stroke of 10 m/s
    /// would pass through the cue ball in one step.
    fn paper_tip(&mut self, start: Seconds) {
        self.scratch.queue.clear();
        for index in 0..self.bodies.len() {
            if self.bodies[index].solid() {
                self.update_bounds(index);
            }
        }
        self.sweep_tip(start);
        self.scratch.balls.clear();
    }

    fn paper_pair(&mut self, start: Seconds, a: usize, b: usize) {
        self.work.pair_tests += 1;
        let h = self.h;
        let (one, two) = (&self.bodies[a], &self.bodies[b]);
        let reach = one.ball.radius_m + two.ball.radius_m;
        let line = one.path.at(h) - two.path.at(h);
        let depth = reach - line.length();
        let (v, w) = (one.path.velocity, two.path.velocity);
        if depth <= 0.0 || line.dot(v - w) >= 0.0 {
            return;
        }
        self.work.events += 1;

        // When they touched: straight back along their paths.
        let from = one.path.start.max(two.path.start);
        let touched =
            roots::straight(one.path.at(from) - two.path.at(from), v - w, reach, h - from, 0.0)
                .map_or(from, |time| from + time);
        let at = if self.settings.contact_back_dating { touched } else { h };
        let normal = (one.path.at(at) - two.path.at(at)).normalize_or(DVec3::X);
        let (p, q) = (one.mover(), two.mover());
        let slip = p.surface_velocity(normal) - q.surface_velocity(-normal);
        let approach = -slip.dot(normal);
        if approach <= 0.0 {
            return;
        }

        let Law { restitution, friction } = self.parameters.ball;
        let (ua, ub) = paper_2009::reflect(&p, &q, normal, restitution);
        let across = slip + normal * approach;
        let friction = self.paper_friction(friction);
        let kick = |ball: &Mover, other: f64, normal: DVec3, across: DVec3| {
            // F_N = F_G·(−N) + m (1 + d) v_proj / h, v_proj in the frame of the centre of mass.
            let weight = self.parameters.gravity_m_s2 * normal.z.max(0.0);
            let force = (weight + other / h) / ball.inverse_mass.max(f64::MIN_POSITIVE);
            paper_2009::friction(ball, normal, across, force, friction, h)
        };
        let change_a = ua - p.velocity.dot(normal);
        let change_b = ub - q.velocity.dot(normal);
        let (dv, dw) = kick(&p, change_a.abs(), normal, across);
        let (ev, ew) = kick(&q, change_b.abs(), -normal, -across);

        let kicks = [
            (a, p, normal, normal * change_a + dv, dw),
            (b, q, -normal, normal * change_b + ev, ew),
        ];
        for (index, old, side, velocity, spin) in kicks {
            let mut new = old;
            new.velocity += velocity;
            new.angular_velocity += spin;
            if old.inverse_mass > 0.0 {
                // The clamp gives and takes unequal momentum; it is booked with the table's.
                let impulse = velocity / old.inverse_mass;
                self.ledger.ball_ball_j -= work_j(impulse, &old, &new, side);
                self.ledger.momentum.table += impulse;
            }
            self.paper_move(start, index, touched, depth, normal, &new, restitution);
        }
        self.work.contacts += 1;
        let point = self.bodies[a].path.at(h) - normal * self.bodies[a].ball.radius_m;
        self.tell_collision(start + touched, a, b, point, approach);
    }

    /// Takes the new velocity. With back-dating the ball goes on from the moment of contact, else
    /// it is put back to the surface and beyond by p′ = d p (section 2.2.1).
    fn paper_move(
        &mut self,
        start: Seconds,
        index: usize,
        touched: Seconds,
        depth: f64,
        normal: DVec3,
        mover: &Mover,
        restitution: f64,
    ) {
        let (h, back_dating) = (self.h, self.settings.contact_back_dating);
        let body = &mut self.bodies[index];
        let old = body.mover();
        let mut path = body.path;
        if back_dating {
            path.position = path.at(touched);
            path.start = touched;
            path.velocity = mover.velocity;
        } else {
            // Each ball's share of the depth is that of its change of normal velocity.
            let change = (mover.velocity - old.velocity).dot(normal);
            let speed = old.velocity.dot(normal);
            let share =
                if speed != 0.0 { (change / speed).abs() / (1.0 + restitution) } else { 0.0 };
            let out = normal * change.signum() * (1.0 + restitution) * depth * share.min(1.0);
            path.position = path.at(h) + out;
            body.pushed += out;
            path.start = h;
            path.velocity = mover.velocity;
        }
        path.revision += 1;
        path.contacts += 1;
        body.path = path;
        body.take(mover);
        body.way = None;
        body.asleep = false;
        let knot = body.knot(start + touched, body.path.at(touched));
        body.knots.push(knot);
    }

    fn paper_face(&mut self, start: Seconds, index: usize) {
        let h = self.h;
        let position = self.bodies[index].path.at(h);
        let Some(found) = self.deepest(index, position) else { return };
        let Deepest { depth, normal, surface, patch } = found;
        self.work.events += 1;
        let mut mover = self.bodies[index].mover();
        let approach = -mover.velocity.dot(normal);
        // v = p / k (section 2.2.1): how long ago the ball entered.
        let ago = if approach > 0.0 { (depth / approach).min(h) } else { 0.0 };
        let tau = h - ago;
        match surface {
            Surface::PocketBottom(pocket) => {
                return self.take_out(start + tau, index, tau, BallPlace::Pocketed, Some(pocket));
            }
            Surface::Floor => {
                return self.take_out(start + tau, index, tau, BallPlace::OffTable, None);
            }
            _ => {}
        }

        let Law { restitution, friction } = self.parameters.surface(surface);
        let (mut loss_j, mut given) = (0.0, DVec3::ZERO);
        if approach > 0.0 && mover.inverse_mass > 0.0 {
            let slip = mover.surface_velocity(normal);
            let across = slip - normal * slip.dot(normal);
            let weight = self.parameters.gravity_m_s2 * normal.z.max(0.0);
            let collision = (1.0 + restitution) * approach / h;
            let force = (weight + collision) / mover.inverse_mass;
            let friction = self.paper_friction(friction);
            let (dv, dw) = paper_2009::friction(&mover, normal, across, force, friction, h);
            let (old, kick) = (mover, normal * ((1.0 + restitution) * approach) + dv);
            mover.velocity += kick;
            mover.angular_velocity += dw;
            given += kick / mover.inverse_mass;
            loss_j -= work_j(given, &old, &mover, normal);

            // Rolling resistance and spin decay of the standard laws, or nothing would ever stop.
            // They live on the collision's part alone, whose mean is the ball's weight.
            let law = self.parameters.carrying(0.0);
            let slip = mover.surface_velocity(normal);
            let slip = slip - normal * slip.dot(normal);
            let rolls = slip.length() <= tolerance::ROLLING_SLIP_M_S;
            let up = normal * mover.velocity.dot(normal);
            mover.velocity -= up;
            let impulse = collision * h / mover.inverse_mass;
            let carried = f64::from(rolls && normal.z > 0.5);
            let level = mover.velocity;
            loss_j +=
                crate::physics::laws::cloth::resist(&mut mover, normal, impulse, carried, &law, h);
            given += (mover.velocity - level) / mover.inverse_mass;
            mover.velocity += up;
        }
        match surface {
            Surface::Cushion(_) => self.ledger.cushion_j += loss_j,
            _ => self.ledger.cloth_j += loss_j,
        }
        let body = &mut self.bodies[index];
        self.ledger.momentum.table += given;

        // p' = d p above the surface (section 2.2.1).
        let out = normal * ((1.0 + restitution) * depth);
        let end = position + out;
        body.take(&mover);
        body.way = None;
        body.pushed += out;
        body.path.position = end;
        body.path.start = h;
        body.path.velocity = mover.velocity;
        body.path.contacts += 1;
        body.supports.clear();
        body.supports.push(Support { normal, surface, patch, gap_m: restitution * depth });
        self.work.contacts += 1;
        if let Surface::Cushion(rail) = surface {
            let point = position - normal * self.bodies[index].ball.radius_m;
            self.tell_cushion(start + tau, index, rail, point, approach);
        }
    }

    fn paper_friction(&self, sliding: f64) -> Friction {
        Friction { sliding, static_: sliding * self.parameters.static_over_sliding }
    }

    /// Only the face that a ball has entered deepest is treated (section 2.1).
    fn deepest(&mut self, index: usize, position: DVec3) -> Option<Deepest> {
        let ground = self.ground.clone();
        let radius = self.bodies[index].ball.radius_m;
        let mut best: Option<Deepest> = None;
        let mut meet = |normal: DVec3, distance: f64, surface: Surface, patch: u64| {
            let depth = radius - distance;
            if depth > best.as_ref().map_or(0.0, |best| best.depth) {
                best = Some(Deepest { depth, normal, surface, patch });
            }
        };
        for (number, plane) in ground.planes.iter().enumerate() {
            self.work.face_tests += 1;
            let distance = (position - plane.point).dot(plane.normal);
            meet(plane.normal, distance, plane.surface, Support::plane(number));
        }
        if !ground.faces.is_empty() {
            let mut faces = std::mem::take(&mut self.scratch.faces);
            let bounds = Bounds::swept(position, position, radius);
            ground.faces_near(&bounds, &mut self.scratch.seen_faces, &mut faces);
            for face in &faces {
                self.work.face_tests += 1;
                let triangle = &ground.faces[*face as usize];
                if let Some(near) = narrow::nearest(triangle, position, radius) {
                    let patch = u64::from(triangle.patch);
                    meet(near.normal, near.distance_m, triangle.surface, patch);
                }
            }
            self.scratch.faces = faces;
        }
        best
    }
}

/// Work of an impulse on a ball's surface [J]: J · (u + u′)/2.
fn work_j(impulse: DVec3, before: &Mover, after: &Mover, normal: DVec3) -> f64 {
    0.5 * impulse.dot(before.surface_velocity(normal) + after.surface_velocity(normal))
}
