//! The order of a tick, as a pure state machine: the one place where it is written down.
//!
//! Tick n carries physics from (n−1) ms to n ms. The commands of its frame act at its start, its
//! facts are delivered in it, and what they cause is due in tick n+1.

use crate::event_manager::Publication;
use crate::events::{Source, Stamped, Topics};
use crate::hash::StateHash;
use crate::physics::Snapshot;
use crate::units::Tick;
use smallvec::SmallVec;
use std::sync::Arc;

/// What a participant is given at the end of a tick: the paper's mail (section 5.1).
#[derive(Debug, Clone)]
pub struct Delivered {
    /// The tick that just happened.
    pub tick: Tick,
    /// What the participant subscribed to, in stamp order.
    pub events: Arc<[Stamped]>,
    /// The visible world at the tick's end.
    pub table: Arc<Snapshot>,
}

/// What a participant answers: it publishes by answering.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outcome {
    /// What it publishes; due in the next tick or later.
    pub publish: SmallVec<[Publication; 2]>,
    /// Delayed events of its own that it takes back, by their label.
    pub cancel: SmallVec<[u32; 1]>,
    /// It wants to be called at this tick at the latest, mail or not.
    pub wake: Option<Tick>,
}

/// Whoever takes part in the game's causality: rules, computer players, input.
pub trait Participant: Send {
    /// Its name on what it publishes.
    fn source(&self) -> Source;

    /// What it wants to be told.
    fn topics(&self) -> Topics;

    /// Called once, before the first tick.
    fn start(&mut self, table: &Snapshot) -> Outcome;

    /// Takes the mail of a tick: the paper's `collectEvent`.
    fn collect(&mut self, delivered: &Delivered) -> Outcome;

    /// Adds everything that decides its future to `hash`.
    fn hash(&self, hash: &mut StateHash);
}
