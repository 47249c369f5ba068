//! All that a mixer is told of a game, as a list: what a file is mixed from.

use super::{Foley, Onset, Told};
use crate::events::Fact;
use crate::physics::Snapshot;
use crate::units::Seconds;
use std::sync::Arc;

/// Facts and snapshots in, what a mixer is told out. The stream begins with the game.
#[derive(Debug, Clone)]
pub struct Script {
    foley: Foley,
    rate_hz: f64,
    told: Vec<(u64, Told)>,
}

impl Script {
    /// A script for a stream of `rate_hz` frames a second.
    pub fn new(foley: Foley, rate_hz: f64) -> Self {
        Script { foley, rate_hz, told: Vec::new() }
    }

    /// A fact; `after` is the first snapshot at or behind it, if there is one.
    pub fn hear(&mut self, fact: &Fact, after: Option<&Snapshot>) {
        if let Some(onset) = self.foley.hear(fact, after) {
            self.begin(&onset);
        }
    }

    /// The world at a later time.
    pub fn see(&mut self, snapshot: &Arc<Snapshot>) {
        let (onsets, rollings) = self.foley.see(snapshot);
        onsets.iter().for_each(|onset| self.begin(onset));
        let at_frame = self.frame(snapshot.time_s);
        self.told.extend(rollings.into_iter().map(|rolling| (at_frame, Told::Roll(rolling))));
    }

    fn begin(&mut self, onset: &Onset) {
        let at_frame = self.frame(onset.time_s);
        self.told.push((at_frame, Told::Start { at_frame, onset: *onset }));
    }

    fn frame(&self, time_s: Seconds) -> u64 {
        // Half up. A negative time is the beginning.
        (time_s * self.rate_hz + 0.5) as u64
    }

    /// Everything, each with its frame, in order: a score for [`super::render_offline`].
    pub fn finish(mut self) -> Vec<(u64, Told)> {
        self.foley.rest().iter().for_each(|onset| self.begin(onset));
        self.told.sort_by_key(|(at_frame, _)| *at_frame);
        self.told
    }
}
