//! The actor that writes a recording, line by line, on a thread of its own.
//!
//! A frame is on disk before the game uses it. The file is named `….part` until the game has
//! ended, and can be replayed as far as it goes even then.

use crate::error::Error;
use crate::files::LineWriter;
use hapticbillard::replay::{Header, Line};
use kameo::prelude::*;
use std::path::PathBuf;

/// Owns the file.
#[derive(Actor)]
pub struct Recorder {
    file: Option<LineWriter>,
}

impl Recorder {
    /// Creates the file and writes its header.
    ///
    /// # Errors
    /// [`Error`] if it cannot be created or written.
    pub fn create(path: PathBuf, header: Header) -> Result<Self, Error> {
        let mut file = LineWriter::create(path)?;
        file.line(&Line::Recording(header).to_json())?;
        Ok(Recorder { file: Some(file) })
    }

    /// Writes a line; the last one closes the file.
    ///
    /// # Errors
    /// [`Error`] if the disk refuses.
    pub fn write(&mut self, line: &Line) -> Result<(), Error> {
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        file.line(&line.to_json())?;
        if matches!(line, Line::End { .. })
            && let Some(file) = self.file.take()
        {
            file.finish()?;
        }
        Ok(())
    }
}

/// Write this line.
pub struct Record(pub Line);

/// Whether it is on disk.
#[derive(Debug, Reply)]
pub struct Written(pub Result<(), Error>);

impl Message<Record> for Recorder {
    type Reply = Written;

    async fn handle(&mut self, message: Record, _: &mut Context<Self, Written>) -> Written {
        Written(self.write(&message.0))
    }
}
