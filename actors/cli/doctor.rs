//! `hapticbillard doctor`: what of this machine the game can use, and what would help.

mod checks;

use super::{Status, json_line};
use checks::{Found, Health};
use clap::Args;
use hapticbillard_actors::error::Error;
use serde::Serialize;
use std::io::Write;

const EXAMPLE: &str = "\
Looks at everything that a game may need: the folders that it writes to, a display and OpenGL,
sound, haptic devices, real-time rights; and plays a game to see that actors compute what lockstep
does. Nothing is changed. What is missing is named with what would help; games go without it. The
exit code is 1 only if something is broken that every game needs.

Examples:
  hapticbillard doctor
  hapticbillard doctor --json";

/// Looks whether this machine has what a game needs, and says what would help.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct DoctorArgs {
    /// Prints JSON lines: one per check, then the summary.
    #[arg(long)]
    pub json: bool,
}

#[derive(Serialize)]
struct Summary {
    well: usize,
    missing: usize,
    broken: usize,
}

/// Looks.
pub fn run(args: &DoctorArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let mut summary = Summary { well: 0, missing: 0, broken: 0 };
    for check in checks::ALL {
        for found in check() {
            match found.health {
                Health::Well => summary.well += 1,
                Health::Missing => summary.missing += 1,
                Health::Broken => summary.broken += 1,
            }
            if args.json {
                json_line(out, &found)?;
            } else {
                write(&found, out)?;
            }
            // Some take a second.
            out.flush()?;
        }
    }
    if args.json {
        json_line(out, &serde_json::json!({ "summary": &summary }))?;
    } else if summary.broken > 0 {
        writeln!(out, "\nThe game cannot be played like this.")?;
    } else if summary.missing > 0 {
        writeln!(out, "\nThe game can be played; it goes without what is missing.")?;
    } else {
        writeln!(out, "\nEverything is there.")?;
    }
    Ok(if summary.broken == 0 { Status::Success } else { Status::CheckFailed })
}

fn write(found: &Found, out: &mut dyn Write) -> Result<(), Error> {
    let mark = match found.health {
        Health::Well => "well",
        Health::Missing => "missing",
        Health::Broken => "BROKEN",
    };
    writeln!(out, "{mark:<9}{:<13}{}", found.what, found.found)?;
    if let Some(remedy) = &found.remedy {
        writeln!(out, "{:<22}{remedy}", "")?;
    }
    Ok(())
}
