//! `simulate --bench`: how long shots take, beside the stepper on the same shots in the same run.
//!
//! Processor time of this thread, without making the world: every turn is played once before.
//! Both solvers take turns every few shots, so that whatever else the machine does hits both alike,
//! and neither pays for what the other has left in the caches; trust the ratio.

use super::super::{Status, json_line, progress};
use super::print::{BallLine, balls};
use super::{LONGEST_S, SETTLED, SimulateArgs, batch};
use hapticbillard::events::FactSet;
use hapticbillard::physics::{PhysicsSettings, Simulation, SolverKind, Work, sample_shots};
use hapticbillard::quantile::nearest_rank;
use hapticbillard::table::Table;
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::Stage;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use serde::Serialize;
use std::io::Write;

/// So many shots one solver runs before the other has its turn.
const TURN: usize = 20;

/// The seed of the sample shots, if nobody gives one.
const SEED: u64 = 7;

/// Shots that belong together.
struct Group {
    name: &'static str,
    /// Each shot at its start, and again for the stepper.
    shots: Vec<(Simulation, Option<Simulation>)>,
}

#[derive(Serialize)]
struct ShotLine {
    group: &'static str,
    shot: usize,
    balls: Vec<BallLine>,
    cpu_us: f64,
    events: u64,
}

#[derive(Serialize, Clone, Copy)]
struct Spread {
    mean: f64,
    median: f64,
    p99: f64,
}

#[derive(Serialize)]
struct Report {
    group: &'static str,
    shots: usize,
    cpu_us_per_shot: Spread,
    events_per_shot: f64,
    us_per_event: Option<f64>,
    steps_per_shot: f64,
    simulated_s_per_shot: f64,
    /// All counters.
    work: Work,
    fixed_step: Option<Reference>,
}

/// The stepper on the same shots.
#[derive(Serialize)]
struct Reference {
    cpu_us_per_shot: Spread,
    steps_per_shot: f64,
    /// Its mean time over that of the solver.
    ratio: f64,
}

/// Times [µs] and counts.
#[derive(Default)]
struct Sums {
    times_us: Vec<f64>,
    reference_us: Vec<f64>,
    work: Work,
    reference: Work,
    simulated_s: f64,
}

/// Runs `count` shots of each group and prints processor times.
pub fn run(
    args: &SimulateArgs,
    stage: Option<&Stage>,
    count: u32,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let groups = match stage {
        Some(stage) => vec![of_scene(args, stage, count)?],
        None => samples(args, count)?,
    };
    let total: usize = groups.iter().map(|group| group.shots.len()).sum();
    let bar = progress(total as u64, "shots");
    let mut reports = Vec::new();
    for group in &groups {
        let mut sums = Sums::default();
        for (turn, shots) in group.shots.chunks(TURN).enumerate() {
            // Once for nothing: a table prepares what a ball first comes near, which is a part of
            // making the world, and the stepper has just left the caches full of its own.
            for (start, _) in shots {
                timed(args, start)?;
            }
            for (number, (start, _)) in shots.iter().enumerate() {
                let (cpu_us, end) = timed(args, start)?;
                sums.times_us.push(cpu_us);
                sums.work += end.work();
                sums.simulated_s += end.now_s() - start.now_s();
                if args.json && stage.is_none() {
                    let (balls, events) = (balls(start, start.now_s()), end.work().events);
                    let (group, shot) = (group.name, turn * TURN + number + 1);
                    json_line(out, &ShotLine { group, shot, balls, cpu_us, events })?;
                }
            }
            for (_, reference) in shots {
                if let Some(reference) = reference {
                    let (cpu_us, end) = timed(args, reference)?;
                    sums.reference_us.push(cpu_us);
                    sums.reference += end.work();
                }
                bar.inc(1);
            }
        }
        reports.push(report(group.name, sums));
    }
    bar.finish_and_clear();
    if args.json {
        // One group is the summary; of several each is a part of it.
        return match &reports[..] {
            [one] => json_line(out, &serde_json::json!({ "summary": one })),
            _ => json_line(out, &serde_json::json!({ "summary": { "groups": reports } })),
        }
        .map(|()| Status::Success);
    }
    reports.iter().try_for_each(|report| print(report, out))?;
    Ok(Status::Success)
}

/// The shot of a scene, again and again, or the shots of a file from it.
fn of_scene(args: &SimulateArgs, stage: &Stage, count: u32) -> Result<Group, Error> {
    let start = stage.simulation()?;
    let stepper = match stage.scene.physics.solver {
        SolverKind::FixedStep => None,
        SolverKind::EventDriven => {
            let balls = stage.scene.build_balls(&stage.table)?;
            let settings = stepper(&stage.scene.physics);
            Some(Simulation::from_parts(&stage.table, balls, &settings)?)
        }
    };
    let Some(file) = &args.batch else {
        let shots = (0..count).map(|_| (start.clone(), stepper.clone())).collect();
        return Ok(Group { name: "scene", shots });
    };
    let mut shots = Vec::new();
    for (line, setup) in batch::read(stage, file)? {
        let begin = |start: &Simulation| {
            setup.begin(start).map_err(|error| batch::wrong(file, line, error))
        };
        shots.push((begin(&start)?, stepper.as_ref().map(begin).transpose()?));
    }
    Ok(Group { name: "batch", shots })
}

fn stepper(settings: &PhysicsSettings) -> PhysicsSettings {
    PhysicsSettings { solver: SolverKind::FixedStep, flight: true, ..settings.clone() }
}

/// Breaks and small shots on the nine-foot table, and on what is left of it when a scene needs
/// neither mesh nor pockets nor flight.
fn samples(args: &SimulateArgs, count: u32) -> Result<Vec<Group>, Error> {
    let table = Table::preset("pool-9ft").map_err(|error| {
        Error::input(String::from("pool-9ft"), error.to_string(), "name a scene with --scene")
    })?;
    let planar = sample_shots::planar(&table);
    let mut groups = on_table(args, count, &table, ["break", "small"])?;
    groups.extend(on_table(args, count, &planar, ["planar break", "planar small"])?);
    Ok(groups)
}

/// A group of breaks and one of small shots on a table.
fn on_table(
    args: &SimulateArgs,
    count: u32,
    table: &Table,
    names: [&'static str; 2],
) -> Result<Vec<Group>, Error> {
    let mut settings = PhysicsSettings::default();
    super::override_physics(args, &mut settings);
    // Where there is nothing to fall from, the exact solver leaves flight out.
    settings.flight = settings.solver == SolverKind::FixedStep || !table.mesh.faces.is_empty();
    let empty = Simulation::from_parts(table, Vec::new(), &settings)?;
    let stepper = match settings.solver {
        SolverKind::FixedStep => None,
        SolverKind::EventDriven => {
            Some(Simulation::from_parts(table, Vec::new(), &stepper(&settings))?)
        }
    };
    let mut groups = Vec::new();
    for name in names {
        let mut random = Pcg64::seed_from_u64(args.seed.unwrap_or(SEED));
        let mut first: Option<Simulation> = None;
        let mut shots = Vec::new();
        for _ in 0..count {
            let balls = if name == names[0] {
                sample_shots::break_shot(table, &mut random)
            } else {
                sample_shots::small_shot(table, &mut random)
            };
            let balls = balls.map_err(hapticbillard::physics::PhysicsError::from)?;
            // Made once for balls of this size, then shared.
            let like = first.as_ref().unwrap_or(&empty);
            let shot = like.with_balls(balls.clone())?;
            let reference = stepper.as_ref().map(|start| start.with_balls(balls)).transpose()?;
            first.get_or_insert_with(|| shot.clone());
            shots.push((shot, reference));
        }
        groups.push(Group { name, shots });
    }
    Ok(groups)
}

/// Runs a shot; processor time [µs] and the world after it.
fn timed(args: &SimulateArgs, start: &Simulation) -> Result<(f64, Simulation), Error> {
    let mut simulation = start.clone();
    let mut facts = Vec::new();
    let (limit, stop) = match args.until {
        Some(until) => (until, FactSet::NONE),
        None => (LONGEST_S, SETTLED),
    };
    let begin = thread_cpu_time();
    simulation.advance(limit, stop, &mut facts)?;
    Ok(((thread_cpu_time() - begin).as_secs_f64() * 1e6, simulation))
}

fn report(group: &'static str, sums: Sums) -> Report {
    let shots = sums.times_us.len();
    let n = shots as f64;
    let time = spread(sums.times_us);
    let events = sums.work.events;
    let fixed_step = (!sums.reference_us.is_empty()).then(|| {
        let cpu_us_per_shot = spread(sums.reference_us);
        let ratio = cpu_us_per_shot.mean / time.mean;
        Reference { cpu_us_per_shot, steps_per_shot: sums.reference.steps as f64 / n, ratio }
    });
    Report {
        group,
        shots,
        cpu_us_per_shot: time,
        events_per_shot: events as f64 / n,
        us_per_event: (events > 0).then(|| time.mean * n / events as f64),
        steps_per_shot: sums.work.steps as f64 / n,
        simulated_s_per_shot: sums.simulated_s / n,
        work: sums.work,
        fixed_step,
    }
}

fn spread(mut times_us: Vec<f64>) -> Spread {
    times_us.sort_by(f64::total_cmp);
    let n = times_us.len() as f64;
    let at = |share: f64| nearest_rank(&times_us, share).unwrap_or(0.0);
    Spread { mean: times_us.iter().sum::<f64>() / n, median: at(0.5), p99: at(0.99) }
}

fn print(report: &Report, out: &mut dyn Write) -> Result<(), Error> {
    let Spread { mean, median, p99 } = report.cpu_us_per_shot;
    writeln!(
        out,
        "{:<12} {} shots of {:.2} s: {mean:.1} us of processor time each (mean; median \
         {median:.1}, 99 % below {p99:.1})",
        report.group, report.shots, report.simulated_s_per_shot
    )?;
    let n = report.shots as f64;
    let each = |count: u64| count as f64 / n;
    let work = &report.work;
    writeln!(
        out,
        "             a shot: {:.1} events, {:.3} us each; {:.1} contacts, {:.1} steps, {:.1} pair \
         and {:.1} face tests",
        report.events_per_shot,
        report.us_per_event.unwrap_or(0.0),
        each(work.contacts),
        each(work.steps),
        each(work.pair_tests),
        each(work.face_tests)
    )?;
    if let Some(reference) = &report.fixed_step {
        let Spread { mean, median, .. } = reference.cpu_us_per_shot;
        writeln!(
            out,
            "             fixed-step, same shots: {mean:.1} us (mean; median {median:.1}), {:.0} \
             steps; {:.1} times as long",
            reference.steps_per_shot, reference.ratio
        )?;
    }
    Ok(())
}
