//! Motion that has no closed form: a ball that turns about a rim, slides down a slope, is wedged
//! between surfaces or leans on other balls.
//!
//! Only the balls concerned are stepped. One with a single contact, an edge or a slope, has a law
//! of its own, [`super::pivot`]; all others go on one grid of
//! [`lasting_step_s`](crate::physics::ExactTolerances). There a step takes every contact without
//! restitution and with Coulomb's friction, solved jointly. Either way it emits the quadratic
//! through the velocities at both ends, so that detection, queue and impacts stay as they are.
//! Normals turn within a step; what that adds or takes is put right by holding the energy of a ball
//! that leans on nothing else to what friction leaves of it. Error: second order in the step for a
//! single contact; else first, for the moment of leaving.

mod lie;
mod single;

use super::EventDriven;
use super::predict::Changed;
use super::segment::{Course, Segment};
use super::swing;
use super::terrain::Feature;
use crate::physics::laws::Mover;
use crate::physics::laws::cloth;
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::{Contact as Law, PhysicsError, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// What is no farther than this touches [m].
pub(super) const TOUCH_M: f64 = 1e-6;

/// A contact that parts faster than this is none [m/s].
const PARTS_M_S: f64 = 1e-2;

/// How often the overlaps of a group are looked at in a step; it bounds the work.
const PARTS_MAX: usize = 20;

type Contacts = SmallVec<[(Feature, DVec3, f64); 4]>;

impl EventDriven {
    /// A ball goes on in lasting contact as `mover` says, moved by `shift`.
    pub(super) fn begin_lasting_with(
        &mut self,
        at: Seconds,
        index: usize,
        mover: &Mover,
        shift: DVec3,
    ) {
        self.watch_rails(index, at);
        self.close_segment(at, index);
        self.book_lift(index, shift);
        let from = self.bodies[index].segment;
        self.bodies[index].turn_into(Segment {
            start_s: at,
            position: from.position_at(at) + shift,
            velocity: mover.velocity,
            angular_velocity: mover.angular_velocity,
            orientation: from.orientation_at(at),
            course: Course::Lasting,
            swing: None,
            ..from
        });
        self.begins.push(index);
    }

    /// The first piece of the balls that begin a lasting contact now, and of all that lean on them
    /// or that they lean on, up to the next step of all. Adds them to the balls that changed.
    ///
    /// It waits until each of them has the velocity that the event gave it.
    pub(super) fn begin_pieces(&mut self, at: Seconds, changed: &mut Changed) {
        if self.begins.is_empty() {
            return;
        }
        let mut group = core::mem::take(&mut self.begins);
        group.sort_unstable();
        group.dedup();
        for index in &group {
            self.bodies[*index].quiet_since = at;
            self.bodies[*index].target_j = f64::INFINITY;
        }
        self.join_leaning(at, &mut group);
        for index in &group {
            self.cut_lasting(at, *index);
        }
        self.pieces(at, &group);
        for index in group {
            if !changed.contains(&index) {
                changed.push(index);
            }
        }
    }

    /// Books the height that a ball is moved by.
    fn book_lift(&mut self, index: usize, shift: DVec3) {
        self.ledger.integration_j += self.lift_j(&self.bodies[index], shift.z);
    }

    /// Adds to a group the balls that its members lean on, or that lean on them.
    fn join_leaning(&mut self, at: Seconds, group: &mut Changed) {
        let mut place = 0;
        while place < group.len() {
            let index = group[place];
            let centre = self.bodies[index].segment.position_at(at);
            for other in 0..self.bodies.len() {
                let it = &self.bodies[other];
                let reach = self.bodies[index].ball.radius_m + it.ball.radius_m + TOUCH_M;
                let line = it.segment.position_at(at) - centre;
                let leans = line.z.abs() > 1e-4 * reach && line.length() <= reach;
                if leans && it.solid() && !group.contains(&other) && it.ball.flags.integrate {
                    // One that slept sleeps on, if nothing moves it.
                    if !it.leans {
                        self.bodies[other].quiet_since = at;
                    }
                    self.bodies[other].target_j = f64::INFINITY;
                    group.push(other);
                }
            }
            place += 1;
        }
        group.sort_unstable();
    }

    /// Ends a ball's segment; what follows is a piece of lasting contact.
    fn cut_lasting(&mut self, at: Seconds, index: usize) {
        self.watch_rails(index, at);
        self.close_segment(at, index);
        let state = self.state_at(at, index);
        let next = Segment { course: Course::Lasting, swing: None, ..state };
        self.bodies[index].turn_into(next);
    }

    pub(super) fn state_at(&self, at: Seconds, index: usize) -> Segment {
        let from = &self.bodies[index].segment;
        Segment {
            start_s: at,
            position: from.position_at(at),
            velocity: from.velocity_at(at),
            angular_velocity: from.angular_velocity_at(at),
            orientation: from.orientation_at(at),
            ..*from
        }
    }

    /// Balls in lasting contact.
    fn lasting(&self) -> impl Iterator<Item = usize> {
        self.bodies.iter().enumerate().filter_map(|(index, body)| {
            (body.in_play() && body.segment.course == Course::Lasting).then_some(index)
        })
    }

    /// The next step of the balls in lasting contact whose piece ends now.
    pub(super) fn step_lasting(&mut self, at: Seconds) -> Result<(), PhysicsError> {
        self.work.steps += 1;
        let mut group: Changed =
            self.lasting().filter(|index| self.bodies[*index].segment.end_s <= at).collect();
        self.join_leaning(at, &mut group);
        for index in &group {
            self.check_finite(at, *index)?;
            self.cut_lasting(at, *index);
        }
        self.pieces(at, &group);
        self.predict(at, &group);
        for index in &group {
            if self.bodies[*index].in_play() {
                self.sinks_for_good(at, *index);
            }
        }
        Ok(())
    }

    /// Emits the next pieces of a group of balls; those that nothing unusual holds any more go on
    /// by closed forms. Their segments must start at `at`.
    fn pieces(&mut self, at: Seconds, group: &[usize]) {
        self.emit_pieces(at, group);
        let ends = self.lasting().map(|index| self.bodies[index].segment.end_s);
        self.lasting_at = ends.fold(f64::INFINITY, f64::min);
    }

    fn emit_pieces(&mut self, at: Seconds, group: &[usize]) {
        let until = after(at, self.parameters.exact.lasting_step_s);
        let dt = until - at;
        let gravity = DVec3::NEG_Z * self.parameters.gravity_m_s2;
        let mut contacts: SmallVec<[Contacts; 4]> = SmallVec::new();
        for index in group {
            let found = self.lie_on(*index);
            contacts.push(found);
        }
        let pairs = self.leaning_pairs(group);
        // Who parts from one may be pushed into the next.
        for _ in 0..PARTS_MAX {
            let mut clear = true;
            for (a, b, normal) in &pairs {
                let (one, two) = self.part(at, (*a, DVec3::ZERO), (*b, DVec3::ZERO), *normal);
                clear &= one == DVec3::ZERO && two == DVec3::ZERO;
                for (index, shift) in [(*a, one), (*b, two)] {
                    self.book_lift(index, shift);
                    self.bodies[index].segment.position += shift;
                }
            }
            if clear {
                break;
            }
        }

        // Who is free of it?
        let mut stay: Changed = Changed::new();
        let mut kept: SmallVec<[Contacts; 4]> = SmallVec::new();
        for (place, index) in group.iter().enumerate() {
            let leans = pairs.iter().any(|(a, b, _)| a == index || b == index);
            let done = !leans
                && (self.leave_lasting(*index, &contacts[place])
                    || self.single_contact(at, *index, &contacts[place]));
            if !done {
                stay.push(*index);
                kept.push(contacts[place].clone());
            }
        }
        if stay.is_empty() {
            return;
        }

        // Forces, then all contacts at once.
        let starts: SmallVec<[Mover; 4]> = stay
            .iter()
            .map(|index| {
                let body = &self.bodies[*index];
                Mover::new(&body.ball, body.segment.velocity, body.segment.angular_velocity)
            })
            .collect();
        let mut movers = starts.clone();
        for (mover, index) in movers.iter_mut().zip(&stay) {
            let body = &self.bodies[*index];
            if mover.inverse_mass == 0.0 {
                continue;
            }
            if body.ball.flags.gravity {
                mover.velocity += gravity * dt;
            }
            if let Some(spring) = &body.ball.spring {
                swing::push(mover, &body.ball, spring, &body.segment, dt);
            }
        }
        let pushed = movers.clone();
        let mut touches: Vec<Touch> = Vec::new();
        for (place, contacts) in kept.iter().enumerate() {
            for (feature, normal, _) in contacts {
                let law = self.parameters.surface(self.terrain.surface(*feature));
                let touch = Touch::new(place, None, *normal, Law { restitution: 0.0, ..law });
                touches.push(Touch { carries: true, ..touch });
            }
        }
        let place_of = |index: usize| stay.iter().position(|other| *other == index);
        for (a, b, normal) in &pairs {
            if let (Some(a), Some(b)) = (place_of(*a), place_of(*b)) {
                let law = Law { restitution: 0.0, ..self.parameters.ball };
                let touch = Touch::new(a, Some(b), *normal, law);
                touches.push(Touch { carries: true, ..touch });
            }
        }
        cluster::resolve(&mut movers, &mut touches);
        let lost = self.friction_losses(&stay, &touches, &pushed, &mut movers, dt);

        // What this step has not moved the next ones will not move either.
        let calm = starts.iter().chain(&movers).all(|mover| pace(mover) <= tolerance::CALM_M_S);
        for (place, index) in stay.iter().enumerate() {
            let body = &mut self.bodies[*index];
            let (start, end) = (&starts[place], &movers[place]);
            let moved = pace(end);
            let from = body.segment;
            let energy = start.kinetic_j()
                + body.ball.mass_kg * self.parameters.gravity_m_s2 * from.position.z;
            // What leans on other balls hands them energy; a spring does as well.
            let leans = pairs.iter().any(|(a, b, _)| a == index || b == index);
            let hands_on = leans || body.ball.spring.is_some();
            body.target_j = if hands_on { f64::INFINITY } else { energy - lost[place] };
            body.held = kept[place].iter().map(|(feature, _, _)| *feature).collect();
            let brushes = body.brushes(at).filter(|other| !body.held.contains(other));
            body.held.extend(brushes);
            if moved > tolerance::REST_M_S {
                body.quiet_since = at;
            }
            if calm || at - body.quiet_since >= tolerance::SLEEP_S {
                // It sleeps where it is.
                let kinetic = start.kinetic_j();
                let momentum = start.velocity * body.ball.mass_kg;
                body.leans = true;
                body.turn_into(Segment::still(at, from.position, from.orientation));
                body.leans = true;
                self.ledger.face_j += kinetic;
                self.ledger.momentum.table -= momentum;
            } else {
                body.leans = false;
                let normal = kept[place].first().map_or(DVec3::Z, |(_, normal, _)| *normal);
                body.turn_into(Segment {
                    end_s: until,
                    acceleration: (end.velocity - from.velocity) / dt,
                    angular_acceleration: (end.angular_velocity - from.angular_velocity) / dt,
                    normal,
                    spin_deceleration: 0.0,
                    course: Course::Lasting,
                    ..from
                });
            }
            self.note_track(*index);
        }
    }

    /// Pairs of a group that lean on each other.
    fn leaning_pairs(&self, group: &[usize]) -> SmallVec<[(usize, usize, DVec3); 8]> {
        let mut pairs = SmallVec::new();
        for (place, a) in group.iter().enumerate() {
            for b in &group[place + 1..] {
                let (one, two) = (&self.bodies[*a], &self.bodies[*b]);
                let line = one.segment.position - two.segment.position;
                let reach = one.ball.radius_m + two.ball.radius_m + 4.0 * TOUCH_M;
                let normal = line.normalize_or(DVec3::Z);
                let parts = (one.segment.velocity - two.segment.velocity).dot(normal) > PARTS_M_S;
                if line.length() <= reach && !parts {
                    pairs.push((*a, *b, normal));
                }
            }
        }
        pairs
    }

    /// What friction takes from each ball in a step [J]; applies rolling resistance.
    fn friction_losses(
        &self,
        stay: &[usize],
        touches: &[Touch],
        pushed: &[Mover],
        movers: &mut [Mover],
        dt: Seconds,
    ) -> SmallVec<[f64; 4]> {
        let mut lost: SmallVec<[f64; 4]> = stay.iter().map(|_| 0.0).collect();
        for touch in touches {
            let slip = |movers: &[Mover]| {
                let own = movers[touch.a].surface_velocity(touch.normal);
                match touch.b {
                    Some(b) => own - movers[b].surface_velocity(-touch.normal),
                    None => own,
                }
            };
            let tangential = touch.impulse - touch.normal * touch.impulse.dot(touch.normal);
            let loss = -0.5 * tangential.dot(slip(pushed) + slip(movers));
            match touch.b {
                Some(b) => {
                    lost[touch.a] += 0.5 * loss;
                    lost[b] += 0.5 * loss;
                }
                None => lost[touch.a] += loss,
            }
        }
        for (place, mover) in movers.iter_mut().enumerate() {
            let pressed = |touch: &&Touch| touch.impulse.dot(touch.normal);
            let own = touches.iter().filter(|touch| touch.a == place && touch.b.is_none());
            let Some(touch) = own.max_by(|a, b| pressed(a).total_cmp(&pressed(b))) else {
                continue;
            };
            let slip = mover.surface_velocity(touch.normal);
            let slip = slip - touch.normal * slip.dot(touch.normal);
            let law = self.parameters.carrying(touch.friction);
            let rolled = f64::from(slip.length() <= tolerance::ROLLING_SLIP_M_S);
            let impulse = touch.impulse.dot(touch.normal);
            lost[place] += cloth::resist(mover, touch.normal, impulse, rolled, &law, dt);
        }
        lost
    }
}

/// Speed of a ball, or of its skin if it spins faster [m/s].
fn pace(mover: &Mover) -> f64 {
    mover.velocity.length().max(mover.angular_velocity.length() * mover.radius_m)
}

/// The next step after `at` of all that go on the grid [s].
fn after(at: Seconds, step: Seconds) -> Seconds {
    let next = (libm::floor(at / step) + 1.0) * step;
    if next - at < 1e-9 { next + step } else { next }
}
