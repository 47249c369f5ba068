//! What is heard, as plain data and arithmetic: everything about sound but the sound card.
//!
//! An [`Onset`] is a sound that begins, told by a fact; [`Rolling`] is the newest state of a ball
//! that rolls or slides. Both are plain values, so that a ring can carry them to an audio callback.

mod mix;
mod onset;

pub use mix::{Listener, MixSettings, Mixer, Mode, Room, VOICES_MAX};
pub use onset::{Onset, Rolling, SoundClass};
