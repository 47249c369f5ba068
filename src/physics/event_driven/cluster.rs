//! Several contacts at one instant: who takes part, and how they go on.

use super::EventDriven;
use super::contacts::Touched;
use super::lasting::TOUCH_M;
use super::predict::Changed;
use super::terrain::Feature;
use crate::mesh::Surface;
use crate::physics::laws::Mover;
use crate::physics::laws::choice;
use crate::physics::laws::cluster::Touch;
use crate::physics::{Contact as Law, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// How often the overlaps of a cluster are looked at; it bounds the work.
const WAYS_OUT_MAX: usize = 50;

impl EventDriven {
    /// The partners of a contact, and from them outwards all balls that nearly touch.
    pub(super) fn cluster_of(&self, at: Seconds, partners: &[usize]) -> Changed {
        let mut members = Changed::from_slice(partners);
        let mut place = 0;
        while place < members.len() {
            let (centre, radius) = {
                let index = members[place];
                (self.centre_at(index, at), self.paths[index].radius_m)
            };
            for (other, it) in self.paths.iter().enumerate() {
                let reach = radius + it.radius_m + tolerance::CLUSTER_M;
                if it.solid
                    && self.centre_at(other, at).distance_squared(centre) <= reach * reach
                    && !members.contains(&other)
                {
                    members.push(other);
                }
            }
            place += 1;
        }
        members.sort_unstable();
        members
    }

    /// Several contacts at one instant; `met` are features that ball `meets` has met.
    pub(super) fn resolve_cluster(
        &mut self,
        at: Seconds,
        members: &[usize],
        meets: usize,
        met: &Touched,
    ) {
        let mut movers: SmallVec<[Mover; 16]> =
            members.iter().map(|index| self.bodies[*index].mover(at)).collect();
        let before = movers.clone();
        let mut touches: Vec<Touch> = Vec::new();
        let mut gaps: SmallVec<[f64; 32]> = SmallVec::new();
        let mut pairs: SmallVec<[(usize, usize); 32]> = SmallVec::new();
        for (place, a) in members.iter().enumerate() {
            for (further, b) in members.iter().enumerate().skip(place + 1) {
                let line = self.bodies[*a].segment.position_at(at)
                    - self.bodies[*b].segment.position_at(at);
                let reach = self.bodies[*a].ball.radius_m + self.bodies[*b].ball.radius_m;
                if line.length() - reach <= tolerance::CLUSTER_M {
                    let normal = line.normalize_or(DVec3::X);
                    let slip = movers[place].surface_velocity(normal)
                        - movers[further].surface_velocity(-normal);
                    let along = slip - normal * slip.dot(normal);
                    let law = self.parameters.ball_at(along.length());
                    gaps.push((line.length() - reach).max(0.0));
                    let touch = Touch::new(place, Some(further), normal, law);
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
            let on_main = body.held.len() == 1 && body.held[0] == self.terrain.main_patch();
            let near = self.terrain.near_but(centre, body.ball.radius_m + TOUCH_M, on_main);
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
        gaps.resize(touches.len(), 0.0);
        choice::several(&mut movers, &mut touches, &gaps, &self.parameters);

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

        let depths: SmallVec<[DVec3; 16]> = self.ways_out(at, members, &pairs, &touches, &faces);
        let mut changed = Changed::new();
        for (place, index) in members.iter().enumerate() {
            let (old, new) = (&before[place], &movers[place]);
            let moved =
                old.velocity != new.velocity || old.angular_velocity != new.angular_velocity;
            let parts = depths[place] != DVec3::ZERO;
            if moved || parts || *index == meets || !self.bodies[*index].stands() {
                changed.push(*index);
            }
        }
        for (place, index) in members.iter().enumerate() {
            if !changed.contains(index) {
                continue;
            }
            self.bodies[*index].met = None;
            if self.is_busy(at, *index) && (self.pressed(at, *index) || !faces.is_empty()) {
                self.begin_lasting_with(at, *index, &movers[place], depths[place]);
            } else {
                self.go_on(at, *index, &movers[place], depths[place], 0.0);
            }
        }
        self.predict(at, &changed);
        self.wake_neighbours(at, &changed);
    }

    /// How the balls of a cluster that were pressed together, or into faces, part: each pair by its
    /// shares, again and again until none overlaps, because who parts from one is pushed into the
    /// next. On the level, so that no energy appears.
    fn ways_out(
        &self,
        at: Seconds,
        members: &[usize],
        pairs: &[(usize, usize)],
        touches: &[Touch],
        faces: &[(usize, Feature)],
    ) -> SmallVec<[DVec3; 16]> {
        let mut shifts: SmallVec<[DVec3; 16]> = members.iter().map(|_| DVec3::ZERO).collect();
        let (pair_touches, face_touches) = touches.split_at(pairs.len());
        for _ in 0..WAYS_OUT_MAX {
            let mut clear = true;
            for ((a, b), touch) in pairs.iter().zip(pair_touches) {
                let Some(other) = touch.b else { continue };
                let (one, two) = (shifts[touch.a], shifts[other]);
                let (one, two) = self.part(at, (*a, one), (*b, two), touch.normal);
                clear &= one == DVec3::ZERO && two == DVec3::ZERO;
                shifts[touch.a] += one;
                shifts[other] += two;
            }
            for ((index, feature), touch) in faces.iter().zip(face_touches) {
                let out = self.way_out(at, (*index, shifts[touch.a]), touch.normal, *feature);
                clear &= out == DVec3::ZERO;
                shifts[touch.a] += out;
            }
            if clear {
                break;
            }
        }
        shifts
    }
}
