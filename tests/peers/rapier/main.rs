//! The report's cases in rapier, in double and in single precision.
//!
//! Reads one case (a line of `hapticbillard report --cases`) from standard input and prints a JSON
//! line for each run: see `tests/peers/README.md`. The argument is how long one setting may take
//! for one start [s].

mod case;

mod double {
    use rapier3d_f64 as rapier;
    include!("engine.rs");
}

mod single {
    use rapier3d as rapier;
    include!("engine.rs");
}

use case::{Case, Start, Vector};
use serde_json::json;
use std::error::Error;

/// A short run is repeated until it has taken so long in all [s], but not more often than this.
const ENOUGH_S: f64 = 0.02;
const REPEATS_MAX: usize = 5;
/// Applied from outside in every step, because rapier has neither.
const HELPED: &str = "rolling resistance and the decay of spin are applied from outside";

/// A world that is moved in steps.
trait Engine {
    fn step(&mut self);
    fn positions(&self) -> Vec<Vector>;
}

type Make = fn(&Case, &Start, f64) -> Result<Box<dyn Engine>, String>;

fn main() -> Result<(), Box<dyn Error>> {
    let case: Case = serde_json::from_reader(std::io::stdin())?;
    let limit_s: f64 = std::env::args().nth(1).ok_or("how long may a run take [s]?")?.parse()?;
    let remark = if case.ground.cloth().is_some() { HELPED } else { "" };
    for (setting, make) in [("f64", double::make as Make), ("f32", single::make as Make)] {
        let mut costs_s = 0.0;
        let mut last_ms = f64::INFINITY;
        for &step_ms in &case.steps_ms {
            if costs_s * last_ms / step_ms > limit_s {
                println!(
                    "{}",
                    json!({"setting": setting, "step_ms": step_ms, "left_out": "too dear"})
                );
                continue;
            }
            costs_s = 0.0;
            for (number, start) in case.starts.iter().enumerate() {
                let (looks_m, times_s) = run(&case, start, make, step_ms)?;
                costs_s = times_s.iter().copied().fold(costs_s, f64::max);
                let times: Vec<f64> =
                    times_s.iter().map(|time| time * 1e6 / case.until_s).collect();
                println!(
                    "{}",
                    json!({
                        "setting": setting, "step_ms": step_ms, "start": number,
                        "cpu_us_per_s": times, "looks_m": looks_m, "remark": remark,
                    })
                );
            }
            last_ms = step_ms;
        }
    }
    Ok(())
}

type Looks = Vec<Vec<Vector>>;

fn run(case: &Case, start: &Start, make: Make, step_ms: f64) -> Result<(Looks, Vec<f64>), String> {
    let mut times_s = Vec::new();
    loop {
        let mut world = make(case, start, step_ms * 1e-3)?;
        let begin = processor_s();
        let looks = watch(case, world.as_mut(), step_ms * 1e-3);
        times_s.push(processor_s() - begin);
        if times_s.iter().sum::<f64>() > ENOUGH_S || times_s.len() == REPEATS_MAX {
            return Ok((looks, times_s));
        }
    }
}

/// Where the balls are at each look; between two steps they go straight.
fn watch(case: &Case, world: &mut dyn Engine, h: f64) -> Looks {
    let mut done = 0_u64;
    let mut before = world.positions();
    let mut after = before.clone();
    let look = |&at_s: &f64| {
        let wanted = (at_s / h - 1e-6).ceil() as u64;
        if wanted > done {
            for _ in done + 1..wanted {
                world.step();
            }
            before = world.positions();
            world.step();
            after = world.positions();
            done = wanted;
        }
        let part = 1.0 - (done as f64 - at_s / h);
        let between =
            |(a, b): (&Vector, &Vector)| [0, 1, 2].map(|axis| a[axis] + part * (b[axis] - a[axis]));
        before.iter().zip(&after).map(between).collect()
    };
    case.looks_s.iter().map(look).collect()
}

fn processor_s() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
