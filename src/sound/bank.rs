//! Recordings that stand in for the synthesis, and the synthesis as recordings.

mod name;
mod prepare;

pub use name::{ClipName, NameError};
pub use prepare::{RECORDING_S_MAX, RecordingError};

use super::chance::Chance;
use super::parameters::{SPEED_MAX_M_S, VARIATION, level_exponent};
use super::voice::{Voice, is_heard};
use super::{Onset, SoundClass};
use glam::Vec3;

/// The slowest speed that a recording can stand for [m/s].
pub const RECORDED_SPEED_MIN_M_S: f32 = 0.05;

/// What is left of a recording is known in pieces of so many samples.
const PIECE: usize = 256;

/// Variants of the synthesis whose mean level a recording is brought to.
const LEVEL_VARIANTS: u32 = 4;

/// Recordings by class and speed. An empty bank: everything is synthesised.
#[derive(Debug, Clone, Default)]
pub struct Bank {
    recordings: Vec<Recording>,
}

#[derive(Debug, Clone)]
struct Recording {
    class: SoundClass,
    speed_m_s: f32,
    /// Pressure at 1 m [Pa], at the rate of the stream.
    samples: Vec<f32>,
    /// From each piece on to the end: the loudest [Pa].
    rest_pa: Vec<f32>,
}

/// A recording of a bank, as one sound plays it: plain data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clip {
    recording: u32,
    length: u32,
    gain: f32,
}

impl Bank {
    /// A bank without recordings.
    pub const EMPTY: &'static Bank = &Bank { recordings: Vec::new() };

    /// Adds a recording of a sound at `speed_m_s`: one channel, at `rate_hz`, the rate of the
    /// stream, in any unit.
    ///
    /// It is cut to its sound, freed of its mean, faded at its end and brought to the level of the
    /// synthesis at this speed. Fails if nothing can be heard in it, if it has samples that are no
    /// finite numbers, or if it is longer than [`RECORDING_S_MAX`].
    pub fn insert(
        &mut self,
        class: SoundClass,
        speed_m_s: f32,
        samples: &[f32],
        rate_hz: f32,
    ) -> Result<(), RecordingError> {
        let mut samples = prepare::prepare(samples, rate_hz)?;
        let speed_m_s = speed_m_s.clamp(RECORDED_SPEED_MIN_M_S, SPEED_MAX_M_S);
        let gain = level_pa(class, speed_m_s, rate_hz) / prepare::peak(&samples);
        samples.iter_mut().for_each(|sample| *sample *= gain);
        let mut rest_pa: Vec<f32> = samples.chunks(PIECE).map(prepare::peak).collect();
        for i in (1..rest_pa.len()).rev() {
            rest_pa[i - 1] = rest_pa[i - 1].max(rest_pa[i]);
        }
        self.recordings.push(Recording { class, speed_m_s, samples, rest_pa });
        Ok(())
    }

    /// Whether everything is synthesised.
    pub fn is_empty(&self) -> bool {
        self.recordings.is_empty()
    }

    /// How many recordings there are of a class.
    pub fn count(&self, class: SoundClass) -> usize {
        self.recordings.iter().filter(|recording| recording.class == class).count()
    }

    /// The recording for an onset: among those of its class nearest in speed, one by the chance of
    /// the onset, louder or softer by the ratio of the speeds. None if there is none, or if the
    /// onset is not heard.
    pub fn pick(&self, onset: &Onset) -> Option<Clip> {
        if self.recordings.is_empty() || !is_heard(onset) {
            return None;
        }
        let speed_m_s = onset.speed_m_s.clamp(RECORDED_SPEED_MIN_M_S, SPEED_MAX_M_S);
        let of_class = || self.recordings.iter().filter(|one| one.class == onset.class);
        let away = |one: &Recording| libm::logf(one.speed_m_s / speed_m_s).abs();
        let nearest = of_class().map(away).min_by(f32::total_cmp)?;
        let candidates = || {
            let all = self.recordings.iter().enumerate();
            all.filter(|(_, one)| one.class == onset.class && away(one) == nearest)
        };

        let mut chance = Chance::new(onset.seed, 0);
        let level = chance.level(VARIATION.level_db);
        let number = (chance.unit() * candidates().count() as f32) as usize;
        let (index, recording) = candidates().nth(number)?;
        let ratio = speed_m_s / recording.speed_m_s;
        Some(Clip {
            recording: index as u32,
            length: recording.samples.len() as u32,
            gain: level * libm::powf(ratio, level_exponent(onset.class)),
        })
    }

    /// Sample `at` of a clip that [`Bank::pick`] of this bank gave [Pa]; 0 behind its end.
    pub fn sample(&self, clip: &Clip, at: u32) -> f32 {
        let recording = self.recordings.get(clip.recording as usize);
        let sample = recording.and_then(|recording| recording.samples.get(at as usize));
        clip.gain * sample.copied().unwrap_or(0.0)
    }

    /// An estimate of the loudest of a clip from sample `at` on [Pa].
    pub fn loudness(&self, clip: &Clip, at: u32) -> f32 {
        let recording = self.recordings.get(clip.recording as usize);
        let rest = recording.and_then(|recording| recording.rest_pa.get(at as usize / PIECE));
        clip.gain * rest.copied().unwrap_or(0.0)
    }

    /// The synthesis of a class, from its begin to its end: pressure at 1 m [Pa].
    ///
    /// # Examples
    /// The click of two balls that meet at 2 m/s, at 48 kHz.
    ///
    /// ```
    /// use hapticbillard::sound::{Bank, SoundClass};
    ///
    /// let click = Bank::synthesise(SoundClass::BallClick, 2.0, 1, 48_000.0);
    /// let loudest = click.iter().fold(0.0_f32, |most, pressure_pa| most.max(pressure_pa.abs()));
    /// println!("{} samples, at most {loudest:.2} Pa", click.len());
    /// # assert!(click.len() > 100 && loudest > 0.0);
    /// ```
    pub fn synthesise(class: SoundClass, speed_m_s: f32, variant: u32, rate_hz: f32) -> Vec<f32> {
        let onset = Onset {
            time_s: 0.0,
            class,
            speed_m_s,
            position_m: Vec3::ZERO,
            axis: Vec3::ZERO,
            seed: variant,
        };
        let mut voice = Voice::begin(&onset, Bank::EMPTY, rate_hz);
        let mut samples = vec![0.0; voice.remaining() as usize];
        voice.fill(Bank::EMPTY, &mut samples);
        samples
    }
}

impl Clip {
    /// [samples].
    pub fn length(&self) -> u32 {
        self.length
    }
}

/// The peak of the synthesis, the mean of some variants [Pa].
fn level_pa(class: SoundClass, speed_m_s: f32, rate_hz: f32) -> f32 {
    let peak = |variant| prepare::peak(&Bank::synthesise(class, speed_m_s, variant, rate_hz));
    (0..LEVEL_VARIANTS).map(peak).sum::<f32>() / LEVEL_VARIANTS as f32
}
