//! What is heard, as plain data and arithmetic: everything about sound but the sound card.
//!
//! [`Foley`] makes sounds of facts and snapshots: an [`Onset`] is a sound that begins, told by a
//! fact; [`Rolling`] is the newest state of a ball that rolls or slides. Both are plain values, so
//! that a ring can carry them to an audio callback; a [`Timeline`] says at which frame. A [`Voice`]
//! is an onset that sounds, a [`RollingVoice`] a ball on the move: synthesis from the table in
//! [`parameters`], or a recording of a [`Bank`]. The [`Mixer`] makes two channels of them; a file
//! is mixed from a [`Script`].

mod bank;
mod chance;
pub mod contact;
mod filter;
mod foley;
pub mod level;
mod mix;
mod onset;
pub mod parameters;
mod perform;
mod rolling;
mod room_tone;
mod script;
mod timeline;
mod voice;

pub use bank::{Bank, Clip, ClipName, NameError, RECORDING_S_MAX, RecordingError};
pub use foley::{Foley, Onsets, Rollings};
pub use mix::{
    AHEAD_MAX_S, Listener, MixSettings, MixWork, Mixer, Mode, ROLLING_MAX, Room, Told, VOICES_MAX,
    render_offline,
};
pub use onset::{Onset, Rolling, SoundClass};
pub use perform::{STARTS_MAX, TOLD_MAX, perform};
pub use rolling::RollingVoice;
pub use room_tone::RoomTone;
pub use script::Script;
pub use timeline::{Stream, Timeline};
pub use voice::Voice;
