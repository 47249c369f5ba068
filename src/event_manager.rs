//! The event manager: order of delayed delivery, topics, interest (paper, section 5.1).
//!
//! Events are collected during a tick and delivered at its end, one batch a subscriber, sorted by
//! `(due tick, source, source sequence)`: never by arrival. Delays are counted in ticks. Nothing
//! here sleeps, and nothing is delivered twice.
//!
//! The one queue is bounded by [`LIMIT`]: an event that finds it full is refused and counted, and
//! the publisher's tick ends with an error, because a lost event would be a wrong game.

use crate::events::{Command, Event, Source, Stamp, Stamped, Topics, TurnAfter};
use crate::hash::Digest;
use crate::tick::{Outcome, Sealed};
use crate::units::Tick;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How many events may wait at one time. A break of a thousand balls makes 351 in its busiest tick.
pub const LIMIT: usize = 1 << 16;

/// An event on its way to the event manager.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Publication {
    /// What.
    pub event: Event,
    /// How many ticks later than the next one it is due.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub delay_ticks: u64,
    /// A label by which its publisher can take it back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<u32>,
}

fn is_zero(ticks: &u64) -> bool {
    *ticks == 0
}

impl From<Event> for Publication {
    fn from(event: Event) -> Self {
        Publication { event, delay_ticks: 0, label: None }
    }
}

/// A subscriber's number: its place in the order of registration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubscriberId(pub usize);

/// Too many events wait.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the event queue is full at tick {}: {LIMIT} events wait; \
     a participant publishes faster than the game consumes",
    tick.0
)]
pub struct QueueFull {
    /// When.
    pub tick: Tick,
}

struct Subscriber {
    topics: Topics,
    /// The subscriber asked to be called at this tick, mail or not.
    wake: Option<Tick>,
    /// Participants are part of the tick and of its hash; sinks only listen.
    source: Option<Source>,
    digest: Option<Digest>,
}

/// What one subscriber gets at the end of a tick.
#[derive(Debug, Clone)]
pub struct Delivery {
    /// Who.
    pub to: SubscriberId,
    /// Its events, in stamp order; may be empty for a participant that asked to be woken.
    pub events: Arc<[Stamped]>,
}

/// The event manager's core.
///
/// ```
/// use hapticbillard::event_manager::{EventManager, Publication};
/// use hapticbillard::events::{Command, Event, Source, Topic, Topics};
/// use hapticbillard::units::Tick;
///
/// let mut events = EventManager::new();
/// let listener = events.subscribe(Topics::of(&[Topic::Command]));
/// let lift = Event::Command(Command::LiftCue);
/// let later = Publication { event: lift, delay_ticks: 5, label: None };
/// events.publish(Source::Input, Tick(1), later)?;
///
/// assert!(events.seal(Tick(5)).is_empty());
/// let mail = events.seal(Tick(6));
/// assert_eq!((mail.len(), mail[0].to), (1, listener));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Default)]
pub struct EventManager {
    subscribers: Vec<Subscriber>,
    interest: Topics,
    /// Due in the tick that is being collected.
    now: Vec<Stamped>,
    /// Due later, with the label by which they can be taken back.
    later: BTreeMap<Stamp, (Event, Option<u32>)>,
    sequences: BTreeMap<Source, u64>,
    refused: u64,
    over: bool,
}

impl EventManager {
    /// One without subscribers.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a participant of the tick: rules, players, input.
    pub fn register(&mut self, source: Source, topics: Topics) -> SubscriberId {
        self.add(Subscriber { topics, wake: None, source: Some(source), digest: None })
    }

    /// Adds a sink: it listens and never answers.
    pub fn subscribe(&mut self, topics: Topics) -> SubscriberId {
        self.add(Subscriber { topics, wake: None, source: None, digest: None })
    }

    fn add(&mut self, subscriber: Subscriber) -> SubscriberId {
        self.interest = self.interest.or(subscriber.topics);
        self.subscribers.push(subscriber);
        SubscriberId(self.subscribers.len() - 1)
    }

    /// Takes a subscriber's topics away; its number stays unused.
    pub fn unsubscribe(&mut self, id: SubscriberId) {
        if let Some(subscriber) = self.subscribers.get_mut(id.0) {
            subscriber.topics = Topics::NONE;
            subscriber.wake = None;
        }
        self.interest =
            self.subscribers.iter().fold(Topics::NONE, |all, subscriber| all.or(subscriber.topics));
    }

    /// What somebody wants to hear. Nothing else is kept, and a jump stops at nothing else.
    pub fn interest(&self) -> Topics {
        self.interest
    }

    /// Events refused since the start because the queue was full.
    pub fn refused(&self) -> u64 {
        self.refused
    }

    /// Publishes an event that is due in `tick` or `delay_ticks` later.
    pub fn publish(
        &mut self,
        source: Source,
        tick: Tick,
        publication: Publication,
    ) -> Result<Stamp, QueueFull> {
        if self.now.len() + self.later.len() >= LIMIT {
            self.refused += 1;
            return Err(QueueFull { tick });
        }
        let sequence = self.sequences.entry(source).or_insert(0);
        let stamp =
            Stamp { tick: tick.after(publication.delay_ticks), source, sequence: *sequence };
        *sequence += 1;
        self.later.insert(stamp, (publication.event, publication.label));
        Ok(stamp)
    }

    /// Publishes what happens in the tick that is being collected, without a detour.
    pub fn publish_now(
        &mut self,
        source: Source,
        tick: Tick,
        events: impl IntoIterator<Item = Event>,
    ) -> Result<(), QueueFull> {
        let sequence = self.sequences.entry(source).or_insert(0);
        for event in events {
            if self.now.len() + self.later.len() >= LIMIT {
                self.refused += 1;
                return Err(QueueFull { tick });
            }
            // What nobody subscribed to is not kept; it still counts, so that stamps do not depend
            // on who listens.
            if self.interest.contains(event.topic()) {
                let stamp = Stamp { tick, source, sequence: *sequence };
                self.now.push(Stamped { stamp, event });
            }
            *sequence += 1;
        }
        Ok(())
    }

    /// Takes back all waiting events of `source` with this label.
    pub fn cancel(&mut self, source: Source, label: u32) {
        self.later.retain(|stamp, (_, own)| stamp.source != source || *own != Some(label));
    }

    /// Takes a participant's answer for tick `tick`: what it publishes is due in the next.
    pub fn answer(
        &mut self,
        id: SubscriberId,
        tick: Tick,
        outcome: Outcome,
        digest: Digest,
    ) -> Result<(), QueueFull> {
        let Some(source) = self.subscribers.get(id.0).and_then(|subscriber| subscriber.source)
        else {
            return Ok(());
        };
        for label in outcome.cancel {
            self.cancel(source, label);
        }
        for publication in outcome.publish {
            self.publish(source, tick.after(1), publication)?;
        }
        let subscriber = &mut self.subscribers[id.0];
        // A wake in the past would stop the clock.
        subscriber.wake = outcome.wake.map(|wake| wake.max(tick.after(1)));
        subscriber.digest = Some(digest);
        Ok(())
    }

    /// The next tick in which something is due or somebody wants to be woken.
    pub fn next_due(&self) -> Option<Tick> {
        let event = self.later.first_key_value().map(|(stamp, _)| stamp.tick);
        let wake = self.subscribers.iter().filter_map(|subscriber| subscriber.wake).min();
        [event, wake].into_iter().flatten().min()
    }

    /// The commands that are due in `tick`, for physics, in stamp order. They stay in the queue:
    /// the same tick delivers them to whoever listens.
    pub fn commands_due(&self, tick: Tick) -> SmallVec<[Command; 2]> {
        self.later
            .iter()
            .take_while(|(stamp, _)| stamp.tick <= tick)
            .filter_map(|(_, (event, _))| match event {
                Event::Command(command) => Some(command.clone()),
                _ => None,
            })
            .collect()
    }

    /// Closes tick `tick`: one batch for each subscriber that has mail or asked to be woken, in
    /// order of registration. Subscribers that want everything of a batch share it.
    pub fn seal(&mut self, tick: Tick) -> Vec<Delivery> {
        while let Some(entry) = self.later.first_entry() {
            if entry.key().tick > tick {
                break;
            }
            let (stamp, (event, _)) = entry.remove_entry();
            if let Event::Verdict(verdict) = &event {
                self.over |= verdict.turn == TurnAfter::End;
            }
            if self.interest.contains(event.topic()) {
                self.now.push(Stamped { stamp, event });
            }
        }
        // Stable and nearly sorted already: runs of single sources.
        self.now.sort_by_key(|stamped| stamped.stamp);
        let whole: Arc<[Stamped]> = self.now.drain(..).collect();
        let present = whole
            .iter()
            .fold(Topics::NONE, |set, stamped| set.or(Topics::of(&[stamped.event.topic()])));

        let mut deliveries = Vec::with_capacity(self.subscribers.len());
        for (index, subscriber) in self.subscribers.iter_mut().enumerate() {
            let wanted = present.and(subscriber.topics);
            let woken = subscriber.wake.is_some_and(|wake| wake <= tick);
            if wanted.is_empty() && !woken {
                continue;
            }
            if woken {
                subscriber.wake = None;
            }
            let events = if wanted == present {
                whole.clone()
            } else {
                whole.iter().filter(|s| wanted.contains(s.event.topic())).cloned().collect()
            };
            deliveries.push(Delivery { to: SubscriberId(index), events });
        }
        deliveries
    }

    /// What the clock needs to know after a tick.
    pub fn sealed(&self) -> Sealed {
        let next_due = self.next_due();
        Sealed {
            next_due,
            commands: next_due.map(|due| self.commands_due(due)).unwrap_or_default(),
            interest: self.interest,
            over: self.over,
        }
    }

    /// The state hashes of all participants as of their last answer, in order of registration.
    pub fn digests(&self) -> SmallVec<[(Source, Digest); 4]> {
        self.subscribers
            .iter()
            .filter_map(|subscriber| Some((subscriber.source?, subscriber.digest?)))
            .collect()
    }
}
