//! `hapticbillard replay`: plays a recording back.

use super::{Driver, Status, no_runtime};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;

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

/// Plays it back.
pub fn run(_args: &ReplayArgs, _out: &mut dyn Write) -> Result<Status, Error> {
    Err(no_runtime("replay"))
}
