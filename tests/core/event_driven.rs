//! The exact solver: what must hold whatever happens, at the extremes, mirrored and renumbered.

mod extremes;
mod interruption;
mod left_out;
mod random;
mod springs;
mod symmetry;
mod table_play;

use hapticbillard::physics::{PhysicsSettings, SolverKind};

/// The default settings, solved exactly.
fn exact() -> PhysicsSettings {
    PhysicsSettings { solver: SolverKind::EventDriven, ..PhysicsSettings::default() }
}
