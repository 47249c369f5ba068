//! `simulate --batch`: many independent shots from one start, on all cores.

use super::super::in_order::in_order;
use super::super::{Status, json_line, progress};
use super::SimulateArgs;
use super::print::{BallLine, Energy, FactLine, balls, state_hash};
use hapticbillard::events::FactKind;
use hapticbillard::hash::Digest;
use hapticbillard::physics::{Shot, Simulation, Strike};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// The largest file of shots that is read [bytes].
const SIZE_MAX: u64 = 256 << 20;

#[derive(Serialize)]
struct ShotLine<'a> {
    shot: u32,
    end_s: f64,
    facts: Vec<FactLine<'a>>,
    balls: Vec<BallLine>,
    #[serde(rename = "energy_J")]
    energy: Energy,
    state_hash: Digest,
}

/// Runs all shots of `file`.
pub fn run(
    args: &SimulateArgs,
    start: &Simulation,
    file: &Path,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let strikes = read(file)?;
    let count = u32::try_from(strikes.len()).unwrap_or(u32::MAX);
    let bar = progress(u64::from(count), "shots");
    let shoot = |shot: u32| -> Result<Shot, Error> {
        let (line, strike) = strikes[shot as usize];
        let struck = start.clone().strike(strike).and_then(Simulation::run_until_rest);
        struck.map_err(|error| wrong(file, line, error))
    };
    in_order(count, shoot, |shot, result| {
        let result = result?;
        bar.inc(1);
        let (end_s, facts) = (result.end_s, &result.facts);
        if args.json {
            let line = ShotLine {
                shot: shot + 1,
                end_s,
                facts: facts.iter().map(FactLine::from).collect(),
                balls: balls(&result.end, end_s),
                energy: Energy::of(&result.end),
                state_hash: state_hash(&result.end),
            };
            return json_line(out, &line);
        }
        let pots: Vec<String> = facts
            .iter()
            .filter_map(|fact| match fact.kind {
                FactKind::BallPocketed { ball, pocket, .. } => Some(format!("{ball} in {pocket}")),
                _ => None,
            })
            .collect();
        let pots = if pots.is_empty() { String::from("nothing falls") } else { pots.join(", ") };
        Ok(writeln!(out, "shot {:>4}: {end_s:>7.3} s, {} facts; {pots}", shot + 1, facts.len())?)
    })?;
    bar.finish_and_clear();
    if args.json {
        json_line(out, &serde_json::json!({ "summary": { "shots": count } }))?;
    }
    Ok(Status::Success)
}

/// The strikes of a file, with their lines.
fn read(file: &Path) -> Result<Vec<(usize, Strike)>, Error> {
    let text = read_text(file, SIZE_MAX)?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(index, line)| match Strike::from_json(line) {
            Ok(strike) => Ok((index + 1, strike)),
            Err(error) => Err(wrong(file, index + 1, error)),
        })
        .collect()
}

fn wrong(file: &Path, line: usize, error: impl std::fmt::Display) -> Error {
    let fix = "see simulate --help for what a line may hold";
    Error::input(format!("{}:{line}", file.display()), error.to_string(), fix)
}
