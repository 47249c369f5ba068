//! Runs every method on a scene, under a stopwatch.

use hapticbillard::report::{self, Method, Prepared, Row, Scene};
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use indicatif::ProgressBar;

/// A start is run again until it has taken so long in all [s], so that short ones can be timed.
const ENOUGH_S: f64 = 2e-3;
/// But not more often than this.
const REPEATS_MAX: u32 = 20;
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

/// Measures a scene.
pub fn scene(scene: Scene, quick: bool, bar: &ProgressBar) -> Result<Measured, Error> {
    let prepared = Prepared::new(scene, most_starts(quick))?;
    let least_ms = scene.least_step_ms[usize::from(!quick)];
    let mut rows = Vec::new();
    for method in report::all_methods() {
        bar.set_message(scene.id);
        if method.step_ms().is_some_and(|step| step < least_ms) {
            let why = if quick { "too dear for a quick report" } else { "too dear" };
            rows.push(Timed { row: report::left_out(&scene, method, why), cpu_us: None });
        } else {
            rows.push(time(&prepared, method)?);
        }
        bar.inc(1);
    }
    let mut plain: Vec<Row> = rows.iter().map(|timed| timed.row.clone()).collect();
    report::orders(&mut plain, prepared.reference_error_m);
    for (timed, row) in rows.iter_mut().zip(plain) {
        timed.row = row;
    }
    Ok(Measured { prepared, rows })
}

fn time(prepared: &Prepared, method: Method) -> Result<Timed, Error> {
    let mut times = Vec::new();
    let mut runs = Vec::new();
    for start in 0..prepared.starts() {
        let world = prepared.simulation(method, start)?;
        let (mut spent, mut run) = (0.0, None);
        for _ in 0..REPEATS_MAX {
            let world = world.clone();
            let begin = thread_cpu_time();
            let track = prepared.watch(world);
            let took = (thread_cpu_time() - begin).as_secs_f64();
            // What failed half-way took half of the time, and says nothing about a second.
            if track.is_ok() {
                times.push(took * 1e6 / prepared.until_s);
            }
            run = Some(track);
            spent += took;
            if spent > ENOUGH_S {
                break;
            }
        }
        runs.extend(run);
    }
    times.sort_by(f64::total_cmp);
    let cpu_us = match (times.first(), times.get(times.len() / 2), times.last()) {
        (Some(least), Some(median), Some(most)) => {
            Some(Spread { median: *median, least: *least, most: *most })
        }
        _ => None,
    };
    Ok(Timed { row: report::judge(prepared, method, &runs), cpu_us })
}
