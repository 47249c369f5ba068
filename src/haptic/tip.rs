//! The tip on its way: a smooth motion that follows the device, as physics gets it.
//!
//! Encoders step by 0.055 mm, which is 55 mm/s at 1 kHz and five times that at the tip. A
//! critically damped spring draws the tip after the device, as it draws it after a mouse: at
//! constant speed it has exactly the speed of the device, two time constants behind, and it never
//! is faster than the device was. The pieces of its path are parabolas that join in place and
//! speed. What the hand feels of things it lies against does not go through this: there every
//! millisecond of delay costs stability.

use crate::physics::spring;
use crate::units::Seconds;
use glam::DVec3;

/// The path.
#[derive(Debug, Clone, Default)]
pub(super) struct Tip {
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
        *self = Tip { at, velocity: DVec3::ZERO, is_laid: true };
    }

    /// Follows `target` over `dt`, drawn with `rate_rad_s`; infinite: exactly and straight.
    pub fn follow(&mut self, target: DVec3, rate_rad_s: f64, dt: Seconds) -> Piece {
        if !self.is_laid {
            self.lay(target);
        }
        let (from, before) = (self.at, self.velocity);
        if !rate_rad_s.is_finite() {
            self.velocity = (target - from) / dt;
            self.at = target;
            return Piece { from, velocity: self.velocity, velocity_end: self.velocity };
        }
        let [_, to_speed] = spring::propagator(rate_rad_s, 1.0, dt);
        self.velocity = to_speed[0] * (from - target) + to_speed[1] * before;
        // The path is the truth: where its parabola ends, the next one begins.
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
    const RATE: f64 = 300.0;

    #[test]
    fn at_constant_speed_the_tip_is_as_fast_as_the_device_two_time_constants_behind() {
        for speed in [0.5, 2.0, 8.0] {
            let mut tip = Tip::default();
            for tick in 0..400 {
                let target = DVec3::X * (speed * f64::from(tick) * 0.001);
                tip.follow(target, RATE, 0.001);
                if tick > 100 {
                    assert!((tip.velocity().x / speed - 1.0).abs() < 1e-6, "{tick}");
                    let behind_s = (target - tip.at()).x / speed;
                    assert!((behind_s - 2.0 / RATE).abs() < 0.000_6, "{behind_s}");
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
                tip.follow(DVec3::X * read, RATE, 0.001);
                if tick > 200 {
                    worst = worst.max((tip.velocity().x / speed - 1.0).abs());
                }
            }
            assert!(worst < 0.02, "{speed}: {worst}");
        }
    }

    #[test]
    fn a_tip_is_never_faster_than_its_device_was() {
        let mut tip = Tip::default();
        let mut x = 0.0;
        for tick in 0..300 {
            // From rest to 5 m/s in 20 ms, and on.
            let speed = (0.25 * f64::from(tick)).min(5.0);
            x += speed * 0.001;
            tip.follow(DVec3::X * x, RATE, 0.001);
            assert!(tip.velocity().x < 5.0 + 1e-9);
        }
        assert!((tip.velocity().x - 5.0).abs() < 1e-9);
    }

    #[test]
    fn pieces_join_in_place_and_speed_and_end_where_they_say() {
        let mut tip = Tip::default();
        let mut last: Option<(DVec3, DVec3)> = None;
        for tick in 0..500 {
            let x = 0.05 * libm::sin(f64::from(tick) * 0.02);
            let dt = if tick % 7 == 0 { 0.0016 } else { 0.001 };
            let piece = tip.follow(DVec3::new(x, 0.3 * x, 0.0), RATE, dt);
            if let Some((at, velocity)) = last {
                assert_eq!((piece.from, piece.velocity), (at, velocity));
            }
            let end = piece.from + 0.5 * (piece.velocity + piece.velocity_end) * dt;
            assert!(end.distance(tip.at()) < 1e-15);
            last = Some((tip.at(), tip.velocity()));
        }
    }
}
