//! `hapticbillard validate`: cases with known answers.

use super::{Status, json_line, progress};
use clap::Args;
use hapticbillard::physics::SolverKind;
use hapticbillard::shipped;
use hapticbillard::validation::{self, Case, Catalogue, Outcome};
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

/// Largest catalogue [bytes].
const CASES_BYTES_MAX: u64 = 64 << 20;

const EXAMPLE: &str = "\
Each row is a case: its id, pass, fail or unsupported, the expected value that is worst met, its
error against what it may be, and processor time. Exits with 1 if a case fails.

Examples:
  hapticbillard validate
  hapticbillard validate --only A01 B12 --json
  hapticbillard validate --cases cases.json --solver fixed-step";

/// Runs cases with known answers: closed forms, published models, measurements.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct ValidateArgs {
    /// A catalogue in JSON; without it the one that is compiled in.
    #[arg(long, value_name = "FILE")]
    pub cases: Option<PathBuf>,

    /// The solver of the cases that move balls [default: the game's].
    #[arg(long, value_name = "SOLVER", value_parser = solver)]
    pub solver: Option<SolverKind>,

    /// Runs only these cases.
    #[arg(long, value_name = "ID", num_args = 1..)]
    pub only: Vec<String>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// A solver by the name that scenes use.
fn solver(name: &str) -> Result<SolverKind, String> {
    serde_json::from_value(json!(name)).map_err(|error| error.to_string())
}

/// Runs the cases.
pub fn run(args: &ValidateArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let judged = Judged {
        cases: args.cases.as_ref(),
        shipped: shipped::CASES,
        solver: args.solver,
        only: &args.only,
        json: args.json,
        command: "validate",
    };
    judge(&judged, out)
}

/// A catalogue, and how it is run.
pub struct Judged<'a> {
    /// The file; without it the shipped text.
    pub cases: Option<&'a PathBuf>,
    /// What is compiled in.
    pub shipped: &'static str,
    /// The solver of the cases that move balls.
    pub solver: Option<SolverKind>,
    /// Only these cases, if there are any.
    pub only: &'a [String],
    /// Prints JSON lines.
    pub json: bool,
    /// The command that somebody typed.
    pub command: &'static str,
}

/// Runs the cases of a catalogue and prints a row for each.
pub fn judge(judged: &Judged<'_>, out: &mut dyn Write) -> Result<Status, Error> {
    let (name, text) = match judged.cases {
        Some(file) => (file.display().to_string(), read_text(file, CASES_BYTES_MAX)?),
        None => (String::from("the shipped catalogue"), judged.shipped.to_string()),
    };
    let wrong = |error: validation::CatalogueError| {
        Error::input(&*name, error.to_string(), "see the shipped catalogue for the format")
    };
    let mut catalogue = Catalogue::parse(&text).map_err(wrong)?;
    choose(&mut catalogue, judged)?;
    let solver = judged.solver.unwrap_or(hapticbillard::physics::PhysicsSettings::default().solver);

    let bar = progress(catalogue.cases.len() as u64, "cases");
    let (mut pass, mut fail, mut unsupported) = (0, 0, 0);
    for case in &catalogue.cases {
        let begin = thread_cpu_time();
        let outcome = validation::run(case, solver).map_err(wrong)?;
        let cpu_ms = (thread_cpu_time() - begin).as_secs_f64() * 1000.0;
        match outcome.status {
            validation::Status::Pass => pass += 1,
            validation::Status::Fail => fail += 1,
            validation::Status::Unsupported => unsupported += 1,
        }
        bar.suspend(|| print(judged.json, case, &outcome, cpu_ms, out))?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    if judged.json {
        let summary = json!({ "pass": pass, "fail": fail, "unsupported": unsupported });
        json_line(out, &json!({ "summary": summary }))?;
    } else {
        writeln!(out, "{pass} pass, {fail} fail, {unsupported} unsupported")?;
    }
    Ok(if fail == 0 { Status::Success } else { Status::CheckFailed })
}

/// Keeps the cases that were asked for, in the order of the file.
fn choose(catalogue: &mut Catalogue, judged: &Judged<'_>) -> Result<(), Error> {
    let only = judged.only;
    for id in only {
        if !catalogue.cases.iter().any(|case| case.id == *id) {
            let problem = format!("there is no case '{}'", id.escape_default());
            let fix = format!("see `hapticbillard {}` for the ids", judged.command);
            return Err(Error::input("--only", problem, &fix));
        }
    }
    if !only.is_empty() {
        catalogue.cases.retain(|case| only.contains(&case.id));
    }
    Ok(())
}

fn print(
    json: bool,
    case: &Case,
    outcome: &Outcome,
    cpu_ms: f64,
    out: &mut dyn Write,
) -> Result<(), Error> {
    if json {
        let mut line = serde_json::to_value(outcome).map_err(std::io::Error::from)?;
        line["cpu_ms"] = json!(cpu_ms);
        return json_line(out, &line);
    }
    let status = match outcome.status {
        validation::Status::Pass => "pass",
        validation::Status::Fail => "FAIL",
        validation::Status::Unsupported => "unsupported",
    };
    let id = &outcome.id;
    let what = match (&outcome.key, outcome.error, outcome.limit) {
        (Some(key), Some(error), Some(limit)) => format!("{key}: {error:.2e} of {limit:.2e}"),
        _ => outcome.reason.clone().unwrap_or_default(),
    };
    writeln!(out, "{id:5} {status:11} {cpu_ms:9.2} ms  {what}  ({})", case.title)?;
    Ok(())
}
