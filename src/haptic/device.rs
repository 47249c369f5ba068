//! A haptic device: a specification in units and a handful of functions.
//!
//! The device frame is right-handed: origin in the middle of the workspace, x to the right, y up,
//! z towards the user. A stylus points along −z of its own frame.

use crate::units::Seconds;
use glam::{DQuat, DVec3};

/// A force on the hand, in the device frame [N].
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct Force(pub DVec3);

impl Force {
    /// No force.
    pub const ZERO: Force = Force(DVec3::ZERO);
}

/// Which buttons are held; the front one strikes, the rear one opens the wheel menu.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Buttons(pub u8);

impl Buttons {
    /// The button under the tip of the index finger.
    pub const FRONT: Buttons = Buttons(1);
    /// The one behind it.
    pub const REAR: Buttons = Buttons(2);

    /// Whether all of `buttons` are held.
    pub fn has(self, buttons: Buttons) -> bool {
        self.0 & buttons.0 == buttons.0
    }

    /// These and `buttons`.
    pub fn with(self, buttons: Buttons) -> Buttons {
        Buttons(self.0 | buttons.0)
    }

    /// These without `buttons`.
    pub fn without(self, buttons: Buttons) -> Buttons {
        Buttons(self.0 & !buttons.0)
    }

    /// The buttons that went down since `before`, and those that went up.
    pub fn edges(self, before: Buttons) -> (Buttons, Buttons) {
        (Buttons(self.0 & !before.0), Buttons(before.0 & !self.0))
    }
}

/// Whether a device can be felt.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum DeviceStatus {
    /// It reads and renders.
    #[default]
    Ready,
    /// It reads, but its motors must rest; the force is zero and comes back over a ramp.
    Warm,
    /// It is gone: its reading is the last one. The game goes on with the mouse.
    Lost,
}

/// What a device says at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviceState {
    /// Where the tip of the stylus is [m].
    pub position: DVec3,
    /// Its velocity, as the device estimates it [m/s]. A device that does not differentiates its
    /// positions over the last period.
    pub velocity: DVec3,
    /// How the stylus is turned: from its own frame to the device's. Identity without a sensor.
    pub orientation: DQuat,
    /// What is held.
    pub buttons: Buttons,
    /// Whether it can be felt.
    pub status: DeviceStatus,
}

impl Default for DeviceState {
    fn default() -> Self {
        DeviceState {
            position: DVec3::ZERO,
            velocity: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            buttons: Buttons::default(),
            status: DeviceStatus::Ready,
        }
    }
}

impl DeviceState {
    /// Unit vector that the stylus points along.
    pub fn pointing(&self) -> DVec3 {
        self.orientation * DVec3::NEG_Z
    }

    /// Whether every number is one.
    pub fn is_finite(&self) -> bool {
        self.position.is_finite() && self.velocity.is_finite() && self.orientation.is_finite()
    }
}

/// What a device is, in units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviceSpec {
    /// What it is called.
    pub model: &'static str,
    /// Width, height and depth of the workspace [m].
    pub workspace_m: DVec3,
    /// Largest force [N].
    pub force_max_n: f64,
    /// Largest force for a long time [N].
    pub force_continuous_n: f64,
    /// Largest stiffness that is rendered well [N/m].
    pub stiffness_max_n_m: f64,
    /// Largest damping that is rendered well [N s/m].
    pub damping_max_ns_m: f64,
    /// Apparent mass at the tip [kg].
    pub mass_kg: f64,
    /// Viscous damping of the mechanism [N s/m].
    pub damping_ns_m: f64,
    /// Dry friction of the mechanism [N].
    pub friction_n: f64,
    /// Step of the position reading [m]; 0 if it is exact.
    pub quantum_m: f64,
    /// How often it is read and written [Hz].
    pub rate_hz: f64,
    /// Time between a reading and the force made of it, besides the period itself [s].
    pub latency_s: Seconds,
    /// Whether it knows how the stylus is turned.
    pub senses_orientation: bool,
    /// Whether its library calls the servo, instead of being called by it.
    pub has_own_scheduler: bool,
}

impl DeviceSpec {
    /// PHANTOM Omni (SensAble): masses, forces and workspace as published; 0.5 N/mm is what its
    /// library reports; viscous damping is not published and assumed.
    pub const OMNI: DeviceSpec = DeviceSpec {
        model: "PHANTOM Omni",
        workspace_m: DVec3::new(0.160, 0.120, 0.070),
        force_max_n: 3.3,
        force_continuous_n: 0.88,
        stiffness_max_n_m: 500.0,
        damping_max_ns_m: 5.0,
        mass_kg: 0.045,
        damping_ns_m: 0.1,
        friction_n: 0.26,
        quantum_m: 5.5e-5,
        rate_hz: 1000.0,
        latency_s: 0.0,
        senses_orientation: true,
        has_own_scheduler: false,
    };

    /// The period of the servo [s].
    pub fn period_s(&self) -> Seconds {
        1.0 / self.rate_hz
    }
}

/// A device that can be read and pushed. Both return at once and never fail: what is wrong stands
/// in [`DeviceState::status`], and why is the backend's to tell its control.
pub trait Device: Send {
    /// What it is.
    fn spec(&self) -> DeviceSpec;

    /// What it says now, `dt` after the last reading. A simulated device moves on by that; a real
    /// one does not ask.
    fn read(&mut self, dt: Seconds) -> DeviceState;

    /// The force from now on. It is held until the next one.
    fn write(&mut self, force: Force);
}
