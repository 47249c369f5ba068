//! What is told: facts, each once, with the exact time.
//!
//! A ball that lies at a cushion, or two that lie together, touch in every step. That is told when
//! it begins and, later, only if they meet with some speed.

use super::body::Body;
use super::{FixedStep, collect, weight_j};
use crate::ball::BallPlace;
use crate::events::{Fact, FactKind};
use crate::ids::{BallId, PocketId, Rail};
use crate::mesh::Surface;
use crate::physics::{Profile, checks, racks, tolerance};
use crate::units::Seconds;
use glam::DVec3;

impl FixedStep {
    /// Notes a fact of the step in hand.
    pub(super) fn tell(&mut self, time_s: Seconds, kind: FactKind) {
        self.told.push(Fact { time_s, kind });
    }

    /// Two balls met; `a` comes before `b`.
    pub(super) fn tell_collision(
        &mut self,
        time_s: Seconds,
        a: usize,
        b: usize,
        position_m: DVec3,
        normal_speed_m_s: f64,
    ) {
        let new = match self.touching.binary_search(&(a, b)) {
            Ok(_) => false,
            Err(place) => {
                self.touching.insert(place, (a, b));
                true
            }
        };
        if !new && normal_speed_m_s <= tolerance::REPEATED_CONTACT_M_S {
            return;
        }
        let (mut one, mut two) = (a, b);
        if self.bodies[two].ball.id == BallId::CUE {
            (one, two) = (two, one);
        }
        let behind = |index: usize| {
            let x = self.bodies[index].path.at(time_s - self.begun).x;
            self.ground.head_string_x().is_some_and(|head| x <= head)
        };
        let kind = FactKind::BallsCollided {
            a: self.bodies[one].ball.id,
            b: self.bodies[two].ball.id,
            in_kitchen: behind(two),
            position_m,
            normal_speed_m_s,
        };
        self.tell(time_s, kind);
    }

    /// A ball met a cushion.
    pub(super) fn tell_cushion(
        &mut self,
        time_s: Seconds,
        index: usize,
        rail: Rail,
        position_m: DVec3,
        normal_speed_m_s: f64,
    ) {
        let bit = rail.bit();
        let body = &mut self.bodies[index];
        let onset = body.clear_rails & bit != 0;
        let held = body.held_rails & bit != 0;
        body.clear_rails &= !bit;
        body.held_rails |= bit;
        if held && !onset && normal_speed_m_s <= tolerance::REPEATED_CONTACT_M_S {
            return;
        }
        let ball = body.ball.id;
        self.tell(time_s, FactKind::CushionHit { ball, rail, onset, position_m, normal_speed_m_s });
    }

    /// A ball leaves play at `tau` of the step: into a pocket, or off the table.
    pub(super) fn take_out(
        &mut self,
        time_s: Seconds,
        index: usize,
        tau: Seconds,
        place: BallPlace,
        pocket: Option<PocketId>,
    ) {
        let g = self.parameters.gravity_m_s2;
        let body = &mut self.bodies[index];
        let start_j = weight_j(body, g);
        body.position = body.path.at(tau);
        let height_j = weight_j(body, g);
        self.ledger.integration_j += height_j - start_j;
        self.ledger.removed_j += body.mover().kinetic_j() + height_j;
        if body.ball.flags.integrate {
            self.ledger.momentum.removed += body.velocity * body.ball.mass_kg;
        }

        let (ball, speed_m_s) = (body.ball.id, body.velocity.length());
        collect(body, place, time_s);
        body.path.revision += 1;
        body.path.position = body.position;
        body.path.velocity = DVec3::ZERO;
        let knot = body.knot(time_s, body.position);
        body.knots.push(knot);
        self.touching.retain(|(a, b)| *a != index && *b != index);
        self.tell(
            time_s,
            match pocket {
                Some(pocket) => FactKind::BallPocketed { ball, pocket, speed_m_s },
                None => FactKind::BallOffTable { ball },
            },
        );
    }

    /// Tells once when everything has come to rest and stayed so. It changes no state, but for
    /// balls that lie beside the bed: they have left the table.
    pub(super) fn watch_rest(&mut self) {
        // The paper's lying balls fall and rise by what gravity gives in a step; that is no motion.
        let hop = match self.settings.profile {
            Profile::Standard => 0.0,
            Profile::Paper2009 => 4.0 * self.parameters.gravity_m_s2 * self.h,
        };
        let lively = self.bodies.iter().any(|body| {
            let lifted = body.velocity.z.abs() > hop.max(tolerance::REST_M_S);
            let level = body.velocity.with_z(0.0).length();
            let skin = body.angular_velocity.length() * body.ball.radius_m;
            body.active() && (lifted || level.max(skin) > tolerance::REST_M_S)
        });
        if lively {
            self.moved = true;
            self.rest_since = None;
            return;
        }
        if !self.moved {
            return;
        }
        let since = *self.rest_since.get_or_insert(self.step);
        if self.step < since + self.settle_steps {
            return;
        }
        self.moved = false;
        self.rest_since = None;
        let now = self.grid(self.step);
        for index in 0..self.bodies.len() {
            let body = &mut self.bodies[index];
            let beside = body.supports.iter().any(|support| support.surface == Surface::Wood);
            if body.in_play() && beside {
                body.path = super::body::Path { position: body.position, ..Default::default() };
                body.knots.clear();
                self.take_out(now, index, 0.0, BallPlace::OffTable, None);
            } else {
                self.clear_touched_rails(index);
            }
        }
        if let Some(cue) = &mut self.cue {
            cue.guided.has_struck = false;
        }
        self.memory.end();
        let lies = |body: &Body| (body.ball.id, body.position, body.ball.radius_m);
        let solid = self.bodies.iter().filter(|body| body.solid());
        for (a, b) in checks::frozen_pairs(solid.map(lies).collect()) {
            self.tell(now, FactKind::BallsFrozen { a, b });
        }
        let lies = |body: &Body| (body.ball.id, body.in_play(), body.position);
        let bed = self.ground.bed.as_ref();
        let cue_in_rack = racks::cue_in_rack(bed, self.bodies.iter().map(lies));
        self.tell(now, FactKind::Settled { snookered: false, cue_in_rack });
    }

    /// A shot begins here for this ball: it has been away from the rails that it does not touch.
    pub(super) fn clear_touched_rails(&mut self, index: usize) {
        let body = &mut self.bodies[index];
        body.clear_rails = !body.near_rails;
        body.held_rails = 0;
    }
}
