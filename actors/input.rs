//! The actors of the input manager: a hand, or something else in its place.
//!
//! Both answer [`FrameOf`]: everything that enters a game from outside enters here.

use crate::haptic::{FeltMouse, Stylus};
use crate::participant::{Answer, Mail, collect};
use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::input::{Human, HumanView, Led, LedHuman, RawInput};
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

/// A hand at the mouse and keyboard of a window.
pub struct WindowHand {
    core: Human,
    /// What devices say. The window bounds the channel; when it is full it keeps movements, which
    /// add up, and waits with buttons.
    raw: flume::Receiver<RawInput>,
    /// What the hand sees and does, for the picture: only the newest counts.
    view: triple_buffer::Input<HumanView>,
    buffer: Vec<RawInput>,
}

impl WindowHand {
    /// Joins the core with its window.
    pub fn new(
        core: Human,
        raw: flume::Receiver<RawInput>,
        view: triple_buffer::Input<HumanView>,
    ) -> Self {
        WindowHand { core, raw, view, buffer: Vec::new() }
    }
}

impl FrameSource for WindowHand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.buffer.clear();
        self.buffer.extend(self.raw.try_iter());
        let inflow = self.core.inflow(tick, &self.buffer);
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

/// A hand at a haptic device, in a window whose mouse may move it.
pub struct LedHand {
    core: LedHuman,
    raw: flume::Receiver<RawInput>,
    view: triple_buffer::Input<HumanView>,
    /// The hand that the mouse moves.
    mouse: Option<FeltMouse>,
    /// What strikes, where there is a cue.
    stylus: Option<Stylus>,
    buffer: Vec<RawInput>,
    hand: Vec<RawInput>,
}

impl LedHand {
    /// Joins the core with its window and its device.
    pub fn new(
        core: LedHuman,
        raw: flume::Receiver<RawInput>,
        view: triple_buffer::Input<HumanView>,
        mouse: Option<FeltMouse>,
        stylus: Option<Stylus>,
    ) -> Self {
        LedHand { core, raw, view, mouse, stylus, buffer: Vec::new(), hand: Vec::new() }
    }
}

impl FrameSource for LedHand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.buffer.clear();
        self.hand.clear();
        self.buffer.extend(self.raw.try_iter());
        let Led { mut inflow, strikes, begins } =
            self.core.inflow(tick, &self.buffer, &mut self.hand);
        self.view.write(self.core.view());
        if let Some(mouse) = &mut self.mouse {
            self.hand.iter().for_each(|report| mouse.hear(report));
            if begins {
                mouse.go_home();
            }
        }
        // The samples flow in the turns of others too, so that none of them is old.
        let moved = self.stylus.as_mut().map(|stylus| stylus.frame(tick));
        inflow.frame.extend(moved.filter(|_| strikes).into_iter().flatten());
        inflow
    }
}

impl Participant for LedHand {
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
