//! Where sound goes: the system's devices, or what stands in for them.

use super::callback::Callback;
use std::any::Any;
use std::path::PathBuf;

/// An output that sound can go to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// What `device` in a scene may name.
    pub name: String,
    /// What it says of itself.
    pub description: String,
}

/// A stream that plays until it is dropped.
pub struct Playing {
    /// The stream.
    pub stream: Box<dyn Any + Send>,
    /// The device, as its driver calls it.
    pub device: String,
}

/// Opens outputs. It is used by one thread, which may wait.
pub trait Backend: Send {
    /// All outputs.
    ///
    /// # Errors
    /// [`NoSound`] if the system cannot be asked.
    fn outputs(&mut self) -> Result<Vec<Output>, NoSound>;

    /// Opens the output of this name, or the system's own choice, and lets it play what the
    /// callback that `make` makes for its rate [Hz] gives. `make` may be called again where the
    /// first try is refused: the last callback plays.
    ///
    /// # Errors
    /// [`NoSound`] if there is none.
    fn open(
        &mut self,
        device: Option<&str>,
        make: &mut dyn FnMut(u32) -> Callback,
    ) -> Result<Playing, NoSound>;
}

/// Why there is no sound; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoSound {
    /// Built without the feature.
    #[error(
        "this build has no sound; build it with the feature `sound`, which is there by default"
    )]
    NotBuilt,
    /// The system has no output.
    #[error("no sound device ({0}); plug one in, or start the sound server")]
    NoDevice(String),
    /// The system has no output of this name.
    #[error("no sound device '{name}'; `hapticbillard sound devices` lists those that are there")]
    NotThere {
        /// What was asked for.
        name: String,
    },
    /// The output does not do what is needed.
    #[error(
        "the sound device {device} cannot be used ({reason}); choose \
         another one with device = \"..\""
    )]
    Refused {
        /// Which.
        device: String,
        /// What it says.
        reason: String,
    },
    /// A scene's recordings are elsewhere.
    #[error("recordings = \"{name}\": recordings must lie in the scene's folder or below it")]
    Recordings {
        /// What the scene says.
        name: String,
    },
    /// A folder of recordings cannot be listed.
    #[error(
        "the recordings in {} cannot be listed ({reason}); name a folder that is there",
        folder.display()
    )]
    NoRecordings {
        /// Which.
        folder: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// The operating system gives no thread.
    #[error("no thread for sound ({0}); end other programs")]
    NoThread(String),
}

/// Stands in where sound is not built in.
pub struct NotBuilt;

impl Backend for NotBuilt {
    fn outputs(&mut self) -> Result<Vec<Output>, NoSound> {
        Err(NoSound::NotBuilt)
    }

    fn open(
        &mut self,
        _: Option<&str>,
        _: &mut dyn FnMut(u32) -> Callback,
    ) -> Result<Playing, NoSound> {
        Err(NoSound::NotBuilt)
    }
}

/// The system's outputs.
pub fn system() -> Box<dyn Backend> {
    #[cfg(feature = "sound")]
    return Box::new(super::card::Card);
    #[cfg(not(feature = "sound"))]
    return Box::new(NotBuilt);
}
