//! What every solver can do.

use super::{Ledger, Lie, PhysicsError, Work};
use crate::ball::BallState;
use crate::cue::CuePose;
use crate::events::{Command, Fact, FactSet};
use crate::hash::StateHash;
use crate::ids::BallId;
use crate::units::Seconds;
use std::sync::Arc;

/// Moves a world of balls through time. The only way to change it is a command.
///
/// Where [`Solver::advance`] is cut changes no bit: not of the facts, not of the state.
pub trait Solver {
    /// Has `command` carried out at `at`, or as soon as the solver can after what it has computed.
    fn apply(&mut self, at: Seconds, command: &Command) -> Result<(), PhysicsError>;

    /// Has balls laid down at `at`, at rest, where they may lie: in no wall and in no other ball.
    /// What is no ball of this world is passed over.
    fn lay(&mut self, at: Seconds, lies: Arc<[Lie]>);

    /// Keeps from now on where the balls lay when the last `shots` shots began, so that
    /// [`Command::Undo`] finds them.
    fn remember(&mut self, shots: usize);

    /// Runs to `limit`, or to the first fact in `stop`; appends what happened in time order;
    /// returns the time reached.
    fn advance(
        &mut self,
        limit: Seconds,
        stop: FactSet,
        facts: &mut Vec<Fact>,
    ) -> Result<Seconds, PhysicsError>;

    /// The state of a ball at a time not long before the one reached; none if nobody knows it.
    fn sample(&self, ball: BallId, at: Seconds) -> Option<BallState>;

    /// The cue, if it is at the table.
    fn cue(&self, at: Seconds) -> Option<CuePose>;

    /// All balls, in ascending order.
    fn balls(&self) -> Vec<BallId>;

    /// Whether everything is at rest to the last bit and stays so until a command comes.
    fn is_still(&self) -> bool;

    /// What was done so far.
    fn work(&self) -> Work;

    /// Energy and momentum so far.
    fn ledger(&self) -> Ledger;

    /// Adds everything that decides the future to `hash`.
    fn hash(&self, hash: &mut StateHash);
}
