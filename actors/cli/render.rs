//! `hapticbillard render`: one picture without a window.

use super::{Status, no_runtime, not_negative, size};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Examples:
  hapticbillard render --scene eight_ball --out table.png
  hapticbillard render --scene break_shot --at 0.4 --size 1920x1080 --out break.png";

/// Renders one picture of a scene into a PNG file, without a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct RenderArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE")]
    pub scene: String,

    /// Size of the picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (u32, u32),

    /// The PNG file.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,

    /// Lets the balls move for so many seconds first.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = not_negative)]
    pub at: f64,

    /// Prints the summary as a JSON line.
    #[arg(long)]
    pub json: bool,
}

/// Renders.
pub fn run(_args: &RenderArgs, _out: &mut dyn Write) -> Result<Status, Error> {
    Err(no_runtime("render"))
}
