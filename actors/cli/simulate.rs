//! `hapticbillard simulate`: the physics of a scene, and nothing else.

mod batch;

mod bench;

mod print;

use super::{Status, positive};
use clap::{Args, ValueEnum};
use hapticbillard::events::{FactKind, FactSet, Topic};
use hapticbillard::physics::{Integrator, PhysicsSettings, SolverKind};
use hapticbillard::scene::Scene;
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Who waits for rest gives up after this long [s].
const LONGEST_S: f64 = 600.0;
/// How far the simulation runs in one go [s], so that its facts appear while it runs.
const SLICE_S: f64 = 1.0;
/// What ends a run until rest.
const SETTLED: FactSet = FactSet::of(&[Topic::Settled]);

const EXAMPLE: &str = "\
With --json: a line {\"t\",\"balls\":[..]} per sample, a line {\"t\",\"fact\",..} per fact, then the
summary with run time, work, energy and a hash of the final state. Facts can be piped into `rules`.

A line of a --batch file is one shot from the scene's start, all keys optional:
  {\"speed_m_s\":4,\"azimuth_deg\":10,\"elevation_deg\":5,\"side\":0.1,\"height\":-0.2}
With \"balls\":[{\"id\":0,\"position_m\":[0,0,0.028575],\"velocity_m_s\":[2,0,0]},..] it
has balls of its own in place of the scene's, which without speed_m_s go on as they are. The
results come in the order of the file.

Examples:
  hapticbillard simulate --scene break_shot
  hapticbillard simulate --scene one_ball --until 2 --sample 0.1 --json
  hapticbillard simulate --scene break_shot --step-ms 0.1 --integrator rk4 --bench 20
  hapticbillard simulate --bench 200
  hapticbillard simulate --scene free_play --batch shots.jsonl --json > results.jsonl";

/// Runs the physics of a scene, without rules and players.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct SimulateArgs {
    /// A shipped scene (see `scenes`) or a scene file; --bench has shots of its own without one.
    #[arg(long, value_name = "SCENE", required_unless_present = "bench")]
    pub scene: Option<String>,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,

    /// In place of the scene's solver.
    #[arg(long, value_enum)]
    pub solver: Option<SolverName>,

    /// In place of the scene's step of fixed-step, in milliseconds; with --bench that of the
    /// stepper beside an exact solver.
    #[arg(long, value_name = "H", value_parser = step_ms)]
    pub step_ms: Option<f64>,

    /// In place of the scene's integrator of fixed-step; with --bench that of the stepper beside an
    /// exact solver.
    #[arg(long, value_enum)]
    pub integrator: Option<IntegratorName>,

    /// Stops after so many simulated seconds.
    #[arg(long, value_name = "SECONDS", value_parser = positive, conflicts_with = "until_rest")]
    pub until: Option<f64>,

    /// Stops when everything is at rest, after at most 600 s; the default.
    #[arg(long)]
    pub until_rest: bool,

    /// Prints where the balls are, every so many seconds.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub sample: Option<f64>,

    /// Runs the scene's shot so many times, or each shot of --batch once, or without a scene so
    /// many random breaks and small shots, and prints run times beside those of fixed-step.
    #[arg(long, value_name = "N", conflicts_with = "sample",
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub bench: Option<u32>,

    /// Runs the shot in each line of this file from the scene's start, on all cores.
    #[arg(long, value_name = "FILE", conflicts_with = "sample", requires = "scene")]
    pub batch: Option<PathBuf>,

    /// So many threads for --batch, in place of one for each core; no result depends on it.
    #[arg(long, value_name = "N", requires = "batch")]
    pub threads: Option<NonZeroUsize>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// Solvers by their names in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum SolverName {
    /// Exact: closed forms between contacts, contacts as roots of polynomials.
    EventDriven,
    /// The paper's method: fixed steps, contacts found by overlap.
    FixedStep,
}

/// Integrators by their names in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum IntegratorName {
    /// Semi-implicit Euler, the paper's choice.
    EulerCromer,
    /// Velocity Verlet.
    Verlet,
    /// The classical Runge-Kutta method of fourth order.
    Rk4,
}

fn step_ms(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if (0.001..=50.0).contains(&step) => Ok(step),
        _ => Err(String::from("expected milliseconds from 0.001 to 50")),
    }
}

/// Puts what the command line says in place of what the scene says.
fn override_scene(args: &SimulateArgs, scene: &mut Scene) {
    if let Some(seed) = args.seed {
        scene.about.seed = seed;
    }
    override_physics(args, &mut scene.physics);
}

fn override_physics(args: &SimulateArgs, physics: &mut PhysicsSettings) {
    if let Some(solver) = args.solver {
        physics.solver = match solver {
            SolverName::EventDriven => SolverKind::EventDriven,
            SolverName::FixedStep => SolverKind::FixedStep,
        };
    }
    if let Some(step_ms) = args.step_ms {
        physics.step_ms = step_ms;
    }
    if let Some(integrator) = args.integrator {
        physics.integrator = match integrator {
            IntegratorName::EulerCromer => Integrator::EulerCromer,
            IntegratorName::Verlet => Integrator::Verlet,
            IntegratorName::Rk4 => Integrator::Rk4,
        };
    }
}

/// A step or an integrator given to a run that has none, because its solver is exact, would change
/// nothing, and who compares integrators would not see why.
fn check_step(args: &SimulateArgs, physics: &PhysicsSettings) -> Result<(), Error> {
    if physics.solver == SolverKind::FixedStep || args.bench.is_some() {
        return Ok(());
    }
    let given =
        [("--step-ms", args.step_ms.is_some()), ("--integrator", args.integrator.is_some())];
    let Some((option, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
    Err(Error::input(
        option.to_string(),
        String::from("event-driven has no steps, so it would change nothing"),
        "add --solver fixed-step, or leave it out",
    ))
}

/// The scene, with what the command line says about it.
fn stage(args: &SimulateArgs, name: &str) -> Result<Stage, Error> {
    let mut loaded = load_scene(name)?;
    override_scene(args, &mut loaded.scene);
    check_step(args, &loaded.scene.physics)?;
    Stage::new(&loaded, name)
}

/// Simulates.
pub fn run(args: &SimulateArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let stage = args.scene.as_deref().map(|name| stage(args, name)).transpose()?;
    if let Some(shots) = args.bench {
        return bench::run(args, stage.as_ref(), shots, out);
    }
    // The command line sees to it that there is a scene.
    let Some(stage) = stage else { return Ok(Status::CheckFailed) };
    if let Some(file) = &args.batch {
        return batch::run(args, &stage, file, out);
    }
    let simulation = stage.simulation()?;
    let start = thread_cpu_time();
    let mut simulation = simulation;
    let mut time = 0.0;
    let mut samples = 0u32;
    let mut all = 0;
    let settled = loop {
        if let Some(dt) = args.sample {
            while f64::from(samples) * dt <= time {
                print::sample(args.json, &simulation, f64::from(samples) * dt, out)?;
                samples += 1;
            }
        }
        if args.until.is_some_and(|until| until <= time) {
            break false;
        }
        let next_sample = args.sample.map_or(f64::INFINITY, |dt| f64::from(samples) * dt);
        let limit = next_sample.min(args.until.unwrap_or(LONGEST_S)).min(time + SLICE_S);
        let mut facts = Vec::new();
        let stop = if args.until.is_some() { FactSet::NONE } else { SETTLED };
        let reached = simulation.advance(limit, stop, &mut facts)?;
        all += facts.len();
        facts.iter().try_for_each(|fact| print::fact(args.json, fact, out))?;
        let over = facts.iter().any(|fact| matches!(fact.kind, FactKind::Settled { .. }));
        time = if reached < limit && over { reached } else { limit };
        if args.until.is_none() && (over || simulation.is_still()) {
            break true;
        }
        if args.until.is_none() && LONGEST_S <= time {
            break false;
        }
    };
    let cpu_ms = (thread_cpu_time() - start).as_secs_f64() * 1e3;
    print::summary(args.json, &simulation, time, all, cpu_ms, out)?;
    // Asked to run until everything rests, and it did not.
    let failed = !settled && args.until.is_none();
    Ok(if failed { Status::CheckFailed } else { Status::Success })
}
