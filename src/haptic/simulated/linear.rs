//! Small matrices: the exact step of a linear system under held inputs.

/// Most states.
pub(super) const STATES: usize = 4;
/// Inputs: a force on the handle, the intent.
const INPUTS: usize = 2;
const SIZE: usize = STATES + INPUTS;

type Square = [[f64; SIZE]; SIZE];

/// x′ = A x + b₀ F + b₁ intent.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Linear {
    pub state: [[f64; STATES]; STATES],
    pub force: [f64; STATES],
    pub intent: [f64; STATES],
}

impl Linear {
    /// The step over `h` with held inputs: the exponential of the system joined with its inputs
    /// (Van Loan 1978).
    pub fn step(&self, h: f64) -> Linear {
        let mut joined: Square = [[0.0; SIZE]; SIZE];
        for (row, into) in joined.iter_mut().take(STATES).enumerate() {
            into[..STATES].copy_from_slice(&self.state[row]);
            into[STATES] = self.force[row];
            into[STATES + 1] = self.intent[row];
        }
        let whole = exponential(&joined, h);
        let mut step = Linear::default();
        for (row, from) in whole.iter().take(STATES).enumerate() {
            step.state[row].copy_from_slice(&from[..STATES]);
            step.force[row] = from[STATES];
            step.intent[row] = from[STATES + 1];
        }
        step
    }

    /// The state after a step that [`Linear::step`] gave.
    pub fn apply(&self, x: &[f64; STATES], force: f64, intent: f64) -> [f64; STATES] {
        let mut next = [0.0; STATES];
        for (row, value) in next.iter_mut().enumerate() {
            let carried: f64 = self.state[row].iter().zip(x).map(|(a, x)| a * x).sum();
            *value = carried + self.force[row] * force + self.intent[row] * intent;
        }
        next
    }
}

/// exp(A h) by scaling, Taylor series and squaring.
fn exponential(a: &Square, h: f64) -> Square {
    let norm: f64 = a.iter().flatten().map(|x| (x * h).abs()).sum();
    // A system that is not finite gives a step that is not, after bounded work.
    let halvings = libm::ceil(libm::log2(norm.max(1e-9))).clamp(0.0, 1000.0) as i32 + 6;
    let scale = h / libm::exp2(f64::from(halvings));

    let mut sum = identity();
    let mut term = identity();
    for k in 1..=12 {
        term = product(&term, a);
        for row in &mut term {
            for x in row {
                *x *= scale / f64::from(k);
            }
        }
        for (into, from) in sum.iter_mut().flatten().zip(term.iter().flatten()) {
            *into += from;
        }
    }
    for _ in 0..halvings {
        sum = product(&sum, &sum);
    }
    sum
}

fn identity() -> Square {
    let mut one = [[0.0; SIZE]; SIZE];
    for (i, row) in one.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    one
}

fn product(a: &Square, b: &Square) -> Square {
    let mut out = [[0.0; SIZE]; SIZE];
    for (row, target) in a.iter().zip(&mut out) {
        for (k, factor) in row.iter().enumerate() {
            for (into, from) in target.iter_mut().zip(&b[k]) {
                *into += factor * from;
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::spring::propagator;

    #[test]
    fn the_step_of_an_oscillator_is_its_closed_form() {
        let (omega, damping) = (133.0, 0.125);
        let mut system = Linear::default();
        system.state[0][1] = 1.0;
        system.state[1] = [-omega * omega, -2.0 * damping * omega, 0.0, 0.0];
        for h in [5e-5, 1e-3, 4e-3, 0.1] {
            let (step, exact) = (system.step(h), propagator(omega, damping, h));
            for (row, expected) in exact.iter().flatten().enumerate() {
                let error = step.state[row / 2][row % 2] - expected;
                assert!(error.abs() < 1e-11 * omega, "{h}: {error:e}");
            }
        }
    }
}
