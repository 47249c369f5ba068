//! A quiet room: what is heard when nothing is.

use super::chance::Chance;
use super::filter::Filter;
use super::level::pascal;
use super::parameters::ROOM_TONE;
use super::voice::usable_rate;
use core::f32::consts::FRAC_1_SQRT_2;

/// The soft noise of a room at night, without end. Two of them with different seeds, one per ear,
/// sound from all round.
#[derive(Debug, Clone)]
pub struct RoomTone {
    low_cut: Filter,
    high_cut: Filter,
    gain: f32,
    chance: Chance,
}

impl RoomTone {
    /// The same samples for the same seed and rate [Hz].
    pub fn new(seed: u32, rate_hz: f32) -> RoomTone {
        let rate_hz = usable_rate(rate_hz);
        let width_hz = ROOM_TONE.high_hz - ROOM_TONE.low_hz;
        RoomTone {
            low_cut: Filter::new(ROOM_TONE.low_hz, FRAC_1_SQRT_2, rate_hz),
            // A soft corner: half of the way between flat and falling by 6 dB per octave.
            high_cut: Filter::new(ROOM_TONE.high_hz, 0.5, rate_hz),
            gain: pascal(ROOM_TONE.level_db) / (width_hz / (0.5 * rate_hz) / 3.0).sqrt(),
            chance: Chance::new(seed, 3),
        }
    }

    /// The next sample [Pa].
    pub fn next(&mut self) -> f32 {
        let noise = self.chance.noise();
        self.gain * self.high_cut.next(self.low_cut.next(noise).high).low
    }
}
