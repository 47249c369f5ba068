//! The order of a tick, as a pure state machine: the one place where it is written down.
//!
//! Tick n carries physics from (n−1) ms to n ms. The commands of its frame act at its start, its
//! facts are delivered in it, and what they cause is due in tick n+1.
//!
//! ```text
//! frame(n) ──► physics: commands at (n−1) ms, advance to n ms ──► seal ──► deliver ──► answers
//!     ▲                                                                        due in n+1 │
//!     └──────────────────── next tick, or a jump to the next one that matters ◄───────────┘
//! ```
//!
//! Whoever drives the machine (lockstep inline, the conductor by messages) does what
//! [`Clock::next`] says and reports back. A jump leaves out ticks in which nobody is called; it
//! changes no bit, because physics may be cut anywhere.

mod world;

pub use world::{Advanced, advance, coast};

use crate::event_manager::Publication;
use crate::events::{Command, Event, Fact, FactSet, Source, Stamped, Topics};
use crate::hash::StateHash;
use crate::physics::Snapshot;
use crate::replay::TickHash;
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
    pub publish: Vec<Publication>,
    /// Delayed events of its own that it takes back, by their label.
    pub cancel: SmallVec<[u32; 1]>,
    /// It wants to be called at this tick at the latest, mail or not. Every answer replaces the
    /// wish of the one before.
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

impl<P: Participant + ?Sized> Participant for Box<P> {
    fn source(&self) -> Source {
        (**self).source()
    }

    fn topics(&self) -> Topics {
        (**self).topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        (**self).start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        (**self).collect(delivered)
    }

    fn hash(&self, hash: &mut StateHash) {
        (**self).hash(hash);
    }
}

/// What enters from outside in one tick.
pub type Frame = SmallVec<[Publication; 2]>;

/// What the outside says about one tick.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Inflow {
    /// What enters.
    pub frame: Frame,
    /// The next tick for which the outside has something to say or to check, if it knows.
    pub next: Option<Tick>,
    /// Whether time stands still; not part of the game.
    pub paused: bool,
    /// Whether whoever acts would rather not wait: a paced game may run faster. Not part of the
    /// game either.
    pub hurried: bool,
    /// Somebody quit: the game ends before this tick.
    pub quit: bool,
}

/// Where frames come from: a recording, a script, a hand.
pub trait FrameSource: Send {
    /// What enters in `tick`. Asked for rising ticks, and once for tick 0, before the game.
    fn inflow(&mut self, tick: Tick) -> Inflow;
}

/// What is to be done next.
#[derive(Debug, Clone, PartialEq)]
pub enum Next {
    /// Get the input frame of this tick; answer with [`Clock::framed`].
    Frame(Tick),
    /// Let physics run to the end of `limit` or of the first tick with a fact in `stop`; answer
    /// with [`Clock::coasted`].
    Coast {
        /// The last tick that may be reached.
        limit: Tick,
        /// What to stop at.
        stop: FactSet,
    },
    /// Apply the commands at the start of `tick`, then advance to its end; answer with
    /// [`Clock::advanced`].
    Advance {
        /// The tick.
        tick: Tick,
        /// In stamp order.
        commands: SmallVec<[Command; 2]>,
    },
    /// Publish frame and facts, seal, deliver, take the answers; answer with [`Clock::sealed`].
    Seal {
        /// The tick.
        tick: Tick,
        /// What came from outside.
        frame: Frame,
        /// What physics saw.
        facts: Vec<Fact>,
    },
    /// The game stands still until [`Clock::resume`]: input is still asked for, time does not run.
    Paused,
    /// Nothing will ever happen again, or somebody quit.
    Finished(End),
}

/// Why a game ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// The rules ended it.
    Over,
    /// Somebody quit.
    Quit,
    /// Nobody waits for anything any more.
    Idle,
    /// The limit of simulated time was reached.
    Limit,
}

/// How a game ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Finished {
    /// Why.
    pub end: End,
    /// The last tick.
    pub tick: Tick,
    /// The state after the last tick in which anybody was called.
    pub hash: Option<TickHash>,
    /// How many hashes were checked against a recording.
    pub verified: u64,
}

/// What the event manager says after a tick.
#[derive(Debug, Clone, Default)]
pub struct Sealed {
    /// The next tick in which something is due.
    pub next_due: Option<Tick>,
    /// Commands due in that tick, in stamp order.
    pub commands: SmallVec<[Command; 2]>,
    /// What somebody wants to hear from physics.
    pub interest: Topics,
    /// The rules ended the game in this tick.
    pub over: bool,
}

#[derive(Debug)]
enum Stage {
    Between,
    Framing,
    Coasting { limit: Tick, called: bool },
    Advancing { tick: Tick, frame: Frame },
    Sealing { tick: Tick },
    Ended(End),
}

/// The state machine.
#[derive(Debug)]
pub struct Clock {
    /// The last tick that is done.
    done: Tick,
    /// How far physics is; ahead of `done` after a coast that met nothing.
    physics: Tick,
    stage: Stage,
    pace: Pace,
    limit: Tick,
    paused: bool,
    after: Sealed,
}

/// Whether ticks may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pace {
    /// Every tick: a hand may act at any time.
    EveryTick,
    /// Only ticks in which somebody is called.
    Jump,
}

impl Clock {
    /// A clock at tick 0. `after` says what the participants wish for at the start; `limit` is the
    /// last tick of all.
    pub fn new(pace: Pace, limit: Tick, after: Sealed) -> Self {
        Clock {
            done: Tick(0),
            physics: Tick(0),
            stage: Stage::Between,
            pace,
            limit,
            paused: false,
            after,
        }
    }

    /// The last tick that is done.
    pub fn now(&self) -> Tick {
        self.done
    }

    /// What to do next. `next_frame` is the next tick for which the outside has something to say
    /// or to check, as far as that is known.
    pub fn next(&mut self, next_frame: Option<Tick>) -> Next {
        if let Stage::Ended(end) = self.stage {
            return Next::Finished(end);
        }
        if self.paused {
            return Next::Paused;
        }
        debug_assert!(matches!(self.stage, Stage::Between), "the last step was not answered");
        if self.done >= self.limit {
            return self.finish(End::Limit);
        }
        let soon = self.done.after(1);
        if self.pace == Pace::EveryTick {
            self.stage = Stage::Framing;
            return Next::Frame(soon);
        }
        // Both are reasons to call somebody; without one, only physics can bring news.
        let called = [self.after.next_due, next_frame].into_iter().flatten().min();
        let tick = called.unwrap_or(self.limit).clamp(soon, self.limit);
        let coast = Tick(tick.0 - 1);
        if self.physics < coast {
            self.stage = Stage::Coasting { limit: coast, called: called.is_some() };
            return Next::Coast { limit: coast, stop: self.after.interest.and(FactSet::FACTS) };
        }
        self.stage = Stage::Framing;
        Next::Frame(tick)
    }

    /// Physics coasted to the end of `reached` and saw `facts`. Returns what to do with them: to
    /// seal that tick, or nothing if there was no fact to stop at.
    pub fn coasted(&mut self, reached: Tick, facts: Vec<Fact>) -> Option<Next> {
        let Stage::Coasting { limit, called } = self.stage else {
            return None;
        };
        debug_assert!(reached <= limit);
        self.physics = reached;
        let news = facts.iter().any(|fact| self.after.interest.contains(fact.kind.topic()));
        if !news {
            // Nobody waits for anything and physics has no news: it would be so for ever.
            self.stage = if called { Stage::Between } else { Stage::Ended(End::Idle) };
            return None;
        }
        self.stage = Stage::Sealing { tick: reached };
        Some(Next::Seal { tick: reached, frame: Frame::new(), facts })
    }

    /// The frame of `tick` is here (and written down).
    pub fn framed(&mut self, tick: Tick, frame: Frame) -> Next {
        let mut commands: SmallVec<[Command; 2]> = frame
            .iter()
            .filter(|publication| publication.delay_ticks == 0)
            .filter_map(|publication| match &publication.event {
                Event::Command(command) => Some(command.clone()),
                _ => None,
            })
            .collect();
        // Input comes first in stamp order.
        if self.after.next_due.is_some_and(|due| due <= tick) {
            commands.append(&mut self.after.commands);
        }
        self.stage = Stage::Advancing { tick, frame };
        Next::Advance { tick, commands }
    }

    /// Physics is at the end of the tick.
    pub fn advanced(&mut self, facts: Vec<Fact>) -> Option<Next> {
        let Stage::Advancing { tick, frame } = std::mem::replace(&mut self.stage, Stage::Between)
        else {
            return None;
        };
        self.physics = tick;
        self.stage = Stage::Sealing { tick };
        Some(Next::Seal { tick, frame, facts })
    }

    /// The tick is delivered and answered.
    pub fn sealed(&mut self, sealed: Sealed) {
        if let Stage::Sealing { tick } = self.stage {
            self.done = tick;
            self.stage = if sealed.over { Stage::Ended(End::Over) } else { Stage::Between };
            self.after = sealed;
        }
    }

    /// Time stands still from the next tick on. A pause is not part of the game: it is recorded as
    /// an event for whoever shows it, and a replay runs through it.
    pub fn pause(&mut self) {
        self.paused = true;
    }

    /// Time runs again after a pause.
    pub fn resume(&mut self) {
        self.paused = false;
    }

    /// Ends the game from outside.
    pub fn quit(&mut self) {
        self.stage = Stage::Ended(End::Quit);
    }

    fn finish(&mut self, end: End) -> Next {
        self.stage = Stage::Ended(end);
        Next::Finished(end)
    }
}
