//! `hapticbillard sound bank`: every class of sounds as files.

#[cfg(feature = "sound")]
mod sounds;
#[cfg(feature = "sound")]
mod write;

use clap::Args;
use std::path::PathBuf;
#[cfg(not(feature = "sound"))]
use {crate::cli::Status, hapticbillard_actors::error::Error, std::io::Write};

const EXAMPLE: &str = "\
Each file is named CLASS_vSPEED_VARIANT.wav: ball_click_v2_3.wav is the third click of two balls
that meet at 2 m/s. It has one channel of 32-bit floats; 124 dB SPL at 1 m are 3 dB below 1.0.

A folder of recordings of your own with such names is used in place of the synthesis by a scene
that says recordings = \"FOLDER\" in [sound]. They may be WAV files of any format, rate and level,
with one channel or two: they are brought to the level of the synthesis at the speed that the name
says, and a hit at another speed plays the nearest of its class. Classes without a recording are
synthesised. Rolling, sliding and the room always are; this command writes them into the folder
`lasting`.

Examples:
  hapticbillard sound bank --out sounds
  hapticbillard sound bank --out sounds --variants 8 --rate 44100 --json";

/// Writes every class of sounds into WAV files, at several speeds and in several variants.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct BankArgs {
    /// The folder; it is made if it is not there.
    #[arg(long, value_name = "FOLDER")]
    pub out: PathBuf,

    /// How many of each speed.
    #[arg(long, value_name = "N", default_value = "3")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100))]
    pub variants: u32,

    /// Samples per second [Hz].
    #[arg(long, value_name = "HZ", default_value = "48000")]
    #[arg(value_parser = clap::value_parser!(u32).range(8_000..=192_000))]
    pub rate: u32,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

#[cfg(feature = "sound")]
pub use write::run;

/// Says that there is nothing to write with.
#[cfg(not(feature = "sound"))]
pub fn run(_: &BankArgs, _: &mut dyn Write) -> Result<Status, Error> {
    let fix = "build it with the feature `sound`, which is there by default";
    Err(Error::input("sound bank", "this build writes no sound files", fix))
}
