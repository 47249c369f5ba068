//! Rules: what facts mean.
//!
//! Physics says what happened, the rules say what it is worth. [`watch`] collects a shot from its
//! facts, [`judge`] decides with one named function per rule, and the [`Referee`] leads from turn
//! to turn with the few phases of [`Phase`]. The paper's statechart of the same rules (section
//! 5.2) is the one part that its authors would not build again: every special case had to become
//! a state. Here only the turn's phases are states; all else is a pure function of a finished shot.
//!
//! The rules never look at positions: whoever asks where a ball lies asks physics.

mod ball_names;
mod carom;
mod console;
mod fact_json;
mod fouls;
mod game;
mod games;
mod phase;
mod referee;
mod scenario;
mod shot;
mod state;
mod text;

pub use crate::ids::{GameKind, UnknownGame};
pub use ball_names::{ball_name, ball_named};
pub use console::{Console, ConsoleAnswer, ConsoleError};
pub use game::{Chosen, Game, Judge, UNDO_SHOTS};
pub use games::game;
pub use phase::{Phase, Signal, diagram};
pub use referee::Referee;
pub use scenario::{
    Difference, Scenario, ScenarioError, ScenarioResult, ScenarioStatus, read_scenarios,
    run_scenario,
};
pub use shot::{FirstContact, Met, Pocketed, Shot, watch};
pub use state::{Missed, State};
pub use text::{Language, Texts, explain};

use crate::events::{Call, Topic, Topics, Verdict};
use crate::ids::BallId;
use smallvec::SmallVec;

/// The verdict of a game's rules on a finished shot.
pub fn judge(kind: GameKind, state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    (game(kind).judge)(state, call, shot)
}

/// The object balls that the cue ball may meet first without a foul, in ascending order.
pub fn legal_first(kind: GameKind, state: &State) -> SmallVec<[BallId; 16]> {
    let may_be_first = |ball: &BallId| (game(kind).may_be_first)(state, *ball);
    state.on_table.iter().copied().filter(may_be_first).collect()
}

/// The facts that decide anything in a game. What nobody needs need not stop the simulation.
pub fn topics(kind: GameKind) -> Topics {
    let every_game = Topics::of(&[
        Topic::BallPlaced,
        Topic::CueBallStruck,
        Topic::BallPocketed,
        Topic::BallOffTable,
        Topic::BallTouched,
        Topic::Settled,
    ]);
    every_game.or(Topics::of(game(kind).facts))
}
