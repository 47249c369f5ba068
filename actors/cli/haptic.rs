//! `hapticbillard haptic`: the haptic renderer on the bench.

pub mod check;
mod devices;
mod load;
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
    Check(check::CheckArgs),
    Devices(devices::DevicesArgs),
}

/// Does it.
pub fn run(args: &HapticArgs, out: &mut dyn Write) -> Result<Status, Error> {
    match &args.command {
        HapticCommand::Simulate(args) => simulate::run(args, out),
        HapticCommand::Check(args) => check::run(args, out),
        HapticCommand::Devices(args) => devices::run(args, out),
    }
}
