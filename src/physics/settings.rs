//! What a scene may choose about its physics.

use super::laws::choice::{BallLaw, CushionLaw, MultiContact};
use serde::{Deserialize, Serialize};

/// The section `[physics]` of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhysicsSettings {
    /// How motion is computed.
    pub solver: SolverKind,
    /// Step of `fixed-step` [ms].
    pub step_ms: f64,
    /// Integrator of `fixed-step`.
    pub integrator: Integrator,
    /// Contact laws and their parameters.
    pub profile: Profile,
    /// What two balls do to each other.
    pub ball_law: BallLaw,
    /// What a cushion does to a ball.
    pub cushion_law: CushionLaw,
    /// What several contacts at one instant do.
    pub multi_contact: MultiContact,
    /// Gravity, downwards [m/s²].
    pub gravity_m_s2: f64,
    /// Friction between balls; the paper switches it off to see what it does (section 5.4.3).
    pub ball_friction: bool,
    /// Balls hop and jump. Without it what the bed carries stays on it, as in a planar program.
    pub flight: bool,
    /// Whether `fixed-step` computes contact point and normal back in time (section 5.4.3).
    pub contact_back_dating: bool,
    /// Runs on a thread of its own.
    pub thread: bool,
}

impl Default for PhysicsSettings {
    fn default() -> Self {
        PhysicsSettings {
            solver: SolverKind::EventDriven,
            step_ms: 4.0,
            integrator: Integrator::EulerCromer,
            profile: Profile::Standard,
            ball_law: BallLaw::default(),
            cushion_law: CushionLaw::default(),
            multi_contact: MultiContact::default(),
            gravity_m_s2: 9.81,
            ball_friction: true,
            flight: true,
            contact_back_dating: true,
            thread: false,
        }
    }
}

/// How motion is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SolverKind {
    /// Exact: every free motion in closed form, every contact a root of a polynomial.
    EventDriven,
    /// The paper's method: fixed steps, contacts found by overlap (chapter 2).
    FixedStep,
}

/// How `fixed-step` integrates between contacts (paper, section 2.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Semi-implicit Euler: velocity first, then position. The paper's choice.
    EulerCromer,
    /// Velocity Verlet.
    Verlet,
    /// The classical Runge-Kutta method of fourth order.
    Rk4,
}

/// A set of contact laws and their parameters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Profile {
    /// Impulse laws, the same in every solver.
    #[serde(rename = "standard")]
    Standard,
    /// The paper's own friction clamp, with its known faults.
    #[serde(rename = "2009")]
    Paper2009,
}
