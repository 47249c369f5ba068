//! Somebody who hears every event of a game and keeps a hash of each.

use hapticbillard::events::{Event, Source, Topics};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use std::sync::{Arc, Mutex, PoisonError};

/// What was heard.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Seen {
    /// A hash of each event, with its stamp, in order. What the runtime says of itself is none.
    pub events: Vec<Digest>,
    /// The tick of each.
    pub ticks: Vec<Tick>,
    /// How often mail came.
    pub batches: u64,
}

/// The witness; its copies share what was heard.
#[derive(Debug, Clone, Default)]
pub struct Witness(Arc<Mutex<Seen>>);

impl Witness {
    /// What was heard so far.
    pub fn seen(&self) -> Seen {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Participant for Witness {
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
        let mut seen = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        seen.batches += 1;
        for stamped in delivered.events.iter() {
            if matches!(stamped.event, Event::Health(_)) {
                continue;
            }
            let mut hash = StateHash::new();
            // Plain data with string keys: serialising it cannot fail.
            hash.bytes(&serde_json::to_vec(stamped).unwrap_or_default());
            seen.events.push(hash.finish());
            seen.ticks.push(delivered.tick);
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}
