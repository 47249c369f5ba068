//! A person at mouse and keyboard.

use super::{HumanView, RawInput};
use crate::events::{Source, Topics};
use crate::hash::StateHash;
use crate::ids::PlayerId;
use crate::physics::Snapshot;
use crate::table::Table;
use crate::tick::{Delivered, Inflow, Outcome, Participant};
use crate::units::Tick;
use std::sync::Arc;

/// The hand of one or two people who share mouse and keyboard.
#[derive(Debug)]
pub struct Human {
    view: HumanView,
}

impl Human {
    /// A hand that plays for `players` on `table`.
    pub fn new(_players: Vec<PlayerId>, _table: Arc<Table>) -> Self {
        Human { view: HumanView::default() }
    }

    /// What the player does in `tick`, given what the devices said since the tick before.
    pub fn inflow(&mut self, _tick: Tick, raw: &[RawInput]) -> Inflow {
        Inflow { quit: raw.contains(&RawInput::Closed), ..Inflow::default() }
    }

    /// What the picture shows of the player now.
    pub fn view(&self) -> HumanView {
        self.view.clone()
    }
}

impl Participant for Human {
    fn source(&self) -> Source {
        Source::Input
    }

    fn topics(&self) -> Topics {
        Topics::NONE
    }

    fn start(&mut self, _table: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, _delivered: &Delivered) -> Outcome {
        Outcome::default()
    }

    fn hash(&self, _hash: &mut StateHash) {}
}
