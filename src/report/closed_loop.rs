//! The stiffest wall that a haptic loop renders, against its period and its delay.
//!
//! Measured by bisection through the servo's own tick and the simulated device, with a bilateral
//! wall and the safety stages off, as the cases of the closed loop are. Beside it stands what
//! theory says of the same loop: the eigenvalues of one period, and formulas.

use crate::haptic::DeviceSpec;
use crate::haptic::simulated::{HandModel, discrete};
use crate::units::Seconds;
use crate::validation::haptic::{limit, stiffest_wall};

/// Length of a run [s].
const RUN_S: Seconds = 3.0;
/// Periods without delay, and delays at 1 kHz [samples].
const PERIODS_S: [Seconds; 6] = [0.000_25, 0.000_5, 0.001, 0.002, 0.004, 0.008];
const DELAYS: [usize; 4] = [1, 2, 3, 4];
/// Most states of a loop: those of device and arm, and a force for each sample of delay.
const STATES: usize = 8;

/// Who holds the device.
pub const LOOP_HANDS: [(&str, HandModel); 3] =
    [("none", HandModel::None), ("L", HandModel::LIGHT), ("G", HandModel::GRIP)];

/// A loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopPoint {
    /// Who holds the device, by name.
    pub hand: &'static str,
    model: HandModel,
    /// Time between two samples [s].
    pub period_s: Seconds,
    /// How many samples late a force acts.
    pub delay: usize,
}

/// What is known of a loop's stiffest wall [N/m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoopRow {
    /// The loop.
    pub point: LoopPoint,
    /// Through tick and device; none if there is no limit below what is tried.
    pub measured_n_m: Option<f64>,
    /// From the eigenvalues of one period of the same loop.
    pub theory_n_m: Option<f64>,
    /// b/(T/2 + t_d) with the damping of device and hand (Gil et al. 2004).
    pub late_n_m: f64,
    /// 2 b/T with the damping of the device alone: passive in any hand (Colgate and Schenkel 1997).
    /// With delay there is no such bound.
    pub passive_n_m: Option<f64>,
    /// The same with dry friction and encoder of an Omni: at most 2 f_c/Δ (Abbott, Okamura 2005).
    pub passive_omni_n_m: Option<f64>,
}

/// All loops: each hand at each period, then at each delay.
pub fn loop_points() -> Vec<LoopPoint> {
    let points = LOOP_HANDS.into_iter().flat_map(|(hand, model)| {
        let point = move |period_s, delay| LoopPoint { hand, model, period_s, delay };
        let undelayed = PERIODS_S.into_iter().map(move |period_s| point(period_s, 0));
        undelayed.chain(DELAYS.into_iter().map(move |delay| point(0.001, delay)))
    });
    points.collect()
}

/// The device: an Omni without dry friction and with exact readings, so that the loop is linear.
fn device(point: &LoopPoint) -> DeviceSpec {
    DeviceSpec {
        friction_n: 0.0,
        quantum_m: 0.0,
        rate_hz: 1.0 / point.period_s,
        latency_s: point.delay as f64 * point.period_s,
        ..DeviceSpec::OMNI
    }
}

/// Measures a loop.
pub fn closed_loop(point: LoopPoint) -> LoopRow {
    let (spec, omni) = (device(&point), DeviceSpec::OMNI);
    let (period_s, hand) = (point.period_s, point.model);
    let late_s = period_s * (0.5 + point.delay as f64);
    let passive_n_m = (point.delay == 0).then_some(2.0 * spec.damping_ns_m / period_s);
    let dry_n_m = 2.0 * omni.friction_n / omni.quantum_m;
    LoopRow {
        point,
        measured_n_m: stiffest_wall(spec, hand, RUN_S),
        theory_n_m: limit(|stiffness| log_radius(&loop_matrix(&point, stiffness)) <= 0.0),
        late_n_m: (spec.damping_ns_m + damping(hand)) / late_s,
        passive_n_m,
        passive_omni_n_m: passive_n_m.map(|bound| bound.min(dry_n_m)),
    }
}

/// What a hand adds to the damping of the handle [N s/m].
fn damping(hand: HandModel) -> f64 {
    match hand {
        HandModel::None => 0.0,
        HandModel::Rigid { damping_ns_m, .. } => damping_ns_m,
        HandModel::Grip { grip_ns_m, .. } => grip_ns_m,
    }
}

type Square = [[f64; STATES]; STATES];

/// One period of the loop: device and hand, then the forces on their way, the newest first. States
/// that there are not stay zero.
fn loop_matrix(point: &LoopPoint, stiffness: f64) -> Square {
    let (step, force, states) = discrete(&device(point), point.model, point.period_s);
    let mut matrix = [[0.0; STATES]; STATES];
    for row in 0..states {
        matrix[row][..states].copy_from_slice(&step[row][..states]);
        match point.delay {
            0 => matrix[row][0] -= stiffness * force[row],
            delay => matrix[row][states + delay - 1] = force[row],
        }
    }
    if point.delay > 0 {
        matrix[states][0] = -stiffness;
    }
    for waiting in 1..point.delay {
        matrix[states + waiting][states + waiting - 1] = 1.0;
    }
    matrix
}

/// ln of the largest eigenvalue's size: ln |A^n|/n for n = 2^40 (Gelfand 1941).
fn log_radius(matrix: &Square) -> f64 {
    const SQUARINGS: i32 = 40;
    let (mut power, mut ln) = (*matrix, 0.0);
    for _ in 0..SQUARINGS {
        let size = power.iter().flatten().fold(0.0_f64, |size, x| size.max(x.abs()));
        if !(size > 0.0) {
            return f64::NEG_INFINITY;
        }
        power.iter_mut().flatten().for_each(|x| *x /= size);
        ln = 2.0 * (ln + libm::log(size));
        power = squared(&power);
    }
    ln / libm::exp2(f64::from(SQUARINGS))
}

fn squared(matrix: &Square) -> Square {
    let mut square = [[0.0; STATES]; STATES];
    for (row, into) in matrix.iter().zip(&mut square) {
        for (factor, other) in row.iter().zip(matrix) {
            into.iter_mut().zip(other).for_each(|(sum, x)| *sum += factor * x);
        }
    }
    square
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_of_a_turn_with_growth_is_the_growth() {
        let (sin, cos) = libm::sincos(0.7);
        for growth in [0.5, 0.999_999, 1.000_001, 3.0] {
            let mut matrix = [[0.0; STATES]; STATES];
            matrix[0][..2].copy_from_slice(&[growth * cos, -growth * sin]);
            matrix[1][..2].copy_from_slice(&[growth * sin, growth * cos]);
            // A large coupling to a state that dies away changes nothing.
            matrix[0][4] = 1e6;
            assert!((log_radius(&matrix) - libm::log(growth)).abs() < 1e-9, "{growth}");
        }
    }
}
