//! `simulate --bench`: how long a shot takes.

use super::super::{Status, json_line, progress};
use super::{LONGEST_S, SETTLED, SimulateArgs};
use hapticbillard::physics::Simulation;
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use serde::Serialize;
use std::io::Write;

#[derive(Serialize)]
struct Spread {
    mean: f64,
    median: f64,
    p99: f64,
}

#[derive(Serialize)]
struct Summary {
    shots: u32,
    cpu_us_per_shot: Spread,
    events_per_shot: f64,
    us_per_event: Option<f64>,
    steps_per_shot: f64,
    simulated_s_per_shot: f64,
}

/// Runs the same shot `shots` times and prints processor times.
pub fn run(
    args: &SimulateArgs,
    start: &Simulation,
    shots: u32,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let bar = progress(u64::from(shots), "shots");
    let mut times_us = Vec::with_capacity(shots as usize);
    let (mut events, mut steps, mut simulated_s) = (0, 0, 0.0);
    let mut facts = Vec::new();
    for _ in 0..shots {
        let mut simulation = start.clone();
        facts.clear();
        let begin = thread_cpu_time();
        match args.until {
            Some(until) => {
                simulation.advance(until, hapticbillard::events::FactSet::NONE, &mut facts)?;
            }
            None => {
                simulation.advance(LONGEST_S, SETTLED, &mut facts)?;
            }
        }
        times_us.push((thread_cpu_time() - begin).as_secs_f64() * 1e6);
        events += simulation.work().events;
        steps += simulation.work().steps;
        simulated_s += simulation.now_s() - start.now_s();
        bar.inc(1);
    }
    bar.finish_and_clear();
    times_us.sort_by(f64::total_cmp);
    let n = f64::from(shots);
    let at = |share: f64| times_us[((n * share) as usize).min(times_us.len() - 1)];
    let mean = times_us.iter().sum::<f64>() / n;
    let events_per_shot = events as f64 / n;
    let summary = Summary {
        shots,
        cpu_us_per_shot: Spread { mean, median: at(0.5), p99: at(0.99) },
        events_per_shot,
        us_per_event: (events > 0).then(|| mean / events_per_shot),
        steps_per_shot: steps as f64 / n,
        simulated_s_per_shot: simulated_s / n,
    };
    if args.json {
        json_line(out, &serde_json::json!({ "summary": summary }))?;
        return Ok(Status::Success);
    }
    let Spread { mean, median, p99 } = summary.cpu_us_per_shot;
    writeln!(
        out,
        "{shots} shots of {:.2} s: {median:.1} us of processor time each (median; mean {mean:.1}, \
         99 % below {p99:.1}); {:.0} events and {:.0} steps a shot",
        summary.simulated_s_per_shot, summary.events_per_shot, summary.steps_per_shot
    )?;
    Ok(Status::Success)
}
