//! A device, a hand and a servo, and what they do to each other tick by tick.

use crate::haptic::simulated::{Guide, HandModel, HandScript, SimulatedDevice};
use crate::haptic::{
    Device, DeviceSpec, Effect, EffectSet, HapticScene, SafetySettings, Servo, ServoSettings,
};
use crate::validation::error::{Trouble, unsupported};
use crate::validation::setup::Setup;
use glam::DVec3;

/// Shortest and longest period: no file may ask for a year of work [s].
const PERIOD_S: (f64, f64) = (1e-5, 1.0);

/// The loop.
pub(crate) struct Bench {
    pub device: SimulatedDevice,
    pub servo: Servo,
    pub scene: HapticScene,
    period_s: f64,
    ticks: u64,
}

/// The device that a case describes.
pub(super) fn spec(setup: &Setup<'_>) -> Result<DeviceSpec, Trouble> {
    let period_s = setup.positive("T_s")?;
    if !(PERIOD_S.0..=PERIOD_S.1).contains(&period_s) {
        return unsupported(format!("a period of {period_s} s"));
    }
    Ok(DeviceSpec {
        model: "case",
        mass_kg: setup.positive("m_kg")?,
        damping_ns_m: setup.at_least_zero("b_Ns_m")?,
        friction_n: setup.at_least_zero("coulomb_N")?,
        quantum_m: setup.at_least_zero("quantum_m")?,
        rate_hz: 1.0 / period_s,
        latency_s: setup.delay_samples()? as f64 * period_s,
        ..DeviceSpec::OMNI
    })
}

impl Bench {
    /// A loop in which the device runs into `wall`; the safety stages are off.
    pub fn new(spec: DeviceSpec, hand: HandModel, script: HandScript, wall: Effect) -> Self {
        let period_s = spec.period_s();
        Bench {
            servo: Servo::new(bare(&spec)),
            device: SimulatedDevice::new(spec, hand, Guide::Script(script)),
            scene: HapticScene { effects: EffectSet::of(1, &[wall]), ..HapticScene::default() },
            period_s,
            ticks: 0,
        }
    }

    /// Another servo in the same loop.
    pub fn with(mut self, settings: ServoSettings) -> Self {
        self.servo = Servo::new(settings);
        self
    }

    /// A tick: reading, force, and what the force does until the next reading.
    pub fn tick(&mut self) {
        let dt = if self.ticks == 0 { 0.0 } else { self.period_s };
        self.ticks += 1;
        let state = self.device.read(dt);
        self.scene.serial += 1;
        let force = self.servo.tick(&state, &self.scene, self.period_s);
        self.device.write(force);
    }

    /// Where the device really is, into the wall [m].
    pub fn depth_m(&self) -> f64 {
        self.device.position().x
    }

    /// How fast it really is, into the wall [m/s].
    pub fn speed_m_s(&self) -> f64 {
        self.device.velocity().x
    }
}

/// The servo's laws and nothing else.
pub(super) fn bare(spec: &DeviceSpec) -> ServoSettings {
    ServoSettings {
        velocity_filter_hz: f64::INFINITY,
        stiffness_max_n_m: f64::INFINITY,
        safety: SafetySettings::OFF,
        ..ServoSettings::of(spec)
    }
}

/// A wall that pushes.
pub(crate) fn wall(stiffness_n_m: f64, damping_ns_m: f64) -> Effect {
    Effect::Plane { normal: DVec3::NEG_X, offset_m: 0.0, stiffness_n_m, damping_ns_m }
}

/// A wall that pulls as well.
pub(super) fn bilateral(stiffness_n_m: f64, damping_ns_m: f64) -> Effect {
    Effect::Point { point: DVec3::ZERO, stiffness_n_m, damping_ns_m }
}

/// The difference between the largest and the smallest value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ripple(f64, f64);

impl Ripple {
    pub fn new() -> Self {
        Ripple(f64::INFINITY, f64::NEG_INFINITY)
    }

    pub fn take(&mut self, value: f64) {
        *self = Ripple(self.0.min(value), self.1.max(value));
    }

    pub fn size(&self) -> f64 {
        (self.1 - self.0).max(0.0)
    }
}
