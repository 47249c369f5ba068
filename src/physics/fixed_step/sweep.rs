//! Contacts of a step, in order of time.
//!
//! Each ball moves straight through the step. The first contact of all is found, the balls that it
//! concerns are moved there, the contact law acts, and they move on from there with their new
//! velocities: the exact re-timing of straight motion. So a fast ball does not tunnel, and one step
//! may hold several contacts. What is left of the step's error is that forces bend paths, and that
//! their kick counts for the whole step wherever in it the contact lies; only for a ball that lands
//! is it told apart, or low hops would never end.

use super::FixedStep;
use super::body::{Path, Support};
use super::narrow;
use super::spatial_hash::Bounds;
use crate::physics::{PhysicsError, roots, tolerance};
use crate::units::Seconds;
use core::cmp::Ordering;
use glam::DVec3;

/// What a ball may meet; the order of the variants breaks ties in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Partner {
    /// The tip of the cue.
    Tip,
    /// A ball with a greater number.
    Ball(usize),
    /// A half space.
    Plane(usize),
    /// A face.
    Face(u32),
}

/// A contact that will happen unless one of the paths changes before.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    /// When, from the start of the step [s].
    pub tau: Seconds,
    /// The ball.
    pub ball: usize,
    /// Whom it meets.
    pub partner: Partner,
    /// Unit vector from a fixed partner to the ball; for others it follows from their positions.
    pub normal: DVec3,
    revisions: (u32, u32),
}

impl Contact {
    fn order(&self, other: &Contact) -> Ordering {
        self.tau
            .total_cmp(&other.tau)
            .then(self.partner.cmp(&other.partner))
            .then(self.ball.cmp(&other.ball))
    }
}

/// Contacts of one step, and more of them for each ball, beyond which something is stuck: a light
/// ball between a wall and a ball of ten thousand times its mass, say, meets them without end once
/// it has lost its restitution.
const EVENTS_MAX: u64 = 10_000;

/// See [`EVENTS_MAX`].
const EVENTS_OF_A_BALL_MAX: u64 = 100;

/// Contacts of a ball that differ by less, which is rounding, are at the same moment [s].
const SAME_MOMENT_S: Seconds = 1e-12;

impl FixedStep {
    /// All contacts of the step that begins at `start`.
    ///
    /// # Errors
    /// [`PhysicsError::StuckInStep`] if they come to no end.
    pub(super) fn sweep(&mut self, start: Seconds) -> Result<(), PhysicsError> {
        self.predict_all();
        let most = self.work.events + EVENTS_MAX + EVENTS_OF_A_BALL_MAX * self.bodies.len() as u64;
        while let Some(contact) = self.next_contact() {
            self.work.events += 1;
            if self.work.events > most {
                let ball = self.bodies[contact.ball].ball.id;
                return Err(PhysicsError::StuckInStep { time_s: start, ball });
            }
            let changed = self.resolve(start, &contact);
            for index in &changed {
                if self.bodies[*index].solid() {
                    self.update_bounds(*index);
                }
            }
            for index in &changed {
                if self.bodies[*index].solid() {
                    self.predict_faces(*index);
                    self.predict_balls(*index, &changed, false);
                    self.predict_tip(Some(*index));
                }
            }
            if contact.partner == Partner::Tip {
                self.predict_tip(None);
            }
        }
        Ok(())
    }

    /// All contacts of the paths as they are now.
    pub(super) fn predict_all(&mut self) {
        self.scratch.queue.clear();
        self.scratch.balls.clear();
        for index in 0..self.bodies.len() {
            if self.bodies[index].solid() {
                self.update_bounds(index);
            }
        }
        self.predict_tip(None);
        for index in 0..self.bodies.len() {
            if self.bodies[index].solid() && self.bodies[index].active() {
                self.predict_faces(index);
                self.predict_balls(index, &[], true);
            }
        }
    }

    /// Contacts of the tip alone, in order of time.
    pub(super) fn sweep_tip(&mut self, start: Seconds) {
        self.scratch.queue.clear();
        self.predict_tip(None);
        while let Some(contact) = self.next_contact() {
            self.work.events += 1;
            for index in self.resolve(start, &contact) {
                self.update_bounds(index);
            }
            self.predict_tip(None);
        }
    }

    /// Takes the first contact that still holds.
    fn next_contact(&mut self) -> Option<Contact> {
        let queue = &self.scratch.queue;
        if queue.is_empty() {
            return None;
        }
        let mut queue = std::mem::take(&mut self.scratch.queue);
        queue.retain(|contact| contact.revisions == self.revisions(contact.ball, contact.partner));
        let first = (0..queue.len()).min_by(|a, b| queue[*a].order(&queue[*b]));
        let first = first.map(|place| queue.swap_remove(self.of_highest_rank(&queue, place)));
        self.scratch.queue = queue;
        first
    }

    /// An edge belongs to the faces on both its sides, and rounding decides which of them a ball
    /// meets first. The surface of higher rank counts, or a mirrored shot would meet another one.
    fn of_highest_rank(&self, queue: &[Contact], first: usize) -> usize {
        let contact = &queue[first];
        let rank = |place: &usize| self.surface_of(queue[*place].partner).rank();
        let same = |place: &usize| {
            let other = &queue[*place];
            other.ball == contact.ball
                && matches!(other.partner, Partner::Plane(_) | Partner::Face(_))
                && (other.tau - contact.tau).abs() <= SAME_MOMENT_S
                && other.normal.dot(contact.normal) > 1.0 - tolerance::COPLANAR
                && rank(place) > rank(&first)
        };
        match contact.partner {
            Partner::Tip | Partner::Ball(_) => first,
            Partner::Plane(_) | Partner::Face(_) => {
                let order = |a: &usize, b: &usize| {
                    rank(b).cmp(&rank(a)).then_with(|| queue[*a].order(&queue[*b]))
                };
                (0..queue.len()).filter(same).min_by(order).unwrap_or(first)
            }
        }
    }

    /// Further contacts of a ball with fixed surfaces at the same moment.
    pub(super) fn also_touches(&self, contact: &Contact) -> impl Iterator<Item = &Contact> {
        let at = contact.tau;
        let ball = contact.ball;
        self.scratch.queue.iter().filter(move |other| {
            other.ball == ball
                && matches!(other.partner, Partner::Plane(_) | Partner::Face(_))
                && (other.tau - at).abs() <= SAME_MOMENT_S
                && other.revisions == self.revisions(other.ball, other.partner)
        })
    }

    /// The counts by which a prediction is recognised as void.
    fn revisions(&self, ball: usize, partner: Partner) -> (u32, u32) {
        let gone = |index: usize| {
            let body = &self.bodies[index];
            if body.solid() { body.path.revision } else { u32::MAX }
        };
        let other = match partner {
            Partner::Ball(other) => gone(other),
            Partner::Tip => self.cue.as_ref().map_or(u32::MAX, |cue| cue.revision),
            Partner::Plane(_) | Partner::Face(_) => 0,
        };
        (gone(ball), other)
    }

    fn push_contact(&mut self, tau: Seconds, ball: usize, partner: Partner, normal: DVec3) {
        let revisions = self.revisions(ball, partner);
        self.scratch.queue.push(Contact { tau, ball, partner, normal, revisions });
    }

    /// Box around the rest of a ball's path; enters it into the hash.
    pub(super) fn update_bounds(&mut self, index: usize) {
        let h = self.h;
        let body = &mut self.bodies[index];
        let reach = body.ball.radius_m + tolerance::CLUSTER_M;
        body.bounds = if self.rejects {
            Bounds::swept(body.path.position, body.path.at(h), reach)
        } else {
            Bounds::EVERYTHING
        };
        self.scratch.balls.insert(index as u32, &body.bounds, |_| true);
    }

    /// Balls whose boxes meet that of `index`, in ascending order.
    pub(super) fn balls_near(&mut self, index: usize) -> Vec<usize> {
        let mut near = std::mem::take(&mut self.scratch.near);
        near.clear();
        let bounds = self.bodies[index].bounds;
        let seen = &mut self.scratch.seen_balls;
        seen.begin(self.bodies.len());
        self.scratch.balls.visit(&bounds, |other| {
            let place = other as usize;
            let body = &self.bodies[place];
            if seen.first(other) && place != index && body.solid() && body.bounds.overlap(&bounds) {
                near.push(place);
            }
        });
        near.sort_unstable();
        near
    }

    /// Contacts with other balls. A pair of two moving balls is tested by the first of them alone;
    /// so is one of two balls in `changed`.
    fn predict_balls(&mut self, index: usize, changed: &[usize], first: bool) {
        let near = self.balls_near(index);
        for other in &near {
            let done_by_other = *other < index
                && if first { self.bodies[*other].active() } else { changed.contains(other) };
            if !done_by_other {
                self.predict_pair(index.min(*other), index.max(*other));
            }
        }
        self.scratch.near = near;
    }

    fn predict_pair(&mut self, a: usize, b: usize) {
        self.work.pair_tests += 1;
        let (one, two) = (&self.bodies[a], &self.bodies[b]);
        let from = one.path.start.max(two.path.start);
        let time = roots::straight(
            one.path.at(from) - two.path.at(from),
            one.path.velocity - two.path.velocity,
            one.ball.radius_m + two.ball.radius_m,
            self.h - from,
            tolerance::STRUCK_M_S,
        );
        if let Some(time) = time {
            self.push_contact(from + time, a, Partner::Ball(b), DVec3::ZERO);
        }
    }

    /// Contacts with planes and faces. Those of a flat patch that carries the ball cannot be met as
    /// long as it does not move towards them.
    fn predict_faces(&mut self, index: usize) {
        let ground = self.ground.clone();
        let body = &self.bodies[index];
        let Path { start, position, velocity, .. } = body.path;
        let (radius, horizon) = (body.ball.radius_m, self.h - start);
        if velocity == DVec3::ZERO {
            return;
        }
        let along: smallvec::SmallVec<[u64; 2]> = body
            .supports
            .iter()
            .filter(|support| velocity.dot(support.normal) >= 0.0)
            .map(|support: &Support| support.patch)
            .collect();
        let bounds = body.bounds;

        for (number, plane) in ground.planes.iter().enumerate() {
            if along.contains(&Support::plane(number)) {
                continue;
            }
            self.work.face_tests += 1;
            let (gap, speed) =
                ((position - plane.point).dot(plane.normal) - radius, velocity.dot(plane.normal));
            if speed < -tolerance::STRUCK_M_S && gap + speed * horizon <= 0.0 {
                let tau = start + (gap / -speed).max(0.0);
                self.push_contact(tau, index, Partner::Plane(number), plane.normal);
            }
        }

        if ground.faces.is_empty() {
            return;
        }
        let mut faces = std::mem::take(&mut self.scratch.faces);
        ground.faces_near(&bounds, &mut self.scratch.seen_faces, &mut faces);
        for face in &faces {
            let triangle = &ground.faces[*face as usize];
            if along.contains(&u64::from(triangle.patch)) {
                continue;
            }
            self.work.face_tests += 1;
            let found = narrow::first_contact(
                triangle,
                position,
                velocity,
                radius,
                horizon,
                tolerance::STRUCK_M_S,
            );
            if let Some((time, normal)) = found {
                self.push_contact(start + time, index, Partner::Face(*face), normal);
            }
        }
        self.scratch.faces = faces;
    }

    /// Contacts of the tip with one ball, or with all.
    fn predict_tip(&mut self, ball: Option<usize>) {
        let Some(cue) = self.cue.as_ref().filter(|cue| cue.guided.is_solid()) else { return };
        let reach = cue.step_bounds();
        let balls = ball.map_or(0..self.bodies.len(), |ball| ball..ball + 1);
        let mut found: smallvec::SmallVec<[(Seconds, usize); 4]> = smallvec::SmallVec::new();
        let mut tests = 0;
        for index in balls {
            let body = &self.bodies[index];
            if body.solid() && !cue.guided.is_blind_to(index) && body.bounds.overlap(&reach) {
                tests += 1;
                if let Some(tau) = cue.first_contact(&body.path, body.ball.radius_m, self.h) {
                    found.push((tau, index));
                }
            }
        }
        self.work.pair_tests += tests;
        for (tau, index) in found {
            self.push_contact(tau, index, Partner::Tip, DVec3::ZERO);
        }
    }
}
