//! Telemetry: every tick of the servo as a line of a file.

use super::ports::{TickTold, Watch};
use super::spool::Spool;
use super::timing::Timing;
use crate::error::Error;
use hapticbillard::haptic::telemetry::{COLUMNS, row};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Ticks that wait at most: four seconds.
const WAITING: usize = 4096;

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

/// A file that is being written.
pub struct Telemetry {
    path: PathBuf,
    timing: Arc<Timing>,
    spool: Spool,
}

impl Telemetry {
    /// Begins a file, if one is wanted, and lets the servo of `watch` tell it every tick. Ticks
    /// that are lost are counted in its timing.
    ///
    /// # Errors
    /// [`Error`] if the file cannot be created, or there is no thread.
    pub fn of(watch: &mut Watch, path: Option<&Path>) -> Result<Option<Self>, Error> {
        let Some(path) = path else { return Ok(None) };
        let line = |told: &TickTold| Some(row(&told.report, told.late_ns as f64 * 1e-9));
        let (spool, port) = Spool::begin("telemetry", path, COLUMNS, WAITING, line)?;
        watch.telemetry = Some(port);
        let timing = watch.timing.clone();
        Ok(Some(Telemetry { path: path.to_path_buf(), timing, spool }))
    }

    /// Writes what still waits and gives the file its name.
    ///
    /// # Errors
    /// [`Error`] if not everything could be written; what could be is in the file `….part`.
    pub fn finish(self) -> Result<Written, Error> {
        let rows = self.spool.finish()?;
        Ok(Written { path: self.path, rows, lost: self.timing.lost_rows() })
    }
}
