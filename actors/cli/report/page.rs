//! `REPORT.md`: the tables, and what they say in plain words.

mod stability;

use super::csv;
use super::figure;
use super::left_out::{COMPARED_S, Line};
use super::measure::{Measured, Timed};
use super::peers;
use super::stability::Table;
use hapticbillard::report::{self, Peers, Status};
use hapticbillard::scene::PlanKind;
use hapticbillard_actors::files::{new_recording_name, processor_name};
use std::fmt::Write;

/// The steps that the page shows; the rest is in the CSV [ms].
const SHOWN_MS: [f64; 5] = [16.0, 4.0, 1.0, 0.1, 0.01];
/// Orders are fitted over steps up to this [ms].
const FITTED_MS: f64 = 4.0;

/// Adds a line. Writing to a string cannot fail.
macro_rules! say {
    ($text:expr, $($rest:tt)*) => {
        let _ = writeln!($text, $($rest)*);
    };
}
use say;

/// The whole page.
pub fn page(
    measured: &[Measured],
    peers: Option<&Peers>,
    table: &Table,
    left_out: &[Line],
    quick: bool,
) -> String {
    let mut text = String::new();
    head(&mut text, quick);
    overview(&mut text, measured);
    if let Some(peers) = peers {
        peers::chapter(&mut text, measured, peers);
    }
    for scene in measured {
        chapter(&mut text, scene, peers);
    }
    stability::chaos(&mut text, table);
    stability::chapter(&mut text, table);
    without(&mut text, left_out);
    missing(&mut text, measured, quick);
    text
}

fn head(text: &mut String, quick: bool) {
    let name = new_recording_name();
    let date = name.split('_').next().unwrap_or_default();
    let build = if cfg!(debug_assertions) { "with debug assertions" } else { "optimised" };
    let flag = if quick { " --quick" } else { "" };
    say!(text, "# Error against run time\n");
    say!(
        text,
        "Made on {date} by `hapticbillard report{flag}`, version {}, {build}, {}, on {}.\n",
        env!("CARGO_PKG_VERSION"),
        env!("COMPILER"),
        processor_name()
    );
    say!(
        text,
        "Errors, counters and classes are the same on every machine; processor times are this \
         one's, of one thread. All rows are in [errors.csv](errors.csv) and \
         [stability.csv](stability.csv). An error is the distance of a ball from where it should \
         be, in metres, for the ball and the time where it is largest, and the median over a few \
         starts that differ a little. Runs that failed stay in the tables.\n"
    );
}

fn exact(scene: &Measured) -> Option<&Timed> {
    scene.rows.iter().find(|timed| timed.row.method.step_ms().is_none())
}

/// The cheapest row of fixed steps that is at least as good as `error_m`.
fn cheapest(scene: &Measured, error_m: f64) -> Option<(&Timed, f64)> {
    scene
        .rows
        .iter()
        .filter(|timed| timed.row.method.step_ms().is_some() && timed.row.status == Status::Ok)
        .filter(|timed| timed.row.error_m.is_some_and(|error| error <= error_m))
        .filter_map(|timed| Some((timed, timed.cpu_us?.median)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}

fn overview(text: &mut String, measured: &[Measured]) {
    say!(text, "## At a glance\n");
    say!(
        text,
        "Processor time per simulated second. The last columns are the cheapest run in fixed \
         steps that is good to a millimetre, and to ten micrometres.\n"
    );
    say!(
        text,
        "| scene | event-driven error [m] | us per s | to 1 mm, us per s | to 10 um, us per s |"
    );
    say!(text, "|---|---|---|---|---|");
    for scene in measured {
        let Some(timed) = exact(scene) else { continue };
        let steps = |error_m: f64| match cheapest(scene, error_m) {
            Some((timed, cost)) => format!(
                "{cost:.0} ({}, {} ms)",
                timed.row.method.name(),
                timed.row.method.step_ms().unwrap_or_default()
            ),
            None => String::from("none was so good"),
        };
        say!(
            text,
            "| {} | {} | {} | {} | {} |",
            scene.prepared.scene.id,
            error(timed.row.error_m),
            timed.cpu_us.map_or_else(|| String::from("-"), |cpu| format!("{:.1}", cpu.median)),
            steps(1e-3),
            steps(1e-5),
        );
    }
    let (mut better, mut told, mut dearer) = (0, 0, Vec::new());
    for scene in measured {
        let cost = exact(scene).and_then(|timed| Some(timed.cpu_us?.median));
        if let (Some(cost), Some((_, steps))) = (cost, cheapest(scene, 1e-3)) {
            told += 1;
            better += usize::from(cost < steps);
            if cost >= steps {
                dearer.push(scene.prepared.scene.id);
            }
        }
    }
    let dearer = if dearer.is_empty() {
        String::new()
    } else {
        format!(
            " It costs more in {}: each event of many balls asks all of them, however coarse an \
             answer would do.",
            dearer.join(", ")
        )
    };
    let front = |scene: &&Measured| {
        let rows = scene.plain();
        rows.first().is_some_and(|row| report::on_the_front(row, &rows))
    };
    let fronts = measured.iter().filter(front).count();
    say!(
        text,
        "\nThe event-driven method costs less than any fixed steps that are good to a millimetre \
         in {better} of the {told} scenes where such steps exist.{dearer} In {fronts} of {} scenes \
         no fixed steps are better for less computation, counted and not timed.\n",
        measured.len()
    );
}

/// An error as a number.
pub fn error(value: Option<f64>) -> String {
    value.map_or_else(|| String::from("-"), |value| format!("{value:.1e}"))
}

fn chapter(text: &mut String, scene: &Measured, peers: Option<&Peers>) {
    let prepared = &scene.prepared;
    let about = &prepared.scene;
    say!(text, "## {}\n", about.title);
    say!(text, "![{}]({})\n", about.id, figure::name(scene));
    let reference = if prepared.closed_form() {
        format!("a closed form, rounded to {:.0e} m", prepared.reference_error_m)
    } else {
        format!(
            "the event-driven method; a disturbance of 1e-12 moves it by {:.0e} m",
            prepared.reference_error_m
        )
    };
    say!(
        text,
        "Compared over {:.3} s, {} starts, {}. The reference is {reference}.\n",
        prepared.until_s,
        prepared.starts(),
        about.norm.words()
    );
    say!(
        text,
        "| method | step [ms] | error [m] | order | us per s: median (min to max) | work | status |"
    );
    say!(text, "|---|---|---|---|---|---|---|");
    for timed in &scene.rows {
        let row = &timed.row;
        let step = row.method.step_ms();
        let failed = matches!(row.status, Status::Failed(_));
        if !failed && step.is_some_and(|step| !SHOWN_MS.contains(&step)) {
            continue;
        }
        let (word, remark) = csv::status(&row.status);
        let work = row.work;
        say!(
            text,
            "| {} | {} | {} | {} | {} | {} events, {} steps, {} tests, {} forces | \
             {word}{}{remark} |",
            row.method.name(),
            step.map_or_else(|| String::from("-"), |step| step.to_string()),
            error(row.error_m),
            row.order.map_or_else(|| String::from("-"), |order| format!("{order:.1}")),
            timed.cpu_us.map_or_else(
                || String::from("-"),
                |cpu| format!("{:.1} ({:.1} to {:.1})", cpu.median, cpu.least, cpu.most)
            ),
            work.events,
            work.steps,
            work.tests(),
            work.force_evaluations,
            if remark.is_empty() { "" } else { ": " },
        );
    }
    if let Some(peers) = peers {
        peers::lines(text, scene, peers, &SHOWN_MS);
    }
    say!(text, "\n{}\n", reading(scene));
    if let Some(front) = peers.and_then(|peers| peers::front(scene, peers)) {
        say!(text, "{front}\n");
    }
}

/// What a scene's rows say.
fn reading(scene: &Measured) -> String {
    let prepared = &scene.prepared;
    let rows = scene.plain();
    let mut sentences = Vec::new();
    let orders: Vec<String> = report::METHODS
        .into_iter()
        .flatten()
        .map(|integrator| report::Method::FixedStep { integrator, step_ms: 1.0 })
        .map(|method| {
            let name = method.name();
            let fitted = report::fitted_order(&rows, name, FITTED_MS, prepared.reference_error_m);
            match fitted {
                Some(order) => format!("{name} {order:.1}"),
                None => format!("{name} none (too few errors that can be told)"),
            }
        })
        .collect();
    sentences.push(format!("Orders over all steps up to {FITTED_MS} ms: {}.", orders.join(", ")));
    let verlet =
        report::fitted_order(&rows, "velocity-verlet", FITTED_MS, prepared.reference_error_m);
    sentences.push(String::from(match verlet {
        _ if prepared.scene.smooth => {
            "The force is smooth and nothing happens, so each integrator shows its own order as \
             long as its step is short against the swing: 1, 2 and 4."
        }
        Some(order) if order > 1.5 => {
            "Forces are constant between events, so that Verlet and RK4 follow them exactly, while \
             Euler-Cromer moves the ball by too much in every step. What is left to the finer two \
             is the step in which sliding ends or the ball lands: its velocity is put right within \
             the step, and the way is off by no more than the step squared."
        }
        Some(_) => {
            "Forces are constant between events, so a finer integrator has nothing to gain there; \
             what is lost lies in the steps in which balls meet something. They meet with the \
             velocity of the step's end instead of that at the contact, off by force times part of \
             a step, and carry that away for the rest of the time: first order, whatever the \
             integrator, and uneven, because it depends on where in its step a contact lies."
        }
        None => {
            "There is no force between the events, and contacts along the straight ways of a step \
             are found exactly, so that hardly an error is left to fall."
        }
    }));
    if let Some(timed) = exact(scene) {
        let best = rows.iter().skip(1).filter(|row| row.status == Status::Ok);
        let best = best.filter_map(|row| row.error_m).fold(f64::INFINITY, f64::min);
        sentences.push(format!(
            "Event-driven is off by {} m, the best of all fixed steps by {best:.1e} m.",
            error(timed.row.error_m)
        ));
    }
    let worse: Vec<String> = rows
        .windows(2)
        .filter(|pair| pair[0].method.name() == pair[1].method.name())
        .filter(|pair| pair[1].order.is_some_and(|order| order < -0.5))
        .map(|pair| {
            format!("{} at {} ms", pair[1].method.name(), pair[1].method.step_ms().unwrap_or(0.0))
        })
        .collect();
    if !worse.is_empty() {
        sentences.push(format!(
            "A finer step is worse here: {}. Which edge or hop a ball meets first can turn on \
             where a step ends; the next finer step may be better again.",
            worse.join(", ")
        ));
    }
    sentences.join(" ")
}

fn without(text: &mut String, left_out: &[Line]) {
    say!(text, "## What is left out costs nothing\n");
    say!(
        text,
        "What a scene does not name does not exist. The proof that it changes nothing: each \
         scene's balls (the first of them pushed where none moves) are run for {COMPARED_S} s as \
         they are, and again with two planes and a ball far away, and every number of places, \
         velocities and spins is compared bit by bit.\n"
    );
    let full = left_out.iter().map(|line| line.count(PlanKind::Actor)).max().unwrap_or(0);
    say!(
        text,
        "| scene | actors (full game: {full}) | terms of physics | left out | triangles | \
         table [bytes] | start-up, us | numbers compared | bits differ in |"
    );
    say!(text, "|---|---|---|---|---|---|---|---|---|");
    for line in left_out {
        say!(
            text,
            "| {} | {} | {} | {} | {} | {} | {:.0} | {} | {} |",
            line.name,
            line.count(PlanKind::Actor),
            line.count(PlanKind::Term),
            line.count(PlanKind::LeftOut),
            line.faces,
            line.table_bytes,
            line.start_ms * 1e3,
            line.idle.compared,
            line.idle.differ,
        );
    }
    for line in left_out {
        let names = |kind| {
            let lines = line.plan.iter().filter(|plan| plan.kind == kind);
            lines.map(|plan| plan.name.as_str()).collect::<Vec<_>>().join(", ")
        };
        say!(
            text,
            "\n- `{}` starts {}; computes {}; leaves out {}.",
            line.name,
            names(PlanKind::Actor),
            names(PlanKind::Term),
            names(PlanKind::LeftOut)
        );
    }
    say!(text, "");
}

fn missing(text: &mut String, measured: &[Measured], quick: bool) {
    say!(text, "## What this report does not show\n");
    say!(
        text,
        "- Fixed steps with sub-steps at contacts (section 2.5 of the paper) are not there to be \
         measured.\n\
         - Verlet in its position form is no integrator of the solver; the chapter on the first \
         hop tries it on a ball in one dimension.\n\
         - A light ball between a wall and one of a million times its mass (3141 contacts) is \
         borne by the event-driven method, which a test holds; fixed steps of 4 ms took more than \
         a minute at a ratio of ten thousand, so that the table shows a hundred.\n\
         - Where the reference is event-driven, its own error is that of a disturbance: rounding \
         and sensitivity. What it approximates itself, a ball on a rim in pieces of half a \
         millisecond, is not in that number; it matters in the scene of the pocket alone.\n\
         - The reference of the thousand balls is sure to the disturbance of one ball only.\n\
         - The event-driven method has one set of tolerances; it is not run with others.\n\
         - Memory is that of a table's mesh alone; threads are those that the plan names."
    );
    let count = |word: &str| {
        let rows = measured.iter().flat_map(|scene| &scene.rows);
        rows.filter(|timed| csv::status(&timed.row.status).0 == word).count()
    };
    say!(
        text,
        "- {} rows are left out because they are too dear{}; {} rows failed and say how.",
        count("left out"),
        if quick { " for a quick report" } else { "" },
        count("failed")
    );
}
