//! `hapticbillard sound devices`: where sound can go.

use crate::cli::{Status, json_line};
use clap::Args;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::sound::system;
use serde_json::json;
use std::io::Write;

const EXAMPLE: &str = "\
A scene names its output in [sound], such as device = \"pulse\"; without it the system's own choice
is taken. The name and the description can both be written.

Examples:
  hapticbillard sound devices
  hapticbillard sound devices --json";

/// Lists the outputs that a scene can name.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct DevicesArgs {
    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// Lists them.
pub fn run(args: &DevicesArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let outputs = system().outputs()?;
    for output in &outputs {
        if args.json {
            let line = json!({ "name": output.name, "description": output.description });
            json_line(out, &line)?;
        } else {
            writeln!(out, "{:<32} {}", output.name, output.description)?;
        }
    }
    if args.json {
        json_line(out, &json!({ "summary": { "devices": outputs.len() } }))?;
    } else if outputs.is_empty() {
        writeln!(out, "no output: games are played in silence")?;
    }
    Ok(Status::Success)
}
