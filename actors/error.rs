//! What can go wrong between a core and the operating system; each in one line.

use crate::conductor::RunError;
use hapticbillard::cast::CastError;
use hapticbillard::physics::PhysicsError;
use hapticbillard::replay::RecordingError;
use hapticbillard::scene::SceneError;
use std::path::PathBuf;

/// Why a command gave up.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        reason: std::io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        reason: std::io::Error,
    },
    /// A file is larger than anything it could rightly be.
    #[error("{} is larger than {limit} bytes; is it the right file?", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Most bytes that are read.
        limit: u64,
    },
    /// A file is no text.
    #[error("{} is not a UTF-8 text; is it the right file?", path.display())]
    NoText {
        /// The file.
        path: PathBuf,
    },
    /// A path names no plain file: a folder, a device.
    #[error("{} is not a plain file", path.display())]
    NoFile {
        /// What was named.
        path: PathBuf,
    },
    /// Neither a shipped scene nor a file.
    #[error("there is no scene '{name}': write a file or one of {}", shipped.join(", "))]
    NoScene {
        /// What was asked for.
        name: String,
        /// What there is.
        shipped: Vec<&'static str>,
    },
    /// A scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The cores of a scene do not fit together.
    #[error(transparent)]
    Cast(#[from] CastError),
    /// A recording is wrong.
    #[error("{}: {error}", path.display())]
    Recording {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        error: RecordingError,
    },
    /// A game could not go on.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A haptic device is not there.
    #[error(transparent)]
    Device(#[from] crate::haptic::NoDevice),
    /// A haptic servo cannot run.
    #[error(transparent)]
    Servo(#[from] crate::haptic::NoServo),
    /// Sound is not there.
    #[error(transparent)]
    Sound(#[from] crate::sound::NoSound),
    /// A simulation cannot begin or go on.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// There is no picture.
    #[cfg(feature = "renderer")]
    #[error(transparent)]
    Picture(#[from] crate::renderer::NoPicture),
    /// The operating system names no folder for data.
    #[error("there is no home folder to keep data in; set HOME")]
    NoHome,
    /// Something that was typed or piped in is wrong.
    #[error("{what}: {problem}; {fix}")]
    Input {
        /// Where it came from, such as `--until` or `shots.jsonl:3`.
        what: String,
        /// What is wrong with it.
        problem: String,
        /// What to do.
        fix: String,
    },
    /// The answer could not be printed.
    #[error("cannot print: {0}")]
    Output(#[from] std::io::Error),
}

impl Error {
    /// An error about something that was typed or piped in.
    pub fn input(
        what: impl Into<String>,
        problem: impl Into<String>,
        fix: impl Into<String>,
    ) -> Self {
        Error::Input { what: what.into(), problem: problem.into(), fix: fix.into() }
    }
}
