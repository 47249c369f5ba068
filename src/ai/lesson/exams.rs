//! What must come out of lessons for the paper's findings to be reproduced (section 5.4.3).

use super::{Condition, Lesson, Summary, conditions};
use core::ops::RangeInclusive;

/// A lesson under one condition, and what is demanded of many seeds of it.
#[derive(Debug, Clone)]
pub struct Exam {
    /// Which contact laws.
    pub condition: Condition,
    /// What is practised.
    pub lesson: Lesson,
    /// What must come out.
    pub demands: Vec<Demand>,
}

/// A figure and what it may be.
#[derive(Debug, Clone)]
pub struct Demand {
    /// The finding that it belongs to, `a` to `d`.
    pub finding: char,
    /// The figure, with its unit.
    pub what: &'static str,
    /// What it may be.
    pub allowed: RangeInclusive<f64>,
    figure: fn(&Summary) -> Option<f64>,
}

impl Demand {
    /// The figure, if there is one, and whether it is allowed.
    pub fn judge(&self, summary: &Summary) -> (Option<f64>, bool) {
        let value = (self.figure)(summary);
        (value, value.is_some_and(|value| self.allowed.contains(&value)))
    }
}

fn in_band(finding: char, allowed: RangeInclusive<f64>) -> Demand {
    let what = "share of seeds with f in 0.35 to 0.55 at shot 20";
    Demand { finding, what, allowed, figure: |summary| summary.in_band }
}

fn factor(finding: char, allowed: RangeInclusive<f64>) -> Demand {
    Demand { finding, what: "f at shot 20", allowed, figure: |summary| summary.factors[2] }
}

fn error(finding: char, allowed: RangeInclusive<f64>) -> Demand {
    Demand { finding, what: "E_c [deg]", allowed, figure: |summary| summary.error_deg }
}

/// The findings: (a) without ball friction and with the normal after the penetration the player
/// would cut too thin, so f falls below 0, and E_c is 1.4 ± 0.4; (b) back-dating brings f to 0 and
/// E_c to 0.6 ± 0.3; (c) with friction f comes to 0.45 ± 0.1 within 20 shots in nine seeds of ten,
/// and hits rise from below 50 % to 60 to 75 %; (d) without the threshold it does not, the less
/// the more balls are hit on their way.
pub fn exams() -> Vec<Exam> {
    let exam = |id: &str, outliers: f64, threshold: bool, demands: Vec<Demand>| {
        let condition = conditions().into_iter().find(|condition| condition.id == id)?;
        let lesson = Lesson { outliers, threshold, ..Lesson::default() };
        Some(Exam { condition, lesson, demands })
    };
    let first = Demand {
        finding: 'c',
        what: "hit rate of the first 10",
        allowed: 0.0..=0.5,
        figure: |summary| summary.first_hits,
    };
    let later = Demand {
        finding: 'c',
        what: "hit rate after 20",
        allowed: 0.6..=0.75,
        figure: |summary| summary.later_hits,
    };
    let usual = Lesson::default().outliers;
    let late = "2009_no_friction_no_back_dating";
    let exams = [
        exam(late, usual, true, vec![error('a', 1.0..=1.8), factor('a', -0.9..=-0.01)]),
        exam(
            "2009_no_friction",
            usual,
            true,
            vec![error('b', 0.3..=0.9), factor('b', -0.05..=0.05)],
        ),
        exam(
            "2009",
            usual,
            true,
            vec![
                in_band('c', 0.9..=1.0),
                factor('c', 0.35..=0.55),
                error('c', 1.1..=2.5),
                first,
                later,
            ],
        ),
        exam("2009", usual, false, vec![in_band('d', 0.0..=0.65)]),
        exam("2009", 0.3, true, vec![in_band('d', 0.85..=1.0)]),
        exam("2009", 0.3, false, vec![in_band('d', 0.0..=0.45)]),
    ];
    exams.into_iter().flatten().collect()
}
