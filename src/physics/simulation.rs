//! A simulation: a world of balls on a table that anybody can clone, strike and watch.

use super::event_driven::EventDriven;
use super::fixed_step::{CELL_M, FixedStep};
use super::shot::{Shot, Strike, Tracks};
use super::{
    Ledger, Parameters, PhysicsError, PhysicsSettings, Profile, Racks, Snapshot, Solver,
    SolverKind, Work,
};
use crate::ball::{Ball, BallState, Motion};
use crate::events::{Command, Fact, FactSet, Topic};
use crate::hash::StateHash;
use crate::ids::BallId;
use crate::rack::Rack;
use crate::table::Table;
use crate::units::Seconds;
use std::sync::Arc;

/// A shot that has not come to rest by then never will [s].
const LONGEST_SHOT_S: Seconds = 600.0;

/// A world of balls on a table, at one time. A clone is an independent world with the same future;
/// the table is shared. `Send` and `Sync`: many can be run in parallel by whoever wants that.
///
/// ```
/// use hapticbillard::ids::BallId;
/// use hapticbillard::physics::{Simulation, Strike};
/// use hapticbillard::rack::Rack;
/// use hapticbillard::table::Table;
///
/// let table = Table::preset("pool-9ft")?; // or Table::from_mesh(obj_text)?, Table::plane()
/// let start = Simulation::new(table, Rack::eight_ball(7))?;
/// let strike = Strike { speed_m_s: 9.0, azimuth_deg: 0.0, ..Strike::CENTRE };
/// let shot = start.clone().strike(strike)?.run_until_rest()?;
/// println!(
///     "{} facts, {:.1} s, energy residual {:.1e} J",
///     shot.facts.len(),
///     shot.end_s,
///     shot.ledger.residual_j
/// );
/// let path: Vec<_> = shot.trajectory(BallId::CUE).every(0.01).map(|s| s.position).collect();
/// # assert!(path.len() > 100 && shot.ledger.residual_j.abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Simulation {
    engine: Engine,
    now_s: Seconds,
    tip_radius_m: f64,
    racks: Option<Arc<Racks>>,
    is_strict: bool,
}

/// The solvers to choose from.
#[derive(Debug, Clone)]
enum Engine {
    EventDriven(Box<EventDriven>),
    FixedStep(Box<FixedStep>),
}

impl Engine {
    fn solver(&self) -> &dyn Solver {
        match self {
            Engine::EventDriven(solver) => &**solver,
            Engine::FixedStep(solver) => &**solver,
        }
    }

    fn solver_mut(&mut self) -> &mut dyn Solver {
        match self {
            Engine::EventDriven(solver) => &mut **solver,
            Engine::FixedStep(solver) => &mut **solver,
        }
    }
}

impl Simulation {
    /// A rack on a table, with default settings.
    pub fn new(table: Table, rack: Rack) -> Result<Self, PhysicsError> {
        let balls = rack.place(&table)?;
        let racks = Racks::new(rack, Vec::new(), &table);
        Ok(Self::from_parts(&table, balls, &PhysicsSettings::default())?.with_racks(racks))
    }

    /// The same with racks, which [`Command::Rack`] lays down; without them it does nothing.
    #[must_use]
    pub fn with_racks(mut self, racks: Racks) -> Self {
        self.racks = Some(Arc::new(racks));
        self
    }

    /// The same world that keeps where its balls lay before each of the last `shots` shots:
    /// [`Command::Undo`] puts them back there; without a memory it does nothing.
    #[must_use]
    pub fn with_memory(mut self, shots: usize) -> Self {
        self.engine.solver_mut().remember(shots);
        self
    }

    /// The same world for a game in which nobody may take up an object ball: such a
    /// [`Command::PlaceBall`] does nothing.
    #[must_use]
    pub fn with_object_balls_left_alone(mut self) -> Self {
        self.is_strict = true;
        self
    }

    /// Balls on a table, with the given settings and the parameters that these ask for.
    pub fn from_parts(
        table: &Table,
        balls: Vec<(Ball, BallState)>,
        settings: &PhysicsSettings,
    ) -> Result<Self, PhysicsError> {
        Self::with_parameters(table, balls, settings, Parameters::of(settings))
    }

    /// Balls on a table, with parameters of one's own.
    pub fn with_parameters(
        table: &Table,
        balls: Vec<(Ball, BallState)>,
        settings: &PhysicsSettings,
        parameters: Parameters,
    ) -> Result<Self, PhysicsError> {
        let tip_radius_m = parameters.tip_radius_m;
        let engine = match settings.solver {
            SolverKind::EventDriven if settings.profile == Profile::Paper2009 => {
                return Err(PhysicsError::ProfileNeedsSteps);
            }
            SolverKind::EventDriven if !settings.flight && !table.mesh.faces.is_empty() => {
                return Err(PhysicsError::FlightNeeded);
            }
            SolverKind::FixedStep if !settings.flight => {
                return Err(PhysicsError::FlightNeedsEvents);
            }
            SolverKind::EventDriven => {
                let solver = EventDriven::new(table, balls, parameters)?;
                Engine::EventDriven(Box::new(solver))
            }
            SolverKind::FixedStep => {
                let solver = FixedStep::new(table, balls, settings, parameters, CELL_M)?;
                Engine::FixedStep(Box::new(solver))
            }
        };
        Ok(Simulation { engine, now_s: 0.0, tip_radius_m, racks: None, is_strict: false })
    }

    /// Other balls at their start, at time zero, on the same table with the same settings. The
    /// table is shared and not prepared again, which is most of the work of making a simulation.
    ///
    /// ```
    /// use hapticbillard::physics::Simulation;
    /// use hapticbillard::rack::Rack;
    /// use hapticbillard::table::Table;
    ///
    /// let table = Table::preset("pool-9ft")?;
    /// let first = Simulation::new(table.clone(), Rack::nine_ball(0))?;
    /// for seed in 1..10 {
    ///     let other = first.with_balls(Rack::nine_ball(seed).place(&table)?)?;
    ///     assert!(other.is_still());
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_balls(&self, balls: Vec<(Ball, BallState)>) -> Result<Self, PhysicsError> {
        let engine = match &self.engine {
            Engine::EventDriven(solver) => Engine::EventDriven(Box::new(solver.with_balls(balls)?)),
            Engine::FixedStep(solver) => Engine::FixedStep(Box::new(solver.with_balls(balls)?)),
        };
        Ok(Simulation { engine, now_s: 0.0, ..self.clone() })
    }

    /// The time reached [s].
    pub fn now_s(&self) -> Seconds {
        self.now_s
    }

    /// Has a command carried out at `at`, or at the next grid time of the solver.
    pub fn apply(&mut self, at: Seconds, command: &Command) -> Result<(), PhysicsError> {
        match command {
            Command::PlaceBall { ball, .. } if self.is_strict && *ball != BallId::CUE => Ok(()),
            Command::Rack(racking) => {
                if let Some(racks) = &self.racks {
                    let lies = racks.lies(*racking, &self.snapshot(at.max(self.now_s)));
                    self.engine.solver_mut().lay(at, lies);
                }
                Ok(())
            }
            _ => self.engine.solver_mut().apply(at, command),
        }
    }

    /// Runs to `limit`, or to the first fact in `stop`; appends what happened in time order;
    /// returns the time reached. Where it is cut changes no bit.
    pub fn advance(
        &mut self,
        limit: Seconds,
        stop: FactSet,
        facts: &mut Vec<Fact>,
    ) -> Result<Seconds, PhysicsError> {
        let reached = self.engine.solver_mut().advance(limit, stop, facts)?;
        self.now_s = self.now_s.max(reached);
        Ok(reached)
    }

    /// Adds a stroke that hits the cue ball with exactly the given tip speed, as soon as possible.
    pub fn strike(self, strike: Strike) -> Result<Self, PhysicsError> {
        self.strike_ball(BallId::CUE, strike)
    }

    /// The same at another ball: carom has two cue balls.
    pub fn strike_ball(mut self, id: BallId, strike: Strike) -> Result<Self, PhysicsError> {
        let ball = self.sample(id, self.now_s).ok_or(PhysicsError::UnknownBall(id))?;
        let radius_m = match &self.engine {
            Engine::EventDriven(solver) => solver.radius_m(id),
            Engine::FixedStep(solver) => solver.radius_m(id),
        };
        let radius_m = radius_m.ok_or(PhysicsError::UnknownBall(id))?;
        // A command acts at the latest one step from now; the tip must not have set out by then.
        let start_s = self.now_s + self.step_s();
        let stroke = strike.path(ball.position, radius_m, self.tip_radius_m, start_s)?;
        let lift_s = stroke.end_s().unwrap_or(start_s);
        self.apply(self.now_s, &Command::MoveCue(stroke.into()))?;
        self.apply(lift_s, &Command::LiftCue)?;
        Ok(self)
    }

    fn step_s(&self) -> Seconds {
        match &self.engine {
            // A command acts at its own time.
            Engine::EventDriven(_) => 0.0,
            Engine::FixedStep(solver) => solver.step_s(),
        }
    }

    /// Runs until everything has settled and keeps where the balls went.
    pub fn run_until_rest(mut self) -> Result<Shot, PhysicsError> {
        match &mut self.engine {
            Engine::EventDriven(solver) => solver.keep_tracks(),
            Engine::FixedStep(solver) => solver.keep_tracks(),
        }
        let start_s = self.now_s;
        let mut facts = Vec::new();
        let settled = FactSet::of(&[Topic::Settled]);
        loop {
            let limit = self.now_s + 1.0;
            self.advance(limit, settled, &mut facts)?;
            let last = facts.last().map(|fact| fact.kind.topic());
            if last == Some(Topic::Settled) || self.is_still() {
                break;
            }
            if self.now_s - start_s > LONGEST_SHOT_S {
                return Err(PhysicsError::NeverRests { limit_s: LONGEST_SHOT_S });
            }
        }
        let tracks = match &mut self.engine {
            Engine::EventDriven(solver) => Tracks::Segments(solver.take_tracks()),
            Engine::FixedStep(solver) => Tracks::Knots(solver.take_tracks()),
        };
        Ok(Shot {
            facts,
            end_s: self.now_s,
            ledger: self.ledger(),
            work: self.work(),
            ids: self.engine.solver().balls(),
            tracks,
            end: self,
        })
    }

    /// The state of one ball at a time not long before the one reached.
    pub fn sample(&self, ball: BallId, at: Seconds) -> Option<BallState> {
        self.engine.solver().sample(ball, at)
    }

    /// What everybody can see at a time not long before the one reached.
    pub fn snapshot(&self, at: Seconds) -> Snapshot {
        let solver = self.engine.solver();
        Snapshot {
            time_s: at,
            balls: solver.balls().into_iter().filter_map(|ball| solver.sample(ball, at)).collect(),
            cue: solver.cue(at),
        }
    }

    /// The liveliest motion of any ball in play.
    pub fn motion(&self) -> Motion {
        let snapshot = self.snapshot(self.now_s);
        let rank = |motion: Motion| motion as u8;
        snapshot.on_table().map(|ball| ball.motion).max_by_key(|m| rank(*m)).unwrap_or(Motion::Rest)
    }

    /// Whether everything is at rest to the last bit, and nothing is waiting to happen.
    pub fn is_still(&self) -> bool {
        self.engine.solver().is_still()
    }

    /// What was computed so far.
    pub fn work(&self) -> Work {
        self.engine.solver().work()
    }

    /// Energy and momentum so far.
    pub fn ledger(&self) -> Ledger {
        self.engine.solver().ledger()
    }

    /// Adds everything that decides the future to `hash`.
    pub fn hash(&self, hash: &mut StateHash) {
        self.engine.solver().hash(hash);
    }
}
