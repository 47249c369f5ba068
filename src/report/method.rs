//! The methods that are compared.

use crate::physics::{Integrator, PhysicsSettings, SolverKind};

/// Steps that are compared [ms], the coarsest first.
pub const STEPS_MS: [f64; 11] = [16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01];

/// The ways to move balls; those in steps are compared at every step.
pub const METHODS: [Option<Integrator>; 4] =
    [None, Some(Integrator::EulerCromer), Some(Integrator::Verlet), Some(Integrator::Rk4)];

/// A way to move balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The exact solver; it has no step.
    EventDriven,
    /// The paper's solver.
    FixedStep {
        /// Between contacts.
        integrator: Integrator,
        /// Length of a step [ms].
        step_ms: f64,
    },
}

impl Method {
    /// What it is called, without its step.
    pub fn name(self) -> &'static str {
        match self {
            Method::EventDriven => "event-driven",
            Method::FixedStep { integrator: Integrator::EulerCromer, .. } => "euler-cromer",
            Method::FixedStep { integrator: Integrator::Verlet, .. } => "velocity-verlet",
            Method::FixedStep { integrator: Integrator::Rk4, .. } => "rk4",
        }
    }

    /// Its step [ms], if it has one.
    pub fn step_ms(self) -> Option<f64> {
        match self {
            Method::EventDriven => None,
            Method::FixedStep { step_ms, .. } => Some(step_ms),
        }
    }

    /// The order of its error where forces are smooth and nothing happens; none if it has no step.
    pub fn smooth_order(self) -> Option<f64> {
        match self {
            Method::EventDriven => None,
            Method::FixedStep { integrator: Integrator::EulerCromer, .. } => Some(1.0),
            Method::FixedStep { integrator: Integrator::Verlet, .. } => Some(2.0),
            Method::FixedStep { integrator: Integrator::Rk4, .. } => Some(4.0),
        }
    }

    /// The settings that ask for it.
    pub fn settings(self) -> PhysicsSettings {
        let settings = PhysicsSettings::default();
        match self {
            Method::EventDriven => PhysicsSettings { solver: SolverKind::EventDriven, ..settings },
            Method::FixedStep { integrator, step_ms } => {
                PhysicsSettings { solver: SolverKind::FixedStep, integrator, step_ms, ..settings }
            }
        }
    }
}
