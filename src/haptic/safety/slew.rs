//! Stage 5: a force rises no faster than it may. A transient is exempt: it is meant to be sharp.

use crate::units::Seconds;
use glam::DVec3;

#[derive(Debug, Clone, Default)]
pub(super) struct Slew {
    last: DVec3,
}

impl Slew {
    /// The force that may be, `dt` after the last one, and whether that is less than `wanted`.
    pub fn limited(&mut self, wanted: DVec3, dt: Seconds, limit_n_s: f64) -> (DVec3, bool) {
        let change = wanted - self.last;
        let allowed = limit_n_s * dt;
        let acts = change.length() > allowed;
        self.last = if acts { self.last + change.normalize_or_zero() * allowed } else { wanted };
        (self.last, acts)
    }

    /// The force is off: it rises from zero again.
    pub fn restart(&mut self) {
        self.last = DVec3::ZERO;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_of_3_newton_takes_two_ticks_at_2_newton_a_millisecond() {
        let mut slew = Slew::default();
        let mut now = |x: f64| slew.limited(DVec3::X * x, 0.001, 2000.0);
        assert_eq!(now(3.0), (DVec3::X * 2.0, true));
        assert_eq!(now(3.0), (DVec3::X * 3.0, false));
        assert_eq!(now(-3.0), (DVec3::X, true));
        assert_eq!(Slew::default().limited(DVec3::X * 9.0, 0.001, f64::INFINITY).0.x, 9.0);
    }
}
