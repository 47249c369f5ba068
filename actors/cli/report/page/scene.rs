//! A chapter for each scene.

use super::{cost, error, exact, figure, named, say};
use crate::cli::report::csv;
use crate::cli::report::measure::{Measured, Timed};
use crate::cli::report::peers;
use hapticbillard::report::{self, Peers, STEPS_MS, Status};
use std::fmt::Write;

/// The steps that the page shows; the rest is in the CSV [ms].
const SHOWN_MS: [f64; 6] = [16.0, 4.0, 1.0, 0.2, 0.05, 0.01];
/// Orders are fitted over steps up to this [ms].
const FITTED_MS: f64 = 4.0;

/// What the tables of the chapters mean.
pub fn how_to_read(text: &mut String) {
    say!(text, "## How to read the chapters\n");
    say!(
        text,
        "A cell is an error in metres, and in parentheses the processor time in microseconds per \
         simulated second. \"Dear\" was left out for its cost, \"slow\" was stopped or not begun \
         because a coarser step took too long, \"failed\" is explained below the table. The order \
         is the slope over all steps up to {FITTED_MS} ms. Methods: event-driven (with its \
         tolerances for hops and lasting contact eight times as coarse, and a thousand and 25 \
         times as fine); Euler-Cromer, the paper's own; Verlet in its velocity and its position \
         form; the classical Runge-Kutta method; and two of them with sub-steps: a step in which \
         something happens is cut into {} (section 2.5 of the paper).\n",
        report::SUB_STEPS
    );
}

/// The chapter of a scene.
pub fn chapter(text: &mut String, scene: &Measured, peers: Option<&Peers>) {
    let prepared = &scene.prepared;
    let about = &prepared.scene;
    say!(text, "## {}\n", about.title);
    say!(text, "![{}]({})\n", about.id, figure::name(scene));
    let reference = if prepared.closed_form() {
        format!("a closed form, rounded to {:.0e} m", prepared.reference_error_m)
    } else {
        format!(
            "the event-driven method with fine tolerances; a disturbance of 1e-12, or tolerances \
             twice as coarse, move it by {:.0e} m",
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
    table(text, scene);
    if let Some(peers) = peers {
        say!(
            text,
            "\n| program | step [ms] | error [m] | order | us per s: median (min to max) | work | \
             status |"
        );
        say!(text, "|---|---|---|---|---|---|---|");
        peers::lines(text, scene, peers, &SHOWN_MS);
    }
    say!(text, "\n{}\n", reading(scene));
    if let Some(front) = peers.and_then(|peers| peers::front(scene, peers)) {
        say!(text, "{front}\n");
    }
}

fn table(text: &mut String, scene: &Measured) {
    let steps: Vec<String> = SHOWN_MS.iter().map(|step| format!("{step} ms")).collect();
    say!(text, "| method | no step | {} | order |", steps.join(" | "));
    say!(text, "|---|{}---|", "---|".repeat(SHOWN_MS.len() + 1));
    let rows = scene.plain();
    let mut names: Vec<&str> = Vec::new();
    for timed in &scene.rows {
        let name = timed.row.method.name();
        if names.contains(&name) {
            continue;
        }
        names.push(name);
        let cell = |step: Option<f64>| {
            let same = |other: &&Timed| {
                other.row.method.name() == name && other.row.method.step_ms() == step
            };
            scene.rows.iter().find(same).map_or_else(String::new, cell)
        };
        let mut line = format!("| {name} | {} |", cell(None));
        for step in SHOWN_MS {
            let _ = write!(line, " {} |", cell(Some(step)));
        }
        let order = report::fitted_order(&rows, name, FITTED_MS, scene.prepared.reference_error_m);
        say!(text, "{line} {} |", order.map_or_else(String::new, |order| format!("{order:.1}")));
    }
    let lost = |timed: &&Timed| matches!(timed.row.status, Status::Failed(_) | Status::TooSlow(_));
    for (count, timed) in scene.rows.iter().filter(lost).enumerate() {
        let (word, remark) = csv::status(&timed.row.status);
        let first = if count == 0 { "\n" } else { "" };
        say!(text, "{first}- {}: {word} {remark}.", named(timed.row.method));
    }
}

fn cell(timed: &Timed) -> String {
    match &timed.row.status {
        Status::LeftOut(why) if why.contains("slow") => String::from("slow"),
        Status::LeftOut(_) => String::from("dear"),
        Status::TooSlow(_) => String::from("slow"),
        Status::Failed(_) => String::from("failed"),
        Status::Ok => {
            let us = timed.cpu_us.map_or_else(|| String::from("-"), |cpu| cost(cpu.median));
            format!("{} ({us})", error(timed.row.error_m))
        }
    }
}

/// What a scene's rows say.
fn reading(scene: &Measured) -> String {
    let prepared = &scene.prepared;
    let rows = scene.plain();
    let order =
        |name: &str| report::fitted_order(&rows, name, FITTED_MS, prepared.reference_error_m);
    let mut sentences = Vec::new();
    sentences.push(String::from(match order("velocity-verlet") {
        _ if prepared.scene.smooth => {
            "The force is smooth and nothing happens, so each integrator shows its own order as \
             long as its step is short against the swing: 1, 2, 2 and 4. Sub-steps change \
             nothing."
        }
        Some(order) if order > 1.5 => {
            "Forces are constant between events, so that Verlet in its velocity form and RK4 \
             follow them exactly, while Euler-Cromer moves the ball by too much in every step. \
             What is left to the finer two is the step in which sliding ends or the ball lands: \
             its velocity is put right within the step, and the way is off by no more than the \
             step squared."
        }
        Some(_) => {
            "Forces are constant between events, so a finer integrator has little to gain there; \
             what is lost lies in the steps in which balls meet something. They meet with the \
             velocity of the step's end instead of that at the contact, off by force times part of \
             a step, and carry that away for the rest of the time: first order, whatever the \
             integrator, and uneven, because it depends on where in its step a contact lies."
        }
        None => {
            "There is no force between the events, and contacts along the straight ways of a step \
             are found exactly, so that hardly an error is left to fall: no order can be told."
        }
    }));
    if !prepared.scene.smooth && order("position-verlet").is_some_and(|order| order < 1.5) {
        sentences.push(String::from(
            "Verlet in its position form is of first order wherever a force begins or ends at \
                 once, because the way of the last step knows of it half a step late.",
        ));
    }
    sentences.extend(parts_help(scene));
    if let Some(timed) = exact(scene) {
        let best = rows.iter().filter(|row| row.method.step_ms().is_some());
        let best = best.filter(|row| row.status == Status::Ok);
        let best = best.filter_map(|row| row.error_m).fold(f64::INFINITY, f64::min);
        sentences.push(format!(
            "Event-driven is off by {} m, the best of all fixed steps by {best:.1e} m.",
            error(timed.row.error_m)
        ));
    }
    sentences.extend(tolerances(scene));
    sentences.extend(worse_with_finer_steps(scene));
    sentences.join(" ")
}

/// How much sub-steps take of the error at the same step, in the median over the steps.
fn parts_help(scene: &Measured) -> Option<String> {
    if scene.prepared.scene.smooth {
        return None;
    }
    let find = |name: &str, step: f64| {
        let same = |timed: &&Timed| {
            timed.row.method.name() == name && timed.row.method.step_ms() == Some(step)
        };
        let timed = scene.rows.iter().find(same)?;
        (timed.row.status == Status::Ok).then_some((timed.row.error_m?, timed.cpu_us?.median))
    };
    let mut ratios: Vec<(f64, f64)> = STEPS_MS
        .iter()
        .filter_map(|step| {
            let plain = find("velocity-verlet", *step)?;
            let parts = find("velocity-verlet sub-steps", *step)?;
            (plain.0 > 1e-12).then_some((parts.0 / plain.0, parts.1 / plain.1))
        })
        .collect();
    if ratios.is_empty() {
        return None;
    }
    let mut middle = |part: fn(&(f64, f64)) -> f64| {
        ratios.sort_by(|a, b| part(a).total_cmp(&part(b)));
        part(&ratios[ratios.len() / 2])
    };
    let (error, us) = (middle(|pair| pair.0), middle(|pair| pair.1));
    Some(format!(
        "Sub-steps leave {:.0} % of Verlet's error for {us:.1} times its cost.",
        error * 100.0
    ))
}

/// What the tolerances of the exact solver do.
fn tolerances(scene: &Measured) -> Option<String> {
    let find = |name: &str| scene.rows.iter().find(|timed| timed.row.method.name() == name);
    let own = exact(scene)?;
    let others = [find("event-driven coarse")?, find("event-driven fine")?];
    let same =
        |timed: &&&Timed| (timed.row.error_m, timed.row.work) == (own.row.error_m, own.row.work);
    if others.iter().filter(same).count() == others.len() {
        return Some(String::from(
            "Its tolerances do not matter: nothing hops and no contact lasts.",
        ));
    }
    Some(format!(
        "Its tolerances matter: coarse ones leave {} m, fine ones {} m.",
        error(others[0].row.error_m),
        error(others[1].row.error_m)
    ))
}

fn worse_with_finer_steps(scene: &Measured) -> Option<String> {
    let worse: Vec<String> = scene
        .rows
        .windows(2)
        .map(|pair| (&pair[0].row, &pair[1].row))
        .filter(|(coarse, fine)| coarse.method.name() == fine.method.name())
        .filter(|(_, fine)| fine.order.is_some_and(|order| order < -0.5))
        .map(|(_, fine)| named(fine.method))
        .collect();
    if worse.is_empty() {
        return None;
    }
    let why = if scene.prepared.scene.id == "pocket" {
        "Between the rim and the net a ball hits edges of a mesh, and which of them it hits first \
         turns on a micrometre, that is, on where a step ends. Each such choice leads to another \
         path, and a smaller step changes the choice without being nearer to the truth, until it \
         is small enough that the choice is always the right one. Errors there have no order"
    } else {
        "Where in its step a contact lies decides how much is lost at it, and a finer step may by \
         luck hit it worse; which ball or hop comes first can turn on it too"
    };
    Some(format!("A finer step is worse here: {}. {why}.", worse.join(", ")))
}
