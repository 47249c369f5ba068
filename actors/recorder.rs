//! The actor that writes a recording, line by line, on a thread of its own.
//!
//! A frame is on disk before the game uses it. The file is named `….part` until the game has
//! ended, and can be replayed as far as it goes even then. When this actor dies, or the disk
//! refuses, [`Keeper`] starts another one that goes on in the same file.

mod keeper;

pub use keeper::{Keeper, Lost, Open};

use crate::crew::Crew;
use crate::error::Error;
use crate::files::LineWriter;
use hapticbillard::replay::Line;
use kameo::mailbox;
use kameo::prelude::*;
use std::path::Path;

/// Lines that may wait for the disk; the conductor waits when it is full.
const MAILBOX: usize = 64;

/// Owns the file.
#[derive(Actor)]
pub struct Recorder {
    file: Option<LineWriter>,
    /// Bytes in the file.
    length: u64,
}

impl Recorder {
    /// Begins a file, or goes on behind the first `length` bytes of one that was begun.
    ///
    /// # Errors
    /// [`Error`] if it cannot be written, or holds less than that.
    pub fn open(path: &Path, length: u64) -> Result<Self, Error> {
        let file = match length {
            0 => LineWriter::create(path.to_path_buf())?,
            _ => LineWriter::resume(path.to_path_buf(), length)?,
        };
        Ok(Recorder { file: Some(file), length })
    }

    /// The same as an actor.
    ///
    /// # Errors
    /// As for [`Recorder::open`].
    pub fn start(path: &Path, length: u64) -> Result<ReplyRecipient<Record, Written>, Error> {
        Self::start_in(&Crew::default(), path, length)
    }

    /// The same, one of a crew.
    ///
    /// # Errors
    /// As for [`Recorder::open`].
    pub fn start_in(
        crew: &Crew,
        path: &Path,
        length: u64,
    ) -> Result<ReplyRecipient<Record, Written>, Error> {
        let recorder = Self::open(path, length)?;
        let mailbox = mailbox::bounded(MAILBOX);
        let actor = Self::spawn_in_thread_with_mailbox(recorder, mailbox);
        crew.tell("recorder", &actor);
        Ok(actor.reply_recipient())
    }

    /// Writes a line; the last one closes the file.
    fn write(&mut self, line: &Line) -> Result<u64, Error> {
        let Some(file) = &mut self.file else {
            return Ok(self.length);
        };
        self.length += file.line(&line.to_json())?;
        if matches!(line, Line::End { .. })
            && let Some(file) = self.file.take()
        {
            file.finish()?;
        }
        Ok(self.length)
    }
}

/// Write this line. The answer says how many bytes are in the file now.
pub struct Record(pub Line);

/// Whether it is on disk.
#[derive(Debug, Reply)]
pub struct Written(pub Result<u64, Error>);

impl Message<Record> for Recorder {
    type Reply = Written;

    async fn handle(&mut self, message: Record, _: &mut Context<Self, Written>) -> Written {
        Written(self.write(&message.0))
    }
}
