//! A mix as a WAV file.

use crate::error::Error;
use crate::files::write_whole_by;
use hapticbillard::sound::{MixWork, Mixer, Told, render_offline};
use hound::{SampleFormat, WavSpec, WavWriter};
use std::io;
use std::path::Path;

/// Bits of a sample.
const BITS: u16 = 24;

/// What was written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Written {
    /// Frames.
    pub frames: u64,
    /// The largest sample; 1 is full scale.
    pub peak: f32,
    /// What the mixer has done.
    pub work: MixWork,
}

/// Mixes up to frame `end` and writes it, in 24 bits.
///
/// # Errors
/// [`Error::Write`] if the file cannot be written.
pub fn write_wave(
    path: &Path,
    mixer: &mut Mixer,
    told: impl IntoIterator<Item = (u64, Told)>,
    end: u64,
) -> Result<Written, Error> {
    let spec = WavSpec {
        channels: 2,
        sample_rate: mixer.rate_hz() as u32,
        bits_per_sample: BITS,
        sample_format: SampleFormat::Int,
    };
    let full = ((1_i32 << (BITS - 1)) - 1) as f32;
    let mut peak = 0.0_f32;
    write_whole_by(path, |file| {
        let mut writer = WavWriter::new(file, spec).map_err(failed)?;
        render_offline(mixer, told, end, |frames| {
            for sample in frames.as_flattened() {
                peak = peak.max(sample.abs());
                writer.write_sample((sample * full).round() as i32).map_err(failed)?;
            }
            Ok::<(), io::Error>(())
        })?;
        writer.finalize().map_err(failed)
    })?;
    Ok(Written { frames: end, peak, work: mixer.work() })
}

fn failed(error: hound::Error) -> io::Error {
    match error {
        hound::Error::IoError(error) => error,
        error => io::Error::other(error),
    }
}
