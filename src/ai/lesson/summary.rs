//! What many lessons have in common.

use super::Trial;

/// Hits are averaged over this many shots (paper, section 5.4.2).
pub const HITS_OVER: usize = 10;
/// f is held against the paper's after this many shots.
const TWENTY: usize = 20;
/// E_c is the mean of this many accepted errors.
const ACCEPTED: usize = 30;
/// f of the paper ± 0.1 [paper, figure 5.5].
const BAND: core::ops::RangeInclusive<f64> = 0.35..=0.55;

/// Means over many seeds of one lesson. What there is no shot for is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// How many seeds.
    pub seeds: usize,
    /// f after 5, 10, 20 and all shots.
    pub factors: [Option<f64>; 4],
    /// Share of the seeds with f within 0.45 ± 0.1 after 20 shots.
    pub in_band: Option<f64>,
    /// E_c: mean size of the last 30 accepted errors [°].
    pub error_deg: Option<f64>,
    /// Hit rate of the first 10 shots.
    pub first_hits: Option<f64>,
    /// Hit rate of all shots after 20.
    pub later_hits: Option<f64>,
}

impl Summary {
    /// The summary of lessons of the same length.
    pub fn of(courses: &[Vec<Trial>]) -> Self {
        let over = |value: &dyn Fn(&[Trial]) -> Option<f64>| {
            mean(courses.iter().filter_map(|course| value(course)))
        };
        let factor = |shots: usize| over(&|course| Some(course.get(shots - 1)?.factor));
        Summary {
            seeds: courses.len(),
            factors: [factor(5), factor(10), factor(TWENTY), over(&|c| Some(c.last()?.factor))],
            in_band: over(&|course| {
                let factor = course.get(TWENTY - 1)?.factor;
                Some(f64::from(u8::from(BAND.contains(&factor))))
            }),
            error_deg: over(&|course| {
                let accepted = course.iter().rev().filter(|trial| trial.believed).take(ACCEPTED);
                mean(accepted.filter_map(|trial| trial.error_deg).map(f64::abs))
            }),
            first_hits: over(&|course| hit_rate(course.get(..HITS_OVER)?)),
            later_hits: over(&|course| hit_rate(course.get(TWENTY..)?)),
        }
    }
}

/// Hit rate of the last [`HITS_OVER`] shots up to each one, those with a ball in the way left out.
pub fn mean_hit_rate(course: &[Trial]) -> Vec<Option<f64>> {
    let upto = |end: usize| hit_rate(&course[(end + 1).saturating_sub(HITS_OVER)..=end]);
    (0..course.len()).map(upto).collect()
}

fn hit_rate(trials: &[Trial]) -> Option<f64> {
    mean(trials.iter().filter_map(|trial| trial.hit).map(|hit| f64::from(u8::from(hit))))
}

fn mean(numbers: impl Iterator<Item = f64>) -> Option<f64> {
    let (count, sum) = numbers.fold((0.0, 0.0), |(count, sum), number| (count + 1.0, sum + number));
    (count > 0.0).then(|| sum / count)
}
