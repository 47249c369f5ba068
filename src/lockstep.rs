//! Lockstep: all cores in one thread, in virtual time. It is the reference: the actor runtime must
//! give the same facts, the same verdicts and the same hashes.

use crate::cast::Cast;
use crate::event_manager::{EventManager, QueueFull, SubscriberId};
use crate::events::{Event, Source};
use crate::hash::{Digest, StateHash};
use crate::physics::{PhysicsError, Simulation, Snapshot};
use crate::replay::{Divergence, Line, Recording, TickHash};
use crate::tick::{
    self, Advanced, Clock, Delivered, Finished, FrameSource, Inflow, Next, Pace, Participant,
};
use crate::units::Tick;
use std::sync::Arc;

/// How a cast is run.
pub struct Setup<'a> {
    /// Whether ticks without news are left out.
    pub pace: Pace,
    /// The last tick of all.
    pub limit: Tick,
    /// Who acts from outside.
    pub input: Option<Box<dyn FrameSource>>,
    /// Takes the lines of the recording, as they are written.
    pub record: Option<&'a mut dyn FnMut(&Line)>,
    /// What the run is checked against.
    pub verify: Option<Arc<Recording>>,
    /// Who only watches: tallies, logs, progress. They take part but publish nothing.
    pub observers: Vec<Box<dyn Participant>>,
}

impl Setup<'_> {
    /// As fast as possible, nobody outside, nothing recorded.
    pub fn headless(limit: Tick) -> Self {
        Setup {
            pace: Pace::Jump,
            limit,
            input: None,
            record: None,
            verify: None,
            observers: Vec::new(),
        }
    }
}

/// Why a run stopped before its end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LockstepError {
    /// The simulation cannot go on.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// Too many events.
    #[error(transparent)]
    Full(#[from] QueueFull),
    /// A replay is not what was recorded.
    #[error(transparent)]
    Diverged(#[from] Divergence),
}

/// A game that runs inline.
pub struct Lockstep<'a> {
    clock: Clock,
    events: EventManager,
    simulation: Simulation,
    participants: Vec<(SubscriberId, Box<dyn Participant>)>,
    setup: Setup<'a>,
    next_frame: Option<Tick>,
    last: Advanced,
    hash: Option<TickHash>,
    verified: u64,
}

/// Runs a game to its end.
///
/// # Errors
/// [`LockstepError`] if the simulation fails, the queue is full or a replay diverges.
///
/// # Examples
/// Two computer players, a referee and a table; the scene says it all.
///
/// ```
/// use hapticbillard::cast::Cast;
/// use hapticbillard::lockstep::{Setup, run};
/// use hapticbillard::scene::Scene;
/// use hapticbillard::shipped;
/// use hapticbillard::tally::Scorer;
/// use hapticbillard::units::Tick;
/// use std::sync::Arc;
///
/// let text = shipped::scene("eight_ball_headless").ok_or("no such scene")?;
/// let scene = Scene::parse("eight_ball_headless.toml", text)?;
/// let table = scene.build_table(&mut |file| Err(format!("there is no {file}")))?;
/// let scorer = Scorer::default();
/// let mut setup = Setup::headless(Tick(3_600_000)); // an hour of game time
/// setup.observers.push(Box::new(scorer.clone()));
/// let finished = run(Cast::new(&scene, Arc::new(table))?, setup)?;
/// let tally = scorer.tally();
/// println!("player {:?} won after {} s", tally.winner, finished.tick.end_s());
/// # assert!(tally.over && finished.hash.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(cast: Cast, setup: Setup<'_>) -> Result<Finished, LockstepError> {
    let mut game = Lockstep::new(cast, setup)?;
    loop {
        if let Some(finished) = game.step()? {
            return Ok(finished);
        }
    }
}

impl<'a> Lockstep<'a> {
    /// A game before its first tick.
    ///
    /// # Errors
    /// [`LockstepError`] if the participants publish too much at the start.
    pub fn new(cast: Cast, mut setup: Setup<'a>) -> Result<Self, LockstepError> {
        let Cast { simulation, referee, players, .. } = cast;
        let table = simulation.snapshot(0.0);
        let mut cores: Vec<Box<dyn Participant>> = Vec::new();
        cores.extend(referee.map(|core| Box::new(core) as Box<dyn Participant>));
        cores.extend(players.into_iter().map(|core| Box::new(core) as Box<dyn Participant>));
        cores.append(&mut setup.observers);

        let mut events = EventManager::new();
        let mut participants = Vec::new();
        for mut core in cores {
            let id = events.register(core.source(), core.topics());
            let outcome = core.start(&table);
            events.answer(id, Tick(0), outcome, digest(&*core))?;
            participants.push((id, core));
        }
        let next_frame = setup.input.as_mut().and_then(|input| input.inflow(Tick(0)).next);
        let clock = Clock::new(setup.pace, setup.limit, events.sealed());
        let mut hash = StateHash::new();
        simulation.hash(&mut hash);
        let last = Advanced {
            tick: Tick(0),
            facts: Vec::new(),
            table: Arc::new(table),
            digest: hash.finish(),
        };
        Ok(Lockstep {
            clock,
            events,
            simulation,
            participants,
            setup,
            next_frame,
            last,
            hash: None,
            verified: 0,
        })
    }

    /// The visible world after the last tick.
    pub fn table(&self) -> &Arc<Snapshot> {
        &self.last.table
    }

    /// One tick, from frame to answers; says how the game ended, once it has.
    ///
    /// # Errors
    /// As [`run`].
    pub fn step(&mut self) -> Result<Option<Finished>, LockstepError> {
        match self.clock.next(self.next_frame) {
            Next::Coast { limit, stop } => {
                let mut reached = tick::coast(&mut self.simulation, limit, stop)?;
                let facts = std::mem::take(&mut reached.facts);
                self.last = reached;
                if let Some(seal) = self.clock.coasted(self.last.tick, facts) {
                    self.seal(seal)?;
                }
            }
            Next::Frame(tick) => {
                let inflow = self.inflow(tick);
                if inflow.quit {
                    self.clock.quit();
                    return Ok(None);
                }
                if !inflow.frame.is_empty() {
                    self.record(Line::Frame { tick, publish: inflow.frame.clone() });
                }
                if let Next::Advance { tick, commands } = self.clock.framed(tick, inflow.frame) {
                    let mut reached = tick::advance(&mut self.simulation, tick, &commands)?;
                    let facts = std::mem::take(&mut reached.facts);
                    self.last = reached;
                    if let Some(seal) = self.clock.advanced(facts) {
                        self.seal(seal)?;
                    }
                }
            }
            Next::Finished(end) => {
                let tick = self.clock.now();
                if let Some(recording) = &self.setup.verify {
                    recording.check_end(tick, end, self.verified)?;
                }
                self.record(Line::End { tick, reason: end });
                let (hash, verified) = (self.hash.clone(), self.verified);
                return Ok(Some(Finished { end, tick, hash, verified }));
            }
            // Nobody pauses a game that has no clock of its own.
            Next::Paused => self.clock.resume(),
            Next::Advance { .. } | Next::Seal { .. } => {}
        }
        Ok(None)
    }

    fn inflow(&mut self, tick: Tick) -> Inflow {
        let Some(input) = &mut self.setup.input else {
            return Inflow::default();
        };
        let inflow = input.inflow(tick);
        self.next_frame = inflow.next;
        inflow
    }

    fn seal(&mut self, seal: Next) -> Result<(), LockstepError> {
        let Next::Seal { tick, frame, facts } = seal else {
            return Ok(());
        };
        for publication in frame {
            self.events.publish(Source::Input, tick, publication)?;
        }
        let facts = facts.into_iter().map(Event::Fact);
        self.events.publish_now(Source::Physics, tick, facts)?;

        let mut fact = false;
        for delivery in self.events.seal(tick) {
            fact |= delivery.events.iter().any(|stamped| matches!(stamped.event, Event::Fact(_)));
            let Some((_, core)) = self.participants.iter_mut().find(|(id, _)| *id == delivery.to)
            else {
                continue;
            };
            let table = self.last.table.clone();
            let outcome = core.collect(&Delivered { tick, events: delivery.events, table });
            let digest = digest(&**core);
            self.events.answer(delivery.to, tick, outcome, digest)?;
        }
        let hash = TickHash::new(tick, self.last.digest, self.events.digests(), &self.last.table);
        if let Some(recorded) = self.setup.verify.as_ref().and_then(|r| r.hashes.get(&tick)) {
            if let Some(divergence) = hash.divergence(recorded) {
                return Err(divergence.into());
            }
            self.verified += 1;
        }
        if fact {
            self.record(Line::Hash(hash.clone()));
        }
        self.hash = Some(hash);
        self.clock.sealed(self.events.sealed());
        Ok(())
    }

    fn record(&mut self, line: Line) {
        if let Some(record) = &mut self.setup.record {
            record(&line);
        }
    }
}

fn digest(core: &dyn Participant) -> Digest {
    let mut hash = StateHash::new();
    core.hash(&mut hash);
    hash.finish()
}
