//! `hapticbillard sound`: what is heard, without a game.

mod bank;

use super::Status;
use clap::{Args, Subcommand};
use hapticbillard_actors::error::Error;
use std::io::Write;

/// Writes sounds into files.
#[derive(Debug, Clone, Args)]
pub struct SoundArgs {
    #[command(subcommand)]
    pub command: SoundCommand,
}

/// What to write.
#[derive(Debug, Clone, Subcommand)]
pub enum SoundCommand {
    Bank(bank::BankArgs),
}

/// Does it.
pub fn run(args: &SoundArgs, out: &mut dyn Write) -> Result<Status, Error> {
    match &args.command {
        SoundCommand::Bank(args) => bank::run(args, out),
    }
}
