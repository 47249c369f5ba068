//! Physics: what balls do. It knows nothing of rules; it says what happened.

mod settings;
mod snapshot;

pub use settings::{Integrator, PhysicsSettings, Profile, SolverKind};
pub use snapshot::Snapshot;
