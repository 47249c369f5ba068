//! The scoreboard: the state of a game as a window shows it, reduced from events.

use crate::events::{
    Call, CallKind, Command, Event, FactKind, Group, Groups, Health, Insight, PlayerState, Topic,
    Topics, Turn, TurnAfter, Verdict,
};
use crate::ids::{BallId, PlayerId};
use crate::input::STYLUS;
use std::sync::Arc;

/// What is known of the game. Every event leads from one state to the next; nothing else does.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scoreboard {
    /// Names of player 1 and player 2, as many as play.
    pub names: Vec<String>,
    /// Whose turn it is, to play what.
    pub turn: Option<Arc<Turn>>,
    /// What the rules said about the last shot.
    pub verdict: Option<Arc<Verdict>>,
    /// Object balls on the table, in ascending order.
    pub on_table: Vec<BallId>,
    /// Who plays which group; none where a game has none.
    pub groups: Option<Groups>,
    /// Where a computer player stands in its turn.
    pub states: [PlayerState; 2],
    /// What was announced for the next shot.
    pub call: Option<Call>,
    /// What the player at the table thought, until its shot is judged; only computers tell.
    pub insight: Option<Arc<Insight>>,
    /// A stroke was made and the balls have not settled.
    pub is_rolling: bool,
    /// The game is over; who won, if anybody.
    pub over: Option<Option<PlayerId>>,
    /// The recording stands still, or has ended.
    pub is_unrecorded: bool,
    /// What is wrong with the haptic device, while something is.
    pub unfelt: Option<String>,
    /// The haptic device is gone, and the mouse strikes.
    pub is_without_stylus: bool,
    /// Why nothing is heard, until the first stroke.
    pub unheard: Option<String>,
    /// What operating system and device have refused, until the first stroke.
    pub refused: Vec<Refused>,
}

/// Something that was asked of the operating system or a device and not given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// What.
    pub asked: String,
    /// Why.
    pub reason: String,
    /// What would help.
    pub remedy: String,
}

/// A call that takes the one before back.
const NOTHING: Call = Call::Kind(CallKind::Nothing);

impl Scoreboard {
    /// Before the first event.
    pub fn new(names: Vec<String>) -> Self {
        Scoreboard { names, ..Scoreboard::default() }
    }

    /// What it needs to be told.
    pub fn topics() -> Topics {
        Topics::of(&[
            Topic::Turn,
            Topic::Verdict,
            Topic::Player,
            Topic::Insight,
            Topic::Command,
            Topic::CueBallStruck,
            Topic::BallPocketed,
            Topic::BallOffTable,
            Topic::Settled,
            Topic::Health,
        ])
    }

    /// Takes one event.
    pub fn hear(&mut self, event: &Event) {
        match event {
            Event::Turn(turn) => {
                self.on_table = turn.on_table.to_vec();
                self.groups = turn.groups;
                self.is_rolling = false;
                self.call = None;
                self.insight = None;
                // A choice was taken: that there was one is old now.
                if turn.options.is_empty() {
                    self.verdict.take_if(|verdict| !verdict.options.is_empty());
                }
                self.turn = Some(turn.clone());
            }
            Event::Verdict(verdict) => {
                self.groups = verdict.groups.or(self.groups);
                if verdict.turn == TurnAfter::End {
                    self.over = Some(verdict.winner);
                }
                self.is_rolling = false;
                self.insight = None;
                self.verdict = Some(verdict.clone());
            }
            Event::Player(report) => self.states[report.player.index()] = report.state,
            Event::Fact(fact) => match fact.kind {
                FactKind::CueBallStruck { .. } => {
                    self.is_rolling = true;
                    // What was said about the shot before is old now.
                    self.verdict = None;
                    self.refused.clear();
                    self.unheard = None;
                }
                FactKind::BallPocketed { ball, .. } | FactKind::BallOffTable { ball } => {
                    self.on_table.retain(|other| *other != ball);
                }
                FactKind::Settled { .. } => self.is_rolling = false,
                _ => {}
            },
            Event::Insight(insight) => self.insight = Some(insight.clone()),
            Event::Health(health) => self.hear_health(health),
            Event::Command(Command::Call(call)) => {
                self.call = Some(call.clone()).filter(|call| *call != NOTHING);
            }
            Event::Command(Command::Undo) => self.verdict = None,
            Event::Command(_) | Event::Menu(_) => {}
        }
    }

    fn hear_health(&mut self, health: &Health) {
        match health {
            Health::ActorFailed { actor, reason } => match actor.as_str() {
                "recorder" => self.is_unrecorded = true,
                "haptic" => self.unfelt = Some(reason.clone()),
                "sound" => self.unheard = Some(reason.clone()),
                STYLUS => self.is_without_stylus = true,
                _ => {}
            },
            Health::ActorRestarted { actor } => match actor.as_str() {
                "recorder" => self.is_unrecorded = false,
                "haptic" => self.unfelt = None,
                "sound" => self.unheard = None,
                STYLUS => self.is_without_stylus = false,
                _ => {}
            },
            Health::Refused { asked, reason, remedy, .. } => self.refused.push(Refused {
                asked: asked.clone(),
                reason: reason.clone(),
                remedy: remedy.clone(),
            }),
            Health::QueueFull { .. } => {}
        }
    }

    /// The name of a player.
    pub fn name(&self, player: PlayerId) -> &str {
        self.names.get(player.index()).map_or("", String::as_str)
    }

    /// The group of a player, once there are groups.
    pub fn group(&self, player: PlayerId) -> Option<Group> {
        self.groups?.of(player)
    }

    /// The balls that a player has still to pocket: the own group, then the 8. None while the
    /// table is open, or in a game without groups.
    pub fn remaining(&self, player: PlayerId) -> Option<Vec<BallId>> {
        let group = self.group(player)?;
        let own = group.among(&self.on_table);
        let mut balls: Vec<BallId> = own.collect();
        balls.extend(self.on_table.iter().filter(|ball| **ball == BallId::EIGHT));
        Some(balls)
    }
}
