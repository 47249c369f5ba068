//! Who stands in for whom.

pub mod haply_service;
pub mod pad;

use hapticbillard::ai::{Player, PlayerSettings};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::cue::Aim;
use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::PlayerId;
use hapticbillard::physics::{Profile, Snapshot};
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, Frame, FrameSource, Inflow, Outcome, Participant};
use hapticbillard::units::Tick;
use std::sync::Arc;

/// A hand that plays a person's turns: it hears what a person hears, and what it does enters
/// through the same door, as frames.
///
/// Inside thinks a computer player; but to the game its commands are input, written down before
/// they are used, and no hash contains it.
pub struct MockHand {
    mind: Player,
    /// What it wants to do, with the tick in which it enters.
    intended: Vec<(Tick, Frame)>,
    wake: Option<Tick>,
    delivered: Option<Delivered>,
}

impl MockHand {
    /// A hand for `player` on `table`.
    pub fn new(player: PlayerId, seed: u64, table: &Arc<Table>) -> Self {
        let settings = PlayerSettings::paper(seed, Profile::Standard);
        let rails = table.clone();
        let clearance = Arc::new(move |at, azimuth_rad| {
            rails.clearance_elevation(at, &Aim { azimuth_rad, ..Aim::default() })
        });
        let (bed, pockets) = (table.bed.unwrap(), table.pockets.clone());
        let mind = Player::new(player, settings, bed, pockets, POOL_RADIUS_M, clearance);
        MockHand { mind, intended: Vec::new(), wake: None, delivered: None }
    }

    /// Takes what the mind wants; it enters in the next tick or later.
    fn intend(&mut self, tick: Tick, outcome: Outcome) {
        assert!(outcome.cancel.is_empty(), "a hand takes nothing back");
        for mut publication in outcome.publish {
            let due = tick.after(1 + publication.delay_ticks);
            publication.delay_ticks = 0;
            self.intended.push((due, Frame::from_iter([publication])));
        }
        self.wake = outcome.wake;
    }
}

impl FrameSource for MockHand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let mut frame = Frame::new();
        self.intended.retain(|(due, publications)| {
            let now = *due <= tick;
            if now {
                frame.extend(publications.iter().cloned());
            }
            !now
        });
        Inflow { frame, ..Inflow::default() }
    }
}

impl Participant for MockHand {
    fn source(&self) -> Source {
        Source::Input
    }

    fn topics(&self) -> Topics {
        self.mind.topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        let outcome = self.mind.start(table);
        self.intend(Tick(0), outcome);
        Outcome { wake: self.wake, ..Outcome::default() }
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let outcome = self.mind.collect(delivered);
        self.intend(delivered.tick, outcome);
        self.delivered = Some(delivered.clone());
        // It enters through the frame, and is heard of from there.
        Outcome { wake: self.wake, ..Outcome::default() }
    }

    fn hash(&self, _: &mut StateHash) {}
}
