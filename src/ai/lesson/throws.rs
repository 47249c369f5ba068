//! How a throw table is learned: a lesson for each of its cells.

use super::{COMMANDED_LIMIT_RAD, DEGREE, Drill, Lesson};
use crate::ai::speed::{self, BALL_PER_TIP_SPEED, arrival_speed, launch_speed};
use crate::ai::{AimLearner, ThrowTable};
use crate::physics::{PhysicsError, Simulation};
use core::ops::Range;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Rows of the table [°].
const CUTS_DEG: [f64; 12] = [2.5, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 78.0];
/// Its columns [m/s].
const SPEEDS_M_S: [f64; 14] =
    [0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 9.0];
/// How many cells there are.
pub const THROW_CELLS: usize = CUTS_DEG.len() * SPEEDS_M_S.len();
/// Ways of the cue ball [m].
const TO_BALL_M: Range<f64> = 0.15..1.5;
/// Cuts of the pots that a table is tried on [°].
const POT_CUTS_DEG: Range<f64> = 3.0..70.0;
/// r β, what a shot corrects of the error of its cut.
const RATE: f64 = 0.3;
/// w of the learner.
const WEIGHT: f64 = 0.5;

/// f of a cell, counted row by row: the mean of the last half of `shots` shots that begin with
/// f = 0, each with the cue ball at the cell's speed when it meets the ball, over random distances.
///
/// # Errors
/// [`PhysicsError`] if the simulation gives up.
pub fn throw_cell(
    cell: usize,
    table: &Simulation,
    seed: u64,
    shots: u32,
) -> Result<f64, PhysicsError> {
    let cut_deg = CUTS_DEG[cell / SPEEDS_M_S.len() % CUTS_DEG.len()];
    let ball_speed_m_s = SPEEDS_M_S[cell % SPEEDS_M_S.len()];
    let mut random = Pcg64Mcg::seed_from_u64(seed ^ (cell as u64) << 32);
    let mut learner = AimLearner::with_rate(0.0, RATE / cut_deg, WEIGHT);
    let (mut sum, mut count) = (0.0, 0.0);
    for shot in 0..shots {
        let to_ball_m = random.random_range(TO_BALL_M);
        let cut_rad = cut_deg * DEGREE;
        let drill = Drill {
            cut_rad,
            commanded_rad: learner.command(cut_rad, COMMANDED_LIMIT_RAD),
            to_ball_m,
            tip_speed_m_s: launch_speed(to_ball_m, ball_speed_m_s) / BALL_PER_TIP_SPEED,
            obstacle: None,
        };
        if let Some(seen) = drill.play(table)? {
            learner.learn(seen.error_deg);
        }
        if shot >= shots / 2 {
            sum += learner.factor;
            count += 1.0;
        }
    }
    Ok(if count > 0.0 { sum / count } else { learner.factor })
}

/// A throw table of its cells' factors, in the order of [`throw_cell`].
pub fn throw_table(factors: &[f64], seed: u64, shots: u32) -> ThrowTable {
    ThrowTable {
        seed,
        shots,
        cuts_deg: CUTS_DEG.to_vec(),
        speeds_m_s: SPEEDS_M_S.to_vec(),
        factors: factors.chunks(SPEEDS_M_S.len()).map(<[f64]>::to_vec).collect(),
    }
}

/// Mean size of the error of the object ball's direction over `pots` random pots [°], aimed with
/// f = `factor`(cut [rad], speed of the cue ball when it meets the ball [m/s]). Cuts of 3° to 70°,
/// strokes as the paper's player makes them; the speed is what a player reckons, not what comes.
///
/// # Errors
/// [`PhysicsError`] if the simulation gives up.
pub fn pot_error_deg(
    factor: impl Fn(f64, f64) -> f64,
    table: &Simulation,
    seed: u64,
    pots: u32,
) -> Result<f64, PhysicsError> {
    let usual = Lesson::default();
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let (mut sum, mut count) = (0.0, 0.0);
    for _ in 0..pots {
        let cut_rad = random.random_range(POT_CUTS_DEG) * DEGREE;
        let to_ball_m = random.random_range(usual.to_ball_m.clone());
        let to_pocket_m = random.random_range(usual.to_pocket_m.clone());
        let tip_speed_m_s = speed::pot_strength(to_ball_m, cut_rad, to_pocket_m, &mut random);
        let arrives_m_s = arrival_speed(BALL_PER_TIP_SPEED * tip_speed_m_s, to_ball_m);
        let commanded_rad = (1.0 + factor(cut_rad, arrives_m_s)) * cut_rad;
        let drill = Drill { cut_rad, commanded_rad, to_ball_m, tip_speed_m_s, obstacle: None };
        if let Some(seen) = drill.play(table)? {
            sum += seen.error_deg.abs();
            count += 1.0;
        }
    }
    Ok(if count > 0.0 { sum / count } else { 0.0 })
}
