//! The cue of the exact solver.
//!
//! Detection needs quadratics: the path of the tip is one, piece by piece; its lag behind the path
//! is taken as one over windows of [`WINDOW_S`] (its error there is below a micrometre).

use super::EventDriven;
use super::closing::{self, Relative};
use super::segment::Segment;
use super::swing_meets::STRETCHES;
use crate::cue::{CuePath, CuePose};
use crate::events::{FactKind, TouchedBy};
use crate::physics::guided_cue::GuidedCue;
use crate::physics::laws::cue_ball::{Cue, cue_contact};
use crate::physics::{Parameters, PhysicsError, tolerance};
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

/// The cue and its way ahead.
#[derive(Debug, Clone)]
pub(super) struct Tip {
    /// How it moves.
    pub cue: GuidedCue,
    stretches: SmallVec<[Stretch; 6]>,
    /// When the window ends [s].
    until: Seconds,
    /// The first meeting with a ball: when, and which.
    meets: (Seconds, usize),
}

impl Tip {
    /// A cue at the start of `path`.
    pub fn new(path: Arc<CuePath>, parameters: &Parameters) -> Self {
        Tip {
            cue: GuidedCue::new(path, parameters),
            stretches: SmallVec::new(),
            until: f64::INFINITY,
            meets: (f64::INFINITY, 0),
        }
    }

    /// When something happens to it [s].
    pub fn next_s(&self) -> Seconds {
        self.until.min(self.meets.0)
    }

    /// Cuts the way from `at` on into stretches, as far as they are known.
    fn prepare(&mut self, at: Seconds) {
        self.stretches.clear();
        self.cue.forget_lag(at, LAG_OVER);
        if !self.cue.is_solid() {
            self.until = f64::INFINITY;
            return;
        }
        let end = self.cue.path().end_s().unwrap_or(at);
        self.until = match (self.cue.lags(), end > at) {
            (true, _) => at + WINDOW_S,
            (false, true) => end.min(at + AHEAD_S),
            (false, false) => f64::INFINITY,
        };
        let mut cuts: SmallVec<[Seconds; 8]> = SmallVec::from_slice(&[at]);
        for piece in &self.cue.path().pieces {
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
            let (position, velocity, acceleration) = self.cue.parabola(from, to, middle, to - from);
            self.stretches.push(Stretch { start: from, end: to, position, velocity, acceleration });
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
            closing::spheres(&motion, radius_m + self.cue.tip_radius_m, horizon)
                .map(|time| start + time)
        })
    }

    /// The same for a ball on a spring; and when to look again, if its swing was not followed as
    /// far as the tip's way is known.
    fn meets_swinging(
        &self,
        ball: &Segment,
        radius_m: f64,
        from: Seconds,
    ) -> (Option<Seconds>, Seconds) {
        let nothing = (None, f64::INFINITY);
        let Some(swing) = &ball.swing else { return nothing };
        let reach = swing.reach_all_m(ball) + radius_m + self.cue.tip_radius_m;
        let near = |stretch: &Stretch| {
            let lasts = (stretch.end - stretch.start).min(AHEAD_S);
            let fastest = stretch.velocity.length() + stretch.acceleration.length() * lasts;
            stretch.position.distance(swing.rest) <= reach + fastest * lasts
        };
        if !self.stretches.iter().any(near) {
            return nothing;
        }
        let until = ball.end_s.min(self.until);
        let mut from = from;
        for _ in 0..STRETCHES {
            let piece = ball.stretch(from, until);
            if let Some(time) = self.first_contact(&piece, radius_m, from) {
                return (Some(time), f64::INFINITY);
            }
            from = piece.end_s;
            if until <= from {
                return nothing;
            }
        }
        (None, from)
    }
}

impl EventDriven {
    /// Looks at the tip's way from `at` on.
    pub(super) fn open_window(&mut self, at: Seconds) {
        let Some(tip) = &mut self.tip else { return };
        let bodies = &self.bodies;
        tip.cue.forget_parted(at, |ball| {
            let body = &bodies[ball];
            body.in_play().then(|| (body.segment.position_at(at), body.ball.radius_m))
        });
        tip.prepare(at);
        if tip.cue.is_blind() {
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
            let blind = tip.cue.is_blind_to(index);
            if !body.solid() || blind || !(whole || changed.contains(&index)) {
                continue;
            }
            tests += 1;
            let (segment, radius) = (&body.segment, body.ball.radius_m);
            let (met, again) = if segment.swings() {
                tip.meets_swinging(segment, radius, at)
            } else {
                (tip.first_contact(segment, radius, at), f64::INFINITY)
            };
            tip.until = tip.until.min(again);
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
        let pose = tip.cue.pose(at);
        let CuePose { tip: centre, velocity, direction, .. } = pose;
        let has_struck = tip.cue.has_struck;

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
        self.begin_shot(at);
        self.press_on_bed(at, index, &mut mover);
        self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
        let kind = FactKind::CueBallStruck {
            ball,
            push: self.is_pushed(at, index, velocity_after),
            moving,
            player: None,
            miscue: !impact.sticks,
            position_m: point,
            normal_speed_m_s: approach,
        };
        self.tell(at, kind);
        if !has_struck {
            self.tell_shaft(at, index, &pose);
        }
        if let Some(tip) = &mut self.tip {
            tip.cue.strike(at, index, cue.velocity - velocity);
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

    /// Balls that lie in the shaft when it strikes were touched by it. They are told, not moved.
    fn tell_shaft(&mut self, at: Seconds, struck: usize, pose: &CuePose) {
        for index in 0..self.bodies.len() {
            let body = &self.bodies[index];
            let (centre, radius_m) = (body.segment.position_at(at), body.ball.radius_m);
            if index != struck && body.solid() && pose.shaft_meets(centre, radius_m) {
                let ball = body.ball.id;
                self.tell(at, FactKind::BallTouched { ball, by: TouchedBy::Shaft });
            }
        }
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
