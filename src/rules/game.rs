//! What distinguishes one game from another: a constant in each file of [`super::games`].

use super::shot::Shot;
use super::state::State;
use crate::events::{BallInHand, Call, Calls, Choice, Topic, Verdict};
use crate::ids::BallId;
use smallvec::SmallVec;

/// So many shots can be taken back in training.
pub const UNDO_SHOTS: usize = 64;

/// A pure function that judges a finished shot.
pub type Judge = fn(&State, Option<&Call>, &Shot) -> Verdict;

/// A game.
pub struct Game {
    /// Completes the state before the first shot. It knows who breaks, and which object balls are
    /// on the table; the cue ball is in hand behind the head string if `has_cue_ball` does not say
    /// that it lies, and the game does not say otherwise.
    pub open: fn(&mut State, has_cue_ball: bool),
    /// Judges a finished shot.
    pub judge: Judge,
    /// Whether the cue ball may meet this object ball first.
    pub may_be_first: fn(&State, BallId) -> bool,
    /// The state before the next shot, or, where there are options, before the choice.
    pub after: fn(&State, &Shot, &Verdict) -> State,
    /// What follows from a choice; it is one of the options of the last verdict.
    pub choose: fn(&State, Choice) -> Chosen,
    /// What may be called before a shot.
    pub calls: fn(&State) -> Calls,
    /// Facts that decide anything, besides those that decide in every game.
    pub facts: &'static [Topic],
    /// The object balls that a full rack has: the numbers 1 to this.
    pub balls: u16,
    /// Names of balls in rule files, where these are no numbers; the first is ball 0.
    pub names: &'static [&'static str],
    /// Whether players have points.
    pub has_score: bool,
    /// Any ball may be put anywhere, and shots are taken back.
    pub is_practice: bool,
    /// So many of the last shots can be taken back, by whoever the game lets do that.
    pub takes_back: usize,
    /// Whether it matters that a foul leaves the next player without a ball on in sight.
    pub knows_snookers: bool,
    /// What ends the game, for the diagram.
    pub ends: &'static str,
    /// When the cue ball is in hand, for the diagram.
    pub in_hand: &'static str,
}

/// What follows from a choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The state before the next shot.
    pub state: State,
    /// Balls that return to their spots.
    pub spot: SmallVec<[BallId; 4]>,
    /// All balls are racked anew.
    pub rack: bool,
}

impl Chosen {
    /// Play goes on from `state`.
    pub fn goes_on(state: State) -> Self {
        Chosen { state, spot: SmallVec::new(), rack: false }
    }
}

impl Game {
    /// What most games have in common.
    pub const USUAL: Game = Game {
        open: |state, _| state.ball_in_hand = BallInHand::Kitchen,
        judge: |_, _, _| Verdict::default(),
        may_be_first: |_, _| true,
        after: State::after,
        choose: |state, _| Chosen::goes_on(state.clone()),
        calls: |_| Calls { ball: false, pocket: false, safety: false, push_out: false },
        facts: &[],
        balls: 15,
        names: &[],
        has_score: false,
        is_practice: false,
        takes_back: 0,
        knows_snookers: false,
        ends: "Settled, somebody has won",
        in_hand: "Turn, cue ball in hand",
    };
}
