//! `hapticbillard replay`: plays a recording back.

use super::{Driver, Status, json_line};
use clap::Args;
use hapticbillard::hash::Digest;
use hapticbillard::ids::PlayerId;
use hapticbillard::replay::{Divergence, Recording, SIZE_MAX, TickHash};
use hapticbillard::units::Tick;
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use hapticbillard_actors::game::{Headless, Stage, play_headless};
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLE: &str = "\
A recording is what entered the game from outside, tick by tick, with a hash of every subsystem at
each tick that has a fact. --verify computes the game again and stops at the first tick whose hash
differs (exit code 1).

Examples:
  hapticbillard replay game.jsonl
  hapticbillard replay game.jsonl --verify --headless --json";

/// Plays a recording back.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct ReplayArgs {
    /// The recording.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,

    /// Exits with 1 at the first divergence, and names tick and ball.
    #[arg(long)]
    pub verify: bool,

    /// Without a window, as fast as possible.
    #[arg(long)]
    pub headless: bool,

    /// Prints the summary as a JSON line.
    #[arg(long)]
    pub json: bool,

    /// The runtime; both give the same output.
    #[arg(long, value_enum, default_value_t)]
    pub driver: Driver,
}

#[derive(Serialize)]
struct Summary {
    ticks: u64,
    shots: u32,
    verified: u64,
    first_divergence: Option<Divergence>,
    winner: Option<PlayerId>,
    complete: bool,
    state_hash: Option<Digest>,
}

/// Plays it back.
pub fn run(args: &ReplayArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let recording = Arc::new(read_recording(&args.file)?);
    let stage = Stage::of_recording(&recording)?;
    #[cfg(feature = "renderer")]
    if !args.headless && !args.verify && !args.json && super::play::has_display() {
        return super::play::replay_in_window(&stage, recording);
    }
    let how = Headless {
        driver: args.driver.into(),
        replay: Some(recording.clone()),
        verify: args.verify,
        ..Headless::default()
    };
    let (summary, status) = match play_headless(&stage, how) {
        Ok((finished, tally)) => {
            let summary = Summary {
                ticks: finished.tick.0,
                shots: tally.shots.iter().sum(),
                verified: finished.verified,
                first_divergence: None,
                winner: tally.winner,
                complete: recording.end.is_some(),
                state_hash: finished.hash.as_ref().map(TickHash::all),
            };
            (summary, Status::Success)
        }
        Err(Error::Run(RunError::Diverged(divergence))) => {
            let summary = Summary {
                ticks: divergence.tick.0,
                shots: 0,
                verified: recording.hashes.range(..divergence.tick).count() as u64,
                first_divergence: Some(divergence),
                winner: None,
                complete: recording.end.is_some(),
                state_hash: None,
            };
            (summary, Status::CheckFailed)
        }
        Err(error) => return Err(error),
    };
    if args.json {
        json_line(out, &serde_json::json!({ "summary": summary }))?;
        return Ok(status);
    }
    if let Some(divergence) = &summary.first_divergence {
        writeln!(out, "{divergence}; {} hashes before it agree", summary.verified)?;
        return Ok(status);
    }
    let seconds = Tick(summary.ticks).end_s();
    writeln!(out, "{} shots in {seconds} s of the game", summary.shots)?;
    if let Some(winner) = summary.winner {
        writeln!(out, "player {winner} wins")?;
    }
    if !summary.complete {
        writeln!(out, "the recording has no end: it was cut off here")?;
    }
    if args.verify {
        writeln!(out, "all {} state hashes agree", summary.verified)?;
    }
    Ok(status)
}

/// Reads a recording, or says what is wrong with it.
pub fn read_recording(path: &Path) -> Result<Recording, Error> {
    let text = read_text(path, SIZE_MAX as u64)?;
    Recording::parse(&text).map_err(|error| Error::Recording { path: path.to_path_buf(), error })
}
