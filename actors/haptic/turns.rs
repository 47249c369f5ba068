//! Who turns a [`Body`]: a thread of ours, or the scheduler of a vendor's library, whose callback
//! calls [`Called::turn`] and so the very same turn.

use super::body::Body;
use super::clock::now_ns;
use super::rights::{Obtained, Refusal};
use super::thread::NoServo;
use super::timing::Timing;
use crate::cpu_time::thread_cpu_time;
use hapticbillard::units::Seconds;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A body that turns. Dropping it ends that, and leaves the device without force.
pub trait Turns: Send + Sync {
    /// What it got of the operating system.
    fn obtained(&self) -> &Obtained;

    /// Whether it turns. It ends by itself only if something is broken.
    fn is_running(&self) -> bool;

    /// Why it does not, where it knows.
    fn why(&self) -> Option<String> {
        None
    }

    /// What its device refused.
    fn refusal(&self) -> Option<&Refusal> {
        None
    }
}

/// A vendor's scheduler that stands ready.
pub trait Scheduler: Send {
    /// From now on it calls [`Called::turn`] at the device's rate.
    ///
    /// # Errors
    /// [`NoServo`] if it does not start.
    fn start(self: Box<Self>, called: Called) -> Result<Box<dyn Turns>, NoServo>;
}

/// Knows why a device is not ready. Asked outside of the servo's loop.
pub trait Explain: Send + Sync {
    /// Why, and what to do; none if nothing is wrong.
    fn why(&self) -> Option<String>;

    /// How much later its forces act than its specification says [s]: a part of the servo's
    /// lateness.
    fn late_s(&self) -> Seconds {
        0.0
    }
}

/// A body that somebody else's clock turns.
///
/// [`Called::turn`] never unwinds: a panic inside leaves the device without force and ends it.
/// Otherwise it allocates nothing, takes no lock, logs nothing and does not wait.
pub struct Called {
    body: Body,
    timing: Arc<Timing>,
    call: Arc<Call>,
    period_ns: u64,
}

/// What caller and control know of each other.
#[derive(Debug, Default)]
pub struct Call {
    stop: AtomicBool,
    ended: AtomicBool,
    inside: AtomicBool,
    /// When it was last called; 0: never.
    last_ns: AtomicU64,
}

impl Call {
    /// The next turn is the last one: it takes the force away.
    pub fn stop(&self) {
        self.stop.store(true, Ordering::Release);
    }

    /// Whether the last turn is over.
    pub fn has_ended(&self) -> bool {
        self.ended.load(Ordering::Acquire)
    }

    /// Whether a turn has begun and is not over.
    pub fn is_inside(&self) -> bool {
        self.inside.load(Ordering::Acquire)
    }

    /// Whether it was called at all.
    pub fn has_begun(&self) -> bool {
        self.last_ns.load(Ordering::Acquire) != 0
    }

    /// How long nobody has called, since the first time [ns].
    pub fn silent_ns(&self) -> u64 {
        match self.last_ns.load(Ordering::Acquire) {
            0 => 0,
            last_ns => now_ns().saturating_sub(last_ns),
        }
    }
}

impl Called {
    /// Nobody has called it yet.
    pub fn new(body: Body) -> Self {
        let timing = body.ports().timing.clone();
        let period_ns = (body.period_s() * 1e9) as u64;
        Called { body, timing, call: Arc::default(), period_ns: period_ns.max(1) }
    }

    /// The other end.
    pub fn call(&self) -> &Arc<Call> {
        &self.call
    }

    /// One turn, now. False: it was the last one, and the device is without force.
    pub fn turn(&mut self) -> bool {
        self.call.inside.store(true, Ordering::Release);
        let goes_on = !self.call.has_ended() && self.timed();
        self.call.inside.store(false, Ordering::Release);
        goes_on
    }

    fn timed(&mut self) -> bool {
        let woke_ns = now_ns();
        let taken_ns = match self.call.last_ns.swap(woke_ns, Ordering::AcqRel) {
            0 => self.period_ns,
            last_ns => woke_ns.saturating_sub(last_ns),
        };
        let is_over = self.call.stop.load(Ordering::Acquire);
        let before = thread_cpu_time();
        let turn = || {
            self.body.turn(taken_ns as f64 * 1e-9);
        };
        if is_over || catch_unwind(AssertUnwindSafe(turn)).is_err() {
            // If that panics too there is nothing left to try.
            let _ = catch_unwind(AssertUnwindSafe(|| self.body.let_go()));
            self.call.ended.store(true, Ordering::Release);
            return false;
        }
        // It is due a period after the last time, and so is every further one.
        let late_ns = taken_ns.saturating_sub(self.period_ns);
        let work = thread_cpu_time().saturating_sub(before);
        self.timing.note(late_ns, work, (late_ns + self.period_ns / 2) / self.period_ns);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haptic::{AllPorts, Orders};
    use hapticbillard::haptic::{
        Device, DeviceSpec, DeviceState, EffectSet, Force, Servo, ServoSettings,
    };
    use std::sync::Mutex;

    /// A device that panics at some reading, and tells what it is pushed with.
    struct Brittle {
        readings_left: u32,
        forces: Arc<Mutex<Vec<Force>>>,
    }

    impl Device for Brittle {
        fn spec(&self) -> DeviceSpec {
            DeviceSpec::OMNI
        }

        fn read(&mut self, _: f64) -> DeviceState {
            if self.readings_left == 0 {
                // A panic that nobody prints.
                std::panic::resume_unwind(Box::new("it breaks"));
            }
            self.readings_left -= 1;
            DeviceState::default()
        }

        fn write(&mut self, force: Force) {
            self.forces.lock().unwrap().push(force);
        }
    }

    fn called(readings_left: u32) -> (Called, Arc<Mutex<Vec<Force>>>) {
        let orders =
            Orders { effects: EffectSet::default(), reach: None, stiffness_max_n_m: 500.0 };
        let forces = Arc::new(Mutex::new(Vec::new()));
        let device = Brittle { readings_left, forces: forces.clone() };
        let servo = Servo::new(ServoSettings::of(&DeviceSpec::OMNI));
        let ports = AllPorts::new(orders, Vec::new()).servo;
        (Called::new(Body::new(Box::new(device), servo, ports)), forces)
    }

    #[test]
    fn a_panic_ends_it_without_unwinding_and_without_force() {
        let (mut called, forces) = called(2);
        assert!(called.turn() && called.turn());
        assert!(!called.turn(), "it goes on");
        assert!(called.call().has_ended());
        assert_eq!(*forces.lock().unwrap(), [Force::ZERO; 3]);
        assert!(!called.turn());
        assert_eq!(forces.lock().unwrap().len(), 3, "it pushes after its end");
        assert_eq!(called.timing.ticks(), 2);
    }

    #[test]
    fn who_is_stopped_takes_the_force_away_in_its_last_turn() {
        let (mut called, forces) = called(10);
        let call = called.call().clone();
        assert_eq!(call.silent_ns(), 0);
        assert!(called.turn());
        call.stop();
        assert!(!call.has_ended(), "nobody called");
        assert!(!called.turn());
        assert!(call.has_ended());
        assert_eq!(forces.lock().unwrap().len(), 2);
    }

    #[test]
    fn who_is_called_late_counts_what_was_missed() {
        let (mut called, _) = called(10);
        assert!(called.turn());
        called.call.last_ns.fetch_sub(10_000_000, Ordering::AcqRel);
        assert!(called.turn());
        assert!(called.timing.missed() >= 9 && called.timing.late() == 1);
        assert!(called.timing.lateness.most() >= 9_000_000);
    }
}
