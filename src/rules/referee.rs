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
use crate::ball::BallState;
use crate::events::{
    BallInHand, Call, CallKind, Choice, Command, Event, Fact, FactKind, Racked, Racking, Source,
    Spotting, Topic, Topics, Turn, TurnAfter, Verdict, Zone,
};
use crate::hash::StateHash;
use crate::ids::GameKind;
use crate::ids::{BallId, PlayerId};
use crate::physics::Snapshot;
use crate::rack::{From, Sight};
use crate::tick::{Delivered, Outcome, Participant};
use smallvec::SmallVec;
use std::collections::VecDeque;
use std::sync::Arc;

/// What the referee says, in this order.
type Sayings = SmallVec<[Event; 4]>;

/// The referee of one game.
///
/// ```
/// use hapticbillard::events::{Event, Fact, FactKind};
/// use hapticbillard::ids::{BallId, GameKind, PlayerId};
/// use hapticbillard::physics::{Simulation, Strike};
/// use hapticbillard::rack::Rack;
/// use hapticbillard::rules::Referee;
/// use hapticbillard::table::Table;
///
/// let mut referee = Referee::new(GameKind::PaperEightBall).first_player(PlayerId::TWO);
/// referee.begin((1..=15).map(BallId));
///
/// let start = Simulation::new(Table::preset("pool-9ft")?, Rack::eight_ball(7))?;
/// let shot = start.strike(Strike { speed_m_s: 8.0, ..Strike::CENTRE })?.run_until_rest()?;
/// let zone = hapticbillard::events::Zone::Kitchen;
/// let placed = FactKind::BallPlaced { ball: BallId::CUE, zone, ok: true };
/// let placed = Fact { time_s: 0.0, kind: placed };
/// for fact in [placed].iter().chain(&shot.facts) {
///     for said in referee.handle(fact) {
///         if let Event::Verdict(verdict) = said {
///             println!("{verdict:?}");
///         }
///     }
/// }
/// assert!(referee.verdict().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Referee {
    game: GameKind,
    judge: Judge,
    phase: Phase,
    state: State,
    /// The rack is not that of the table but part of a state that was given.
    is_resumed: bool,
    /// The object balls of a full rack: those that the game began with.
    full_rack: SmallVec<[BallId; 16]>,
    /// What the player has announced for the next shot.
    call: Option<Call>,
    shot: Shot,
    shot_number: u32,
    /// Racks of this game so far, the first not counted.
    racks: u32,
    verdict: Option<Arc<Verdict>>,
    /// In training, how it stood when each of the last shots began.
    history: VecDeque<(State, u32)>,
    /// Balls are put back: that the cue ball lies then is nobody's placement.
    is_put_back: bool,
    /// What it takes to see whether the next player is snookered, where that matters.
    sight: Option<Sight>,
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
            full_rack: (1..=self::game(game).balls).map(BallId).collect(),
            call: None,
            shot: Shot::default(),
            shot_number: 1,
            racks: 0,
            verdict: None,
            history: VecDeque::new(),
            is_put_back: false,
            sight: None,
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

    /// Lets the first player play alone, where the game has no use for a second one.
    #[must_use]
    pub fn alone(mut self) -> Self {
        self.state.is_alone = true;
        self
    }

    /// Lets it see whether a foul leaves the next player snookered. Without that it believes what
    /// [`FactKind::Settled`] says.
    #[must_use]
    pub fn with_sight(mut self, sight: Sight) -> Self {
        self.sight = Some(sight);
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
            let State { player, is_alone, .. } = self.state;
            self.state = State { is_alone, ..State::opening(self.game, player, on_table) };
            self.full_rack.clone_from(&self.state.on_table);
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
                let is_taken_back = *call == Call::Kind(CallKind::Nothing);
                self.call = (!is_taken_back).then(|| call.clone());
                Sayings::new()
            }
            (Phase::Placing | Phase::Waiting | Phase::Shooting, Command::Undo) => self.take_back(),
            _ => Sayings::new(),
        }
    }

    /// Goes back to how it stood when the last shot began, which may be still under way.
    fn take_back(&mut self) -> Sayings {
        let Some((state, shot_number)) = self.history.pop_back() else { return Sayings::new() };
        self.shot = Shot::of(state.cue_ball);
        (self.state, self.shot_number) = (state, shot_number);
        self.verdict = None;
        self.announce_turn()
    }

    fn begin_shot(&mut self) {
        if self.is_practice() {
            if self.history.len() == game(self.game).takes_back {
                self.history.pop_front();
            }
            self.history.push_back((self.state.clone(), self.shot_number));
        }
        self.go(Signal::ShotBegan);
    }

    fn is_practice(&self) -> bool {
        game(self.game).is_practice
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
            Call::Kind(CallKind::Nothing) => true,
        }
    }

    fn take_choice(&mut self, choice: Choice) -> Sayings {
        let chosen = (game(self.game).choose)(&self.state, choice);
        self.state = chosen.state;
        self.shot = Shot::of(self.state.cue_ball);
        let mut sayings = Sayings::new();
        self.is_put_back = choice == Choice::PutBack;
        if self.is_put_back {
            sayings.push(Event::Command(Command::Undo));
        }
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
        if balls == Racked::All {
            self.state.on_table.clone_from(&self.full_rack);
        }
        self.racks = self.racks.saturating_add(1);
        Event::Command(Command::Rack(Racking { serial: self.racks, balls }))
    }

    /// Hears what a whole shot did, and sees the table after it: for whoever tries shots on a table
    /// of their own.
    pub(crate) fn watch_shot(&mut self, facts: &[Fact], after: &Snapshot) -> Sayings {
        let mut sayings = Sayings::new();
        for fact in facts {
            let fact = self.seen(fact, after);
            sayings.extend(self.handle(&fact));
        }
        sayings
    }

    /// Hears one fact. Facts come in time order.
    pub fn handle(&mut self, fact: &Fact) -> Sayings {
        if let FactKind::BallPlaced { ball, ok: true, .. } = fact.kind
            && self.is_practice()
        {
            watch(&mut self.shot, fact);
            return self.bring_back(ball);
        }
        match self.phase {
            // Nobody may shoot before a choice is taken.
            Phase::Opening | Phase::Choosing | Phase::Over => Sayings::new(),

            Phase::Placing | Phase::Waiting => match fact.kind {
                FactKind::BallPlaced { ball, .. }
                    if ball == self.state.cue_ball && std::mem::take(&mut self.is_put_back) =>
                {
                    Sayings::new()
                }
                FactKind::BallPlaced { ball, zone, ok } if ball == self.state.cue_ball => {
                    watch(&mut self.shot, fact);
                    self.take_placement(zone, ok)
                }
                FactKind::CueBallStruck { .. } | FactKind::BallTouched { .. } => {
                    self.is_put_back = false;
                    watch(&mut self.shot, fact);
                    self.begin_shot();
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

    /// Training: a hand has put a ball down, wherever it was.
    fn bring_back(&mut self, ball: BallId) -> Sayings {
        let is_cue_ball = ball == self.state.cue_ball;
        if is_cue_ball {
            self.state.ball_in_hand = BallInHand::None;
        } else if self.full_rack.contains(&ball) {
            self.state.bring_back(ball);
        }
        match self.phase {
            Phase::Placing | Phase::Waiting if is_cue_ball => {
                self.go(Signal::Placed);
                Sayings::new()
            }
            // Other balls may be met now than before.
            Phase::Placing | Phase::Waiting => self.announce_turn(),
            Phase::Opening | Phase::Choosing | Phase::Shooting | Phase::Over => Sayings::new(),
        }
    }

    /// The fact, and if everything is at rest whether the next player is snookered: physics knows
    /// where balls lie but not which are on, nor which return to their spots.
    fn seen(&self, fact: &Fact, table: &Snapshot) -> Fact {
        let (Some(sight), FactKind::Settled { snookered: false, cue_in_rack }) =
            (&self.sight, fact.kind)
        else {
            return *fact;
        };
        let mut shot = self.shot.clone();
        watch(&mut shot, fact);
        let verdict = (self.judge)(&self.state, self.call.as_ref(), &shot);
        let snookered = !verdict.legal && is_snookered(sight, &self.state, &verdict, table);
        Fact { kind: FactKind::Settled { snookered, cue_in_rack }, ..*fact }
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
        if !verdict.spotted_now().is_empty() {
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
            free_ball: state.free_ball,
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
                Event::Fact(fact) => {
                    let fact = self.seen(fact, &delivered.table);
                    sayings.extend(self.handle(&fact));
                }
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
        for (state, shot_number) in &self.history {
            state.hash_into(hash);
            hash.u64((*shot_number).into());
        }
        // Other games never do that, and keep their hashes.
        if self.is_put_back {
            hash.u64(1);
        }
        hash.u64(match self.call {
            None | Some(Call::Kind(CallKind::Nothing)) => 0,
            Some(Call::Kind(CallKind::Safety)) => 1,
            Some(Call::Kind(CallKind::PushOut)) => 2,
            Some(Call::Ball { ball, pocket }) => {
                let pocket = pocket.map_or(0, |pocket| 1 + pocket as u64);
                3 + (u64::from(ball.0) << 8 | pocket)
            }
        });
    }
}

/// Whether a verdict leaves the next player without a ball on to be hit in a straight line.
fn is_snookered(sight: &Sight, state: &State, verdict: &Verdict, table: &Snapshot) -> bool {
    let lies = |ball: &BallState| (ball.id, ball.position.truncate());
    let (cue_ball, lying): (Vec<_>, Vec<_>) =
        table.on_table().map(lies).partition(|(id, _)| *id == state.cue_ball);
    let from = match (verdict.ball_in_hand, cue_ball.first()) {
        (BallInHand::None, Some((_, place))) => From::Here(*place),
        (BallInHand::D, _) => From::D,
        // From anywhere on the bed something can always be hit.
        _ => return false,
    };
    let stays = match from {
        From::Here(place) => Some(place),
        From::D => None,
    };
    let balls = sight.with_spotted(&lying, stays, &verdict.spot);
    sight.is_snookered(from, &balls, |ball| verdict.ball_on_next.is_some_and(|on| on.is(ball)))
}

fn say(sayings: Sayings) -> Outcome {
    Outcome { publish: sayings.into_iter().map(Into::into).collect(), ..Outcome::default() }
}
