//! What is heard, as plain data and arithmetic: everything about sound but the sound card.
//!
//! An [`Onset`] is a sound that begins, told by a fact; [`Rolling`] is the newest state of a ball
//! that rolls or slides. Both are plain values, so that a ring can carry them to an audio callback.
//! A [`Voice`] is an onset that sounds, a [`RollingVoice`] a ball on the move: synthesis from the
//! table in [`parameters`], or a recording of a [`Bank`]. The [`Mixer`] makes two channels of them.

mod bank;
mod chance;
pub mod contact;
mod filter;
pub mod level;
mod mix;
mod onset;
pub mod parameters;
mod rolling;
mod room_tone;
mod voice;

pub use bank::{Bank, Clip, ClipName, NameError, RECORDING_S_MAX, RecordingError};
pub use mix::{
    AHEAD_MAX_S, Listener, MixSettings, MixWork, Mixer, Mode, ROLLING_MAX, Room, Told, VOICES_MAX,
    render_offline,
};
pub use onset::{Onset, Rolling, SoundClass};
pub use rolling::RollingVoice;
pub use room_tone::RoomTone;
pub use voice::Voice;
