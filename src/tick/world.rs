//! Physics as the clock sees it: in whole ticks.

use crate::events::{Command, Fact, FactSet};
use crate::hash::{Digest, StateHash};
use crate::physics::{PhysicsError, Simulation, Snapshot};
use crate::units::Tick;
use std::sync::Arc;

/// What physics answers.
#[derive(Debug, Clone)]
pub struct Advanced {
    /// The end of this tick was reached.
    pub tick: Tick,
    /// What happened, in time order.
    pub facts: Vec<Fact>,
    /// The visible world then.
    pub table: Arc<Snapshot>,
    /// The simulation's state hash then.
    pub digest: Digest,
}

/// Runs from where the simulation is to the end of `limit`, or of the first tick with a fact in
/// `stop`.
///
/// # Errors
/// What the solver says, unchanged.
pub fn coast(
    simulation: &mut Simulation,
    limit: Tick,
    stop: FactSet,
) -> Result<Advanced, PhysicsError> {
    let mut facts = Vec::new();
    // What happens at the very start of a tick belongs to it and not to the one before.
    let soon = Tick::containing(simulation.now_s()).after(1);
    simulation.advance(limit.end_s(), stop, &mut facts)?;
    let news = facts.iter().find(|fact| stop.contains(fact.kind.topic()));
    let tick = news.map_or(limit, |fact| Tick::containing(fact.time_s).max(soon).min(limit));
    if news.is_some() {
        // What else happens in the same tick belongs to the same batch.
        simulation.advance(tick.end_s(), FactSet::NONE, &mut facts)?;
    }
    Ok(finish(simulation, tick, facts))
}

/// Applies `commands` at the start of `tick` and advances to its end.
///
/// # Errors
/// What the solver says, unchanged.
pub fn advance(
    simulation: &mut Simulation,
    tick: Tick,
    commands: &[Command],
) -> Result<Advanced, PhysicsError> {
    for command in commands {
        simulation.apply(tick.start_s(), command)?;
    }
    let mut facts = Vec::new();
    simulation.advance(tick.end_s(), FactSet::NONE, &mut facts)?;
    Ok(finish(simulation, tick, facts))
}

fn finish(simulation: &Simulation, tick: Tick, facts: Vec<Fact>) -> Advanced {
    let mut hash = StateHash::new();
    simulation.hash(&mut hash);
    Advanced {
        tick,
        facts,
        table: Arc::new(simulation.snapshot(tick.end_s())),
        digest: hash.finish(),
    }
}
