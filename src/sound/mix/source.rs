//! What sounds: a voice that is reckoned, made safe to be mixed.

use crate::sound::{Onset, Rolling};
use glam::Vec3;

/// A sound that begins, at 1 m.
#[derive(Debug, Clone)]
pub struct Source {
    axis: Vec3,
    level: f32,
    frame: u32,
    length: u32,
}

impl Source {
    /// Its beginning.
    pub fn begin(onset: &Onset, rate_hz: f32) -> Source {
        let length = (300e-6 * rate_hz) as u32;
        Source { axis: onset.axis, level: onset.speed_m_s * 3.0, frame: 0, length }
    }

    /// The next samples [Pa].
    pub fn fill(&mut self, out: &mut [f32]) {
        for x in out.iter_mut() {
            let t = self.frame as f32 / self.length as f32;
            *x = if t < 1.0 { self.level * libm::sinf(t * std::f32::consts::TAU) } else { 0.0 };
            self.frame += 1;
        }
        out.iter_mut().for_each(|x| *x = clean(*x));
    }

    /// Whether all of it was said.
    pub fn is_over(&self) -> bool {
        self.frame >= self.length
    }

    /// What is still to be said [Pa].
    pub fn loudness(&self) -> f32 {
        if self.is_over() { 0.0 } else { self.level }
    }

    /// Factor of what is sent along a unit vector.
    pub fn directivity(&self, to_ear: Vec3) -> f32 {
        self.axis.dot(to_ear).abs().max(0.25)
    }
}

/// A ball that rolls, at 1 m.
#[derive(Debug, Clone)]
pub struct RollingSource {
    state: u32,
    speed_m_s: f32,
}

impl RollingSource {
    /// Silent.
    pub fn new(_rate_hz: f32) -> RollingSource {
        RollingSource { state: 1, speed_m_s: 0.0 }
    }

    /// Its beginning.
    pub fn begin(rolling: &Rolling, rate_hz: f32) -> RollingSource {
        let mut source = RollingSource::new(rate_hz);
        source.state = u32::from(rolling.ball.0) * 77 + 1;
        source.tell(rolling);
        source
    }

    /// How it rolls now.
    pub fn tell(&mut self, rolling: &Rolling) {
        self.speed_m_s = rolling.velocity_m_s.length();
    }

    /// The next samples [Pa].
    pub fn fill(&mut self, out: &mut [f32]) {
        for x in out {
            self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *x = clean(0.02 * self.speed_m_s * (self.state >> 8) as f32 / 16_777_216.0);
        }
    }
}

/// Louder than any explosion [Pa]: whatever says so is wrong.
const PRESSURE_MAX_PA: f32 = 1e6;
/// Softer than anything heard by a factor of a million [Pa].
const PRESSURE_MIN_PA: f32 = 1e-11;

/// Neither NaN nor infinity nor a number that is slow to reckon with.
fn clean(x: f32) -> f32 {
    if (PRESSURE_MIN_PA..PRESSURE_MAX_PA).contains(&x.abs()) { x } else { 0.0 }
}
