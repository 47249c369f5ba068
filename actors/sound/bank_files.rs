//! Sound files: a folder of recordings that stand in for the synthesis, and samples as a file.
//!
//! A file that cannot be used is refused with a sentence, and what it would have been is
//! synthesised; nothing in a folder keeps a game from being played. That a folder which somebody
//! named is not there is an error.

use super::backend::NoSound;
use crate::error::Error;
use crate::files::{list, read_bytes};
use audioadapter_buffers::direct::SequentialSlice;
use hapticbillard::sound::{Bank, ClipName, NameError, RECORDING_S_MAX, RecordingError};
use hound::{SampleFormat, WavReader, WavSpec, WavWriter};
use rubato::{Fft, FixedSync, Resampler};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest sound file that is read [bytes]: 10 s of two channels at the highest rate.
const FILE_BYTES_MAX: u64 = 32 << 20;

/// Most recordings of one folder, so that its samples fit into memory.
const RECORDINGS_MAX: usize = 200;

/// Rates of recordings that are read [Hz].
const RATES_HZ: std::ops::RangeInclusive<u32> = 8_000..=384_000;

/// The loudest sample, 1 being full scale: far larger ones are none of a sound, and a resampler
/// cannot add them up.
const SAMPLE_MAX: f32 = 1e6;

/// Frames that are resampled in one go.
const CHUNK: usize = 1024;

/// A file of a folder that is not used.
#[derive(Debug, Error)]
#[error("{} is not used: {reason}", shown(path))]
pub struct Refused {
    /// The file.
    pub path: PathBuf,
    /// Why.
    pub reason: Reason,
}

/// A path in one line: a file's name may hold anything.
fn shown(path: &Path) -> String {
    path.display().to_string().replace(char::is_control, "?")
}

/// Why a sound file is not used.
#[derive(Debug, Error)]
pub enum Reason {
    /// Its name does not say what it is.
    #[error(transparent)]
    Name(#[from] NameError),
    /// It could not be read.
    #[error(transparent)]
    File(#[from] Box<Error>),
    /// It is no WAV file, or a broken one.
    #[error("it is no WAV file that can be read: {0}")]
    Wav(#[from] hound::Error),
    /// Too many channels.
    #[error("it has {0} channels; one or two are read")]
    Channels(u16),
    /// A rate outside of what is read.
    #[error("it has {0} samples a second; 8000 to 384000 are read")]
    Rate(u32),
    /// A sample far beyond full scale.
    #[error("sample {sample} is {value:e} times full scale; write it with samples from -1 to 1")]
    Beyond {
        /// Which, from 0 on.
        sample: usize,
        /// What stands there.
        value: f32,
    },
    /// It could not be brought to the rate of the stream.
    #[error("it cannot be brought from {from_hz} to {to_hz} samples a second: {problem}")]
    Resampling {
        /// Its rate [Hz].
        from_hz: u32,
        /// That of the stream [Hz].
        to_hz: u32,
        /// What the resampler says.
        problem: String,
    },
    /// What is in it cannot stand in for a sound.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// There were enough before it.
    #[error("there are {} recordings before it, and more are not read", RECORDINGS_MAX)]
    Enough,
}

/// The bank of a folder, for a stream of `rate_hz`, and what was refused.
///
/// Reads what ends in `.wav` and is named `CLASS_vSPEED_VARIANT.wav`, in the order of the names;
/// other files and folders in it are left alone. Blocks as long as the disk does: not for the audio
/// callback.
///
/// # Errors
/// [`NoSound::NoRecordings`] if the folder cannot be listed.
pub fn read_folder(folder: &Path, rate_hz: u32) -> Result<(Bank, Vec<Refused>), NoSound> {
    let mut names = list(folder).map_err(|problem| NoSound::NoRecordings {
        folder: folder.to_path_buf(),
        reason: problem.to_string(),
    })?;

    names.retain(|name| name.to_ascii_lowercase().ends_with(".wav"));
    let (mut bank, mut refused) = (Bank::default(), Vec::new());
    let mut read = 0;
    for name in names {
        let path = folder.join(&name);
        let added = match read < RECORDINGS_MAX {
            true => add(&mut bank, &name, &path, rate_hz),
            false => Err(Reason::Enough),
        };
        match added {
            Ok(()) => read += 1,
            Err(reason) => refused.push(Refused { path, reason }),
        }
    }
    Ok((bank, refused))
}

/// Adds one file to a bank.
fn add(bank: &mut Bank, name: &str, path: &Path, rate_hz: u32) -> Result<(), Reason> {
    let name: ClipName = name.parse()?;
    let bytes = read_bytes(path, FILE_BYTES_MAX).map_err(Box::new)?;
    add_bytes(bank, name, &bytes, rate_hz)
}

/// Adds what a WAV file holds to the bank of a stream of `rate_hz`.
///
/// # Errors
/// [`Reason`] if it cannot stand in for a sound.
pub fn add_bytes(
    bank: &mut Bank,
    name: ClipName,
    bytes: &[u8],
    rate_hz: u32,
) -> Result<(), Reason> {
    let (samples, from_hz) = decode(bytes)?;
    let samples = resample(samples, from_hz, rate_hz)?;
    Ok(bank.insert(name.class, name.speed_m_s, &samples, rate_hz as f32)?)
}

/// One channel of samples from -1 to 1, the mean of two, and their rate [Hz].
fn decode(bytes: &[u8]) -> Result<(Vec<f32>, u32), Reason> {
    let mut reader = WavReader::new(Cursor::new(bytes))?;
    let WavSpec { channels, sample_rate, bits_per_sample, sample_format } = reader.spec();
    if !(1..=2).contains(&channels) {
        return Err(Reason::Channels(channels));
    }
    if !RATES_HZ.contains(&sample_rate) {
        return Err(Reason::Rate(sample_rate));
    }
    if reader.duration() as f32 > RECORDING_S_MAX * sample_rate as f32 {
        return Err(RecordingError::TooLong.into());
    }
    let samples: Vec<f32> = match sample_format {
        SampleFormat::Float => reader.samples::<f32>().collect::<Result<_, _>>()?,
        SampleFormat::Int => {
            let full = (1_u64 << (bits_per_sample.clamp(1, 32) - 1)) as f32;
            let scaled = |sample: Result<i32, hound::Error>| sample.map(|x| x as f32 / full);
            reader.samples::<i32>().map(scaled).collect::<Result<_, _>>()?
        }
    };
    let width = usize::from(channels);
    let mean = |frame: &[f32]| frame.iter().sum::<f32>() / width as f32;
    Ok((samples.chunks_exact(width).map(mean).collect(), sample_rate))
}

/// The same sound at another rate, band-limited by a windowed sinc.
fn resample(samples: Vec<f32>, from_hz: u32, to_hz: u32) -> Result<Vec<f32>, Reason> {
    // A sample that is no number would spread over all others.
    if let Some(sample) = samples.iter().position(|sample| !sample.is_finite()) {
        return Err(RecordingError::NotFinite { sample }.into());
    }
    if let Some(sample) = samples.iter().position(|sample| sample.abs() > SAMPLE_MAX) {
        return Err(Reason::Beyond { sample, value: samples[sample] });
    }
    if from_hz == to_hz || samples.is_empty() {
        return Ok(samples);
    }
    let failed = |problem: String| -> Reason { Reason::Resampling { from_hz, to_hz, problem } };
    let (from, to) = (from_hz as usize, to_hz as usize);
    let mut resampler = Fft::<f32>::new(from, to, CHUNK, 1, FixedSync::Both)
        .map_err(|problem| failed(problem.to_string()))?;
    let input = SequentialSlice::new(&samples, 1, samples.len())
        .map_err(|problem| failed(problem.to_string()))?;
    let output = resampler
        .process_all(&input, samples.len(), None)
        .map_err(|problem| failed(problem.to_string()))?;
    Ok(output.take_data())
}

/// A WAV file of 32-bit floats; `samples` are interleaved where there are several channels.
pub fn encode(samples: &[f32], channels: u16, rate_hz: u32) -> Result<Vec<u8>, hound::Error> {
    let spec = WavSpec {
        channels,
        sample_rate: rate_hz,
        bits_per_sample: 32,
        sample_format: SampleFormat::Float,
    };
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = WavWriter::new(&mut bytes, spec)?;
    samples.iter().try_for_each(|&sample| writer.write_sample(sample))?;
    writer.finalize()?;
    Ok(bytes.into_inner())
}
