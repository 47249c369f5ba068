//! The simulated device with a simulated hand: the default where no hardware is, and the bench on
//! which the renderer is measured.
//!
//! Handle and hand are linear; between two readings they move by the exact solution for a held
//! force. Only dry friction needs sub-steps. Forces may act late by whole samples, positions are
//! read in steps of the encoder.

mod hand;
mod linear;
mod mouse;
mod plant;
mod script;
mod stroke;

pub use hand::HandModel;
pub use mouse::{MouseFeel, MouseHand};
pub(crate) use plant::discrete;
pub use script::{HandScript, Intent, Leg};

use super::device::{Device, DeviceSpec, DeviceState, Force};
use crate::units::Seconds;
use glam::DVec3;
use plant::Plant;

/// Most samples that a force may act late.
pub const DELAY_MAX: usize = 64;
/// Longest sub-step while there is dry friction [s].
const FRICTION_STEP_S: Seconds = 5e-5;

/// Who moves the hand.
#[derive(Debug, Clone)]
pub enum Guide {
    /// A script.
    Script(HandScript),
    /// Somebody at a mouse.
    Mouse(MouseHand),
}

impl Guide {
    fn intent(&self, time_s: Seconds) -> Intent {
        match self {
            Guide::Script(script) => script.at(time_s),
            Guide::Mouse(mouse) => mouse.intent(),
        }
    }
}

/// A device that exists only as numbers, in the hand of somebody who does too.
#[derive(Debug, Clone)]
pub struct SimulatedDevice {
    spec: DeviceSpec,
    guide: Guide,
    plant: Plant,
    /// A force on the handle besides hand and motors [N].
    bias: DVec3,
    delay: usize,
    /// Forces on their way to the motors, a ring of which `delay` are in use.
    waiting: [DVec3; DELAY_MAX],
    next: usize,
    /// What the motors do now [N].
    acting: DVec3,
    time_s: Seconds,
    last: Option<DVec3>,
}

impl SimulatedDevice {
    /// A device as `spec` says in a hand, at rest where the guide begins. Forces act
    /// `spec.latency_s` late, in whole samples.
    pub fn new(spec: DeviceSpec, hand: HandModel, guide: Guide) -> Self {
        let start = guide.intent(0.0).position;
        let delay = libm::round(spec.latency_s * spec.rate_hz).clamp(0.0, DELAY_MAX as f64);
        SimulatedDevice {
            plant: Plant::new(&spec, hand, start),
            spec,
            guide,
            bias: DVec3::ZERO,
            delay: delay as usize,
            waiting: [DVec3::ZERO; DELAY_MAX],
            next: 0,
            acting: DVec3::ZERO,
            time_s: 0.0,
            last: None,
        }
    }

    /// The same with a constant force on the handle [N], and the handle moving [m/s].
    pub fn pushed(mut self, bias: DVec3, velocity: DVec3) -> Self {
        self.push(bias);
        self.plant.set_velocity(velocity);
        self
    }

    /// From now on a constant force is on the handle, besides hand and motors [N].
    pub fn push(&mut self, bias: DVec3) {
        self.bias = bias;
    }

    /// Where the handle really is [m].
    pub fn position(&self) -> DVec3 {
        self.plant.position()
    }

    /// How fast it really is [m/s].
    pub fn velocity(&self) -> DVec3 {
        self.plant.velocity()
    }

    /// What the motors do now [N]: the force that was written `delay` samples ago.
    pub fn acting(&self) -> DVec3 {
        self.acting
    }

    /// Time since it began [s].
    pub fn time_s(&self) -> Seconds {
        self.time_s
    }

    /// Who moves the hand.
    pub fn guide_mut(&mut self) -> &mut Guide {
        &mut self.guide
    }

    fn advance(&mut self, dt: Seconds) {
        let steps = match self.spec.friction_n > 0.0 {
            true => libm::ceil(dt / FRICTION_STEP_S - 1e-9).clamp(1.0, 1e4) as u32,
            false => 1,
        };
        let h = dt / f64::from(steps);
        self.plant.prepare(h);
        for step in 0..steps {
            let intent = self.guide.intent(self.time_s + f64::from(step) * h);
            self.plant.step(self.acting + self.bias, &intent);
        }
        self.time_s += dt;
        if let Guide::Mouse(mouse) = &mut self.guide {
            mouse.step(dt);
        }
    }

    /// A place as the encoders read it.
    fn read_off(&self, position: DVec3) -> DVec3 {
        match self.spec.quantum_m {
            quantum if quantum > 0.0 => (position / quantum).map(libm::floor) * quantum,
            _ => position,
        }
    }
}

impl Device for SimulatedDevice {
    fn spec(&self) -> DeviceSpec {
        self.spec
    }

    fn read(&mut self, dt: Seconds) -> DeviceState {
        if dt > 0.0 {
            self.advance(dt);
        }
        let position = self.read_off(self.plant.position());
        let moved = position - self.last.unwrap_or(position);
        self.last = Some(position);
        let intent = self.guide.intent(self.time_s);
        DeviceState {
            position,
            velocity: if dt > 0.0 { moved / dt } else { DVec3::ZERO },
            orientation: intent.orientation,
            buttons: intent.buttons,
            ..DeviceState::default()
        }
    }

    fn write(&mut self, force: Force) {
        if self.delay == 0 {
            self.acting = force.0;
            return;
        }
        self.acting = std::mem::replace(&mut self.waiting[self.next], force.0);
        self.next = (self.next + 1) % self.delay;
    }
}
