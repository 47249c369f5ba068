//! The actors of the input manager: a hand, or something else in its place.
//!
//! Both answer [`FrameOf`]: everything that enters a game from outside enters here. Beside them
//! stands the driver of gamepads, whose reports go to a window as those of its mouse do.

#[cfg(feature = "gamepad")]
mod gamepads;

mod pad;
pub use pad::{PadDriver, PadError, PadSource};

use crate::haptic::{FeltMouse, Stylus, frame_of};
use crate::kept::{Kept, Saved, Shared};
use crate::participant::{Answer, Mail, collect};
use hapticbillard::events::{Command, Event, Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::input::{
    HandInput, Human, HumanView, Led, LedHuman, MouseSplit, Reader, StylusWord,
};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, FrameSource, Inflow, Outcome, Participant};
use hapticbillard::units::Tick;
use kameo::prelude::*;
use std::pin::Pin;
use std::sync::Arc;

/// The gamepads of this machine; none where the program was built without them.
pub fn gamepads() -> Option<PadDriver> {
    #[cfg(feature = "gamepad")]
    match PadDriver::start(gamepads::Gamepads::open) {
        Ok(driver) => return Some(driver),
        Err(error) => tracing::warn!("{error}"),
    }
    None
}

/// What enters in this tick? The conductor asks it before every tick that has a frame.
pub struct FrameOf(pub Tick);

/// The answer.
#[derive(Debug, Reply)]
pub struct Entered(pub Inflow);

/// Somebody who acts from outside and hears what happens.
pub trait Hand: FrameSource + Participant {}

impl<H: FrameSource + Participant> Hand for H {}

/// The actor of a hand, which outlives it.
#[derive(Actor)]
pub struct Input(pub Shared<Box<dyn Hand>>);

impl Message<FrameOf> for Input {
    type Reply = Entered;

    async fn handle(&mut self, message: FrameOf, _: &mut Context<Self, Entered>) -> Entered {
        Entered(told(self.0.borrow().inflow(message.0), message.0))
    }
}

impl Message<Mail> for Input {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        collect(&mut **self.0.borrow(), &mail)
    }
}

/// The same, and the log has what enters.
fn told(inflow: Inflow, tick: Tick) -> Inflow {
    for publication in &inflow.frame {
        match &publication.event {
            // A hand says so in every tick.
            Event::Command(Command::MoveCue(_)) => {
                tracing::trace!(tick = tick.0, "{:?}", publication.event);
            }
            event => tracing::debug!(tick = tick.0, "{event:?}"),
        }
    }
    inflow
}

/// Somebody who acts from outside and hears nothing: a recording, a script.
#[derive(Actor)]
pub struct StandIn(pub Shared<Box<dyn FrameSource>>);

impl Message<FrameOf> for StandIn {
    type Reply = Entered;

    async fn handle(&mut self, message: FrameOf, _: &mut Context<Self, Entered>) -> Entered {
        Entered(told(self.0.borrow().inflow(message.0), message.0))
    }
}

/// Asks for a tick's frame; an error says why there is nobody any more.
pub type AskFrame = Box<dyn Fn(Tick) -> Awaited + Send + Sync>;

/// A frame to come.
pub type Awaited = Pin<Box<dyn Future<Output = Result<Inflow, String>> + Send>>;

/// The door to whoever is in this place. What devices said to one who died is lost with it.
pub fn frame_door<A: Message<FrameOf, Reply = Entered>>(kept: Arc<Kept<A>>) -> AskFrame {
    Box::new(move |tick| {
        let kept = kept.clone();
        Box::pin(async move {
            let actor = kept.actor();
            let reason = match actor.ask(FrameOf(tick)).await {
                Ok(entered) => return Ok(entered.0),
                Err(error) => error.to_string(),
            };
            let Some(other) = kept.instead_of(&actor, &reason) else { return Err(reason) };
            let entered = other.ask(FrameOf(tick)).await;
            entered.map(|entered| entered.0).map_err(|error| error.to_string())
        })
    })
}

/// A hand at the mouse and keyboard of a window, and at a stylus where there is one.
pub struct WindowHand {
    core: Saved<Human>,
    /// What devices say. The window bounds the channel; when it is full it keeps movements, which
    /// add up, and waits with buttons.
    raw: flume::Receiver<HandInput>,
    /// What the hand sees and does, for the picture: only the newest counts.
    view: triple_buffer::Input<HumanView>,
    buffer: Vec<HandInput>,
    stylus: Option<Stylus>,
    /// The hand at the haptic device that the mouse moves, and what of the mouse is for it.
    felt: Option<(FeltMouse, MouseSplit)>,
}

impl WindowHand {
    /// Joins the core with its window.
    pub fn new(
        core: Human,
        raw: flume::Receiver<HandInput>,
        view: triple_buffer::Input<HumanView>,
    ) -> Self {
        let core = Saved::new(core);
        WindowHand { core, raw, view, buffer: Vec::new(), stylus: None, felt: None }
    }

    /// The same with a stylus, and the way of the mouse into its hand, if one leads there.
    #[must_use]
    pub fn with_stylus(mut self, stylus: Stylus, felt: Option<FeltMouse>) -> Self {
        let core = self.core.get().clone().with_stylus();
        let core = if felt.is_some() { core.whose_mouse_is_the_stylus() } else { core };
        self.core = Saved::new(core);
        self.stylus = Some(stylus);
        self.felt = felt.map(|felt| (felt, MouseSplit::default()));
        self
    }

    /// What the stylus says in this tick.
    fn word(&mut self, tick: Tick) -> Option<StylusWord> {
        let is_paused = self.core.get().is_paused();
        let stylus = self.stylus.as_mut()?;
        if is_paused { stylus.rest() } else { stylus.word(tick) }
    }
}

impl FrameSource for WindowHand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.buffer.clear();
        self.buffer.extend(self.raw.try_iter());
        if let Some((felt, split)) = &mut self.felt {
            let mode = self.core.get().view().mode;
            let is_for_it = |report: &&HandInput| split.reader_in(mode, report) != Reader::Eye;
            self.buffer.iter().filter(is_for_it).for_each(|report| felt.hear(report));
        }
        let word = self.word(tick);
        let buffer = &self.buffer;
        let (inflow, turn) = self.core.work(|core| {
            let inflow = core.inflow_beside(tick, buffer, word.as_ref());
            (inflow, core.take_turn())
        });
        if let Some(stylus) = &self.stylus {
            stylus.turn(turn);
            stylus.lead(self.core.get().stylus_leads_what());
        }
        self.view.write(self.core.get().view());
        inflow
    }
}

/// A hand at a haptic device, in a window whose mouse may move it.
pub struct LedHand {
    core: Saved<LedHuman>,
    raw: flume::Receiver<HandInput>,
    view: triple_buffer::Input<HumanView>,
    /// The hand that the mouse moves.
    mouse: Option<FeltMouse>,
    /// What strikes, where there is a cue.
    stylus: Option<Stylus>,
    buffer: Vec<HandInput>,
}

impl LedHand {
    /// Joins the core with its window and its device.
    pub fn new(
        core: LedHuman,
        raw: flume::Receiver<HandInput>,
        view: triple_buffer::Input<HumanView>,
        mouse: Option<FeltMouse>,
        stylus: Option<Stylus>,
    ) -> Self {
        LedHand { core: Saved::new(core), raw, view, mouse, stylus, buffer: Vec::new() }
    }
}

impl FrameSource for LedHand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.buffer.clear();
        self.buffer.extend(self.raw.try_iter());
        let buffer = &self.buffer;
        let (led, hand) = self.core.work(|core| {
            let mut hand = Vec::new();
            (core.inflow(tick, buffer, &mut hand), hand)
        });
        let Led { mut inflow, strikes, begins } = led;
        self.view.write(self.core.get().view());
        if let Some(mouse) = &mut self.mouse {
            hand.iter().for_each(|report| mouse.hear(report));
            if begins {
                mouse.go_home();
            }
        }
        if let Some(stylus) = &mut self.stylus {
            if inflow.paused {
                stylus.rest();
            } else {
                // The samples flow in the turns of others too, so that none of them is old.
                let word = stylus.word(tick);
                if let Some(hand) = word.as_ref().and_then(StylusWord::camera) {
                    self.core.work(|core| core.fly(hand));
                }
                inflow.frame.extend(frame_of(word.as_ref()).into_iter().filter(|_| strikes));
            }
            stylus.lead(self.core.get().stylus_leads_what());
        }
        inflow
    }
}

/// Takes part in the game as its saved core does.
macro_rules! takes_part_by_its_core {
    ($hand:ty) => {
        impl Participant for $hand {
            fn source(&self) -> Source {
                self.core.get().source()
            }

            fn topics(&self) -> Topics {
                self.core.get().topics()
            }

            fn start(&mut self, table: &Snapshot) -> Outcome {
                self.core.work(|core| core.start(table))
            }

            fn collect(&mut self, delivered: &Delivered) -> Outcome {
                self.core.work(|core| core.collect(delivered))
            }

            fn hash(&self, hash: &mut StateHash) {
                self.core.get().hash(hash);
            }
        }
    };
}

takes_part_by_its_core!(WindowHand);
takes_part_by_its_core!(LedHand);
