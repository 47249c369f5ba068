//! Somebody who watches a game from inside the tick and strikes when it is time.

use super::{FaultKind, Planned};
use crate::crew::Roster;
use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// A fault that struck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Struck {
    /// When.
    pub tick: Tick,
    /// What had been planned.
    pub planned: Planned,
    /// How many it struck: none if the victim was not there, or too busy for a message.
    pub victims: usize,
}

/// Does what was planned.
pub struct Saboteur {
    planned: VecDeque<Planned>,
    batches: u64,
    roster: Roster,
    struck: Arc<Mutex<Vec<Struck>>>,
}

impl Saboteur {
    /// A saboteur, and where it notes what it did.
    pub fn new(planned: &[Planned], roster: Roster) -> (Self, Arc<Mutex<Vec<Struck>>>) {
        let struck = Arc::new(Mutex::new(Vec::new()));
        let planned = planned.iter().copied().collect();
        (Saboteur { planned, batches: 0, roster, struck: struck.clone() }, struck)
    }
}

impl Participant for Saboteur {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        while let Some(&planned) = self.planned.front()
            && planned.batch <= self.batches
        {
            self.planned.pop_front();
            let victims = self.roster.strike(planned.victim.name(), planned.fault);
            let struck = Struck { tick: delivered.tick, planned, victims };
            tracing::debug!("{:?} to {}", FaultKind::of(planned.fault), planned.victim.name());
            self.struck.lock().unwrap_or_else(PoisonError::into_inner).push(struck);
        }
        self.batches += 1;
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}
