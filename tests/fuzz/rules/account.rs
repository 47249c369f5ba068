//! A game as somebody who does not trust the referee writes it down: what must hold in every game.

use super::play::Tally;
use super::{paper, pool};
use hapticbillard::events::{
    BallInHand, Call, Choice, Command, Event, Fact, FactKind, Groups, Racked, Turn, TurnAfter,
    Verdict,
};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::rules::{GameKind, Judge, Phase, Referee, Shot, State, game, watch};

/// Games in which a rule takes points away.
const POINTS_FALL: [&str; 2] = ["straight", "free_carom"];

/// The account of one game.
#[derive(Clone)]
pub struct Account {
    pub kind: GameKind,
    judge: Judge,
    /// Every object ball of the game.
    all: Vec<BallId>,
    /// Those on the table.
    pub on_table: Vec<BallId>,
    /// The cue ball is put back: that it lies then is nobody's placement.
    pub awaits_return: bool,
    pub groups: Option<Groups>,
    /// Who must act: shoot, or choose.
    pub player: PlayerId,
    pub is_break: bool,
    pub shot_number: u32,
    /// What the referee went by before the shot.
    pub state: State,
    /// What the special accounts of some games remember.
    pub paper: paper::Memory,
}

/// What a shot did to the balls, from its facts alone.
pub struct Fate {
    fallen: Vec<BallId>,
    lost: Vec<BallId>,
}

impl Fate {
    fn of(facts: &[Fact]) -> Self {
        let mut fate = Fate { fallen: Vec::new(), lost: Vec::new() };
        for fact in facts {
            match fact.kind {
                FactKind::BallPocketed { ball, .. } => fate.fallen.push(ball),
                FactKind::BallOffTable { ball } => fate.lost.push(ball),
                _ => {}
            }
        }
        fate
    }

    /// Whether a ball went down.
    pub fn fell(&self, ball: BallId) -> bool {
        self.fallen.contains(&ball)
    }

    /// Whether it left the table.
    pub fn left(&self, ball: BallId) -> bool {
        self.lost.contains(&ball)
    }

    /// How many object balls went down.
    pub fn pots(&self, cue_ball: BallId) -> usize {
        let mut balls: Vec<_> = self.fallen.iter().filter(|ball| **ball != cue_ball).collect();
        balls.sort_unstable();
        balls.dedup();
        balls.len()
    }
}

impl Account {
    pub fn new(kind: GameKind, judge: Judge) -> Self {
        Account {
            kind,
            judge,
            all: (1..=game(kind).balls).map(BallId).collect(),
            on_table: (1..=game(kind).balls).map(BallId).collect(),
            awaits_return: false,
            groups: None,
            player: PlayerId::ONE,
            is_break: true,
            shot_number: 1,
            state: State::default(),
            paper: paper::Memory::default(),
        }
    }

    /// The account of a game that goes on from a state.
    pub fn resumed(kind: GameKind, judge: Judge, state: &State) -> Self {
        Account {
            on_table: state.on_table.to_vec(),
            groups: state.groups,
            player: state.player,
            is_break: state.is_break(),
            paper: paper::Memory::resumed(state),
            ..Account::new(kind, judge)
        }
    }

    /// The first turn: player 1 breaks a full rack.
    pub fn check_opening(&mut self, said: &[Event], referee: &Referee) -> Result<(), String> {
        self.groups = referee.state().groups;
        require(matches!(self.groups, None | Some(Groups::Open)), "a game begins with groups")?;
        self.check_turn(said, referee)
    }

    pub fn check_shot(
        &mut self,
        heard: &[Fact],
        call: Option<&Call>,
        said: &[Event],
        referee: &Referee,
        tally: &mut Tally,
    ) -> Result<(), String> {
        let [Event::Verdict(verdict), rest @ ..] = said else {
            return Err(format!("no verdict at rest: {said:?}"));
        };
        let fate = Fate::of(heard);
        self.check_form(verdict, &fate)?;
        self.check_function(heard, call, verdict)?;
        match self.kind {
            GameKind::PaperEightBall => paper::check_eight_ball(self, verdict, &fate)?,
            GameKind::FreePlay => paper::check_free_play(verdict, &fate)?,
            GameKind::WpaNineBall => pool::check_nine_ball(self, call, verdict, &fate)?,
            GameKind::Straight => pool::check_straight(self, call, verdict, &fate)?,
            _ => {}
        }
        self.note(verdict, tally);

        let is_racked = verdict.rack == Some(Racked::All);
        let may_change = is_racked || self.groups == Some(Groups::Open);
        require(may_change || verdict.groups == self.groups, "groups changed")?;
        self.groups = verdict.groups;
        // Of the 8 on the break, and of carom balls that touch, a player chooses if they return.
        let is_chosen = |choice: &Choice| {
            matches!(
                choice,
                Choice::Respot8Continue | Choice::Respot8CueInHandKitchen | Choice::SpotFrozen
            )
        };
        let spots = !verdict.options.iter().any(is_chosen);
        self.awaits_return = false;
        let before = self.on_table.clone();
        match self.is_carom() {
            true => self.move_carom_balls(&fate, verdict, referee)?,
            false => self.move_balls(&fate, verdict, spots)?,
        }
        require(referee.state().on_table.as_slice() == self.on_table, "balls are miscounted")?;
        let missed = referee.state().missed.as_ref();
        let is_kept = missed.is_none_or(|missed| missed.on_table.as_slice() == before);
        require(is_kept, "other balls would be put back than lay there")?;
        self.check_score(verdict, referee)?;
        self.is_break = is_racked;
        self.shot_number += 1;

        let rest = match (verdict.spot.is_empty() || !spots, rest) {
            (true, rest) => rest,
            (false, [Event::Command(Command::SpotBalls(spotting)), rest @ ..]) => {
                require(
                    spotting.balls == verdict.spot,
                    "other balls are spotted than the verdict says",
                )?;
                rest
            }
            (false, _) => return Err("the balls to spot are not spotted".into()),
        };
        let rest = match (verdict.rack, rest) {
            (None, rest) => rest,
            (Some(racked), [Event::Command(Command::Rack(racking)), rest @ ..]) => {
                require(racking.balls == racked, "another rack than the verdict says")?;
                rest
            }
            (Some(_), _) => return Err("the balls to rack are not racked".into()),
        };
        if verdict.turn == TurnAfter::End {
            require(verdict.next_player.is_none(), "somebody shoots after the end")?;
            require(verdict.options.is_empty(), "somebody chooses after the end")?;
            require(rest.is_empty(), "something was said after the end")?;
            return require(referee.phase() == Phase::Over, "the end is not the end");
        }
        require(verdict.winner.is_none(), "somebody won a game that goes on")?;
        self.player = match (verdict.chooser, verdict.next_player) {
            (Some(chooser), _) => chooser,
            (None, Some(next)) => next,
            (None, None) => return Err("nobody acts next".into()),
        };
        require(verdict.chooser.is_some() != verdict.options.is_empty(), "a choice of nobody")?;
        let cue_ball_is_gone = fate.fell(self.state.cue_ball) || fate.left(self.state.cue_ball);
        let returns = verdict.ball_in_hand != BallInHand::None
            || verdict.spot.contains(&self.state.cue_ball)
            || is_racked
            || referee.state().ball_in_hand != BallInHand::None;
        require(!cue_ball_is_gone || returns, "the cue ball is gone and does not come back")?;
        self.check_turn(rest, referee)
    }

    /// What every verdict looks like.
    fn check_form(&self, verdict: &Verdict, fate: &Fate) -> Result<(), String> {
        require(verdict.player == Some(self.player), "the verdict is on another player")?;
        let pots = fate.pots(self.state.cue_ball);
        require(verdict.pocketed.len() == pots, "a pocketed ball is missing or double")?;
        require(verdict.legal == verdict.fouls.is_empty(), "a foul shot is called legal")?;
        let ascending = verdict.fouls.windows(2).all(|pair| pair[0] < pair[1]);
        require(ascending, "fouls are not sorted, or double")?;
        let goes_on = verdict.turn == TurnAfter::Continue;
        let same = verdict.next_player.is_none_or(|next| next == self.player);
        require(!goes_on || same, "the turn continues with somebody else")
    }

    /// A verdict is a function of state, call and shot, and of nothing else.
    fn check_function(
        &self,
        heard: &[Fact],
        call: Option<&Call>,
        verdict: &Verdict,
    ) -> Result<(), String> {
        let mut shot = Shot::of(self.state.cue_ball);
        heard.iter().for_each(|fact| watch(&mut shot, fact));
        let again = (self.judge)(&self.state, call, &shot);
        require(again == *verdict, "the verdict does not follow from state, call and shot")
    }

    fn note(&self, verdict: &Verdict, tally: &mut Tally) {
        let is_end = verdict.turn == TurnAfter::End;
        tally.verdicts += 1;
        tally.fouls += u64::from(!verdict.legal);
        tally.wins += u64::from(verdict.winner.is_some());
        tally.draws += u64::from(is_end && verdict.winner.is_none());
        tally.assigned += u64::from(verdict.groups != self.groups);
        tally.spotted += verdict.spot.len() as u64;
        tally.racks += u64::from(verdict.rack.is_some());
        tally.points += u64::from(!verdict.points.is_nothing());
    }

    /// Whether each player has a cue ball, and no ball is ever gone for good.
    fn is_carom(&self) -> bool {
        matches!(self.kind, GameKind::ThreeCushion | GameKind::FreeCarom)
    }

    /// All three balls are on the table: what was gone is spotted, and each player strikes his own.
    fn move_carom_balls(
        &mut self,
        fate: &Fate,
        verdict: &Verdict,
        referee: &Referee,
    ) -> Result<(), String> {
        let all = (0..=2).map(BallId);
        let is_gone = |ball: &BallId| fate.fell(*ball) || fate.left(*ball);
        let gone: Vec<BallId> = all.clone().filter(is_gone).collect();
        let would = !verdict.options.is_empty();
        require(would || verdict.spot.as_slice() == gone, "other balls return than were gone")?;
        require(!would || gone.is_empty(), "a choice is offered while balls are gone")?;
        let next = verdict.next_player.unwrap_or(self.player);
        let cue_ball = match next == self.player {
            true => self.state.cue_ball,
            false => BallId(1 - self.state.cue_ball.0.min(1)),
        };
        require(referee.state().cue_ball == cue_ball, "the wrong cue ball")?;
        self.on_table = all.filter(|ball| *ball != cue_ball).collect();
        Ok(())
    }

    /// Balls on the table, down and off are all balls, and none comes from nowhere.
    fn move_balls(&mut self, fate: &Fate, verdict: &Verdict, spots: bool) -> Result<(), String> {
        let is_gone = |ball: &BallId| fate.fell(*ball) || fate.left(*ball);
        for ball in &verdict.spot {
            // After a tie snooker's black goes to its spot from wherever it lies.
            let is_tied = self.kind == GameKind::Snooker && self.on_table == [*ball];
            require(is_gone(ball) || is_tied, "a ball is spotted that was not gone")?;
        }
        self.on_table.retain(|ball| !is_gone(ball));
        if spots {
            let cue_ball = self.state.cue_ball;
            self.on_table.extend(verdict.spot.iter().filter(|ball| **ball != cue_ball));
        }
        if verdict.rack.is_some() {
            self.on_table.clone_from(&self.all);
        }
        self.on_table.sort_unstable();
        self.on_table.dedup();
        Ok(())
    }

    /// Points are added up, and fall only where a rule says so.
    fn check_score(&self, verdict: &Verdict, referee: &Referee) -> Result<(), String> {
        for player in [PlayerId::ONE, PlayerId::TWO] {
            let points = verdict.points.of(player);
            let may_fall = POINTS_FALL.contains(&self.kind.short_id());
            require(points >= 0 || may_fall, "points were taken away")?;
            let sum = self.state.score.of(player) + points;
            require(referee.state().score.of(player) == sum, "points are not added up")?;
        }
        Ok(())
    }

    /// Balls may be spotted or racked, and then one player is called.
    pub fn check_choice(
        &mut self,
        said: &[Event],
        referee: &Referee,
        tally: &mut Tally,
    ) -> Result<(), String> {
        let mut rest = said;
        if let [Event::Command(Command::Undo), more @ ..] = rest {
            let Some(missed) = &self.state.missed else {
                return Err("balls are put back after no miss".into());
            };
            self.on_table = missed.on_table.to_vec();
            self.awaits_return = true;
            rest = more;
        }
        if let [Event::Command(Command::SpotBalls(spotting)), more @ ..] = rest {
            let is_carom = self.is_carom();
            for ball in spotting.balls.iter().filter(|_| !is_carom) {
                require(!self.on_table.contains(ball), "a ball is spotted that lies there")?;
                self.on_table.push(*ball);
            }
            self.on_table.sort_unstable();
            rest = more;
        }
        if let [Event::Command(Command::Rack(_)), more @ ..] = rest {
            self.on_table.clone_from(&self.all);
            self.groups = referee.state().groups;
            self.is_break = true;
            tally.racks += 1;
            rest = more;
        }
        self.player = referee.state().player;
        require(referee.state().options.is_empty(), "a choice leads to a choice")?;
        self.check_turn(rest, referee)
    }

    /// In training a hand puts down any ball there is.
    pub fn put(&mut self, ball: BallId) {
        if self.all.contains(&ball) && !self.on_table.contains(&ball) {
            self.on_table.push(ball);
            self.on_table.sort_unstable();
        }
    }

    /// Exactly one player is called, and knows how the table stands.
    pub fn check_turn(&mut self, said: &[Event], referee: &Referee) -> Result<(), String> {
        let [Event::Turn(turn)] = said else {
            return Err(format!("one turn was awaited, not {said:?}"));
        };
        require([PlayerId::ONE, PlayerId::TWO].contains(&turn.player), "a third player")?;
        require(turn.player == self.player, "the wrong player is called")?;
        require(turn.shot_number == self.shot_number, "shots are miscounted")?;
        require(turn.on_table.as_slice() == self.on_table, "the turn has other balls")?;
        require(turn.groups == self.groups, "the turn has other groups")?;
        let all_lie = turn.legal_first.iter().all(|ball| turn.on_table.contains(ball));
        require(all_lie && turn.legal_first.is_sorted(), "a ball on is not on the table")?;
        require(referee.phase() == phase_of(turn), "the phase contradicts the turn")?;
        self.state = referee.state().clone();
        Ok(())
    }
}

/// The phase that a turn begins in.
fn phase_of(turn: &Turn) -> Phase {
    match turn.ball_in_hand {
        _ if !turn.options.is_empty() => Phase::Choosing,
        BallInHand::None => Phase::Waiting,
        BallInHand::Kitchen | BallInHand::Anywhere | BallInHand::D => Phase::Placing,
    }
}

pub fn require(holds: bool, problem: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem.into()) }
}
