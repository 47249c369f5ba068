//! Runs every method on a scene, under a stopwatch.

use hapticbillard::events::FactSet;
use hapticbillard::physics::Simulation;
use hapticbillard::report::{self, Failure, Method, Prepared, Row, Scene, Track};
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use indicatif::ProgressBar;

/// A start is run again until it has taken so long in all [s], so that short ones can be timed.
const ENOUGH_S: f64 = 2e-3;
/// But not more often than this.
const REPEATS_MAX: usize = 20;
/// What a row may take, at least one start included [s]; a quick report's, and else.
const QUICK_ROW_S: f64 = 0.4;
const ROW_S: f64 = 2.5;
/// Most starts of a scene in a quick report.
const QUICK_STARTS: usize = 3;

/// All rows of a scene.
pub struct Measured {
    /// The scene with its truth.
    pub prepared: Prepared,
    /// A row for each method and step.
    pub rows: Vec<Timed>,
}

impl Measured {
    /// The rows without their times.
    pub fn plain(&self) -> Vec<Row> {
        self.rows.iter().map(|timed| timed.row.clone()).collect()
    }
}

/// A row and its processor times.
pub struct Timed {
    /// The row.
    pub row: Row,
    /// Processor time per simulated second [µs]; none if it was not run.
    pub cpu_us: Option<Spread>,
    /// How many starts were run.
    pub starts: usize,
}

impl Timed {
    fn unmeasured(row: Row) -> Self {
        Timed { row, cpu_us: None, starts: 0 }
    }
}

/// A middle, and how far to both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Half are smaller.
    pub median: f64,
    /// The smallest.
    pub least: f64,
    /// The largest.
    pub most: f64,
}

/// Most starts of a scene.
pub fn most_starts(quick: bool) -> usize {
    if quick { QUICK_STARTS } else { usize::MAX }
}

/// Patience for so much processor time [s].
pub fn budget(seconds: f64) -> impl FnMut() -> bool {
    let begin = thread_cpu_time();
    move || (thread_cpu_time() - begin).as_secs_f64() < seconds
}

/// Measures a scene.
pub fn scene(scene: Scene, quick: bool, bar: &ProgressBar) -> Result<Measured, Error> {
    let prepared = Prepared::new(scene, most_starts(quick))?;
    let least_ms = scene.least_step_ms[usize::from(!quick)];
    let row_s = if quick { QUICK_ROW_S } else { ROW_S };
    let mut rows: Vec<Timed> = Vec::new();
    for method in report::all_methods() {
        bar.set_message(scene.id);
        let too_slow = |timed: &Timed| {
            timed.row.method.name() == method.name() && timed.row.status.is_too_slow()
        };
        let left_out = |why| Timed::unmeasured(report::left_out(&scene, method, why));
        rows.push(if method.step_ms().is_some_and(|step| step < least_ms) {
            left_out(if quick { "too dear for a quick report" } else { "too dear" })
        } else if rows.iter().any(too_slow) {
            left_out("a coarser step was too slow")
        } else {
            time(&prepared, method, row_s)?
        });
        bar.inc(1);
    }
    let mut plain: Vec<Row> = rows.iter().map(|timed| timed.row.clone()).collect();
    report::orders(&mut plain, prepared.reference_error_m);
    for (timed, row) in rows.iter_mut().zip(plain) {
        timed.row = row;
    }
    Ok(Measured { prepared, rows })
}

/// A method on all starts, or on as many as can be run in `row_s` of processor time.
fn time(prepared: &Prepared, method: Method, row_s: f64) -> Result<Timed, Error> {
    let mut times = Vec::new();
    let mut runs: Vec<Result<Track, Failure>> = Vec::new();
    let mut patience = budget(row_s);
    for start in 0..prepared.starts() {
        let world = prepared.simulation(method, start)?;
        let begin = thread_cpu_time();
        let track = prepared.watch_while(world.clone(), &mut patience);
        let took = (thread_cpu_time() - begin).as_secs_f64();
        let stopped = track.as_ref().is_err_and(|failure| failure.stopped);
        if stopped && !runs.is_empty() {
            break;
        }
        if track.is_ok() && took > ENOUGH_S {
            times.push(took * 1e6 / prepared.until_s);
        } else if track.is_ok() {
            times.extend(short_times(prepared, &world)?);
        }
        runs.push(track);
        if stopped {
            break;
        }
    }
    times.sort_by(f64::total_cmp);
    let cpu_us = match (times.first(), times.get(times.len() / 2), times.last()) {
        (Some(least), Some(median), Some(most)) => {
            Some(Spread { median: *median, least: *least, most: *most })
        }
        _ => None,
    };
    Ok(Timed { row: report::judge(prepared, method, &runs), cpu_us, starts: runs.len() })
}

/// Times of a short run, again and again and without anybody looking where the balls are.
fn short_times(prepared: &Prepared, world: &Simulation) -> Result<Vec<f64>, Error> {
    let (mut times, mut spent) = (Vec::new(), 0.0);
    let mut facts = Vec::new();
    while times.is_empty() || (times.len() < REPEATS_MAX && spent < ENOUGH_S) {
        let mut world = world.clone();
        facts.clear();
        let begin = thread_cpu_time();
        world.advance(prepared.until_s, FactSet::NONE, &mut facts)?;
        let took = (thread_cpu_time() - begin).as_secs_f64();
        times.push(took * 1e6 / prepared.until_s);
        spent += took;
    }
    Ok(times)
}
