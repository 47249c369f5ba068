//! The end of a step: where everything is, what carries it, and what follows from that.

use super::FixedStep;
use super::body::{Body, Support};
use super::narrow;
use super::spatial_hash::Bounds;
use crate::ball::BallPlace;
use crate::events::FactKind;
use crate::mesh::Surface;
use crate::physics::{PhysicsError, Profile, spring, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// Passes over the surfaces around a ball that is caught between several.
const PUSH_OUT_PASSES: usize = 4;

impl FixedStep {
    /// Ends the step that began at `start`.
    pub(super) fn finish(&mut self, start: Seconds) -> Result<(), PhysicsError> {
        let end = self.grid(self.step);
        let mut awake = std::mem::take(&mut self.scratch.awake);
        awake.clear();
        awake.extend((0..self.bodies.len()).filter(|index| self.bodies[*index].active()));

        for index in &awake {
            self.arrive(*index);
        }
        self.part_pairs();
        for index in &awake {
            self.settle_down(*index, start, end)?;
        }
        self.scratch.awake = awake;
        if let Some(cue) = &mut self.cue {
            cue.end_step(&self.bodies, end);
        }
        Ok(())
    }

    /// Moves a ball to the end of its path.
    fn arrive(&mut self, index: usize) {
        let h = self.h;
        let body = &mut self.bodies[index];
        body.position = body.path.at(h);
        body.orientation =
            spring::turned(body.orientation, body.angular_velocity, h - body.path.start);
    }

    /// Everything that depends on where a ball is now.
    fn settle_down(
        &mut self,
        index: usize,
        start: Seconds,
        end: Seconds,
    ) -> Result<(), PhysicsError> {
        self.find_supports(index);
        let g = self.parameters.gravity_m_s2;
        let body = &mut self.bodies[index];
        check_finite(body, end)?;

        // Weight along the step's way, push-out included; its counterpart is in `smooth`.
        let from = body.knots.first().map_or(body.position, |knot| knot.position);
        if body.ball.flags.gravity && body.ball.flags.integrate {
            self.ledger.integration_j += body.ball.mass_kg * g * (body.position.z - from.z);
        }

        body.clear_rails |= !body.near_rails;
        body.held_rails &= body.near_rails;
        body.name_motion();
        // A ball that the whole step has not changed will not change in the next.
        let untouched = body.path.contacts == 0;
        let still = body.velocity == DVec3::ZERO && body.angular_velocity == DVec3::ZERO;
        let before = body.knots.first().is_some_and(|knot| {
            knot.position == body.position
                && knot.velocity == DVec3::ZERO
                && knot.angular_velocity == DVec3::ZERO
        });
        body.asleep = self.skips && untouched && still && before;

        self.watch_head_string(index, start, end);
        self.watch_depth(index, end);
        Ok(())
    }

    /// Finds what carries a ball and which rails it is at; pushes it out of what it has entered.
    pub(super) fn find_supports(&mut self, index: usize) {
        if !self.bodies[index].solid() {
            return;
        }
        if self.settings.profile == Profile::Paper2009 {
            // The paper puts balls back by p′ = d p alone; that was done with the contact.
            self.look_around(index);
            return;
        }
        for _ in 0..PUSH_OUT_PASSES {
            let deepest = self.look_around(index);
            match deepest {
                Some((depth, normal)) if depth > tolerance::PUSH_OUT_M => {
                    self.bodies[index].position += normal * depth;
                }
                _ => return,
            }
        }
        self.look_around(index);
    }

    /// Lists what touches a ball; returns the deepest overlap and the way out.
    fn look_around(&mut self, index: usize) -> Option<(f64, DVec3)> {
        let ground = self.ground.clone();
        let mut faces = std::mem::take(&mut self.scratch.faces);
        let body = &mut self.bodies[index];
        let (position, radius) = (body.position, body.ball.radius_m);
        // Under the paper's laws a lying ball hops by what gravity gives in a step or two.
        let carried = match self.settings.profile {
            Profile::Standard => tolerance::SUPPORT_M,
            Profile::Paper2009 => 4.0 * self.parameters.gravity_m_s2 * self.h * self.h,
        };
        let reach = radius + tolerance::APART_M.max(carried);
        let last: SmallVec<[u64; 2]> = body.supports.iter().map(|support| support.patch).collect();
        body.supports.clear();
        body.near_rails = 0;
        let mut deepest: Option<(f64, DVec3)> = None;
        let mut meet = |normal: DVec3, distance: f64, surface: Surface, patch: u64| {
            let gap_m = distance - radius;
            if gap_m < -deepest.map_or(0.0, |(depth, _)| depth) {
                deepest = Some((-gap_m, normal));
            }
            if let (Surface::Cushion(rail), true) = (surface, gap_m <= tolerance::APART_M) {
                body.near_rails |= rail.bit();
            }
            let same = |s: &Support| s.normal.dot(normal) > 1.0 - tolerance::COPLANAR;
            if gap_m <= carried && !body.supports.iter().any(same) {
                body.supports.push(Support { normal, surface, patch, gap_m });
            }
        };

        for (number, plane) in ground.planes.iter().enumerate() {
            self.work.face_tests += 1;
            let distance = (position - plane.point).dot(plane.normal);
            if distance <= reach {
                meet(plane.normal, distance, plane.surface, Support::plane(number));
            }
        }
        if !ground.faces.is_empty() {
            let near = Bounds::swept(position, position, reach);
            let bounds = if self.rejects { near } else { Bounds::EVERYTHING };
            ground.faces_near(&bounds, &mut self.scratch.seen_faces, &mut faces);
            // The patches that carried the ball before come first: once its foot is found inside
            // one face of a flat patch, the others of that patch are farther away. Their edges are
            // no surface: across a seam they would lean towards the ball and throw it up.
            let patch = |face: &u32| u64::from(ground.faces[*face as usize].patch);
            faces.sort_by_key(|face| (!last.contains(&patch(face)), *face));
            let mut done: SmallVec<[u64; 4]> = SmallVec::new();
            let mut edges: SmallVec<[(narrow::Near, u32); 8]> = SmallVec::new();
            for face in &faces {
                if done.contains(&patch(face)) {
                    continue;
                }
                self.work.face_tests += 1;
                let triangle = &ground.faces[*face as usize];
                match narrow::nearest(triangle, position, reach) {
                    Some(near) if near.inside => {
                        meet(near.normal, near.distance_m, triangle.surface, patch(face));
                        done.push(patch(face));
                    }
                    Some(near) => edges.push((near, *face)),
                    None => {}
                }
            }
            // An edge counts as the surface of highest rank at it.
            let surface = |face: u32| ground.faces[face as usize].surface;
            edges.retain(|(_, face)| !done.contains(&patch(face)));
            edges.sort_by_key(|(_, face)| core::cmp::Reverse(surface(*face).rank()));
            for (near, face) in &edges {
                meet(near.normal, near.distance_m, surface(*face), patch(face));
            }
        }
        self.scratch.faces = faces;
        deepest
    }

    /// Pairs that have touched: forgets those that parted, moves overlapping ones apart, each ball
    /// by its share of the other's mass.
    fn part_pairs(&mut self) {
        let standard = self.settings.profile == Profile::Standard;
        let mut touching = std::mem::take(&mut self.touching);
        touching.retain(|(a, b)| {
            let (one, two) = (&self.bodies[*a], &self.bodies[*b]);
            if !one.active() && !two.active() {
                return true;
            }
            let line = one.position - two.position;
            let gap = line.length() - one.ball.radius_m - two.ball.radius_m;
            let (p, q) = (one.mover().inverse_mass, two.mover().inverse_mass);
            let total = p + q;
            if standard && gap < -tolerance::PUSH_OUT_M && total > 0.0 {
                let out = line.normalize_or(DVec3::X) * (-gap / total);
                for (index, shift) in [(*a, out * p), (*b, -out * q)] {
                    // A sleeping ball wakes in its next step.
                    if self.bodies[index].active() {
                        self.bodies[index].position += shift;
                    }
                }
            }
            gap <= tolerance::APART_M
        });
        self.touching = touching;
    }

    /// The base of a ball crosses the head string towards the foot.
    fn watch_head_string(&mut self, index: usize, start: Seconds, end: Seconds) {
        let Some(head) = self.ground.head_string_x() else { return };
        let body = &self.bodies[index];
        let mut from = (start, body.knots.first().map_or(body.position.x, |k| k.position.x));
        let mut crossed: SmallVec<[Seconds; 2]> = SmallVec::new();
        let ends = body.knots.iter().skip(1).map(|knot| (knot.time_s, knot.position.x));
        for to in ends.chain([(end, body.position.x)]) {
            if from.1 <= head && head < to.1 {
                crossed.push(from.0 + (to.0 - from.0) * (head - from.1) / (to.1 - from.1));
            }
            from = to;
        }
        let ball = body.ball.id;
        for time in crossed {
            self.tell(time, FactKind::HeadStringCrossed { ball });
        }
    }

    /// A ball that is wholly below the bed inside a pocket and too slow to come back is down; one
    /// that has fallen below everything has left the table.
    fn watch_depth(&mut self, index: usize, end: Seconds) {
        let ground = self.ground.clone();
        let body = &self.bodies[index];
        let (position, radius) = (body.position, body.ball.radius_m);
        let (h, g) = (self.h, self.parameters.gravity_m_s2);
        let rises = body.velocity.length_squared() >= 2.0 * g * -position.z;
        let pocket = ground
            .pockets
            .iter()
            .find(|pocket| pocket.centre.distance(position.truncate()) <= pocket.radius_m + radius);
        if let Some(pocket) = pocket.filter(|_| position.z < -radius && !rises) {
            self.bodies[index].path.position = position;
            self.bodies[index].path.velocity = DVec3::ZERO;
            self.take_out(end, index, h, BallPlace::Pocketed, Some(pocket.id));
        } else if position.z < ground.lowest_m - tolerance::ABYSS_M {
            self.bodies[index].path.position = position;
            self.bodies[index].path.velocity = DVec3::ZERO;
            self.take_out(end, index, h, BallPlace::OffTable, None);
        }
    }
}

fn check_finite(body: &Body, time_s: Seconds) -> Result<(), PhysicsError> {
    let bounded = |v: DVec3| v.is_finite() && v.abs().max_element() < 1e9;
    for (term, value) in [
        ("position", body.position),
        ("velocity", body.velocity),
        ("angular velocity", body.angular_velocity * 1e-3),
    ] {
        if !bounded(value) {
            return Err(PhysicsError::NonFinite { ball: body.ball.id, time_s, term });
        }
    }
    Ok(())
}
