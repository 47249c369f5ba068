//! What a mixer is made for.

use super::Room;

/// What the two channels are played by.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    /// One channel an ear: delay and shadow of the head tell where a sound is.
    #[default]
    Headphones,
    /// Two loudspeakers in front: level alone tells left from right, and the listener's own head
    /// does the rest.
    Loudspeakers,
}

/// What a mixer is made for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MixSettings {
    /// Frames a second of the stream [Hz]; held to 8 000 to 192 000.
    pub rate_hz: f32,
    /// Headphones or loudspeakers.
    pub mode: Mode,
    /// The walls that answer; `None` is an open field.
    pub room: Option<Room>,
    /// The soft noise of a room at night.
    pub room_tone: bool,
    /// Factor of the whole; held to 0 to 4.
    pub volume: f32,
}

impl Default for MixSettings {
    fn default() -> Self {
        MixSettings {
            rate_hz: 48_000.0,
            mode: Mode::Headphones,
            room: None,
            room_tone: false,
            volume: 1.0,
        }
    }
}
