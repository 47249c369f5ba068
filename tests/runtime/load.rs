//! Full queues and slow listeners: what the doc of each queue says happens, and a counter shows it.
//!
//! | queue | when it is full | test |
//! |---|---|---|
//! | events of the event manager | the tick ends in an error | `more_events_than_…` |
//! | mailbox of a participant | the mail waits, so does the tick | `a_participant_that_takes_…` |
//! | mail of a sink | its own mail is dropped and counted | `ten_times_…` |
//! | news for the player | dropped and counted | `news_that_nobody_takes_…` |
//! | the mouse into a device | movements are dropped, counted | `a_mouse_whose_device_…` |
//! | reports of a window | movements add up, the rest waits | unit tests of `renderer::outbox` |
//! | samples, buttons, telemetry of a servo | the oldest stay, loss is counted | `servo` |
//! | readings of a device | dropped and counted | `device_recordings` |
//! | lines of a recording | the conductor waits | `a_flood_changes_…`, `supervision` |

use super::cli::folder;
use super::thousand;
use hapticbillard::event_manager::{LIMIT, Publication, QueueFull};
use hapticbillard::events::{Event, Fact, FactKind, Health, Source, Stamp, Stamped, Topic, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::BallId;
use hapticbillard::input::{Action, HandInput};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::QueueReading;
use hapticbillard::scene::{HapticDevice, Overrides};
use hapticbillard::tick::{Delivered, Frame, Outcome, Participant};
use hapticbillard::units::Tick;
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::event_manager::{Delivery, DeliveryError, EventManager, Seal, Sink};
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{LIMIT as LAST, Stage};
use hapticbillard_actors::haptic::{FeltMouse, open};
use hapticbillard_actors::meters::Meters;
use hapticbillard_actors::news::News;
use hapticbillard_actors::observer::Observer;
use hapticbillard_actors::participant::{self, Answer, Mail, Seat, door};
use hapticbillard_actors::runtime::{self, Setup};
use kameo::mailbox;
use kameo::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use tokio::sync::mpsc::{UnboundedReceiver, UnboundedSender, unbounded_channel};

/// Facts in the busiest tick of a break of a thousand balls.
const BREAK: usize = 351;
/// What the event manager is given in a tick here.
const LOAD: usize = 10 * BREAK;
/// Ticks of such a load.
const TICKS: u64 = 100;
/// Events that a participant publishes in a tick.
const SAID: usize = 50;

#[test]
fn a_break_of_a_thousand_balls_makes_so_many_facts_in_its_busiest_tick() {
    // The cue ball needs 44 ms to the rack.
    assert_eq!(thousand::busiest(thousand::rack(), 100).in_a_tick, BREAK);
}

fn fact(number: u64) -> Fact {
    let ball = BallId((number % 16) as u16);
    Fact { time_s: number as f64 * 1e-6, kind: FactKind::HeadStringCrossed { ball } }
}

fn said() -> Publication {
    Publication::from(Event::Health(Arc::new(Health::ActorRestarted { actor: "said".into() })))
}

/// Everything that somebody heard, by number; insists on the order of the stamps.
#[derive(Debug, Default)]
struct Heard {
    facts: u64,
    said: u64,
    ticks: Vec<Tick>,
    last: Option<Stamp>,
}

impl Heard {
    fn take(&mut self, delivered: &Delivered) {
        self.ticks.push(delivered.tick);
        for Stamped { stamp, event } in delivered.events.iter() {
            assert!(self.last < Some(*stamp), "{stamp:?} behind {:?}", self.last);
            self.last = Some(*stamp);
            match event {
                Event::Fact(_) => self.facts += 1,
                _ => self.said += 1,
            }
        }
    }
}

/// Takes part, hears everything, and says as much as it is told to in each of its first ticks.
struct Speaks {
    heard: Arc<Mutex<Heard>>,
    per_tick: usize,
    until: Tick,
}

impl Speaks {
    fn new(per_tick: usize, until: Tick) -> (Self, Arc<Mutex<Heard>>) {
        let heard = Arc::<Mutex<Heard>>::default();
        (Speaks { heard: heard.clone(), per_tick, until }, heard)
    }
}

impl Participant for Speaks {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome { wake: Some(Tick(1)), ..Outcome::default() }
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        self.heard.lock().unwrap().take(delivered);
        if self.until < delivered.tick {
            return Outcome::default();
        }
        let publish = (0..self.per_tick).map(|_| said()).collect();
        Outcome { publish, wake: Some(delivered.tick.after(1)), ..Outcome::default() }
    }

    fn hash(&self, _: &mut StateHash) {}
}

fn seat(mut core: impl Participant + 'static) -> Seat {
    let (source, topics) = (core.source(), core.topics());
    let first = participant::start(&mut core, &Snapshot::default());
    let actor = Observer::spawn_with_mailbox(Observer(Box::new(core)), mailbox::bounded(2));
    Seat { source, topics, first, ask: door(actor) }
}

fn sink(
    name: &'static str,
    room: usize,
) -> (Sink, flume::Receiver<Delivered>, impl Fn() -> u64 + use<>) {
    let (mail, inbox) = flume::bounded(room);
    let dropped = Arc::<AtomicU64>::default();
    let counter = dropped.clone();
    let sink = Sink { name, topics: Topics::of(&[Topic::HeadStringCrossed]), mail, dropped };
    (sink, inbox, move || counter.load(Ordering::SeqCst))
}

async fn seal(
    manager: &ActorRef<EventManager>,
    tick: u64,
    facts: usize,
) -> Result<Delivery, DeliveryError> {
    let facts = (0..facts as u64).map(fact).collect();
    let (frame, health, table) = (Frame::new(), Vec::new(), Arc::default());
    let seal = Seal { tick: Tick(tick), frame, facts, health, table };
    manager.ask(seal).await.unwrap().0
}

#[tokio::test]
async fn ten_times_a_break_of_a_thousand_balls_loses_nothing_but_the_mail_of_slow_sinks() {
    let (all, heard): (Vec<_>, Vec<_>) = (0..5).map(|_| Speaks::new(SAID, Tick(TICKS))).unzip();
    let (quick, quick_inbox, quick_dropped) = sink("quick", 1);
    let (slow, slow_inbox, slow_dropped) = sink("slow", 4);
    let (stuck, stuck_inbox, stuck_dropped) = sink("stuck", 4);
    let (gone, gone_inbox, gone_dropped) = sink("gone", 4);
    drop(gone_inbox);
    let seats = all.into_iter().map(seat).collect();
    let manager = EventManager::new(seats, vec![gone, stuck, slow, quick]).unwrap();
    let manager = EventManager::spawn_with_mailbox(manager, mailbox::bounded(2));
    let [mut by_quick, mut by_slow, mut by_stuck] = [(); 3].map(|()| Heard::default());
    for tick in 1..=TICKS {
        let delivery = seal(&manager, tick, LOAD).await.unwrap();
        assert_eq!(delivery.digests.len(), heard.len());
        quick_inbox.try_iter().for_each(|mail| by_quick.take(&mail));
        if tick.is_multiple_of(3) {
            by_slow.take(&slow_inbox.try_recv().unwrap());
        }
    }
    // What was said in the last tick comes in the next.
    seal(&manager, TICKS + 1, 0).await.unwrap();
    slow_inbox.try_iter().for_each(|mail| by_slow.take(&mail));
    stuck_inbox.try_iter().for_each(|mail| by_stuck.take(&mail));

    let facts = TICKS * LOAD as u64;
    let said = TICKS * (SAID * heard.len()) as u64;
    for heard in &heard {
        let heard = heard.lock().unwrap();
        assert_eq!((heard.facts, heard.said), (facts, said));
        assert_eq!(heard.ticks, (1..=TICKS + 1).map(Tick).collect::<Vec<_>>());
    }
    assert_eq!((by_quick.facts, quick_dropped()), (facts, 0));
    // Whole batches are lost, and each is counted.
    for (heard, dropped) in [(&by_slow, slow_dropped()), (&by_stuck, stuck_dropped())] {
        assert_eq!(heard.ticks.len() as u64 + dropped, TICKS);
        assert_eq!(heard.facts, heard.ticks.len() as u64 * LOAD as u64);
    }
    assert_eq!(by_stuck.ticks, [1, 2, 3, 4].map(Tick));
    assert_eq!(by_slow.ticks.len() as u64, TICKS / 3 + 4);
    // Whoever is gone misses nothing.
    assert_eq!(gone_dropped(), 0);
}

#[tokio::test]
async fn more_events_than_the_queue_holds_end_the_tick_with_an_error_that_says_so() {
    let (quiet, heard) = Speaks::new(0, Tick(0));
    let manager = EventManager::new(vec![seat(quiet)], Vec::new()).unwrap();
    let manager = EventManager::spawn_with_mailbox(manager, mailbox::bounded(2));
    seal(&manager, 1, LIMIT).await.unwrap();
    assert_eq!(heard.lock().unwrap().facts, LIMIT as u64);
    let error = seal(&manager, 2, LIMIT + 1).await.unwrap_err();
    assert!(matches!(error, DeliveryError::Full(QueueFull { tick: Tick(2) })), "{error}");
    assert!(error.to_string().contains("the event queue is full at tick 2"), "{error}");
    // Nobody was told half of it.
    assert_eq!(heard.lock().unwrap().facts, LIMIT as u64);
}

fn stage() -> Stage {
    let name = "eight_ball_headless";
    let stage = Stage::new(&load_scene(name).unwrap(), name).unwrap();
    stage.with(Overrides { seed: Some(8), ..Overrides::default() })
}

/// The same game for ten seconds, recorded, while somebody says so much in every tick.
fn played(file: &Path, per_tick: usize) -> (Result<Tick, RunError>, Arc<Mutex<Heard>>, u64) {
    let stage = stage();
    let (speaks, heard) = Speaks::new(per_tick, Tick(400));
    let (window, _inbox, dropped) = sink("window", 4);
    let setup = Setup {
        observers: vec![Box::new(speaks)],
        sinks: vec![Sink { topics: Topics::ALL, ..window }],
        record: Some((file.to_path_buf(), stage.header())),
        ..Setup::headless(Tick(10_000).min(LAST))
    };
    let finished = runtime::run(stage.cast().unwrap(), setup);
    (finished.map(|finished| finished.tick), heard, dropped())
}

#[test]
fn a_flood_changes_no_byte_of_the_recording_and_is_heard_whole() {
    let folder = folder("flood");
    let files = ["quiet", "flood"].map(|name| folder.join(format!("{name}.jsonl")));
    let (quiet, by_quiet, _) = played(&files[0], 0);
    let (flood, by_flood, dropped) = played(&files[1], LOAD);
    assert_eq!(quiet.unwrap(), flood.unwrap());
    let [quiet, flood] = files.map(|file| std::fs::read_to_string(file).unwrap());
    assert!(quiet.lines().count() > 2 && quiet == flood);
    let (by_quiet, by_flood) = (by_quiet.lock().unwrap(), by_flood.lock().unwrap());
    assert!(by_quiet.facts > 0);
    assert_eq!(by_flood.facts, by_quiet.facts);
    assert_eq!(by_flood.said - by_quiet.said, 400 * LOAD as u64);
    assert!(dropped > 300, "the window takes nothing and loses its mail: {dropped}");
}

#[test]
fn a_participant_that_floods_a_game_ends_it_with_an_error_that_says_so() {
    let file = folder("flood_ended").join("game.jsonl");
    let error = played(&file, LIMIT + 1).0.unwrap_err();
    let full = QueueFull { tick: Tick(2) };
    assert!(
        matches!(&error, RunError::Delivery(DeliveryError::Full(at)) if *at == full),
        "{error}"
    );
}

/// Answers when the test lets it.
#[derive(Actor)]
struct Gated {
    begun: UnboundedSender<Tick>,
    gate: UnboundedReceiver<()>,
}

impl Message<Mail> for Gated {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        self.begun.send(mail.0.tick).unwrap();
        self.gate.recv().await.unwrap();
        participant::start(&mut Speaks::new(0, Tick(0)).0, &Snapshot::default())
    }
}

#[tokio::test]
async fn a_participant_that_takes_its_time_is_waited_for_and_gets_all_its_mail_in_order() {
    let ((begun, mut begins), (open, gate)) = (unbounded_channel(), unbounded_channel());
    let gated = Gated::spawn_with_mailbox(Gated { begun, gate }, mailbox::bounded(1));
    let ask = door(gated.clone());
    let mail = |tick| {
        let (events, table) = (Arc::from([]), Arc::default());
        Mail::from(Delivered { tick: Tick(tick), events, table })
    };
    let first = ask(mail(1));
    assert_eq!(begins.recv().await, Some(Tick(1)));
    // One fills the mailbox, and two find it full.
    let others = [2, 3, 4].map(|tick| ask(mail(tick)));
    assert_eq!(gated.mailbox_sender().capacity(), Some(0));
    (0..4).for_each(|_| open.send(()).unwrap());
    first.answer().await.unwrap();
    for other in others {
        other.answer().await.unwrap();
    }
    for tick in 2..=4 {
        assert_eq!(begins.recv().await, Some(Tick(tick)));
    }
}

#[test]
fn news_that_nobody_takes_are_dropped_and_counted() {
    let (way, inbox) = flume::bounded(2);
    let news = News::from(way);
    let health = |dropped| Health::QueueFull { queue: "test".into(), dropped };
    (1..=5).for_each(|number| news.tell(health(number)));
    assert_eq!(news.dropped().load(Ordering::SeqCst), 3);
    assert_eq!(inbox.drain().collect::<Vec<_>>(), [health(1), health(2)]);
    // A game that is over drops nothing.
    drop(inbox);
    news.tell(health(6));
    assert_eq!(news.dropped().load(Ordering::SeqCst), 3);
}

#[test]
fn a_mouse_whose_device_takes_nothing_loses_movements_and_they_are_counted() {
    let opened = open(&HapticDevice::Mouse).unwrap().unwrap();
    let mut mouse = FeltMouse::new(opened.mouse.unwrap());
    let moved = HandInput::Moved { right: 0.1, up: 0.0 };
    for _ in 0..1000 {
        mouse.hear(&moved);
    }
    let room = 1000 - mouse.lost();
    assert!(0 < room && room < 1000, "{room}");
    mouse.hear(&HandInput::Act { action: Action::Stroke, down: true });
    assert_eq!(mouse.lost(), 1001 - room);
}

#[tokio::test]
async fn meters_see_what_waits_and_was_lost_as_long_as_the_queue_is_there() {
    let meters = Meters::default();
    let ((begun, mut begins), (open, gate)) = (unbounded_channel(), unbounded_channel());
    let gated = Gated::spawn_with_mailbox(Gated { begun, gate }, mailbox::bounded(3));
    meters.watch_mailbox("gated", &gated);
    let (slow, inbox, _) = sink("slow", 2);
    meters.watch_sink(&slow);
    let manager = EventManager::new(Vec::new(), vec![slow]).unwrap();
    let manager = EventManager::spawn_with_mailbox(manager, mailbox::bounded(2));
    for tick in 1..=5 {
        seal(&manager, tick, 1).await.unwrap();
    }
    let ask = door(gated.clone());
    let mail = || {
        let (events, table) = (Arc::from([]), Arc::default());
        Mail::from(Delivered { tick: Tick(1), events, table })
    };
    let asked = [ask(mail()), ask(mail())];
    begins.recv().await.unwrap();
    let reading =
        |name: &str, waiting, room, lost| QueueReading { name: name.into(), waiting, room, lost };
    assert_eq!(meters.queues(), [reading("gated", 1, 3, 0), reading("mail slow", 2, 2, 3)]);

    (0..2).for_each(|_| open.send(()).unwrap());
    for asked in asked {
        asked.answer().await.unwrap();
    }
    drop(ask);
    gated.stop_gracefully().await.unwrap();
    gated.wait_for_shutdown().await;
    assert_eq!(inbox.try_iter().count(), 2);
    assert_eq!(meters.queues(), [reading("mail slow", 0, 2, 3)]);
}

#[test]
fn a_game_is_measured_while_somebody_looks_and_is_the_same() {
    let run = |meters: Option<Arc<Meters>>| {
        let setup = Setup { meters, ..Setup::headless(Tick(10_000)) };
        runtime::run(stage().cast().unwrap(), setup).unwrap()
    };
    let [off, on] = [false, true].map(|is_on| {
        let meters = Arc::new(Meters::default());
        meters.switch(is_on);
        meters
    });
    let reference = run(None);
    for meters in [&off, &on] {
        let finished = run(Some(meters.clone()));
        assert_eq!((finished.tick, finished.hash), (reference.tick, reference.hash.clone()));
        // Nobody is left whose mailbox could be looked at.
        assert_eq!(meters.queues(), []);
    }
    assert_eq!((off.ticks().noted(), off.newest()), (0, Tick(0)));
    assert!(on.ticks().noted() > 10 && on.newest() > Tick(1000));
    let begun = |tick: Tick| on.begin_of(tick).is_some();
    assert!(begun(on.newest()) && !begun(on.newest().after(1)));
}
