//! Telemetry: every tick of the servo as a line of a file, written by a thread of its own.
//!
//! The servo puts a tick into a ring and knows nothing of files. A ring that is full loses the tick
//! and counts it.

use super::ports::TickTold;
use super::timing::Timing;
use crate::error::Error;
use crate::files::LineWriter;
use hapticbillard::haptic::telemetry::{COLUMNS, row};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// Ticks that wait at most: four seconds.
const WAITING: usize = 4096;
/// How long the writer sleeps between two looks.
const LOOK: Duration = Duration::from_millis(20);

/// What stands in a finished file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The file.
    pub path: PathBuf,
    /// Ticks, a line each under the names of the columns.
    pub rows: u64,
    /// Ticks that found the ring full.
    pub lost: u64,
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Written { path, rows, lost } = self;
        write!(f, "telemetry: {rows} ticks in {}", path.display())?;
        if *lost > 0 {
            write!(f, "; {lost} more were lost, because writing was too slow")?;
        }
        Ok(())
    }
}

/// A file that is being written. It is named `….part` until it is finished, which it is at the
/// latest when this is dropped.
pub struct Telemetry {
    path: PathBuf,
    timing: Arc<Timing>,
    end: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<u64, Error>>>,
}

impl Telemetry {
    /// Begins a file, and gives the servo's end. Ticks that are lost are counted in `timing`.
    ///
    /// # Errors
    /// [`Error`] if the file cannot be created, or there is no thread.
    pub fn begin(
        path: &Path,
        timing: Arc<Timing>,
    ) -> Result<(Self, rtrb::Producer<TickTold>), Error> {
        let mut file = LineWriter::create(path.to_path_buf())?;
        file.line(COLUMNS)?;
        let path = path.to_path_buf();
        let (port, ticks) = rtrb::RingBuffer::new(WAITING);
        let end = Arc::new(AtomicBool::new(false));
        let ended = end.clone();
        let thread = std::thread::Builder::new()
            .name("telemetry".to_string())
            .spawn(move || write(file, ticks, &ended))
            .map_err(|reason| Error::Write { path: path.clone(), reason })?;
        Ok((Telemetry { path, timing, end, thread: Some(thread) }, port))
    }

    /// Writes what still waits and gives the file its name.
    ///
    /// # Errors
    /// [`Error`] if not everything could be written; what could be is in the file `….part`.
    pub fn finish(mut self) -> Result<Written, Error> {
        let rows = self.join()?;
        Ok(Written { path: self.path.clone(), rows, lost: self.timing.lost_rows() })
    }

    fn join(&mut self) -> Result<u64, Error> {
        self.end.store(true, Ordering::Release);
        let Some(thread) = self.thread.take() else { return Ok(0) };
        thread.join().unwrap_or_else(|_| {
            let problem = "the thread that writes it ended by a defect";
            Err(Error::input("telemetry", problem, "report this"))
        })
    }
}

impl Drop for Telemetry {
    fn drop(&mut self) {
        if let Err(error) = self.join() {
            log::warn!("{error}");
        }
    }
}

/// Writes until the end is asked for, or the servo is gone; returns how many ticks.
fn write(
    mut file: LineWriter,
    mut ticks: rtrb::Consumer<TickTold>,
    end: &AtomicBool,
) -> Result<u64, Error> {
    let mut rows = 0;
    loop {
        // Asked before the look, so that nothing is left behind by the last one.
        let is_last = end.load(Ordering::Acquire) || ticks.is_abandoned();
        let mut lines: Vec<String> = Vec::with_capacity(ticks.slots());
        for _ in 0..ticks.slots() {
            if let Ok(TickTold { report, late_ns }) = ticks.pop() {
                lines.push(row(&report, late_ns as f64 * 1e-9));
            }
        }
        if !lines.is_empty() {
            rows += lines.len() as u64;
            file.line(&lines.join("\n"))?;
        }
        if is_last {
            file.finish()?;
            return Ok(rows);
        }
        std::thread::sleep(LOOK);
    }
}
