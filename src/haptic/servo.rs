//! The servo: one tick from reading to force.

use super::device::{DeviceState, Force};
use super::effect_force::Hand;
use super::report::ServoReport;
use super::safety::{Felt, Safety};
use super::scene::HapticScene;
use super::settings::ServoSettings;
use crate::units::Seconds;
use glam::DVec3;

/// What moves is never carried farther than this at a time [s]: a stall is not caught up with.
const DT_MAX_S: Seconds = 0.02;

/// Everything that is rendered, between two ticks.
#[derive(Debug, Clone)]
pub struct Servo {
    settings: ServoSettings,
    velocity: DVec3,
    safety: Safety,
    report: ServoReport,
}

impl Servo {
    /// A servo at rest.
    pub fn new(settings: ServoSettings) -> Self {
        Servo {
            safety: Safety::new(&settings.safety),
            settings,
            velocity: DVec3::ZERO,
            report: ServoReport { stiffness_factor: 1.0, ..ServoReport::default() },
        }
    }

    /// One tick: the force on the device [N, device frame], from what it says, the newest scene
    /// and the true time since the last tick [s].
    pub fn tick(&mut self, device: &DeviceState, scene: &HapticScene, dt: Seconds) -> Force {
        let report = &mut self.report;
        report.counters.ticks += 1;
        if !(device.is_finite() && 0.0 < dt && dt.is_finite()) {
            return self.safety.refuse(&self.settings.safety, report);
        }
        report.time_s += dt;
        let share = -libm::expm1(
            -std::f64::consts::TAU * self.settings.velocity_filter_hz * dt.min(DT_MAX_S),
        );
        self.velocity += (device.velocity - self.velocity) * share;
        let hand = Hand { position: device.position, velocity: self.velocity, dt };
        self.safety.pass(Felt::default(), &hand, device, scene, &self.settings, report)
    }

    /// What the last tick did.
    pub fn report(&self) -> &ServoReport {
        &self.report
    }
}
