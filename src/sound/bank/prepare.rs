//! What a recording needs before it can stand in for a sound.

use crate::sound::level::factor;
use thiserror::Error;

/// The longest recording [s]; behind it nothing of an impact is to be heard.
pub const RECORDING_S_MAX: f32 = 10.0;

/// Before this much below its peak a recording has not begun [dB].
const BEGIN_DB: f32 = -40.0;
/// Behind this much below its peak it is over [dB].
const END_DB: f32 = -66.0;
/// What is kept before its begin [s].
const BEFORE_S: f32 = 0.0005;
/// The fade at its end [s].
const FADE_S: f32 = 0.005;

/// Why a recording cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RecordingError {
    /// There is nothing in it.
    #[error("nothing can be heard in it")]
    Silent,
    /// A sample is no number.
    #[error("sample {sample} is no finite number")]
    NotFinite {
        /// Which, from 0 on.
        sample: usize,
    },
    /// It is too long.
    #[error("it lasts longer than {} s", RECORDING_S_MAX)]
    TooLong,
}

/// The greatest of the absolute values.
pub(super) fn peak(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |peak, sample| peak.max(sample.abs()))
}

/// The sound in a recording: without mean, from its begin to its end, faded.
pub(super) fn prepare(samples: &[f32], rate_hz: f32) -> Result<Vec<f32>, RecordingError> {
    if samples.len() as f32 > RECORDING_S_MAX * rate_hz {
        return Err(RecordingError::TooLong);
    }
    if let Some(sample) = samples.iter().position(|sample| !sample.is_finite()) {
        return Err(RecordingError::NotFinite { sample });
    }
    let sum: f64 = samples.iter().copied().map(f64::from).sum();
    let mean = (sum / samples.len().max(1) as f64) as f32;
    let mut sound: Vec<f32> = samples.iter().map(|sample| sample - mean).collect();

    let peak = peak(&sound);
    // A level that is not even the last bit of 24.
    if !(peak > 1e-7 && peak.is_finite()) {
        return Err(RecordingError::Silent);
    }
    let louder = |db: f32| move |sample: &f32| sample.abs() >= peak * factor(db);
    let end = sound.iter().rposition(louder(END_DB)).map_or(0, |last| last + 1);
    let begin = sound.iter().position(louder(BEGIN_DB)).unwrap_or(0);
    // What sounds must not begin late: the start of a clip is the moment of the impact.
    let begin = begin.saturating_sub((BEFORE_S * rate_hz) as usize);
    sound.truncate(end);
    sound.drain(..begin);

    let fade = ((FADE_S * rate_hz) as usize).min(sound.len() / 2);
    let length = sound.len();
    for (i, sample) in sound[length - fade..].iter_mut().enumerate() {
        *sample *= 1.0 - (i + 1) as f32 / fade as f32;
    }
    Ok(sound)
}
