//! How long it takes from the publishing of a tick until a subscriber has handled its last event.
//!
//! A thread of its own publishes, at a game's rate, at ten times what a break of a thousand balls
//! makes in its busiest second, and in ticks of ten times what it makes in its busiest tick, as
//! fast as the queues take them. Queues are bounded as in the game, so that each variant shows what
//! it does when they are full.

use crate::common::{Check, SUBSCRIBERS, fact};
use crate::thousand::{Busiest, busiest, rack};
use hapticbillard::events::{Event, Fact, Source, Stamp, Stamped, Topics};
use hapticbillard::hash::Digest;
use hapticbillard::tick::{Delivered, Frame, Outcome};
use hapticbillard::units::Tick;
use hapticbillard_actors::event_manager::{EventManager, Seal, Sink};
use hapticbillard_actors::histogram::Histogram;
use hapticbillard_actors::participant::{Answer, Mail, Seat, door};
use kameo::mailbox;
use kameo::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tokio::runtime::{Builder, Runtime};
use tokio::sync::broadcast::{self, error::RecvError};

/// Mail that a sink has room for.
const ROOM: usize = 64;
/// Ticks that are published at their time in a round, and as fast as can be.
const PACED: u64 = 2000;
const SATURATED: u64 = 300;
const TICK: Duration = Duration::from_millis(1);

/// What is published.
#[derive(Clone, Copy)]
struct Load {
    ticks: u64,
    per_tick: u64,
    is_paced: bool,
}

impl Load {
    fn events(self) -> u64 {
        self.ticks * self.per_tick
    }
}

/// What came of it.
#[derive(Default)]
struct Measured {
    latency_ns: Histogram,
    lost: AtomicU64,
    events: AtomicU64,
}

/// When each tick was published.
struct Clock {
    start: Instant,
    published_ns: Vec<AtomicU64>,
}

impl Clock {
    fn new(load: Load) -> Arc<Self> {
        let published_ns = (0..=load.ticks).map(|_| AtomicU64::new(0)).collect();
        Arc::new(Clock { start: Instant::now(), published_ns })
    }

    fn now_ns(&self) -> u64 {
        self.start.elapsed().as_nanos() as u64
    }

    /// Publishes all ticks, each at its time.
    fn publish(&self, load: Load, mut send: impl FnMut(Tick, Vec<Fact>)) {
        let begun = Instant::now();
        for number in 1..=load.ticks {
            if load.is_paced {
                std::thread::sleep((begun + TICK * number as u32) - Instant::now().max(begun));
            }
            let first = (number - 1) * load.per_tick;
            let facts = (first..first + load.per_tick).map(fact).collect();
            self.published_ns[number as usize].store(self.now_ns(), Ordering::Release);
            send(Tick(number), facts);
        }
    }
}

/// One who handles events.
struct Handler {
    check: Check,
    clock: Arc<Clock>,
    measured: Arc<Measured>,
    load: Load,
}

impl Handler {
    fn take(&mut self, stamped: &Stamped) {
        self.check.take(stamped);
        if (stamped.stamp.sequence + 1).is_multiple_of(self.load.per_tick) {
            let published_ns = &self.clock.published_ns[stamped.stamp.tick.0 as usize];
            let latency_ns = self.clock.now_ns() - published_ns.load(Ordering::Acquire);
            self.measured.latency_ns.note(latency_ns);
        }
    }
}

fn handlers(load: Load, clock: &Arc<Clock>, measured: &Arc<Measured>) -> Vec<Handler> {
    let one = |_| Handler {
        check: Check::default(),
        clock: clock.clone(),
        measured: measured.clone(),
        load,
    };
    (0..SUBSCRIBERS).map(one).collect()
}

fn runtime() -> Runtime {
    Builder::new_multi_thread().worker_threads(1).build().unwrap()
}

fn stamped(tick: Tick, number: u64, fact: Fact) -> Stamped {
    let stamp = Stamp { tick, source: Source::Physics, sequence: number };
    Stamped { stamp, event: Event::Fact(fact) }
}

#[derive(Actor)]
struct Listener(Handler);

impl Message<Mail> for Listener {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        mail.0.events.iter().for_each(|stamped| self.0.take(stamped));
        Answer { outcome: Outcome::default(), digest: Digest(self.0.check.seen) }
    }
}

fn seal(manager: &ActorRef<EventManager>, tick: Tick, facts: Vec<Fact>) -> u64 {
    let (frame, health, table) = (Frame::new(), Vec::new(), Arc::default());
    let delivery = manager.ask(Seal { tick, frame, facts, health, table }).blocking_send();
    delivery.unwrap().0.unwrap().digests.iter().map(|(_, seen)| seen.0).sum()
}

fn participants(load: Load, measured: &Arc<Measured>) {
    let (runtime, clock) = (runtime(), Clock::new(load));
    let _in = runtime.enter();
    let first = Answer { outcome: Outcome::default(), digest: Digest(0) };
    let seats = handlers(load, &clock, measured).into_iter().map(|handler| Seat {
        source: Source::Rules,
        topics: Topics::ALL,
        first: first.clone(),
        ask: door(Listener::spawn_with_mailbox(Listener(handler), mailbox::bounded(2))),
    });
    let manager = EventManager::new(seats.collect(), Vec::new()).unwrap();
    let manager = EventManager::spawn_with_mailbox(manager, mailbox::bounded(2));
    let mut seen = 0;
    clock.publish(load, |tick, facts| seen = seal(&manager, tick, facts));
    assert_eq!(seen, SUBSCRIBERS as u64 * load.events());
}

fn sinks(load: Load, measured: &Arc<Measured>) {
    let (runtime, clock) = (runtime(), Clock::new(load));
    let dropped = Arc::<AtomicU64>::default();
    let (mut sinks, mut tasks) = (Vec::new(), Vec::new());
    for mut handler in handlers(load, &clock, measured) {
        let (mail, inbox) = flume::bounded::<Delivered>(ROOM);
        sinks.push(Sink { name: "test", topics: Topics::ALL, mail, dropped: dropped.clone() });
        tasks.push(runtime.spawn(async move {
            while let Ok(mail) = inbox.recv_async().await {
                mail.events.iter().for_each(|stamped| handler.take(stamped));
            }
            handler.check.seen
        }));
    }
    let _in = runtime.enter();
    let manager = EventManager::new(Vec::new(), sinks).unwrap();
    let manager = EventManager::spawn_with_mailbox(manager, mailbox::bounded(2));
    clock.publish(load, |tick, facts| {
        seal(&manager, tick, facts);
    });
    runtime.block_on(async {
        manager.stop_gracefully().await.unwrap();
        manager.wait_for_shutdown().await;
    });
    drop(manager);
    let seen: u64 = tasks.into_iter().map(|task| runtime.block_on(task).unwrap()).sum();
    let lost = dropped.load(Ordering::Acquire) * load.per_tick;
    // The counter shows all that is missing.
    assert_eq!(seen + lost, SUBSCRIBERS as u64 * load.events());
    measured.lost.fetch_add(lost, Ordering::Relaxed);
}

fn flume_fan_out(load: Load, measured: &Arc<Measured>) {
    let clock = Clock::new(load);
    let (mut senders, mut threads) = (Vec::new(), Vec::new());
    for mut handler in handlers(load, &clock, measured) {
        let (sender, receiver) = flume::bounded::<Stamped>(1024);
        senders.push(sender);
        threads.push(std::thread::spawn(move || {
            receiver.iter().for_each(|stamped| handler.take(&stamped));
            handler.check.seen
        }));
    }
    let mut number = 0;
    clock.publish(load, |tick, facts| {
        for fact in facts {
            let event = stamped(tick, number, fact);
            senders.iter().for_each(|sender| sender.send(event.clone()).unwrap());
            number += 1;
        }
    });
    drop(senders);
    threads.into_iter().for_each(|thread| assert_eq!(thread.join().unwrap(), load.events()));
}

fn tokio_broadcast(load: Load, measured: &Arc<Measured>) {
    let (runtime, clock) = (runtime(), Clock::new(load));
    // As many events as the sinks have room for batches of a busy tick.
    let (sender, _) = broadcast::channel::<Stamped>(8192);
    let tasks: Vec<_> = handlers(load, &clock, measured)
        .into_iter()
        .map(|mut handler| {
            let mut receiver = sender.subscribe();
            runtime.spawn(async move {
                let mut lost = 0;
                loop {
                    match receiver.recv().await {
                        Ok(stamped) => handler.take(&stamped),
                        Err(RecvError::Lagged(missed)) => lost += missed,
                        Err(RecvError::Closed) => return (handler.check.seen, lost),
                    }
                }
            })
        })
        .collect();
    let mut number = 0;
    clock.publish(load, |tick, facts| {
        for fact in facts {
            sender.send(stamped(tick, number, fact)).unwrap();
            number += 1;
        }
    });
    drop(sender);
    for task in tasks {
        let (seen, lost) = runtime.block_on(task).unwrap();
        assert_eq!(seen + lost, load.events());
        measured.lost.fetch_add(lost, Ordering::Relaxed);
    }
}

type Variant = (&'static str, fn(Load, &Arc<Measured>));

const VARIANTS: [Variant; 4] = [
    ("event manager, 7 participants", participants),
    ("event manager, 7 sinks", sinks),
    ("raw flume fan-out, a message an event", flume_fan_out),
    ("tokio broadcast, a message an event", tokio_broadcast),
];

/// Measures and prints the table.
pub fn table(rounds: u64) {
    let Busiest { in_a_tick, in_a_second } = busiest(rack(), 1200);
    eprintln!(
        "a break of a thousand balls: {in_a_tick} facts in a tick, {in_a_second} in a second"
    );
    let per_ms = (10 * in_a_second as u64).div_ceil(1000);
    let loads = [
        Load { ticks: PACED, per_tick: 1, is_paced: true },
        Load { ticks: PACED, per_tick: per_ms, is_paced: true },
        Load { ticks: SATURATED, per_tick: 10 * in_a_tick as u64, is_paced: false },
    ];
    let measured: Vec<[Arc<Measured>; 3]> = VARIANTS.iter().map(|_| Default::default()).collect();
    for round in 1..=rounds {
        for ((name, run), measured) in VARIANTS.iter().zip(&measured) {
            eprintln!("latency, round {round} of {rounds}: {name}");
            for (load, measured) in loads.iter().zip(measured) {
                run(*load, measured);
                let events = SUBSCRIBERS as u64 * load.events();
                measured.events.fetch_add(events, Ordering::Relaxed);
            }
        }
    }
    println!(
        "\nA break of a thousand balls makes {in_a_tick} facts in its busiest tick and \
         {in_a_second} in its busiest second. From the publishing of a tick until a subscriber has \
         handled its last event: p50 / p99 / p99.9 in µs, and what was lost; {rounds} interleaved \
         rounds.\n"
    );
    println!(
        "| variant | a game: 1 event/ms | ten breaks: {per_ms} events/ms | saturated: ticks of {} \
         events, as fast as can be |",
        10 * in_a_tick
    );
    println!("|---|---|---|---|");
    for ((name, _), measured) in VARIANTS.iter().zip(&measured) {
        let cells = measured.each_ref().map(|measured| cell(measured));
        println!("| {name} | {} |", cells.join(" | "));
    }
}

fn cell(measured: &Measured) -> String {
    let us = |share| measured.latency_ns.quantile(share) as f64 * 1e-3;
    let [p50, p99, p99_9] = [0.5, 0.99, 0.999].map(|share| format!("{:.0}", us(share)));
    let lost = measured.lost.load(Ordering::Relaxed) as f64;
    let percent = 100.0 * lost / measured.events.load(Ordering::Relaxed) as f64;
    let lost = if lost == 0.0 { "none lost".into() } else { format!("{percent:.0} % lost") };
    format!("{p50} / {p99} / {p99_9}, {lost}")
}
