//! How the rows of the table become a sound: one function per class.

mod ball_click;
mod cue;
mod fall;

use super::burst::Burst;
use super::pulse::Pulse;
use super::resonator::Resonator;
use super::{SPHERE_RINGS_S, Voice, is_heard};
use crate::sound::chance::Chance;
use crate::sound::level::pascal;
use crate::sound::parameters::{
    ClassParameters, SILENT_BELOW_M_S, SPEED_MAX_M_S, VARIATION, class_parameters,
};
use crate::sound::{Onset, SoundClass};

/// What all functions need.
struct Synthesis<'a> {
    voice: &'a mut Voice,
    chance: Chance,
    rate_hz: f32,
    /// Within the limits.
    speed_m_s: f32,
    /// The variation of the level of this hit.
    level: f32,
}

/// Puts the sound of `onset` into an empty voice.
pub(super) fn synthesise(voice: &mut Voice, onset: &Onset, rate_hz: f32) {
    if !is_heard(onset) {
        return;
    }
    let speed_m_s = onset.speed_m_s.min(SPEED_MAX_M_S);
    let mut chance = Chance::new(onset.seed, 0);
    let mut level = chance.level(VARIATION.level_db);
    if onset.class.is_impact() {
        // From nothing at the limit to all of it at twice that.
        level *= (speed_m_s / SILENT_BELOW_M_S - 1.0).min(1.0);
    }
    let synthesis = Synthesis { voice, chance, rate_hz, speed_m_s, level };
    let row = class_parameters(onset.class);
    match onset.class {
        SoundClass::BallClick => ball_click::ball_click(synthesis, row),
        SoundClass::Miscue => cue::miscue(synthesis, row),
        SoundClass::Chalk => cue::chalk(synthesis, row),
        SoundClass::Pocket => fall::pocket(synthesis, row),
        SoundClass::Gully => fall::gully(synthesis, row, onset.seed),
        SoundClass::Floor => fall::floor(synthesis, row),
        SoundClass::CueStrike | SoundClass::Cushion | SoundClass::Landing => synthesis.plain(row),
    }
}

impl Synthesis<'_> {
    /// One contact, its modes and its noise.
    fn plain(mut self, row: &ClassParameters) {
        let length_s = self.length_s(row);
        self.modes(row);
        self.strike(row, length_s, 0.0, self.speed_m_s, self.drive(row));
        self.noise(row, 0.0, self.drive(row));
        self.ring_out(row, length_s);
    }

    /// How strongly the modes and the noise of a row are driven.
    fn drive(&self, row: &ClassParameters) -> f32 {
        libm::powf(self.speed_m_s, row.speed_exponent)
    }

    /// Length of the contact, with the variation of this hit [s].
    fn length_s(&mut self, row: &ClassParameters) -> f32 {
        let length_s = row.contact.map_or(0.0, |contact| contact.length.at_s(self.speed_m_s));
        self.varied(length_s)
    }

    /// A whole number, both limits included.
    fn count(&mut self, limits: [u8; 2]) -> u8 {
        self.chance.between(f32::from(limits[0]), f32::from(limits[1]) + 1.0) as u8
    }

    /// A length with the variation of this hit.
    fn varied(&mut self, length_s: f32) -> f32 {
        length_s * (1.0 + VARIATION.length * self.chance.noise())
    }

    /// A contact that begins `at_s` after the onset: the ball changes its velocity by the part of
    /// `speed_m_s` that the row says, the modes are struck by `modes`.
    fn strike(
        &mut self,
        row: &ClassParameters,
        length_s: f32,
        at_s: f32,
        speed_m_s: f32,
        modes: f32,
    ) {
        let Some(contact) = row.contact else { return };
        let length = length_s * self.rate_hz;
        let pulse = Pulse {
            start: at_s * self.rate_hz,
            rise: contact.rise * length,
            fall: (1.0 - contact.rise) * length,
            sphere_m_s: self.level * contact.sphere * speed_m_s,
            modes: self.level * modes,
        };
        self.voice.last_until(pulse.end() + SPHERE_RINGS_S * self.rate_hz);
        self.voice.pulses.push(pulse);
    }

    /// The modes of a row, each with the variation of this hit.
    fn modes(&mut self, row: &ClassParameters) {
        for mode in row.modes {
            let level = pascal(mode.level_db) * self.chance.level(VARIATION.mode_db);
            // What the rate cannot hold is left out.
            if mode.frequency_hz < 0.45 * self.rate_hz {
                let ring = Resonator::new(mode.frequency_hz, mode.t60_s, level, self.rate_hz);
                self.voice.push_mode(ring);
            }
        }
    }

    /// The noise of a row, `gain` times, from `at_s` on.
    fn noise(&mut self, row: &ClassParameters, at_s: f32, gain: f32) {
        for band in row.noise {
            let gain = gain * self.level;
            let burst = Burst::new(band, gain, at_s * self.rate_hz, self.rate_hz);
            self.voice.last_until(burst.end() as f32);
            self.voice.push_burst(burst);
        }
    }

    /// Lets the modes ring out that were struck last at `at_s`.
    fn ring_out(&mut self, row: &ClassParameters, at_s: f32) {
        let longest = row.modes.iter().map(|mode| mode.t60_s).fold(0.0, f32::max);
        self.voice.last_until((at_s + longest) * self.rate_hz);
    }
}
