//! The actor that owns the logical clock: does what [`Clock`] says, one tick a message.
//!
//! Asks run down a tree: conductor → input, physics, event manager; event manager → participants.
//! Nobody asks upwards or sideways. A [`Step`] does one tick and returns, so that a message to stop
//! or to pause is read between any two ticks; who wants time to run sends steps (see
//! [`crate::pacer`]).

use crate::event_manager::{DeliveryError, EventManager, Seal};
use crate::haptic::Signs;
use crate::input::AskFrame;
use crate::physics::{Advance, Coast, Moved, Physics};
use crate::recorder::{Keeper, Lost};
use hapticbillard::events::Health;
use hapticbillard::hash::Digest;
use hapticbillard::lockstep::LockstepError;
use hapticbillard::physics::{PhysicsError, Snapshot};
use hapticbillard::replay::{Divergence, Line, Recording, TickHash};
use hapticbillard::tick::{Advanced, Clock, End, Finished, Frame, Inflow, Next};
use hapticbillard::units::Tick;
use kameo::prelude::*;
use std::sync::Arc;
use tracing::{Instrument, Span};

/// Why a run stopped before its end.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The simulation cannot go on.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// A tick could not be delivered.
    #[error(transparent)]
    Delivery(#[from] DeliveryError),
    /// A replay is not what was recorded.
    #[error(transparent)]
    Diverged(#[from] Divergence),
    /// An actor is gone.
    #[error("the {actor} actor stopped at tick {}: {reason}", tick.0)]
    Gone {
        /// Which.
        actor: &'static str,
        /// When.
        tick: Tick,
        /// Why.
        reason: String,
    },
    /// The recording cannot be written, or not to its end.
    #[error("the recording cannot be written: {0}")]
    Recording(String),
    /// The runtime itself cannot start.
    #[error("the actor runtime cannot start: {0}")]
    Start(String),
}

impl From<LockstepError> for RunError {
    fn from(error: LockstepError) -> Self {
        match error {
            LockstepError::Physics(error) => RunError::Physics(error),
            LockstepError::Full(error) => RunError::Delivery(error.into()),
            LockstepError::Diverged(divergence) => RunError::Diverged(divergence),
        }
    }
}

/// Who is below the conductor.
pub struct Below {
    /// The simulation.
    pub physics: ActorRef<Physics>,
    /// The event manager.
    pub events: ActorRef<EventManager>,
    /// Whoever acts from outside, or stands in for them.
    pub input: Option<AskFrame>,
    /// Hands the recording over to whoever writes it.
    pub recording: Option<Keeper>,
    /// What to check the run against.
    pub verify: Option<Arc<Recording>>,
    /// Who wants to know that time stands still on purpose: a haptic servo.
    pub signs: Option<Arc<Signs>>,
    /// What the player should be told about the runtime, from outside the tick.
    pub news: flume::Receiver<Health>,
}

/// Owns the clock.
#[derive(Actor)]
pub struct Conductor {
    clock: Clock,
    below: Below,
    /// Asked from the input before the first tick; none while nothing is known.
    next_frame: Option<Tick>,
    primed: bool,
    /// What entered while time stood still: it is due in the first tick after that.
    held: Frame,
    /// What the runtime has to tell about itself, with the next mail.
    health: Vec<Health>,
    /// Whoever acts would rather not wait.
    hurried: bool,
    last: Last,
    verified: u64,
    shot: Span,
}

#[derive(Default)]
struct Last {
    table: Arc<Snapshot>,
    physics: Digest,
    hash: Option<TickHash>,
}

impl Conductor {
    /// A conductor before the first tick.
    pub fn new(clock: Clock, below: Below) -> Self {
        let last = Last::default();
        Conductor {
            clock,
            below,
            next_frame: None,
            primed: false,
            held: Frame::new(),
            health: Vec::new(),
            hurried: false,
            last,
            verified: 0,
            shot: Span::none(),
        }
    }
}

/// Do one tick.
pub struct Step;

/// How far the game is.
#[derive(Debug, Clone, PartialEq)]
pub enum Progress {
    /// It goes on.
    Running,
    /// It goes on, and whoever acts would rather not wait.
    Hurried,
    /// Time stands still.
    Paused,
    /// It is over.
    Finished(Finished),
}

/// What a step did.
#[derive(Debug, Reply)]
pub struct Stepped(pub Result<(Tick, Progress), RunError>);

impl Message<Step> for Conductor {
    type Reply = Stepped;

    async fn handle(&mut self, _: Step, _: &mut Context<Self, Stepped>) -> Stepped {
        let shot = self.shot.clone();
        let progress = self.step().instrument(shot).await;
        Stepped(progress.map(|progress| (self.clock.now(), progress)))
    }
}

/// End the game here.
pub struct Quit;

impl Message<Quit> for Conductor {
    type Reply = Stepped;

    async fn handle(&mut self, _: Quit, _: &mut Context<Self, Stepped>) -> Stepped {
        self.clock.quit();
        let progress = self.finish(End::Quit).await;
        Stepped(progress.map(|progress| (self.clock.now(), progress)))
    }
}

/// End the recording: wait until its actor has stopped.
pub struct EndRecording;

/// What is missing in it, if anything.
#[derive(Debug, Reply)]
pub struct Recorded(pub Option<Lost>);

impl Message<EndRecording> for Conductor {
    type Reply = Recorded;

    async fn handle(&mut self, _: EndRecording, _: &mut Context<Self, Recorded>) -> Recorded {
        match self.below.recording.take() {
            Some(recording) => Recorded(recording.end().await),
            None => Recorded(None),
        }
    }
}

impl Conductor {
    /// One tick, from frame to answers; or a coast that met nothing.
    async fn step(&mut self) -> Result<Progress, RunError> {
        self.health.extend(self.below.news.try_iter());
        if !self.primed {
            self.primed = true;
            self.inflow(Tick(0)).await?;
        }
        match self.clock.next(self.next_frame) {
            Next::Coast { limit, stop } => {
                let moved = self.below.physics.ask(Coast { limit, stop }).await;
                let reached = self.moved(moved)?;
                if let Some(seal) = self.clock.coasted(reached.tick, reached.facts) {
                    self.seal(seal).await?;
                }
            }
            Next::Frame(tick) => {
                let mut inflow = self.inflow(tick).await?;
                if inflow.quit {
                    self.clock.quit();
                    return self.finish(End::Quit).await;
                }
                if inflow.paused {
                    tracing::debug!("time stands still from tick {} on", tick.0);
                    self.clock.pause();
                }
                inflow.frame.insert_many(0, self.held.drain(..));
                if !inflow.frame.is_empty() {
                    // On disk before it is used.
                    self.record(Line::Frame { tick, publish: inflow.frame.clone() }).await;
                }
                let Next::Advance { tick, commands } = self.clock.framed(tick, inflow.frame) else {
                    return Ok(Progress::Running);
                };
                let moved = self.below.physics.ask(Advance { tick, commands }).await;
                let reached = self.moved(moved)?;
                if let Some(seal) = self.clock.advanced(reached.facts) {
                    self.seal(seal).await?;
                }
            }
            Next::Paused => {
                // Menus can be felt.
                if let Some(signs) = &self.below.signs {
                    signs.beat();
                }
                let inflow = self.inflow(self.clock.now().after(1)).await?;
                if inflow.quit {
                    self.clock.quit();
                    return self.finish(End::Quit).await;
                }
                self.held.extend(inflow.frame);
                if !inflow.paused {
                    self.clock.resume();
                }
                return Ok(Progress::Paused);
            }
            Next::Finished(end) => return self.finish(end).await,
            Next::Advance { .. } | Next::Seal { .. } => {}
        }
        Ok(if self.hurried { Progress::Hurried } else { Progress::Running })
    }

    async fn inflow(&mut self, tick: Tick) -> Result<Inflow, RunError> {
        let Some(input) = &self.below.input else {
            return Ok(Inflow::default());
        };
        let inflow = input(tick).await.map_err(|reason| self.gone("input", reason))?;
        self.next_frame = inflow.next;
        self.hurried = inflow.hurried;
        Ok(inflow)
    }

    fn moved<E: std::fmt::Display>(
        &mut self,
        answer: Result<Moved, E>,
    ) -> Result<Advanced, RunError> {
        let reached = answer.map_err(|e| self.gone("physics", e))?.0?;
        self.last.table = reached.table.clone();
        self.last.physics = reached.digest;
        Ok(reached)
    }

    async fn seal(&mut self, seal: Next) -> Result<(), RunError> {
        let Next::Seal { tick, frame, facts } = seal else {
            return Ok(());
        };
        let table = self.last.table.clone();
        let health = std::mem::take(&mut self.health);
        let seal = Seal { tick, frame, facts, health, table };
        let answer = self.below.events.ask(seal).await;
        let delivery = answer.map_err(|e| self.gone("event manager", e))?.0?;
        let hash = TickHash::new(tick, self.last.physics, delivery.digests, &self.last.table);
        if let Some(recorded) = self.below.verify.as_ref().and_then(|r| r.hashes.get(&tick)) {
            if let Some(divergence) = hash.divergence(recorded) {
                return Err(divergence.into());
            }
            self.verified += 1;
        }
        if delivery.fact {
            self.record(Line::Hash(hash.clone())).await;
        }
        self.last.hash = Some(hash);
        self.shot = delivery.shot;
        self.clock.sealed(delivery.sealed);
        Ok(())
    }

    /// Waits until the line is on disk. A game goes on without its recording.
    async fn record(&mut self, line: Line) {
        if let Some(recording) = &mut self.below.recording {
            self.health.extend(recording.record(line).await);
        }
    }

    async fn finish(&mut self, end: End) -> Result<Progress, RunError> {
        let tick = self.clock.now();
        if let Some(recording) = &self.below.verify {
            recording.check_end(tick, end, self.verified)?;
        }
        self.record(Line::End { tick, reason: end }).await;
        tracing::info!("the game ends at tick {}: {end:?}", tick.0);
        let hash = self.last.hash.clone();
        Ok(Progress::Finished(Finished { end, tick, hash, verified: self.verified }))
    }

    fn gone(&self, actor: &'static str, error: impl std::fmt::Display) -> RunError {
        RunError::Gone { actor, tick: self.clock.now(), reason: error.to_string() }
    }
}
