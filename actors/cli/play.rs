//! `hapticbillard [play]`: the game.

use super::{Driver, Status, no_runtime, positive};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Without a display it says so and plays eight_ball_headless with a live score. Every game is
recorded in the user's data folder, where the last 20 are kept.

Examples:
  hapticbillard                              the same as: hapticbillard play --scene eight_ball
  hapticbillard play --scene free_play
  hapticbillard play --seed 3 --record game.jsonl";

/// Plays a game in a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct PlayArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE", default_value = "eight_ball")]
    pub scene: String,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,

    /// Records into this file instead of the data folder.
    #[arg(long, value_name = "FILE", conflicts_with = "no_record")]
    pub record: Option<PathBuf>,

    /// Records nothing.
    #[arg(long)]
    pub no_record: bool,

    /// The runtime of a game without a window.
    #[arg(long, value_enum, default_value_t)]
    pub driver: Driver,

    /// Game time per real time; 1 is as in the world, 0.25 slow motion.
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = positive)]
    pub speed: f64,
}

/// Plays.
pub fn run(_args: &PlayArgs, _out: &mut dyn Write) -> Result<Status, Error> {
    Err(no_runtime("play"))
}
