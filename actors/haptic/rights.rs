//! What the servo's thread asks of the operating system, and what it gets.
//!
//! Everything can be refused, and the servo runs on: later, so with less stiffness. A refusal says
//! what would help. The kernel is asked first; where it refuses a priority, the service
//! RealtimeKit, which grants lower ones to ordinary users.

use hapticbillard::scene::HapticSection;
use serde::Serialize;
use std::fmt;

/// The priority where a scene names none: above everything but the kernel's own threads.
const PRIORITY: u8 = 80;
/// How long before a deadline the thread is awake, where a scene does not say [µs].
const SPIN_US: u32 = 100;
/// It sleeps for the rest of a period at least: a real-time thread that never pauses is held up by
/// the kernel, and killed under the limits of RealtimeKit [µs].
pub const SPIN_MAX_US: u32 = 500;

/// Which processor core to stay on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Core {
    /// None.
    Any,
    /// The last one that the program may use.
    Last,
    /// This one.
    Number(u32),
}

impl fmt::Display for Core {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Core::Any => f.write_str("any core"),
            Core::Last => f.write_str("the last core"),
            Core::Number(core) => write!(f, "core {core}"),
        }
    }
}

/// What is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Asked {
    /// The core to stay on.
    pub core: Core,
    /// The priority among real-time threads, first in first out.
    pub priority: Option<u8>,
    /// Whether memory stays in memory.
    pub lock_memory: bool,
    /// How long before a deadline it stops sleeping and spins [µs].
    pub spin_us: u32,
}

impl Default for Asked {
    fn default() -> Self {
        Asked { core: Core::Last, priority: Some(PRIORITY), lock_memory: true, spin_us: SPIN_US }
    }
}

impl Asked {
    /// What a scene asks for.
    pub fn by(section: &HapticSection) -> Self {
        let usual = Asked::default();
        let priority = section.priority.and_then(|priority| u8::try_from(priority).ok());
        Asked {
            core: section.core.map_or(usual.core, Core::Number),
            priority: priority.or(usual.priority),
            spin_us: section.spin_us.unwrap_or(usual.spin_us).min(SPIN_MAX_US),
            ..usual
        }
    }
}

/// What came of one request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Grant {
    /// Nobody asked.
    NotAsked,
    /// A vendor's scheduler runs the servo, as it likes.
    Vendors,
    /// It was given: which core, which priority and by whom.
    Obtained(String),
    /// It was not.
    Refused(Refusal),
}

/// Why something was not given, and what would help.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{asked} was refused ({reason}); {remedy}")]
pub struct Refusal {
    /// What was asked for.
    pub asked: String,
    /// What the operating system says.
    pub reason: String,
    /// What to do.
    pub remedy: String,
}

impl fmt::Display for Grant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Grant::NotAsked => f.write_str("not asked for"),
            Grant::Vendors => f.write_str("the vendor's scheduler decides"),
            Grant::Obtained(what) => f.write_str(what),
            Grant::Refused(refusal) => refusal.fmt(f),
        }
    }
}

/// What the thread got.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Obtained {
    /// The core it stays on.
    pub core: Grant,
    /// Its priority.
    pub priority: Grant,
    /// Whether memory stays in memory.
    pub memory: Grant,
}

impl Obtained {
    /// Where a vendor's scheduler runs the servo nothing is asked for.
    pub const VENDORS: Obtained =
        Obtained { core: Grant::Vendors, priority: Grant::Vendors, memory: Grant::Vendors };

    /// Its three parts by name.
    pub fn parts(&self) -> [(&'static str, &Grant); 3] {
        [("core", &self.core), ("priority", &self.priority), ("memory", &self.memory)]
    }

    /// What was refused.
    pub fn refusals(&self) -> impl Iterator<Item = &Refusal> {
        self.parts().into_iter().filter_map(|(_, grant)| match grant {
            Grant::Refused(refusal) => Some(refusal),
            Grant::NotAsked | Grant::Vendors | Grant::Obtained(_) => None,
        })
    }
}

/// Asks for the calling thread.
pub fn obtain(asked: &Asked) -> Obtained {
    Obtained {
        core: system::pin(asked.core),
        priority: asked.priority.map_or(Grant::NotAsked, system::prioritise),
        memory: if asked.lock_memory { system::lock_memory() } else { Grant::NotAsked },
    }
}

/// Asks for a thread that ends at once: what a servo would get.
pub fn probe(asked: &Asked) -> Obtained {
    let refused = |what: &str| {
        Grant::Refused(Refusal {
            asked: what.to_string(),
            reason: "no thread could be started".to_string(),
            remedy: "end other programs".to_string(),
        })
    };
    let asked = *asked;
    let thread = std::thread::Builder::new().name("servo".to_string()).spawn(move || {
        let obtained = obtain(&asked);
        release();
        obtained
    });
    let obtained = thread.ok().and_then(|thread| thread.join().ok());
    obtained.unwrap_or_else(|| Obtained {
        core: refused("a core"),
        priority: refused("a priority"),
        memory: refused("locked memory"),
    })
}

/// Gives back what outlives the thread.
pub fn release() {
    system::unlock_memory();
}

#[cfg(target_os = "linux")]
mod system {
    use super::{Core, Grant, Refusal};
    use rustix::mm::{MlockAllFlags, mlockall, munlockall};
    use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity, set_current_timer_slack};
    use std::num::NonZeroU64;
    use thread_priority::unix::{
        RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
        thread_native_id,
    };
    use thread_priority::{Error, ThreadPriority, ThreadPriorityValue};

    fn refused(asked: String, reason: impl ToString, remedy: String) -> Grant {
        Grant::Refused(Refusal { asked, reason: reason.to_string(), remedy })
    }

    pub fn pin(core: Core) -> Grant {
        if core == Core::Any {
            return Grant::NotAsked;
        }
        let usable: Vec<usize> = match sched_getaffinity(None) {
            Ok(set) => (0..CpuSet::MAX_CPU).filter(|core| set.is_set(*core)).collect(),
            Err(_) => Vec::new(),
        };
        let wanted = match core {
            Core::Number(core) => Some(core as usize),
            Core::Any | Core::Last => usable.last().copied(),
        };
        let Some(wanted) = wanted.filter(|wanted| *wanted < CpuSet::MAX_CPU) else {
            return refused(core.to_string(), "there is none of that number", remedy_core(&usable));
        };
        let mut set = CpuSet::new();
        set.set(wanted);
        match sched_setaffinity(None, &set) {
            Ok(()) => Grant::Obtained(format!("core {wanted}")),
            Err(error) => refused(format!("core {wanted}"), error, remedy_core(&usable)),
        }
    }

    fn remedy_core(usable: &[usize]) -> String {
        match (usable.first(), usable.last()) {
            (Some(first), Some(last)) => {
                format!("this program may use cores from {first} to {last}: name one in [haptic]")
            }
            _ => "leave `core` out of [haptic]".to_string(),
        }
    }

    pub fn prioritise(priority: u8) -> Grant {
        let kernel = match by_kernel(priority) {
            Ok(()) => match kept("the kernel") {
                Ok(granted) => return granted,
                Err(reason) => reason,
            },
            Err(reason) => reason,
        };
        let (reason, remedy) = match by_realtime_kit(priority) {
            Ok(granted) => return granted,
            Err((reason, remedy)) => (format!("{kernel}; {reason}"), remedy),
        };
        // Threads without it are woken up to 50 µs late on purpose; not this one.
        let _ = set_current_timer_slack(NonZeroU64::new(1));
        let remedy = format!(
            "{remedy}add the line `@users - rtprio {priority}` to a file in \
             /etc/security/limits.d and log in again"
        );
        refused(format!("real-time priority {priority}"), reason, remedy)
    }

    fn by_kernel(priority: u8) -> Result<(), String> {
        let fifo = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
        let value = ThreadPriorityValue::try_from(priority).map_err(|why| why.to_string())?;
        let value = ThreadPriority::Crossplatform(value);
        set_thread_priority_and_policy(thread_native_id(), value, fifo).map_err(|error| match error
        {
            Error::OS(code) => std::io::Error::from_raw_os_error(code).to_string(),
            other => format!("{other:?}"),
        })
    }

    /// What this thread has now, given by `who`.
    fn kept(who: &str) -> Result<Grant, String> {
        let (policy, priority) = scheduling()?;
        let name = match policy & !libc::SCHED_RESET_ON_FORK {
            libc::SCHED_FIFO => "SCHED_FIFO",
            libc::SCHED_RR => "SCHED_RR",
            _ => return Err("it was not kept".to_string()),
        };
        Ok(Grant::Obtained(format!("{name} {priority}, by {who}")))
    }

    /// Policy with its flags, and priority of this thread. The C library knows only what it has
    /// set itself, so the kernel is asked.
    #[allow(unsafe_code)]
    fn scheduling() -> Result<(i32, i32), String> {
        let mut parameters = libc::sched_param { sched_priority: 0 };
        // SAFETY: 0 is the calling thread, and the kernel writes one `sched_param`, which lives
        // until after the call.
        let (policy, got) =
            unsafe { (libc::sched_getscheduler(0), libc::sched_getparam(0, &mut parameters)) };
        match policy {
            0.. if got == 0 => Ok((policy, parameters.sched_priority)),
            _ => Err(std::io::Error::last_os_error().to_string()),
        }
    }

    /// None of it: why, and the beginning of what would help.
    #[cfg(feature = "rtkit")]
    fn by_realtime_kit(priority: u8) -> Result<Grant, (String, String)> {
        let thread = u64::from(rustix::thread::gettid().as_raw_nonzero().get().unsigned_abs());
        super::super::realtime_kit::ask(thread, priority)
            .map_err(|why| (why.to_string(), format!("{}, or ", why.remedy())))?;
        kept("RealtimeKit").map_err(|why| (format!("RealtimeKit: {why}"), String::new()))
    }

    #[cfg(not(feature = "rtkit"))]
    fn by_realtime_kit(_: u8) -> Result<Grant, (String, String)> {
        let why = "this build does not ask RealtimeKit (feature `rtkit`)";
        Err((why.to_string(), String::new()))
    }

    pub fn lock_memory() -> Grant {
        // What is there now, page by page as it is used: to lock all of a program that draws
        // would take more than it needs, and what comes later would fail at the limit.
        match mlockall(MlockAllFlags::CURRENT | MlockAllFlags::ONFAULT) {
            Ok(()) => Grant::Obtained("locked".to_string()),
            Err(error) => refused(
                "locked memory".to_string(),
                error,
                "add the line `@users - memlock unlimited` to a file in /etc/security/limits.d \
                 and log in again"
                    .to_string(),
            ),
        }
    }

    pub fn unlock_memory() {
        // Nothing locked is what is wanted.
        let _ = munlockall();
    }
}

#[cfg(not(target_os = "linux"))]
mod system {
    use super::{Core, Grant, Refusal};

    fn unknown(asked: String) -> Grant {
        Grant::Refused(Refusal {
            asked,
            reason: "not built in on this system".to_string(),
            remedy: "the servo runs without; use Linux for real-time rights".to_string(),
        })
    }

    pub fn pin(core: Core) -> Grant {
        if core == Core::Any { Grant::NotAsked } else { unknown(core.to_string()) }
    }

    pub fn prioritise(priority: u8) -> Grant {
        unknown(format!("real-time priority {priority}"))
    }

    pub fn lock_memory() -> Grant {
        unknown("locked memory".to_string())
    }

    pub fn unlock_memory() {}
}
