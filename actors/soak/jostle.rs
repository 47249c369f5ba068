//! Makes the scheduler's life hard: actors and threads are held up for moments, at random, and the
//! priorities of the game's threads change.

use crate::crew::{Fault, Roster};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long somebody is held up at most [µs].
const HELD_MAX_US: u64 = 300;
/// How long a thread that only burns time burns it at most [µs].
const BURN_MAX_US: u64 = 500;

/// Jostles until it is dropped.
pub struct Jostle {
    end: Arc<AtomicBool>,
    threads: Vec<JoinHandle<()>>,
}

impl Jostle {
    /// Begins; `seed` fixes what is tried, not when.
    pub fn begin(seed: u64, roster: Roster) -> Self {
        let end = Arc::new(AtomicBool::new(false));
        let hold = {
            let end = end.clone();
            std::thread::spawn(move || hold_up(seed, &roster, &end))
        };
        let burn = {
            let end = end.clone();
            std::thread::spawn(move || burn(seed, &end))
        };
        Jostle { end, threads: vec![hold, burn] }
    }
}

impl Drop for Jostle {
    fn drop(&mut self) {
        self.end.store(true, Ordering::Release);
        for thread in self.threads.drain(..) {
            // One that failed has jostled enough.
            let _ = thread.join();
        }
    }
}

fn hold_up(seed: u64, roster: &Roster, end: &AtomicBool) {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    while !end.load(Ordering::Acquire) {
        let names = roster.living();
        if !names.is_empty() {
            let name = names[random.random_range(0..names.len())];
            let time = Duration::from_micros(random.random_range(0..=HELD_MAX_US));
            let fault = match random.random_range(0..4) {
                0 => Fault::Stall(time),
                1 => Fault::Flood(random.random_range(1..=8)),
                _ => Fault::Delay(time),
            };
            roster.strike(name, fault);
        }
        reprioritise(&mut random);
        std::thread::sleep(Duration::from_micros(random.random_range(0..=HELD_MAX_US)));
    }
}

/// Takes the processor away from others for moments.
fn burn(seed: u64, end: &AtomicBool) {
    let mut random = Pcg64Mcg::seed_from_u64(!seed);
    while !end.load(Ordering::Acquire) {
        let time = Duration::from_micros(random.random_range(0..=BURN_MAX_US));
        let begin = Instant::now();
        while begin.elapsed() < time {
            std::hint::spin_loop();
        }
        std::thread::sleep(time);
    }
}

/// Gives one of the program's threads another priority, where that is allowed.
#[cfg(target_os = "linux")]
fn reprioritise(random: &mut impl Rng) {
    use rustix::process::{Pid, setpriority_process};
    let threads = crate::files::names_in(std::path::Path::new("/proc/self/task"));
    if threads.is_empty() {
        return;
    }
    let thread = threads[random.random_range(0..threads.len())].parse().ok();
    if let Some(thread) = thread.and_then(Pid::from_raw) {
        // It may have ended since; and who may not be raised again stays where it is.
        let _ = setpriority_process(Some(thread), random.random_range(0..20));
    }
}

#[cfg(not(target_os = "linux"))]
fn reprioritise(_: &mut impl Rng) {}
