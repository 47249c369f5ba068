//! Events per second through the tick of the event manager, beside other ways to send the same
//! events to seven subscribers. `README.md` holds the figures and how to read them.
//!
//! `cargo run --release --manifest-path tests/bench/bus/Cargo.toml [-- EVENTS [ROUNDS]]`
//!
//! Every variant sends the same `Stamped` values, 16 a tick; every subscriber checks that they
//! arrive complete and in stamp order. Rounds are interleaved, the median counts, and only ratios
//! within one run mean anything.

mod common;
mod latency;
#[path = "../../thousand.rs"]
mod thousand;

use common::{Check, PER_TICK, SUBSCRIBERS, fact, on_runtime, stamped};
use hapticbillard::event_manager::EventManager as Core;
use hapticbillard::events::{Event, Fact, Source, Stamp, Stamped, Topics};
use hapticbillard::hash::Digest;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Frame, Outcome};
use hapticbillard::units::Tick;
use hapticbillard_actors::event_manager::{EventManager, Seal, Sink};
use hapticbillard_actors::participant::{Answer, Mail, Seat, door};
use kameo::mailbox;
use kameo::prelude::*;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use tokio::sync::{broadcast, mpsc};

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

/// As in a game: rules, players, observers. All answer before the next tick.
fn participants(events: u64) -> Duration {
    on_runtime(async move {
        let first = Answer { outcome: Outcome::default(), digest: Digest(0) };
        let seats = (0..SUBSCRIBERS).map(|_| Seat {
            source: Source::Rules,
            topics: Topics::ALL,
            first: first.clone(),
            ask: door(Listener::spawn(Listener(Check::default()))),
        });
        let manager = EventManager::new(seats.collect(), Vec::new()).unwrap();
        let (elapsed, digests) = all_ticks(manager, events).await;
        assert!(digests.len() == SUBSCRIBERS && digests.iter().all(|seen| *seen == events));
        elapsed
    })
}

/// The event manager's other subscribers, such as a window: nobody answers.
fn sinks(events: u64) -> Duration {
    on_runtime(async move {
        let dropped = Arc::new(AtomicU64::new(0));
        let (mut sinks, mut tasks) = (Vec::new(), Vec::new());
        for _ in 0..SUBSCRIBERS {
            // Large enough to lose nothing: a sink that lags loses its own mail.
            let (mail, inbox) = flume::bounded::<Delivered>((events / PER_TICK) as usize);
            sinks.push(Sink { name: "test", topics: Topics::ALL, mail, dropped: dropped.clone() });
            tasks.push(tokio::spawn(async move {
                let mut check = Check::default();
                while let Ok(mail) = inbox.recv_async().await {
                    mail.events.iter().for_each(|stamped| check.take(stamped));
                }
                check.seen
            }));
        }
        let manager = EventManager::new(Vec::new(), sinks).unwrap();
        let start = Instant::now();
        all_ticks(manager, events).await;
        for task in tasks {
            assert_eq!(task.await.unwrap(), events);
        }
        assert_eq!(dropped.load(Ordering::Relaxed), 0);
        start.elapsed()
    })
}

/// Asks the event manager for one tick after another, as the conductor does. Returns how long that
/// took and what the participants saw.
async fn all_ticks(manager: EventManager, events: u64) -> (Duration, Vec<u64>) {
    let manager = EventManager::spawn_with_mailbox(manager, mailbox::bounded(2));
    let table = Arc::new(Snapshot::default());
    let start = Instant::now();
    let mut last = None;
    for tick in 0..events / PER_TICK {
        let facts = (tick * PER_TICK..(tick + 1) * PER_TICK).map(fact).collect();
        let frame = Frame::new();
        let (health, table) = (Vec::new(), table.clone());
        let seal = Seal { tick: Tick(tick + 1), frame, facts, health, table };
        last = Some(manager.ask(seal).await.unwrap().0.unwrap());
    }
    let elapsed = start.elapsed();
    (elapsed, last.unwrap().digests.iter().map(|(_, seen)| seen.0).collect())
}

/// The same core without a message: what the lockstep driver does.
fn direct_calls(events: u64) -> Duration {
    let mut core = Core::new();
    let mut checks: Vec<Check> = (0..SUBSCRIBERS).map(|_| Check::default()).collect();
    for _ in 0..SUBSCRIBERS {
        core.register(Source::Rules, Topics::ALL);
    }
    let start = Instant::now();
    for number in 0..events / PER_TICK {
        let tick = Tick(number + 1);
        let facts = (number * PER_TICK..(number + 1) * PER_TICK).map(fact);
        core.publish_now(Source::Physics, tick, facts.map(Event::Fact)).unwrap();
        for delivery in core.seal(tick) {
            let check = &mut checks[delivery.to.0];
            delivery.events.iter().for_each(|stamped| check.take(stamped));
            core.answer(delivery.to, tick, Outcome::default(), Digest(check.seen)).unwrap();
        }
        assert_eq!(core.sealed().next_due, None);
    }
    assert!(checks.iter().all(|check| check.seen == events));
    start.elapsed()
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

/// Kameo's own publisher. Its package switches kameo's tracing on for everybody in its graph, which
/// would slow the event manager, so it is a program of its own, and built apart.
fn kameo_pubsub(events: u64) -> Duration {
    let output = Command::new(pubsub_folder().1).arg(events.to_string()).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    Duration::from_secs_f64(String::from_utf8(output.stdout).unwrap().trim().parse().unwrap())
}

/// Where its sources are, and the program once it is built.
fn pubsub_folder() -> (PathBuf, PathBuf) {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("pubsub");
    let program = sources.join("target/release/pubsub-bench");
    (sources, program.with_extension(std::env::consts::EXE_EXTENSION))
}

fn build_pubsub() {
    let (sources, _) = pubsub_folder();
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let built = Command::new(cargo)
        .args(["build", "--release", "--locked", "--manifest-path"])
        .arg(sources.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(sources.join("target"))
        .status();
    assert!(built.is_ok_and(|status| status.success()), "kameo's PubSub could not be built");
}

/// What a variant is held against: the fan-out that does the same job by hand.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Every subscriber answers before the next tick.
    Answered,
    /// Nobody answers; ticks overlap.
    Unanswered,
}

type Variant = (&'static str, Kind, fn(u64) -> Duration);

const VARIANTS: [Variant; 8] = [
    ("event manager, 7 participants", Kind::Answered, participants),
    ("**batched tokio mpsc by hand**", Kind::Answered, answered_mpsc),
    ("event manager, 7 sinks", Kind::Unanswered, sinks),
    ("**batched tokio mpsc by hand**", Kind::Unanswered, batched_mpsc),
    ("raw flume fan-out, a message an event", Kind::Unanswered, flume_fan_out),
    ("tokio broadcast, a message an event", Kind::Unanswered, tokio_broadcast),
    ("kameo's PubSub, guaranteed, a message an event", Kind::Unanswered, kameo_pubsub),
    ("the event manager's core, called directly", Kind::Answered, direct_calls),
];
/// Places of the two fan-outs by hand.
const BY_HAND: [usize; 2] = [1, 3];

fn main() {
    let mut arguments = std::env::args().skip(1).map(|text| {
        text.parse::<u64>().unwrap_or_else(|_| {
            eprintln!("'{text}' is no number; usage: bus-bench [EVENTS [ROUNDS]]");
            std::process::exit(2)
        })
    });
    let events = arguments.next().unwrap_or(1_000_000).max(PER_TICK) / PER_TICK * PER_TICK;
    let rounds = arguments.next().unwrap_or(5).max(1);
    build_pubsub();
    let mut rates = vec![Vec::new(); VARIANTS.len()];
    for round in 1..=rounds {
        for (rates, (name, _, run)) in rates.iter_mut().zip(&VARIANTS) {
            let rate = events as f64 / run(events).as_secs_f64();
            eprintln!("round {round} of {rounds}: {name}: {rate:.0} events/s");
            rates.push(rate);
        }
    }
    rates.iter_mut().for_each(|rates| rates.sort_by(f64::total_cmp));
    let medians: Vec<f64> = rates.iter().map(|rates| rates[rates.len() / 2]).collect();
    println!(
        "{events} events of {} bytes, {PER_TICK} a tick, {SUBSCRIBERS} subscribers; \
         median, least and most of {rounds} interleaved rounds.\n",
        size_of::<Stamped>()
    );
    println!("| variant | tick ends when | million events/s | × answered | × unanswered |");
    println!("|---|---|---|---|---|");
    for (((name, kind, _), median), rates) in VARIANTS.iter().zip(&medians).zip(&rates) {
        let end = if *kind == Kind::Answered { "all have answered" } else { "all was sent" };
        let [answered, unanswered] = BY_HAND.map(|place| median / medians[place]);
        let (least, most) = (rates[0] / 1e6, rates[rates.len() - 1] / 1e6);
        println!(
            "| {name} | {end} | {:.2} ({least:.2}–{most:.2}) | {answered:.2} | {unanswered:.2} |",
            median / 1e6
        );
    }
    latency::table(rounds);
}
