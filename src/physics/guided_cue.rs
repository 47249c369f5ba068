//! The cue as every solver has it: a tip that is led along a path, and lags behind after a strike.
//!
//! The tip follows its path exactly until it strikes. The impulse changes the cue's speed along its
//! shaft; from then on the cue lags behind its path, and the hand draws it back: a critically
//! damped coupling in closed form. Across the shaft the tip stays on the path, because the hand
//! guides it there. A ball that leaves faster than the path goes on is struck once; a path that
//! runs after the ball strikes it again, and that is told. When the tip meets what is the solvers'
//! own business.

use super::{Parameters, spring, tolerance};
use crate::cue::{CuePath, CuePose};
use crate::hash::StateHash;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

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
pub(super) struct GuidedCue {
    path: Arc<CuePath>,
    lead: Lead,
    coupling_rad_s: f64,
    /// Radius of the tip [m].
    pub tip_radius_m: f64,
    struck: SmallVec<[Struck; 2]>,
    /// The present stroke has struck already.
    pub has_struck: bool,
}

impl GuidedCue {
    /// A cue at the start of `path`.
    pub fn new(path: Arc<CuePath>, parameters: &Parameters) -> Self {
        GuidedCue {
            path,
            lead: Lead::default(),
            coupling_rad_s: parameters.cue_coupling_rad_s,
            tip_radius_m: parameters.tip_radius_m,
            struck: SmallVec::new(),
            has_struck: false,
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

    /// The path that it is led along.
    pub fn path(&self) -> &CuePath {
        &self.path
    }

    /// Whether the tip touches balls.
    pub fn is_solid(&self) -> bool {
        self.path.solid && !self.path.pieces.is_empty()
    }

    /// Whether it is not where its path is.
    pub fn lags(&self) -> bool {
        self.lead.offset_m != 0.0 || self.lead.rate_m_s != 0.0
    }

    /// Forgets a lag that is smaller than `over` at `at`, in m and m/s.
    pub fn forget_lag(&mut self, at: Seconds, over: f64) {
        let (offset_m, rate_m_s) = self.lead_at(at);
        if offset_m.abs() < over && rate_m_s.abs() < over {
            self.lead = Lead::default();
        }
    }

    /// Whether the ball was just struck and has not parted.
    pub fn is_blind_to(&self, ball: usize) -> bool {
        self.struck.iter().any(|struck| struck.ball == ball)
    }

    /// Whether there is any such ball.
    pub fn is_blind(&self) -> bool {
        !self.struck.is_empty()
    }

    /// Forgets struck balls that have parted by `at`; `place` gives a ball's centre and radius [m],
    /// none if it is out of play.
    pub fn forget_parted(&mut self, at: Seconds, place: impl Fn(usize) -> Option<(DVec3, f64)>) {
        let (tip, tip_radius_m) = (self.pose(at).tip, self.tip_radius_m);
        self.struck.retain(|struck| {
            place(struck.ball).is_some_and(|(centre, radius_m)| {
                centre.distance(tip) - radius_m - tip_radius_m <= tolerance::APART_M
            }) && at - struck.since_s <= tolerance::TIP_BLIND_S
        });
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
        if !self.lags() {
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

    /// Centre, velocity and acceleration at `from` of the parabola that the tip follows to `to`,
    /// `span` later; `middle` names the piece that holds in between. Inside of one piece the path
    /// is a parabola; so is, nearly, the lag.
    pub fn parabola(
        &self,
        from: Seconds,
        to: Seconds,
        middle: Seconds,
        span: Seconds,
    ) -> (DVec3, DVec3, DVec3) {
        let direction = self.direction(middle);
        let (position, velocity, acceleration) = match self.path.piece_at(middle) {
            Some(piece) if piece.start_s <= middle && middle < piece.end_s() => {
                let (position, velocity) = piece.at(from);
                (position, velocity, piece.acceleration)
            }
            _ => (self.on_path(middle).0, DVec3::ZERO, DVec3::ZERO),
        };
        let (offset, rate) = self.lead_at(from);
        let bend = if self.lags() && span > 0.0 {
            2.0 * (self.lead_at(to).0 - offset - rate * span) / (span * span)
        } else {
            0.0
        };
        (
            position + direction * offset,
            velocity + direction * rate,
            acceleration + direction * bend,
        )
    }

    /// The tip has struck `ball`, which changed its velocity by `change` [m/s]: from now on the cue
    /// moves along its shaft with what the contact left it.
    pub fn strike(&mut self, at: Seconds, ball: usize, change: DVec3) {
        let (offset_m, rate) = self.lead_at(at);
        let rate_m_s = rate + change.dot(self.direction(at));
        self.lead = Lead { time_s: at, offset_m, rate_m_s };
        self.struck.push(Struck { ball, since_s: at });
        self.has_struck = true;
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
