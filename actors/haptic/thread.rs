//! The servo's thread: turns the [`Body`] at the device's rate, on absolute deadlines.

use super::body::Body;
use super::clock::{Deadlines, now_ns, wait_until};
use super::ports::Signs;
use super::rights::{Asked, Obtained, obtain, release};
use super::turns::Turns;
use crate::cpu_time::thread_cpu_time;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

/// A servo that cannot run.
#[derive(Debug, thiserror::Error)]
pub enum NoServo {
    /// The operating system gives no thread.
    #[error("the haptic servo gets no thread: {0}; end other programs")]
    NoThread(std::io::Error),
    /// It ended before it began.
    #[error("the haptic servo ended at its start; report this as a defect")]
    Ended,
    /// Its device does not let it.
    #[error(transparent)]
    Device(#[from] super::NoDevice),
}

/// A running servo. When it is dropped the thread ends, and leaves the device without force.
pub struct ServoThread {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    obtained: Obtained,
    signs: Arc<Signs>,
}

impl ServoThread {
    /// Starts the thread, and waits until it has its rights or knows that it does not get them.
    ///
    /// # Errors
    /// [`NoServo`] if there is no thread. Refused rights are no error: see
    /// [`Turns::obtained`].
    pub fn start(body: Body, asked: Asked) -> Result<Self, NoServo> {
        let stop = Arc::new(AtomicBool::new(false));
        let signs = body.ports().signs.clone();
        let (tell, told) = flume::bounded(1);
        let thread = {
            let stop = stop.clone();
            let run = move || {
                let obtained = obtain(&asked);
                let is_awaited = tell.send(obtained).is_ok();
                drop(tell);
                if is_awaited {
                    turn(body, &stop, asked.spin_us);
                }
                release();
            };
            let builder = std::thread::Builder::new().name("servo".to_string());
            builder.spawn(run).map_err(NoServo::NoThread)?
        };
        let obtained = told.recv().map_err(|_| NoServo::Ended)?;
        Ok(ServoThread { stop, thread: Some(thread), obtained, signs })
    }
}

impl Turns for ServoThread {
    fn obtained(&self) -> &Obtained {
        &self.obtained
    }

    fn is_running(&self) -> bool {
        self.thread.as_ref().is_some_and(|thread| !thread.is_finished())
    }
}

impl Drop for ServoThread {
    fn drop(&mut self) {
        self.signs.hold(false);
        self.stop.store(true, Ordering::Release);
        if let Some(thread) = self.thread.take()
            && thread.join().is_err()
        {
            tracing::error!(
                "the haptic servo ended by a defect; the device was left without force"
            );
        }
    }
}

/// Turns the body until somebody stops it.
fn turn(mut body: Body, stop: &AtomicBool, spin_us: u32) {
    let timing = body.ports().timing.clone();
    let period_ns = (body.period_s() * 1e9) as u64;
    let spin_ns = u64::from(spin_us) * 1000;
    let mut last_ns = now_ns();
    let mut deadlines = Deadlines::from(last_ns, period_ns);
    while !stop.load(Ordering::Acquire) {
        let woke_ns = wait_until(deadlines.due_ns(), spin_ns);
        let late_ns = woke_ns.saturating_sub(deadlines.due_ns());
        let dt = woke_ns.saturating_sub(last_ns) as f64 * 1e-9;
        last_ns = woke_ns;
        let before = thread_cpu_time();
        body.begin_late(late_ns);
        body.turn(dt);
        let work = thread_cpu_time().saturating_sub(before);
        timing.note(late_ns, work, deadlines.go_on(now_ns()));
    }
}
