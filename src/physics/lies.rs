//! Where balls lie: what a rack lays down, and what comes back when a shot is taken back.

use crate::ball::{BallPlace, BallState};
use crate::events::{Command, FactKind, Zone};
use crate::hash::StateHash;
use crate::ids::BallId;
use glam::{DQuat, DVec3};
use std::collections::VecDeque;
use std::sync::Arc;

/// How one ball lies at rest, or how it is out of play.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lie {
    /// The ball.
    pub ball: BallId,
    /// Where it is in the game's sense.
    pub place: BallPlace,
    /// Its middle [m].
    pub position: DVec3,
    /// How it is turned.
    pub orientation: DQuat,
}

impl Lie {
    /// What is told when a shot was taken back, so that whoever holds the cue looks again.
    pub const TAKEN_BACK: FactKind =
        FactKind::BallPlaced { ball: BallId::CUE, zone: Zone::Anywhere, ok: true };

    /// Whether this is the cue ball and it lies on the table.
    pub fn is_cue_ball_on_table(&self) -> bool {
        self.ball == BallId::CUE && self.place == BallPlace::OnTable
    }
}

impl From<&BallState> for Lie {
    fn from(state: &BallState) -> Self {
        Lie {
            ball: state.id,
            place: state.place,
            position: state.position,
            orientation: state.orientation,
        }
    }
}

/// What a solver carries out when it is due.
#[derive(Debug, Clone)]
pub enum Order {
    /// Of a player, or of the rules.
    Command(Command),
    /// All these balls are laid down, at rest, as one hand would: first all are taken up.
    Lay(Arc<[Lie]>),
}

/// Where the balls lay when the last shots began. A shot begins with the first contact of the tip,
/// and it is over when everything has settled.
#[derive(Debug, Clone, Default)]
pub struct Memory {
    /// How many shots are kept.
    limit: usize,
    shots: VecDeque<Arc<[Lie]>>,
    is_open: bool,
}

impl Memory {
    /// Keeps so many shots; none means that nothing is kept.
    pub fn of(limit: usize) -> Self {
        Memory { limit, ..Memory::default() }
    }

    /// A shot begins, if none is under way: asks for where the balls lie.
    pub fn begin(&mut self, lies: impl FnOnce() -> Arc<[Lie]>) {
        if self.limit == 0 || std::mem::replace(&mut self.is_open, true) {
            return;
        }
        if self.shots.len() == self.limit {
            self.shots.pop_front();
        }
        self.shots.push_back(lies());
    }

    /// The shot is over.
    pub fn end(&mut self) {
        self.is_open = false;
    }

    /// Where the balls lay when the last shot began; the one before is the last then.
    pub fn take_back(&mut self) -> Option<Arc<[Lie]>> {
        self.is_open = false;
        self.shots.pop_back()
    }

    /// Adds what decides the future to `hash`: nothing where nothing is kept.
    pub fn hash(&self, hash: &mut StateHash) {
        if self.limit == 0 {
            return;
        }
        hash.u64(self.shots.len() as u64);
        hash.u64(self.is_open.into());
        for lie in self.shots.iter().flat_map(|lies| lies.iter()) {
            hash.u64(lie.ball.0.into());
            hash.u64(lie.place as u64);
            hash.vec3(lie.position);
            hash.quat(lie.orientation);
        }
    }
}
