//! Recordings that stand in for the synthesis, and the synthesis as recordings.

use super::voice::Voice;
use super::{Onset, SoundClass};
use glam::Vec3;

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

    /// Adds a recording of a sound at `speed_m_s`: pressure at 1 m [Pa], at the rate of the stream.
    pub fn insert(&mut self, class: SoundClass, speed_m_s: f32, samples: Vec<f32>) {
        self.recordings.push(Recording { class, speed_m_s, samples });
    }

    /// Whether everything is synthesised.
    pub fn is_empty(&self) -> bool {
        self.recordings.is_empty()
    }

    /// The recording for an onset: among those of its class and nearest in speed, one by chance.
    /// None if there is none or if the onset is too slow to be heard.
    pub fn pick(&self, _onset: &Onset) -> Option<Clip> {
        None
    }

    /// Sample `at` of a clip that [`Bank::pick`] of this bank gave [Pa]; 0 behind its end.
    pub fn sample(&self, clip: &Clip, at: u32) -> f32 {
        let recording = self.recordings.get(clip.recording as usize);
        let sample = recording.and_then(|recording| recording.samples.get(at as usize));
        clip.gain * sample.copied().unwrap_or(0.0)
    }

    /// The synthesis of a class, from its begin to its end: pressure at 1 m [Pa].
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
        let mut samples = Vec::with_capacity(voice.remaining() as usize);
        while !voice.is_over() {
            samples.push(voice.next(Bank::EMPTY));
        }
        samples
    }
}

impl Clip {
    /// [samples].
    pub fn length(&self) -> u32 {
        self.length
    }

    /// An estimate of the loudest behind sample `at` [Pa].
    pub(super) fn loudness(&self, _at: u32) -> f32 {
        self.gain
    }
}
