//! What other programs made of the same scenes, beside the report's own rows.

use super::csv::{number, quoted};
use super::measure::Measured;
use hapticbillard::report::{self, PeerRow, PeerStatus, Peers, Status};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use std::fmt::Write;
use std::path::Path;

/// Largest file that is read [bytes].
const FILE_MAX: u64 = 64 << 20;

/// Reads the results and holds them against the scenes that were measured.
pub fn read(file: &Path, measured: &[Measured]) -> Result<Peers, Error> {
    let what = || format!("--peers {}", file.display());
    let fix = "write it anew with tests/peers/run.py";
    let peers = Peers::parse(&read_text(file, FILE_MAX)?)
        .map_err(|error| Error::input(what(), error.to_string(), fix))?;
    for scene in measured {
        let case = scene.prepared.case();
        if let Some(row) = peers.stale(case.scene, case.digest) {
            let problem =
                format!("{} was given another scene '{}' than this one", row.program, row.scene);
            return Err(Error::input(what(), problem, fix));
        }
    }
    Ok(peers)
}

/// A part of the page that says what the programs are.
pub fn chapter(text: &mut String, measured: &[Measured], peers: &Peers) {
    let _ = writeln!(
        text,
        "## Other programs\n\nMeasured by `tests/peers/run.py` on {}. Each of them was given the \
         same balls, ground and laws, as far as it knows them, and is held to the same truth; its \
         rows stand below those of this program. `helped` means that a law is applied from \
         outside. An error that does not fall with the step is mostly another law. \
         Where a program cannot express a scene, or failed, the row says why.\n",
        peers.made
    );
    let on = |scene: &&Measured| better(scene, peers).is_some_and(|better| better.is_empty());
    let (front, off): (Vec<&Measured>, Vec<&Measured>) = measured.iter().partition(on);
    let names = off.iter().map(|scene| scene.prepared.scene.id).collect::<Vec<_>>().join(", ");
    let _ = writeln!(
        text,
        "Event-driven is on the Pareto front of error against run time, against every method and \
         program, in {} of {} scenes{}{names}.\n",
        front.len(),
        measured.len(),
        if off.is_empty() { "" } else { "; not in " }
    );
    for program in &peers.programs {
        let state = match (&program.version, &program.problem) {
            (_, Some(problem)) => format!("not run: {problem}"),
            (Some(version), None) => version.clone(),
            (None, None) => String::from("of unknown version"),
        };
        let _ = writeln!(text, "- {} ({state}): {}", program.name, program.about);
    }
    let _ = writeln!(text);
}

/// The rows of a scene, as lines of its table.
pub fn lines(text: &mut String, scene: &Measured, peers: &Peers, shown_ms: &[f64]) {
    for row in peers.of_scene(scene.prepared.scene.id) {
        let hidden = row.step_ms.is_some_and(|step| !shown_ms.contains(&step));
        if hidden && row.status != PeerStatus::Failed {
            continue;
        }
        let cpu = row.cpu_us_per_s.map_or_else(
            || String::from("-"),
            |[median, least, most]| format!("{median:.1} ({least:.1} to {most:.1})"),
        );
        let _ = writeln!(
            text,
            "| {} | {} | {} | - | {cpu} | - | {}{}{} |",
            row.method(),
            row.step_ms.map_or_else(|| String::from("-"), |step| step.to_string()),
            super::page::error(row.error_m),
            row.status.words(),
            if row.remark.is_empty() { "" } else { ": " },
            row.remark.replace('|', "/"),
        );
    }
}

/// Who keeps event-driven off the Pareto front of error against run time, in steps or elsewhere.
fn better(scene: &Measured, peers: &Peers) -> Option<Vec<String>> {
    let exact = scene.rows.iter().find(|timed| timed.row.method.step_ms().is_none())?;
    let (error_m, cost) = (exact.row.error_m?, exact.cpu_us?.median);
    let rows = peers.of_scene(scene.prepared.scene.id);
    let mut better: Vec<String> = report::cheaper_and_better(rows, error_m, cost)
        .into_iter()
        .map(|row| named(row.method(), row.step_ms))
        .collect();
    for timed in &scene.rows {
        let (Some(error), Some(cpu)) = (timed.row.error_m, timed.cpu_us) else { continue };
        let dominates = error <= error_m && cpu.median <= cost;
        let differs = error < error_m || cpu.median < cost;
        if timed.row.status == Status::Ok && dominates && differs {
            better.push(named(timed.row.method.name().to_owned(), timed.row.method.step_ms()));
        }
    }
    Some(better)
}

/// Whether event-driven is on the Pareto front of error against run time, against everybody.
pub fn front(scene: &Measured, peers: &Peers) -> Option<String> {
    let better = better(scene, peers)?;
    let ran = peers.of_scene(scene.prepared.scene.id).filter(|row| row.point().is_some()).count();
    Some(if better.is_empty() {
        format!(
            "Event-driven is on the Pareto front of error against run time: none of the {ran} \
             runs of other programs that worked, and none in fixed steps, is both as good and as \
             cheap."
        )
    } else {
        format!(
            "Event-driven is not on the Pareto front: as good and as cheap or better are {}.",
            better.join("; ")
        )
    })
}

fn named(method: String, step_ms: Option<f64>) -> String {
    match step_ms {
        Some(step) => format!("{method} at {step} ms"),
        None => method,
    }
}

/// The lines of the errors' file.
pub fn csv(text: &mut String, scene: &Measured, peers: &Peers) {
    let prepared = &scene.prepared;
    for row in peers.of_scene(prepared.scene.id) {
        let [median, least, most] =
            row.cpu_us_per_s.map_or([None; 3], |times| times.map(Some)).map(number);
        let _ = writeln!(
            text,
            "{},{},{},position,{},m,{},{},{:e},,{},{median},{least},{most},,,,,,,,,,{},{}",
            row.scene,
            quoted(&row.method()),
            row.step_ms.map(|step| step.to_string()).unwrap_or_default(),
            quoted(prepared.scene.norm.words()),
            number(row.error_m),
            if prepared.closed_form() { "closed form" } else { "event-driven" },
            prepared.reference_error_m,
            prepared.until_s,
            row.status.words(),
            quoted(&row.remark),
        );
    }
}

/// A line of a figure: a program with one setting.
pub struct Curve<'a> {
    /// The program's place among the programs.
    pub number: usize,
    /// The program.
    pub name: &'a str,
    /// Its setting.
    pub setting: &'a str,
    /// What is drawn along, and the error [m].
    pub points: Vec<(f64, f64)>,
}

/// The lines of a scene's figure.
pub fn curves<'a>(
    peers: &'a Peers,
    scene: &str,
    along: impl Fn(&PeerRow) -> Option<f64>,
) -> Vec<Curve<'a>> {
    let mut curves: Vec<Curve<'a>> = Vec::new();
    for row in peers.rows.iter().filter(|row| row.scene == scene) {
        let (Some((error, _)), Some(x)) = (row.point(), along(row)) else { continue };
        let known = peers.programs.iter().position(|program| program.name == row.program);
        let Some(number) = known else { continue };
        let same = |curve: &&mut Curve<'_>| {
            curve.number == number && curve.setting == row.setting && row.step_ms.is_some()
        };
        match curves.iter_mut().find(same) {
            Some(curve) => curve.points.push((x, error)),
            None => curves.push(Curve {
                number,
                name: &row.program,
                setting: &row.setting,
                points: vec![(x, error)],
            }),
        }
    }
    curves
}
