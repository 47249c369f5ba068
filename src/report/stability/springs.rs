//! Stiff springs, and from where on a step is too long for them.

use super::{Cell, Class, Measured, measure};
use crate::ball::{Ball, BallFlags, POOL_MASS_KG, Spring};
use crate::events::FactSet;
use crate::ids::BallId;
use crate::physics::{Integrator, PhysicsError, Simulation};
use crate::report::answers;
use crate::report::method::Method;
use crate::report::starts::{ball, nothing};
use glam::DVec3;

/// Stiffnesses of the table [N/m].
pub const STIFFNESSES: [f64; 9] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];
/// Damping of the table, over critical.
pub const RATIOS: [f64; 2] = [0.0, 0.05];
/// How far the ball is let go from its anchor [m].
const OFF_M: f64 = 0.01;
/// Step of the search for a limit [ms].
const SEARCH_MS: f64 = 1.0;
/// Steps of each try. What grows by a thousandth a step has become several times as large.
const TRIES: f64 = 4000.0;

/// From where on a method fails: natural frequency times step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// As the solver shows it.
    pub measured: f64,
    /// From the eigenvalues of one step.
    pub theory: f64,
}

fn held(stiffness_n_m: f64, ratio: f64, method: Method) -> Result<Simulation, PhysicsError> {
    let (held, state) = ball(0, DVec3::X * OFF_M, DVec3::ZERO, DVec3::ZERO);
    let damping_ns_m = 2.0 * ratio * (stiffness_n_m * held.mass_kg).sqrt();
    let flags = BallFlags { gravity: false, ..BallFlags::default() };
    let spring = Spring { stiffness_n_m, damping_ns_m, ..Spring::default() };
    let balls = vec![(Ball { spring: Some(spring), flags, ..held }, state)];
    Simulation::from_parts(&nothing(), balls, &method.settings())
}

/// The cell of a method on a spring: displacement off the closed form over a second, in units of
/// the first displacement.
pub fn spring_cell(stiffness_n_m: f64, ratio: f64, method: Method) -> Cell {
    let omega = (stiffness_n_m / POOL_MASS_KG).sqrt();
    let measured = held(stiffness_n_m, ratio, method).and_then(|world| {
        measure(&mut || true, world, 1.0, 250, |world, at| {
            let place = world.sample(BallId(0), at).map_or(DVec3::NAN, |ball| ball.position);
            let truth = answers::on_spring(omega, ratio, DVec3::X * OFF_M, DVec3::ZERO, at);
            (place - truth).length() / OFF_M
        })
    });
    let mut cell = Cell::of(measured);
    if let (Some(integrator), Some(step_ms)) = (method.integrator(), method.step_ms()) {
        let product = omega * step_ms / 1000.0;
        let limit = theory(integrator, ratio);
        if cell.class == Class::Diverges {
            cell.note = format!("ωh {product:.3}, limit {limit:.3}");
        }
    }
    cell
}

/// The limit of an integrator.
///
/// # Errors
/// [`PhysicsError`] if the solver refuses a spring.
pub fn spring_limit(integrator: Integrator, ratio: f64) -> Result<Limit, PhysicsError> {
    let method = Method::FixedStep { integrator, step_ms: SEARCH_MS };
    let h = SEARCH_MS / 1000.0;
    let (mut stable, mut unstable) = (0.1, 6.0);
    while unstable - stable > 1e-4 {
        let product = 0.5 * (stable + unstable);
        let omega = product / h;
        if grows(held(omega * omega * POOL_MASS_KG, ratio, method)?, h)? {
            unstable = product;
        } else {
            stable = product;
        }
    }
    Ok(Limit { measured: 0.5 * (stable + unstable), theory: theory(integrator, ratio) })
}

/// Whether a ball swings wider in the last quarter of the time than in the one before.
fn grows(mut world: Simulation, h: f64) -> Result<bool, PhysicsError> {
    let mut widest = Measured::default();
    let mut facts = Vec::new();
    for step in 1..=TRIES as u32 {
        let at = f64::from(step) * h;
        world.advance(at, FactSet::NONE, &mut facts)?;
        let off = world.sample(BallId(0), at).map_or(f64::NAN, |ball| ball.position.length());
        if !(off < 1e3) {
            return Ok(true);
        }
        let share = f64::from(step) / TRIES;
        if share > 0.75 {
            widest.second = widest.second.max(off);
        } else if share > 0.5 {
            widest.first = widest.first.max(off);
        }
    }
    Ok(widest.second > 1.001 * widest.first && widest.second > OFF_M)
}

/// The largest product of frequency and step for which no eigenvalue of a step exceeds 1.
fn theory(integrator: Integrator, ratio: f64) -> f64 {
    // Coarse first: stability may be lost and won again.
    let mut product = 0.01;
    while radius(integrator, ratio, product) <= 1.0 + 1e-9 && product < 20.0 {
        product += 0.01;
    }
    let (mut stable, mut unstable) = (product - 0.01, product);
    for _ in 0..50 {
        let middle = 0.5 * (stable + unstable);
        if radius(integrator, ratio, middle) <= 1.0 + 1e-12 {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    stable
}

/// Largest eigenvalue of a step, for place and velocity times step.
fn radius(integrator: Integrator, ratio: f64, product: f64) -> f64 {
    let force = |x: f64, y: f64| -product * product * x - 2.0 * ratio * product * y;
    let step = |x: f64, y: f64| match integrator {
        Integrator::EulerCromer => {
            let y = y + force(x, y);
            (x + y, y)
        }
        Integrator::Verlet => {
            let a = force(x, y);
            let next = x + y + 0.5 * a;
            (next, y + 0.5 * (a + force(next, y + a)))
        }
        // Here the second number is the way of the last step, which is all that it knows of its
        // velocity.
        Integrator::PositionVerlet => {
            let way = y + force(x, y + 0.5 * force(x, y));
            (x + way, way)
        }
        Integrator::Rk4 => {
            let slope = |x: f64, y: f64| (y, force(x, y));
            let k1 = slope(x, y);
            let k2 = slope(x + 0.5 * k1.0, y + 0.5 * k1.1);
            let k3 = slope(x + 0.5 * k2.0, y + 0.5 * k2.1);
            let k4 = slope(x + k3.0, y + k3.1);
            let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
            (x + mean(k1.0, k2.0, k3.0, k4.0), y + mean(k1.1, k2.1, k3.1, k4.1))
        }
    };
    let ((a, c), (b, d)) = (step(1.0, 0.0), step(0.0, 1.0));
    largest_eigenvalue([[a, b], [c, d]])
}

/// Largest absolute value of the eigenvalues of a matrix.
fn largest_eigenvalue([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let (trace, determinant) = (a + d, a * d - b * c);
    let inner = 0.25 * trace * trace - determinant;
    if inner < 0.0 { determinant.sqrt() } else { 0.5 * trace.abs() + inner.sqrt() }
}
