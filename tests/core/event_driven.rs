//! The exact solver: what must hold whatever happens, at the extremes, mirrored and renumbered.

mod extremes;
mod left_out;
mod random;
mod springs;
mod symmetry;

use hapticbillard::physics::{PhysicsSettings, SolverKind};

/// The default settings, solved exactly.
fn exact() -> PhysicsSettings {
    PhysicsSettings { solver: SolverKind::EventDriven, ..PhysicsSettings::default() }
}
