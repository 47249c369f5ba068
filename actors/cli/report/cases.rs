//! The scenes in numbers, for other programs.

use super::super::Status;
use super::measure;
use hapticbillard::report::{Prepared, Scene};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use serde_json::to_writer;
use std::io::Write;
use std::path::Path;

/// Writes a line for each scene.
pub fn write(
    file: &Path,
    scenes: &[Scene],
    quick: bool,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let mut text = Vec::new();
    for scene in scenes {
        let prepared = Prepared::new(*scene, measure::most_starts(quick))?;
        to_writer(&mut text, &prepared.case()).map_err(std::io::Error::other)?;
        text.push(b'\n');
    }
    write_whole(file, &text)?;
    writeln!(out, "{} cases in {}", scenes.len(), file.display())?;
    Ok(Status::Success)
}
