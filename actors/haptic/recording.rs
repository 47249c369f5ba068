//! Recordings of devices as files.
//!
//! What a device says goes into a ring, and a thread of its own writes it down. The servo never
//! touches the file. A full ring loses readings, which are counted; the time that they took is
//! kept. The file has its name only when it is whole; what a crash leaves behind is named `….part`,
//! and holds all but the last hundredth of a second.

use super::device::{NoDevice, Opened};
use crate::error::Error;
use crate::files::{LineWriter, open_lines};
use hapticbillard::haptic::{
    Device, DeviceRecording, DeviceSpec, DeviceState, Force, READINGS_MAX, Reading,
    RecordingReader, RecordingWriter,
};
use hapticbillard::units::Seconds;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// Readings that wait at most, should the disk stall: a minute.
const WAITING: usize = 1 << 16;
/// How long the writer sleeps.
const SLEEP: Duration = Duration::from_millis(10);

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
    pub readings: usize,
    /// Readings that found the ring full, or came after the longest recording.
    pub lost: u64,
}

/// A recording that grows.
#[must_use = "finish it, or it may not get its name"]
pub struct DeviceRecorder {
    shared: Arc<Shared>,
    thread: JoinHandle<Result<usize, Error>>,
}

#[derive(Default)]
struct Shared {
    is_over: AtomicBool,
    lost: AtomicU64,
}

impl DeviceRecorder {
    /// Records what `opened` says from now on.
    ///
    /// # Errors
    /// [`Error::Write`] if the file cannot be created.
    pub fn tap(opened: Opened, path: PathBuf) -> Result<(Opened, DeviceRecorder), Error> {
        let mut file = LineWriter::create(path.clone())?;
        file.line(&RecordingWriter::head(&opened.device.spec()))?;
        let (ring, readings) = rtrb::RingBuffer::new(WAITING);
        let shared = Arc::<Shared>::default();
        let writer = Writer { file, readings, lines: RecordingWriter::default(), written: 0 };
        let thread = {
            let shared = shared.clone();
            let builder = std::thread::Builder::new().name("device recorder".to_string());
            builder
                .spawn(move || writer.run(&shared))
                .map_err(|reason| Error::Write { path, reason })?
        };
        let device = Tap { device: opened.device, ring, behind_s: 0.0, shared: shared.clone() };
        let opened = Opened { device: Box::new(device), ..opened };
        Ok((opened, DeviceRecorder { shared, thread }))
    }

    /// Writes what is left, and gives the file its name.
    ///
    /// # Errors
    /// [`Error::Write`] if it could not be written whole.
    pub fn finish(self) -> Result<Recorded, Error> {
        self.shared.is_over.store(true, Ordering::Release);
        let written = self.thread.join().unwrap_or_else(|_| {
            Err(Error::input("the recording", "its thread ended", "report this as a defect"))
        });
        Ok(Recorded { readings: written?, lost: self.shared.lost.load(Ordering::Acquire) })
    }
}

struct Writer {
    file: LineWriter,
    readings: rtrb::Consumer<Reading>,
    lines: RecordingWriter,
    written: usize,
}

impl Writer {
    fn run(mut self, shared: &Shared) -> Result<usize, Error> {
        loop {
            // Looked at first: what comes before it is still written.
            let is_over = shared.is_over.load(Ordering::Acquire) || self.readings.is_abandoned();
            while let Ok(reading) = self.readings.pop() {
                if self.written < READINGS_MAX {
                    self.file.line(&self.lines.line(&reading))?;
                    self.written += 1;
                } else {
                    shared.lost.fetch_add(1, Ordering::Relaxed);
                }
            }
            if is_over {
                self.file.finish()?;
                return Ok(self.written);
            }
            std::thread::sleep(SLEEP);
        }
    }
}

/// A device that is listened in to.
struct Tap {
    device: Box<dyn Device>,
    ring: rtrb::Producer<Reading>,
    /// Time of readings that were lost [s].
    behind_s: Seconds,
    shared: Arc<Shared>,
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
            self.shared.lost.fetch_add(1, Ordering::Relaxed);
        }
        state
    }

    fn write(&mut self, force: Force) {
        self.device.write(force);
    }
}
