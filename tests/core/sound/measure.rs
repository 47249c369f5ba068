//! Spectra and levels of samples.

use hapticbillard::sound::level::decibels;
use hapticbillard::sound::{Bank, SoundClass};
use realfft::RealFftPlanner;

/// The rate that is measured at, where nothing else is said [Hz].
pub const RATE_HZ: f32 = 48_000.0;

/// The synthesis of a class at [`RATE_HZ`].
pub fn sound(class: SoundClass, speed_m_s: f32, variant: u32) -> Vec<f32> {
    Bank::synthesise(class, speed_m_s, variant, RATE_HZ)
}

/// The greatest of the absolute values.
pub fn peak(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |peak, sample| peak.max(sample.abs()))
}

/// Level of the peak, in dB SPL.
pub fn peak_db(samples: &[f32]) -> f32 {
    decibels(peak(samples))
}

/// Level of the root mean square, in dB SPL.
pub fn rms_db(samples: &[f32]) -> f32 {
    let sum: f64 = samples.iter().map(|&x| f64::from(x) * f64::from(x)).sum();
    decibels((sum / samples.len().max(1) as f64).sqrt() as f32)
}

/// Energy by frequency.
pub struct Spectrum {
    bins: Vec<f64>,
    width_hz: f64,
}

impl Spectrum {
    /// Of at least 65 536 samples, zeros behind the end.
    pub fn of(samples: &[f32], rate_hz: f32) -> Spectrum {
        let length = samples.len().next_power_of_two().max(65_536);
        let mut input = samples.to_vec();
        input.resize(length, 0.0);
        let transform = RealFftPlanner::<f32>::new().plan_fft_forward(length);
        let mut output = transform.make_output_vec();
        transform.process(&mut input, &mut output).unwrap();
        let bins = output.iter().map(|bin| f64::from(bin.norm_sqr())).collect();
        Spectrum { bins, width_hz: f64::from(rate_hz) / length as f64 }
    }

    fn lines(&self) -> impl Iterator<Item = (f64, f64)> {
        self.bins.iter().enumerate().map(|(i, energy)| (i as f64 * self.width_hz, *energy))
    }

    /// The energy between two frequencies.
    pub fn between(&self, low_hz: f64, high_hz: f64) -> f64 {
        let inside = self.lines().filter(|(hz, _)| (low_hz..high_hz).contains(hz));
        inside.map(|(_, energy)| energy).sum()
    }

    /// The part of the energy between two frequencies, from 0 to 1.
    pub fn part(&self, low_hz: f64, high_hz: f64) -> f64 {
        self.between(low_hz, high_hz) / self.bins.iter().sum::<f64>()
    }

    /// The mean frequency, weighted by energy [Hz].
    pub fn centroid_hz(&self) -> f64 {
        let moment: f64 = self.lines().map(|(hz, energy)| hz * energy).sum();
        moment / self.bins.iter().sum::<f64>()
    }

    /// The loudest frequency between two [Hz].
    pub fn peak_hz(&self, low_hz: f64, high_hz: f64) -> f64 {
        let inside = self.lines().filter(|(hz, _)| (low_hz..high_hz).contains(hz));
        inside.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0
    }
}

/// The mean frequency of a sound, weighted by energy [Hz].
pub fn centroid_hz(samples: &[f32]) -> f64 {
    Spectrum::of(samples, RATE_HZ).centroid_hz()
}

/// Where the loudness has peaks above `floor` of its greatest [samples]: blows, strokes, bounces.
/// Peaks nearer than `apart` count once.
pub fn blows(samples: &[f32], apart: usize, floor: f32) -> Vec<usize> {
    let width = apart / 4;
    let piece = |piece: &[f32]| piece.iter().map(|x| x.abs()).sum::<f32>();
    let loudness: Vec<f32> = samples.chunks(width).map(piece).collect();
    let least = floor * peak(&loudness);
    let mut blows = Vec::new();
    for (i, &loud) in loudness.iter().enumerate() {
        let before = &loudness[i.saturating_sub(4)..i];
        let after = &loudness[i + 1..(i + 5).min(loudness.len())];
        if loud >= least && loud > peak(before) && loud >= peak(after) {
            blows.push(i * width);
        }
    }
    blows
}
