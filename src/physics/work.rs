//! What a solver did, counted: the same on every machine, unlike run time.

use crate::hash::StateHash;

/// Counters of work. All are sums since the start.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Work {
    /// Steps that were computed; steps in which everything rests are skipped and not counted.
    pub steps: u64,
    /// Contacts that were put in order of time.
    pub events: u64,
    /// Exact distances of two balls that were computed, after cells and bounding boxes.
    pub pair_tests: u64,
    /// Exact distances of a ball and a face or plane, after cells and bounding boxes.
    pub face_tests: u64,
    /// Contacts that were resolved, lasting ones not included.
    pub contacts: u64,
    /// Evaluations of the smooth forces, one per ball each.
    pub force_evaluations: u64,
    /// Flights whose way was computed; the stepper does not tell them apart.
    pub flights: u64,
    /// Looks ahead for when a spin about the normal ends; not told apart by the stepper either.
    pub spins: u64,
    /// Looks ahead for a ball that sinks into a pocket; not told apart by the stepper either.
    pub pocket_tests: u64,
}

impl core::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        for (sum, more) in self.counters_mut().into_iter().zip(other.counters()) {
            *sum += more;
        }
    }
}

impl Work {
    /// Pair and face tests.
    pub fn tests(&self) -> u64 {
        self.pair_tests + self.face_tests
    }

    fn counters(&self) -> [u64; 9] {
        let mut copy = *self;
        copy.counters_mut().map(|count| *count)
    }

    fn counters_mut(&mut self) -> [&mut u64; 9] {
        let Work {
            steps,
            events,
            pair_tests,
            face_tests,
            contacts,
            force_evaluations,
            flights,
            spins,
            pocket_tests,
        } = self;
        [
            steps,
            events,
            pair_tests,
            face_tests,
            contacts,
            force_evaluations,
            flights,
            spins,
            pocket_tests,
        ]
    }

    /// Adds all counters to `hash`.
    pub fn hash(&self, hash: &mut StateHash) {
        for count in self.counters() {
            hash.u64(count);
        }
    }
}
