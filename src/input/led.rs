//! A person who leads the cue with the stylus of a haptic device, and a mouse beside it.
//!
//! Turns and the ball in hand are those of a [`Human`]; the cue is the stylus'. Where a mouse moves
//! the hand at the device, it puts the cue ball down before it does.

use super::{Action, CameraHand, HandInput, Human, HumanMode, HumanView, MouseSplit, Reader};
use crate::events::{Command, Event, Source, Topics};
use crate::haptic::Leads;
use crate::hash::StateHash;
use crate::physics::Snapshot;
use crate::tick::{Delivered, Inflow, Outcome, Participant};
use crate::units::Tick;
use std::sync::Arc;

/// The person.
#[derive(Debug, Clone)]
pub struct LedHuman {
    human: Human,
    /// There are turns to wait for.
    plays: bool,
    split: MouseSplit,
    seen: Arc<Snapshot>,
    /// A turn was called, and no ball was there to be struck since.
    is_called: bool,
}

/// What a tick's reports are to whom.
#[derive(Debug, Clone, PartialEq)]
pub struct Led {
    /// What enters the game without the cue.
    pub inflow: Inflow,
    /// The cue may be moved: this person is at the table, or there are no turns.
    pub strikes: bool,
    /// A ball is there to be struck from now on.
    pub begins: bool,
}

impl LedHuman {
    /// Somebody who plays for others' turns to wait for, or alone with the device if `human` plays
    /// for nobody.
    pub fn new(human: Human) -> Self {
        let plays = human.plays();
        LedHuman {
            human,
            plays,
            split: MouseSplit::default(),
            seen: Arc::default(),
            is_called: false,
        }
    }

    /// Takes the reports since the last tick; adds to `hand` what is for the hand at the device.
    pub fn inflow(&mut self, tick: Tick, heard: &[HandInput], hand: &mut Vec<HandInput>) -> Led {
        let mode = self.human.view().mode;
        let mut own = Vec::new();
        for report in heard {
            let reader = self.split.reader_in(mode, report);
            if reader != Reader::Hand {
                own.push(*report);
            }
            if reader != Reader::Eye {
                hand.push(*report);
            }
        }
        let mut inflow = self.human.inflow(tick, &own);
        inflow
            .frame
            .retain(|entered| !matches!(entered.event, Event::Command(Command::MoveCue(_))));
        inflow.hurried |= self.split.holds(Action::Hurry) && self.seen.is_rolling();

        let is_at_ball = self.human.view().mode == HumanMode::Aiming;
        let begins = is_at_ball && std::mem::take(&mut self.is_called);
        Led { inflow, strikes: is_at_ball || !self.plays, begins }
    }

    /// What the stylus is for now.
    pub fn stylus_leads_what(&self) -> Leads {
        self.human.stylus_leads_what()
    }

    /// One tick in which the stylus leads the camera.
    pub fn fly(&mut self, hand: &CameraHand) {
        self.human.fly_by(hand);
    }

    /// What the picture shows of the person.
    pub fn view(&self) -> HumanView {
        self.human.view()
    }
}

impl Participant for LedHuman {
    fn source(&self) -> Source {
        self.human.source()
    }

    fn topics(&self) -> Topics {
        self.human.topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.human.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        self.seen = delivered.table.clone();
        let is_call = |event: &Event| matches!(event, Event::Turn(_));
        self.is_called |= delivered.events.iter().any(|stamped| is_call(&stamped.event));
        self.human.collect(delivered)
    }

    fn hash(&self, hash: &mut StateHash) {
        self.human.hash(hash);
    }
}
