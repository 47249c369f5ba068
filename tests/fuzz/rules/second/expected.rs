//! What a second judge says, and how it is held against the first one's verdict.

use hapticbillard::events::{BallInHand, Choice, Foul, Groups, Racked, TurnAfter, Verdict};
use hapticbillard::ids::{BallId, PlayerId};
use std::fmt::Debug;

/// A verdict as the tables give it.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    /// The row of the tables that decided.
    pub row: &'static str,
    pub fouls: Vec<Foul>,
    pub turn: TurnAfter,
    pub next_player: Option<PlayerId>,
    pub groups: Groups,
    pub winner: Option<PlayerId>,
    pub ball_in_hand: BallInHand,
    pub spot: Vec<BallId>,
    pub chooser: Option<PlayerId>,
    pub options: Vec<Choice>,
    pub rack: Option<Racked>,
}

impl Expected {
    /// `next` shoots, with the cue ball where it lies.
    pub fn plays(row: &'static str, player: PlayerId, next: PlayerId, groups: Groups) -> Self {
        Expected {
            row,
            fouls: Vec::new(),
            turn: if next == player { TurnAfter::Continue } else { TurnAfter::Pass },
            next_player: Some(next),
            groups,
            winner: None,
            ball_in_hand: BallInHand::None,
            spot: Vec::new(),
            chooser: None,
            options: Vec::new(),
            rack: None,
        }
    }

    /// The game is over.
    pub fn ends(row: &'static str, winner: Option<PlayerId>, groups: Groups) -> Self {
        Expected {
            turn: TurnAfter::End,
            next_player: None,
            winner,
            ..Expected::plays(row, PlayerId::ONE, PlayerId::ONE, groups)
        }
    }

    pub fn fouled(self, fouls: impl IntoIterator<Item = Foul>) -> Self {
        let mut fouls: Vec<Foul> = fouls.into_iter().collect();
        fouls.sort_unstable();
        Expected { fouls, ..self }
    }

    pub fn in_hand(self, ball_in_hand: BallInHand) -> Self {
        Expected { ball_in_hand, ..self }
    }

    pub fn chooses(self, who: PlayerId, options: &[Choice]) -> Self {
        Expected { chooser: Some(who), options: options.to_vec(), ..self }
    }

    pub fn spots_eight(self) -> Self {
        Expected { spot: vec![BallId::EIGHT], ..self }
    }

    /// The first thing in which a verdict is another.
    pub fn differs(&self, verdict: &Verdict) -> Option<String> {
        // The tables give options no order.
        let sorted = |choices: &[Choice]| {
            let mut choices = choices.to_vec();
            choices.sort_by_key(|choice| *choice as u8);
            choices
        };
        let options = (sorted(&self.options), sorted(&verdict.options));
        [
            differ("legal", &self.fouls.is_empty(), &verdict.legal),
            differ("fouls", &self.fouls.as_slice(), &verdict.fouls.as_slice()),
            differ("turn", &self.turn, &verdict.turn),
            differ("next_player", &self.next_player, &verdict.next_player),
            differ("groups", &Some(self.groups), &verdict.groups),
            differ("winner", &self.winner, &verdict.winner),
            differ("ball_in_hand", &self.ball_in_hand, &verdict.ball_in_hand),
            differ("spot", &self.spot.as_slice(), &verdict.spot.as_slice()),
            differ("chooser", &self.chooser, &verdict.chooser),
            differ("options", &options.0, &options.1),
            differ("rack", &self.rack, &verdict.rack),
        ]
        .into_iter()
        .flatten()
        .next()
        .map(|difference| format!("{}: {difference}", self.row))
    }
}

fn differ<T: PartialEq + Debug>(field: &str, tables: &T, program: &T) -> Option<String> {
    let is_same = tables == program;
    (!is_same).then(|| format!("{field}: the tables say {tables:?}, the program {program:?}"))
}
