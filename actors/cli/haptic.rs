//! `hapticbillard haptic`: the haptic renderer on the bench.

mod simulate;

use super::Status;
use clap::{Args, Subcommand};
use hapticbillard_actors::error::Error;
use std::io::Write;

/// Tries the haptic renderer.
#[derive(Debug, Clone, Args)]
pub struct HapticArgs {
    #[command(subcommand)]
    pub command: HapticCommand,
}

/// What to try.
#[derive(Debug, Clone, Subcommand)]
pub enum HapticCommand {
    Simulate(simulate::SimulateArgs),
}

/// Does it.
pub fn run(args: &HapticArgs, out: &mut dyn Write) -> Result<Status, Error> {
    match &args.command {
        HapticCommand::Simulate(args) => simulate::run(args, out),
    }
}
