//! How long the future of many balls can be told, and what can be said beyond.

use super::method::Method;
use super::starts;
use crate::events::FactSet;
use crate::physics::{Parameters, PhysicsError, Simulation};
use crate::units::Seconds;
use glam::DVec3;

/// A disturbance of 1e-12 has grown beyond telling once it has become this [m].
const TOLD_M: f64 = 1e-6;
/// How often two futures are compared [s].
const LOOK_S: Seconds = 0.005;
/// Balls are counted as moving above this [m/s].
const MOVING_M_S: f64 = 1e-2;

/// How a disturbance of 1e-12 of the first ball's speed grows.
#[derive(Debug, Clone, PartialEq)]
pub struct Growth {
    /// Time [s] and distance of the ball that is off most [m].
    pub curve: Vec<(Seconds, f64)>,
    /// Until then it stays below 1e-6 m [s].
    pub horizon_s: Seconds,
    /// Factor by which it grows in a second, on the average up to the horizon; none if it does not
    /// grow.
    pub factor_per_s: Option<f64>,
}

/// Compares two worlds that differ by a disturbance, to `most_s`.
pub(super) fn growth_of(
    mut one: Simulation,
    mut other: Simulation,
    most_s: Seconds,
) -> Result<Growth, PhysicsError> {
    let mut curve = Vec::new();
    let mut horizon_s = most_s;
    let mut told = true;
    let mut facts = Vec::new();
    for look in 1.. {
        let at = LOOK_S * f64::from(look);
        if at > most_s + 0.5 * LOOK_S {
            break;
        }
        facts.clear();
        one.advance(at, FactSet::NONE, &mut facts)?;
        other.advance(at, FactSet::NONE, &mut facts)?;
        let (balls, others) = (one.snapshot(at).balls, other.snapshot(at).balls);
        let pairs = balls.iter().zip(&others);
        let apart = pairs.map(|(a, b)| a.position.distance(b.position)).fold(0.0, f64::max);
        curve.push((at, apart));
        if told && apart >= TOLD_M {
            told = false;
            horizon_s = at - LOOK_S;
        }
    }
    let mut upto = curve.iter().filter(|(at, apart)| *at <= horizon_s && *apart > 0.0);
    let (first, last) = (upto.clone().next(), upto.next_back());
    let factor_per_s = match (first, last) {
        (Some((t0, d0)), Some((t1, d1))) if t1 > t0 && d1 > d0 => {
            Some(libm::exp((libm::log(*d1) - libm::log(*d0)) / (t1 - t0)))
        }
        _ => None,
    };
    Ok(Growth { curve, horizon_s, factor_per_s })
}

/// How a disturbance of rack `seed` grows within `most_s`.
///
/// # Errors
/// [`PhysicsError`] if the exact solver does not get on.
pub fn growth(seed: usize, most_s: Seconds) -> Result<Growth, PhysicsError> {
    let world = |scale: f64| {
        let mut balls = starts::racked(seed);
        for (_, state) in &mut balls {
            state.velocity *= scale;
        }
        Simulation::from_parts(&starts::noses(), balls, &Method::EventDriven.settings())
    };
    growth_of(world(1.0)?, world(1.0 + 1e-12)?, most_s)
}

/// What breaks have in common, whichever of them happened: mean over racks and its standard error.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// The method.
    pub method: Method,
    /// Kinetic over first kinetic energy at the look.
    pub energy: (f64, f64),
    /// Distance of the balls from their middle at the look [m].
    pub spread_m: (f64, f64),
    /// Balls that move at the look.
    pub moving: (f64, f64),
    /// What of energy does not add up, worst rack [J].
    pub energy_residual_j: f64,
    /// What of momentum does not add up, worst rack [N s].
    pub momentum_residual_ns: f64,
    /// Energy that the method itself added, worst rack [J].
    pub added_j: f64,
}

/// Breaks `racks` racks with `method` and looks at them after `at_s`.
///
/// # Errors
/// [`PhysicsError`] if a solver does not get on.
pub fn spread(method: Method, racks: usize, at_s: Seconds) -> Result<Spread, PhysicsError> {
    let (mut energy, mut apart, mut moving) = (Vec::new(), Vec::new(), Vec::new());
    let (mut energy_residual_j, mut momentum_residual_ns, mut added_j) = (0.0_f64, 0.0_f64, 0.0);
    let table = starts::noses();
    for rack in 0..racks {
        let settings = method.settings();
        let parameters = Parameters::of(&settings);
        let balls = starts::racked(rack);
        let first: f64 = balls.iter().map(|(_, state)| state.velocity.length_squared()).sum();
        let first_j = 0.5 * crate::ball::POOL_MASS_KG * first;
        let mut world = Simulation::with_parameters(&table, balls, &settings, parameters)?;
        world.advance(at_s, FactSet::NONE, &mut Vec::new())?;
        let ledger = world.ledger();
        let balls = world.snapshot(at_s).balls;
        let n = balls.len().max(1) as f64;
        let middle = balls.iter().map(|ball| ball.position).sum::<DVec3>() / n;
        let square: f64 = balls.iter().map(|b| b.position.distance_squared(middle)).sum();
        let moves = balls.iter().filter(|ball| ball.velocity.length() > MOVING_M_S).count();
        energy.push(ledger.kinetic_j / first_j);
        apart.push((square / n).sqrt());
        moving.push(moves as f64);
        energy_residual_j = energy_residual_j.max(ledger.residual_j.abs());
        momentum_residual_ns = momentum_residual_ns.max(ledger.momentum.residual.length());
        if ledger.integration_j.abs() > f64::abs(added_j) {
            added_j = ledger.integration_j;
        }
    }
    Ok(Spread {
        method,
        energy: mean(&energy),
        spread_m: mean(&apart),
        moving: mean(&moving),
        energy_residual_j,
        momentum_residual_ns,
        added_j,
    })
}

/// Mean and its standard error.
fn mean(values: &[f64]) -> (f64, f64) {
    let n = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (mean, (square / (n - 1.0).max(1.0) / n).sqrt())
}
