//! The tally: what a game comes to, counted from verdicts by somebody who only watches.

use crate::events::{Event, Source, Topic, Topics, TurnAfter, Verdict};
use crate::hash::StateHash;
use crate::ids::PlayerId;
use crate::physics::Snapshot;
use crate::tick::{Delivered, Outcome, Participant};
use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};

/// What a game came to. Arrays hold player 1, then player 2.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Who won; none in a draw or while it goes on.
    pub winner: Option<PlayerId>,
    /// The rules ended it.
    pub over: bool,
    /// Shots that were judged.
    pub shots: [u32; 2],
    /// Shots that were fouls.
    pub fouls: [u32; 2],
    /// Object balls that fell.
    pub pots: [u32; 2],
    /// The winner cleared his group and the 8 in one visit to the table.
    pub run_out: bool,
    /// Object balls pocketed in the visit that goes on.
    #[serde(skip)]
    visit_pots: u32,
}

impl Tally {
    /// Counts one verdict.
    pub fn count(&mut self, verdict: &Verdict) {
        let Some(player) = verdict.player else {
            return;
        };
        let seat = player.index();
        let pots = verdict.pocketed.len() as u32;
        self.shots[seat] += 1;
        self.fouls[seat] += u32::from(!verdict.legal);
        self.pots[seat] += pots;
        self.visit_pots += pots;
        match verdict.turn {
            TurnAfter::Continue => {}
            TurnAfter::Pass => self.visit_pots = 0,
            TurnAfter::End => {
                self.over = true;
                self.winner = verdict.winner;
                self.run_out = verdict.winner == Some(player) && self.visit_pots >= 8;
            }
        }
    }
}

/// Watches a game and shares its tally with whoever holds the other end.
#[derive(Debug, Default, Clone)]
pub struct Scorer(Arc<Mutex<Tally>>);

impl Scorer {
    /// The tally so far.
    pub fn tally(&self) -> Tally {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Participant for Scorer {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[Topic::Verdict])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        for stamped in delivered.events.iter() {
            if let Event::Verdict(verdict) = &stamped.event {
                self.0.lock().unwrap_or_else(PoisonError::into_inner).count(verdict);
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::BallId;

    #[test]
    fn eight_pots_in_one_visit_are_a_run_out() {
        let mut tally = Tally::default();
        let shot = |pocketed: &[u16], turn, winner| Verdict {
            player: Some(PlayerId::ONE),
            legal: true,
            turn,
            winner,
            pocketed: pocketed.iter().map(|id| BallId(*id)).collect(),
            ..Verdict::default()
        };
        tally.count(&shot(&[1, 2, 3, 4], TurnAfter::Continue, None));
        tally.count(&shot(&[5, 6, 7], TurnAfter::Continue, None));
        tally.count(&shot(&[8], TurnAfter::End, Some(PlayerId::ONE)));
        assert_eq!((tally.shots, tally.pots, tally.run_out), ([3, 0], [8, 0], true));

        let mut tally = Tally::default();
        tally.count(&shot(&[1, 2, 3, 4], TurnAfter::Pass, None));
        tally.count(&shot(&[5, 6, 7, 8], TurnAfter::End, Some(PlayerId::ONE)));
        assert!(!tally.run_out);
    }
}
