//! How a player learns to allow for throw (paper, section 5.4.3).

/// Share of a new error in the pre-filter.
const FILTER: f64 = 0.3;
/// The pre-filter before anything was seen [°].
const FILTER_START_DEG: f64 = 8.0;
/// The threshold over the pre-filtered error, and its least and greatest value [°].
const OPENING: f64 = 2.0;
const THRESHOLD_DEG: (f64, f64) = (1.5, 20.0);
/// f cannot leave this range.
const RANGE: (f64, f64) = (-0.9, 1.5);

/// Learns f, by which a player aims steeper than geometry says: to cut by β, it commands (1 + f) β.
///
/// Per shot, with α the error of the object ball's direction [°], positive when it left too
/// straight, that is towards the cue ball's line:
/// ```text
/// T = clamp(2 m, 1.5°, 20°)             m ← m + 0.3 (min(|α|, 2 m + 1) − m)
/// if |α| ≤ T:   a ← a + w (α − a)       f ← f + r a,  within −0.9 and 1.5
/// ```
/// The pre-filter m decides what is believed: a ball that was hit on its way says nothing about the
/// aim. Limits: f is constant over all cuts, so it fits the small ones and overdoes the large
/// ones, where the surfaces slip. Under the paper's friction it settles at 0.45.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AimLearner {
    /// f.
    pub factor: f64,
    /// a, the mean error [°].
    mean_deg: f64,
    /// m, the pre-filtered size of the errors [°].
    filtered_deg: f64,
    /// r, gained per degree of mean error.
    rate_per_deg: f64,
    /// w, weight of a new error.
    weight: f64,
    /// Every error is believed.
    credulous: bool,
}

impl AimLearner {
    /// The learner of the paper's figures: r = 0.015 per degree, w = 0.5.
    pub fn new(factor: f64) -> Self {
        Self::with_rate(factor, 0.015, 0.5)
    }

    /// A learner of another pace.
    pub fn with_rate(factor: f64, rate_per_deg: f64, weight: f64) -> Self {
        let (mean_deg, filtered_deg) = (0.0, FILTER_START_DEG);
        AimLearner { factor, mean_deg, filtered_deg, rate_per_deg, weight, credulous: false }
    }

    /// The same learner with the threshold off: every error is believed.
    #[must_use]
    pub fn without_threshold(mut self) -> Self {
        self.credulous = true;
        self
    }

    /// T: the next error is believed if its size is at most this [°]; infinite with the threshold
    /// off.
    pub fn threshold_deg(&self) -> f64 {
        if self.credulous {
            return f64::INFINITY;
        }
        (OPENING * self.filtered_deg).clamp(THRESHOLD_DEG.0, THRESHOLD_DEG.1)
    }

    /// a, the mean of the errors that were believed [°].
    pub fn mean_error_deg(&self) -> f64 {
        self.mean_deg
    }

    /// The cut to command for a wanted one, at most `limit`; in any unit.
    pub fn command(&self, cut: f64, limit: f64) -> f64 {
        ((1.0 + self.factor) * cut).min(limit)
    }

    /// Takes the error of a shot [°]; returns whether it was believed.
    pub fn learn(&mut self, error_deg: f64) -> bool {
        let size = error_deg.abs();
        let threshold = self.threshold_deg();
        // The clip keeps one outlier from opening the threshold.
        let clipped = size.min(2.0 * self.filtered_deg + 1.0);
        self.filtered_deg += FILTER * (clipped - self.filtered_deg);
        let believed = size <= threshold;
        if believed {
            self.mean_deg += self.weight * (error_deg - self.mean_deg);
            let factor = self.factor + self.rate_per_deg * self.mean_deg;
            self.factor = factor.clamp(RANGE.0, RANGE.1);
        }
        believed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_in_proportion_to_the_cut_is_learnt_away() {
        // Throw takes 0.31 of what is commanded: f must end at 1/(1 − 0.31) − 1.
        let mut learner = AimLearner::new(0.0);
        for shot in 0..200 {
            let cut = 5.0 + f64::from(shot * 37 % 40);
            let error = cut - learner.command(cut, 89.0) * (1.0 - 0.31);
            learner.learn(error);
        }
        assert!((learner.factor - 0.449).abs() < 0.005, "{}", learner.factor);
    }

    #[test]
    fn outliers_are_not_believed_once_errors_are_small() {
        let mut learner = AimLearner::new(0.1);
        for _ in 0..20 {
            assert!(learner.learn(0.2));
        }
        let before = learner.factor;
        assert!(!learner.learn(30.0) && !learner.learn(-45.0));
        assert_eq!(learner.factor, before);
    }
}
