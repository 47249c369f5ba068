//! A gamepad in the hands of a script.

use hapticbillard::input::{PadInput, Rumble};
use hapticbillard_actors::input::{PadDriver, PadSource};
use std::time::Duration;

/// Whatever the driver has not taken after so long it does not take.
const AWAITED: Duration = Duration::from_secs(20);

/// The device's side.
struct MockPad {
    done: flume::Receiver<PadInput>,
    /// Says that what was handed over is with the driver.
    taken: flume::Sender<()>,
    is_handed: bool,
    shaken: flume::Sender<Rumble>,
}

impl PadSource for MockPad {
    fn next(&mut self, patience: Duration) -> Option<PadInput> {
        // Whoever asks for the next report has put the last one where it belongs.
        if std::mem::take(&mut self.is_handed) {
            let _ = self.taken.send(());
        }
        let report = self.done.recv_timeout(patience).ok();
        self.is_handed = report.is_some();
        report
    }

    fn shake(&mut self, rumble: Rumble) {
        let _ = self.shaken.send(rumble);
    }
}

/// The script's side: the driver of the game in front of the device.
pub struct PadDesk {
    pub driver: PadDriver,
    /// What it shook.
    pub shaken: flume::Receiver<Rumble>,
    does: flume::Sender<PadInput>,
    taken: flume::Receiver<()>,
}

impl PadDesk {
    /// A gamepad that was just plugged in.
    pub fn new() -> Self {
        let (does, done) = flume::unbounded();
        let (says, taken) = flume::unbounded();
        let (shakes, shaken) = flume::unbounded();
        let open = move || Ok(MockPad { done, taken: says, is_handed: false, shaken: shakes });
        let driver = PadDriver::start(open).unwrap();
        PadDesk { driver, shaken, does, taken }
    }

    /// Does this, and waits until the driver has all of it.
    pub fn does(&self, done: &[PadInput]) {
        for report in done {
            self.does.send(*report).unwrap();
        }
        for report in done {
            let taken = self.taken.recv_timeout(AWAITED);
            assert!(taken.is_ok(), "the driver has not taken {report:?}");
        }
    }
}
