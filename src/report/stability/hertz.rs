//! A contact that is a spring: how short a step must be for it.
//!
//! Two pool balls that meet head-on with Hertz' force K δ^(3/2) and no loss part with the speed
//! they came with. A step that is not short against the time of contact gives them another one.

use crate::ball::{POOL_MASS_KG, POOL_RADIUS_M};
use crate::physics::Integrator;
use crate::physics::laws::hertz::{POISSON_RATIO, YOUNGS_MODULUS_PA};
use crate::report::method::INTEGRATORS;
use crate::units::Seconds;

/// An integrator at a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzRow {
    /// The integrator.
    pub integrator: Integrator,
    /// Its step [s].
    pub step_s: Seconds,
    /// Over the time of contact.
    pub share: f64,
    /// Speed after over speed before, less 1; the worst of places in a step where contact begins.
    pub error: f64,
}

/// Balls that meet with `speed_m_s`, in steps of a quarter of a microsecond to a millisecond, and
/// the time of contact [s].
pub fn hertz_rows(speed_m_s: f64) -> (Seconds, Vec<HertzRow>) {
    let stiffness = {
        let modulus = YOUNGS_MODULUS_PA / (2.0 * (1.0 - POISSON_RATIO * POISSON_RATIO));
        4.0 / 3.0 * modulus * (0.5 * POOL_RADIUS_M).sqrt()
    };
    // Hertz 1881: 2.9432 times deepest overlap over speed.
    let mass = 0.5 * POOL_MASS_KG;
    let deepest = libm::pow(1.25 * mass * speed_m_s * speed_m_s / stiffness, 0.4);
    let contact_s = 2.943_2 * deepest / speed_m_s;
    let mut rows = Vec::new();
    for integrator in INTEGRATORS {
        for step_s in [0.25e-6, 1e-6, 4e-6, 16e-6, 64e-6, 256e-6, 1e-3] {
            let force = |x: f64| if x > 0.0 { -stiffness * x * x.sqrt() / mass } else { 0.0 };
            let error = (0..16)
                .map(|part| {
                    let begin = -speed_m_s * step_s * f64::from(part) / 16.0;
                    meet(integrator, step_s, begin, speed_m_s, &force)
                })
                .fold(
                    0.0,
                    |worst: f64, error| if error.abs() > worst.abs() { error } else { worst },
                );
            rows.push(HertzRow { integrator, step_s, share: step_s / contact_s, error });
        }
    }
    (contact_s, rows)
}

/// Error of the speed of two balls that approach with `v`, overlapping by `x`, until they part.
fn meet(integrator: Integrator, h: Seconds, x: f64, v: f64, force: &impl Fn(f64) -> f64) -> f64 {
    let (mut x, speed, mut v) = (x, v, v);
    // The last place, from which the force brings the pair here.
    let mut last = x - v * h + 0.5 * force(x) * h * h;
    let mut touched = false;
    for _ in 0..100_000 {
        match integrator {
            Integrator::EulerCromer => {
                v += force(x) * h;
                x += v * h;
            }
            Integrator::Verlet => {
                let a = force(x);
                x += v * h + 0.5 * a * h * h;
                v += 0.5 * (a + force(x)) * h;
            }
            Integrator::PositionVerlet => {
                let next = 2.0 * x - last + force(x) * h * h;
                v = (next - x) / h + 0.5 * force(next) * h;
                (last, x) = (x, next);
            }
            Integrator::Rk4 => {
                let (a1, v1) = (force(x), v);
                let (a2, v2) = (force(x + 0.5 * h * v1), v + 0.5 * h * a1);
                let (a3, v3) = (force(x + 0.5 * h * v2), v + 0.5 * h * a2);
                let (a4, v4) = (force(x + h * v3), v + h * a3);
                x += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
                v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            }
        }
        touched |= x > 0.0;
        if touched && x <= 0.0 {
            break;
        }
    }
    v.abs() / speed - 1.0
}
