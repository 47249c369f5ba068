//! Tables: a lesson shot by shot, and all conditions beside the paper's figures.

use super::super::json_line;
use super::{LearnArgs, Strokes, Taught};
use hapticbillard::ai::lesson::{Demand, Exam, Trial, mean_hit_rate};
use hapticbillard_actors::error::Error;
use serde_json::{Value, json};
use std::fmt::Write;

/// A lesson as comma-separated values, a line for each shot.
pub fn csv(course: &[Trial]) -> String {
    let mut text = String::from(
        "shot,cut_deg,tip_speed_m_s,obstructed,raw_error_deg,threshold_deg,accepted,\
         filtered_error_deg,f,hit,hit_rate_of_10\n",
    );
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.4}"));
    for ((shot, trial), rate) in (1..).zip(course).zip(mean_hit_rate(course)) {
        let hit = trial.hit.map_or("", |hit| if hit { "1" } else { "0" });
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{shot},{:.4},{:.4},{},{},{},{},{:.4},{:.5},{hit},{}",
            trial.cut_deg,
            trial.tip_speed_m_s,
            u8::from(trial.obstructed),
            number(trial.error_deg),
            number(Some(trial.threshold_deg).filter(|threshold| threshold.is_finite())),
            u8::from(trial.believed),
            trial.mean_error_deg,
            trial.factor,
            number(rate),
        );
    }
    text
}

fn factor(value: Option<f64>) -> String {
    // Zero has no sign here.
    let rounded = |value: f64| (1e2 * value).round() / 1e2 + 0.0;
    value.map_or_else(|| String::from("-"), |value| format!("{:.2}", rounded(value)))
}

fn percent(value: Option<f64>) -> String {
    value.map_or_else(|| String::from("-"), |value| format!("{:.0} %", 1e2 * value))
}

/// All conditions, a row each.
pub fn table(taught: &[Taught]) -> String {
    let mut text = String::from(
        "| condition | f after 5 / 10 / 20 / all | in 0.35 to 0.55 at 20 | E_c [°] | hits of the \
         first 10 | hits after 20 | paper: f | E_c [°] | hits |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for Taught { condition, summary, .. } in taught {
        let (paper_f, paper_error, paper_hits) = match condition.paper {
            Some(paper) => (paper.factor, format!("{}", paper.error_deg), paper.hits),
            None => ("-", String::from("-"), "-"),
        };
        let factors = summary.factors.map(factor).join(" / ");
        let _ = writeln!(
            text,
            "| {} | {factors} | {} | {} | {} | {} | {paper_f} | {paper_error} | {paper_hits} |",
            condition.title,
            percent(summary.in_band),
            factor(summary.error_deg),
            percent(summary.first_hits),
            percent(summary.later_hits),
        );
    }
    text
}

/// The page of a run.
pub fn page(taught: &[Taught], args: &LearnArgs) -> String {
    let lesson = args.lesson();
    let mut text = format!(
        "# Learning to aim\n\n\
         The paper's player cuts a ball by (1 + f) β where geometry says β, sees by which angle α \
         the ball left too straight, and learns f (section 5.4.3). {} lessons of {} shots each, \
         seeds from {}; f begins at {}. Every shot is simulated: cuts of {}° to {}° of either \
         side, the cue ball {} to {} m away, {}. The direction is read from two looks at the \
         object ball, the last 30 ms or 2 R of way after the contact, with an error of {}° \
         (standard deviation). In {} % of the shots the ball hits another on its way, which the \
         player does not notice{}. A shot is a hit if |α| times the way to the pocket, {} to {} \
         m, is below 29 mm; shots with a ball in the way do not count. E_c is the mean size of \
         the last 30 accepted errors.\n\n",
        args.seeds,
        lesson.shots,
        args.seed,
        lesson.start_factor,
        lesson.cut_deg.start,
        lesson.cut_deg.end,
        lesson.to_ball_m.start,
        lesson.to_ball_m.end,
        match args.strokes {
            Strokes::Wide => "leaving with 1 to 5 m/s",
            Strokes::Played => "struck as in play, in a band above what the ways need",
        },
        lesson.observation_error_deg,
        1e2 * lesson.outliers,
        if lesson.threshold { "" } else { "; the threshold is off" },
        lesson.to_pocket_m.start,
        lesson.to_pocket_m.end,
    );
    text.push_str(&table(taught));
    let _ = writeln!(
        text,
        "\nThe figures show the lesson with seed {}, and the means over all seeds as thin lines.",
        args.seed
    );
    for Taught { condition, .. } in taught {
        let _ = writeln!(text, "\n## {0}\n\n![{0}]({1}.svg)", condition.title, condition.id);
    }
    text
}

/// A condition's row as JSON.
pub fn json(taught: &Taught) -> Value {
    let Taught { condition, summary, .. } = taught;
    let paper = condition.paper.map(
        |paper| json!({ "f": paper.factor, "error_deg": paper.error_deg, "hits": paper.hits }),
    );
    json!({
        "condition": condition.id, "seeds": summary.seeds,
        "f_after_5_10_20_all": summary.factors, "in_band_at_20": summary.in_band,
        "error_deg": summary.error_deg, "hits_first_10": summary.first_hits,
        "hits_after_20": summary.later_hits, "paper": paper,
    })
}

/// A row of a check.
pub fn print_check(
    as_json: bool,
    exam: &Exam,
    demand: &Demand,
    value: Option<f64>,
    ok: bool,
    out: &mut dyn std::io::Write,
) -> Result<(), Error> {
    let (least, most) = (demand.allowed.start(), demand.allowed.end());
    let Exam { condition, lesson, .. } = exam;
    if as_json {
        return json_line(
            out,
            &json!({
                "finding": demand.finding, "condition": condition.id, "outliers": lesson.outliers,
                "threshold": lesson.threshold, "what": demand.what, "value": value,
                "least": least, "most": most, "met": ok,
            }),
        );
    }
    let status = if ok { "met" } else { "MISSED" };
    let threshold = if lesson.threshold { "" } else { ", no threshold" };
    writeln!(
        out,
        "({}) {status:6} {}: {} of {least} to {most}  ({}, {:.0} % outliers{threshold})",
        demand.finding,
        demand.what,
        value.map_or_else(|| String::from("none"), |value| format!("{value:.3}")),
        condition.title,
        1e2 * lesson.outliers,
    )?;
    Ok(())
}
