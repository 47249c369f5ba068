//! What can be measured of a running game: how long ticks take, and what waits in which queue.
//!
//! While nobody looks nothing is measured: a tick costs the look at one flag. The pacer notes, a
//! window looks; neither waits for the other.

mod recent;

pub use recent::Recent;

use crate::crew::{Blow, Crew};
use crate::event_manager::Sink;
use crate::news::News;
use hapticbillard::renderer::QueueReading;
use hapticbillard::units::Tick;
use kameo::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// Ticks that count at a time: four seconds.
const TICKS: usize = 4096;

/// The meters of a game.
pub struct Meters {
    is_on: AtomicBool,
    start: Instant,
    newest: AtomicU64,
    ticks: Recent,
    /// When ticks began: number, and time since the start [ns], at the place of the number.
    begun: Box<[[AtomicU64; 2]]>,
    queues: Mutex<Vec<Queue>>,
}

/// A queue that can be looked at.
struct Queue {
    name: String,
    /// What waits, how much may wait, and what was lost so far; none when it is gone.
    look: Box<dyn Fn() -> Option<[u64; 3]> + Send>,
}

impl Default for Meters {
    fn default() -> Self {
        let begun = (0..TICKS).map(|_| [0, 0].map(AtomicU64::new)).collect();
        Meters {
            is_on: AtomicBool::new(false),
            start: Instant::now(),
            newest: AtomicU64::new(0),
            ticks: Recent::of(TICKS),
            begun,
            queues: Mutex::default(),
        }
    }
}

impl Meters {
    /// Measures from now on, or no longer.
    pub fn switch(&self, is_on: bool) {
        self.is_on.store(is_on, Ordering::Relaxed);
    }

    /// Now, if somebody looks.
    pub fn now(&self) -> Option<Instant> {
        self.is_on.load(Ordering::Relaxed).then(Instant::now)
    }

    /// A tick is done that began then.
    pub fn note_tick(&self, tick: Tick, begun: Instant) {
        self.ticks.note(begun.elapsed());
        let [number, since_ns] = &self.begun[(tick.0 % TICKS as u64) as usize];
        let since = begun.saturating_duration_since(self.start).as_nanos();
        since_ns.store(u64::try_from(since).unwrap_or(u64::MAX), Ordering::Relaxed);
        number.store(tick.0, Ordering::Release);
        self.newest.store(tick.0, Ordering::Relaxed);
    }

    /// When a tick began; none if that was not measured, or too long ago.
    pub fn begin_of(&self, tick: Tick) -> Option<Instant> {
        let [number, since_ns] = &self.begun[(tick.0 % TICKS as u64) as usize];
        let is_it = number.load(Ordering::Acquire) == tick.0;
        let since = std::time::Duration::from_nanos(since_ns.load(Ordering::Relaxed));
        is_it.then(|| self.start + since)
    }

    /// The newest tick that was measured.
    pub fn newest(&self) -> Tick {
        Tick(self.newest.load(Ordering::Relaxed))
    }

    /// How long the last ticks took.
    pub fn ticks(&self) -> &Recent {
        &self.ticks
    }

    /// Every queue that is still there.
    pub fn queues(&self) -> Vec<QueueReading> {
        let mut readings = Vec::new();
        self.places().retain(|queue| {
            let read = (queue.look)();
            let reading = read.map(|[waiting, room, lost]| QueueReading {
                name: queue.name.clone(),
                waiting,
                room,
                lost,
            });
            readings.extend(reading);
            read.is_some()
        });
        readings
    }

    /// The mailbox of an actor. Whoever finds it full waits: nothing is lost in it.
    pub fn watch_mailbox<A: Actor>(&self, name: &str, actor: &ActorRef<A>) {
        let actor = actor.downgrade();
        self.watch(name.to_string(), move || {
            let actor = actor.upgrade().filter(ActorRef::is_alive)?;
            let (room, free) =
                (actor.mailbox_sender().max_capacity()?, actor.mailbox_sender().capacity()?);
            Some([room.saturating_sub(free) as u64, room as u64, 0])
        });
    }

    /// The mail of somebody who listens outside the tick.
    pub fn watch_sink(&self, sink: &Sink) {
        self.watch_channel(format!("mail {}", sink.name), sink.mail.downgrade(), &sink.dropped);
    }

    /// What the player is to be told.
    pub fn watch_news(&self, news: &News) {
        self.watch_channel("news".into(), news.way(), news.dropped());
    }

    fn watch_channel<T: Send + 'static>(
        &self,
        name: String,
        way: flume::WeakSender<T>,
        lost: &Arc<AtomicU64>,
    ) {
        let lost = lost.clone();
        self.watch(name, move || {
            let way = way.upgrade()?;
            let room = way.capacity()? as u64;
            Some([way.len() as u64, room, lost.load(Ordering::Relaxed)])
        });
    }

    fn watch(&self, name: String, look: impl Fn() -> Option<[u64; 3]> + Send + 'static) {
        self.places().push(Queue { name, look: Box::new(look) });
    }

    fn places(&self) -> MutexGuard<'_, Vec<Queue>> {
        // Nothing is done under the lock that could leave it half done.
        self.queues.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A crew whose mailboxes are watched, if there are meters.
#[derive(Clone)]
pub struct Watched {
    /// The crew.
    pub crew: Crew,
    /// The meters.
    pub meters: Option<Arc<Meters>>,
}

impl Watched {
    /// As [`Crew::join`].
    pub fn join<A: Message<Blow> + Actor<Args = A>>(
        &self,
        name: &'static str,
        actor: A,
    ) -> ActorRef<A> {
        let actor = self.crew.join(name, actor);
        self.watch(name, &actor);
        actor
    }

    /// As [`Crew::tell`].
    pub fn tell<A: Message<Blow>>(&self, name: &'static str, actor: &ActorRef<A>) {
        self.crew.tell(name, actor);
        self.watch(name, actor);
    }

    fn watch<A: Actor>(&self, name: &str, actor: &ActorRef<A>) {
        if let Some(meters) = &self.meters {
            meters.watch_mailbox(name, actor);
        }
    }
}
