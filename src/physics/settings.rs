//! What a scene may choose about its physics.

use super::laws::choice::{BallLaw, CushionLaw, MultiContact};
use super::tolerance;
use crate::units::Seconds;
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
    /// Parts that `fixed-step` cuts a step into in which something happens: balls meet something,
    /// land, or slide and begin to roll (paper, section 2.5). 1 cuts none.
    pub sub_steps: u32,
    /// Contact laws and their parameters.
    pub profile: Profile,
    /// What two balls do to each other.
    pub ball_law: BallLaw,
    /// What a cushion does to a ball.
    pub cushion_law: CushionLaw,
    /// What several contacts at one instant do.
    pub multi_contact: MultiContact,
    /// From where on the exact solver is content with less than a closed form.
    pub exact: ExactTolerances,
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
            sub_steps: 1,
            profile: Profile::Standard,
            ball_law: BallLaw::default(),
            cushion_law: CushionLaw::default(),
            multi_contact: MultiContact::default(),
            exact: ExactTolerances::default(),
            gravity_m_s2: 9.81,
            ball_friction: true,
            flight: true,
            contact_back_dating: true,
            thread: false,
        }
    }
}

/// The tolerances of `event-driven` that trade accuracy for time. Everything else it computes is
/// either a closed form or good to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExactTolerances {
    /// A hop on level ground that begins slower than this is not followed [m/s]; see
    /// [`tolerance::HOP_M_S`].
    pub hop_m_s: f64,
    /// Step of the motion that has no closed form [s]; see [`tolerance::LASTING_STEP_S`].
    pub lasting_step_s: Seconds,
}

impl ExactTolerances {
    /// Speed below which a hop off a surface is not followed [m/s]; see [`tolerance::hop_m_s`].
    pub fn hop_below(&self, restitution: f64, upright: f64) -> f64 {
        let factor = self.hop_m_s / tolerance::HOP_M_S;
        // What is slower is no contact that closes.
        (tolerance::hop_m_s(restitution, upright) * factor).max(tolerance::CLOSING_M_S)
    }
}

impl Default for ExactTolerances {
    fn default() -> Self {
        ExactTolerances { hop_m_s: tolerance::HOP_M_S, lasting_step_s: tolerance::LASTING_STEP_S }
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
    /// Verlet in its position form (Störmer): where a ball goes next is told by its last two
    /// places. A contact makes the last place invalid. It is written anew from the new velocity;
    /// under `profile = "2009"` what puts a ball back counts as a way that it went, and it hops.
    PositionVerlet,
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
