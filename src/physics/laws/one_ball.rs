//! One ball at two or three surfaces at once, solved directly: cushion and bed, a corner, a corner
//! and the bed.
//!
//! The conditions are those of [`super::cluster`]: for each contact, with u the velocity of the
//! ball's skin after the impulses,
//! ```text
//! 0 ≤ Jn  ⊥  u·n − target ≥ 0
//! |Jt| ≤ μ Jn: u_t = 0 inside of that disc, Jt against u_t on its edge
//! ```
//! Newton's method on the projections (Alart and Curnier 1991) meets them in a handful of linear
//! solves of 6 or 9 unknowns, whatever sticks and whatever slips; Gauss-Seidel needs 15 to 40
//! sweeps for the same digits. Limits: Newton's method may circle; then there is no answer and the
//! caller sweeps.

use super::Mover;
use glam::DVec3;
use smallvec::SmallVec;

/// Most surfaces at once.
pub const SURFACES_MAX: usize = 3;
/// Sweeps before the first of Newton's iterations; each costs a tenth of one.
const SWEEPS: usize = 3;
/// Iterations before giving up.
const ITERATIONS: usize = 12;
/// Relative change of impulses that ends the iteration. It converges quadratically, so what is left
/// then is the square of this.
const RELATIVE: f64 = 1e-8;

/// A fixed surface that the ball touches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface {
    /// Unit vector from the surface to the centre.
    pub normal: DVec3,
    /// Normal velocity that the contact must leave at least [m/s].
    pub target_m_s: f64,
    /// Friction coefficient.
    pub friction: f64,
}

/// The impulses of the surfaces on the ball [N s], in their order; none if there are more than
/// [`SURFACES_MAX`] or the iteration does not settle.
pub fn solve(ball: &Mover, surfaces: &[Surface]) -> Option<SmallVec<[DVec3; SURFACES_MAX]>> {
    if ball.inverse_mass == 0.0 {
        return None;
    }
    match surfaces.len() {
        1 => settle::<3>(ball, surfaces),
        2 => settle::<6>(ball, surfaces),
        3 => settle::<9>(ball, surfaces),
        _ => None,
    }
}

/// The solution for `N` unknowns, three a surface.
fn settle<const N: usize>(
    ball: &Mover,
    surfaces: &[Surface],
) -> Option<SmallVec<[DVec3; SURFACES_MAX]>> {
    let frames: SmallVec<[[DVec3; 3]; SURFACES_MAX]> = surfaces
        .iter()
        .map(|surface| {
            let (t, b) = surface.normal.any_orthonormal_pair();
            [surface.normal, t, b]
        })
        .collect();

    // u = start + W J in the frames of the contacts.
    let mut yields = [[0.0; N]; N];
    let mut start = [0.0; N];
    let turns = ball.radius_m * ball.radius_m * ball.inverse_inertia;
    for (i, frame) in frames.iter().enumerate() {
        let skin = ball.surface_velocity(frame[0]);
        for (p, axis) in frame.iter().enumerate() {
            let k = 3 * i + p;
            start[k] = skin.dot(*axis);
            yields[k][k] = ball.inverse_mass + if p > 0 { turns } else { 0.0 };
        }
        for (j, other) in frames.iter().enumerate().take(i) {
            let block = yields_between(frame, other, ball.inverse_mass, turns);
            for (p, row) in block.iter().enumerate() {
                for (q, value) in row.iter().enumerate() {
                    yields[3 * i + p][3 * j + q] = *value;
                    yields[3 * j + q][3 * i + p] = *value;
                }
            }
        }
    }

    let mut impulses = first_guess(&start, &yields, surfaces);
    for _ in 0..ITERATIONS {
        let mut velocity = start;
        for (u, row) in velocity.iter_mut().zip(&yields) {
            *u += row.iter().zip(&impulses).map(|(w, j)| w * j).sum::<f64>();
        }
        let mut matrix = [[0.0; N]; N];
        let mut right = [0.0; N];
        for (i, surface) in surfaces.iter().enumerate() {
            rows(i, surface, &velocity, &yields, &impulses, &mut matrix, &mut right);
        }
        let change = eliminate(&mut matrix, &mut right)?;
        let mut largest: f64 = 0.0;
        let mut moved: f64 = 0.0;
        for (impulse, change) in impulses.iter_mut().zip(&change) {
            *impulse += change;
            largest = largest.max(impulse.abs());
            moved = moved.max(change.abs());
        }
        if !moved.is_finite() {
            return None;
        }
        if moved <= RELATIVE * largest {
            let vector = |i: usize| {
                frames[i].iter().zip(&impulses[3 * i..]).map(|(axis, j)| *axis * *j).sum()
            };
            return Some((0..surfaces.len()).map(vector).collect());
        }
    }
    None
}

/// How the skin at one contact yields along its axes to impulses along those of another:
/// p·q/m + (R²/I) (n·n′ p·q − p·n′ q·n).
fn yields_between(
    frame: &[DVec3; 3],
    other: &[DVec3; 3],
    inverse_mass: f64,
    turns: f64,
) -> [[f64; 3]; 3] {
    let cosine = frame.map(|p| other.map(|q| p.dot(q)));
    let mut block = cosine;
    for (p, row) in block.iter_mut().enumerate() {
        for (q, value) in row.iter_mut().enumerate() {
            let turned = cosine[0][0] * cosine[p][q] - cosine[p][0] * cosine[0][q];
            *value = inverse_mass * cosine[p][q] + turns * turned;
        }
    }
    block
}

/// A few sweeps of projected Gauss-Seidel: which contacts act, and against which slip.
fn first_guess<const N: usize>(
    start: &[f64; N],
    yields: &[[f64; N]; N],
    surfaces: &[Surface],
) -> [f64; N] {
    let mut impulses = [0.0; N];
    let velocity = |impulses: &[f64; N], k: usize| {
        start[k] + yields[k].iter().zip(impulses).map(|(w, j)| w * j).sum::<f64>()
    };
    let order = (0..SWEEPS).flat_map(|_| surfaces.iter().enumerate());
    for (i, surface) in order {
        let k = 3 * i;
        let lacks = surface.target_m_s - velocity(&impulses, k);
        impulses[k] = (impulses[k] + lacks / yields[k][k]).max(0.0);
        let [a, b] = [k + 1, k + 2].map(|k| impulses[k] - velocity(&impulses, k) / yields[k][k]);
        let (size, limit) = ((a * a + b * b).sqrt(), surface.friction * impulses[k]);
        let scale = if size > limit { limit / size } else { 1.0 };
        (impulses[k + 1], impulses[k + 2]) = (a * scale, b * scale);
    }
    impulses
}

/// The three linear equations of a contact for the change of the impulses.
#[allow(clippy::too_many_arguments)]
fn rows<const N: usize>(
    index: usize,
    surface: &Surface,
    velocity: &[f64; N],
    yields: &[[f64; N]; N],
    impulses: &[f64; N],
    matrix: &mut [[f64; N]; N],
    right: &mut [f64; N],
) {
    let (n, t, b) = (3 * index, 3 * index + 1, 3 * index + 2);
    // Open: no impulse at all.
    if impulses[n] - (velocity[n] - surface.target_m_s) / yields[n][n] <= 0.0 {
        for k in [n, t, b] {
            matrix[k][k] = 1.0;
            right[k] = -impulses[k];
        }
        return;
    }
    matrix[n] = yields[n];
    right[n] = surface.target_m_s - velocity[n];

    let stiff = 1.0 / yields[t][t];
    let trial = [impulses[t] - velocity[t] * stiff, impulses[b] - velocity[b] * stiff];
    let length = (trial[0] * trial[0] + trial[1] * trial[1]).sqrt();
    let limit = surface.friction * impulses[n].max(0.0);
    // Sticks: no slip.
    if length <= limit {
        for k in [t, b] {
            matrix[k] = yields[k];
            right[k] = -velocity[k];
        }
        return;
    }
    // Slips: Jt = μ Jn â, â along the trial, and how that changes with the impulses.
    let along = [trial[0] / length, trial[1] / length];
    let turn = limit / length;
    for (own, k) in [(0, t), (1, b)] {
        right[k] = limit * along[own] - impulses[k];
        for column in 0..N {
            let change = [t, b].map(|k| {
                let unit = if k == column { 1.0 } else { 0.0 };
                unit - yields[k][column] * stiff
            });
            let radial = along[0] * change[0] + along[1] * change[1];
            let unit = if k == column { 1.0 } else { 0.0 };
            matrix[k][column] = unit - turn * (change[own] - along[own] * radial);
        }
        matrix[k][n] -= surface.friction * along[own];
    }
}

/// Gauss's elimination with the largest pivot of each column; none if the matrix is singular.
#[allow(clippy::needless_range_loop)]
fn eliminate<const N: usize>(matrix: &mut [[f64; N]; N], right: &mut [f64; N]) -> Option<[f64; N]> {
    for column in 0..N {
        let (mut pivot, mut largest) = (column, matrix[column][column].abs());
        for row in column + 1..N {
            let size = matrix[row][column].abs();
            if size > largest {
                (pivot, largest) = (row, size);
            }
        }
        if !(largest >= 1e-12) {
            return None;
        }
        if pivot != column {
            matrix.swap(column, pivot);
            right.swap(column, pivot);
        }
        let leading = matrix[column];
        let inverse = 1.0 / leading[column];
        for row in column + 1..N {
            let factor = matrix[row][column] * inverse;
            if factor != 0.0 {
                // Whole rows: what is left of the column is never read again, and the loop has no
                // bounds to check.
                for k in 0..N {
                    matrix[row][k] -= factor * leading[k];
                }
                right[row] -= factor * right[column];
            }
        }
    }
    let mut solution = [0.0; N];
    for row in (0..N).rev() {
        let mut known = 0.0;
        for k in row + 1..N {
            known += matrix[row][k] * solution[k];
        }
        solution[row] = (right[row] - known) / matrix[row][row];
    }
    Some(solution)
}
