//! The actor of the simulation: runs [`tick::coast`] and [`tick::advance`], nothing else.

use crate::haptic::WorldPort;
use hapticbillard::events::{Command, FactSet};
use hapticbillard::physics::{PhysicsError, Simulation, Snapshot};
use hapticbillard::tick::{self, Advanced};
use hapticbillard::units::Tick;
use kameo::prelude::*;
use smallvec::SmallVec;
use std::sync::Arc;
use tracing::level_filters::LevelFilter;

/// Owns the simulation.
#[derive(Actor)]
pub struct Physics {
    simulation: Simulation,
    /// The newest state of the world, for whoever draws it: a stream, so it goes through a slot.
    world: Option<triple_buffer::Input<Arc<Snapshot>>>,
    /// The same for whoever listens.
    heard: Option<triple_buffer::Input<Arc<Snapshot>>>,
    /// The same for a hand.
    felt: Option<WorldPort>,
    /// Where shots are filmed, and how many states were not filmed since the last one that was.
    film: Option<(flume::Sender<Arc<Snapshot>>, u32)>,
}

/// One state in so many is filmed: 250 in a second.
const FILMED: u32 = 4;

impl Physics {
    /// Joins the simulation with the slots for its picture, if somebody draws one, for its sound,
    /// if somebody listens, for a hand, if somebody feels it, and with a film of it.
    pub fn new(
        simulation: Simulation,
        world: Option<triple_buffer::Input<Arc<Snapshot>>>,
        heard: Option<triple_buffer::Input<Arc<Snapshot>>>,
        mut felt: Option<WorldPort>,
        film: Option<flume::Sender<Arc<Snapshot>>>,
    ) -> Self {
        if let Some(felt) = &mut felt {
            felt.show(&simulation.snapshot(simulation.now_s()));
        }
        let film = film.map(|film| (film, 0));
        Physics { simulation, world, heard, felt, film }
    }

    fn show(&mut self, moved: Result<Advanced, PhysicsError>) -> Moved {
        if LevelFilter::DEBUG <= LevelFilter::current() {
            let facts = moved.iter().flat_map(|advanced| &advanced.facts);
            facts.for_each(|fact| tracing::debug!("{fact:?}"));
        }
        let slots = [&mut self.world, &mut self.heard];
        if let Ok(advanced) = &moved {
            for slot in slots.into_iter().flatten() {
                slot.write(advanced.table.clone());
            }
        }
        if let (Some((film, left_out)), Ok(advanced)) = (&mut self.film, &moved) {
            *left_out += 1;
            if FILMED <= *left_out {
                *left_out = 0;
                // A window that draws nothing for long has a gap in its film, and nothing waits.
                let _ = film.try_send(advanced.table.clone());
            }
        }
        if let (Some(felt), Ok(advanced)) = (&mut self.felt, &moved) {
            felt.show(&advanced.table);
        }
        Moved(moved)
    }
}

/// Run to the end of `limit`, or of the first tick with a fact in `stop`.
pub struct Coast {
    /// The last tick that may be reached.
    pub limit: Tick,
    /// What to stop at.
    pub stop: FactSet,
}

/// Apply commands at the start of a tick and run to its end.
pub struct Advance {
    /// The tick.
    pub tick: Tick,
    /// In stamp order.
    pub commands: SmallVec<[Command; 2]>,
}

/// The answer, as data: an error must not look like a fault of the actor.
#[derive(Reply)]
pub struct Moved(pub Result<Advanced, PhysicsError>);

impl Message<Coast> for Physics {
    type Reply = Moved;

    async fn handle(&mut self, message: Coast, _: &mut Context<Self, Moved>) -> Moved {
        let moved = tick::coast(&mut self.simulation, message.limit, message.stop);
        self.show(moved)
    }
}

impl Message<Advance> for Physics {
    type Reply = Moved;

    async fn handle(&mut self, message: Advance, _: &mut Context<Self, Moved>) -> Moved {
        let moved = tick::advance(&mut self.simulation, message.tick, &message.commands);
        self.show(moved)
    }
}
