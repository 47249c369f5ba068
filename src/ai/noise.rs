//! How strokes err.

use crate::cue::Aim;
use rand::{Rng, RngExt};

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// No stroke becomes slower than this by its error [m/s].
const SPEED_LEAST_M_S: f64 = 0.1;

/// Standard deviations of a stroke's five parameters; each errs by itself, normally distributed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeNoise {
    /// Contact point of the tip, sideways and upwards alike [m].
    pub offset_m: f64,
    /// Elevation of the cue [rad].
    pub elevation_rad: f64,
    /// Azimuth of the stroke [rad].
    pub azimuth_rad: f64,
    /// Speed of the tip [m/s].
    pub speed_m_s: f64,
}

impl StrokeNoise {
    /// The Computer Pool Olympiad's: 0.5 mm, 0.1°, 0.125°, 0.075 m/s (Archibald, Altman,
    /// Greenspan and Shoham 2010; FastFiz).
    pub const OLYMPIAD: StrokeNoise = StrokeNoise {
        offset_m: 0.0005,
        elevation_rad: 0.1 * DEGREE,
        azimuth_rad: 0.125 * DEGREE,
        speed_m_s: 0.075,
    };

    /// A perfect arm.
    pub const NONE: StrokeNoise =
        StrokeNoise { offset_m: 0.0, elevation_rad: 0.0, azimuth_rad: 0.0, speed_m_s: 0.0 };

    /// The Olympiad's, so many times as large.
    pub fn olympiad(times: f64) -> Self {
        let StrokeNoise { offset_m, elevation_rad, azimuth_rad, speed_m_s } = Self::OLYMPIAD;
        StrokeNoise {
            offset_m: times * offset_m,
            elevation_rad: times * elevation_rad,
            azimuth_rad: times * azimuth_rad,
            speed_m_s: times * speed_m_s,
        }
    }

    /// Whether strokes do not err at all.
    pub fn is_none(&self) -> bool {
        *self == Self::NONE
    }

    /// One stroke's error: `aim` and the tip's speed [m/s] as they come out. A perfect arm draws
    /// nothing.
    pub fn err(
        &self,
        aim: Aim,
        speed_m_s: f64,
        ball_radius_m: f64,
        rng: &mut impl Rng,
    ) -> (Aim, f64) {
        if self.is_none() {
            return (aim, speed_m_s);
        }
        let mut error = |sigma: f64| sigma * normal(rng);
        let side_offset = aim.side_offset + error(self.offset_m / ball_radius_m);
        let height_offset = aim.height_offset + error(self.offset_m / ball_radius_m);
        let elevation_rad = (aim.elevation_rad + error(self.elevation_rad)).max(0.0);
        let azimuth_rad = aim.azimuth_rad + error(self.azimuth_rad);
        let speed_m_s = (speed_m_s + error(self.speed_m_s)).max(SPEED_LEAST_M_S);
        (Aim { azimuth_rad, elevation_rad, side_offset, height_offset }, speed_m_s)
    }
}

/// A number from the standard normal distribution (Box and Muller 1958).
pub(crate) fn normal(rng: &mut impl Rng) -> f64 {
    let (u, angle): (f64, f64) = (rng.random(), rng.random());
    // 1 − u lies in (0, 1], so that the logarithm exists.
    (-2.0 * libm::log(1.0 - u)).sqrt() * libm::cos(std::f64::consts::TAU * angle)
}
