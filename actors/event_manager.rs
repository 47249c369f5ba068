//! The actor of the event manager: seals a tick, delivers it, takes the answers.
//!
//! It asks its subscribers and nobody else; nobody asks it but the conductor. Participants answer
//! within the tick (all are asked at once, the answers taken in order of registration). Sinks get
//! theirs by `try_send` on a bounded channel: a sink that lags loses its own mail, which is
//! counted in [`Sink::dropped`], and delays nobody.
//!
//! `tests/bench/bus/README.md` holds what this costs beside other ways to send the same events.

use crate::participant::{Ask, Mail, Seat};
use crate::shot;
use hapticbillard::event_manager::{EventManager as Core, QueueFull};
use hapticbillard::events::{Event, Fact, Health, Source, Topics};
use hapticbillard::hash::Digest;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Frame, Sealed};
use hapticbillard::units::Tick;
use kameo::prelude::*;
use smallvec::SmallVec;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tracing::{Instrument, Span};

/// A listener outside the tick and outside the hash: window, sound.
pub struct Sink {
    /// What it is called.
    pub name: &'static str,
    /// What it wants to be told.
    pub topics: Topics,
    /// Where its mail goes.
    pub mail: flume::Sender<Delivered>,
    /// How many batches it was too slow for.
    pub dropped: Arc<AtomicU64>,
}

impl Sink {
    /// Nothing was dropped yet.
    pub fn new(name: &'static str, topics: Topics, mail: flume::Sender<Delivered>) -> Self {
        Sink { name, topics, mail, dropped: Arc::default() }
    }
}

enum Subscriber {
    Seat(Source, Ask),
    Sink(Sink),
}

/// Owns the core and knows everybody who listens.
#[derive(Actor)]
pub struct EventManager {
    core: Core,
    subscribers: Vec<Subscriber>,
    shot: Span,
}

impl EventManager {
    /// Registers participants, then sinks, and takes what the participants said at the start.
    ///
    /// # Errors
    /// [`QueueFull`] if they publish more than the queue holds.
    pub fn new(seats: Vec<Seat>, sinks: Vec<Sink>) -> Result<Self, QueueFull> {
        let mut core = Core::new();
        let mut subscribers = Vec::new();
        let mut first = Vec::new();
        for seat in seats {
            let id = core.register(seat.source, seat.topics);
            first.push((id, seat.first));
            subscribers.push(Subscriber::Seat(seat.source, seat.ask));
        }
        for sink in sinks {
            core.subscribe(sink.topics);
            subscribers.push(Subscriber::Sink(sink));
        }
        for (id, answer) in first {
            core.answer(id, Tick(0), answer.outcome, answer.digest)?;
        }
        Ok(EventManager { core, subscribers, shot: Span::none() })
    }

    /// What the clock needs to know before the first tick.
    pub fn before_first(&self) -> Sealed {
        self.core.sealed()
    }
}

/// Publish, seal and deliver a tick.
pub struct Seal {
    /// The tick.
    pub tick: Tick,
    /// What came from outside.
    pub frame: Frame,
    /// What physics saw.
    pub facts: Vec<Fact>,
    /// What the runtime says about itself. No core hears it and no hash contains it.
    pub health: Vec<Health>,
    /// The visible world at the tick's end.
    pub table: Arc<Snapshot>,
}

/// What became of it.
#[derive(Debug, Reply)]
pub struct Delivery {
    /// For the clock.
    pub sealed: Sealed,
    /// The participants' state hashes.
    pub digests: SmallVec<[(Source, Digest); 4]>,
    /// A fact was delivered, so the state is worth a hash.
    pub fact: bool,
    /// The shot that it belongs to, for the log.
    pub shot: Span,
}

/// Why a tick could not be delivered.
#[derive(Debug, thiserror::Error)]
pub enum DeliveryError {
    /// Too many events.
    #[error(transparent)]
    Full(#[from] QueueFull),
    /// A participant is gone.
    #[error("{who:?} stopped at tick {}: {reason}", tick.0)]
    Gone {
        /// Who.
        who: Source,
        /// When.
        tick: Tick,
        /// Why.
        reason: String,
    },
}

/// The answer, as data.
#[derive(Debug, Reply)]
pub struct SealAnswer(pub Result<Delivery, DeliveryError>);

impl Message<Seal> for EventManager {
    type Reply = SealAnswer;

    async fn handle(&mut self, seal: Seal, _: &mut Context<Self, SealAnswer>) -> SealAnswer {
        let shot = self.shot.clone();
        SealAnswer(self.deliver(seal).instrument(shot).await)
    }
}

impl EventManager {
    async fn deliver(&mut self, seal: Seal) -> Result<Delivery, DeliveryError> {
        let Seal { tick, frame, facts, health, table } = seal;
        for publication in frame {
            self.core.publish(Source::Input, tick, publication)?;
        }
        self.core.publish_now(Source::Physics, tick, facts.into_iter().map(Event::Fact))?;
        let health = health.into_iter().map(|health| Event::Health(Arc::new(health)));
        self.core.publish_now(Source::Runtime, tick, health)?;

        let mut fact = false;
        let mut asked: SmallVec<[_; 8]> = SmallVec::new();
        let deliveries = self.core.seal(tick);
        if shot::is_told() {
            let begun = deliveries.iter().find_map(|mail| shot::begun_by(&mail.events, tick));
            if let Some(shot) = begun {
                tracing::info!(parent: &shot, "a turn begins");
                self.shot = shot;
            }
        }
        for delivery in deliveries {
            fact |= delivery.events.iter().any(|stamped| matches!(stamped.event, Event::Fact(_)));
            let mail = Delivered { tick, events: delivery.events, table: table.clone() };
            match &self.subscribers[delivery.to.0] {
                Subscriber::Seat(who, ask) => {
                    asked.push((delivery.to, *who, ask(Mail(mail, self.shot.clone()))));
                }
                Subscriber::Sink(sink) => {
                    if let Err(flume::TrySendError::Full(_)) = sink.mail.try_send(mail)
                        && sink.dropped.fetch_add(1, Ordering::Relaxed) == 0
                    {
                        tracing::warn!(
                            "{} is too slow and loses mail from tick {} on",
                            sink.name,
                            tick.0
                        );
                    }
                }
            }
        }
        // All were asked; who was asked last answers among the last, so that waiting for it first
        // wakes this actor about once a tick and not once an answer.
        let mut answers: SmallVec<[_; 8]> = SmallVec::new();
        for (id, who, asked) in asked.into_iter().rev() {
            answers.push((id, asked.answer().await.map_err(|error| gone(who, tick, error))?));
        }
        // They are taken in order of registration, whoever was first.
        for (id, answer) in answers.into_iter().rev() {
            self.core.answer(id, tick, answer.outcome, answer.digest)?;
        }
        let (sealed, digests) = (self.core.sealed(), self.core.digests());
        Ok(Delivery { sealed, digests, fact, shot: self.shot.clone() })
    }
}

fn gone(who: Source, tick: Tick, error: impl std::fmt::Display) -> DeliveryError {
    DeliveryError::Gone { who, tick, reason: error.to_string() }
}
