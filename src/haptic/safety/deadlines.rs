//! Stage 10: a loop that comes late carries less stiffness; one that stalls carries none.

use crate::haptic::settings::SafetySettings;
use crate::units::Seconds;

/// The lowest stiffness that lateness leaves.
const FACTOR_MIN: f64 = 0.125;

/// Who came late, how often.
#[derive(Debug, Clone)]
pub(super) struct Deadlines {
    late: u32,
    punctual: u32,
    wanted: f64,
    factor: f64,
}

/// What the stage says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Punctuality {
    /// This tick came late.
    pub is_late: bool,
    /// So late that the force goes off.
    pub is_stall: bool,
}

impl Deadlines {
    pub fn new() -> Self {
        Deadlines { late: 0, punctual: 0, wanted: 1.0, factor: 1.0 }
    }

    /// What all stiffness is multiplied by from the next tick on.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// A tick came `dt` after the last one.
    pub fn watch(
        &mut self,
        dt: Seconds,
        period_s: Seconds,
        safety: &SafetySettings,
    ) -> Punctuality {
        let is_late = dt > safety.late_periods * period_s;
        if is_late {
            (self.late, self.punctual) = (self.late + 1, 0);
        } else {
            (self.late, self.punctual) = (0, self.punctual + 1);
        }
        if self.late >= safety.late_ticks.max(1) {
            self.late = 0;
            self.wanted = (0.5 * self.wanted).max(FACTOR_MIN);
        }
        if self.punctual >= safety.punctual_ticks.max(1) {
            self.punctual = 0;
            self.wanted = (2.0 * self.wanted).min(1.0);
        }
        // Not at once: a wall that softens under the hand must not be a step either.
        let step = if safety.fade_s > 0.0 { dt / safety.fade_s } else { 1.0 };
        self.factor += (self.wanted - self.factor).clamp(-step, step);
        Punctuality { is_late, is_stall: dt >= safety.stall_s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haptic::device::DeviceSpec;

    #[test]
    fn three_late_ticks_halve_the_stiffness_and_a_punctual_second_gives_it_back() {
        let safety = SafetySettings::of(&DeviceSpec::OMNI);
        let mut deadlines = Deadlines::new();
        let mut ticks = |n: u32, dt| {
            for _ in 0..n {
                deadlines.watch(dt, 0.001, &safety);
            }
            deadlines.factor()
        };
        assert_eq!(ticks(2, 0.002), 1.0);
        assert_eq!(ticks(100, 0.001), 1.0);
        ticks(3, 0.002);
        assert_eq!(ticks(50, 0.001), 0.5);
        ticks(3, 0.002);
        assert_eq!(ticks(50, 0.001), 0.25);
        ticks(1_000, 0.001);
        assert_eq!(ticks(50, 0.001), 0.5);
        ticks(1_000, 0.001);
        assert_eq!(ticks(50, 0.001), 1.0);
    }

    #[test]
    fn only_20_ms_without_a_tick_are_a_stall() {
        let safety = SafetySettings::of(&DeviceSpec::OMNI);
        let mut deadlines = Deadlines::new();
        assert!(!deadlines.watch(0.019, 0.001, &safety).is_stall);
        assert!(deadlines.watch(0.020, 0.001, &safety).is_stall);
    }
}
