//! The searching player: geometry proposes, its own copy of the simulation decides under the
//! player's own noise, a value of the position stands for what comes after.

mod decision;
pub use decision::{Considered, Decision, Deliberation, PlannedShot, Thoughts};

mod outcome;
pub use outcome::Outcome;

mod task;
pub use task::{Task, TaskKind};

mod workers;
pub use workers::{Inline, Workers};

/// What a searching player knows besides the question that it is asked.
#[derive(Debug)]
pub struct Mind {}

impl Mind {
    /// Answers a question. The same question, mind and seed give the same answer, however many
    /// workers there are.
    pub fn deliberate(&self, _task: &Task, _workers: &dyn Workers) -> Deliberation {
        Deliberation { decision: Decision::Nothing, thoughts: Thoughts::default(), simulations: 0 }
    }
}
