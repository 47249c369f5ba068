//! Recordings of devices as files.
//!
//! A full ring loses readings, which are counted; the time that they took is kept.

use super::device::{NoDevice, Opened};
use super::spool::Spool;
use crate::error::Error;
use crate::files::open_lines;
use hapticbillard::haptic::{
    Device, DeviceRecording, DeviceSpec, DeviceState, Force, READINGS_MAX, Reading,
    RecordingReader, RecordingWriter,
};
use hapticbillard::units::Seconds;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Readings that wait at most, should the disk stall: a minute.
const WAITING: usize = 1 << 16;

/// So much of a line is read [bytes]; longer ones are refused.
const LINE_BYTES: u64 = 8192;

/// Reads a recording.
///
/// # Errors
/// [`NoDevice::Recording`], with the line that is wrong.
pub fn load(path: &Path) -> Result<DeviceRecording, NoDevice> {
    let wrong = |problem: String| NoDevice::Recording { path: path.to_path_buf(), problem };
    let file = open_lines(path).map_err(|error| wrong(error.to_string()))?;
    let (mut file, mut reader) = (BufReader::new(file), RecordingReader::default());
    let mut line = String::new();
    loop {
        line.clear();
        let read = (&mut file).take(LINE_BYTES).read_line(&mut line);
        if read.map_err(|error| wrong(error.to_string()))? == 0 {
            break;
        }
        reader.take(line.trim_end()).map_err(|error| wrong(error.to_string()))?;
    }
    reader.finish().map_err(|error| wrong(error.to_string()))
}

/// What was recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Recorded {
    /// Readings in the file.
    pub readings: u64,
    /// Readings that found the ring full, or came after the longest recording.
    pub lost: u64,
}

/// A recording that grows.
#[must_use = "finish it, or nobody hears whether it is whole"]
pub struct DeviceRecorder {
    lost: Arc<AtomicU64>,
    spool: Spool,
}

impl DeviceRecorder {
    /// Records what `opened` says from now on.
    ///
    /// # Errors
    /// [`Error::Write`] if the file cannot be created.
    pub fn tap(opened: Opened, path: PathBuf) -> Result<(Opened, DeviceRecorder), Error> {
        let head = RecordingWriter::head(&opened.device.spec());
        let lost = Arc::<AtomicU64>::default();
        let (mut lines, mut readings) = (RecordingWriter::default(), 0);
        let too_many = lost.clone();
        let line = move |reading: &Reading| {
            readings += 1;
            if readings > READINGS_MAX {
                too_many.fetch_add(1, Ordering::Relaxed);
                return None;
            }
            Some(lines.line(reading))
        };
        let (spool, ring) = Spool::begin("recording", &path, &head, WAITING, line)?;
        let device = Tap { device: opened.device, ring, behind_s: 0.0, lost: lost.clone() };
        let opened = Opened { device: Box::new(device), ..opened };
        Ok((opened, DeviceRecorder { lost, spool }))
    }

    /// Writes what is left, and gives the file its name.
    ///
    /// # Errors
    /// [`Error::Write`] if it could not be written whole.
    pub fn finish(self) -> Result<Recorded, Error> {
        let readings = self.spool.finish()?;
        Ok(Recorded { readings, lost: self.lost.load(Ordering::Acquire) })
    }
}

/// A device that is listened in to.
struct Tap {
    device: Box<dyn Device>,
    ring: rtrb::Producer<Reading>,
    /// Time of readings that were lost [s].
    behind_s: Seconds,
    lost: Arc<AtomicU64>,
}

impl Device for Tap {
    fn spec(&self) -> DeviceSpec {
        self.device.spec()
    }

    fn read(&mut self, dt: Seconds) -> DeviceState {
        let state = self.device.read(dt);
        if self.ring.push(Reading { dt: dt + self.behind_s, state }).is_ok() {
            self.behind_s = 0.0;
        } else {
            self.behind_s += dt;
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
        state
    }

    fn write(&mut self, force: Force) {
        self.device.write(force);
    }
}
