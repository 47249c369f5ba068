//! A ball that rolls or slides, as long as it moves.

use super::Rolling;
use super::chance::Chance;
use super::filter::Filter;
use super::level::{factor, pascal};
use super::parameters::{ROLLING, Rumble, SPEED_MAX_M_S};
use super::voice::usable_rate;
use core::f32::consts::{FRAC_1_SQRT_2, PI, TAU};

/// Filters and gains follow speed and slip once in so many samples.
const BLOCK: u32 = 32;

/// How fast the sound follows what it is told [s].
const FOLLOW_S: f32 = 0.01;

/// Quality of each of the two band-passes in series.
const QUALITY: f32 = 1.0;

/// The sound of one ball on the move: noise that is formed by speed and slip.
///
/// Plain data without heap. It never ends; a ball at rest is silent and costs nothing.
#[derive(Debug, Clone)]
pub struct RollingVoice {
    row: &'static Rumble,
    rate_hz: f32,
    radius_m: f32,
    /// What was told.
    told: [f32; 2],
    /// Speed and slip as they are heard now [m/s].
    heard: [f32; 2],
    bands: [Filter; 2],
    hiss: [Filter; 2],
    /// Gains of rumble and hiss now, and how they change per sample.
    gains: [f32; 2],
    slopes: [f32; 2],
    /// Of rumble and hiss at 1 m/s [Pa].
    level_pa: [f32; 2],
    /// Gain of the noise in the band of the hiss to a root mean square of 1.
    hiss_norm: f32,
    /// How far the ball has turned [rad].
    turned: f32,
    /// The part of the way to what was told that is made in one block.
    follow: f32,
    /// Samples until the next look at speed and slip.
    left: u32,
    chance: Chance,
}

impl RollingVoice {
    /// A ball at rest. `radius_m`: the beat of a turn; `seed`: the noise; `rate_hz`: of the stream.
    pub fn new(radius_m: f32, seed: u32, rate_hz: f32) -> RollingVoice {
        Self::over(&ROLLING, radius_m, seed, rate_hz)
    }

    /// The same over another ground.
    pub(super) fn over(
        row: &'static Rumble,
        radius_m: f32,
        seed: u32,
        rate_hz: f32,
    ) -> RollingVoice {
        let rate_hz = usable_rate(rate_hz);
        let width = (row.hiss_hz[1] - row.hiss_hz[0]) / (0.5 * rate_hz);
        RollingVoice {
            row,
            rate_hz,
            radius_m: if radius_m > 1e-3 { radius_m } else { 1e-3 },
            told: [0.0; 2],
            heard: [0.0; 2],
            bands: [Filter::default(); 2],
            hiss: [
                Filter::new(row.hiss_hz[0], FRAC_1_SQRT_2, rate_hz),
                Filter::new(row.hiss_hz[1], FRAC_1_SQRT_2, rate_hz),
            ],
            gains: [0.0; 2],
            slopes: [0.0; 2],
            level_pa: [pascal(row.level_db), pascal(row.hiss_db)],
            hiss_norm: 1.0 / (width / 3.0).sqrt(),
            turned: 0.0,
            follow: 1.0 - libm::expf(-(BLOCK as f32) / (FOLLOW_S * rate_hz)),
            left: 0,
            chance: Chance::new(seed, 2),
        }
    }

    /// Tells how the ball moves now; its sound follows within some 10 ms. What is no finite number
    /// counts as 0.
    pub fn tell(&mut self, rolling: &Rolling) {
        self.set(rolling.velocity_m_s.length(), rolling.slip_m_s);
    }

    /// Sets speed and slip [m/s].
    pub(super) fn set(&mut self, speed_m_s: f32, slip_m_s: f32) {
        let usable = |speed: f32| {
            if speed.is_finite() { speed.clamp(0.0, SPEED_MAX_M_S) } else { 0.0 }
        };
        self.told = [usable(speed_m_s), usable(slip_m_s)];
    }

    /// The next sample: pressure at 1 m [Pa].
    pub fn next(&mut self) -> f32 {
        if self.left == 0 {
            self.look();
        }
        self.left -= 1;
        if self.is_silent() {
            return 0.0;
        }
        self.gains[0] += self.slopes[0];
        self.gains[1] += self.slopes[1];
        let noise = self.chance.noise();
        let [first, second] = &mut self.bands;
        let rumble = second.next(first.next(noise).band).band;
        let [low_cut, high_cut] = &mut self.hiss;
        let hiss = high_cut.next(low_cut.next(noise).high).low;
        self.gains[0] * rumble + self.gains[1] * hiss
    }

    /// The next samples [Pa].
    pub fn fill(&mut self, out: &mut [f32]) {
        out.iter_mut().for_each(|sample| *sample = self.next());
    }

    /// Whether nothing is heard of it now.
    pub fn is_silent(&self) -> bool {
        self.gains == [0.0; 2] && self.slopes == [0.0; 2]
    }

    /// How loud it is now, root mean square at 1 m [Pa].
    pub fn loudness(&self) -> f32 {
        let (rumble, hiss) = self.levels();
        (rumble * rumble + hiss * hiss).sqrt()
    }

    /// Root mean square of rumble and hiss [Pa].
    fn levels(&self) -> (f32, f32) {
        let [speed, slip] = self.heard;
        let sliding = factor(self.row.sliding_db * (slip / Rumble::SLIDING_M_S).min(1.0));
        let rumble = self.level_pa[0] * libm::powf(speed, self.row.speed_exponent) * sliding;
        (rumble, self.level_pa[1] * slip)
    }

    /// Sets filters and gains for the next block.
    fn look(&mut self) {
        self.left = BLOCK;
        let dt_s = BLOCK as f32 / self.rate_hz;
        for (heard, told) in self.heard.iter_mut().zip(self.told) {
            *heard += self.follow * (told - *heard);
            // Far below hearing.
            if *heard < 1e-4 && told == 0.0 {
                *heard = 0.0;
            }
        }
        let speed = self.heard[0];
        let [low, high] = self.row.centres_hz;
        let centre_hz = (self.row.centre_hz * speed).clamp(low, high);
        self.bands.iter_mut().for_each(|band| band.set(centre_hz, QUALITY, self.rate_hz));

        self.turned = (self.turned + speed / self.radius_m * dt_s) % TAU;
        let beat = 1.0 + self.row.modulation * libm::sinf(self.turned);

        let (rumble, hiss) = self.levels();
        let goals = [beat * rumble * self.norm(centre_hz), hiss * self.hiss_norm];
        for ((gain, slope), goal) in self.gains.iter_mut().zip(&mut self.slopes).zip(goals) {
            // Rounding must not leave a rest of a sound that has ended.
            if goal == 0.0 && *slope <= 0.0 && *gain <= -*slope * BLOCK as f32 {
                *gain = 0.0;
            }
            *slope = (goal - *gain) / BLOCK as f32;
        }
    }

    /// The gain that brings the noise behind both band-passes to a root mean square of 1: white
    /// noise of variance 1/3, and ∫|H|⁴ df = π f₀/(4Q) for the square of a band-pass of gain 1.
    fn norm(&self, centre_hz: f32) -> f32 {
        let width_hz = PI * centre_hz / (4.0 * QUALITY);
        1.0 / (width_hz / (0.5 * self.rate_hz) / 3.0).sqrt()
    }
}
