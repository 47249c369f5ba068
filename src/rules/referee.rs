//! The referee: leads from turn to turn.
//!
//! It hears facts, and only those; where a ball lies is not its business. What it says (verdict,
//! balls to spot, next turn) is due in the tick after the one in which everything came to rest.

use super::game::Judge;
use super::games::game;
use super::phase::{Phase, Signal};
use super::shot::{Shot, watch};
use super::state::State;
use super::{legal_first, topics};
use crate::events::{
    BallInHand, Call, CallKind, Choice, Command, Event, Fact, FactKind, Racked, Racking, Source,
    Spotting, Topic, Topics, Turn, TurnAfter, Verdict, Zone,
};
use crate::hash::StateHash;
use crate::ids::GameKind;
use crate::ids::{BallId, PlayerId};
use crate::physics::Snapshot;
use crate::tick::{Delivered, Outcome, Participant};
use smallvec::SmallVec;
use std::sync::Arc;

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
    /// What the player has announced for the next shot.
    call: Option<Call>,
    shot: Shot,
    shot_number: u32,
    /// Racks of this game so far, the first not counted.
    racks: u32,
    verdict: Option<Arc<Verdict>>,
}

impl Referee {
    /// The referee of a new game; player 1 breaks.
    pub fn new(kind: GameKind) -> Self {
        Self::with_judge(kind, game(kind).judge)
    }

    /// The same game with other verdicts: house rules.
    pub fn with_judge(game: GameKind, judge: Judge) -> Self {
        Referee {
            game,
            judge,
            phase: Phase::Opening,
            state: State::opening(game, PlayerId::ONE, []),
            is_resumed: false,
            call: None,
            shot: Shot::default(),
            shot_number: 1,
            racks: 0,
            verdict: None,
        }
    }

    /// The referee of a game that goes on from `state`.
    pub fn resume(game: GameKind, state: State) -> Self {
        let shot = Shot::of(state.cue_ball);
        Referee { state, shot, is_resumed: true, ..Self::new(game) }
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

    /// What the player has announced for the next shot.
    pub fn call(&self) -> Option<&Call> {
        self.call.as_ref()
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
            self.shot = Shot::of(self.state.cue_ball);
        }
        self.announce_turn()
    }

    /// Hears a command of a player; of the rules' own nothing follows. Who may not choose or call
    /// now, or names what is not offered, is not heard.
    pub fn obey(&mut self, source: Source, command: &Command) -> Sayings {
        if let Source::Ai(player) = source
            && player != self.state.player
        {
            return Sayings::new();
        }
        match (self.phase, command) {
            (Phase::Choosing, Command::Choose(choice)) if self.state.options.contains(choice) => {
                self.take_choice(*choice)
            }
            (Phase::Placing | Phase::Waiting, Command::Call(call)) if self.may_call(call) => {
                self.call = Some(call.clone());
                Sayings::new()
            }
            _ => Sayings::new(),
        }
    }

    fn may_call(&self, call: &Call) -> bool {
        let calls = (game(self.game).calls)(&self.state);
        match call {
            Call::Ball { ball, pocket } => {
                calls.ball
                    && (calls.pocket || pocket.is_none())
                    && self.state.on_table.contains(ball)
            }
            Call::Kind(CallKind::Safety) => calls.safety,
            Call::Kind(CallKind::PushOut) => calls.push_out,
        }
    }

    fn take_choice(&mut self, choice: Choice) -> Sayings {
        let chosen = (game(self.game).choose)(&self.state, choice);
        self.state = chosen.state;
        self.shot = Shot::of(self.state.cue_ball);
        let mut sayings = Sayings::new();
        if !chosen.spot.is_empty() {
            sayings.push(self.spot(chosen.spot));
        }
        if chosen.rack {
            sayings.push(self.rack(Racked::All));
        }
        sayings.extend(self.announce_turn());
        sayings
    }

    /// Balls return to where they belong for whoever shoots next.
    fn spot(&self, balls: SmallVec<[BallId; 4]>) -> Event {
        let cue_ball = self.state.cue_ball;
        Event::Command(Command::SpotBalls(Spotting { balls, cue_ball }))
    }

    fn rack(&mut self, balls: Racked) -> Event {
        self.racks = self.racks.saturating_add(1);
        Event::Command(Command::Rack(Racking { serial: self.racks, balls }))
    }

    /// Hears one fact. Facts come in time order.
    pub fn handle(&mut self, fact: &Fact) -> Sayings {
        match self.phase {
            // Nobody may shoot before a choice is taken.
            Phase::Opening | Phase::Choosing | Phase::Over => Sayings::new(),

            Phase::Placing | Phase::Waiting => match fact.kind {
                FactKind::BallPlaced { ball, zone, ok } if ball == self.state.cue_ball => {
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
                | FactKind::BallsFrozen { .. }
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
        let call = self.call.take();
        let verdict = Arc::new((self.judge)(&self.state, call.as_ref(), &shot));
        self.state = (game(self.game).after)(&self.state, &shot, &verdict);
        self.shot = Shot::of(self.state.cue_ball);
        self.verdict = Some(verdict.clone());

        let mut sayings = Sayings::new();
        sayings.push(Event::Verdict(verdict.clone()));
        if !verdict.spot.is_empty() && verdict.options.is_empty() {
            sayings.push(self.spot(verdict.spot.clone()));
        }
        if let Some(balls) = verdict.rack {
            sayings.push(self.rack(balls));
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
        self.call = None;
        self.go(match self.state.ball_in_hand {
            _ if !self.state.options.is_empty() => Signal::TurnToChoose,
            BallInHand::None => Signal::TurnAsItLies,
            BallInHand::Kitchen | BallInHand::Anywhere | BallInHand::D => Signal::TurnInHand,
        });
        let state = &self.state;
        let turn = Turn {
            player: state.player,
            shot: state.shot,
            ball_in_hand: state.ball_in_hand,
            groups: state.groups,
            on_table: state.on_table.clone(),
            legal_first: legal_first(self.game, state),
            shot_number: self.shot_number,
            options: state.options.clone(),
            calls: (game(self.game).calls)(state),
            cue_ball: state.cue_ball,
            score: game(self.game).has_score.then_some(state.score),
            on: state.on,
            warned: state.warned,
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
        topics(self.game).or(Topics::of(&[Topic::Command]))
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        say(self.begin(table.on_table().map(|ball| ball.id)))
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut sayings = Sayings::new();
        for stamped in delivered.events.iter() {
            match &stamped.event {
                Event::Fact(fact) => sayings.extend(self.handle(fact)),
                Event::Command(command) => {
                    sayings.extend(self.obey(stamped.stamp.source, command));
                }
                _ => {}
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
        hash.u64(self.racks.into());
        hash.u64(match self.call {
            None => 0,
            Some(Call::Kind(CallKind::Safety)) => 1,
            Some(Call::Kind(CallKind::PushOut)) => 2,
            Some(Call::Ball { ball, pocket }) => {
                let pocket = pocket.map_or(0, |pocket| 1 + pocket as u64);
                3 + (u64::from(ball.0) << 8 | pocket)
            }
        });
    }
}

fn say(sayings: Sayings) -> Outcome {
    Outcome { publish: sayings.into_iter().map(Into::into).collect(), ..Outcome::default() }
}
