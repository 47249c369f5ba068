//! The driver of gamepads: a thread that waits for what they say.
//!
//! It keeps every press and release in order and of sticks and triggers only the newest, until a
//! window looks ([`PadQueue`]); it never waits for the window. What it drives is a [`PadSource`]:
//! the gamepads of this machine, or a script in their place.

use hapticbillard::input::{PadInput, PadQueue, Rumble};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// So long the thread waits for a report before it looks whether it shall shake or end.
const PATIENCE: Duration = Duration::from_millis(20);
/// Shakes that may wait; those that do not fit are of contacts that nobody tells apart.
const SHAKES: usize = 64;

/// Gamepads, or what stands in their place.
pub trait PadSource {
    /// The next report; none if there was none within this time.
    fn next(&mut self, patience: Duration) -> Option<PadInput>;

    /// Shakes whoever holds one.
    fn shake(&mut self, rumble: Rumble);
}

/// Why there are no gamepads.
#[derive(Debug, thiserror::Error)]
pub enum PadError {
    /// The system gives no thread.
    #[error("no thread for gamepads: {0}")]
    Thread(std::io::Error),
}

/// The thread, and the window's ends of it. Whoever lets go of it ends it.
pub struct PadDriver {
    queue: Arc<Mutex<PadQueue>>,
    shakes: flume::Sender<Rumble>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl PadDriver {
    /// Starts the thread, which opens its source itself: some systems bind it to the thread.
    ///
    /// # Errors
    /// [`PadError`].
    pub fn start<S: PadSource>(
        open: impl FnOnce() -> Result<S, String> + Send + 'static,
    ) -> Result<Self, PadError> {
        let queue = Arc::new(Mutex::new(PadQueue::default()));
        let stop = Arc::new(AtomicBool::new(false));
        let (shakes, shaken) = flume::bounded(SHAKES);
        let (said, stopped) = (queue.clone(), stop.clone());
        let drive = move || match open() {
            Ok(mut source) => drive(&mut source, &said, &shaken, &stopped),
            Err(problem) => tracing::warn!("there are no gamepads: {problem}"),
        };
        let thread = thread::Builder::new().name("gamepads".into()).spawn(drive);
        let thread = Some(thread.map_err(PadError::Thread)?);
        Ok(PadDriver { queue, shakes, stop, thread })
    }

    /// What was said since this was asked last.
    pub fn take(&self) -> Vec<PadInput> {
        locked(&self.queue).take()
    }

    /// Shakes; softer ones than others that wait are not felt.
    pub fn shake(&self, rumble: Rumble) {
        // A full channel shakes enough.
        let _ = self.shakes.try_send(rumble);
    }
}

impl Drop for PadDriver {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if self.thread.take().is_some_and(|thread| thread.join().is_err()) {
            tracing::warn!("the thread for gamepads has failed");
        }
    }
}

fn drive(
    source: &mut dyn PadSource,
    queue: &Mutex<PadQueue>,
    shakes: &flume::Receiver<Rumble>,
    stop: &AtomicBool,
) {
    while !stop.load(Ordering::Relaxed) {
        if let Some(report) = source.next(PATIENCE) {
            locked(queue).say(report);
        }
        let hardest = shakes.try_iter().max_by(|a, b| a.strength.total_cmp(&b.strength));
        if let Some(rumble) = hardest {
            source.shake(rumble);
        }
    }
}

/// A queue is whole between its calls, whoever has failed meanwhile.
fn locked(queue: &Mutex<PadQueue>) -> MutexGuard<'_, PadQueue> {
    queue.lock().unwrap_or_else(PoisonError::into_inner)
}
