//! How sure a share is: Wilson's interval, and when a test may stop counting.

/// The standard normal distribution's 97.5 % point.
const Z: f64 = 1.959_963_984_540_054;

/// Wilson's score interval at 95 % for the chance behind `hits` of `trials` (Wilson 1927); 0 to 1
/// without trials.
pub fn wilson(hits: u32, trials: u32) -> [f64; 2] {
    if trials == 0 {
        return [0.0, 1.0];
    }
    let n = f64::from(trials);
    let p = f64::from(hits) / n;
    let middle = (p + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n);
    let half = Z / (1.0 + Z * Z / n) * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    [(middle - half).max(0.0), (middle + half).min(1.0)]
}

/// A sequential test of whether a chance reaches a goal (Wald 1945).
///
/// It tests `p = goal − d` against `p = goal + d` with `d = min(0.05, (1 − goal) / 2)`, and errs
/// with 5 % either way. A chance nearer to the goal than d may stay undecided for long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SequentialTest {
    /// The chance that is asked for.
    goal: f64,
}

/// What a [`SequentialTest`] says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// The goal is reached.
    Reached,
    /// It is missed.
    Missed,
    /// More trials are needed.
    Open,
}

/// Errors of the first and of the second kind.
const ERROR: f64 = 0.05;
/// Half the width of the range around the goal that the test does not resolve, at most.
const HALF_WIDTH: f64 = 0.05;

impl SequentialTest {
    /// A test for a goal; none unless the goal lies above 0.05 and below 1.
    pub fn new(goal: f64) -> Option<Self> {
        (HALF_WIDTH < goal && goal < 1.0).then_some(SequentialTest { goal })
    }

    /// The chance that is asked for.
    pub fn goal(self) -> f64 {
        self.goal
    }

    /// What so many hits and misses say: the logarithm of the likelihood ratio against
    /// `± ln((1 − error) / error)`.
    pub fn decide(self, hits: u32, misses: u32) -> Decision {
        let half = HALF_WIDTH.min((1.0 - self.goal) / 2.0);
        let (low, high) = (self.goal - half, self.goal + half);
        let ratio = f64::from(hits) * libm::log(high / low)
            + f64::from(misses) * libm::log((1.0 - high) / (1.0 - low));
        let bound = libm::log((1.0 - ERROR) / ERROR);
        if ratio >= bound {
            Decision::Reached
        } else if ratio <= -bound {
            Decision::Missed
        } else {
            Decision::Open
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_interval_of_eight_in_ten() {
        // Brown, Cai and DasGupta 2001 give 0.490 to 0.943.
        let [low, high] = wilson(8, 10);
        assert!((low - 0.490).abs() < 1e-3 && (high - 0.943).abs() < 1e-3, "{low} {high}");
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
    }

    #[test]
    fn a_goal_of_95_percent_takes_56_wins_in_a_row_or_3_losses() {
        // ln 19 = 2.944; a win adds ln(0.975 / 0.925), a loss ln(0.025 / 0.075).
        let test = SequentialTest::new(0.95).unwrap();
        assert_eq!(test.decide(55, 0), Decision::Open);
        assert_eq!(test.decide(56, 0), Decision::Reached);
        assert_eq!(test.decide(0, 2), Decision::Open);
        assert_eq!(test.decide(0, 3), Decision::Missed);
    }

    #[test]
    fn few_tests_err_when_the_chance_is_that_of_a_hypothesis() {
        use rand::{RngExt, SeedableRng};
        let test = SequentialTest::new(0.8).unwrap();
        for (chance, right) in [(0.85, Decision::Reached), (0.75, Decision::Missed)] {
            let mut wrong = 0;
            for seed in 0..400 {
                let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
                let (mut hits, mut misses) = (0, 0);
                let said = loop {
                    let hit = rng.random::<f64>() < chance;
                    (hits, misses) = (hits + u32::from(hit), misses + u32::from(!hit));
                    match test.decide(hits, misses) {
                        Decision::Open => {}
                        said => break said,
                    }
                };
                wrong += u32::from(said != right);
            }
            // 5 % of 400 are 20, with a standard deviation of 4.4.
            assert!(wrong <= 33, "{chance}: {wrong} of 400");
        }
    }

    #[test]
    fn a_goal_that_leaves_no_room_is_none() {
        assert!(SequentialTest::new(1.0).is_none() && SequentialTest::new(0.05).is_none());
    }
}
