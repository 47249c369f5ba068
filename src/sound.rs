//! What is heard, as plain data and arithmetic: everything about sound but the sound card.
//!
//! [`Foley`] makes sounds of facts and snapshots: an [`Onset`] is a sound that begins, told by a
//! fact; [`Rolling`] is the newest state of a ball that rolls or slides. Both are plain values, so
//! that a ring can carry them to an audio callback. The [`Timeline`] says at which frame of a stream
//! they are [`Told`] to a [`Mixer`]; a file is mixed from a [`Script`].

mod foley;
mod mix;
mod onset;
mod script;
mod timeline;
mod told;

pub use foley::{Foley, Onsets, ROLLING_MAX, Rollings};
pub use mix::{Listener, MixSettings, Mixer, Mode, Room, VOICES_MAX};
pub use onset::{Onset, Rolling, SoundClass};
pub use script::{Script, read_aloud};
pub use timeline::{Stream, Timeline};
pub use told::{Told, What, perform};
