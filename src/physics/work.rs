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
}

impl core::ops::AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        let Work { steps, events, pair_tests, face_tests, contacts, force_evaluations } = other;
        self.steps += steps;
        self.events += events;
        self.pair_tests += pair_tests;
        self.face_tests += face_tests;
        self.contacts += contacts;
        self.force_evaluations += force_evaluations;
    }
}

impl Work {
    /// Pair and face tests.
    pub fn tests(&self) -> u64 {
        self.pair_tests + self.face_tests
    }

    /// Adds all counters to `hash`.
    pub fn hash(&self, hash: &mut StateHash) {
        for count in [
            self.steps,
            self.events,
            self.pair_tests,
            self.face_tests,
            self.contacts,
            self.force_evaluations,
        ] {
            hash.u64(count);
        }
    }
}
