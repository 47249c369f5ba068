//! The phases of a turn: all that is left of the paper's statechart (figure 5.1).

use super::games::game;
use crate::ids::GameKind;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Where a game stands.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// Nobody was called to the table yet.
    #[default]
    Opening,
    /// A player was called to choose how it goes on.
    Choosing,
    /// A player was called and has the cue ball in hand.
    Placing,
    /// A player was called and the cue ball lies.
    Waiting,
    /// A shot is under way, until everything is at rest.
    Shooting,
    /// The game is over.
    Over,
}

/// What leads from one phase to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// A player is called, the cue ball is in hand.
    TurnInHand,
    /// A player is called, the cue ball is played from where it lies.
    TurnAsItLies,
    /// A player is called who must choose first.
    TurnToChoose,
    /// The cue ball was put down where it may be.
    Placed,
    /// A ball was struck or touched.
    ShotBegan,
    /// The shot's verdict ends the game.
    GameOver,
}

impl Phase {
    /// All phases, in the order in which a game first meets them.
    pub const ALL: [Phase; 6] = [
        Phase::Opening,
        Phase::Choosing,
        Phase::Placing,
        Phase::Waiting,
        Phase::Shooting,
        Phase::Over,
    ];

    /// The phase that a signal leads to; none where it cannot come. The whole machine is here.
    pub fn after(self, signal: Signal) -> Option<Phase> {
        match (self, signal) {
            (Phase::Over, _) => None,

            (Phase::Opening | Phase::Choosing | Phase::Shooting, Signal::TurnInHand) => {
                Some(Phase::Placing)
            }
            (Phase::Opening | Phase::Choosing | Phase::Shooting, Signal::TurnAsItLies) => {
                Some(Phase::Waiting)
            }
            // A game may be taken up in the middle of a choice, and training takes shots back.
            (Phase::Opening | Phase::Shooting, Signal::TurnToChoose) => Some(Phase::Choosing),
            (Phase::Opening | Phase::Choosing, Signal::Placed | Signal::ShotBegan) => None,
            (Phase::Opening | Phase::Choosing, Signal::GameOver) => None,
            (Phase::Choosing, Signal::TurnToChoose) => None,

            (Phase::Placing | Phase::Waiting, Signal::Placed) => Some(Phase::Waiting),
            (Phase::Placing | Phase::Waiting, Signal::ShotBegan) => Some(Phase::Shooting),
            // A placement was refused, or a call heard: the same turn is announced again.
            (Phase::Placing | Phase::Waiting, Signal::TurnInHand) => Some(Phase::Placing),
            // Training takes a shot back.
            (Phase::Placing | Phase::Waiting, Signal::TurnAsItLies) => Some(Phase::Waiting),
            (Phase::Placing | Phase::Waiting, Signal::TurnToChoose | Signal::GameOver) => None,

            (Phase::Shooting, Signal::GameOver) => Some(Phase::Over),
            (Phase::Shooting, Signal::Placed | Signal::ShotBegan) => None,
        }
    }
}

impl fmt::Display for Phase {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Phase::Opening => "Opening",
            Phase::Choosing => "Choosing",
            Phase::Placing => "Placing",
            Phase::Waiting => "Waiting",
            Phase::Shooting => "Shooting",
            Phase::Over => "Over",
        })
    }
}

impl Signal {
    /// All signals.
    pub const ALL: [Signal; 6] = [
        Signal::TurnInHand,
        Signal::TurnAsItLies,
        Signal::TurnToChoose,
        Signal::Placed,
        Signal::ShotBegan,
        Signal::GameOver,
    ];

    /// What it means in a game, for the diagram.
    fn label(self, kind: GameKind) -> &'static str {
        match self {
            Signal::TurnInHand => game(kind).in_hand,
            Signal::TurnAsItLies => "Turn, played as it lies",
            Signal::TurnToChoose => "Turn with options",
            Signal::Placed => "BallPlaced in its zone",
            Signal::ShotBegan => "CueBallStruck or BallTouched",
            Signal::GameOver => game(kind).ends,
        }
    }
}

/// The phases of a game as a Mermaid state diagram, drawn from [`Phase::after`] itself.
pub fn diagram(game: GameKind) -> String {
    let mut text = format!("---\ntitle: {game}\n---\nstateDiagram-v2\n    [*] --> Opening\n");
    for phase in Phase::ALL {
        for signal in Signal::ALL {
            if let Some(next) = phase.after(signal) {
                text += &format!("    {phase} --> {next} : {}\n", signal.label(game));
            }
        }
    }
    text += "    Over --> [*]\n";
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_phase_is_reached_and_only_the_last_has_no_way_out() {
        for phase in Phase::ALL {
            let way_out = Signal::ALL.iter().any(|signal| phase.after(*signal).is_some());
            assert_eq!(way_out, phase != Phase::Over, "{phase}");
            let is_reached = Phase::ALL
                .iter()
                .any(|from| Signal::ALL.iter().any(|signal| from.after(*signal) == Some(phase)));
            assert_eq!(is_reached, phase != Phase::Opening, "{phase}");
        }
    }

    #[test]
    fn the_diagram_has_one_arrow_per_transition() {
        let transitions = Phase::ALL
            .iter()
            .flat_map(|phase| Signal::ALL.iter().filter_map(|signal| phase.after(*signal)))
            .count();
        for game in GameKind::ALL {
            let arrows = diagram(game).matches("-->").count();
            assert_eq!(arrows, transitions + 2, "and those from and to the ends");
            assert!(diagram(game).contains("Waiting --> Shooting : CueBallStruck"));
        }
    }
}
