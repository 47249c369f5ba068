//! Handle and hand: three equal axes, each linear, and dry friction on the handle.

use super::hand::HandModel;
use super::linear::{Linear, STATES};
use super::script::Intent;
use crate::haptic::device::DeviceSpec;
use crate::units::Seconds;
use glam::DVec3;

/// The state of an axis: place and speed of the handle, place and speed of the arm.
type Axis = [f64; STATES];

#[derive(Debug, Clone)]
pub(super) struct Plant {
    system: Linear,
    hand: HandModel,
    mass_kg: f64,
    damping_ns_m: f64,
    friction_n: f64,
    axes: [Axis; 3],
    /// The step that is prepared, and its length [s].
    step: Linear,
    step_s: Seconds,
}

impl Plant {
    pub fn new(spec: &DeviceSpec, hand: HandModel, start: DVec3) -> Self {
        let mut plant = Plant {
            system: system(spec, hand),
            hand,
            mass_kg: spec.mass_kg,
            damping_ns_m: spec.damping_ns_m,
            friction_n: spec.friction_n,
            axes: start.to_array().map(|x| [x, 0.0, x, 0.0]),
            step: Linear::default(),
            step_s: 0.0,
        };
        plant.prepare(1e-3);
        plant
    }

    pub fn position(&self) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis[0]))
    }

    pub fn velocity(&self) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis[1]))
    }

    /// Handle and arm move at this velocity.
    pub fn set_velocity(&mut self, velocity: DVec3) {
        for (axis, v) in self.axes.iter_mut().zip(velocity.to_array()) {
            (axis[1], axis[3]) = (v, v);
        }
    }

    /// Makes steps of `h` ready.
    pub fn prepare(&mut self, h: Seconds) {
        if h != self.step_s {
            self.step = self.system.step(h);
            self.step_s = h;
        }
    }

    /// One prepared step under a held force on the handle.
    pub fn step(&mut self, force: DVec3, intent: &Intent) {
        let drawn_to = self.drawn_to(intent);
        let before = self.axes;
        let was_at_rest = self.velocity() == DVec3::ZERO;
        for (i, axis) in self.axes.iter_mut().enumerate() {
            *axis = self.step.apply(axis, force[i], drawn_to[i]);
        }
        // Dry friction takes from the speed what it can in this step, and never turns it round.
        let velocity = self.velocity();
        let speed = velocity.length();
        let change = self.friction_n * self.step.force[1];
        if was_at_rest && speed <= change {
            // It sticks: nothing has moved at all.
            for (axis, held) in self.axes.iter_mut().zip(before) {
                (axis[0], axis[1]) = (held[0], 0.0);
            }
        } else if change > 0.0 && speed > 0.0 {
            let left = (speed - change).max(0.0) / speed;
            for (axis, v) in self.axes.iter_mut().zip(velocity.to_array()) {
                axis[1] = v * left;
            }
        }
    }

    /// Where the spring of the hand pulls to, so that a practised hand follows its intent: the
    /// intent and what its inertia, damping and friction would leave behind, over the stiffness.
    fn drawn_to(&self, intent: &Intent) -> DVec3 {
        let (mass, damping, stiffness) = match self.hand {
            HandModel::None => return intent.position,
            HandModel::Rigid { mass_kg, damping_ns_m, stiffness_n_m }
            | HandModel::Grip { mass_kg, damping_ns_m, stiffness_n_m, .. } => {
                (mass_kg + self.mass_kg, damping_ns_m + self.damping_ns_m, stiffness_n_m)
            }
        };
        let friction = self.friction_n * intent.velocity.normalize_or_zero();
        let needed = mass * intent.acceleration + damping * intent.velocity + friction;
        intent.position + intent.practice * needed / stiffness
    }
}

/// The linear system of one axis.
fn system(spec: &DeviceSpec, hand: HandModel) -> Linear {
    let (m, b) = (spec.mass_kg, spec.damping_ns_m);
    let mut system = Linear::default();
    system.state[0][1] = 1.0;
    match hand {
        HandModel::None => {
            system.state[1][1] = -b / m;
            system.force[1] = 1.0 / m;
        }
        HandModel::Rigid { mass_kg, damping_ns_m, stiffness_n_m } => {
            let both = m + mass_kg;
            system.state[1][0] = -stiffness_n_m / both;
            system.state[1][1] = -(b + damping_ns_m) / both;
            system.force[1] = 1.0 / both;
            system.intent[1] = stiffness_n_m / both;
        }
        HandModel::Grip { grip_n_m, grip_ns_m, mass_kg, damping_ns_m, stiffness_n_m } => {
            let (kg, bg, arm) = (grip_n_m, grip_ns_m, mass_kg);
            system.state[1] = [-kg / m, -(b + bg) / m, kg / m, bg / m];
            system.state[2][3] = 1.0;
            system.state[3] =
                [kg / arm, bg / arm, -(kg + stiffness_n_m) / arm, -(bg + damping_ns_m) / arm];
            system.force[1] = 1.0 / m;
            system.intent[3] = stiffness_n_m / arm;
        }
    }
    system
}

/// One axis of a device in a hand over a period with a held force, x⁺ = Φ x + Γ F: Φ by rows, Γ,
/// and how many of the states there are. The first is the place of the handle.
pub(crate) fn discrete(
    spec: &DeviceSpec,
    hand: HandModel,
    period_s: Seconds,
) -> ([[f64; STATES]; STATES], [f64; STATES], usize) {
    let step = system(spec, hand).step(period_s);
    let states = if matches!(hand, HandModel::Grip { .. }) { 4 } else { 2 };
    (step.state, step.force, states)
}
