//! `hapticbillard sound`: what is heard, without playing.

mod bank;
mod devices;
mod render;

use super::Status;
use clap::{Args, Subcommand};
use hapticbillard_actors::error::Error;
use std::io::Write;

/// Renders sound into files, lists outputs.
#[derive(Debug, Clone, Args)]
pub struct SoundArgs {
    #[command(subcommand)]
    pub command: SoundCommand,
}

/// What to do.
#[derive(Debug, Clone, Subcommand)]
pub enum SoundCommand {
    Render(render::RenderArgs),
    Bank(bank::BankArgs),
    Devices(devices::DevicesArgs),
}

/// Does it.
pub fn run(args: &SoundArgs, out: &mut dyn Write) -> Result<Status, Error> {
    match &args.command {
        SoundCommand::Render(args) => render::run(args, out),
        SoundCommand::Bank(args) => bank::run(args, out),
        SoundCommand::Devices(args) => devices::run(args, out),
    }
}
