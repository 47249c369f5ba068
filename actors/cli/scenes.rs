//! `hapticbillard scenes`: what is shipped.

use super::{Status, json_line};
use clap::Args;
use hapticbillard::scene::Scene;
use hapticbillard::shipped::SCENES;
use hapticbillard_actors::error::Error;
use serde_json::json;
use std::io::Write;

const EXAMPLE: &str = "\
Examples:
  hapticbillard scenes
  hapticbillard scenes --json";

/// Lists the shipped scenes, one line each.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct ScenesArgs {
    /// Prints JSON lines: one per scene, then the summary.
    #[arg(long)]
    pub json: bool,
}

/// Prints the list.
pub fn run(args: &ScenesArgs, out: &mut dyn Write) -> Result<Status, Error> {
    for (name, text) in SCENES {
        let about = Scene::parse(&format!("{name}.toml"), text)?.about;
        if args.json {
            let description = about.description;
            json_line(
                out,
                &json!({ "scene": name, "name": about.name, "description": description }),
            )?;
        } else {
            writeln!(out, "{name:<20} {}", about.description)?;
        }
    }
    if args.json {
        json_line(out, &json!({ "summary": { "scenes": SCENES.len() } }))?;
    }
    Ok(Status::Success)
}
