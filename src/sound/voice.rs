//! A sound that was begun: what it gives sample by sample.

mod burst;
mod pulse;
mod resonator;
mod run;
mod synthesis;

use super::bank::{Bank, Clip};
use super::chance::Chance;
use super::filter::Filter;
use super::parameters::{
    AIR_DENSITY_KG_M3, BALL_RADIUS_M, BROADSIDE, RATES_HZ, SILENT_BELOW_M_S, SOUND_SPEED_M_S,
};
use super::{Onset, SoundClass};
use burst::Burst;
use core::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_2, SQRT_2, TAU};
use glam::Vec3;
use pulse::{Pulse, Pulses};
use resonator::Resonator;
use run::Run;

/// The most modes of one sound.
const MODES_MAX: usize = 8;

/// The most bursts of noise of one sound.
const BURSTS_MAX: usize = 4;

/// The last part of every sound fades [s]: nothing ends with a click.
const FADE_S: f32 = 0.005;

/// How long a sphere in air goes on after a contact [s]: its pole is at c/R = 12 000 per second.
const SPHERE_RINGS_S: f32 = 0.004;

/// One sound that was begun: plain data without heap, about 700 bytes.
///
/// It gives the same samples for the same onset, rate and bank, whatever else sounds.
#[derive(Debug, Clone)]
pub struct Voice {
    class: SoundClass,
    axis: Vec3,
    /// The next sample.
    at: u32,
    /// Where the fade begins, and where nothing is left.
    fade: u32,
    end: u32,
    clip: Option<Clip>,
    pulses: Pulses,
    sphere: Sphere,
    modes: [Resonator; MODES_MAX],
    modes_count: u8,
    bursts: [Burst; BURSTS_MAX],
    bursts_count: u8,
    run: Option<Run>,
    chance: Chance,
}

/// A ball that is pushed to and fro in air.
///
/// Far field of a rigid sphere that oscillates along a line through the ear, from the exact
/// solution of the wave equation (dipole; Koss, J. Sound Vib. 36 (1974) 541, for a pair):
/// P(s) = ρ R c s A(s) / (s² + 2 (c/R) s + 2 (c/R)²) at 1 m. A band-pass at 2.70 kHz.
#[derive(Debug, Clone, Copy, Default)]
struct Sphere {
    filter: Filter,
    rate_hz: f32,
    /// From the change of velocity in a sample [m/s] to the input of the filter [Pa].
    gain: f32,
    /// Sounds until this sample.
    until: u32,
    rings: u32,
}

/// Frequency of the band-pass of a ball [Hz].
const SPHERE_HZ: f32 = SQRT_2 * SOUND_SPEED_M_S / (TAU * BALL_RADIUS_M);

impl Sphere {
    fn new(rate_hz: f32) -> Self {
        // ρ R c / ω₀ with ω₀ = √2 c/R; the rate makes the acceleration from a change of velocity.
        let gain = AIR_DENSITY_KG_M3 * BALL_RADIUS_M * BALL_RADIUS_M / SQRT_2 * rate_hz;
        let filter = Filter::new(SPHERE_HZ, FRAC_1_SQRT_2, rate_hz);
        let rings = (SPHERE_RINGS_S * rate_hz) as u32;
        Sphere { filter, rate_hz, gain, until: 0, rings }
    }

    fn next(&mut self, at: u32, change_m_s: f32) -> f32 {
        if change_m_s != 0.0 {
            self.until = at + self.rings;
        } else if self.until <= at {
            self.filter.rest();
            return 0.0;
        }
        self.filter.next(self.gain * change_m_s).band
    }

    /// About the peak that a pulse will give [Pa]: its acceleration, less for one that is longer
    /// than the band-pass answers to.
    fn peak_pa(&self, pulse: &Pulse) -> f32 {
        let frequency = self.rate_hz / (2.0 * (pulse.rise + pulse.fall));
        self.gain * pulse.peak().abs() * (frequency / SPHERE_HZ).min(1.0)
    }
}

impl Voice {
    /// Begins the sound of `onset` at the rate of a stream [Hz]: a recording of `bank`, or, where
    /// it has none, the synthesis.
    ///
    /// Whatever is told, every sample is finite. What has no finite speed, and an impact that is
    /// too slow to be heard, is over at once.
    pub fn begin(onset: &Onset, bank: &Bank, rate_hz: f32) -> Voice {
        let rate_hz = usable_rate(rate_hz);
        match bank.pick(onset) {
            Some(clip) => {
                let mut voice = Voice::empty(onset, rate_hz);
                voice.end = clip.length();
                voice.fade = voice.end;
                voice.clip = Some(clip);
                voice
            }
            None => Voice::synthesised(onset, rate_hz),
        }
    }

    /// The synthesis of `onset`, as [`Voice::begin`] does it without a recording.
    fn synthesised(onset: &Onset, rate_hz: f32) -> Voice {
        let mut voice = Voice::empty(onset, rate_hz);
        synthesis::synthesise(&mut voice, onset, rate_hz);
        voice.close(rate_hz);
        voice
    }

    fn empty(onset: &Onset, rate_hz: f32) -> Voice {
        Voice {
            class: onset.class,
            axis: onset.axis,
            at: 0,
            fade: 0,
            end: 0,
            clip: None,
            pulses: Pulses::default(),
            sphere: Sphere::new(rate_hz),
            modes: [Resonator::default(); MODES_MAX],
            modes_count: 0,
            bursts: [Burst::default(); BURSTS_MAX],
            bursts_count: 0,
            run: None,
            chance: Chance::new(onset.seed, 1),
        }
    }

    /// The next sample: pressure at 1 m, in the direction in which it is loudest [Pa].
    ///
    /// `bank` is the one it was begun with. Zero when it is over.
    pub fn next(&mut self, bank: &Bank) -> f32 {
        if self.end <= self.at {
            return 0.0;
        }
        let pressure_pa = match &self.clip {
            Some(clip) => bank.sample(clip, self.at),
            None => self.synthesis(),
        };
        let at = self.at;
        self.at += 1;
        if at < self.fade {
            pressure_pa
        } else {
            pressure_pa * fading((at - self.fade) as f32 / (self.end - self.fade) as f32)
        }
    }

    /// The next samples, as [`Voice::next`] gives them [Pa].
    pub fn fill(&mut self, bank: &Bank, out: &mut [f32]) {
        out.iter_mut().for_each(|sample| *sample = self.next(bank));
    }

    fn synthesis(&mut self) -> f32 {
        let drive = self.pulses.next(self.at).unwrap_or_default();
        let mut sum = self.sphere.next(self.at, drive.sphere_m_s);
        for mode in &mut self.modes[..usize::from(self.modes_count)] {
            sum += mode.next(drive.modes);
        }
        for burst in &mut self.bursts[..usize::from(self.bursts_count)] {
            sum += burst.next(self.at, &mut self.chance);
        }
        if let Some(run) = &mut self.run {
            sum += run.next(self.at);
        }
        sum
    }

    /// Whether nothing more is to be heard.
    pub fn is_over(&self) -> bool {
        self.end <= self.at
    }

    /// How many samples are still to come.
    pub fn remaining(&self) -> u32 {
        self.end.saturating_sub(self.at)
    }

    /// What makes the sound.
    pub fn class(&self) -> SoundClass {
        self.class
    }

    /// An estimate of the loudest that is still to be heard [Pa], for stealing the quietest.
    /// `bank` is the one it was begun with.
    pub fn loudness(&self, bank: &Bank) -> f32 {
        if self.is_over() {
            return 0.0;
        }
        if let Some(clip) = &self.clip {
            return bank.loudness(clip, self.at);
        }
        let modes = &self.modes[..usize::from(self.modes_count)];
        let bursts = &self.bursts[..usize::from(self.bursts_count)];
        let ringing: f32 = modes.iter().map(Resonator::loudness).sum();
        let noise: f32 = bursts.iter().map(|burst| burst.loudness(self.at)).sum();
        let blows = self.pulses.coming().iter();
        let coming = blows.map(|pulse| {
            let length = pulse.rise + pulse.fall;
            let struck: f32 = modes.iter().map(|mode| mode.answer(length)).sum();
            self.sphere.peak_pa(pulse) + struck * pulse.modes.abs()
        });
        let runs = self.run.as_ref().map_or(0.0, Run::loudness);
        ringing + noise + runs + coming.fold(0.0, f32::max)
    }

    /// The factor for an ear in the direction `to_ear`, a unit vector from the sound.
    ///
    /// Two balls, or a ball at a tip, sound along the line of the impact, equally to both sides;
    /// beside it only what the table throws back is heard. A sound without an axis is the same all
    /// round: for a click the mean over all directions.
    pub fn directivity(&self, to_ear: Vec3) -> f32 {
        if !matches!(self.class, SoundClass::BallClick | SoundClass::CueStrike) {
            return 1.0;
        }
        let floor = BROADSIDE * BROADSIDE;
        let cos = self.axis.dot(to_ear);
        let known = cos.is_finite() && self.axis.length_squared() > 0.5;
        let cos_squared = if known { (cos * cos).min(1.0) } else { 1.0 / 3.0 };
        (floor + (1.0 - floor) * cos_squared).sqrt()
    }

    fn push_mode(&mut self, mode: Resonator) {
        let count = usize::from(self.modes_count);
        if count < MODES_MAX {
            self.modes[count] = mode;
            self.modes_count += 1;
        }
    }

    fn push_burst(&mut self, burst: Burst) {
        let count = usize::from(self.bursts_count);
        if count < BURSTS_MAX {
            self.bursts[count] = burst;
            self.bursts_count += 1;
        }
    }

    /// Lets the sound last until sample `end`, if it does not last longer.
    fn last_until(&mut self, end: f32) {
        self.end = self.end.max(end.max(0.0) as u32);
    }

    /// Puts the fade at the end.
    fn close(&mut self, rate_hz: f32) {
        let fade = (FADE_S * rate_hz) as u32;
        self.fade = self.end;
        if self.end > 0 {
            self.end += fade;
        }
    }
}

/// Whether anything of an onset is to be heard: its speed is a finite number, and that of an impact
/// not too low.
pub(super) fn is_heard(onset: &Onset) -> bool {
    let least = if onset.class.is_impact() { SILENT_BELOW_M_S } else { 0.0 };
    onset.speed_m_s.is_finite() && onset.speed_m_s >= least
}

/// From 1 to 0 while `part` goes from 0 to 1, flat at both ends.
fn fading(part: f32) -> f32 {
    let cos = libm::cosf(FRAC_PI_2 * part);
    cos * cos
}

/// A rate that sounds can be made for [Hz].
pub(super) fn usable_rate(rate_hz: f32) -> f32 {
    if rate_hz.is_nan() { 48_000.0 } else { rate_hz.clamp(RATES_HZ[0], RATES_HZ[1]) }
}
