//! The library's scheduler turns the servo: it calls us, once per tick, on a thread of its own.

#![allow(unsafe_code)]

use super::NoOpenHaptics;
use super::faults::short;
use super::hd::{CALLBACK_CONTINUE, CALLBACK_DONE, Task, capability};
use super::session::Session;
use crate::haptic::rights::{Obtained, Refusal};
use crate::haptic::thread::NoServo;
use crate::haptic::turns::{Call, Called, Scheduler, Turns};
use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How long the first call may be awaited, and the last.
const FIRST_CALL: Duration = Duration::from_secs(2);
const LAST_CALL: Duration = Duration::from_millis(500);
/// Between two looks whether it came.
const LOOK: Duration = Duration::from_millis(1);
/// A scheduler that is silent for so long is broken [ns].
const SILENT_NS: u64 = 1_000_000_000;

/// An open device, ready to be pushed.
pub struct Ready {
    pub session: Arc<Session>,
    pub closed: Arc<AtomicBool>,
}

impl Scheduler for Ready {
    fn start(self: Box<Self>, called: Called) -> Result<Box<dyn Turns>, NoServo> {
        let running = self.run(called).map_err(super::super::NoDevice::from)?;
        Ok(Box::new(running))
    }
}

impl Ready {
    fn run(self, called: Called) -> Result<Running, NoOpenHaptics> {
        let Ready { session, closed } = self;
        let refused = |what: &'static str, code: u32| NoOpenHaptics::NotStarted {
            library: session.library(),
            what,
            reason: short(code),
        };
        session.calibrate()?;
        let hd = session.current();
        hd.error();
        hd.switch(capability::FORCE_OUTPUT, true);
        if let Some(code) = hd.error() {
            return Err(refused("force output", code));
        }
        // The servo ramps and clamps by itself: these two are a second guard.
        for (guard, name) in [
            (capability::FORCE_RAMPING, "force ramping"),
            (capability::MAX_FORCE_CLAMPING, "force clamping"),
        ] {
            hd.switch(guard, true);
            if let Some(code) = hd.error() {
                tracing::warn!("{} has no {name}: {}", session.library(), short(code));
            }
        }
        let call = called.call().clone();
        let called = Box::into_raw(Box::new(called));
        // SAFETY: the pointer stays good until `Running` has stopped the scheduler.
        let task = unsafe { hd.schedule(tick, called.cast()) };
        let running = Running { session: session.clone(), closed, call, called, task };
        if let Some(code) = hd.error() {
            return Err(refused("a callback", code));
        }
        hd.start_scheduler();
        if let Some(code) = hd.error() {
            return Err(refused("the scheduler", code));
        }
        if !wait(FIRST_CALL, || running.call.has_begun()) {
            return Err(NoOpenHaptics::Silent { library: session.library() });
        }
        Ok(running)
    }
}

/// Waits until something is so; false if it does not come to pass.
fn wait(at_most: Duration, is_so: impl Fn() -> bool) -> bool {
    let end = Instant::now() + at_most;
    while !is_so() {
        if Instant::now() > end {
            return false;
        }
        std::thread::sleep(LOOK);
    }
    true
}

/// The library's callback. It does not unwind: [`Called::turn`] does not.
unsafe extern "system" fn tick(called: *mut c_void) -> u32 {
    // SAFETY: it is what was scheduled, and only this callback uses it until the scheduler stops.
    let called = unsafe { &mut *called.cast::<Called>() };
    if called.turn() { CALLBACK_CONTINUE } else { CALLBACK_DONE }
}

/// A scheduler that calls. Dropping it takes the force away, and ends the calls.
struct Running {
    session: Arc<Session>,
    closed: Arc<AtomicBool>,
    call: Arc<Call>,
    called: *mut Called,
    task: Task,
}

// SAFETY: the pointer is touched by the scheduler's thread alone until it has stopped, and then by
// whoever drops this.
unsafe impl Send for Running {}
// SAFETY: a shared reference does not lead to what the pointer points at.
unsafe impl Sync for Running {}

impl Turns for Running {
    fn obtained(&self) -> &Obtained {
        &Obtained::VENDORS
    }

    fn is_running(&self) -> bool {
        !self.call.has_ended() && self.call.silent_ns() < SILENT_NS
    }

    fn why(&self) -> Option<String> {
        let is_silent = self.call.silent_ns() >= SILENT_NS;
        is_silent.then(|| {
            let library = self.session.library();
            format!("the scheduler of {library} has ceased to call: switch the device off")
        })
    }

    fn refusal(&self) -> Option<&Refusal> {
        self.session.rate_refused.as_ref()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // The last call takes the force away, within the loop, where forces are set.
        self.call.stop();
        let has_ended = wait(LAST_CALL, || self.call.has_ended());
        let hd = self.session.current();
        hd.switch(capability::FORCE_OUTPUT, false);
        hd.stop_scheduler();
        hd.unschedule(self.task);
        hd.error();
        self.closed.store(true, Ordering::Release);
        if has_ended || !self.call.is_inside() {
            // SAFETY: it came from a box, and nobody calls any more.
            drop(unsafe { Box::from_raw(self.called) });
        } else {
            // It hangs in the library, which may still come back to it.
            tracing::error!("{} does not end its callback", self.session.library());
        }
    }
}
