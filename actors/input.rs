//! The actors of the input manager: a hand, or something else in its place.
//!
//! Both answer [`FrameOf`]: everything that enters a game from outside enters here.

use crate::haptic::{FeltMouse, Stylus};
use crate::participant::{Answer, Mail, collect};
use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::input::{Human, HumanView, RawInput, StylusWord};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, FrameSource, Inflow, Outcome, Participant};
use hapticbillard::units::Tick;
use kameo::prelude::*;

/// What enters in this tick? The conductor asks it before every tick that has a frame.
pub struct FrameOf(pub Tick);

/// The answer.
#[derive(Debug, Reply)]
pub struct Entered(pub Inflow);

/// Somebody who acts from outside and hears what happens.
pub trait Hand: FrameSource + Participant {}

impl<H: FrameSource + Participant> Hand for H {}

/// The actor of a hand.
#[derive(Actor)]
pub struct Input(pub Box<dyn Hand>);

impl Message<FrameOf> for Input {
    type Reply = Entered;

    async fn handle(&mut self, message: FrameOf, _: &mut Context<Self, Entered>) -> Entered {
        Entered(self.0.inflow(message.0))
    }
}

impl Message<Mail> for Input {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        collect(&mut *self.0, &mail)
    }
}

/// Somebody who acts from outside and hears nothing: a recording, a script.
#[derive(Actor)]
pub struct StandIn(pub Box<dyn FrameSource>);

impl Message<FrameOf> for StandIn {
    type Reply = Entered;

    async fn handle(&mut self, message: FrameOf, _: &mut Context<Self, Entered>) -> Entered {
        Entered(self.0.inflow(message.0))
    }
}

/// A hand at the mouse and keyboard of a window, and at a stylus where there is one.
pub struct WindowHand {
    core: Human,
    /// What devices say. The window bounds the channel; when it is full it keeps movements, which
    /// add up, and waits with buttons.
    raw: flume::Receiver<RawInput>,
    /// What the hand sees and does, for the picture: only the newest counts.
    view: triple_buffer::Input<HumanView>,
    buffer: Vec<RawInput>,
    stylus: Option<Stylus>,
    /// The hand at the haptic device that the mouse moves.
    felt: Option<FeltMouse>,
}

impl WindowHand {
    /// Joins the core with its window.
    pub fn new(
        core: Human,
        raw: flume::Receiver<RawInput>,
        view: triple_buffer::Input<HumanView>,
    ) -> Self {
        WindowHand { core, raw, view, buffer: Vec::new(), stylus: None, felt: None }
    }

    /// The same with a stylus, and the way of the mouse into its hand, if one leads there.
    #[must_use]
    pub fn with_stylus(mut self, stylus: Stylus, felt: Option<FeltMouse>) -> Self {
        self.core = self.core.with_stylus();
        if felt.is_some() {
            self.core = self.core.whose_mouse_is_the_stylus();
        }
        (self.stylus, self.felt) = (Some(stylus), felt);
        self
    }

    /// What the stylus says in this tick.
    fn word(&mut self, tick: Tick) -> Option<StylusWord> {
        let is_paused = self.core.is_paused();
        let stylus = self.stylus.as_mut()?;
        if is_paused { stylus.rest() } else { stylus.word(tick) }
    }
}

impl FrameSource for WindowHand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.buffer.clear();
        self.buffer.extend(self.raw.try_iter());
        if let Some(felt) = &mut self.felt {
            self.buffer.iter().for_each(|report| felt.hear(report));
        }
        let word = self.word(tick);
        let inflow = self.core.inflow_beside(tick, &self.buffer, word.as_ref());
        let turn = self.core.take_turn();
        if let Some(stylus) = &self.stylus {
            stylus.turn(turn);
        }
        self.view.write(self.core.view());
        inflow
    }
}

impl Participant for WindowHand {
    fn source(&self) -> Source {
        self.core.source()
    }

    fn topics(&self) -> Topics {
        self.core.topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.core.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        self.core.collect(delivered)
    }

    fn hash(&self, hash: &mut StateHash) {
        self.core.hash(hash);
    }
}
