//! PHANTOM Omni, Touch and their relatives: devices of SensAble and 3D Systems, by the HD library
//! of OpenHaptics, which is loaded at run time and belongs to whoever has the device.
//!
//! The library's scheduler calls the servo ([`Called`](super::Called)), once per tick and device,
//! on a thread whose core and priority are the vendor's affair. What the device reports makes its
//! motors rest or loses it ([`care`]); the force is zero then.

mod access;
mod care;
mod faults;
mod handset;
mod hd;
mod library;
mod scheduler;
mod session;

pub use library::{VARIABLE, named};

use super::Opened;
use super::turns::{Explain, Scheduler};
use care::Reason;
use handset::Handset;
use hapticbillard::haptic::DeviceSpec;
use scheduler::Ready;
use session::Session;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Why there is no device, or why it does not move.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoOpenHaptics {
    /// The library is not there.
    #[error(
        "the OpenHaptics library was not found: {tried}; install OpenHaptics and the device's \
         driver, or name the library's file in the environment variable {VARIABLE}"
    )]
    NoLibrary {
        /// Each name, with the system's reason.
        tried: String,
    },
    /// It is another library, or an old one.
    #[error(
        "{library} has no function {function} ({reason}); install OpenHaptics 3.0 or later, or \
         name its file in {VARIABLE}"
    )]
    NoFunction {
        /// The library.
        library: String,
        /// The first function that is missing.
        function: &'static str,
        /// The system's reason.
        reason: String,
    },
    /// It opens no device.
    #[error("{library} opens no haptic device ({tried}): {remedy}")]
    NoDevice {
        /// The library.
        library: String,
        /// Each name, with the library's reason.
        tried: String,
        /// What to do.
        remedy: String,
    },
    /// The device does not know where its arm is.
    #[error(
        "{library} could not calibrate the device ({reason}): hold its arm with all links at right \
         angles, and start again"
    )]
    NotCalibrated {
        /// The library.
        library: String,
        /// Its reason.
        reason: String,
    },
    /// The device is there, but the loop does not start.
    #[error(
        "{library} does not start {what} ({reason}): end other programs that use the device, or \
         unplug it and plug it in again"
    )]
    NotStarted {
        /// The library.
        library: String,
        /// What was asked for.
        what: &'static str,
        /// Its reason.
        reason: String,
    },
    /// The loop has started, and nobody calls.
    #[error(
        "the scheduler of {library} does not call: end other programs that use the device, or \
         unplug it and plug it in again"
    )]
    Silent {
        /// The library.
        library: String,
    },
}

/// Opens the device of this name, or the usual one, in this library, or the one that is installed.
/// It is not pushed before its scheduler starts.
///
/// # Errors
/// [`NoOpenHaptics`] if there is no library or no device.
pub fn open(library: Option<&Path>, name: Option<&str>) -> Result<Opened, NoOpenHaptics> {
    let session = Arc::new(Session::open(library::load(library)?, name)?);
    if let Some(refusal) = &session.rate_refused {
        tracing::warn!("{refusal}");
    }
    let (reason, closed) = (Arc::<Reason>::default(), Arc::<AtomicBool>::default());
    let device = Handset::new(session.clone(), reason.clone(), closed.clone());
    let scheduler: Box<dyn Scheduler> = Box::new(Ready { session, closed });
    let explains: Arc<dyn Explain> = reason;
    Ok(Opened { scheduler: Some(scheduler), explains: Some(explains), ..Opened::new(device) })
}

/// What a device says of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Its limits, in units.
    pub spec: DeviceSpec,
    /// Which library, which device, which versions; what was refused.
    pub about: String,
}

/// Asks a device what it is, without pushing it, and closes it again.
///
/// # Errors
/// [`NoOpenHaptics`] if there is no library or no device.
pub fn look(library: Option<&Path>, name: Option<&str>) -> Result<Seen, NoOpenHaptics> {
    let session = Session::open(library::load(library)?, name)?;
    let mut about = format!("{}: {}", session.library(), session.about);
    if let Some(refusal) = &session.rate_refused {
        about = format!("{about}; {refusal}");
    }
    Ok(Seen { spec: session.spec, about })
}
