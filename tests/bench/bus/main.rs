//! Events per second through the tick of the event manager, beside other ways to send the same
//! events to seven subscribers.
//!
//! `cargo run --release --manifest-path tests/bench/bus/Cargo.toml [-- EVENTS [ROUNDS]]`
//!
//! With `--features pubsub` kameo's own PubSub runs too; its package switches kameo's tracing on,
//! so that the event manager is slower than in the game.
//!
//! Every variant sends the same `Stamped` values, 16 a tick; every subscriber checks that they
//! arrive complete and in stamp order. Rounds are interleaved, the median counts, and only ratios
//! within one run mean anything.

use hapticbillard::events::{Event, Fact, FactKind, Source, Stamp, Stamped, Topics};
use hapticbillard::hash::Digest;
use hapticbillard::ids::BallId;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Frame, Outcome};
use hapticbillard::units::Tick;
use hapticbillard_actors::event_manager::{EventManager, Seal};
use hapticbillard_actors::participant::{Answer, Mail, Seat, door};
use kameo::mailbox;
use kameo::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::{broadcast, mpsc};

const SUBSCRIBERS: usize = 7;
const PER_TICK: u64 = 16;

fn fact(number: u64) -> Fact {
    let ball = BallId((number % 16) as u16);
    Fact { time_s: number as f64 * 1e-4, kind: FactKind::HeadStringCrossed { ball } }
}

fn stamped(number: u64) -> Stamped {
    let tick = Tick(number / PER_TICK + 1);
    let stamp = Stamp { tick, source: Source::Physics, sequence: number };
    Stamped { stamp, event: Event::Fact(fact(number)) }
}

/// Counts what arrives and insists on its order.
#[derive(Default)]
struct Check {
    seen: u64,
    last: Option<Stamp>,
}

impl Check {
    fn take(&mut self, stamped: &Stamped) {
        assert!(self.last < Some(stamped.stamp), "out of order");
        self.last = Some(stamped.stamp);
        self.seen += 1;
    }
}

/// Runs `job` on a runtime as the game has it: one worker, and nothing on the caller's thread.
fn on_runtime<F>(job: F) -> Duration
where
    F: Future<Output = Duration> + Send + 'static,
{
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).build().unwrap();
    runtime.block_on(async { tokio::spawn(job).await.unwrap() })
}

// --- the event manager -------------------------------------------------------------------------

#[derive(Actor)]
struct Listener(Check);

impl Message<Mail> for Listener {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        mail.0.events.iter().for_each(|stamped| self.0.take(stamped));
        Answer { outcome: Outcome::default(), digest: Digest(self.0.seen) }
    }
}

fn event_manager(events: u64) -> Duration {
    on_runtime(async move {
        let first = Answer { outcome: Outcome::default(), digest: Digest(0) };
        let seats = (0..SUBSCRIBERS).map(|_| Seat {
            source: Source::Rules,
            topics: Topics::ALL,
            first: first.clone(),
            ask: door(Listener::spawn(Listener(Check::default()))),
        });
        let core = EventManager::new(seats.collect(), Vec::new()).unwrap();
        let manager = EventManager::spawn_with_mailbox(core, mailbox::bounded(2));
        let table = Arc::new(Snapshot::default());
        let start = Instant::now();
        let mut last = None;
        for tick in 0..events / PER_TICK {
            let facts = (tick * PER_TICK..(tick + 1) * PER_TICK).map(fact).collect();
            let frame = Frame::new();
            let seal = Seal { tick: Tick(tick + 1), frame, facts, table: table.clone() };
            last = Some(manager.ask(seal).await.unwrap().0.unwrap());
        }
        let elapsed = start.elapsed();
        assert!(last.unwrap().digests.iter().all(|(_, seen)| seen.0 == events));
        elapsed
    })
}

// --- a hand-written fan-out of batches ---------------------------------------------------------

/// Seals one tick by hand.
fn seal(tick: Tick, sequence: &mut u64, facts: Vec<Fact>) -> Arc<[Stamped]> {
    let mut batch: Vec<Stamped> = Vec::with_capacity(facts.len());
    for fact in facts {
        let stamp = Stamp { tick, source: Source::Physics, sequence: *sequence };
        batch.push(Stamped { stamp, event: Event::Fact(fact) });
        *sequence += 1;
    }
    batch.sort_by_key(|stamped| stamped.stamp);
    batch.into()
}

/// The same job as the event manager's: every subscriber answers before the next tick.
fn answered_mpsc(events: u64) -> Duration {
    on_runtime(async move {
        let (to_manager, mut inbox) = mpsc::channel::<Vec<Fact>>(2);
        let (done, mut finished) = mpsc::channel::<u64>(2);
        let (answer, mut answers) = mpsc::channel::<(usize, Outcome)>(SUBSCRIBERS);
        let mut senders = Vec::new();
        for index in 0..SUBSCRIBERS {
            let (sender, mut receiver) = mpsc::channel::<Arc<[Stamped]>>(2);
            senders.push(sender);
            let answer = answer.clone();
            tokio::spawn(async move {
                let mut check = Check::default();
                while let Some(batch) = receiver.recv().await {
                    batch.iter().for_each(|stamped| check.take(stamped));
                    answer.send((index, Outcome::default())).await.unwrap();
                }
                assert_eq!(check.seen, events);
            });
        }
        tokio::spawn(async move {
            let mut sequence = 0;
            let mut tick = Tick(0);
            while let Some(facts) = inbox.recv().await {
                tick = tick.after(1);
                let batch = seal(tick, &mut sequence, facts);
                for sender in &senders {
                    sender.send(batch.clone()).await.unwrap();
                }
                let mut outcomes: [Option<Outcome>; SUBSCRIBERS] = Default::default();
                for _ in 0..SUBSCRIBERS {
                    let (index, outcome) = answers.recv().await.unwrap();
                    outcomes[index] = Some(outcome);
                }
                assert!(outcomes.iter().all(Option::is_some));
                done.send(sequence).await.unwrap();
            }
        });
        let start = Instant::now();
        for tick in 0..events / PER_TICK {
            let facts = (tick * PER_TICK..(tick + 1) * PER_TICK).map(fact).collect();
            to_manager.send(facts).await.unwrap();
            finished.recv().await.unwrap();
        }
        start.elapsed()
    })
}

/// Less than the event manager does: nobody answers, so ticks overlap.
fn batched_mpsc(events: u64) -> Duration {
    on_runtime(async move {
        let (to_manager, mut inbox) = mpsc::channel::<Vec<Fact>>(64);
        let mut senders = Vec::new();
        let mut tasks = Vec::new();
        for _ in 0..SUBSCRIBERS {
            let (sender, mut receiver) = mpsc::channel::<Arc<[Stamped]>>(64);
            senders.push(sender);
            tasks.push(tokio::spawn(async move {
                let mut check = Check::default();
                while let Some(batch) = receiver.recv().await {
                    batch.iter().for_each(|stamped| check.take(stamped));
                }
                check.seen
            }));
        }
        let manager = tokio::spawn(async move {
            let mut sequence = 0;
            let mut tick = Tick(0);
            while let Some(facts) = inbox.recv().await {
                tick = tick.after(1);
                let batch = seal(tick, &mut sequence, facts);
                for sender in &senders {
                    sender.send(batch.clone()).await.unwrap();
                }
            }
        });
        let start = Instant::now();
        for tick in 0..events / PER_TICK {
            let facts = (tick * PER_TICK..(tick + 1) * PER_TICK).map(fact).collect();
            to_manager.send(facts).await.unwrap();
        }
        drop(to_manager);
        manager.await.unwrap();
        for task in tasks {
            assert_eq!(task.await.unwrap(), events);
        }
        start.elapsed()
    })
}

// --- one message an event ----------------------------------------------------------------------

fn flume_fan_out(events: u64) -> Duration {
    let mut senders = Vec::new();
    let mut threads = Vec::new();
    for _ in 0..SUBSCRIBERS {
        let (sender, receiver) = flume::bounded::<Stamped>(1024);
        senders.push(sender);
        threads.push(std::thread::spawn(move || {
            let mut check = Check::default();
            receiver.iter().for_each(|stamped| check.take(&stamped));
            check.seen
        }));
    }
    let start = Instant::now();
    for number in 0..events {
        let stamped = stamped(number);
        senders.iter().for_each(|sender| sender.send(stamped.clone()).unwrap());
    }
    drop(senders);
    for thread in threads {
        assert_eq!(thread.join().unwrap(), events);
    }
    start.elapsed()
}

fn tokio_broadcast(events: u64) -> Duration {
    on_runtime(async move {
        // Large enough to lose nothing: broadcast drops what a receiver is too slow for.
        let (sender, _) = broadcast::channel::<Stamped>((events as usize).next_power_of_two());
        let tasks: Vec<_> = (0..SUBSCRIBERS)
            .map(|_| {
                let mut receiver = sender.subscribe();
                tokio::spawn(async move {
                    let mut check = Check::default();
                    while let Ok(stamped) = receiver.recv().await {
                        check.take(&stamped);
                    }
                    check.seen
                })
            })
            .collect();
        let start = Instant::now();
        tokio::spawn(async move {
            for number in 0..events {
                sender.send(stamped(number)).unwrap();
            }
        })
        .await
        .unwrap();
        for task in tasks {
            assert_eq!(task.await.unwrap(), events);
        }
        start.elapsed()
    })
}

/// Kameo's own publisher, in a graph in which kameo traces.
#[cfg(feature = "pubsub")]
mod pubsub {
    use super::{Check, SUBSCRIBERS, on_runtime, stamped};
    use hapticbillard::events::Stamped;
    use kameo::prelude::*;
    use kameo_actors::DeliveryStrategy;
    use kameo_actors::pubsub::{PubSub, Publish, Subscribe};
    use std::time::{Duration, Instant};

    #[derive(Actor)]
    struct Hearer(Check);

    impl Message<Stamped> for Hearer {
        type Reply = ();

        async fn handle(&mut self, stamped: Stamped, _: &mut Context<Self, ()>) {
            self.0.take(&stamped);
        }
    }

    struct Seen;

    impl Message<Seen> for Hearer {
        type Reply = u64;

        async fn handle(&mut self, _: Seen, _: &mut Context<Self, u64>) -> u64 {
            self.0.seen
        }
    }

    pub fn kameo_pubsub(events: u64) -> Duration {
        on_runtime(async move {
            let pubsub = PubSub::<Stamped>::spawn(PubSub::new(DeliveryStrategy::Guaranteed));
            let hearers: Vec<_> =
                (0..SUBSCRIBERS).map(|_| Hearer::spawn(Hearer(Check::default()))).collect();
            for hearer in &hearers {
                pubsub.ask(Subscribe(hearer.clone())).await.unwrap();
            }
            let start = Instant::now();
            for number in 0..events {
                pubsub.tell(Publish(stamped(number))).await.unwrap();
            }
            pubsub.stop_gracefully().await.unwrap();
            pubsub.wait_for_shutdown().await;
            for hearer in hearers {
                assert_eq!(hearer.ask(Seen).await.unwrap(), events);
            }
            start.elapsed()
        })
    }
}

fn main() {
    let mut arguments = std::env::args().skip(1).map(|text| {
        text.parse::<u64>().unwrap_or_else(|_| {
            eprintln!("'{text}' is no number; usage: bus-bench [EVENTS [ROUNDS]]");
            std::process::exit(2)
        })
    });
    let events = arguments.next().unwrap_or(1_000_000) / PER_TICK * PER_TICK;
    let rounds = arguments.next().unwrap_or(5).max(1);
    type Variant = (&'static str, fn(u64) -> Duration);
    let variants: Vec<Variant> = vec![
        ("event manager (kameo, one batch a tick, answered)", event_manager),
        ("hand-written batched tokio mpsc, answered", answered_mpsc),
        ("hand-written batched tokio mpsc, nobody answers", batched_mpsc),
        ("flume fan-out, an event a message", flume_fan_out),
        ("tokio broadcast, an event a message", tokio_broadcast),
        #[cfg(feature = "pubsub")]
        ("kameo PubSub (guaranteed), an event a message", pubsub::kameo_pubsub),
    ];
    let mut rates = vec![Vec::new(); variants.len()];
    for round in 0..rounds {
        for (rates, (name, run)) in rates.iter_mut().zip(&variants) {
            let rate = events as f64 / run(events).as_secs_f64();
            eprintln!("round {} of {rounds}: {name}: {rate:.0} events/s", round + 1);
            rates.push(rate);
        }
    }
    let median = |rates: &mut Vec<f64>| {
        rates.sort_by(f64::total_cmp);
        rates[rates.len() / 2]
    };
    let medians: Vec<f64> = rates.iter_mut().map(median).collect();
    println!("{events} events of {} bytes, {PER_TICK} a tick, {SUBSCRIBERS} subscribers,", size());
    println!("median of {rounds} interleaved rounds:\n");
    println!("| variant | events/s | over answered mpsc | over unanswered |\n|---|---|---|---|");
    for ((name, _), rate) in variants.iter().zip(&medians) {
        println!("| {name} | {rate:.0} | {:.2} | {:.2} |", rate / medians[1], rate / medians[2]);
    }
}

fn size() -> usize {
    size_of::<Stamped>()
}
