//! Rules: what facts mean.
//!
//! Physics says what happened, the rules say what it is worth. [`watch`] collects a shot from its
//! facts, [`judge`] decides with one named function per rule, and the [`Referee`] leads from turn
//! to turn with the few phases of [`Phase`]. The paper's statechart of the same rules (section
//! 5.2) is the one part that its authors would not build again: every special case had to become
//! a state. Here only the turn's phases are states; all else is a pure function of a finished shot.
//!
//! The rules never look at positions: whoever asks where a ball lies asks physics.

mod shot;

mod state;

mod eight_ball;

mod free_play;

mod phase;

mod referee;

mod fact_json;

mod scenario;

mod console;

mod text;

pub use crate::ids::{GameKind, UnknownGame};
pub use console::{Console, ConsoleAnswer, ConsoleError};
pub use phase::{Phase, Signal, diagram};
pub use referee::{Judge, Referee};
pub use scenario::{
    Difference, Scenario, ScenarioError, ScenarioResult, ScenarioStatus, read_scenarios,
    run_scenario,
};
pub use shot::{Pocketed, Shot, watch};
pub use state::State;
pub use text::{Language, Texts, explain};

use crate::events::{Call, Topic, Topics, Verdict};
use crate::ids::BallId;
use smallvec::SmallVec;

/// The verdict of a game's rules on a finished shot.
pub fn judge(game: GameKind, state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    judge_of(game)(state, call, shot)
}

/// The object balls that the cue ball may meet first without a foul, in ascending order.
pub fn legal_first(game: GameKind, state: &State) -> SmallVec<[BallId; 16]> {
    let may_be_first = |ball: &BallId| match game {
        GameKind::PaperEightBall => eight_ball::may_be_first(state, *ball),
        GameKind::FreePlay => true,
    };
    state.on_table.iter().copied().filter(may_be_first).collect()
}

/// The facts that decide anything in a game. What nobody needs need not stop the simulation.
pub fn topics(game: GameKind) -> Topics {
    let every_game = Topics::of(&[
        Topic::BallPlaced,
        Topic::CueBallStruck,
        Topic::BallPocketed,
        Topic::BallOffTable,
        Topic::BallTouched,
        Topic::Settled,
    ]);
    match game {
        // Rails are never required, so cushions decide nothing.
        GameKind::PaperEightBall => every_game.or(Topics::of(&[Topic::BallsCollided])),
        GameKind::FreePlay => every_game,
    }
}

/// The pure function that judges a game's shots.
fn judge_of(game: GameKind) -> Judge {
    match game {
        GameKind::PaperEightBall => eight_ball::judge,
        GameKind::FreePlay => free_play::judge,
    }
}
