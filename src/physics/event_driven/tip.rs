//! The cue of the exact solver.
//!
//! The tip follows its path exactly until it strikes. The impulse changes the cue's speed along its
//! shaft; from then on the cue lags behind its path and the hand draws it back: a critically
//! damped coupling in closed form. Across the shaft the tip stays on the path. Detection needs
//! quadratics: the path is one, piece by piece; the lag is taken as one over windows of
//! [`WINDOW_S`] (its error there is below a micrometre). A ball that leaves faster than the path
//! goes on is struck once; a path that runs after the ball strikes it again, and that is told.

use super::EventDriven;
use super::closing::{self, Relative};
use super::segment::Segment;
use crate::cue::{CuePath, CuePose, TIP_RADIUS_M};
use crate::events::{FactKind, TouchedBy};
use crate::hash::StateHash;
use crate::ids::BallId;
use crate::physics::laws::cue_ball::{Cue, cue_contact};
use crate::physics::{PhysicsError, spring, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// How long the lag counts as a parabola [s].
const WINDOW_S: Seconds = 2e-3;
/// How far a path is looked ahead [s].
const AHEAD_S: Seconds = 10.0;
/// A lag this small, and this slow, is over [m, m/s].
const LAG_OVER: f64 = 1e-7;

/// A stretch of the tip's way: p + v τ + ½ a τ², τ from its start.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    start: Seconds,
    end: Seconds,
    position: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
}

/// How far the cue is ahead of its path, along the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Lead {
    time_s: Seconds,
    offset_m: f64,
    rate_m_s: f64,
}

/// A ball that the tip has struck and not parted from.
#[derive(Debug, Clone, Copy)]
struct Struck {
    ball: usize,
    since_s: Seconds,
}

/// The cue.
#[derive(Debug, Clone)]
pub(super) struct Tip {
    path: Arc<CuePath>,
    lead: Lead,
    coupling_rad_s: f64,
    struck: SmallVec<[Struck; 2]>,
    has_struck: bool,
    stretches: SmallVec<[Stretch; 6]>,
    /// When the window ends [s].
    until: Seconds,
    /// The first meeting with a ball: when, and which.
    meets: (Seconds, usize),
}

impl Tip {
    /// A cue at the start of `path`.
    pub fn new(path: Arc<CuePath>, coupling_rad_s: f64) -> Self {
        Tip {
            path,
            lead: Lead::default(),
            coupling_rad_s,
            struck: SmallVec::new(),
            has_struck: false,
            stretches: SmallVec::new(),
            until: f64::INFINITY,
            meets: (f64::INFINITY, 0),
        }
    }

    /// Goes on along another path. A path that is not solid ends the stroke.
    pub fn follow(&mut self, path: Arc<CuePath>) {
        if !path.solid {
            self.lead = Lead::default();
            self.struck.clear();
            self.has_struck = false;
        }
        self.path = path;
    }

    /// What was struck is forgotten: a new shot begins.
    pub fn new_shot(&mut self) {
        self.has_struck = false;
    }

    /// When something happens to it [s].
    pub fn next_s(&self) -> Seconds {
        self.until.min(self.meets.0)
    }

    fn direction(&self, at: Seconds) -> DVec3 {
        self.path.piece_at(at).map_or(DVec3::X, |piece| piece.direction_at(at))
    }

    /// Centre and velocity on the path alone: before its start and after its end it stands.
    fn on_path(&self, at: Seconds) -> (DVec3, DVec3) {
        let Some(piece) = self.path.piece_at(at) else { return (DVec3::ZERO, DVec3::ZERO) };
        if at < piece.start_s {
            (piece.position, DVec3::ZERO)
        } else if at >= piece.end_s() {
            (piece.at(piece.end_s()).0, DVec3::ZERO)
        } else {
            piece.at(at)
        }
    }

    fn lead_at(&self, at: Seconds) -> (f64, f64) {
        let Lead { time_s, offset_m, rate_m_s } = self.lead;
        if offset_m == 0.0 && rate_m_s == 0.0 {
            return (0.0, 0.0);
        }
        let m = spring::propagator(self.coupling_rad_s, 1.0, (at - time_s).max(0.0));
        (m[0][0] * offset_m + m[0][1] * rate_m_s, m[1][0] * offset_m + m[1][1] * rate_m_s)
    }

    /// The cue as everybody sees it.
    pub fn pose(&self, at: Seconds) -> CuePose {
        let (tip, velocity) = self.on_path(at);
        let direction = self.direction(at);
        let (offset, rate) = self.lead_at(at);
        CuePose {
            tip: tip + direction * offset,
            velocity: velocity + direction * rate,
            direction,
            solid: self.path.solid,
        }
    }

    /// Cuts the way from `at` on into stretches, as far as they are known.
    fn prepare(&mut self, at: Seconds) {
        self.stretches.clear();
        let (offset, rate) = self.lead_at(at);
        if offset.abs() < LAG_OVER && rate.abs() < LAG_OVER {
            self.lead = Lead::default();
        }
        let lags = self.lead != Lead::default();
        let end = self.path.end_s().unwrap_or(at);
        if !self.path.solid || self.path.pieces.is_empty() {
            self.until = f64::INFINITY;
            return;
        }
        self.until = match (lags, end > at) {
            (true, _) => at + WINDOW_S,
            (false, true) => end.min(at + AHEAD_S),
            (false, false) => f64::INFINITY,
        };
        let mut cuts: SmallVec<[Seconds; 8]> = SmallVec::from_slice(&[at]);
        for piece in &self.path.pieces {
            for border in [piece.start_s, piece.end_s()] {
                if cuts.last().is_none_or(|last| *last < border) && border < self.until {
                    cuts.push(border);
                }
            }
        }
        cuts.push(self.until);
        for pair in cuts.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let middle = if to.is_finite() { 0.5 * (from + to) } else { from };
            let direction = self.direction(middle);
            let (position, velocity, acceleration) = match self.path.piece_at(middle) {
                Some(piece) if piece.start_s <= middle && middle < piece.end_s() => {
                    let (position, velocity) = piece.at(from);
                    (position, velocity, piece.acceleration)
                }
                _ => (self.on_path(middle).0, DVec3::ZERO, DVec3::ZERO),
            };
            let (offset, rate) = self.lead_at(from);
            let span = to - from;
            let bend = if lags && span > 0.0 {
                2.0 * (self.lead_at(to).0 - offset - rate * span) / (span * span)
            } else {
                0.0
            };
            self.stretches.push(Stretch {
                start: from,
                end: to,
                position: position + direction * offset,
                velocity: velocity + direction * rate,
                acceleration: acceleration + direction * bend,
            });
        }
    }

    /// When the tip meets a ball, at `from` or later.
    fn first_contact(&self, ball: &Segment, radius_m: f64, from: Seconds) -> Option<Seconds> {
        self.stretches.iter().find_map(|stretch| {
            let start = from.max(stretch.start);
            let end = stretch.end.min(ball.end_s);
            if start > end {
                return None;
            }
            let t = start - stretch.start;
            let tip = stretch.position + (stretch.velocity + stretch.acceleration * (0.5 * t)) * t;
            let motion = Relative {
                offset: ball.position_at(start) - tip,
                velocity: ball.velocity_at(start) - stretch.velocity - stretch.acceleration * t,
                acceleration: ball.acceleration - stretch.acceleration,
            };
            let horizon = (end - start).min(AHEAD_S);
            closing::spheres(&motion, radius_m + TIP_RADIUS_M, horizon).map(|time| start + time)
        })
    }

    /// Adds everything that decides its future to `hash`.
    pub fn hash(&self, hash: &mut StateHash) {
        hash.u64(u64::from(self.path.solid) << 1 | u64::from(self.has_struck));
        hash.f64(self.lead.offset_m);
        hash.f64(self.lead.rate_m_s);
        hash.u64(self.struck.len() as u64);
        for piece in &self.path.pieces {
            hash.f64(piece.start_s);
            hash.f64(piece.duration_s);
            hash.vec3(piece.position);
            hash.vec3(piece.velocity);
            hash.vec3(piece.acceleration);
            hash.vec3(piece.direction_end);
        }
    }
}

impl EventDriven {
    /// Looks at the tip's way from `at` on.
    pub(super) fn open_window(&mut self, at: Seconds) {
        let Some(tip) = &mut self.tip else { return };
        let centre = tip.pose(at).tip;
        let bodies = &self.bodies;
        tip.struck.retain(|struck| {
            let body = &bodies[struck.ball];
            let gap =
                body.segment.position_at(at).distance(centre) - body.ball.radius_m - TIP_RADIUS_M;
            body.in_play()
                && gap <= tolerance::APART_M
                && at - struck.since_s <= tolerance::TIP_BLIND_S
        });
        tip.prepare(at);
        if !tip.struck.is_empty() {
            // A ball that has not parted is looked at again soon.
            tip.until = tip.until.min(at + WINDOW_S);
        }
        tip.meets = (f64::INFINITY, 0);
        let all: super::predict::Changed = (0..self.bodies.len()).collect();
        self.predict_tip(at, &all);
    }

    /// Contacts of the tip, after the balls in `changed` go on differently.
    pub(super) fn predict_tip(&mut self, at: Seconds, changed: &[usize]) {
        let Some(tip) = &mut self.tip else { return };
        if tip.stretches.is_empty() {
            return;
        }
        let whole = changed.contains(&tip.meets.1) && tip.meets.0.is_finite();
        if whole {
            tip.meets = (f64::INFINITY, 0);
        }
        let mut tests = 0;
        for (index, body) in self.bodies.iter().enumerate() {
            let blind = tip.struck.iter().any(|struck| struck.ball == index);
            if !body.solid() || blind || !(whole || changed.contains(&index)) {
                continue;
            }
            tests += 1;
            let met = tip.first_contact(&body.segment, body.ball.radius_m, at);
            if let Some(time) = met.filter(|time| *time < tip.meets.0) {
                tip.meets = (time, index);
            }
        }
        self.work.pair_tests += tests;
    }

    /// The tip's window ends, or it strikes.
    pub(super) fn tip_event(&mut self, at: Seconds) -> Result<(), PhysicsError> {
        let Some(tip) = &self.tip else { return Ok(()) };
        if tip.until < tip.meets.0 {
            self.open_window(at);
            return Ok(());
        }
        let index = tip.meets.1;
        self.check_finite(at, index)?;
        let CuePose { tip: centre, velocity, direction, .. } = tip.pose(at);
        let has_struck = tip.has_struck;

        let body = &self.bodies[index];
        let (position, radius) = (body.segment.position_at(at), body.ball.radius_m);
        let normal = (position - centre).normalize_or(direction);
        let mut mover = body.mover(at);
        let before = mover;
        let approach = -(mover.surface_velocity(normal) - velocity).dot(normal);
        let mut cue = Cue::new(&self.parameters, velocity, direction);
        let impact = cue_contact(&mut mover, &mut cue, normal);
        self.ledger.cue_j += mover.kinetic_j() - before.kinetic_j();
        self.ledger.momentum.cue += impact.impulse;
        self.work.contacts += 1;

        // What is told is as it was before the stroke.
        let lively =
            |body: &super::Body| body.in_play() && body.liveliness(at) > tolerance::REST_M_S;
        let moving = !has_struck && self.bodies.iter().any(lively);
        let ball = body.ball.id;
        let point = position - normal * radius;
        let velocity_after = mover.velocity;
        self.press_on_bed(at, index, &mut mover);
        self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
        let kind = if ball == BallId::CUE {
            let push = self.is_pushed(at, index, velocity_after);
            FactKind::CueBallStruck {
                ball,
                push,
                moving,
                player: None,
                position_m: point,
                normal_speed_m_s: approach,
            }
        } else {
            FactKind::BallTouched { ball, by: TouchedBy::Tip }
        };
        self.tell(at, kind);
        if let Some(tip) = &mut self.tip {
            let (offset_m, rate) = tip.lead_at(at);
            let change = (cue.velocity - velocity).dot(direction);
            tip.lead = Lead { time_s: at, offset_m, rate_m_s: rate + change };
            tip.struck.push(Struck { ball: index, since_s: at });
            tip.has_struck = true;
            tip.meets = (f64::INFINITY, 0);
        }
        self.predict(at, &[index]);
        self.open_window(at);
        self.wake_neighbours(at, &[index]);
        Ok(())
    }

    /// A stroke that presses the ball into the bed: the bed answers with its own restitution,
    /// which is what makes a jump shot.
    fn press_on_bed(&mut self, at: Seconds, index: usize, mover: &mut crate::physics::laws::Mover) {
        let [feature] = self.bodies[index].held[..] else { return };
        let centre = self.bodies[index].segment.position_at(at);
        let Some(normal) = self.flat_normal(feature, centre) else { return };
        let into = -mover.velocity.dot(normal);
        if into <= 0.0 {
            return;
        }
        let law = self.parameters.surface(self.terrain.surface(feature));
        let slow = law.restitution * into < tolerance::LANDING_M_S;
        let restitution = if slow { 0.0 } else { law.restitution };
        let impact =
            crate::physics::laws::ball_face::bounce(mover, normal, restitution, law.friction);
        self.ledger.momentum.table += impact.impulse;
        self.ledger.face_j += impact.loss_j;
    }

    /// Whether the ball, just struck, meets another while the tip is still on it: within the time
    /// that a tip stays, and not frozen to it before.
    fn is_pushed(&self, at: Seconds, index: usize, velocity: DVec3) -> bool {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at);
        self.bodies.iter().enumerate().any(|(other, it)| {
            let distance = body.ball.radius_m + it.ball.radius_m;
            let offset = centre - it.segment.position_at(at);
            other != index
                && it.solid()
                && offset.length() - distance > tolerance::CLUSTER_M
                && crate::physics::roots::straight(
                    offset,
                    velocity - it.segment.velocity_at(at),
                    distance,
                    tolerance::TIP_CONTACT_S,
                    0.0,
                )
                .is_some()
        })
    }
}
