//! What this process uses, and whether it grows from game to game.

use crate::files;
use serde::Serialize;
use std::path::Path;
use std::time::{Duration, Instant};

/// What a process uses at a moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Use {
    /// Memory that is resident [KiB].
    pub memory_kib: u64,
    /// Threads.
    pub threads: usize,
    /// Open files, sockets and the like.
    pub handles: usize,
}

impl Use {
    /// What this process uses now; none where the system does not tell.
    pub fn now() -> Option<Self> {
        let memory_kib = files::resident_memory_kib("/proc/self/status")?;
        let count = |folder| files::list(Path::new(folder)).ok().map(|names| names.len());
        let threads = count("/proc/self/task")?;
        // Reading the folder is one handle more.
        let handles = count("/proc/self/fd")?.saturating_sub(1);
        Some(Use { memory_kib, threads, handles })
    }
}

/// How long threads may take to end that have nothing more to do.
const SETTLES: Duration = Duration::from_secs(2);

impl Use {
    /// What this process uses when it has no more than `least` threads, or, if it keeps more, after
    /// a while.
    pub fn settled(least: usize) -> Option<Self> {
        let begin = Instant::now();
        loop {
            let now = Self::now()?;
            if now.threads <= least || SETTLES <= begin.elapsed() {
                return Some(now);
            }
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

/// Moments at least before anything is said about growth.
pub const MOMENTS_MIN: usize = 40;
/// How much memory may differ between early and late.
const MEMORY_SHARE: f64 = 0.05;
const MEMORY_KIB: f64 = 2048.0;

/// What was used early on and at the end, as means over a fifth of the moments each. The first
/// fifth is left out: what is made once and kept is made then.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Growth {
    /// Memory early and late [KiB].
    pub memory_kib: [f64; 2],
    /// Most threads early and late.
    pub threads: [usize; 2],
    /// Most handles early and late.
    pub handles: [usize; 2],
}

impl Growth {
    /// What became of it; none if there are too few moments.
    pub fn over(moments: &[Use]) -> Option<Self> {
        if moments.len() < MOMENTS_MIN {
            return None;
        }
        let fifth = moments.len() / 5;
        let parts = [&moments[fifth..2 * fifth], &moments[moments.len() - fifth..]];
        let mean = |part: &[Use]| {
            part.iter().map(|moment| moment.memory_kib as f64).sum::<f64>() / part.len() as f64
        };
        let most =
            |part: &[Use], of: fn(&Use) -> usize| part.iter().map(of).max().unwrap_or_default();
        Some(Growth {
            memory_kib: parts.map(mean),
            threads: parts.map(|part| most(part, |moment| moment.threads)),
            handles: parts.map(|part| most(part, |moment| moment.handles)),
        })
    }

    /// What has grown, in words; empty if nothing has.
    pub fn faults(&self) -> Vec<String> {
        let mut faults = Vec::new();
        let [early, late] = self.memory_kib;
        if early * (1.0 + MEMORY_SHARE) + MEMORY_KIB < late {
            faults.push(format!("memory grew from {early:.0} to {late:.0} KiB"));
        }
        for (what, [early, late]) in [("threads", self.threads), ("handles", self.handles)] {
            if early < late {
                faults.push(format!("there were {early} {what}, and later {late}"));
            }
        }
        faults
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(of: impl Fn(u64) -> Use) -> Vec<Use> {
        (0..100).map(of).collect()
    }

    const FLAT: Use = Use { memory_kib: 20_000, threads: 3, handles: 9 };

    #[test]
    fn what_is_made_once_is_no_growth_and_what_is_made_again_and_again_is() {
        let settles = moments(|n| Use { memory_kib: 30_000.min(10_000 + 2000 * n), ..FLAT });
        assert_eq!(Growth::over(&settles).unwrap().faults(), Vec::<String>::new());
        let leaks = moments(|n| Use { memory_kib: 20_000 + 100 * n, ..FLAT });
        assert!(Growth::over(&leaks).unwrap().faults()[0].starts_with("memory grew from 2"));
        let threads = moments(|n| Use { threads: 3 + n as usize / 40, ..FLAT });
        assert_eq!(Growth::over(&threads).unwrap().faults(), ["there were 3 threads, and later 5"]);
        assert!(Growth::over(&settles[..10]).is_none());
    }

    #[test]
    fn a_process_knows_what_it_uses() {
        if cfg!(target_os = "linux") {
            let now = Use::now().unwrap();
            assert!(now.memory_kib > 500 && now.threads >= 1 && now.handles >= 3, "{now:?}");
        }
    }
}
