//! The cue in the stepper.
//!
//! The tip follows its path exactly until it strikes. The impulse changes the cue's speed along its
//! shaft; from then on the cue lags behind its path, and the hand draws it back: a critically
//! damped coupling, carried from step to step by its closed form. Across the shaft the tip stays on
//! the path, because the hand guides it there. A ball that leaves faster than the path goes on is
//! struck once; a path that runs after the ball strikes it again, and that is told.

use super::body::{Body, Path};
use super::spatial_hash::Bounds;
use crate::cue::{CuePath, CuePose, TIP_RADIUS_M};
use crate::hash::StateHash;
use crate::physics::{roots, spring, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// A stretch of the tip's way within a step: p + v τ + ½ a τ², τ from its start.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    start: Seconds,
    end: Seconds,
    position: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
}

impl Stretch {
    fn at(&self, tau: Seconds) -> (DVec3, DVec3) {
        let t = tau - self.start;
        (
            self.position + self.velocity * t + self.acceleration * (0.5 * t * t),
            self.velocity + self.acceleration * t,
        )
    }
}

/// How far the cue is ahead of its path, along the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Lead {
    /// At this time [s].
    time_s: Seconds,
    /// How far [m]; negative while it lags behind.
    offset_m: f64,
    /// Its rate [m/s].
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
pub(super) struct CueMotion {
    path: Arc<CuePath>,
    lead: Lead,
    coupling_rad_s: f64,
    struck: SmallVec<[Struck; 2]>,
    /// The present stroke has struck already.
    pub has_struck: bool,
    /// Counts the changes of its way: predictions made before one are void.
    pub revision: u32,
    stretches: SmallVec<[Stretch; 6]>,
    bounds: Bounds,
}

impl CueMotion {
    /// A cue at the start of `path`.
    pub fn new(path: Arc<CuePath>, coupling_rad_s: f64) -> Self {
        let nowhere = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        CueMotion {
            path,
            lead: Lead::default(),
            coupling_rad_s,
            struck: SmallVec::new(),
            has_struck: false,
            revision: 0,
            stretches: SmallVec::new(),
            bounds: nowhere,
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

    /// Whether the tip touches balls.
    pub fn is_solid(&self) -> bool {
        self.path.solid && !self.path.pieces.is_empty()
    }

    /// When it will stand still for good [s]; none while it follows or comes back to its path.
    pub fn stands_from(&self) -> Option<Seconds> {
        (self.lead.offset_m == 0.0 && self.lead.rate_m_s == 0.0)
            .then(|| self.path.end_s().unwrap_or(0.0))
    }

    /// Whether the ball was just struck and has not parted.
    pub fn is_blind_to(&self, ball: usize) -> bool {
        self.struck.iter().any(|struck| struck.ball == ball)
    }

    /// Unit vector along the shaft.
    pub fn direction(&self, at: Seconds) -> DVec3 {
        self.path.piece_at(at).map_or(DVec3::X, |piece| piece.direction_at(at))
    }

    /// Centre and velocity of the tip on the path alone: before its start and after its end it
    /// stands.
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

    /// Prepares the way from `tau` to the end of the step that begins at `start`.
    pub fn prepare(&mut self, start: Seconds, tau: Seconds, h: Seconds) {
        self.revision += 1;
        self.stretches.clear();
        let mut cuts: SmallVec<[Seconds; 8]> = SmallVec::new();
        cuts.push(tau);
        for piece in &self.path.pieces {
            for border in [piece.start_s - start, piece.end_s() - start] {
                if tau < border && border < h && cuts.last().is_none_or(|last| *last < border) {
                    cuts.push(border);
                }
            }
        }
        cuts.push(h);
        let mut bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        for pair in cuts.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let span = to - from;
            let middle = start + 0.5 * (from + to);
            let direction = self.direction(middle);
            // Inside of one piece the path is a parabola; so is, nearly, the lead.
            let (position, velocity, acceleration) = match self.path.piece_at(middle) {
                Some(piece) if piece.start_s <= middle && middle < piece.end_s() => {
                    let (position, velocity) = piece.at(start + from);
                    (position, velocity, piece.acceleration)
                }
                _ => (self.on_path(middle).0, DVec3::ZERO, DVec3::ZERO),
            };
            let (offset, rate) = self.lead_at(start + from);
            let (end_offset, _) = self.lead_at(start + to);
            let bend = if span > 0.0 {
                2.0 * (end_offset - offset - rate * span) / (span * span)
            } else {
                0.0
            };
            let stretch = Stretch {
                start: from,
                end: to,
                position: position + direction * offset,
                velocity: velocity + direction * rate,
                acceleration: acceleration + direction * bend,
            };
            // Both ends and the control point of the parabola hold all of it.
            let control = stretch.position + stretch.velocity * (0.5 * span);
            let bend = Bounds::swept(stretch.position, control, TIP_RADIUS_M);
            let whole = Bounds::swept(stretch.position, stretch.at(to).0, TIP_RADIUS_M);
            bounds = bounds.join(&bend).join(&whole);
            self.stretches.push(stretch);
        }
        self.bounds = bounds;
    }

    /// Box around what is left of the step's way.
    pub fn step_bounds(&self) -> Bounds {
        self.bounds
    }

    /// When the tip meets a ball on its way, from the start of the step.
    pub fn first_contact(&self, ball: &Path, radius_m: f64, h: Seconds) -> Option<Seconds> {
        self.stretches.iter().find_map(|stretch| {
            let from = stretch.start.max(ball.start);
            let end = stretch.end.min(h);
            if from > end {
                return None;
            }
            let (tip, velocity) = stretch.at(from);
            roots::curved(
                ball.at(from) - tip,
                ball.velocity - velocity,
                -stretch.acceleration,
                radius_m + TIP_RADIUS_M,
                end - from,
            )
            .map(|time| from + time)
        })
    }

    /// Centre and velocity of the tip at `tau` of the step.
    pub fn tip_at(&self, tau: Seconds) -> (DVec3, DVec3) {
        let stretch = self.stretches.iter().find(|s| tau <= s.end).or(self.stretches.last());
        stretch.map_or((DVec3::ZERO, DVec3::ZERO), |stretch| stretch.at(tau))
    }

    /// The tip has struck `ball`: from now on the cue moves along its shaft with what the contact
    /// left it.
    pub fn strike(&mut self, start: Seconds, tau: Seconds, h: Seconds, ball: usize, after: DVec3) {
        let at = start + tau;
        let (offset_m, _) = self.lead_at(at);
        let direction = self.direction(at);
        let (_, before) = self.tip_at(tau);
        let (_, rate) = self.lead_at(at);
        self.lead = Lead { time_s: at, offset_m, rate_m_s: rate + (after - before).dot(direction) };
        self.struck.push(Struck { ball, since_s: at });
        self.has_struck = true;
        self.prepare(start, tau, h);
    }

    /// A step, or several in which nothing happened, end: forgets balls that have parted, and a
    /// lead that has died away.
    pub fn end_step(&mut self, bodies: &[Body], end: Seconds) {
        let tip = self.pose(end).tip;
        self.struck.retain(|struck| {
            let body = &bodies[struck.ball];
            let gap = body.position.distance(tip) - body.ball.radius_m - TIP_RADIUS_M;
            body.in_play()
                && gap <= tolerance::APART_M
                && end - struck.since_s <= tolerance::TIP_BLIND_S
        });
        let (offset_m, rate_m_s) = self.lead_at(end);
        if offset_m.abs() < 1e-9 && rate_m_s.abs() < 1e-9 {
            self.lead = Lead::default();
        }
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
