//! All that a mixer is told of a game, as a list: what a file is mixed from.

use super::{Foley, Told, What};
use crate::events::Fact;
use crate::physics::Snapshot;
use std::sync::Arc;

/// Facts and snapshots in, what a mixer is told out. The stream begins with the game.
#[derive(Debug, Clone)]
pub struct Script {
    foley: Foley,
    rate_hz: f64,
    told: Vec<Told>,
}

impl Script {
    /// A script for a stream of `rate_hz` frames a second.
    pub fn new(foley: Foley, rate_hz: f64) -> Self {
        Script { foley, rate_hz, told: Vec::new() }
    }

    /// A fact; `after` is the first snapshot at or behind it, if there is one.
    pub fn hear(&mut self, fact: &Fact, after: Option<&Snapshot>) {
        if let Some(onset) = self.foley.hear(fact, after) {
            self.tell(onset.time_s, What::Onset(onset));
        }
    }

    /// The world at a later time.
    pub fn see(&mut self, snapshot: &Arc<Snapshot>) {
        let (onsets, rollings) = self.foley.see(snapshot);
        onsets.into_iter().for_each(|onset| self.tell(onset.time_s, What::Onset(onset)));
        let at = snapshot.time_s;
        rollings.into_iter().for_each(|rolling| self.tell(at, What::Rolling(rolling)));
    }

    fn tell(&mut self, time_s: f64, what: What) {
        // Half up. A negative time is the beginning.
        let at_frame = (time_s * self.rate_hz + 0.5) as u64;
        self.told.push(Told { at_frame, what });
    }

    /// Everything, in the order of the frames.
    pub fn finish(mut self) -> Vec<Told> {
        self.told.sort_by_key(|told| told.at_frame);
        self.told
    }
}

/// What a list tells, one after another: for [`super::perform`].
pub fn read_aloud(told: &[Told]) -> impl FnMut(u64) -> Option<Told> + '_ {
    let mut rest = told;
    move |end| {
        let (first, others) = rest.split_first().filter(|(first, _)| first.at_frame < end)?;
        rest = others;
        Some(*first)
    }
}
