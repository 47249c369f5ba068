//! What a meeting does: which law, which balls, and how they go on.

use super::EventDriven;
use super::lasting::TOUCH_M;
use super::motion::{self, Start};
use super::predict::Changed;
use super::segment::{Course, Segment};
use super::sweep::Meeting;
use super::terrain::Feature;
use crate::ball::BallPlace;
use crate::mesh::Surface;
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::laws::{Impact, Mover, ball_ball, ball_face, cushion};
use crate::physics::{Contact as Law, PhysicsError, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// How far a ball that turns about a rim is put over it [m].
const OVER_M: f64 = 1e-9;

/// A feature that a ball touches besides the one that it meets.
type Touched = SmallVec<[(Feature, DVec3); 2]>;

impl EventDriven {
    /// Finds what a ball lies on when its world begins, or when it is put down.
    pub(super) fn lay_down(&mut self, index: usize) {
        let at = self.done;
        let body = &self.bodies[index];
        let weighs = body.ball.flags.gravity && body.ball.flags.integrate;
        if !body.in_play() {
            let (position, orientation) = (body.segment.position, body.segment.orientation);
            self.bodies[index].segment = Segment::still(at, position, orientation);
            return;
        }
        let (segment, radius) = (body.segment, body.ball.radius_m);
        let mut leans = false;
        let mut carriers: SmallVec<[Feature; 2]> = SmallVec::new();
        if weighs && body.ball.flags.collide && self.parameters.gravity_m_s2 > 0.0 {
            let reach = radius + tolerance::START_OVERLAP_M;
            for (feature, normal, distance) in self.terrain.near(segment.position, reach) {
                if normal.z > 1e-9 && segment.velocity.dot(normal) <= tolerance::HOP_M_S {
                    carriers.push(feature);
                    // It lies on the first exactly.
                    if carriers.len() == 1 {
                        self.bodies[index].segment.position += normal * (radius - distance);
                    }
                }
            }
            leans = self.bodies.iter().enumerate().any(|(other, it)| {
                let line = segment.position - it.segment.position;
                other != index
                    && it.solid()
                    && line.z > 1e-6
                    && line.length() - radius - it.ball.radius_m <= TOUCH_M
            });
        }
        let flat = |feature: &Feature| matches!(feature, Feature::Plane(_) | Feature::Patch(_));
        let simple = carriers.len() == 1 && flat(&carriers[0]) && !leans;
        let stuck = (carriers.len() + usize::from(leans) > 0) && !simple;
        self.bodies[index].held = if simple { carriers } else { Self::nothing() };
        let mover = self.bodies[index].mover(at);
        if stuck {
            self.begin_lasting(at, index);
        } else {
            self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
        }
    }

    /// Normal of a flat feature on the side of a ball's centre.
    pub(super) fn flat_normal(&self, feature: Feature, centre: DVec3) -> Option<DVec3> {
        match feature {
            Feature::Plane(plane) => Some(self.terrain.planes[plane as usize].normal),
            Feature::Patch(patch) => {
                let patch = &self.terrain.patches[patch as usize];
                let above = patch.normal.dot(centre) >= patch.offset;
                Some(if above { patch.normal } else { -patch.normal })
            }
            Feature::Edge(_) | Feature::Corner(_) => None,
        }
    }

    /// What carries a ball, as a law sees it: normal and material.
    fn support(&self, index: usize, at: Seconds) -> Option<(DVec3, Law)> {
        let body = &self.bodies[index];
        let [feature] = body.held[..] else { return None };
        let normal = self.flat_normal(feature, body.segment.position_at(at))?;
        Some((normal, self.parameters.surface(self.terrain.surface(feature))))
    }

    /// A ball goes on from here as `mover` says, by what holds it.
    pub(super) fn go_on(
        &mut self,
        at: Seconds,
        index: usize,
        mover: &Mover,
        shift: DVec3,
        hops_s: Seconds,
    ) {
        self.watch_rails(index, at);
        self.close_segment(at, index);
        let body = &self.bodies[index];
        let from = &body.segment;
        let mut start = Segment {
            start_s: at,
            position: from.position_at(at) + shift,
            velocity: mover.velocity,
            angular_velocity: mover.angular_velocity,
            orientation: from.orientation_at(at),
            ..*from
        };
        if !body.ball.flags.integrate {
            start.velocity = DVec3::ZERO;
            start.angular_velocity = DVec3::ZERO;
        }
        // Out of what it was pressed into; what that lifts it, it pays.
        let lift_j = body.ball.mass_kg * self.parameters.gravity_m_s2 * shift.z;
        if shift.z != 0.0 && body.ball.flags.gravity && body.ball.flags.integrate {
            let kinetic = mover.kinetic_j();
            let factor = if kinetic > lift_j { (1.0 - lift_j / kinetic).sqrt() } else { 0.0 };
            let factor = factor.min(1.0);
            self.ledger.integration_j += lift_j - (1.0 - factor * factor) * kinetic;
            self.ledger.momentum.table += start.velocity * ((factor - 1.0) * body.ball.mass_kg);
            start.velocity *= factor;
            start.angular_velocity *= factor;
        }
        if body.held.is_empty() {
            let next = motion::free(&start, &body.ball, &self.parameters);
            self.turn_into(index, next);
            return;
        }
        let Some((normal, law)) = self.support(index, at) else {
            self.bodies[index].turn_into(Segment { course: Course::Lasting, swing: None, ..start });
            self.begin_lasting(at, index);
            return;
        };
        let lift = start.velocity.dot(normal);
        if lift > tolerance::HOP_M_S {
            self.bodies[index].held.clear();
            let next = motion::free(&start, &self.bodies[index].ball, &self.parameters);
            self.turn_into(index, next);
            return;
        }
        if lift != 0.0 {
            start.velocity -= normal * lift;
            let mass = body.ball.mass_kg;
            self.ledger.face_j += 0.5 * mass * lift * lift;
            self.ledger.momentum.table -= normal * (lift * mass);
        }
        let start = Start { segment: start, normal, friction: law.friction, hops_s };
        let body = &self.bodies[index];
        match motion::carried(&start, &body.ball, &self.parameters) {
            Some(next) => {
                self.book_slip(index, &start.segment, &next);
                self.turn_into(index, next);
            }
            None => {
                self.bodies[index].turn_into(Segment { course: Course::Lasting, swing: None, ..start.segment });
                self.begin_lasting(at, index);
            }
        }
    }

    pub(super) fn turn_into(&mut self, index: usize, next: Segment) {
        self.bodies[index].leans = false;
        self.bodies[index].turn_into(next);
        self.note_track(index);
    }

    /// Books what the last of the slip cost when a ball begins to roll, or stops.
    pub(super) fn book_slip(&mut self, index: usize, from: &Segment, to: &Segment) {
        let ball = &self.bodies[index].ball;
        if !ball.flags.integrate {
            return;
        }
        let kinetic = |s: &Segment| {
            0.5 * ball.mass_kg * s.velocity.length_squared()
                + 0.5 * ball.inertia_kg_m2() * s.angular_velocity.length_squared()
        };
        self.ledger.cloth_j += kinetic(from) - kinetic(to);
        self.ledger.momentum.table += (to.velocity - from.velocity) * ball.mass_kg;
    }

    /// The law of a ball's motion has ended by itself.
    pub(super) fn follow(&mut self, at: Seconds, index: usize) -> Result<(), PhysicsError> {
        self.check_finite(at, index)?;
        self.watch_rails(index, at);
        self.close_segment(at, index);
        let body = &self.bodies[index];
        let from = body.segment;
        let state = Segment {
            start_s: at,
            position: from.position_at(at),
            velocity: from.velocity_at(at),
            angular_velocity: from.angular_velocity_at(at),
            orientation: from.orientation_at(at),
            ..from
        };
        let (normal, law) = self
            .support(index, at)
            .unwrap_or((DVec3::Z, Law { restitution: 0.0, friction: 0.0 }));
        let start = Start { segment: state, normal, friction: law.friction, hops_s: 0.0 };
        match motion::after(&from, &start, &body.ball, &self.parameters) {
            Some(next) => {
                self.book_slip(index, &state, &next);
                self.turn_into(index, next);
            }
            None => {
                self.bodies[index].turn_into(Segment { course: Course::Lasting, swing: None, ..state });
                self.begin_lasting(at, index);
            }
        }
        self.predict(at, &[index]);
        Ok(())
    }

    /// The foot of a carried ball crosses the edge of what carries it.
    pub(super) fn leave(
        &mut self,
        at: Seconds,
        index: usize,
        feature: Feature,
    ) -> Result<(), PhysicsError> {
        self.check_finite(at, index)?;
        let mover = self.bodies[index].mover(at);
        let [Feature::Patch(patch)] = self.bodies[index].held[..] else { return Ok(()) };
        let Feature::Edge(number) = feature else { return Ok(()) };
        let terrain = self.terrain.clone();
        let edge = &terrain.edges[number as usize];
        let across = edge.sides.iter().find(|(side, _)| *side != patch);
        if let (true, Some((other, _))) = (edge.flat, across) {
            self.bodies[index].held = SmallVec::from_slice(&[Feature::Patch(*other)]);
            self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
            self.predict(at, &[index]);
            return Ok(());
        }
        // Over the rim: fast enough it flies at once, v² ≥ g R; else it turns about the edge.
        let inwards = edge.sides.iter().find(|(side, _)| *side == patch).map(|(_, inwards)| *inwards);
        let outwards = -inwards.unwrap_or(DVec3::ZERO).dot(mover.velocity);
        let normal = self.bodies[index].segment.normal;
        let into = self.parameters.gravity_m_s2 * normal.z;
        self.bodies[index].held.clear();
        if outwards * outwards >= into * self.bodies[index].ball.radius_m {
            self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
        } else {
            // Over the edge by more than rounding, or the patch would seem to carry it still.
            let over = inwards.unwrap_or(DVec3::ZERO) * -OVER_M;
            self.begin_lasting_with(at, index, &mover, over);
        }
        self.predict(at, &[index]);
        Ok(())
    }

    /// Other features that a ball touches and closes on at `at`.
    fn also_touched(&self, at: Seconds, index: usize, but: &[DVec3], mover: &Mover) -> Touched {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at);
        let mut touched = Touched::new();
        let on_main = body.held.len() == 1 && body.held[0] == self.terrain.main_patch();
        let alone = self.terrain.leap(self.terrain.cell_of(centre), on_main) > 0;
        if alone && self.terrain.planes.is_empty() {
            return touched;
        }
        for (feature, normal, _) in self.terrain.near(centre, body.ball.radius_m + TOUCH_M) {
            let apart =
                but.iter().all(|other| other.dot(normal) < 1.0 - tolerance::SAME_NORMAL * 1e3);
            let closes = mover.velocity.dot(normal) < -tolerance::CLOSING_M_S;
            let held = body.held.iter().any(|held| self.terrain.belongs(feature, *held));
            if apart && closes && !held {
                touched.push((feature, normal));
            }
        }
        touched
    }

    /// A ball meets the terrain.
    pub(super) fn meet(
        &mut self,
        at: Seconds,
        index: usize,
        meeting: &Meeting,
    ) -> Result<(), PhysicsError> {
        self.check_finite(at, index)?;
        let Meeting { feature, normal, .. } = *meeting;
        let surface = self.terrain.surface(feature);
        match surface {
            Surface::PocketBottom(pocket) => {
                self.take_out(at, index, BallPlace::Pocketed, Some(pocket));
                return Ok(());
            }
            Surface::Floor => {
                self.take_out(at, index, BallPlace::OffTable, None);
                return Ok(());
            }
            _ => {}
        }
        self.work.contacts += 1;
        let members = self.cluster_of(at, &[index]);
        let mut mover = self.bodies[index].mover(at);
        let before = mover;
        let approach = -mover.velocity.dot(normal);
        let material = self.parameters.surface(surface);
        let slow = material.restitution * approach < tolerance::HOP_M_S
            || matches!(surface, Surface::Cushion(_)) && approach < tolerance::STICKY_M_S;
        let law = if slow { Law { restitution: 0.0, ..material } } else { material };
        let support = self.support(index, at);
        let mut known: SmallVec<[DVec3; 2]> = SmallVec::from_slice(&[normal]);
        known.extend(support.map(|(normal, _)| normal));
        let also = self.also_touched(at, index, &known, &mover);

        if members.len() > 1 {
            let met: Touched = std::iter::once((feature, normal)).chain(also).collect();
            self.resolve_cluster(at, &members, index, &met);
            return Ok(());
        }
        let mut loss_j = 0.0;
        match (support, &also[..]) {
            (None, []) => {
                let Impact { impulse, loss_j: lost, .. } =
                    ball_face::bounce(&mut mover, normal, law.restitution, law.friction);
                self.ledger.momentum.table += impulse;
                loss_j += lost;
            }
            (Some((carrier, cloth)), []) => {
                let (own, bed) = cushion::bounce(&mut mover, normal, carrier, law, cloth);
                self.ledger.momentum.table += own.impulse + bed.impulse;
                self.ledger.cloth_j += bed.loss_j;
                loss_j += own.loss_j;
            }
            (support, also) => {
                let mut touches: SmallVec<[Touch; 6]> = SmallVec::new();
                touches.push(Touch::new(0, None, normal, law));
                for (feature, normal) in also {
                    let law = self.parameters.surface(self.terrain.surface(*feature));
                    let touch = Touch::new(0, None, *normal, law);
                    touches.push(Touch { sticky_m_s: tolerance::STICKY_M_S, ..touch });
                }
                if let Some((normal, law)) = support {
                    touches.push(Touch { carries: true, ..Touch::new(0, None, normal, law) });
                }
                cluster::resolve(core::slice::from_mut(&mut mover), &mut touches);
                for touch in &touches {
                    self.ledger.momentum.table += touch.impulse;
                    loss_j += touch.loss_j;
                }
            }
        }
        match surface {
            Surface::Cushion(_) => self.ledger.cushion_j += loss_j,
            _ => self.ledger.face_j += loss_j,
        }

        let radius = self.bodies[index].ball.radius_m;
        let point = self.bodies[index].segment.position_at(at) - normal * radius;
        let met = std::iter::once((feature, normal)).chain(also.iter().copied());
        for (feature, normal) in met {
            if let Surface::Cushion(rail) = self.terrain.surface(feature) {
                self.tell_cushion(at, index, rail, point, -before.velocity.dot(normal));
            }
        }
        self.rebound(at, index, &mover, meeting, approach, law.restitution);
        Ok(())
    }

    /// How a ball goes on after it has met the terrain alone.
    fn rebound(
        &mut self,
        at: Seconds,
        index: usize,
        mover: &Mover,
        meeting: &Meeting,
        approach: f64,
        restitution: f64,
    ) {
        let busy = self.is_busy(at, index);
        let (feature, normal) = (meeting.feature, meeting.normal);
        let radius = self.bodies[index].ball.radius_m;
        let gravity = self.parameters.gravity_m_s2;
        let carries = normal.z > 1e-9 && self.bodies[index].ball.flags.gravity && gravity > 0.0;
        let lands = restitution == 0.0 && carries && self.bodies[index].held.is_empty();
        if busy {
            self.begin_lasting_with(at, index, mover, DVec3::ZERO);
        } else if lands && self.flat_normal(feature, DVec3::ZERO).is_some() {
            // It lies on the surface exactly, whatever rounding says.
            let centre = self.bodies[index].segment.position_at(at);
            let height = match feature {
                Feature::Plane(plane) => {
                    (centre - self.terrain.planes[plane as usize].point).dot(normal)
                }
                Feature::Patch(patch) => {
                    let patch = &self.terrain.patches[patch as usize];
                    (patch.normal.dot(centre) - patch.offset).abs()
                }
                Feature::Edge(_) | Feature::Corner(_) => radius,
            };
            // The rest of the series of hops: 2 v / (g (1 − e)), v the next rebound.
            let real = self.parameters.surface(self.terrain.surface(feature)).restitution;
            let hops_s = if real < 1.0 && real > 0.0 {
                2.0 * real * approach / (gravity * normal.z * (1.0 - real))
            } else {
                0.0
            };
            self.bodies[index].held = SmallVec::from_slice(&[feature]);
            self.go_on(at, index, mover, normal * (radius - height), hops_s);
        } else if lands {
            self.begin_lasting_with(at, index, mover, DVec3::ZERO);
        } else {
            let shift = self.way_out(at, index, normal, feature);
            self.go_on(at, index, mover, shift, 0.0);
        }
        self.predict(at, &[index]);
        if self.bodies[index].in_play() {
            self.sinks_for_good(at, index);
        }
        self.wake_neighbours(at, &[index]);
    }

    /// Out of a surface into which a ball was pressed; along what carries it, so that no energy
    /// appears.
    fn way_out(&self, at: Seconds, index: usize, normal: DVec3, feature: Feature) -> DVec3 {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at);
        let distance = match feature {
            Feature::Plane(plane) => {
                (centre - self.terrain.planes[plane as usize].point).dot(normal)
            }
            Feature::Patch(patch) => {
                let patch = &self.terrain.patches[patch as usize];
                (patch.normal.dot(centre) - patch.offset).abs()
            }
            Feature::Edge(edge) => {
                let edge = &self.terrain.edges[edge as usize];
                let offset = centre - edge.from;
                (offset - edge.along * offset.dot(edge.along)).length()
            }
            Feature::Corner(corner) => centre.distance(self.terrain.corners[corner as usize].point),
        };
        let depth = body.ball.radius_m - distance;
        let level = normal.with_z(0.0);
        let square = level.length_squared();
        if depth <= tolerance::PUSH_OUT_M || square < 0.25 || depth > 2.0 * tolerance::PRESS_M {
            return DVec3::ZERO;
        }
        level * (depth / square)
    }

    /// Counts a contact; whether there were too many of them in too short a time.
    fn is_busy(&mut self, at: Seconds, index: usize) -> bool {
        let body = &mut self.bodies[index];
        if at - body.busy.0 > tolerance::BUSY_S {
            body.busy = (at, 0);
        }
        body.busy.1 += 1;
        body.busy.1 > tolerance::BUSY_CONTACTS
            && body.ball.flags.gravity
            && self.parameters.gravity_m_s2 > 0.0
    }

    /// Two balls meet.
    pub(super) fn collide(
        &mut self,
        at: Seconds,
        one: usize,
        two: usize,
    ) -> Result<(), PhysicsError> {
        let (a, b) = (one.min(two), one.max(two));
        self.check_finite(at, a)?;
        self.check_finite(at, b)?;
        let members = self.cluster_of(at, &[a, b]);
        let (movers, normal) = self.pair(at, a, b);
        let beside = [(a, &movers.0), (b, &movers.1)].into_iter().any(|(index, mover)| {
            // What a ball might be pressed against counts, wherever it moves now.
            let pushed = Mover {
                velocity: if index == a { normal } else { -normal },
                ..*mover
            };
            !self.also_touched(at, index, &[], &pushed).is_empty()
        });
        if members.len() > 2 || beside {
            self.resolve_cluster(at, &members, a, &Touched::new());
            return Ok(());
        }

        self.work.contacts += 1;
        let (mut p, mut q) = movers;
        let approach =
            -(p.surface_velocity(normal) - q.surface_velocity(-normal)).dot(normal);
        let Law { restitution, friction } = self.parameters.ball;
        let restitution = if approach < tolerance::STICKY_M_S { 0.0 } else { restitution };
        let impact = ball_ball::collide(&mut p, &mut q, normal, restitution, friction);
        self.ledger.ball_ball_j += impact.loss_j;
        for (index, mover) in [(a, &mut p), (b, &mut q)] {
            self.hold_up(at, index, mover);
        }
        let point = self.bodies[a].segment.position_at(at) - normal * self.bodies[a].ball.radius_m;
        self.tell_collision(at, a, b, point, approach);
        let shifts = self.part(at, a, b, normal);
        let busy = self.is_busy(at, a) | self.is_busy(at, b);
        for (index, mover, shift) in [(a, &p, shifts.0), (b, &q, shifts.1)] {
            if busy && self.pressed(at, index) {
                self.begin_lasting_with(at, index, mover, DVec3::ZERO);
            } else {
                self.go_on(at, index, mover, shift, 0.0);
            }
        }
        self.predict(at, &[a, b]);
        self.wake_neighbours(at, &[a, b]);
        Ok(())
    }

    /// Whether a ball leans on another, so that micro-impacts would never end: gravity presses.
    fn pressed(&self, at: Seconds, index: usize) -> bool {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at);
        self.bodies.iter().enumerate().any(|(other, it)| {
            let line = centre - it.segment.position_at(at);
            other != index
                && it.solid()
                && line.z.abs() > 1e-4
                && line.length() - body.ball.radius_m - it.ball.radius_m <= 10.0 * TOUCH_M
        })
    }

    fn pair(&self, at: Seconds, a: usize, b: usize) -> ((Mover, Mover), DVec3) {
        let (one, two) = (&self.bodies[a], &self.bodies[b]);
        let line = one.segment.position_at(at) - two.segment.position_at(at);
        ((one.mover(at), two.mover(at)), line.normalize_or(DVec3::X))
    }

    /// What carries a ball takes what would press it in, without restitution and, at this short a
    /// contact, without friction.
    fn hold_up(&mut self, at: Seconds, index: usize, mover: &mut Mover) {
        let Some((normal, _)) = self.support(index, at) else { return };
        let into = mover.velocity.dot(normal);
        if into < 0.0 && mover.inverse_mass > 0.0 {
            mover.velocity -= normal * into;
            self.ledger.face_j += 0.5 * into * into / mover.inverse_mass;
            self.ledger.momentum.table -= normal * (into / mover.inverse_mass);
        }
    }

    /// How two balls that were pressed together part, each by its share, on the level.
    fn part(&self, at: Seconds, a: usize, b: usize, normal: DVec3) -> (DVec3, DVec3) {
        let (one, two) = (&self.bodies[a], &self.bodies[b]);
        let distance = one.segment.position_at(at).distance(two.segment.position_at(at));
        let depth = one.ball.radius_m + two.ball.radius_m - distance;
        let level = normal.with_z(0.0);
        let square = level.length_squared();
        let (p, q) = (one.mover(at).inverse_mass, two.mover(at).inverse_mass);
        if depth <= tolerance::PUSH_OUT_M || square < 0.25 || depth > 2.0 * tolerance::PRESS_M {
            return (DVec3::ZERO, DVec3::ZERO);
        }
        let out = level * (depth / square / (p + q));
        (out * p, out * -q)
    }

    /// The partners of a contact, and from them outwards all balls that nearly touch.
    fn cluster_of(&self, at: Seconds, partners: &[usize]) -> Changed {
        let mut members = Changed::from_slice(partners);
        let mut place = 0;
        while place < members.len() {
            let body = &self.bodies[members[place]];
            let (centre, radius) = (body.segment.position_at(at), body.ball.radius_m);
            for (other, it) in self.bodies.iter().enumerate() {
                if !it.solid() || members.contains(&other) {
                    continue;
                }
                let reach = radius + it.ball.radius_m + tolerance::CLUSTER_M;
                let apart = it.segment.position_at(at) - centre;
                if apart.x.abs() <= reach && apart.length_squared() <= reach * reach {
                    members.push(other);
                }
            }
            place += 1;
        }
        members.sort_unstable();
        members
    }

    /// Several contacts at one instant; `met` are features that ball `meets` has met.
    fn resolve_cluster(&mut self, at: Seconds, members: &[usize], meets: usize, met: &Touched) {
        let mut movers: SmallVec<[Mover; 16]> =
            members.iter().map(|index| self.bodies[*index].mover(at)).collect();
        let before = movers.clone();
        let mut touches: Vec<Touch> = Vec::new();
        let mut pairs: SmallVec<[(usize, usize); 32]> = SmallVec::new();
        for (place, a) in members.iter().enumerate() {
            for (further, b) in members.iter().enumerate().skip(place + 1) {
                let line =
                    self.bodies[*a].segment.position_at(at) - self.bodies[*b].segment.position_at(at);
                let reach = self.bodies[*a].ball.radius_m + self.bodies[*b].ball.radius_m;
                if line.length() - reach <= tolerance::CLUSTER_M {
                    let normal = line.normalize_or(DVec3::X);
                    let touch = Touch::new(place, Some(further), normal, self.parameters.ball);
                    touches.push(Touch { sticky_m_s: tolerance::STICKY_M_S, ..touch });
                    pairs.push((*a, *b));
                }
            }
        }
        let balls = touches.len();
        let mut faces: SmallVec<[(usize, Feature); 8]> = SmallVec::new();
        for (place, index) in members.iter().enumerate() {
            let body = &self.bodies[*index];
            let centre = body.segment.position_at(at);
            let own = if *index == meets { &met[..] } else { &[] };
            let near = self.terrain.near(centre, body.ball.radius_m + TOUCH_M);
            let near = near
                .iter()
                .filter(|(feature, _, _)| {
                    !own.iter().any(|(met, _)| met == feature)
                        && !body.held.iter().any(|held| self.terrain.belongs(*feature, *held))
                })
                .map(|(feature, normal, _)| (*feature, *normal));
            for (feature, normal) in own.iter().copied().chain(near) {
                let law = self.parameters.surface(self.terrain.surface(feature));
                let touch = Touch::new(place, None, normal, law);
                touches.push(Touch { sticky_m_s: tolerance::STICKY_M_S, ..touch });
                faces.push((*index, feature));
            }
        }
        let smooth = Law { restitution: 0.0, friction: 0.0 };
        for (place, index) in members.iter().enumerate() {
            if let Some((normal, _)) = self.support(*index, at) {
                touches.push(Touch { carries: true, ..Touch::new(place, None, normal, smooth) });
            }
        }
        cluster::resolve(&mut movers, &mut touches);

        for ((a, b), touch) in pairs.iter().zip(&touches[..balls]) {
            self.ledger.ball_ball_j += touch.loss_j;
            let impulse = touch.impulse.dot(touch.normal);
            if impulse > 0.0 {
                self.work.contacts += 1;
                let inverse =
                    movers[touch.a].inverse_mass + touch.b.map_or(0.0, |b| movers[b].inverse_mass);
                let speed = impulse * inverse / (1.0 + touch.restitution);
                let radius = self.bodies[*a].ball.radius_m;
                let point = self.bodies[*a].segment.position_at(at) - touch.normal * radius;
                self.tell_collision(at, *a, *b, point, speed);
            }
        }
        for (place, touch) in touches[balls..].iter().enumerate() {
            self.ledger.momentum.table += touch.impulse;
            let feature = faces.get(place);
            match feature.map(|(_, feature)| self.terrain.surface(*feature)) {
                Some(Surface::Cushion(rail)) => {
                    self.ledger.cushion_j += touch.loss_j;
                    let (index, normal) = (members[touch.a], touch.normal);
                    let speed = -before[touch.a].velocity.dot(normal);
                    let impulse = touch.impulse.dot(normal) * movers[touch.a].inverse_mass;
                    if impulse > 0.0 {
                        let radius = self.bodies[index].ball.radius_m;
                        let centre = self.bodies[index].segment.position_at(at);
                        let speed = speed.max(impulse / (1.0 + touch.restitution));
                        self.tell_cushion(at, index, rail, centre - normal * radius, speed);
                    }
                }
                _ => self.ledger.face_j += touch.loss_j,
            }
        }

        let mut changed = Changed::new();
        for (place, index) in members.iter().enumerate() {
            let (old, new) = (&before[place], &movers[place]);
            let moved = old.velocity != new.velocity || old.angular_velocity != new.angular_velocity;
            if moved || *index == meets || !self.bodies[*index].stands() {
                changed.push(*index);
            }
        }
        let depths: SmallVec<[DVec3; 16]> = self.ways_out(at, members, &pairs, &touches[..balls]);
        for (place, index) in members.iter().enumerate() {
            if !changed.contains(index) {
                continue;
            }
            if self.is_busy(at, *index) && (self.pressed(at, *index) || !faces.is_empty()) {
                self.begin_lasting_with(at, *index, &movers[place], DVec3::ZERO);
            } else {
                self.go_on(at, *index, &movers[place], depths[place], 0.0);
            }
        }
        self.predict(at, &changed);
        self.wake_neighbours(at, &changed);
    }

    /// How the balls of a cluster that were pressed together part.
    fn ways_out(
        &self,
        at: Seconds,
        members: &[usize],
        pairs: &[(usize, usize)],
        touches: &[Touch],
    ) -> SmallVec<[DVec3; 16]> {
        let mut shifts: SmallVec<[DVec3; 16]> = members.iter().map(|_| DVec3::ZERO).collect();
        for ((a, b), touch) in pairs.iter().zip(touches) {
            let (one, two) = self.part(at, *a, *b, touch.normal);
            shifts[touch.a] += one;
            if let Some(b) = touch.b {
                shifts[b] += two;
            }
        }
        shifts
    }

    /// A state that is no number is an error with its place.
    pub(super) fn check_finite(&self, at: Seconds, index: usize) -> Result<(), PhysicsError> {
        let body = &self.bodies[index];
        let s = &body.segment;
        for (term, value) in [
            ("position", s.position_at(at)),
            ("velocity", s.velocity_at(at)),
            ("angular velocity", s.angular_velocity_at(at) * 1e-3),
        ] {
            if !(value.is_finite() && value.abs().max_element() < 1e9) {
                return Err(PhysicsError::NonFinite { ball: body.ball.id, time_s: at, term });
            }
        }
        Ok(())
    }
}
