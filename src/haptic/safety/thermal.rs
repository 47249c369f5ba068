//! Stage 6: motors bear a large force only for a while.

use crate::units::Seconds;
use glam::DVec3;

/// Share of the budget at which the force begins to be held back.
const NEAR: f64 = 0.9;

/// Mean square of the force over the time constant of the motors' heat.
#[derive(Debug, Clone, Default)]
pub(super) struct Thermal {
    square: f64,
}

impl Thermal {
    /// Root mean square of the force [N].
    pub fn rms_n(&self) -> f64 {
        self.square.max(0.0).sqrt()
    }

    /// `wanted`, held to what the motors bear for ever once they are as warm as that makes them;
    /// from [`NEAR`] on between that and `most_n`.
    pub fn held_back(&self, wanted: DVec3, limit_n: f64, most_n: f64) -> (DVec3, bool) {
        let heat = self.rms_n() / limit_n;
        if !(heat > NEAR) {
            return (wanted, false);
        }
        let most_n = most_n.min(1e6).max(limit_n);
        let cap_n = most_n + (limit_n - most_n) * ((heat - NEAR) / (1.0 - NEAR)).min(1.0);
        (wanted.clamp_length_max(cap_n), wanted.length() > cap_n)
    }

    /// What was sent is felt by the motors.
    pub fn took(&mut self, force: DVec3, dt: Seconds, time_constant_s: Seconds) {
        let share = (dt / time_constant_s).min(1.0);
        self.square += (force.length_squared() - self.square) * share;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lasting_push_sinks_to_what_the_motors_bear() {
        let mut thermal = Thermal::default();
        let mut sent = Vec::new();
        for _ in 0..120_000 {
            let (force, _) = thermal.held_back(DVec3::X * 3.3, 0.88, 3.3);
            thermal.took(force, 0.001, 20.0);
            sent.push(force.x);
        }
        // 3.3 N reach the budget of 0.88 N rms after 20 s · −ln(1 − (0.9 · 0.88/3.3)²) = 1.19 s.
        assert!(sent[..1_150].iter().all(|force| *force == 3.3));
        assert!(sent[1_250] < 3.3);
        assert!(thermal.rms_n() <= 0.881, "{}", thermal.rms_n());
        assert!((sent[119_999] - 0.88).abs() < 0.02, "{}", sent[119_999]);
    }

    #[test]
    fn a_light_touch_is_never_held_back() {
        let mut thermal = Thermal::default();
        for _ in 0..100_000 {
            assert_eq!(thermal.held_back(DVec3::X * 0.7, 0.88, 3.3), (DVec3::X * 0.7, false));
            thermal.took(DVec3::X * 0.7, 0.001, 20.0);
        }
    }
}
