//! What a hand and a wall do to each other.

use super::bench::{Bench, Ripple, bare, spec, wall};
use crate::haptic::simulated::{HandModel, HandScript, Leg};
use crate::haptic::{SafetySettings, ServoSettings};
use crate::validation::error::Trouble;
use crate::validation::observed::Observations;
use crate::validation::setup::Setup;
use glam::DVec3;

/// Longest tap [ticks].
const TAP_MAX: u32 = 20_000;
/// Most taps of a run.
const PHASES_MAX: u64 = 10_000;
/// A wall has settled if the device moves less than this from then on: two steps of an Omni's
/// encoder [m].
const SETTLED_M: f64 = 1.1e-4;

/// What one tap of a free device on a wall gives.
struct Tap {
    speed_ratio: f64,
    energy_j: f64,
}

/// Taps at one speed, their starts equally spaced over the way of one sample.
fn taps(setup: &Setup<'_>) -> Result<Vec<Tap>, Trouble> {
    let (spec, speed) = (spec(setup)?, setup.positive("speed_m_s")?);
    let (stiffness, damping) = (setup.positive("K_N_m")?, setup.number_or_zero("B_Ns_m")?);
    let phases = setup.count("phases")?.unwrap_or(1);
    if !(1..=PHASES_MAX).contains(&phases) {
        return Err(setup.error("phases", format!("{phases}"), "write 1 to 10000").into());
    }
    let way_m = speed * spec.period_s();
    let tap = |phase: u64| {
        let start = DVec3::X * (-way_m * (phase as f64 + 0.5) / phases as f64);
        let script = HandScript::drawn(start, Vec::new());
        let mut bench = Bench::new(spec, HandModel::None, script, wall(stiffness, damping));
        bench.device = bench.device.pushed(DVec3::ZERO, DVec3::X * speed);
        let mut has_touched = false;
        for _ in 0..TAP_MAX {
            bench.tick();
            let (depth, is_leaving) = (bench.depth_m(), bench.speed_m_s() < 0.0);
            has_touched |= depth > 0.0;
            if has_touched && depth <= 0.0 && is_leaving && bench.device.acting() == DVec3::ZERO {
                let energy_j = bench.servo.report().energy_j;
                return Some(Tap { speed_ratio: -bench.speed_m_s() / speed, energy_j });
            }
        }
        None
    };
    let missing = || Trouble::Failed(String::from("the device stays in the wall"));
    (0..phases).map(|phase| tap(phase).ok_or_else(missing)).collect()
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// Speed after a tap over that before it.
pub(in crate::validation) fn bounce_gain(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let taps = taps(setup)?;
    let mut seen = Observations::default();
    seen.set("speed_ratio", mean(taps.iter().map(|tap| tap.speed_ratio)));
    Ok(seen)
}

/// What the servo's own observer counts in a tap.
pub(in crate::validation) fn energy_observer(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let taps = taps(setup)?;
    let mut seen = Observations::default();
    seen.set("energy_J", mean(taps.iter().map(|tap| tap.energy_j)));
    // A held force gives an undamped mass exp(π T √(K/m)/2) times its energy in a half swing.
    let (mass, speed) = (setup.positive("m_kg")?, setup.positive("speed_m_s")?);
    let omega = (setup.positive("K_N_m")? / mass).sqrt();
    let growth = std::f64::consts::FRAC_PI_2 * setup.positive("T_s")? * omega;
    seen.set("formula_energy_J", -0.5 * mass * speed * speed * libm::expm1(growth));
    Ok(seen)
}

/// A hand that pushes into a wall, and the ripple that remains.
fn pushed(setup: &Setup<'_>, safety: SafetySettings) -> Result<(f64, f64), Trouble> {
    let (spec, push) = (spec(setup)?, setup.push()?);
    let (stiffness, damping) = (setup.positive("K_N_m")?, setup.number_or_zero("B_Ns_m")?);
    let ticks = setup.ticks("duration_s", spec.period_s())?;
    let from = setup.ticks("ripple_from_s", spec.period_s())?;
    let (start, end) = (DVec3::X * push.from_m, DVec3::X * push.to_m);
    let script = HandScript::drawn(start, vec![Leg::ramp(end, push.ramp_s)]);
    let settings = ServoSettings { safety, ..bare(&spec) };
    let mut bench =
        Bench::new(spec, setup.hand()?, script, wall(stiffness, damping)).with(settings);
    let bias = DVec3::X * setup.number_or_zero("bias_force_N")?;
    bench.device = bench.device.pushed(bias, DVec3::ZERO);
    let (mut place, mut force) = (Ripple::new(), Ripple::new());
    for tick in 0..ticks {
        bench.tick();
        if tick > from {
            place.take(bench.depth_m());
            force.take(bench.device.acting().x);
        }
    }
    Ok((place.size(), force.size()))
}

fn only_clamped(setup: &Setup<'_>) -> Result<SafetySettings, Trouble> {
    let force_max_n = setup.maybe("force_limit_N")?.unwrap_or(f64::INFINITY);
    Ok(SafetySettings { force_max_n, ..SafetySettings::OFF })
}

/// Without any stage but the clamp.
pub(in crate::validation) fn wall_settles(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (ripple_m, force_ripple_n) = pushed(setup, only_clamped(setup)?)?;
    let mut seen = Observations::default();
    seen.set("ripple_m", ripple_m);
    seen.set("force_ripple_N", force_ripple_n);
    seen.set("settles", ripple_m < SETTLED_M);
    Ok(seen)
}

/// With the passivity controller.
pub(in crate::validation) fn passivity_controller(
    setup: &Setup<'_>,
) -> Result<Observations, Trouble> {
    let passivity_damping_ns_m = setup.positive("alpha_max_Ns_m")?;
    let safety = SafetySettings { passivity_damping_ns_m, ..only_clamped(setup)? };
    let (ripple_m, force_ripple_n) = pushed(setup, safety)?;
    let mut seen = Observations::default();
    seen.set("ripple_m", ripple_m);
    seen.set("force_ripple_N", force_ripple_n);
    Ok(seen)
}

/// A device that lies still in a wall, held by a constant force.
pub(in crate::validation) fn hold_still(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (spec, depth) = (spec(setup)?, setup.positive("depth_m")?);
    let stiffness = setup.positive("K_N_m")?;
    let ticks = setup.ticks("duration_s", spec.period_s())?;
    let script = HandScript::drawn(DVec3::X * depth, Vec::new());
    let mut bench = Bench::new(spec, HandModel::None, script, wall(stiffness, 0.0));
    bench.device = bench.device.pushed(DVec3::X * (stiffness * depth), DVec3::ZERO);
    let (mut place, mut force) = (Ripple::new(), Ripple::new());
    for _ in 0..ticks {
        bench.tick();
        place.take(bench.depth_m());
        force.take(bench.device.acting().x);
    }
    let mut seen = Observations::default();
    seen.set("force_ripple_N", force.size());
    seen.set("position_ripple_m", place.size());
    seen.set("half_quantum_force_N", 0.5 * stiffness * spec.quantum_m);
    Ok(seen)
}
