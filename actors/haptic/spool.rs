//! What a servo tells, as the lines of a file, written by a thread of its own.
//!
//! The servo puts an entry into a ring and never touches the file. What finds the ring full is
//! lost; whoever puts it in counts that. The file has its name only when it is whole; what a crash
//! leaves behind is named `….part`, and holds all but the last hundredth of a second.

use crate::error::Error;
use crate::files::LineWriter;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// How long the writer sleeps between two looks.
const LOOK: Duration = Duration::from_millis(10);

/// A file that is being written; it gets its name at the latest when this is dropped.
pub struct Spool {
    what: &'static str,
    end: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<u64, Error>>>,
}

impl Spool {
    /// Begins a file with its first line, and gives the end of the ring in which at most `waiting`
    /// entries wait. `line` makes the line of an entry, or leaves it out.
    ///
    /// # Errors
    /// [`Error::Write`] if the file cannot be created, or there is no thread.
    pub fn begin<T: Send + 'static>(
        what: &'static str,
        path: &Path,
        head: &str,
        waiting: usize,
        line: impl FnMut(&T) -> Option<String> + Send + 'static,
    ) -> Result<(Self, rtrb::Producer<T>), Error> {
        let mut file = LineWriter::create(path.to_path_buf())?;
        file.line(head)?;
        let (port, entries) = rtrb::RingBuffer::new(waiting);
        let end = Arc::new(AtomicBool::new(false));
        let ended = end.clone();
        let thread = std::thread::Builder::new()
            .name(what.to_string())
            .spawn(move || write(file, entries, &ended, line))
            .map_err(|reason| Error::Write { path: path.to_path_buf(), reason })?;
        Ok((Spool { what, end, thread: Some(thread) }, port))
    }

    /// Writes what still waits and gives the file its name; returns how many entries it has.
    ///
    /// # Errors
    /// [`Error`] if not everything could be written; what could be is in the file `….part`.
    pub fn finish(mut self) -> Result<u64, Error> {
        self.join()
    }

    fn join(&mut self) -> Result<u64, Error> {
        self.end.store(true, Ordering::Release);
        let Some(thread) = self.thread.take() else { return Ok(0) };
        thread.join().unwrap_or_else(|_| {
            let problem = "the thread that writes it ended by a defect";
            Err(Error::input(self.what, problem, "report this"))
        })
    }
}

impl Drop for Spool {
    fn drop(&mut self) {
        if let Err(error) = self.join() {
            tracing::warn!("{error}");
        }
    }
}

/// Writes until the end is asked for, or the servo is gone.
fn write<T>(
    mut file: LineWriter,
    mut entries: rtrb::Consumer<T>,
    end: &AtomicBool,
    mut line: impl FnMut(&T) -> Option<String>,
) -> Result<u64, Error> {
    let mut written = 0;
    loop {
        // Asked before the look, so that nothing is left behind by the last one.
        let is_last = end.load(Ordering::Acquire) || entries.is_abandoned();
        let waiting = (0..entries.slots()).filter_map(|_| entries.pop().ok());
        let lines: Vec<String> = waiting.filter_map(|entry| line(&entry)).collect();
        if !lines.is_empty() {
            written += lines.len() as u64;
            file.line(&lines.join("\n"))?;
        }
        if is_last {
            file.finish()?;
            return Ok(written);
        }
        std::thread::sleep(LOOK);
    }
}
