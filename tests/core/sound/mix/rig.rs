//! Set-up and measures of the mixer's tests.

use glam::Vec3;
use hapticbillard::ids::BallId;
use hapticbillard::sound::{
    Bank, Listener, MixSettings, Mixer, Mode, Onset, Rolling, Room, SoundClass,
};
use std::sync::Arc;

/// Frames a second of most tests [Hz].
pub const RATE_HZ: f32 = 48_000.0;
/// Speed of sound [m/s].
pub const SOUND_M_S: f32 = 343.0;
/// A head at the origin that looks along +y.
pub const HEAD: Listener = Listener { position_m: Vec3::ZERO, right: Vec3::X };

/// An open field, headphones, the head at the origin.
pub fn field() -> Mixer {
    with(MixSettings::default())
}

/// The cellar round the head.
pub fn cellar() -> Mixer {
    with(MixSettings { room: Some(Room::CELLAR), ..MixSettings::default() })
}

/// Two loudspeakers in an open field.
pub fn loudspeakers() -> Mixer {
    with(MixSettings { mode: Mode::Loudspeakers, ..MixSettings::default() })
}

/// A mixer for which a ball's click is a single sample: what it does to a sound, as it is.
pub fn impulses() -> Mixer {
    let mut samples = vec![0.0; 2_000];
    samples[0] = 1.0;
    // A recording is freed of its mean, and faded at its end.
    samples[1_999] = -1.0;
    let mut bank = Bank::default();
    bank.insert(SoundClass::BallClick, 1.0, &samples, RATE_HZ).unwrap();
    let mut mixer = Mixer::new(MixSettings::default(), Arc::new(bank));
    mixer.set_listener(HEAD);
    mixer
}

/// The head at the origin.
pub fn with(settings: MixSettings) -> Mixer {
    let mut mixer = Mixer::new(settings, Arc::new(Bank::default()));
    mixer.set_listener(HEAD);
    mixer
}

/// A click that sends alike to all sides of its place.
pub fn click(position_m: Vec3, speed_m_s: f32) -> Onset {
    Onset {
        time_s: 0.0,
        class: SoundClass::BallClick,
        speed_m_s,
        position_m,
        axis: Vec3::ZERO,
        seed: 7,
    }
}

/// A ball that rolls.
pub fn rolling(ball: u16, position_m: Vec3, velocity_m_s: Vec3) -> Rolling {
    Rolling { ball: BallId(ball), radius_m: 0.028_575, position_m, velocity_m_s, slip_m_s: 0.0 }
}

/// The next frames.
pub fn hear(mixer: &mut Mixer, frames: usize) -> Vec<[f32; 2]> {
    let mut out = vec![[0.0; 2]; frames];
    mixer.mix(&mut out);
    out
}

/// What is heard of one click, from its beginning.
pub fn heard(mixer: &mut Mixer, onset: &Onset) -> Vec<[f32; 2]> {
    mixer.start(mixer.frame(), onset);
    hear(mixer, 4_096)
}

/// One of the two channels.
pub fn channel(heard: &[[f32; 2]], ear: usize) -> Vec<f32> {
    heard.iter().map(|frame| frame[ear]).collect()
}

/// Largest of all samples.
pub fn peak(samples: &[f32]) -> f32 {
    samples.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Sum of all squares.
pub fn energy(samples: &[f32]) -> f64 {
    samples.iter().map(|x| f64::from(*x) * f64::from(*x)).sum()
}

/// Decibels of a ratio of amplitudes.
pub fn decibel(ratio: f64) -> f64 {
    20.0 * libm::log10(ratio)
}

/// By how many frames `b` is later than `a`, at most `lag_max`: the peak of the correlation, with
/// a parabola through it.
pub fn lag(a: &[f32], b: &[f32], lag_max: i64) -> f64 {
    let correlation = |lag: i64| -> f64 {
        let at = |i: usize| usize::try_from(i as i64 + lag).ok().and_then(|j| b.get(j));
        let products = a.iter().enumerate().filter_map(|(i, x)| Some(f64::from(*x * at(i)?)));
        products.sum()
    };
    let all: Vec<f64> = (-lag_max..=lag_max).map(correlation).collect();
    let best = (1..all.len() - 1).max_by(|i, j| all[*i].total_cmp(&all[*j])).unwrap();
    let (before, at, after) = (all[best - 1], all[best], all[best + 1]);
    best as f64 - lag_max as f64 + (before - after) / (2.0 * (before - 2.0 * at + after))
}

/// Steepest step from one sample to the next.
pub fn steepest(samples: &[f32]) -> f32 {
    samples.windows(2).fold(0.0, |most, pair| most.max((pair[1] - pair[0]).abs()))
}
