//! The servo: one tick from reading to force.

use super::device::{DeviceState, Force};
use super::effect_force::{EffectMemory, Hand};
use super::report::ServoReport;
use super::scene::HapticScene;
use super::settings::ServoSettings;
use crate::units::Seconds;

/// Everything that is rendered, between two ticks.
#[derive(Debug, Clone)]
pub struct Servo {
    settings: ServoSettings,
    effects: EffectMemory,
    report: ServoReport,
}

impl Servo {
    /// A servo at rest.
    pub fn new(settings: ServoSettings) -> Self {
        Servo { settings, effects: EffectMemory::new(), report: ServoReport::default() }
    }

    /// One tick: the force on the device [N, device frame], from what it says, the newest scene
    /// and the true time since the last tick [s].
    pub fn tick(&mut self, device: &DeviceState, scene: &HapticScene, dt: Seconds) -> Force {
        let hand = Hand { position: device.position, velocity: device.velocity, dt };
        let force = self.effects.force(&scene.effects, &hand).0;
        Force(force.clamp_length_max(self.settings.safety.force_max_n))
    }

    /// What the last tick did.
    pub fn report(&self) -> &ServoReport {
        &self.report
    }
}
