//! The thread of a game beside its window, which does not outlive the window.

use crate::conductor::RunError;
use hapticbillard::input::HandInput;
use hapticbillard::tick::Finished;
use std::panic::{self, AssertUnwindSafe};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How long a game may take to end that nobody waits for any more.
const PATIENCE: Duration = Duration::from_secs(10);

/// A game on a thread of its own. Whoever lets go of it, and be it in a panic, ends the game in
/// order: its recording is whole, and no force is left.
pub struct GameThread {
    /// None when it was joined.
    thread: Option<JoinHandle<thread::Result<Result<Finished, RunError>>>>,
    says: flume::Sender<HandInput>,
}

impl GameThread {
    /// Begins; `ended` is called on the thread when the game is over. What is said to the game goes
    /// over `says`.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn begin(
        play: impl FnOnce() -> Result<Finished, RunError> + Send + 'static,
        ended: impl FnOnce() + Send + 'static,
        says: flume::Sender<HandInput>,
    ) -> Result<Self, RunError> {
        let thread = thread::Builder::new().name("game".into()).spawn(move || {
            let finished = panic::catch_unwind(AssertUnwindSafe(play));
            ended();
            finished
        });
        let thread =
            thread.map_err(|error| RunError::Start(format!("no thread for the game: {error}")))?;
        Ok(GameThread { thread: Some(thread), says })
    }

    /// Waits for the end of the game. A panic of its thread goes on here; none if it was joined
    /// before.
    pub fn join(&mut self) -> Option<Result<Finished, RunError>> {
        match self.thread.take()?.join() {
            Ok(Ok(finished)) => Some(finished),
            Ok(Err(payload)) | Err(payload) => panic::resume_unwind(payload),
        }
    }
}

impl Drop for GameThread {
    fn drop(&mut self) {
        let Some(thread) = self.thread.take() else { return };
        let begin = Instant::now();
        while !thread.is_finished() && begin.elapsed() < PATIENCE {
            // A full channel is emptied every tick, so that there is room the next time.
            let _ = self.says.try_send(HandInput::Closed);
            thread::sleep(Duration::from_millis(5));
        }
        if thread.is_finished() {
            // How it ended nobody wants to know any more.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::tick::End;
    use hapticbillard::units::Tick;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};

    #[test]
    fn a_window_that_panics_ends_its_game_in_order() {
        let (says, hears) = flume::bounded(2);
        // The channel is full of older reports.
        while says.try_send(HandInput::FocusLost).is_ok() {}
        let has_ended = Arc::new(AtomicBool::new(false));
        let told = has_ended.clone();
        let play = move || {
            thread::sleep(Duration::from_millis(20));
            while hears.recv() != Ok(HandInput::Closed) {}
            Ok(Finished { end: End::Quit, tick: Tick(1), hash: None, verified: 0 })
        };
        let tell = move || told.store(true, Ordering::SeqCst);
        let window = panic::catch_unwind(AssertUnwindSafe(|| {
            let _game = GameThread::begin(play, tell, says).unwrap();
            panic::resume_unwind(Box::new("the window is made to fail here"));
        }));
        assert!(window.is_err() && has_ended.load(Ordering::SeqCst));
    }
}
