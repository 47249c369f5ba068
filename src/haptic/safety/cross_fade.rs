//! Stage 3: other effects come in while the old ones go.
//!
//! After Ummenhofer's effects and HAPI's: the old set, still evaluated, weighs 1 − a and the new
//! one a. A change in the middle of a fade starts a new one from the set that weighs more; what is
//! left of the other dies away in the same time, so that no change is ever a step.

use crate::haptic::effect::EffectSet;
use crate::haptic::effect_force::{EffectMemory, Hand};
use crate::units::Seconds;
use glam::DVec3;

/// What the effects give.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Faded {
    /// The whole force [N].
    pub force: DVec3,
    /// The part that is sharp on purpose [N].
    pub sharp: DVec3,
    /// Two sets act.
    pub is_fading: bool,
    /// A number was none.
    pub is_broken: bool,
}

#[derive(Debug, Clone)]
struct Active {
    set: EffectSet,
    memory: EffectMemory,
}

impl Active {
    fn none() -> Self {
        Active { set: EffectSet::default(), memory: EffectMemory::new() }
    }

    fn force(&mut self, hand: &Hand, broken: &mut bool) -> (DVec3, DVec3) {
        let (force, sharp) = self.memory.force(&self.set, hand);
        let (force, is_finite) = super::finite::checked(force);
        *broken |= !is_finite;
        (force, if is_finite { sharp } else { DVec3::ZERO })
    }
}

/// The effects of now and before.
#[derive(Debug, Clone)]
pub(super) struct CrossFade {
    new: Active,
    old: Active,
    is_begun: bool,
    /// How much the new set weighs.
    weight: f64,
    /// What is left of fades that were cut short [N].
    rest: DVec3,
    last: DVec3,
}

impl CrossFade {
    pub fn new() -> Self {
        CrossFade {
            new: Active::none(),
            old: Active::none(),
            is_begun: false,
            weight: 1.0,
            rest: DVec3::ZERO,
            last: DVec3::ZERO,
        }
    }

    /// The force of the effects, `hand.dt` after the last one.
    pub fn force(&mut self, set: &EffectSet, hand: &Hand, fade_s: Seconds) -> Faded {
        let is_other = self.is_begun && set.generation != self.new.set.generation;
        let is_cut = is_other && self.weight < 1.0;
        if is_other {
            if self.weight > 0.5 || self.weight == 1.0 {
                std::mem::swap(&mut self.old, &mut self.new);
            }
            self.new.memory = EffectMemory::new();
            self.weight = 0.0;
        }
        self.is_begun = true;
        self.new.set = *set;

        let step = if fade_s > 0.0 { hand.dt / fade_s } else { 1.0 };
        self.weight = (self.weight + step).min(1.0);
        self.rest *= (1.0 - step).max(0.0);
        let mut is_broken = false;
        let (mut force, mut sharp) = self.new.force(hand, &mut is_broken);
        if self.weight < 1.0 {
            let (old, old_sharp) = self.old.force(hand, &mut is_broken);
            force = old.lerp(force, self.weight);
            sharp = old_sharp.lerp(sharp, self.weight);
        }
        if is_cut {
            self.rest = self.last - force;
        }
        force += self.rest;
        self.last = force;
        Faded { force, sharp, is_fading: self.weight < 1.0, is_broken }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haptic::effect::Effect;

    fn constant(generation: u32, newton: f64) -> EffectSet {
        EffectSet::of(generation, &[Effect::Constant { force: DVec3::X * newton }])
    }

    fn hand() -> Hand {
        Hand {
            position: DVec3::ZERO,
            velocity: DVec3::ZERO,
            dt: 0.001,
            stiffness_max_n_m: f64::INFINITY,
        }
    }

    #[test]
    fn a_change_of_effects_takes_the_time_of_the_fade_and_a_modification_none() {
        let mut fade = CrossFade::new();
        let mut force = |set: EffectSet| fade.force(&set, &hand(), 0.05).force.x;
        assert_eq!(force(constant(1, 1.0)), 1.0);
        assert_eq!(force(constant(1, 1.5)), 1.5);
        let ramp: Vec<f64> = (0..60).map(|_| force(constant(2, 3.5))).collect();
        assert!((ramp[24] - 2.5).abs() < 1e-9, "{}", ramp[24]);
        assert!((ramp[49] - 3.5).abs() < 1e-9);
    }

    #[test]
    fn changes_in_the_middle_of_fades_are_never_steps() {
        let mut fade = CrossFade::new();
        let mut last = fade.force(&constant(0, 0.0), &hand(), 0.05).force.x;
        for tick in 0..2_000_u32 {
            // Another set every 13 ms, of up to 3 N either way.
            let n = tick / 13;
            let set = constant(n + 1, [3.0, -3.0, 0.5, 2.0, -1.0][n as usize % 5]);
            let now = fade.force(&set, &hand(), 0.05).force.x;
            // 6 N in 50 ms, and as much again from what is left over.
            assert!((now - last).abs() <= 0.31, "{tick}: {last} to {now}");
            last = now;
        }
    }
}
