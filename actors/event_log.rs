//! The event log: one more subscriber. It writes every event as a line of JSON, in stamp order.

use crate::files::LineWriter;
use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use tracing::error;

/// Writes events into a file. When the disk refuses it says so once and the game goes on.
pub struct EventLog(Option<LineWriter>);

impl EventLog {
    /// A log in this file.
    pub fn new(file: LineWriter) -> Self {
        EventLog(Some(file))
    }
}

impl Participant for EventLog {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        for stamped in delivered.events.iter() {
            let Some(file) = &mut self.0 else {
                break;
            };
            // Plain data with string keys: serialising it cannot fail.
            let line = serde_json::to_string(stamped).unwrap_or_default();
            if let Err(error) = file.line(&line) {
                error!("the event log ends here: {error}");
                self.0 = None;
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

impl Drop for EventLog {
    fn drop(&mut self) {
        if let Some(Err(error)) = self.0.take().map(LineWriter::finish) {
            error!("{error}");
        }
    }
}
