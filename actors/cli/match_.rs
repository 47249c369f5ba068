//! `hapticbillard match`: games without a window.

use super::{Driver, Status, no_runtime, not_negative};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Prints a line per game and a total: who won, shots, fouls, balls pocketed, racks cleared in one
turn. Two runs with one seed print the same bytes, unless --timing is given.

Examples:
  hapticbillard match --games 100 --seed 1
  hapticbillard match --games 10 --players paper,paper --noise 0.5 --json
  hapticbillard match --games 3 --record games/";

/// Plays games without a window, as fast as possible.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct MatchArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE", default_value = "eight_ball_headless")]
    pub scene: String,

    /// How many games.
    #[arg(long, value_name = "N", default_value = "1",
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub games: u32,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "K")]
    pub seed: Option<u64>,

    /// Kinds of the two players, in place of the scene's; the first breaks in the first game.
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1,
          value_parser = ["paper"])]
    pub players: Vec<String>,

    /// Noise of both players' strokes, in multiples of their own, in place of the scene's.
    #[arg(long, value_name = "X", value_parser = not_negative)]
    pub noise: Option<f64>,

    /// Records every game into this folder.
    #[arg(long, value_name = "DIR")]
    pub record: Option<PathBuf>,

    /// The runtime; both give the same output.
    #[arg(long, value_enum, default_value_t)]
    pub driver: Driver,

    /// Prints JSON lines: one per game, then the summary.
    #[arg(long)]
    pub json: bool,

    /// Also tells how long decisions took; two runs then differ.
    #[arg(long)]
    pub timing: bool,
}

/// Plays the games.
pub fn run(_args: &MatchArgs, _out: &mut dyn Write) -> Result<Status, Error> {
    Err(no_runtime("match"))
}
