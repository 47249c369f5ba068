//! The cue in the stepper.
//!
//! The way of the tip in a step is cut into parabolas: where its path changes, and where the step
//! ends. The first contact with a ball's straight path is found on each.

use super::body::{Body, Path};
use super::spatial_hash::Bounds;
use crate::cue::CuePath;
use crate::physics::Parameters;
use crate::physics::guided_cue::GuidedCue;
use crate::physics::roots;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;
use std::sync::Arc;

/// A lag this small, and this slow, is over [m, m/s].
const LAG_OVER: f64 = 1e-9;

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

/// The cue and its way in the step.
#[derive(Debug, Clone)]
pub(super) struct CueMotion {
    /// How it moves.
    pub guided: GuidedCue,
    /// Counts the changes of its way: predictions made before one are void.
    pub revision: u32,
    stretches: SmallVec<[Stretch; 6]>,
    bounds: Bounds,
}

impl CueMotion {
    /// A cue at the start of `path`.
    pub fn new(path: Arc<CuePath>, parameters: &Parameters) -> Self {
        CueMotion {
            guided: GuidedCue::new(path, parameters),
            revision: 0,
            stretches: SmallVec::new(),
            bounds: Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY },
        }
    }

    /// When it will stand still for good [s]; none while it follows or comes back to its path.
    pub fn stands_from(&self) -> Option<Seconds> {
        (!self.guided.lags()).then(|| self.guided.path().end_s().unwrap_or(0.0))
    }

    /// Prepares the way from `tau` to the end of the step that begins at `start`.
    pub fn prepare(&mut self, start: Seconds, tau: Seconds, h: Seconds) {
        self.revision += 1;
        self.stretches.clear();
        let mut cuts: SmallVec<[Seconds; 8]> = SmallVec::new();
        cuts.push(tau);
        for piece in &self.guided.path().pieces {
            for border in [piece.start_s - start, piece.end_s() - start] {
                if tau < border && border < h && cuts.last().is_none_or(|last| *last < border) {
                    cuts.push(border);
                }
            }
        }
        cuts.push(h);
        let tip_radius_m = self.guided.tip_radius_m;
        let mut bounds = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        for pair in cuts.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let span = to - from;
            let middle = start + 0.5 * (from + to);
            let (position, velocity, acceleration) =
                self.guided.parabola(start + from, start + to, middle, span);
            let stretch = Stretch { start: from, end: to, position, velocity, acceleration };
            // Both ends and the control point of the parabola hold all of it.
            let control = stretch.position + stretch.velocity * (0.5 * span);
            let bend = Bounds::swept(stretch.position, control, tip_radius_m);
            let whole = Bounds::swept(stretch.position, stretch.at(to).0, tip_radius_m);
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
                radius_m + self.guided.tip_radius_m,
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
        let (_, before) = self.tip_at(tau);
        self.guided.strike(at, ball, after - before);
        self.prepare(start, tau, h);
    }

    /// A step, or several in which nothing happened, end: forgets balls that have parted, and a
    /// lead that has died away.
    pub fn end_step(&mut self, bodies: &[Body], end: Seconds) {
        self.guided.forget_parted(end, |ball| {
            let body = &bodies[ball];
            body.in_play().then_some((body.position, body.ball.radius_m))
        });
        self.guided.forget_lag(end, LAG_OVER);
    }
}
