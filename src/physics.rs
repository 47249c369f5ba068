//! Physics: what balls do. It knows nothing of rules; it says what happened.
//!
//! [`Simulation`] is the front door. Behind it a [`Solver`] moves the balls, and every solver uses
//! the same contact laws ([`laws`]) with the same numbers ([`Parameters`]).

mod checks;
mod error;
mod guided_cue;
mod settings;
mod setup;
mod snapshot;

mod racks;

mod parameters;
mod profiles;

pub mod tolerance;

pub mod laws;

pub mod roots;

pub mod spring;

mod ledger;
mod lies;
mod work;

mod solver;

pub mod fixed_step;

pub mod event_driven;

pub mod sample_shots;

mod shot;
mod simulation;

pub use checks::may_stand;
pub use error::PhysicsError;
pub use laws::choice::{BallLaw, CushionLaw, MultiContact};
pub use laws::cue_ball::cue_contact;
pub use ledger::{Ledger, Momentum};
pub use lies::{Lie, Memory, Order};
pub use parameters::{Contact, Parameters};
pub use profiles::Equipment;
pub use racks::Racks;
pub use settings::{ExactTolerances, Integrator, PhysicsSettings, Profile, SolverKind};
pub use setup::{Setup, SetupError};
pub use shot::{Shot, Strike, Trajectory};
pub use simulation::Simulation;
pub use snapshot::Snapshot;
pub use solver::Solver;
pub use work::Work;
