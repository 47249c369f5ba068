//! The head: a sphere with an ear on either side.

use super::{Listener, Mode};
use crate::sound::filter::TINY;
use crate::sound::parameters::SOUND_SPEED_M_S;
use glam::Vec3;

/// Radius of the head [m] (Woodworth 1938; Kuhn 1977).
pub const HEAD_M: f32 = 0.0875;
/// Nothing is heard louder than from here [m].
pub const NEAR_M: f32 = 0.3;
/// Angle from the ear's axis at which the shadow is deepest [rad] (Brown and Duda 1998).
const DEEPEST_RAD: f32 = 150.0 / 180.0 * std::f32::consts::PI;

/// What one ear gets of a source.
#[derive(Debug, Clone, Copy)]
pub struct Arrival {
    /// Length of the way to it [m].
    pub path_m: f32,
    /// Factor on the pressure at 1 m.
    pub gain: f32,
    /// Zero of the head's shadow over its pole: 2 towards the ear, 0.1 in the deepest shadow, 1 for
    /// no shadow at all.
    pub alpha: f32,
}

/// What the left and the right ear get of a source.
///
/// A source mirrored at the median plane gives the same numbers, bit for bit, with the ears
/// swapped.
pub fn arrivals(listener: &Listener, mode: Mode, source_m: Vec3) -> [Arrival; 2] {
    let to_source = source_m - listener.position_m;
    let distance_m = to_source.length().max(HEAD_M);
    // Sine of the azimuth: 1 on the right.
    let lateral = (to_source.dot(listener.right) / distance_m).clamp(-1.0, 1.0);
    match mode {
        Mode::Headphones => [-lateral, lateral].map(|towards| at_ear(distance_m, towards)),
        Mode::Loudspeakers => [-lateral, lateral].map(|towards| panned(distance_m, towards)),
    }
}

/// On a sphere: straight to an ear in sight, round the head to the other one.
///
/// For a far source the difference of the two ways is a (θ + sin θ), θ the azimuth (Woodworth
/// 1938): 0.656 ms from the side. The shadow is α(γ) = 1.05 + 0.95 cos(γ 180°/150°), γ from the
/// axis of the ear (Brown and Duda 1998). `towards` is cos γ.
fn at_ear(distance_m: f32, towards: f32) -> Arrival {
    let sight = HEAD_M / distance_m;
    let angle = libm::acosf(towards);
    let path_m = if towards >= sight {
        let squared = distance_m * distance_m - 2.0 * HEAD_M * distance_m * towards;
        (squared + HEAD_M * HEAD_M).max(0.0).sqrt()
    } else {
        let tangent_m = (distance_m * distance_m - HEAD_M * HEAD_M).max(0.0).sqrt();
        tangent_m + HEAD_M * (angle - libm::acosf(sight))
    };
    let alpha = 1.05 + 0.95 * libm::cosf(angle * std::f32::consts::PI / DEEPEST_RAD);
    Arrival { path_m, gain: 1.0 / path_m.max(NEAR_M), alpha }
}

/// Between two loudspeakers: the powers of both sum up to the same everywhere.
fn panned(distance_m: f32, towards: f32) -> Arrival {
    let share = ((1.0 + towards) / 2.0).sqrt();
    Arrival { path_m: distance_m, gain: share / distance_m.max(NEAR_M), alpha: 1.0 }
}

/// The shadow of the head as a filter of one pole and one zero:
/// H = (1 + jωα/2ω₀) / (1 + jω/2ω₀), ω₀ = c/a (Brown and Duda 1998), by the bilinear transform.
#[derive(Debug, Clone, Copy, Default)]
pub struct Shadow {
    b0: f32,
    b1: f32,
    a1: f32,
    x1: f32,
    y1: f32,
}

impl Shadow {
    /// Silent so far.
    pub fn new(alpha: f32, rate_hz: f32) -> Shadow {
        let mut shadow = Shadow { a1: 0.0, ..Shadow::default() };
        shadow.turn(alpha, rate_hz);
        shadow
    }

    /// Another α; what rings goes on. The pole does not depend on it.
    pub fn turn(&mut self, alpha: f32, rate_hz: f32) {
        let k = pole_frames(rate_hz);
        self.b0 = (1.0 + alpha * k) / (1.0 + k);
        self.b1 = (1.0 - alpha * k) / (1.0 + k);
        self.a1 = (1.0 - k) / (1.0 + k);
    }

    /// In place.
    pub fn apply(&mut self, samples: &mut [f32]) {
        let Shadow { b0, b1, a1, mut x1, mut y1 } = *self;
        for sample in samples {
            let x = *sample;
            y1 = b0 * x + b1 * x1 - a1 * y1 + TINY;
            x1 = x;
            *sample = y1;
        }
        (self.x1, self.y1) = (x1, y1);
    }
}

/// Rate over ω₀: twice the time constant of the shadow [frames].
pub fn pole_frames(rate_hz: f32) -> f32 {
    rate_hz * HEAD_M / SOUND_SPEED_M_S
}

/// The shadow as one number, for sound that needs no more: |H| at ω = 2ω₀, 1.25 kHz.
pub fn shadow_gain(alpha: f32) -> f32 {
    ((1.0 + alpha * alpha) / 2.0).sqrt()
}
