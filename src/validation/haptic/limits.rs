//! Where a loop loses its stability.

use super::bench::{Bench, bilateral, spec};
use crate::haptic::DeviceSpec;
use crate::haptic::simulated::{HandModel, HandScript};
use crate::units::Seconds;
use crate::validation::error::{Trouble, unsupported};
use crate::validation::observed::Observations;
use crate::validation::setup::Setup;
use glam::DVec3;

/// Windows in which the size of the motion is compared, as parts of the run.
const EARLY: (f64, f64) = (0.35, 0.5);
const LATE: (f64, f64) = (0.85, 1.0);
/// Length of a case's run [s], and the least length of any [ticks].
const RUN_S: Seconds = 12.0;
const TICKS_MIN: u64 = 2_000;
/// A motion this many times larger than the first has run away.
const RUNAWAY: f64 = 1e6;
/// How the search climbs, and how near it goes.
const CLIMB: f64 = 1.4;
const NEAR: f64 = 2e-4;
/// Where the search ends: no device renders that.
const HIGHEST: f64 = 1e7;

/// Largest stiffness or damping of a bilateral wall at which a motion dies away.
pub(in crate::validation) fn stability_limit(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (spec, hand) = (spec(setup)?, setup.hand()?);
    let (stiffness, damping) = (setup.number_or_zero("K_N_m")?, setup.number_or_zero("B_Ns_m")?);
    let limit = match setup.word("limit_of")?.as_str() {
        "K_N_m" => limit(|k| dies_away(spec, hand, k, damping, RUN_S)),
        "B_Ns_m" => limit(|b| dies_away(spec, hand, stiffness, b, RUN_S)),
        other => return unsupported(format!("no limit of '{other}'")),
    };
    let mut seen = Observations::default();
    seen.maybe("limit", limit);
    Ok(seen)
}

/// The stiffest bilateral wall without damping at which a motion dies away, as runs of `run_s` show
/// it [N/m].
pub(crate) fn stiffest_wall(spec: DeviceSpec, hand: HandModel, run_s: Seconds) -> Option<f64> {
    limit(|stiffness| dies_away(spec, hand, stiffness, 0.0, run_s))
}

/// The first loss of stability on a rising scale, then by bisection.
pub(crate) fn limit(is_stable: impl Fn(f64) -> bool) -> Option<f64> {
    let (mut low, mut high) = (0.0, 1.0);
    while is_stable(high) {
        (low, high) = (high, high * CLIMB);
        if high > HIGHEST {
            return None;
        }
    }
    while high - low > NEAR * high {
        let middle = 0.5 * (low + high);
        if is_stable(middle) { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// Whether a device that was pushed is slower late than early.
fn dies_away(
    spec: DeviceSpec,
    hand: HandModel,
    stiffness: f64,
    damping: f64,
    run_s: Seconds,
) -> bool {
    let script = HandScript::drawn(DVec3::ZERO, Vec::new());
    let mut bench = Bench::new(spec, hand, script, bilateral(stiffness, damping));
    bench.device = bench.device.pushed(DVec3::ZERO, DVec3::X * 0.01);
    let ticks = ((run_s / spec.period_s()) as u64).max(TICKS_MIN);
    let (mut first, mut early, mut late) = (0.01_f64, 0.0_f64, 0.0_f64);
    for tick in 0..ticks {
        bench.tick();
        let speed = bench.speed_m_s().abs();
        let part = tick as f64 / ticks as f64;
        if part < 0.01 {
            first = first.max(speed);
        }
        if !(speed < RUNAWAY * first) {
            return false;
        }
        if (EARLY.0..EARLY.1).contains(&part) {
            early = early.max(speed);
        }
        if (LATE.0..LATE.1).contains(&part) {
            late = late.max(speed);
        }
    }
    late < early || early < 1e-12 * first
}

/// Whether an explicitly stepped tip mass on the coupling runs away: speed first, then place.
pub(in crate::validation) fn divergence_sign(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (mass, period) = (setup.positive("tip_mass_kg")?, setup.positive("T_s")?);
    let (stiffness, damping) = (setup.positive("Kc_N_m")?, setup.at_least_zero("Bc_Ns_m")?);
    let start = setup.positive("x0_m")?;
    let ticks = setup.count("ticks")?.unwrap_or(0).min(10_000_000);
    let (mut x, mut v, mut diverges) = (start, 0.0, false);
    for _ in 0..ticks {
        v -= period * (stiffness * x + damping * v) / mass;
        x += period * v;
        if !(x.abs() <= 10.0 * start) {
            diverges = true;
            break;
        }
    }
    let mut seen = Observations::default();
    seen.set("diverges", diverges);
    // Jury's criterion for the pair of speed and place.
    seen.set("Kc_limit_N_m", (4.0 * mass - 2.0 * damping * period) / (period * period));
    Ok(seen)
}
