//! The clock of the servo's thread: nanoseconds that only rise, and sleep until one of them.

#[cfg(target_os = "linux")]
mod precise {
    use rustix::thread::clock_nanosleep_absolute;
    use rustix::time::{ClockId, Timespec, clock_gettime};

    const SECOND_NS: u64 = 1_000_000_000;

    /// Nanoseconds since some fixed time.
    pub fn now_ns() -> u64 {
        let time = clock_gettime(ClockId::Monotonic);
        // Neither is negative on this clock.
        time.tv_sec.unsigned_abs() * SECOND_NS + time.tv_nsec.unsigned_abs()
    }

    /// Sleeps until [`now_ns`] says so. A signal may end the sleep early: the caller looks again.
    pub fn sleep_until_ns(due_ns: u64) {
        let seconds = i64::try_from(due_ns / SECOND_NS).unwrap_or(i64::MAX);
        let due = Timespec { tv_sec: seconds, tv_nsec: (due_ns % SECOND_NS) as i64 };
        let _ = clock_nanosleep_absolute(ClockId::Monotonic, &due);
    }
}

#[cfg(not(target_os = "linux"))]
mod precise {
    use std::sync::OnceLock;
    use std::time::{Duration, Instant};

    fn start() -> Instant {
        static START: OnceLock<Instant> = OnceLock::new();
        *START.get_or_init(Instant::now)
    }

    /// Nanoseconds since the first call.
    pub fn now_ns() -> u64 {
        u64::try_from(start().elapsed().as_nanos()).unwrap_or(u64::MAX)
    }

    /// Sleeps until [`now_ns`] says so, as well as relative sleep can.
    pub fn sleep_until_ns(due_ns: u64) {
        std::thread::sleep(Duration::from_nanos(due_ns.saturating_sub(now_ns())));
    }
}

pub use precise::{now_ns, sleep_until_ns};

/// Deadlines at a fixed distance. Who comes late goes on with the next one that is still ahead:
/// there are no bursts of ticks that catch up, forces would jump.
#[derive(Debug, Clone)]
pub struct Deadlines {
    period_ns: u64,
    due_ns: u64,
}

impl Deadlines {
    /// The first one is a period after `now_ns`.
    pub fn from(now_ns: u64, period_ns: u64) -> Self {
        let period_ns = period_ns.max(1);
        Deadlines { period_ns, due_ns: now_ns + period_ns }
    }

    /// The next deadline.
    pub fn due_ns(&self) -> u64 {
        self.due_ns
    }

    /// Goes on to the next deadline after `now_ns`; returns how many were missed on the way.
    pub fn go_on(&mut self, now_ns: u64) -> u64 {
        self.due_ns += self.period_ns;
        let missed = match now_ns.checked_sub(self.due_ns) {
            Some(over) => over / self.period_ns + 1,
            None => 0,
        };
        self.due_ns += missed * self.period_ns;
        missed
    }
}

/// Waits until `due_ns`: asleep until `spin_ns` before it, then awake. Returns the time.
pub fn wait_until(due_ns: u64, spin_ns: u64) -> u64 {
    loop {
        let now = now_ns();
        if now >= due_ns {
            return now;
        }
        if now + spin_ns < due_ns {
            sleep_until_ns(due_ns - spin_ns);
        } else {
            std::hint::spin_loop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_comes_late_skips_whole_periods() {
        let mut deadlines = Deadlines::from(0, 1000);
        assert_eq!(deadlines.due_ns(), 1000);
        assert_eq!(deadlines.go_on(1200), 0);
        assert_eq!(deadlines.due_ns(), 2000);
        // Done exactly when the next one is due: that one is gone.
        assert_eq!(deadlines.go_on(3000), 1);
        assert_eq!(deadlines.due_ns(), 4000);
        assert_eq!(deadlines.go_on(9999), 5);
        assert_eq!(deadlines.due_ns(), 10_000);
    }

    #[test]
    fn waiting_ends_after_the_deadline_and_not_before() {
        for spin_ns in [0, 50_000, 10_000_000] {
            let due = now_ns() + 2_000_000;
            assert!(wait_until(due, spin_ns) >= due);
        }
        assert!(wait_until(0, 0) > 0);
    }
}
