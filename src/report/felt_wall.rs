//! How wrong the force of a haptic wall is, against the rate of its servo.
//!
//! The servo and the simulated device of the game, without safety stages: a stylus without friction
//! runs at 0.2 m/s into a wall of 500 N/m. In continuous time it would feel K x(t) with
//! x = v/ω sin ωt, ω = √(K/m), and leave as fast as it came. What is sampled is held for a period
//! and late by half of it in the mean, so the error is about ω T of the peak, and the stylus leaves
//! faster by about π ω T/4.

use crate::haptic::DeviceSpec;
use crate::haptic::simulated::{HandModel, HandScript};
use crate::validation::haptic::{Bench, wall};
use glam::DVec3;

/// Stiffness of the wall [N/m]: what the makers of the Omni promise.
pub const STIFFNESS_N_M: f64 = 500.0;

/// How fast the stylus comes [m/s].
pub const SPEED_M_S: f64 = 0.2;

/// The rates that are tried [Hz].
pub const RATES_HZ: [f64; 6] = [250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0];

/// Taps at one rate; they begin equally spaced over the way of a sample.
const TAPS: u32 = 16;

/// A tap in which the stylus has not left after so many times half a swing sticks in the wall.
const SWINGS_MAX: f64 = 4.0;

/// What a wall feels like at one rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeltWall {
    /// Rate of the servo [Hz].
    pub rate_hz: f64,
    /// The largest difference of the force that acts from that of the spring where the stylus is,
    /// over the largest force of the spring; mean of the taps.
    pub force_error: f64,
    /// ω T, which theory expects of it for small T.
    pub theory: f64,
    /// Speed after a tap over that before it, mean; none if the stylus stays in the wall.
    pub speed_ratio: Option<f64>,
}

/// Taps a wall at one rate.
pub fn felt_wall(rate_hz: f64) -> FeltWall {
    let spec = DeviceSpec { damping_ns_m: 0.0, friction_n: 0.0, quantum_m: 0.0, rate_hz, ..OMNI };
    let taps: Vec<(f64, Option<f64>)> =
        (0..TAPS).map(|tap| one_tap(spec, f64::from(tap) / f64::from(TAPS))).collect();
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / f64::from(TAPS);
    let left = taps.iter().all(|(_, ratio)| ratio.is_some());
    FeltWall {
        rate_hz,
        force_error: mean(&mut taps.iter().map(|(error, _)| *error)),
        theory: omega(&spec) / rate_hz,
        speed_ratio: left.then(|| mean(&mut taps.iter().filter_map(|(_, ratio)| *ratio))),
    }
}

const OMNI: DeviceSpec = DeviceSpec::OMNI;

fn omega(spec: &DeviceSpec) -> f64 {
    (STIFFNESS_N_M / spec.mass_kg).sqrt()
}

/// Force error of a tap over its peak, and speed after it over the speed before. The device begins
/// `part` of a sample's way in front of the wall.
fn one_tap(spec: DeviceSpec, part: f64) -> (f64, Option<f64>) {
    let period_s = spec.period_s();
    let start = DVec3::X * (-SPEED_M_S * period_s * part);
    let script = HandScript::drawn(start, Vec::new());
    let mut bench = Bench::new(spec, HandModel::None, script, wall(STIFFNESS_N_M, 0.0));
    bench.device = bench.device.pushed(DVec3::ZERO, DVec3::X * SPEED_M_S);
    let swing_s = core::f64::consts::PI / omega(&spec);
    let peak_n = STIFFNESS_N_M * SPEED_M_S / omega(&spec);
    let ticks = (SWINGS_MAX * swing_s / period_s) as u32 + 2;
    let mut largest_n: f64 = 0.0;
    for _ in 0..ticks {
        // What acts up to the end of a hold was felt a period before.
        let held_n = bench.device.acting().x;
        bench.tick();
        let spring_n = -STIFFNESS_N_M * bench.depth_m().max(0.0);
        largest_n = largest_n.max((held_n - spring_n).abs());
        let free = bench.depth_m() <= 0.0 && bench.device.acting() == DVec3::ZERO;
        if free && bench.speed_m_s() < 0.0 {
            return (largest_n / peak_n, Some(-bench.speed_m_s() / SPEED_M_S));
        }
    }
    (largest_n / peak_n, None)
}
