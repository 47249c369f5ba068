//! Stage 9: after a start, and after every interruption, the force comes back slowly, and only once
//! there is little of it.

use crate::units::Seconds;

/// So many ticks in a row little must be wanted.
const CALM_TICKS: u32 = 3;

/// How much of the force is felt.
#[derive(Debug, Clone)]
pub(super) struct Ramp {
    gain: f64,
    rise_s: Seconds,
    calm: u32,
}

impl Ramp {
    /// At the very start.
    pub fn new(rise_s: Seconds) -> Self {
        Ramp { gain: 0.0, rise_s, calm: 0 }
    }

    /// From zero again.
    pub fn restart(&mut self, rise_s: Seconds) {
        *self = Ramp::new(rise_s);
    }

    /// The share of the force that is felt after `dt`: it begins to rise once `wanted_n` was
    /// below `below_n` for some ticks.
    pub fn gain(&mut self, wanted_n: f64, dt: Seconds, below_n: f64) -> f64 {
        if self.gain == 0.0 && self.calm < CALM_TICKS && below_n < f64::INFINITY {
            self.calm = if wanted_n < below_n { self.calm + 1 } else { 0 };
            return 0.0;
        }
        let step = if self.rise_s > 0.0 { dt / self.rise_s } else { 1.0 };
        self.gain = (self.gain + step).min(1.0);
        self.gain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inside_a_wall_nothing_begins_and_in_the_open_it_rises_steadily() {
        let mut ramp = Ramp::new(0.5);
        assert!((0..1_000).all(|_| ramp.gain(1.0, 0.001, 0.2) == 0.0));
        let rising: Vec<f64> = (0..600).map(|_| ramp.gain(0.1, 0.001, 0.2)).collect();
        assert_eq!(rising[2], 0.0);
        assert!((rising[252] - 0.5).abs() < 1e-9);
        assert_eq!(rising[503], 1.0);
        assert_eq!(ramp.gain(9.0, 0.001, 0.2), 1.0);
        ramp.restart(0.5);
        assert_eq!(ramp.gain(9.0, 0.001, 0.2), 0.0);
    }

    #[test]
    fn without_a_rise_it_is_there_at_once() {
        assert_eq!(Ramp::new(0.0).gain(9.0, 0.001, f64::INFINITY), 1.0);
    }
}
