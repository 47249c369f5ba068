//! A scene run by a method, and judged.

use super::catalogue::{Norm, Scene, Until};
use super::chaos;
use super::method::Method;
use crate::ball::{BallPlace, BallState};
use crate::events::FactSet;
use crate::physics::sample_shots::Start;
use crate::physics::{Parameters, PhysicsError, Simulation, Work};
use crate::table::Table;
use crate::units::Seconds;
use glam::DVec3;

/// How often an error is looked at.
pub(super) const LOOKS: u32 = 32;
/// A ball farther away than this has flown apart [m].
const FAR_M: f64 = 1e4;
/// The disturbance that shows how sure a reference is, relative to the first ball's velocity.
const DISTURBANCE: f64 = 1e-12;

/// A scene with its table, its starts and the truth.
pub struct Prepared {
    /// The scene.
    pub scene: Scene,
    /// How long it is compared [s].
    pub until_s: Seconds,
    /// How far the truth itself may be off [m].
    pub reference_error_m: f64,
    pub(super) table: Table,
    pub(super) starts: Vec<Start>,
    pub(super) truth: Vec<Track>,
}

/// Where the balls went.
#[derive(Debug, Clone, Default)]
pub struct Track {
    /// At each look, each ball.
    pub looks: Vec<Vec<DVec3>>,
    /// At the end, each ball.
    pub places: Vec<BallPlace>,
    /// What was computed.
    pub work: Work,
}

/// A run that did not work.
#[derive(Debug, Clone, PartialEq)]
pub struct Failure {
    /// When it was seen [s].
    pub at_s: Seconds,
    /// How it failed.
    pub how: String,
}

/// What became of a method in a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Status {
    /// Every start was computed.
    Ok,
    /// Some starts failed; this is the first of them.
    Failed(Failure),
    /// It was not run.
    LeftOut(&'static str),
}

/// One row of the table of errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The scene.
    pub scene: &'static str,
    /// The method.
    pub method: Method,
    /// Median over the starts that were computed [m].
    pub error_m: Option<f64>,
    /// Observed order against the next coarser step.
    pub order: Option<f64>,
    /// What was computed for all starts.
    pub work: Work,
    /// What became of it.
    pub status: Status,
}

impl Prepared {
    /// Prepares a scene with at most so many starts.
    ///
    /// # Errors
    /// [`PhysicsError`] if the exact solver, which is the truth or its measure, does not get on.
    pub fn new(scene: Scene, most_starts: usize) -> Result<Self, PhysicsError> {
        let count = scene.starts.min(most_starts).max(1);
        let mut prepared = Prepared {
            scene,
            until_s: 0.0,
            reference_error_m: 0.0,
            table: (scene.table)(),
            starts: (0..count).map(scene.start).collect(),
            truth: Vec::new(),
        };
        prepared.until_s = match scene.until {
            Until::Time(time) => time,
            Until::Horizon(most_s) => {
                let start = prepared.simulation(Method::EventDriven, 0)?;
                let other = prepared.disturbed(0)?;
                chaos::growth_of(start, other, most_s)?.horizon_s
            }
        };
        for start in 0..count {
            let (track, off) = prepared.truth_of(start)?;
            prepared.truth.push(track);
            prepared.reference_error_m = prepared.reference_error_m.max(off);
        }
        Ok(prepared)
    }

    /// How many starts there are.
    pub fn starts(&self) -> usize {
        self.starts.len()
    }

    /// Whether the truth is a closed form.
    pub fn closed_form(&self) -> bool {
        self.scene.answer.is_some()
    }

    pub(super) fn parameters(&self, method: Method) -> Parameters {
        let mut parameters = Parameters::of(&method.settings());
        (self.scene.parameters)(&mut parameters);
        parameters
    }

    /// The world of a start.
    ///
    /// # Errors
    /// [`PhysicsError`] if it is impossible.
    pub fn simulation(&self, method: Method, start: usize) -> Result<Simulation, PhysicsError> {
        self.world(method, self.starts[start].clone())
    }

    fn world(&self, method: Method, balls: Start) -> Result<Simulation, PhysicsError> {
        let parameters = self.parameters(method);
        Simulation::with_parameters(&self.table, balls, &method.settings(), parameters)
    }

    /// The same, the first moving ball faster by a millionth of a millionth.
    fn disturbed(&self, start: usize) -> Result<Simulation, PhysicsError> {
        let mut balls = self.starts[start].clone();
        let moving = balls.iter_mut().find(|(_, state)| state.velocity != DVec3::ZERO);
        if let Some((_, state)) = moving {
            state.velocity *= 1.0 + DISTURBANCE;
        }
        self.world(Method::EventDriven, balls)
    }

    /// Runs a world to the end of the scene and looks where its balls are.
    ///
    /// # Errors
    /// [`Failure`] if the solver gives up or the balls fly apart.
    pub fn watch(&self, mut world: Simulation) -> Result<Track, Failure> {
        let mut track = Track::default();
        let mut facts = Vec::new();
        for look in 1..=LOOKS {
            let at_s = self.look_s(look);
            facts.clear();
            world
                .advance(at_s, FactSet::NONE, &mut facts)
                .map_err(|error| Failure { at_s: world.now_s(), how: error.to_string() })?;
            let balls = world.snapshot(at_s).balls;
            let lost = |ball: &&BallState| !(ball.position.length() < FAR_M);
            if let Some(ball) = balls.iter().find(lost) {
                let how = format!("diverged: ball {} is not within {FAR_M} m", ball.id);
                return Err(Failure { at_s, how });
            }
            track.places = balls.iter().map(|ball| ball.place).collect();
            track.looks.push(balls.iter().map(|ball| ball.position).collect());
        }
        track.work = world.work();
        Ok(track)
    }

    pub(super) fn look_s(&self, look: u32) -> Seconds {
        self.until_s * f64::from(look) / f64::from(LOOKS)
    }

    /// The truth of a start and how far it may be off [m].
    fn truth_of(&self, start: usize) -> Result<(Track, f64), PhysicsError> {
        if let Some(answer) = self.scene.answer {
            let law = self.parameters(Method::EventDriven);
            let look = |look| answer(&self.starts[start], &law, self.look_s(look));
            let looks: Vec<Vec<DVec3>> = (1..=LOOKS).map(look).collect();
            let places = vec![BallPlace::OnTable; self.starts[start].len()];
            // A few roundings of the largest number that occurs.
            let largest = looks.iter().flatten().map(|place| place.length()).fold(0.1, f64::max);
            let off = 16.0 * f64::EPSILON * largest;
            return Ok((Track { looks, places, work: Work::default() }, off));
        }
        let gave_up = |_: Failure| PhysicsError::NeverRests { limit_s: self.until_s };
        let track = self.watch(self.simulation(Method::EventDriven, start)?).map_err(gave_up)?;
        let other = self.watch(self.disturbed(start)?).map_err(gave_up)?;
        let off = self.distance(&track, &other);
        Ok((track, off))
    }

    /// How far two runs are apart [m].
    pub fn distance(&self, one: &Track, other: &Track) -> f64 {
        let looks = one.looks.iter().zip(&other.looks);
        let apart = looks.map(|(one, other)| {
            let squares = one.iter().zip(other).map(|(a, b)| a.distance_squared(*b));
            match self.scene.norm {
                Norm::Worst => squares.fold(0.0, f64::max).sqrt(),
                Norm::MeanSquare => (squares.sum::<f64>() / one.len().max(1) as f64).sqrt(),
            }
        });
        apart.fold(0.0, f64::max)
    }

    /// The error of a run of a start [m].
    ///
    /// # Errors
    /// [`Failure`] if a ball ended in another place than in truth: in a pocket, off the table.
    pub fn error_m(&self, start: usize, run: &Track) -> Result<f64, Failure> {
        let truth = &self.truth[start];
        let ends = run.places.iter().zip(&truth.places).enumerate();
        for (ball, (got, expected)) in ends {
            if got != expected {
                let how = format!("another outcome: ball {ball} {got:?}, not {expected:?}");
                return Err(Failure { at_s: self.until_s, how });
            }
        }
        Ok(self.distance(run, truth))
    }
}

/// The row of a method, given its run of each start.
pub fn judge(prepared: &Prepared, method: Method, runs: &[Result<Track, Failure>]) -> Row {
    let mut work = Work::default();
    let mut errors = Vec::new();
    let mut first = None;
    for (start, run) in runs.iter().enumerate() {
        let judged = run.as_ref().map_err(Failure::clone).and_then(|track| {
            work += track.work;
            prepared.error_m(start, track)
        });
        match judged {
            Ok(error) => errors.push(error),
            Err(failure) => first = first.or(Some(failure)),
        }
    }
    errors.sort_by(f64::total_cmp);
    let mut error_m = errors.get(errors.len() / 2).copied();
    if method == Method::EventDriven && !prepared.closed_form() {
        // It is the reference: its error is how sure that is.
        error_m = Some(prepared.reference_error_m);
    }
    let status = first.map_or(Status::Ok, Status::Failed);
    Row { scene: prepared.scene.id, method, error_m, order: None, work, status }
}

/// The row of a method that is not run.
pub fn left_out(scene: &Scene, method: Method, why: &'static str) -> Row {
    let (error_m, order, work) = (None, None, Work::default());
    Row { scene: scene.id, method, error_m, order, work, status: Status::LeftOut(why) }
}
