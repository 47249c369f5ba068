//! What scenes leave out, and what this report does.

use super::{LeftOut, builds, say};
use crate::cli::report::csv;
use crate::cli::report::left_out::{COMPARED_S, Line};
use crate::cli::report::measure::Measured;
use hapticbillard::scene::PlanKind;
use std::fmt::Write;

/// What the chapter begins with.
pub const HEADING: &str = "## What is left out costs nothing\n";

/// The chapter; `made` says where its figures are from, if not from the same run.
pub fn chapter(text: &mut String, left_out: &LeftOut<'_>, made: Option<&str>) {
    let lines = left_out.scenes;
    say!(text, "{HEADING}");
    say!(
        text,
        "{}What a scene does not name does not exist. What there is, against the full game (the \
         scene with most actors). Predictions are what the physics computed in {COMPARED_S} s (the \
         first ball is pushed where none moves): tests of pairs and of faces, closed forms of \
         flights and spins, looks for pockets; 0 means that the term does not exist. Memory and \
         time are those of a process of its own that runs the physics for a millisecond.\n",
        made.unwrap_or_default()
    );
    let full = lines.iter().max_by_key(|line| line.count(PlanKind::Actor));
    let most = full.map_or(0, |line| line.count(PlanKind::Actor));
    say!(
        text,
        "| scene | actors (full: {most}) | threads of their own | terms of physics | left out | \
         predictions: pairs, faces, flights, spins, pockets | triangles | table [bytes] | memory \
         [KiB] | start-up [us] | whole process [ms] | linked by default, not used |"
    );
    say!(text, "|---|---|---|---|---|---|---|---|---|---|---|---|");
    for line in lines {
        let work = line.work;
        let (memory, wall) = line.process.map_or_else(
            || (String::from("-"), String::from("-")),
            |process| (process.peak_kib.to_string(), format!("{:.0}", process.wall_ms)),
        );
        let unused =
            if line.unused.is_empty() { String::from("none") } else { line.unused.join(", ") };
        say!(
            text,
            "| {} | {} | {} | {} | {} | {}, {}, {}, {}, {} | {} | {} | {memory} | {:.0} | {wall} | \
             {unused} |",
            line.name,
            line.count(PlanKind::Actor),
            line.threads,
            line.count(PlanKind::Term),
            line.count(PlanKind::LeftOut),
            work.pair_tests,
            work.face_tests,
            work.flights,
            work.spins,
            work.pocket_tests,
            line.faces,
            line.table_bytes,
            line.start_ms * 1e3,
        );
    }
    proof(text, lines);
    for line in lines {
        let names = |kind| {
            let lines = line.plan.iter().filter(|plan| plan.kind == kind);
            lines.map(|plan| plan.name.as_str()).collect::<Vec<_>>().join(", ")
        };
        say!(
            text,
            "- `{}` starts {}; computes {}; leaves out {}.",
            line.name,
            names(PlanKind::Actor),
            names(PlanKind::Term),
            names(PlanKind::LeftOut)
        );
    }
    say!(text, "");
    if let Some(builds) = left_out.builds {
        builds::section(text, builds);
    }
}

fn proof(text: &mut String, lines: &[Line]) {
    let compared: u64 = lines.iter().map(|line| line.idle.compared).sum();
    let differ: u64 = lines.iter().map(|line| line.idle.differ).sum();
    say!(
        text,
        "\n**Leaving out changes no bit.** Each scene's balls were run for {COMPARED_S} s as they \
         are, and again with two planes and a ball far away, and every number of places, \
         velocities and spins was compared: of {compared} numbers in {} scenes {differ} differ in \
         any bit.\n",
        lines.len()
    );
    for line in lines.iter().filter(|line| line.idle.differ > 0) {
        say!(text, "- In `{}` {} differ.", line.name, line.idle.differ);
    }
}

/// What this report does not show.
pub fn missing(text: &mut String, measured: &[Measured], quick: bool) {
    say!(text, "## What this report does not show\n");
    say!(
        text,
        "- Where the reference is event-driven, it and the method share their laws and their code: \
         its error is that of tolerances and of a disturbance, not of a mistake in both. The \
         closed forms of the other scenes, `hapticbillard validate` and fixed steps that converge \
         to it speak against one.\n\
         - The reference of the thousand balls is sure to the disturbance of one ball only.\n\
         - All balls take sub-steps together; with many balls nearly every step is cut.\n\
         - Sub-steps are not combined with the laws of 2009, in which a lying ball collides in \
         every step.\n\
         - Memory and threads of a game with a window are those that its plan names; the process \
         that is measured runs the physics alone."
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
