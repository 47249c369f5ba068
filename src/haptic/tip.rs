//! The tip on its way: a smooth motion that follows the device, as physics gets it.
//!
//! Encoders step by 0.055 mm, which is 55 mm/s at 1 kHz and five times that at the tip. A
//! critically damped tracker (g-h filter) takes that out and has no lag at constant speed; the path
//! of the tip then is drawn to the tracker slowly, so that its speed stays as smooth. Its pieces
//! are parabolas that join in place and speed.

use crate::units::Seconds;
use glam::DVec3;

/// Rate at which the path is drawn to the tracker [1/s].
const DRAWN_1_S: f64 = 50.0;

/// The tracker, and the path.
#[derive(Debug, Clone, Default)]
pub(super) struct Tip {
    tracked: DVec3,
    tracked_velocity: DVec3,
    at: DVec3,
    velocity: DVec3,
    is_laid: bool,
}

/// A parabola of one tick.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Where and how fast it begins [m, m/s].
    pub from: DVec3,
    /// See above.
    pub velocity: DVec3,
    /// How fast it ends [m/s].
    pub velocity_end: DVec3,
}

impl Tip {
    /// Centre [m].
    pub fn at(&self) -> DVec3 {
        self.at
    }

    /// Velocity [m/s].
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// Rests at a place.
    pub fn lay(&mut self, at: DVec3) {
        *self = Tip { tracked: at, at, is_laid: true, ..Tip::default() };
    }

    /// Follows `target` over `dt`, with a tracker of rate `rate_rad_s`; infinite: exactly.
    pub fn follow(&mut self, target: DVec3, rate_rad_s: f64, dt: Seconds) -> Piece {
        if !self.is_laid {
            self.lay(target);
        }
        let (from, before) = (self.at, self.velocity);
        let ahead = self.tracked + self.tracked_velocity * dt;
        let off = target - ahead;
        let theta = libm::exp(-rate_rad_s * dt);
        self.tracked = ahead + off * (1.0 - theta * theta);
        self.tracked_velocity += off * ((1.0 - theta) * (1.0 - theta) / dt);

        let drawn = (DRAWN_1_S * dt).min(1.0) / dt;
        let expected = from + 0.5 * (before + self.tracked_velocity) * dt;
        self.velocity = self.tracked_velocity + (self.tracked - expected) * drawn;
        self.at = from + 0.5 * (before + self.velocity) * dt;
        Piece { from, velocity: before, velocity_end: self.velocity }
    }

    /// Something fixed was in the way: the tip is at `at` instead, and does not move into it.
    pub fn held(&mut self, at: DVec3, normal: DVec3) {
        self.at = at;
        self.velocity -= normal * self.velocity.dot(normal).min(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of an Omni's encoder on a tip five times as fast [m].
    const STEP_M: f64 = 5.0 * 5.5e-5;

    #[test]
    fn at_constant_speed_the_tip_is_where_the_device_is() {
        for speed in [0.5, 2.0, 8.0] {
            let mut tip = Tip::default();
            for tick in 0..400 {
                let target = DVec3::X * (speed * f64::from(tick) * 0.001);
                tip.follow(target, 300.0, 0.001);
                if tick > 200 {
                    assert!(tip.at().distance(target) < 1e-4 * speed, "{tick}");
                    assert!((tip.velocity().x / speed - 1.0).abs() < 1e-4);
                }
            }
        }
    }

    #[test]
    fn steps_of_the_encoder_hardly_show_in_the_speed() {
        for speed in [1.0, 2.3, 5.7] {
            let mut tip = Tip::default();
            let mut worst = 0.0_f64;
            for tick in 0..2_000 {
                let x = speed * f64::from(tick) * 0.001;
                let read = libm::floor(x / STEP_M) * STEP_M;
                tip.follow(DVec3::X * read, 300.0, 0.001);
                if tick > 200 {
                    worst = worst.max((tip.velocity().x / speed - 1.0).abs());
                }
            }
            assert!(worst < 0.03, "{speed}: {worst}");
        }
    }

    #[test]
    fn pieces_join_in_place_and_speed_and_end_where_they_say() {
        let mut tip = Tip::default();
        let mut last: Option<(DVec3, DVec3)> = None;
        for tick in 0..500 {
            let x = 0.05 * libm::sin(f64::from(tick) * 0.02);
            let dt = if tick % 7 == 0 { 0.0016 } else { 0.001 };
            let piece = tip.follow(DVec3::new(x, 0.3 * x, 0.0), 300.0, dt);
            if let Some((at, velocity)) = last {
                assert_eq!((piece.from, piece.velocity), (at, velocity));
            }
            let end = piece.from + 0.5 * (piece.velocity + piece.velocity_end) * dt;
            assert!(end.distance(tip.at()) < 1e-15);
            last = Some((tip.at(), tip.velocity()));
        }
    }
}
