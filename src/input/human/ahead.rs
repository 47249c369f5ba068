//! What the person sees ahead while aiming.

use super::super::{AimAid, BallWay, Foresight};
use super::{Human, KeyStroke, Stage};
use crate::cue::Aim;
use crate::units::Tick;
use std::sync::Arc;

/// How fast a stroke is taken to be before there was one [m/s].
const FIRST_SPEED_M_S: f64 = 2.0;
/// The ways are computed anew so often at most [ticks]: about as often as a picture is drawn.
const PAUSE_TICKS: u64 = 33;

/// The ways of the balls, and for which stroke they are.
#[derive(Debug, Clone, Default)]
pub(super) struct Ahead {
    pub aid: AimAid,
    foresight: Option<Foresight>,
    ways: Arc<Vec<BallWay>>,
    of: Option<(Aim, f64)>,
    looked: Tick,
}

impl Human {
    /// The same with a table to look ahead on.
    #[must_use]
    pub fn with_foresight(mut self, foresight: Foresight) -> Self {
        self.ahead.foresight = Some(foresight);
        self
    }

    /// How hard the stroke is taken to be that is aimed [m/s]: as hard as the last one, or as a key
    /// that is held has made it.
    pub(super) fn expected_m_s(&self) -> f64 {
        let last = if 0.0 < self.strength_m_s { self.strength_m_s } else { FIRST_SPEED_M_S };
        self.key_stroke.as_ref().map_or(last, KeyStroke::speed_m_s)
    }

    /// Looks where the balls would go, if somebody wants to know.
    pub(super) fn look_ahead(&mut self, tick: Tick) {
        let wants = self.ahead.aid == AimAid::Ways && !self.stylus_leads();
        let aims = matches!(self.stage, Stage::Aiming | Stage::Stroking(_));
        if !(wants && aims) {
            self.ahead.of = None;
            self.ahead.ways = Arc::default();
            return;
        }
        let of = (self.aim, self.expected_m_s());
        if self.ahead.of == Some(of) || tick.0 < self.ahead.looked.0 + PAUSE_TICKS {
            return;
        }
        let Some(foresight) = &self.ahead.foresight else { return };
        // A stroke that cannot be has no ways.
        let ways = foresight.ways(&self.seen, self.cue_ball(), of.0, of.1).unwrap_or_default();
        self.ahead.ways = Arc::new(ways);
        (self.ahead.of, self.ahead.looked) = (Some(of), tick);
    }

    /// The ways that are seen.
    pub(super) fn ways_ahead(&self) -> Arc<Vec<BallWay>> {
        self.ahead.ways.clone()
    }
}
