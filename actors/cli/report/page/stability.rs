//! The chapters on chaos and stability.

use super::{error, named, say};
use crate::cli::report::figure::CHAOS;
use crate::cli::report::stability::{DROP, DROP_STEPS_MS, HERTZ_M_S, LOOK_S, Line, Table};
use hapticbillard::physics::{Integrator, Profile};
use hapticbillard::report::{self, Class, Method};
use std::fmt::Write;

fn integrator(integrator: Integrator) -> &'static str {
    Method::FixedStep { integrator, step_ms: 1.0 }.name()
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
         energy that does not add up [J] | momentum that does not [N s] | energy the method added \
         [J] |"
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
                    named(spread.method),
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
                say!(text, "| {} | failed: {error} | - | - | - | - | - |", named(*method));
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
            .map(|spread| format!("{} by {:.1}", named(spread.method), apart(spread)))
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
        let _ = write!(line, " {} |", named(method));
    }
    say!(text, "{line}");
    say!(text, "|---|---|{}", "---|".repeat(report::COLUMNS.len()));
    let mut remarks = Vec::new();
    for row in &table.rows {
        let mut line = format!("| {} | {} |", row.title, row.measures);
        for (method, cell) in &row.cells {
            let _ = write!(line, " {}", cell.class.word());
            if cell.error.is_finite() {
                let _ = write!(line, " {}", error(Some(cell.error)));
            }
            if matches!(cell.class, Class::Diverges | Class::GivesUp | Class::TooSlow) {
                if cell.class == Class::Diverges && !cell.note.is_empty() {
                    let _ = write!(line, " ({}{})", cell.note, measured_limit(table, *method, row));
                } else {
                    let why = match cell.note.as_str() {
                        "" => "no limit in the step is known",
                        why => why,
                    };
                    remarks.push(format!("{}, {}: {why}", row.title, named(*method)));
                }
            }
            line.push_str(" |");
        }
        say!(text, "{line}");
    }
    let seen = REMARKS.iter().filter_map(|(case, class, remark)| {
        let row = table.rows.iter().find(|row| row.id == *case)?;
        row.cells.iter().any(|(_, cell)| cell.class == *class).then_some(*remark)
    });
    say!(
        text,
        "\nA cell that diverges names natural frequency times step, the limit of theory and the \
         limit found on the solver. What wants a word:\n"
    );
    for remark in remarks.iter().map(String::as_str).chain(seen) {
        say!(text, "- {remark}.");
    }
    limits(text, table);
    hertz(text, table);
    rest(text, table);
    hop(text, table);
}

/// What the table does not explain by itself: the case, what one sees there, and why.
const REMARKS: [(&str, Class, &str); 3] = [
    (
        "restitution_1",
        Class::Drifts,
        "Restitution 1 with sub-steps: Euler-Cromer keeps energy, on the average, only as long as \
         its step stays the same. Its velocity is that of another moment of the step than its \
         place; a change of step before and after each bounce changes by how much, always to the \
         same side",
    ),
    (
        "galperin_1e4",
        Class::GivesUp,
        "Bounces between a wall and a heavy ball: a step lets a ball have 16 contacts and then \
         takes its restitution, so that it comes to rest between the two and is struck without \
         end. With fewer contacts in a step the stepper is exact, and sub-steps are enough for 314 \
         of them",
    ),
    (
        "grazing",
        Class::Bounded,
        "Grazing: event-driven finds so flat a meeting as the root of a polynomial of fourth \
         degree that is hardly negative there, and rounding of its coefficients moves the root. \
         Straight paths need a square root alone. The velocity itself is 1.4e-4 of the other \
         ball's",
    ),
];

/// The limit as it was found on the solver, for a cell that names that of theory.
fn measured_limit(table: &Table, method: Method, row: &Line) -> String {
    let same = |(integrator, ratio, _): &&(Integrator, f64, report::Limit)| {
        Some(*integrator) == method.integrator() && row.ratio == Some(*ratio)
    };
    let found = table.limits.iter().find(same);
    found.map_or_else(String::new, |(.., limit)| format!(", found {:.3}", limit.measured))
}

fn limits(text: &mut String, table: &Table) {
    say!(text, "\n### From where on a spring is too stiff\n");
    say!(
        text,
        "Natural frequency times step: measured by halving on the solver itself, and from the \
         eigenvalues of one step.\n"
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
        "\nEuler-Cromer and both forms of Verlet end at 2, RK4 at 2 √2. Damping *lowers* the limit \
         of those that take it from the start of the step. Event-driven follows a spring in closed \
         form and is never unstable; beyond the reach of its swing it looks for no contacts, so \
         that a free one costs the same however stiff it is.\n"
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
    let names: Vec<&str> = report::INTEGRATORS.into_iter().map(integrator).collect();
    say!(text, "| step [us] | over time of contact | {} |", names.join(" | "));
    say!(text, "|---|---|{}", "---|".repeat(names.len()));
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
        "\nSeen at 60 frames a second. The paper found hops below 0.1 mm that are seen at 2 to 10 \
         Hz, an alias of step and picture (section 2.5); a ball that hops nowhere has 0 Hz.\n"
    );
}

fn hop(text: &mut String, table: &Table) {
    let (drop_m, restitution) = DROP;
    say!(text, "### The first hop (section 2.3)\n");
    say!(
        text,
        "A ball is dropped from {drop_m} m with restitution {restitution}: height of its first hop \
         over what it should be, and in parentheses how high it still hops when it should lie \
         [mm]. First the solver itself, under the standard laws and under those of 2009, then four \
         ways to write the step down in one dimension, where what overlaps is pushed out as in the \
         paper.\n"
    );
    let steps: Vec<String> = DROP_STEPS_MS.iter().map(|step| format!("{step} ms")).collect();
    say!(text, "| where | method | {} |", steps.join(" | "));
    say!(text, "|---|---|{}", "---|".repeat(DROP_STEPS_MS.len()));
    let cell = |hop: &report::Hop| {
        format!(" {:.2} ({:.3}) |", hop.first_m / hop.truth_m, hop.at_rest_m * 1e3)
    };
    for hops in table.solver_hops.chunks(DROP_STEPS_MS.len()) {
        let Some((which, profile, ..)) = hops.first() else { continue };
        let laws = match profile {
            Profile::Standard => "solver, standard",
            Profile::Paper2009 => "solver, 2009",
        };
        let cells: String = hops.iter().map(|(.., hop)| cell(hop)).collect();
        say!(text, "| {laws} | {} |{cells}", integrator(*which));
    }
    for form in report::Form::ALL {
        let cells: String = table
            .hops
            .iter()
            .filter(|(other, ..)| *other == form)
            .map(|(.., hop)| cell(hop))
            .collect();
        say!(text, "| one dimension | {} |{cells}", form.words());
    }
    say!(
        text,
        "\nIn its position form Verlet takes the way of the last step for the velocity. A ball \
         that is pushed out of the ground therefore leaves it faster, by push over step, and hops \
         higher than it should; the paper gave Verlet up for that. A smaller step does not help, \
         because push and step shrink together. Written by place and velocity, or with the last \
         place written anew, as the solver does under the standard laws, the hop is right.\n"
    );
}
