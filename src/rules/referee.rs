//! The referee: leads from turn to turn.
//!
//! It hears facts, and only those; where a ball lies is not its business. What it says (verdict,
//! balls to spot, next turn) is due in the tick after the one in which everything came to rest.

use super::phase::{Phase, Signal};
use super::shot::{Shot, watch};
use super::state::State;
use super::{judge_of, legal_first, topics};
use crate::events::{
    BallInHand, Call, Command, Event, Fact, FactKind, Source, Topics, Turn, TurnAfter, Verdict,
    Zone,
};
use crate::hash::StateHash;
use crate::ids::GameKind;
use crate::ids::{BallId, PlayerId};
use crate::physics::Snapshot;
use crate::tick::{Delivered, Outcome, Participant};
use smallvec::SmallVec;
use std::sync::Arc;

/// A pure function that judges a finished shot.
pub type Judge = fn(&State, Option<&Call>, &Shot) -> Verdict;

/// What the referee says, in this order.
type Sayings = SmallVec<[Event; 4]>;

/// The referee of one game.
#[derive(Debug, Clone)]
pub struct Referee {
    game: GameKind,
    judge: Judge,
    phase: Phase,
    state: State,
    /// The rack is not that of the table but part of a state that was given.
    is_resumed: bool,
    shot: Shot,
    shot_number: u32,
    verdict: Option<Arc<Verdict>>,
}

impl Referee {
    /// The referee of a new game; player 1 breaks.
    pub fn new(game: GameKind) -> Self {
        Self::with_judge(game, judge_of(game))
    }

    /// The same game with other verdicts: house rules.
    pub fn with_judge(game: GameKind, judge: Judge) -> Self {
        Referee {
            game,
            judge,
            phase: Phase::Opening,
            state: State::opening(game, PlayerId::ONE, []),
            is_resumed: false,
            shot: Shot::default(),
            shot_number: 1,
            verdict: None,
        }
    }

    /// The referee of a game that goes on from `state`.
    pub fn resume(game: GameKind, state: State) -> Self {
        Referee { state, is_resumed: true, ..Self::new(game) }
    }

    /// Lets `player` break.
    #[must_use]
    pub fn first_player(mut self, player: PlayerId) -> Self {
        self.state.player = player;
        self
    }

    /// The game.
    pub fn game(&self) -> GameKind {
        self.game
    }

    /// Where it stands.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// Table and game before the shot that comes or is under way; after the end, as it ended.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The verdict on the last shot.
    pub fn verdict(&self) -> Option<&Arc<Verdict>> {
        self.verdict.as_ref()
    }

    /// Begins the game with these object balls and calls the first player.
    pub fn begin(&mut self, on_table: impl IntoIterator<Item = BallId>) -> Sayings {
        if self.phase != Phase::Opening {
            return Sayings::new();
        }
        if !self.is_resumed {
            self.state = State::opening(self.game, self.state.player, on_table);
        }
        self.announce_turn()
    }

    /// Hears one fact. Facts come in time order.
    pub fn handle(&mut self, fact: &Fact) -> Sayings {
        match self.phase {
            Phase::Opening | Phase::Over => Sayings::new(),

            Phase::Placing | Phase::Waiting => match fact.kind {
                FactKind::BallPlaced { ball: BallId::CUE, zone, ok } => {
                    watch(&mut self.shot, fact);
                    self.take_placement(zone, ok)
                }
                FactKind::CueBallStruck { .. } | FactKind::BallTouched { .. } => {
                    watch(&mut self.shot, fact);
                    self.go(Signal::ShotBegan);
                    Sayings::new()
                }
                // What happens between two shots is no part of either.
                FactKind::BallPlaced { .. }
                | FactKind::BallsCollided { .. }
                | FactKind::CushionHit { .. }
                | FactKind::HeadStringCrossed { .. }
                | FactKind::BallPocketed { .. }
                | FactKind::BallOffTable { .. }
                | FactKind::Settled { .. } => Sayings::new(),
            },

            Phase::Shooting => match fact.kind {
                FactKind::Settled { .. } => {
                    watch(&mut self.shot, fact);
                    self.end_shot()
                }
                // The cue ball is placed before a shot, never in it.
                FactKind::BallPlaced { .. } => Sayings::new(),
                _ => {
                    watch(&mut self.shot, fact);
                    Sayings::new()
                }
            },
        }
    }

    /// The cue ball lies where it may, or the player is called once more. Who shoots from a wrong
    /// place all the same commits a foul.
    fn take_placement(&mut self, zone: Zone, ok: bool) -> Sayings {
        if ok && self.state.may_place_in(zone) {
            self.go(Signal::Placed);
            Sayings::new()
        } else {
            self.announce_turn()
        }
    }

    fn end_shot(&mut self) -> Sayings {
        let shot = std::mem::take(&mut self.shot);
        let verdict = Arc::new((self.judge)(&self.state, None, &shot));
        self.state = self.state.after(&shot, &verdict);
        self.verdict = Some(verdict.clone());

        let mut sayings = Sayings::new();
        sayings.push(Event::Verdict(verdict.clone()));
        if !verdict.spot.is_empty() {
            sayings.push(Event::Command(Command::SpotBalls(verdict.spot.clone())));
        }
        if verdict.turn == TurnAfter::End {
            self.go(Signal::GameOver);
        } else {
            self.shot_number = self.shot_number.saturating_add(1);
            sayings.extend(self.announce_turn());
        }
        sayings
    }

    fn announce_turn(&mut self) -> Sayings {
        self.go(match self.state.ball_in_hand {
            BallInHand::None => Signal::TurnAsItLies,
            BallInHand::Kitchen | BallInHand::Anywhere | BallInHand::D => Signal::TurnInHand,
        });
        let turn = Turn {
            player: self.state.player,
            shot: self.state.shot,
            ball_in_hand: self.state.ball_in_hand,
            groups: self.state.groups,
            on_table: self.state.on_table.clone(),
            legal_first: legal_first(self.game, &self.state),
            shot_number: self.shot_number,
        };
        std::iter::once(Event::Turn(Arc::new(turn))).collect()
    }

    fn go(&mut self, signal: Signal) {
        let next = self.phase.after(signal);
        debug_assert!(next.is_some(), "{signal:?} cannot come in {}", self.phase);
        self.phase = next.unwrap_or(self.phase);
    }
}

impl Participant for Referee {
    fn source(&self) -> Source {
        Source::Rules
    }

    fn topics(&self) -> Topics {
        topics(self.game)
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        say(self.begin(table.on_table().map(|ball| ball.id)))
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut sayings = Sayings::new();
        for stamped in delivered.events.iter() {
            if let Event::Fact(fact) = &stamped.event {
                sayings.extend(self.handle(fact));
            }
        }
        say(sayings)
    }

    fn hash(&self, hash: &mut StateHash) {
        hash.u64(self.game as u64);
        hash.u64(self.phase as u64);
        self.state.hash_into(hash);
        self.shot.hash_into(hash);
        hash.u64(self.shot_number.into());
    }
}

fn say(sayings: Sayings) -> Outcome {
    Outcome { publish: sayings.into_iter().map(Into::into).collect(), ..Outcome::default() }
}
