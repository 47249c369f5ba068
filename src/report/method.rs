//! The methods that are compared.

use crate::physics::{ExactTolerances, Integrator, PhysicsSettings, SolverKind};

/// Steps that are compared [ms], the coarsest first.
pub const STEPS_MS: [f64; 11] = [16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01];

/// Ways to integrate between contacts; each is compared at every step.
pub const INTEGRATORS: [Integrator; 4] =
    [Integrator::EulerCromer, Integrator::Verlet, Integrator::PositionVerlet, Integrator::Rk4];

/// Those that are also compared with sub-steps: the paper's own, and the cheapest of second order.
pub const IN_PARTS: [Integrator; 2] = [Integrator::EulerCromer, Integrator::Verlet];

/// Parts of a step in which something happens, where there are sub-steps.
pub const SUB_STEPS: u32 = 16;

/// A way to move balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// The exact solver; it has no step.
    EventDriven,
    /// The exact solver with other tolerances.
    Tolerances(Tolerances),
    /// The paper's solver.
    FixedStep {
        /// Between contacts.
        integrator: Integrator,
        /// Length of a step [ms].
        step_ms: f64,
    },
    /// The paper's solver with sub-steps where something happens (paper, section 2.5).
    SubSteps {
        /// Between contacts.
        integrator: Integrator,
        /// Length of a step [ms].
        step_ms: f64,
    },
}

/// Other tolerances of the exact solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tolerances {
    /// Hops and steps of lasting contact as large as a game would not see.
    Coarse,
    /// Hops down to a thousandth of the default, lasting contact in steps of a 25th.
    Fine,
    /// Twice those of `Fine`: their difference is how sure `Fine` is.
    LessFine,
}

impl Tolerances {
    /// In numbers.
    pub fn values(self) -> ExactTolerances {
        let standard = ExactTolerances::default();
        let scaled = |hop: f64, lasting: f64| ExactTolerances {
            hop_m_s: standard.hop_m_s * hop,
            lasting_step_s: standard.lasting_step_s * lasting,
        };
        match self {
            Tolerances::Coarse => scaled(8.0, 8.0),
            Tolerances::Fine => scaled(1e-3, 0.04),
            Tolerances::LessFine => scaled(2e-3, 0.08),
        }
    }
}

impl Method {
    /// What it is called, without its step.
    pub fn name(self) -> &'static str {
        match self {
            Method::EventDriven => "event-driven",
            Method::Tolerances(Tolerances::Coarse) => "event-driven coarse",
            Method::Tolerances(Tolerances::Fine) => "event-driven fine",
            Method::Tolerances(Tolerances::LessFine) => "event-driven less fine",
            Method::FixedStep { integrator, .. } => match integrator {
                Integrator::EulerCromer => "euler-cromer",
                Integrator::Verlet => "velocity-verlet",
                Integrator::PositionVerlet => "position-verlet",
                Integrator::Rk4 => "rk4",
            },
            Method::SubSteps { integrator, .. } => match integrator {
                Integrator::EulerCromer => "euler-cromer sub-steps",
                Integrator::Verlet => "velocity-verlet sub-steps",
                Integrator::PositionVerlet => "position-verlet sub-steps",
                Integrator::Rk4 => "rk4 sub-steps",
            },
        }
    }

    /// Its step [ms], if it has one.
    pub fn step_ms(self) -> Option<f64> {
        match self {
            Method::EventDriven | Method::Tolerances(_) => None,
            Method::FixedStep { step_ms, .. } | Method::SubSteps { step_ms, .. } => Some(step_ms),
        }
    }

    /// Its integrator, if it has steps.
    pub fn integrator(self) -> Option<Integrator> {
        match self {
            Method::EventDriven | Method::Tolerances(_) => None,
            Method::FixedStep { integrator, .. } | Method::SubSteps { integrator, .. } => {
                Some(integrator)
            }
        }
    }

    /// The order of its error where forces are smooth and nothing happens; none if it has no step.
    pub fn smooth_order(self) -> Option<f64> {
        self.integrator().map(|integrator| match integrator {
            Integrator::EulerCromer => 1.0,
            Integrator::Verlet | Integrator::PositionVerlet => 2.0,
            Integrator::Rk4 => 4.0,
        })
    }

    /// The settings that ask for it.
    pub fn settings(self) -> PhysicsSettings {
        let settings = PhysicsSettings::default();
        let exact = PhysicsSettings { solver: SolverKind::EventDriven, ..settings.clone() };
        let stepping = PhysicsSettings { solver: SolverKind::FixedStep, ..settings };
        match self {
            Method::EventDriven => exact,
            Method::Tolerances(tolerances) => {
                PhysicsSettings { exact: tolerances.values(), ..exact }
            }
            Method::FixedStep { integrator, step_ms } => {
                PhysicsSettings { integrator, step_ms, ..stepping }
            }
            Method::SubSteps { integrator, step_ms } => {
                PhysicsSettings { integrator, step_ms, sub_steps: SUB_STEPS, ..stepping }
            }
        }
    }
}

/// The methods in steps, each at a step of `step_ms`.
pub fn stepping(step_ms: f64) -> Vec<Method> {
    let plain = INTEGRATORS.map(|integrator| Method::FixedStep { integrator, step_ms });
    let parts = IN_PARTS.map(|integrator| Method::SubSteps { integrator, step_ms });
    plain.into_iter().chain(parts).collect()
}

/// All methods of a scene in the order of the table: event-driven, with other tolerances, then each
/// method in steps from the coarsest step to the finest.
pub fn all_methods() -> Vec<Method> {
    let exact = [Tolerances::Coarse, Tolerances::Fine].map(Method::Tolerances);
    let mut methods: Vec<Method> = core::iter::once(Method::EventDriven).chain(exact).collect();
    for place in 0..stepping(1.0).len() {
        methods.extend(STEPS_MS.map(|step_ms| stepping(step_ms)[place]));
    }
    methods
}
