//! The chapters on chaos and stability.

use super::{error, say};
use crate::cli::report::figure::CHAOS;
use crate::cli::report::stability::{DROP, HERTZ_M_S, LOOK_S, Table};
use hapticbillard::physics::Integrator;
use hapticbillard::report::{self, Class, Method};
use std::fmt::Write;

fn integrator(integrator: Integrator) -> &'static str {
    Method::FixedStep { integrator, step_ms: 1.0 }.name()
}

fn heading(method: Method) -> String {
    match method.step_ms() {
        None => method.name().to_string(),
        Some(step) => format!("{} {step} ms", method.name()),
    }
}

/// How long the future can be told, and what can be said beyond.
pub fn chaos(text: &mut String, table: &Table) {
    say!(text, "## Chaos: how long a break can be told\n");
    say!(text, "![growth of a disturbance]({CHAOS})\n");
    say!(text, "| rack | horizon [s] | factor per second up to it |");
    say!(text, "|---|---|---|");
    for (rack, growth) in table.growth.iter().enumerate() {
        let factor = growth.factor_per_s.map_or_else(|| String::from("-"), |f| format!("{f:.1e}"));
        say!(text, "| {rack} | {:.3} | {factor} |", growth.horizon_s);
    }
    let longest = table.growth.iter().map(|growth| growth.horizon_s).fold(0.0, f64::max);
    say!(
        text,
        "\nThe horizon is the time until which a change of the cue ball's speed by 1e-12 moves no \
         ball by a micrometre; here the longest is {longest:.3} s of the time looked at. Positions \
         after a break are compared no longer than that. Beyond it only what all breaks have in \
         common can be compared: mean over {} racks, {LOOK_S} s after the stroke, with the \
         standard error of the mean.\n",
        table.racks
    );
    say!(
        text,
        "| method | kinetic energy over the first | spread of the balls [m] | balls that move | \
         energy that does not add up [J] | momentum that does not [N s] | \
         energy the method added [J] |"
    );
    say!(text, "|---|---|---|---|---|---|---|");
    let mut seen = Vec::new();
    for spread in &table.spread {
        match spread {
            Ok(spread) => {
                let pair = |(mean, off): (f64, f64)| format!("{mean:.4} ± {off:.4}");
                say!(
                    text,
                    "| {} | {} | {} | {} | {:.0e} | {:.0e} | {:.1e} |",
                    heading(spread.method),
                    pair(spread.energy),
                    pair(spread.spread_m),
                    pair(spread.moving),
                    spread.energy_residual_j,
                    spread.momentum_residual_ns,
                    spread.added_j
                );
                seen.push(spread);
            }
            Err((method, error)) => {
                say!(text, "| {} | failed: {error} | - | - | - | - | - |", heading(*method));
            }
        }
    }
    if let Some((first, rest)) = seen.split_first() {
        let apart = |spread: &&report::Spread| {
            let pairs = [(spread.energy, first.energy), (spread.spread_m, first.spread_m)];
            let off = |((a, s), (b, t)): ((f64, f64), (f64, f64))| {
                (a - b).abs() / (s * s + t * t).sqrt().max(f64::MIN_POSITIVE)
            };
            pairs.into_iter().map(off).fold(0.0, f64::max)
        };
        let differ: Vec<String> = rest
            .iter()
            .filter(|spread| apart(spread) > 3.0)
            .map(|spread| format!("{} by {:.1}", heading(spread.method), apart(spread)))
            .collect();
        let said = if differ.is_empty() {
            String::from("No method differs from event-driven by more than three standard errors.")
        } else {
            format!(
                "These differ from event-driven by more than three standard errors: {}.",
                differ.join(", ")
            )
        };
        say!(text, "\n{said}\n");
    }
}

/// The table of methods and cases.
pub fn chapter(text: &mut String, table: &Table) {
    say!(text, "## Stability\n");
    say!(
        text,
        "A number is the largest error in the unit that the case names. Exact: at most 1e-9. \
         Bounded: no larger in the second half of the time than 1.5 times that of the first. \
         Drifts: larger; what drifts on a spring is the phase. Diverges: above a hundred.\n"
    );
    let mut line = String::from("| case | measured |");
    for method in report::COLUMNS {
        let _ = write!(line, " {} |", heading(method));
    }
    say!(text, "{line}");
    say!(text, "|---|---|{}", "---|".repeat(report::COLUMNS.len()));
    let mut remarks = Vec::new();
    for row in &table.rows {
        let mut line = format!("| {} | {} |", row.title, row.measures);
        for (method, cell) in &row.cells {
            let _ = write!(line, " {} {}", cell.class.word(), error(Some(cell.error)));
            if matches!(cell.class, Class::Diverges | Class::GivesUp) {
                if cell.note.is_empty() {
                    remarks.push(format!(
                        "{}, {}: no limit in the step is known",
                        row.title,
                        heading(*method)
                    ));
                } else {
                    let _ = write!(line, " ({})", cell.note);
                }
            }
            line.push_str(" |");
        }
        say!(text, "{line}");
    }
    for remark in remarks {
        say!(text, "\n- {remark}.");
    }
    limits(text, table);
    hertz(text, table);
    rest(text, table);
    hop(text, table);
}

fn limits(text: &mut String, table: &Table) {
    say!(text, "\n### From where on a spring is too stiff\n");
    say!(
        text,
        "Natural frequency times step: measured by halving on the solver itself, and from \
         the eigenvalues of one step.\n"
    );
    say!(text, "| integrator | damping over critical | measured | theory |");
    say!(text, "|---|---|---|---|");
    for (which, ratio, limit) in &table.limits {
        say!(
            text,
            "| {} | {ratio} | {:.4} | {:.4} |",
            integrator(*which),
            limit.measured,
            limit.theory
        );
    }
    say!(
        text,
        "\nBoth forms of first and second order end at 2, RK4 at 2 √2. Damping *lowers* the limit \
         of the first two, because they take it from the start of the step. Event-driven follows \
         a spring in closed form and is never unstable; beyond the reach of its swing it looks for \
         no contacts, so that a free one costs the same however stiff it is.\n"
    );
}

fn hertz(text: &mut String, table: &Table) {
    let (contact_s, rows) = &table.hertz;
    say!(text, "### A contact that is a spring (Hertz)\n");
    say!(
        text,
        "Two pool balls at {HERTZ_M_S} m/s touch for {:.0} us. The error of the speed with which \
         they part, worst of 16 places in the step where contact begins:\n",
        contact_s * 1e6
    );
    say!(text, "| step [us] | over time of contact | euler-cromer | velocity-verlet | rk4 |");
    say!(text, "|---|---|---|---|---|");
    let first = rows.first().map(|row| row.integrator);
    for row in rows.iter().filter(|row| Some(row.integrator) == first) {
        let mut line = format!("| {} | {:.3} |", row.step_s * 1e6, row.share);
        for other in rows.iter().filter(|other| other.step_s == row.step_s) {
            let _ = write!(line, " {:+.1e} |", other.error);
        }
        say!(text, "{line}");
    }
    say!(
        text,
        "\nThe game's step is some fourteen times the time of contact: a penalty force would throw \
         balls apart, which is why both solvers use impulses.\n"
    );
}

fn rest(text: &mut String, table: &Table) {
    say!(text, "### A ball that lies\n");
    say!(text, "| method | lies for [s] | seen off its place [m] | seen to rise [Hz] |");
    say!(text, "|---|---|---|---|");
    for row in &table.rest {
        say!(
            text,
            "| {} | {} | {} | {:.2} |",
            row.what,
            row.lasts_s,
            error(Some(row.hop_m)),
            row.seen_hz
        );
    }
    say!(
        text,
        "\nSeen at 60 frames a second. The paper found hops below 0.1 mm that are seen at 2 to \
         10 Hz, an alias of step and picture (section 2.6); a ball that hops nowhere has 0 Hz.\n"
    );
}

fn hop(text: &mut String, table: &Table) {
    let (drop_m, restitution) = DROP;
    say!(text, "### The first hop (section 2.3)\n");
    say!(
        text,
        "A ball in one dimension, dropped from {drop_m} m with restitution {restitution}; what \
         overlaps is pushed out, as in the paper.\n"
    );
    say!(
        text,
        "| form | step [ms] | first hop [mm] | in truth [mm] | hops on when it should lie [mm] |"
    );
    say!(text, "|---|---|---|---|---|");
    for (form, step, hop) in &table.hops {
        say!(
            text,
            "| {} | {step} | {:.3} | {:.3} | {:.4} |",
            form.words(),
            hop.first_m * 1e3,
            hop.truth_m * 1e3,
            hop.at_rest_m * 1e3
        );
    }
    say!(
        text,
        "\nIn its position form Verlet takes the way of the last step for the velocity. A ball \
         that is pushed out of the ground therefore leaves it faster, by push over step, and hops \
         higher than it should; the paper gave Verlet up for that. Written by place and velocity, \
         or with the last place written anew, the hop is gone.\n"
    );
}
