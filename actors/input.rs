//! The actors of the input manager: a hand, or a recording in its place.
//!
//! Both answer [`FrameOf`]: everything that enters a game from outside enters here.

use crate::participant::{Answer, Mail, collect};
use hapticbillard::input::{Human, HumanView, RawInput};
use hapticbillard::tick::{FrameSource, Inflow};
use hapticbillard::units::Tick;
use kameo::prelude::*;

/// What enters in this tick? The conductor asks it before every tick that has a frame.
pub struct FrameOf(pub Tick);

/// The answer.
#[derive(Debug, Reply)]
pub struct Entered(pub Inflow);

/// A hand at mouse and keyboard.
#[derive(Actor)]
pub struct Input {
    core: Human,
    /// Raw input from the window, bounded there: when it is full the window drops movements, which
    /// it coalesces anyway, and waits with buttons.
    raw: flume::Receiver<RawInput>,
    /// What the hand sees and does, for the picture.
    view: triple_buffer::Input<HumanView>,
    buffer: Vec<RawInput>,
}

impl Input {
    /// Joins the core with its window.
    pub fn new(
        core: Human,
        raw: flume::Receiver<RawInput>,
        view: triple_buffer::Input<HumanView>,
    ) -> Self {
        Input { core, raw, view, buffer: Vec::new() }
    }
}

impl Message<FrameOf> for Input {
    type Reply = Entered;

    async fn handle(&mut self, message: FrameOf, _: &mut Context<Self, Entered>) -> Entered {
        self.buffer.clear();
        self.buffer.extend(self.raw.try_iter());
        let inflow = self.core.inflow(message.0, &self.buffer);
        self.view.write(self.core.view());
        Entered(inflow)
    }
}

impl Message<Mail> for Input {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        collect(&mut self.core, &mail)
    }
}

/// Somebody else in its place: a recording, a script.
#[derive(Actor)]
pub struct StandIn(pub Box<dyn FrameSource>);

impl Message<FrameOf> for StandIn {
    type Reply = Entered;

    async fn handle(&mut self, message: FrameOf, _: &mut Context<Self, Entered>) -> Entered {
        Entered(self.0.inflow(message.0))
    }
}
