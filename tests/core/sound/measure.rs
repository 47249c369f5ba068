//! Spectra and levels of samples.

use hapticbillard::sound::level::decibels;
use realfft::RealFftPlanner;

/// The greatest of the absolute values.
pub fn peak(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |peak, sample| peak.max(sample.abs()))
}

/// Level of the peak, in dB SPL.
pub fn peak_db(samples: &[f32]) -> f32 {
    decibels(peak(samples))
}

/// Root mean square.
pub fn rms(samples: &[f32]) -> f32 {
    let sum: f64 = samples.iter().map(|&x| f64::from(x) * f64::from(x)).sum();
    (sum / samples.len().max(1) as f64).sqrt() as f32
}

/// Energy by frequency, one value per bin, and the width of a bin [Hz]; at least 8192 samples,
/// zeros behind the end.
pub fn spectrum(samples: &[f32], rate_hz: f32) -> (Vec<f64>, f64) {
    let length = samples.len().next_power_of_two().max(8192);
    let mut input = samples.to_vec();
    input.resize(length, 0.0);
    let transform = RealFftPlanner::<f32>::new().plan_fft_forward(length);
    let mut output = transform.make_output_vec();
    transform.process(&mut input, &mut output).unwrap();
    let energy = output.iter().map(|bin| f64::from(bin.norm_sqr())).collect();
    (energy, f64::from(rate_hz) / length as f64)
}

/// The mean frequency, weighted by energy [Hz].
pub fn centroid_hz(samples: &[f32], rate_hz: f32) -> f64 {
    let (energy, width_hz) = spectrum(samples, rate_hz);
    let sum: f64 = energy.iter().sum();
    let moment: f64 = energy.iter().enumerate().map(|(i, e)| i as f64 * width_hz * e).sum();
    moment / sum
}

/// The part of the energy between two frequencies, from 0 to 1.
pub fn part_between(samples: &[f32], rate_hz: f32, low_hz: f64, high_hz: f64) -> f64 {
    let (energy, width_hz) = spectrum(samples, rate_hz);
    let inside = |i: usize| (low_hz..high_hz).contains(&(i as f64 * width_hz));
    let part: f64 = energy.iter().enumerate().filter(|(i, _)| inside(*i)).map(|(_, e)| e).sum();
    part / energy.iter().sum::<f64>()
}
