//! Stage 2: a world that says nothing new fades out, and comes back as softly.

use crate::units::Seconds;

/// How old the world is, and how much of it is felt.
#[derive(Debug, Clone)]
pub(super) struct Stale {
    serial: Option<u64>,
    age_s: Seconds,
    gain: f64,
}

impl Stale {
    pub fn new() -> Self {
        Stale { serial: None, age_s: 0.0, gain: 1.0 }
    }

    /// The share of the force that is felt after `dt`: one until the scene with this serial number
    /// is older than `limit_s`, then falling to zero in `fade_s`.
    pub fn gain(&mut self, serial: u64, dt: Seconds, limit_s: Seconds, fade_s: Seconds) -> f64 {
        if self.serial == Some(serial) {
            self.age_s += dt;
        } else {
            (self.serial, self.age_s) = (Some(serial), 0.0);
        }
        let over_s = self.age_s - limit_s;
        let step = if fade_s > 0.0 { dt / fade_s } else { 1.0 };
        self.gain = if over_s > 0.0 {
            // The first tick over the limit counts only for what is over it.
            self.gain - step * (over_s / dt).min(1.0)
        } else {
            self.gain + step
        };
        self.gain = self.gain.clamp(0.0, 1.0);
        self.gain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_silent_world_is_gone_70_ms_later_and_back_in_50() {
        let mut stale = Stale::new();
        let mut gain = |serial| stale.gain(serial, 0.001, 0.020, 0.050);
        for serial in 0..100 {
            assert_eq!(gain(serial), 1.0);
        }
        let fading: Vec<f64> = (0..80).map(|_| gain(99)).collect();
        // The scene is 1 ms old at the first of these.
        assert!(fading[19] > 1.0 - 1e-9);
        assert!((fading[44] - 0.5).abs() < 1e-9, "{}", fading[44]);
        assert!(fading[70..].iter().all(|gain| *gain == 0.0));
        let back: Vec<f64> = (100..160).map(gain).collect();
        assert!((back[24] - 0.5).abs() < 1e-9);
        assert_eq!(back[59], 1.0);
    }

    #[test]
    fn without_a_limit_nothing_fades() {
        let mut stale = Stale::new();
        assert!((0..10_000).all(|_| stale.gain(1, 1.0, f64::INFINITY, 0.05) == 1.0));
    }
}
