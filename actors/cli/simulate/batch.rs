//! `simulate --batch`: many independent shots from one start, on all cores.

use super::super::{Status, json_line, progress};
use super::SimulateArgs;
use super::print::{BallLine, Energy, FactLine, balls, state_hash};
use hapticbillard::events::FactKind;
use hapticbillard::hash::Digest;
use hapticbillard_actors::batch::{self, Setup};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use hapticbillard_actors::game::Stage;
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// The largest file of shots that is read [bytes].
const SIZE_MAX: u64 = 256 << 20;

#[derive(Serialize)]
struct ShotLine<'a> {
    shot: usize,
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
    stage: &Stage,
    file: &Path,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let start = stage.simulation()?;
    let shots = read(stage, file)?;
    let setups: Vec<Setup> = shots.iter().map(|(_, setup)| setup.clone()).collect();
    let bar = progress(setups.len() as u64, "shots");
    let done = || bar.inc(1);
    batch::run(&start, &setups, args.threads, done, |shot, result| {
        let result = result.map_err(|error| wrong(file, shots[shot].0, error))?;
        let (number, end_s, facts) = (shot + 1, result.end_s, &result.facts);
        if args.json {
            let line = ShotLine {
                shot: number,
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
        Ok(writeln!(out, "shot {number:>4}: {end_s:>7.3} s, {} facts; {pots}", facts.len())?)
    })?;
    bar.finish_and_clear();
    if args.json {
        json_line(out, &serde_json::json!({ "summary": { "shots": setups.len() } }))?;
    }
    Ok(Status::Success)
}

/// The shots of a file, with their lines.
pub fn read(stage: &Stage, file: &Path) -> Result<Vec<(usize, Setup)>, Error> {
    let known = stage.scene.build_balls(&stage.table)?;
    let text = read_text(file, SIZE_MAX)?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(index, line)| match Setup::from_json(line, &known) {
            Ok(setup) => Ok((index + 1, setup)),
            Err(error) => Err(wrong(file, index + 1, error)),
        })
        .collect()
}

/// What is wrong with a line.
pub fn wrong(file: &Path, line: usize, error: impl std::fmt::Display) -> Error {
    let fix = "see simulate --help for what a line may hold";
    Error::input(format!("{}:{line}", file.display()), error.to_string(), fix)
}
