//! What a sound meets on its way: the listener, the room, and how far the mixer looks ahead.

use super::head::pole_frames;
use super::line::Line;
use super::path::{BACK, BLOCK};
use super::{Listener, MixSettings, Mode, Room};
use crate::sound::Bank;
use crate::sound::parameters::SOUND_SPEED_M_S;
use crate::sound::voice::usable_rate;
use glam::Vec3;
use std::sync::Arc;

/// Longest way of a sound [s]: 20 m; from further away it comes no later.
const DELAY_MAX_S: f32 = 0.06;
/// No coordinate is further out [m]: squares and sums of them stay numbers.
const FAR_M: f32 = 1e4;
/// The tail of a head's shadow is over after so many of its frames: below -200 dB.
const TAIL: f32 = 13.0;

/// What all sounds have in common.
#[derive(Debug)]
pub struct Surroundings {
    /// Frames a second [Hz].
    pub rate_hz: f32,
    /// Headphones or loudspeakers.
    pub mode: Mode,
    /// Who hears it, now.
    pub listener: Listener,
    /// The walls that answer.
    pub room: Option<Room>,
    /// Longest delay [frames].
    pub delay_max: usize,
    /// Recordings of sounds.
    pub bank: Arc<Bank>,
}

impl Surroundings {
    /// As the settings say, and with nothing in them that is no number.
    pub fn new(settings: &MixSettings, bank: Arc<Bank>) -> Surroundings {
        let rate_hz = usable_rate(settings.rate_hz);
        Surroundings {
            rate_hz,
            mode: settings.mode,
            listener: Listener::default(),
            room: settings.room.filter(Room::is_sound),
            delay_max: (DELAY_MAX_S * rate_hz) as usize,
            bank,
        }
    }

    /// A line that holds all that is on its way.
    pub fn line(&self) -> Line {
        Line::new(self.delay_max + 2 * BLOCK + BACK)
    }

    /// Frames in a span of time; at least one.
    pub fn frames(&self, span_s: f32) -> u32 {
        ((span_s * self.rate_hz) as u32).max(1)
    }

    /// How long the way to an ear rings after its source [frames].
    pub fn tail_frames(&self) -> u64 {
        (TAIL * pole_frames(self.rate_hz)) as u64 + 8
    }

    /// Delay of a way [frames].
    pub fn delay(&self, way_m: f32) -> f32 {
        (way_m / SOUND_SPEED_M_S * self.rate_hz).clamp(0.0, self.delay_max as f32)
    }
}

/// A point that can be reckoned with, or none.
pub fn point(told_m: Vec3) -> Option<Vec3> {
    told_m.is_finite().then(|| told_m.clamp(Vec3::splat(-FAR_M), Vec3::splat(FAR_M)))
}
