//! `hapticbillard man`: a manual page for each command.

use super::Status;
use clap::{Args, Command};
use clap_mangen::Man;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use roff::{Roff, roman};
use std::io::Write;
use std::path::{Path, PathBuf};

const EXAMPLE: &str = "\
Examples:
  hapticbillard man --out ~/.local/share/man/man1
  man hapticbillard-simulate";

/// Writes the manual: hapticbillard.1, and a page for each command.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct ManArgs {
    /// The folder to write to.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Writes the pages of `program`, the whole command line.
pub fn run(args: &ManArgs, program: Command, out: &mut dyn Write) -> Result<Status, Error> {
    let mut program = program.disable_help_subcommand(true);
    // Gives each page its full name: hapticbillard-haptic-check.
    program.build();
    let count = write(&program, &args.out)?;
    writeln!(out, "{count} pages in {}", args.out.display())?;
    Ok(Status::Success)
}

/// Writes the page of a command and those below it; returns how many.
fn write(command: &Command, folder: &Path) -> Result<usize, Error> {
    let version = concat!("HapticBillard ", env!("CARGO_PKG_VERSION"));
    let page = Man::new(command.clone()).manual("HapticBillard").source(version);
    let mut text = Vec::new();
    page.render_title(&mut text)?;
    page.render_name_section(&mut text)?;
    page.render_synopsis_section(&mut text)?;
    page.render_description_section(&mut text)?;
    page.render_options_section(&mut text)?;
    if command.has_subcommands() {
        page.render_subcommands_section(&mut text)?;
    }
    if let Some(notes) = command.get_after_help() {
        notes_section(&notes.to_string()).to_writer(&mut text)?;
    }
    write_whole(&folder.join(page.get_filename()), &text)?;
    let mut below = command.get_subcommands().map(|command| write(command, folder));
    below.try_fold(1, |sum, count| Ok(sum + count?))
}

/// What stands behind the options in the help. Examples are indented there, and keep their lines.
fn notes_section(notes: &str) -> Roff {
    let mut section = Roff::new();
    section.control("SH", ["NOTES AND EXAMPLES"]);
    let mut in_example = false;
    for line in notes.lines() {
        let is_example = line.starts_with("  ");
        if in_example != is_example {
            section.control(if is_example { "EX" } else { "EE" }, []);
            in_example = is_example;
        }
        match line {
            "" => section.control("PP", []),
            line => section.text([roman(line)]),
        };
    }
    if in_example {
        section.control("EE", []);
    }
    section
}
