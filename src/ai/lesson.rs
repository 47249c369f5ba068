//! Lessons: how a player learns to allow for throw, by practice shots in the simulation (paper,
//! section 5.4.3).
//!
//! The player knows cut and aim and sees where the object ball goes; it never looks into the
//! simulation. What it shall learn depends on the contact laws, which a [`Condition`] names.

mod conditions;
mod drill;
mod exams;
mod summary;
mod throws;

pub use conditions::{Condition, PaperFigures, conditions};
pub use drill::{Drill, Sighting, practice_table};
pub use exams::{Demand, Exam, exams};
pub use summary::{HITS_OVER, Summary, mean_hit_rate};
pub use throws::{THROW_CELLS, pot_error_deg, throw_cell, throw_table};

use super::AimLearner;
use super::geometry::turned;
use super::noise::normal;
use super::plan::COMMANDED_LIMIT_RAD;
use super::speed::{self, BALL_PER_TIP_SPEED};
use crate::ball::POOL_RADIUS_M;
use crate::physics::{PhysicsError, Simulation};
use core::ops::Range;
use glam::DVec2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const DEGREE: f64 = core::f64::consts::PI / 180.0;
/// How far a ball in the way lies off the wanted direction [rad]: it turns the object ball away by
/// about as much as is left to a right angle.
const OBSTACLE_RAD: Range<f64> = 20.0 * DEGREE..65.0 * DEGREE;
/// The room between it and the object ball [m].
const OBSTACLE_GAP_M: Range<f64> = 0.001..0.01;
/// Half of what a ball may be off at a pocket [m].
const HALF_WINDOW_M: f64 = 0.029;

/// What is practised, how it is seen, and how it is learned from.
#[derive(Debug, Clone, PartialEq)]
pub struct Lesson {
    /// How many shots.
    pub shots: u32,
    /// f before the first.
    pub start_factor: f64,
    /// r of [`AimLearner`], gained per degree of mean error.
    pub rate_per_deg: f64,
    /// w of [`AimLearner`], weight of a new error.
    pub weight: f64,
    /// Cuts of either side [°].
    pub cut_deg: Range<f64>,
    /// Ways of the cue ball [m].
    pub to_ball_m: Range<f64>,
    /// How hard it is struck.
    pub strength: Strength,
    /// Ways of the object ball to its pocket [m].
    pub to_pocket_m: Range<f64>,
    /// Standard deviation of what the player sees of the direction [°].
    pub observation_error_deg: f64,
    /// Share of shots in which the object ball hits another on its way, unnoticed.
    pub outliers: f64,
    /// Whether the learner sorts out errors above its threshold.
    pub threshold: bool,
}

/// How hard the cue ball is struck.
#[derive(Debug, Clone, PartialEq)]
pub enum Strength {
    /// So that it would leave with one of these speeds [m/s].
    BallSpeed(Range<f64>),
    /// As the paper's player strikes in play: in a band above what the ways need.
    AsPlayed,
}

impl Default for Lesson {
    fn default() -> Self {
        Lesson {
            shots: 60,
            start_factor: 0.0,
            rate_per_deg: 0.015,
            weight: 0.5,
            cut_deg: 3.0..55.0,
            to_ball_m: 0.2..1.2,
            strength: Strength::BallSpeed(1.0..5.0),
            to_pocket_m: 0.3..1.4,
            observation_error_deg: 0.76,
            outliers: 0.12,
            threshold: true,
        }
    }
}

/// A shot of a lesson.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Cut β [°]; the side drops out.
    pub cut_deg: f64,
    /// Speed of the tip [m/s].
    pub tip_speed_m_s: f64,
    /// α as the player saw it [°]; none if it missed the ball.
    pub error_deg: Option<f64>,
    /// Errors up to this were believed [°].
    pub threshold_deg: f64,
    /// Whether this one was.
    pub believed: bool,
    /// a, the mean error after the shot [°].
    pub mean_error_deg: f64,
    /// f after the shot.
    pub factor: f64,
    /// A ball lay in the way.
    pub obstructed: bool,
    /// Whether the ball would have fallen; none if something lay in its way.
    pub hit: Option<bool>,
}

/// All shots of a lesson with one seed, on a [`practice_table`].
///
/// Every shot draws the same numbers whatever comes of it, so that two conditions with one seed
/// play the same shots.
///
/// # Errors
/// [`PhysicsError`] if the simulation gives up.
pub fn practise(
    lesson: &Lesson,
    table: &Simulation,
    seed: u64,
) -> Result<Vec<Trial>, PhysicsError> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut learner =
        AimLearner::with_rate(lesson.start_factor, lesson.rate_per_deg, lesson.weight);
    if !lesson.threshold {
        learner = learner.without_threshold();
    }
    (0..lesson.shots).map(|_| lesson.trial(table, &mut learner, &mut random)).collect()
}

impl Lesson {
    fn trial(
        &self,
        table: &Simulation,
        learner: &mut AimLearner,
        random: &mut Pcg64Mcg,
    ) -> Result<Trial, PhysicsError> {
        let cut_rad = random.random_range(self.cut_deg.clone()) * DEGREE;
        let side = if random.random_bool(0.5) { 1.0 } else { -1.0 };
        let to_ball_m = random.random_range(self.to_ball_m.clone());
        let to_pocket_m = random.random_range(self.to_pocket_m.clone());
        let tip_speed_m_s = match &self.strength {
            Strength::BallSpeed(band) => random.random_range(band.clone()) / BALL_PER_TIP_SPEED,
            Strength::AsPlayed => speed::pot_strength(to_ball_m, cut_rad, to_pocket_m, random),
        };
        let misreading_deg = self.observation_error_deg * normal(random);
        let obstructed = random.random::<f64>() < self.outliers;
        let off_rad = random.random_range(OBSTACLE_RAD);
        let off_rad = if random.random_bool(0.5) { off_rad } else { -off_rad };
        let away_m = 2.0 * POOL_RADIUS_M + random.random_range(OBSTACLE_GAP_M);

        let drill = Drill {
            cut_rad: side * cut_rad,
            commanded_rad: side * learner.command(cut_rad, COMMANDED_LIMIT_RAD),
            to_ball_m,
            tip_speed_m_s,
            obstacle: obstructed.then(|| turned(DVec2::X, off_rad) * away_m),
        };
        let true_deg = drill.play(table)?.map(|seen| seen.error_deg);
        let error_deg = true_deg.map(|error| error + misreading_deg);
        let threshold_deg = learner.threshold_deg();
        let believed = error_deg.is_some_and(|error| learner.learn(error));
        let falls = error_deg.map(|error| error.abs() * DEGREE * to_pocket_m < HALF_WINDOW_M);
        Ok(Trial {
            cut_deg: cut_rad / DEGREE,
            tip_speed_m_s,
            error_deg,
            threshold_deg,
            believed,
            mean_error_deg: learner.mean_error_deg(),
            factor: learner.factor,
            obstructed,
            hit: (!obstructed).then(|| falls.unwrap_or(false)),
        })
    }
}
