//! What each feature adds to the program: measured from outside by `tests/builds/run.py`, since a
//! program cannot build others.

use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use serde::Deserialize;
use std::fmt::Write;
use std::path::Path;

/// Largest file that is read [bytes].
const FILE_MAX: u64 = 1 << 20;

/// The file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Builds {
    /// How many starts each median is of.
    starts: u32,
    /// From the least to the whole program.
    builds: Vec<Build>,
}

/// One set of features.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Build {
    features: String,
    /// Packages that are linked.
    crates: u32,
    /// The program; none if it was not built.
    program: Option<Program>,
}

/// A program that was built and run.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Program {
    /// Stripped.
    bytes: u64,
    /// A headless game, ready for its first tick.
    headless_start: Used,
    /// One ball, until it rests.
    one_ball: Used,
    /// A whole headless game.
    game: Used,
}

/// What a process used.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Used {
    /// User time [ms].
    user_ms: f64,
    /// Whole processor time [ms].
    cpu_ms: f64,
    /// The most memory that it had [KiB].
    peak_kib: u64,
}

/// Reads the file.
pub fn read(file: &Path) -> Result<Builds, Error> {
    let text = read_text(file, FILE_MAX)?;
    serde_json::from_str(&text).map_err(|error| {
        let what = format!("--builds {}", file.display());
        Error::input(what, error.to_string(), "write it anew with tests/builds/run.py")
    })
}

/// A part of the chapter of what is left out.
pub fn section(text: &mut String, builds: &Builds) {
    let _ = writeln!(
        text,
        "### What each feature adds\n\nMeasured by `tests/builds/run.py`, in a run of its own. \
         Size is that of the stripped program; crates are those that are linked, the program's own \
         three included. Times are processor times of whole processes, medians of {}: user time, \
         and in brackets all of it. A headless start makes table, simulation, referee, players and \
         actors of `eight_ball_headless` and ends before the first tick; one ball is `simulate \
         --scene one_ball`; a game is `match --games 1`. What was not built has no figures.\n",
        builds.starts
    );
    let _ = writeln!(
        text,
        "| features | crates | size [MB] | headless start [ms] | one ball [ms] | a game [ms] | its \
         memory [MiB] |\n|---|---|---|---|---|---|---|"
    );
    for build in &builds.builds {
        let ms = |used: &Used| format!("{:.0} ({:.0})", used.user_ms, used.cpu_ms);
        let Build { features, crates, program } = build;
        let Some(program) = program else {
            let _ = writeln!(text, "| {features} | {crates} | - | - | - | - | - |");
            continue;
        };
        let _ = writeln!(
            text,
            "| {features} | {crates} | {:.1} | {} | {} | {} | {:.1} |",
            program.bytes as f64 / 1e6,
            ms(&program.headless_start),
            ms(&program.one_ball),
            ms(&program.game),
            program.game.peak_kib as f64 / 1024.0
        );
    }
    let _ = writeln!(text);
}
