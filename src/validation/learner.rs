//! The aiming learner, over many seeds of shots with noise (paper, section 5.4.3).

use super::error::{Trouble, unsupported};
use super::impacts::clamp;
use super::observed::{Observations, degrees};
use super::setup::Setup;
use super::shapes::Topspin;
use crate::ai::{AimLearner, normal};
use crate::ball::Ball;
use crate::ids::BallId;
use crate::physics::Contact;
use crate::physics::laws::{Mover, ball_ball};
use core::f64::consts::PI;
use core::ops::Range;
use glam::DVec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Shots that a run may ask for in all.
const SHOTS_MAX: u64 = 10_000_000;
/// f is read after this many shots, and hits are counted over the last as many.
const TWENTY: usize = 20;
/// Errors are averaged over this many accepted shots.
const ACCEPTED: usize = 30;

/// What a run says about its shots.
struct Ranges {
    cut: Range<f64>,
    speed: Range<f64>,
    outlier: Range<f64>,
    distance: Range<f64>,
}

struct Game {
    ranges: Ranges,
    outliers: f64,
    noise_deg: f64,
    topspin: Topspin,
    limit_deg: f64,
    half_window_m: f64,
    outliers_count: bool,
    ball: Ball,
    law: Contact,
    clamped: bool,
    late_s: f64,
}

/// What one seed shows.
struct Course {
    factor: f64,
    error_deg: Option<f64>,
    hits: Option<f64>,
}

pub(super) fn observe(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let seeds = setup.count("seeds")?.unwrap_or(0);
    let shots = setup.count("shots")?.unwrap_or(0);
    if seeds == 0 || shots < TWENTY as u64 || seeds.saturating_mul(shots) > SHOTS_MAX {
        return unsupported("a learner needs 20 shots or more, and 10000000 in all at most");
    }
    let clamped = match setup.law {
        "default" | "constant_friction" => false,
        "clamp_2009" => true,
        law => return unsupported(format!("law {law} has no meaning for the learner")),
    };
    let game = Game {
        ranges: Ranges {
            cut: setup.range("cut_range_deg")?,
            speed: setup.range("speed_range_m_s")?,
            outlier: setup.range("outlier_range_deg")?,
            distance: setup.range("pocket_distance_range_m")?,
        },
        outliers: setup.number_or_zero("outlier_fraction")?,
        noise_deg: setup.number_or_zero("observation_error_deg")?,
        topspin: setup.topspin()?,
        limit_deg: setup.number("commanded_cut_limit_deg")?,
        half_window_m: setup.number("pocket_half_window_m")?,
        outliers_count: setup.switch("hit_counts_outliers")?,
        ball: Ball { radius_m: setup.positive("R_m")?, ..Ball::pool(BallId(0)) },
        law: Contact {
            restitution: setup.number("e_ball")?,
            friction: setup.number_or_zero("mu_ball")?,
        },
        clamped,
        late_s: setup.number_or_zero("detection_step_s")?.max(0.0),
    };
    let start = AimLearner::with_rate(
        setup.number_or_zero("start_f")?,
        setup.number("rate_per_deg")?,
        setup.number("weight")?,
    );
    let courses: Vec<Course> = (0..seeds).map(|seed| game.course(start, seed, shots)).collect();

    let band = setup.range("f_band")?;
    let inside = |course: &&Course| band.start <= course.factor && course.factor <= band.end;
    let mut seen = Observations::default();
    let factors: Vec<f64> = courses.iter().map(|course| course.factor).collect();
    seen.maybe("f_after_20", mean(&factors));
    let errors: Vec<f64> = courses.iter().filter_map(|course| course.error_deg).collect();
    seen.maybe("mean_accepted_error_deg", mean(&errors));
    let hits: Vec<f64> = courses.iter().filter_map(|course| course.hits).collect();
    seen.maybe("hit_rate_last_20", mean(&hits));
    let share = courses.iter().filter(inside).count() as f64 / seeds as f64;
    seen.set("fraction_of_seeds_in_band_at_20", share);
    Ok(seen)
}

fn mean(list: &[f64]) -> Option<f64> {
    (!list.is_empty()).then(|| list.iter().sum::<f64>() / list.len() as f64)
}

impl Game {
    fn course(&self, mut learner: AimLearner, seed: u64, shots: u64) -> Course {
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut accepted = Vec::new();
        let mut hits: Vec<Option<bool>> = Vec::new();
        let mut factor = learner.factor;
        for shot in 1..=shots {
            let cut = random.random_range(self.ranges.cut.clone());
            let speed = random.random_range(self.ranges.speed.clone());
            let distance = random.random_range(self.ranges.distance.clone());
            let late = self.late_s * random.random::<f64>();
            // The side of the cut drops out of the error.
            let commanded = learner.command(cut, self.limit_deg);
            let mut error = cut - self.object_ball_deg(commanded, speed, late);
            error += self.noise_deg * normal(&mut random);
            let wild = random.random::<f64>() < self.outliers;
            if wild {
                let sign = if random.random_bool(0.5) { 1.0 } else { -1.0 };
                error += sign * random.random_range(self.ranges.outlier.clone());
            }
            if learner.learn(error) {
                accepted.push(error.abs());
            }
            let hit = error.abs() * (PI / 180.0) * distance < self.half_window_m;
            hits.push((self.outliers_count || !wild).then_some(hit));
            if shot == TWENTY as u64 {
                factor = learner.factor;
            }
        }
        let last = &accepted[accepted.len().saturating_sub(ACCEPTED)..];
        let counted: Vec<f64> = hits[hits.len() - TWENTY..]
            .iter()
            .flatten()
            .map(|hit| f64::from(u8::from(*hit)))
            .collect();
        Course { factor, error_deg: mean(last), hits: mean(&counted) }
    }

    /// Direction of the object ball from the cue ball's line [°], for a cut that is noticed `late`.
    fn object_ball_deg(&self, cut_deg: f64, speed: f64, late: f64) -> f64 {
        let (sin, cos) = libm::sincos(cut_deg * (PI / 180.0));
        let reach = 2.0 * self.ball.radius_m;
        let line = DVec3::new(reach * cos - speed * late, reach * sin, 0.0).normalize_or(DVec3::X);
        let over = (self.topspin.at_rest + self.topspin.per_m_s * speed).max(self.topspin.lowest);
        let spin = DVec3::Y * (over * speed / self.ball.radius_m);
        let mut cue = Mover::new(&self.ball, DVec3::X * speed, spin);
        let mut object = Mover::new(&self.ball, DVec3::ZERO, DVec3::ZERO);
        if self.clamped {
            clamp(&mut cue, &mut object, -line, self.law);
        } else {
            let Contact { restitution, friction } = self.law;
            ball_ball::collide(&mut cue, &mut object, -line, restitution, friction);
        }
        degrees(libm::atan2(object.velocity.y, object.velocity.x))
    }
}
