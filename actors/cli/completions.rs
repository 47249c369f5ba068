//! `hapticbillard completions`: what a shell needs to complete the command line.

use super::Status;
use clap::{Args, Command};
use clap_complete::{Shell, generate};
use hapticbillard_actors::error::Error;
use std::io::Write;

const EXAMPLE: &str = "\
Examples:
  hapticbillard completions bash > ~/.local/share/bash-completion/completions/hapticbillard
  hapticbillard completions zsh > ~/.zfunc/_hapticbillard          (with ~/.zfunc in $fpath)
  hapticbillard completions fish > ~/.config/fish/completions/hapticbillard.fish";

/// Prints completions of the command line for a shell.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct CompletionsArgs {
    /// The shell.
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Prints the script for `program`, the whole command line.
pub fn run(
    args: &CompletionsArgs,
    mut program: Command,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    // It panics where it cannot write, and a pipe may be closed.
    let mut script = Vec::new();
    generate(args.shell, &mut program, "hapticbillard", &mut script);
    out.write_all(&script)?;
    Ok(Status::Success)
}
