//! The runtime: spawns the actors that the scene names, and nothing else.
//!
//! This is the only place that decides who runs where; results do not depend on it. Threads of a
//! headless game: the caller's, which waits, and [`Setup::workers`] of tokio; physics and the
//! recorder have one each where they are asked for. A computer player that searches has a thread
//! while it thinks, and all share workers, one a core.

use crate::ai::{Ai, ThinkAhead};
use crate::conductor::{Below, Conductor, EndRecording, RunError};
use crate::crew::{Crew, MAILBOX};
use crate::event_manager::{EventManager, Sink};
use crate::haptic;
use crate::input::{Hand, Input, StandIn, frame_door};
use crate::kept::{Kept, Saved, Shared};
use crate::meters::{Meters, Watched};
use crate::news::News;
use crate::observer::Observer;
use crate::pacer::{self, StopFlag, Tempo};
use crate::participant::{self, Answer, Mail, Seat, door, kept_door};
use crate::physics::Physics;
use crate::recorder::{Keeper, Open, Recorder};
use crate::rules::Rules;
use crate::sound;
use hapticbillard::ai::Player;
use hapticbillard::cast::Cast;
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::{Header, Line, Recording};
use hapticbillard::tick::{Clock, Finished, FrameSource, Pace, Participant};
use hapticbillard::units::Tick;
use kameo::mailbox;
use kameo::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;

/// How a cast is run.
pub struct Setup {
    /// Whether ticks without news are left out.
    pub pace: Pace,
    /// Whether it keeps to real time.
    pub tempo: Tempo,
    /// The last tick of all.
    pub limit: Tick,
    /// Who acts from outside.
    pub input: InputPort,
    /// Where the recording goes. A game goes on without it; whoever plays is told at once, and a
    /// run without a person ends in an error.
    pub record: Option<(PathBuf, Header)>,
    /// Who writes it.
    pub recorder: Open,
    /// What the run is checked against.
    pub verify: Option<Arc<Recording>>,
    /// Who only watches.
    pub observers: Vec<Box<dyn Participant>>,
    /// Who listens outside the tick.
    pub sinks: Vec<Sink>,
    /// Where the newest state of the world goes, for a picture.
    pub world: Option<triple_buffer::Input<Arc<Snapshot>>>,
    /// Where every fourth state goes, in order, for a film. What does not fit is left out.
    pub film: Option<flume::Sender<Arc<Snapshot>>>,
    /// What is heard. A game goes on without it; whoever plays is told.
    pub sound: Option<Heard>,
    /// What is felt, and at which device. A game goes on without it; whoever plays is told.
    pub haptic: Option<Felt>,
    /// Physics runs on a thread of its own.
    pub physics_thread: bool,
    /// Threads of the tokio runtime, at least 1.
    pub workers: usize,
    /// Ends the game between two ticks.
    pub stop: StopFlag,
    /// Who wants to know of every actor.
    pub crew: Crew,
    /// Where is measured, while somebody looks.
    pub meters: Option<Arc<Meters>>,
}

/// Who acts from outside.
pub enum InputPort {
    /// Nobody.
    None,
    /// A recording or a script.
    StandIn(Box<dyn FrameSource>),
    /// A hand: it hears what happens.
    Hand(Box<dyn Hand>),
}

/// Sound that runs and the way of the balls to it.
pub struct Heard {
    /// The line to the device. It ends with the game.
    pub seat: Arc<sound::Seat>,
    /// The way of the balls.
    pub world: triple_buffer::Input<Arc<Snapshot>>,
}

/// A servo that runs and the way of the balls to it.
pub struct Felt {
    /// The servo. It ends with the game if nobody else holds it.
    pub seat: Arc<haptic::Seat>,
    /// The way of the balls.
    pub world: haptic::WorldPort,
}

/// News for the player that wait at most; see [`News`].
const NEWS: usize = 64;

impl Setup {
    /// As fast as possible, nobody outside, nothing recorded.
    pub fn headless(limit: Tick) -> Self {
        Setup {
            pace: Pace::Jump,
            tempo: Tempo::Free,
            limit,
            input: InputPort::None,
            record: None,
            recorder: Box::new(Recorder::start),
            verify: None,
            observers: Vec::new(),
            sinks: Vec::new(),
            world: None,
            film: None,
            sound: None,
            haptic: None,
            physics_thread: false,
            workers: 1,
            stop: StopFlag::default(),
            crew: Crew::default(),
            meters: None,
        }
    }
}

/// Runs a game to its end; returns when all its actors have stopped.
///
/// # Errors
/// [`RunError`] if the runtime cannot start, an actor is gone, or the game cannot go on.
pub fn run(cast: Cast, setup: Setup) -> Result<Finished, RunError> {
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(setup.workers.max(1))
        .thread_name("game")
        .enable_time()
        .build()
        .map_err(|error| RunError::Start(error.to_string()))?;
    // Everything runs on the workers: a step that had to cross threads would cost a wake-up.
    let game = runtime.spawn(play(cast, setup));
    runtime.block_on(game).map_err(|error| RunError::Start(error.to_string()))?
}

async fn play(cast: Cast, setup: Setup) -> Result<Finished, RunError> {
    let Cast { simulation, referee, players, .. } = cast;
    let table = simulation.snapshot(0.0);

    let meters = setup.meters;
    let crew = Watched { crew: setup.crew, meters: meters.clone() };
    let (tell, news) = flume::bounded(NEWS);
    let tell = News::from(tell);
    if let Some(meters) = &meters {
        meters.watch_news(&tell);
    }

    // Participants, in the order in which they are registered.
    let mut seats = Vec::new();
    seats.extend(
        referee.map(|core| take_seat(core, |core| crew.join("rules", Rules(core)), &table)),
    );
    let thinker = Arc::new(ThinkAhead);
    let players = players.into_iter().map(|core| core.with_thinker(thinker.clone()));
    seats.extend(players.map(|core| keep_player(core, &crew, &tell, &table)));
    let observer = |core| crew.join("observer", Observer(core));
    seats.extend(setup.observers.into_iter().map(|core| take_seat(core, observer, &table)));

    let input = match setup.input {
        InputPort::None => None,
        InputPort::StandIn(source) => {
            let (source, crew) = (Shared::new(source), crew.clone());
            let spawn = move || crew.join("input", StandIn(source.clone()));
            Some(frame_door(Arc::new(Kept::new("input", spawn, tell.clone()))))
        }
        InputPort::Hand(mut core) => {
            let (source, topics) = (core.source(), core.topics());
            let first = participant::start(&mut *core, &table);
            let (core, crew) = (Shared::new(core), crew.clone());
            let spawn = move || crew.join("input", Input(core.clone()));
            let kept = Arc::new(Kept::new("input", spawn, tell.clone()));
            seats.push(Seat { source, topics, first, ask: kept_door(kept.clone()) });
            Some(frame_door(kept))
        }
    };

    let mut sinks = setup.sinks;
    let heard = setup.sound.map(|Heard { seat, world }| {
        sinks.push(seat.sink());
        let crew = crew.clone();
        let joins: sound::Joins = Box::new(move |control| crew.tell(sound::SOUND, control));
        (sound::keep(seat, tell.clone(), joins), world)
    });
    let (sound_keeper, heard_world) = heard.unzip();
    let felt = setup.haptic.map(|Felt { seat, world }| {
        sinks.push(seat.sink());
        let crew = crew.clone();
        let joins: haptic::Joins = Box::new(move |control| crew.tell(haptic::HAPTIC, control));
        (haptic::keep_and_tell(seat, tell, joins), world)
    });
    let (keeper, felt_world) = felt.unzip();
    let signs = keeper.as_ref().map(|keeper| keeper.seat().signs().clone());

    let recording = match setup.record {
        None => None,
        Some((path, header)) => {
            let begun = Keeper::begin(path, Line::Recording(header), setup.recorder).await;
            Some(begun.map_err(|error| RunError::Recording(error.to_string()))?)
        }
    };

    if let Some(meters) = &meters {
        sinks.iter().for_each(|sink| meters.watch_sink(sink));
    }
    let events =
        EventManager::new(seats, sinks).map_err(|error| RunError::Delivery(error.into()))?;
    let clock = Clock::new(setup.pace, setup.limit, events.before_first());
    let events = crew.join("event manager", events);
    let physics = Physics::prepare_with_mailbox(mailbox::bounded(MAILBOX));
    let physics_ref = physics.actor_ref().clone();
    crew.tell("physics", &physics_ref);
    let body = Physics::new(simulation, setup.world, heard_world, felt_world, setup.film);
    if setup.physics_thread {
        physics.spawn_in_thread(body);
    } else {
        physics.spawn(body);
    }
    let below = Below {
        physics: physics_ref.clone(),
        events: events.clone(),
        input,
        recording,
        verify: setup.verify,
        signs,
        news,
    };
    let conductor = crew.join("conductor", Conductor::new(clock, below));

    let finished = pacer::run(&conductor, setup.tempo, &setup.stop, meters.as_deref()).await;
    // A conductor that is gone took its recording with it; what is on disk stays there.
    let lost = conductor.ask(EndRecording).await.ok().and_then(|recorded| recorded.0);

    // From above to below, so that nobody asks somebody who is gone. The participants stop with
    // the event manager, who holds the last reference to them.
    stop(conductor).await;
    stop(physics_ref).await;
    stop(events).await;
    if let Some(keeper) = sound_keeper {
        keeper.end().await;
    }
    if let Some(keeper) = keeper {
        keeper.end().await;
    }
    match (finished, lost) {
        (Ok(_), Some(lost)) if setup.tempo == Tempo::Free => {
            Err(RunError::Recording(lost.to_string()))
        }
        (finished, Some(lost)) => {
            tracing::warn!("{lost}");
            finished
        }
        (finished, None) => finished,
    }
}

async fn stop<A: Actor>(actor: ActorRef<A>) {
    // An actor that has stopped already is what is wanted.
    let _ = actor.stop_gracefully().await;
    actor.wait_for_shutdown().await;
}

fn take_seat<P, A>(mut core: P, spawn: impl FnOnce(P) -> ActorRef<A>, table: &Snapshot) -> Seat
where
    P: Participant,
    A: Message<Mail, Reply = Answer>,
{
    let (source, topics) = (core.source(), core.topics());
    let first = participant::start(&mut core, table);
    Seat { source, topics, first, ask: door(spawn(core)) }
}

/// The same for a computer player, whose actor is replaced when it dies.
fn keep_player(mut core: Player, crew: &Watched, news: &News, table: &Snapshot) -> Seat {
    let (source, topics) = (core.source(), core.topics());
    let first = participant::start(&mut core, table);
    let (core, crew) = (Shared::new(Saved::new(core)), crew.clone());
    let spawn = move || crew.join("ai", Ai(core.clone()));
    let kept = Arc::new(Kept::new("ai", spawn, news.clone()));
    Seat { source, topics, first, ask: kept_door(kept) }
}
