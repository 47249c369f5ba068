//! What is heard, as plain data and arithmetic: everything about sound but the sound card.
//!
//! An [`Onset`] is a sound that begins, told by a fact; [`Rolling`] is the newest state of a ball
//! that rolls or slides. Both are plain values, so that a ring can carry them to an audio callback.

mod mix;
mod onset;

pub use mix::{
    AHEAD_MAX_S, Listener, MixSettings, MixWork, Mixer, Mode, ROLLING_MAX, Room, Told, VOICES_MAX,
    render_offline,
};
pub use onset::{Onset, Rolling, SoundClass};
