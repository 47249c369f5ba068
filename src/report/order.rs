//! Orders of convergence, and who is best at what price.

use super::trial::{Row, Status};
use crate::physics::Work;

/// An error this close to the reference's own says nothing about a method.
const CLEAR_OF_REFERENCE: f64 = 20.0;
/// Smaller errors are rounding [m].
const ROUNDING_M: f64 = 1e-12;

/// Fills in the observed orders: of each row against the next coarser step of the same method.
pub fn orders(rows: &mut [Row], reference_error_m: f64) {
    for at in 1..rows.len() {
        rows[at].order = between(&rows[at - 1], &rows[at], reference_error_m);
    }
}

fn clear(row: &Row, reference_error_m: f64) -> Option<(f64, f64)> {
    let (step, error) = (row.method.step_ms()?, row.error_m?);
    let told = error > ROUNDING_M && error > CLEAR_OF_REFERENCE * reference_error_m;
    (row.status == Status::Ok && told).then(|| (libm::log(step), libm::log(error)))
}

fn between(coarse: &Row, fine: &Row, reference_error_m: f64) -> Option<f64> {
    if coarse.method.name() != fine.method.name() {
        return None;
    }
    let (h1, e1) = clear(coarse, reference_error_m)?;
    let (h2, e2) = clear(fine, reference_error_m)?;
    Some((e1 - e2) / (h1 - h2))
}

/// The order of a method over all steps up to `most_ms`: the slope of the line through errors and
/// steps on paper with two logarithmic scales. None with fewer than three clear errors.
pub fn fitted_order(
    rows: &[Row],
    method: &str,
    most_ms: f64,
    reference_error_m: f64,
) -> Option<f64> {
    let points: Vec<(f64, f64)> = rows
        .iter()
        .filter(|row| row.method.name() == method)
        .filter(|row| row.method.step_ms().is_some_and(|step| step <= most_ms))
        .filter_map(|row| clear(row, reference_error_m))
        .collect();
    if points.len() < 3 {
        return None;
    }
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0 / n, sum.1 + p.1 / n));
    let along: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    let across: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    Some(across / along)
}

/// Everything that was computed, added up: events, tests, contacts, evaluations of forces, closed
/// forms and looks.
pub fn computations(work: Work) -> u64 {
    let looks = work.flights + work.spins + work.pocket_tests;
    work.events + work.tests() + work.contacts + work.force_evaluations + looks
}

/// Whether no other row has a smaller or equal error for less computation, or a smaller one for as
/// much. Other tolerances of the exact solver are the same method and do not count.
pub fn on_the_front(row: &Row, rows: &[Row]) -> bool {
    let Some(error) = row.error_m else { return false };
    let own = computations(row.work);
    let others = rows.iter().filter(|other| other.method.step_ms().is_some());
    others.into_iter().all(|other| {
        let (Some(off), work) = (other.error_m, computations(other.work)) else { return true };
        let better = off <= error && work <= own && (off < error || work < own);
        other.status != Status::Ok || !better
    })
}
