//! Accounts of energy and momentum: where they come from and where they go.
//!
//! Every entry is computed from impulses and the surface velocities they act on, never as a
//! difference of kinetic energies, so the residual is a real check of the solver: it holds rounding
//! and nothing else. What a coarse step itself adds or takes (gravity over a straight path,
//! overlaps that are pushed out) has an account of its own.

use glam::DVec3;

/// Energy and momentum of all balls in play, from the start to one time.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct Ledger {
    /// At the start [J]: kinetic, and weight times height.
    pub start_j: f64,
    /// Now: kinetic energy of the balls in play [J].
    pub kinetic_j: f64,
    /// Now: weight times height of the balls in play [J].
    pub potential_j: f64,
    /// Given by the cue [J]; what the stroke loses in the tip is not in it.
    pub cue_j: f64,
    /// Given by balls that were put down [J].
    pub placed_j: f64,
    /// Given by springs, their dampers included [J].
    pub spring_j: f64,
    /// Added by the method itself [J]: gravity and springs over a step's path, push-out.
    pub integration_j: f64,
    /// Lost between balls [J].
    pub ball_ball_j: f64,
    /// Lost at cushions [J].
    pub cushion_j: f64,
    /// Lost at impacts on anything else [J].
    pub face_j: f64,
    /// Lost to what carries the balls: sliding, rolling, spinning [J].
    pub cloth_j: f64,
    /// Taken out with balls that fell or left the table [J].
    pub removed_j: f64,
    /// What does not add up [J].
    pub residual_j: f64,
    /// The same for momentum.
    pub momentum: Momentum,
}

/// Momentum of all balls in play [N s].
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize)]
pub struct Momentum {
    /// At the start.
    pub start: DVec3,
    /// Now.
    pub now: DVec3,
    /// Given by the cue.
    pub cue: DVec3,
    /// Given by table and ground.
    pub table: DVec3,
    /// Given by gravity and springs.
    pub smooth: DVec3,
    /// Taken out with balls that fell or left the table.
    pub removed: DVec3,
    /// What does not add up.
    pub residual: DVec3,
}

impl Ledger {
    /// The ledger at a time when the balls have this energy and momentum.
    pub(crate) fn closed(mut self, kinetic_j: f64, potential_j: f64, momentum: DVec3) -> Self {
        self.kinetic_j = kinetic_j;
        self.potential_j = potential_j;
        let given = self.start_j + self.cue_j + self.placed_j + self.spring_j + self.integration_j;
        self.residual_j = kinetic_j + potential_j + self.lost_j() + self.removed_j - given;
        let m = &mut self.momentum;
        m.now = momentum;
        m.residual = m.now + m.removed - m.start - m.cue - m.table - m.smooth;
        self
    }

    /// All that was lost in contacts [J].
    pub fn lost_j(&self) -> f64 {
        self.ball_ball_j + self.cushion_j + self.face_j + self.cloth_j
    }
}
