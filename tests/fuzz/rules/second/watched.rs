//! A referee at work, with the second judge looking over his shoulder.

use super::SecondJudge;
use hapticbillard::events::{BallInHand, Choice, Command, Event, Fact, FactKind, Groups, Source};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::rules::{GameKind, Judge, Phase, Referee, State};
use std::collections::BTreeMap;

/// What a run has met.
#[derive(Debug, Default)]
pub struct Met {
    /// Shots that both judged.
    pub shots: u64,
    /// Facts and commands.
    pub events: u64,
    /// Games that came to their end.
    pub games: u64,
    /// Choices that were taken.
    pub choices: u64,
    /// Verdicts by the row of the tables that decides them.
    pub rows: BTreeMap<&'static str, u64>,
}

/// A referee who is watched.
pub struct Watched {
    pub referee: Referee,
    second: SecondJudge,
    /// The facts that belong to the shot which comes or is under way.
    heard: Vec<Fact>,
    breaker: PlayerId,
    /// Turns in a row without a pocketed object ball, and whether this one has had one.
    dry: (u32, bool),
}

impl Watched {
    pub fn new(kind: GameKind, judge: Judge, second: SecondJudge) -> Self {
        Watched {
            referee: Referee::with_judge(kind, judge),
            second,
            heard: Vec::new(),
            breaker: PlayerId::ONE,
            dry: (0, false),
        }
    }

    pub fn begin(&mut self, balls: impl IntoIterator<Item = BallId>) {
        self.referee.begin(balls);
    }

    /// The facts of the shot so far.
    pub fn heard(&self) -> &[Fact] {
        &self.heard
    }

    /// The referee hears a fact; if it ends a shot, both judge it.
    pub fn handle(&mut self, fact: &Fact, met: &mut Met) -> Result<(), String> {
        met.events += 1;
        let phase = self.referee.phase();
        if belongs_to_shot(phase, &fact.kind) {
            self.heard.push(*fact);
        }
        let (state, call) = (self.referee.state().clone(), self.referee.call().cloned());
        let said = self.referee.handle(fact);
        if phase != Phase::Shooting || !matches!(fact.kind, FactKind::Settled { .. }) {
            return Ok(());
        }
        let facts = std::mem::take(&mut self.heard);
        let tell = |problem: String| {
            format!("{problem}\nbefore: {state:?}\ncall: {call:?}\nfacts: {facts:?}")
        };
        // The memory of a game is no judge's, but what the judges go by.
        if (state.dry_turns, state.pocketed_this_turn, state.breaker)
            != (self.dry.0, self.dry.1, self.breaker)
        {
            return Err(tell(format!("dry turns are {:?}, {} broke", self.dry, self.breaker)));
        }
        let expected = (self.second)(&state, call.as_ref(), &facts);
        let [Event::Verdict(verdict), ..] = said.as_slice() else {
            return Err(tell(format!("no verdict at rest: {said:?}")));
        };
        if let Some(difference) = expected.differs(verdict) {
            return Err(tell(difference));
        }
        met.shots += 1;
        *met.rows.entry(expected.row).or_default() += 1;

        let is_pot = |fact: &Fact| match fact.kind {
            FactKind::BallPocketed { ball, .. } => ball != BallId::CUE,
            _ => false,
        };
        if facts.iter().any(is_pot) {
            self.dry = (0, true);
        }
        if expected.next_player != Some(state.player) || expected.rack.is_some() {
            self.dry = (if self.dry.1 { 0 } else { self.dry.0 + 1 }, false);
        }
        if expected.rack.is_some() {
            self.dry = (0, false);
        }
        Ok(())
    }

    /// The referee hears a command; of a choice, what follows is looked at.
    pub fn obey(&mut self, source: Source, command: &Command, met: &mut Met) -> Result<(), String> {
        met.events += 1;
        let before = self.referee.state().clone();
        let phase = self.referee.phase();
        self.referee.obey(source, command);
        let by_chooser = source != Source::Ai(before.player.other());
        match command {
            Command::Choose(choice)
                if phase == Phase::Choosing && by_chooser && before.options.contains(choice) =>
            {
                met.choices += 1;
                self.check_choice(&before, *choice)
            }
            _ => Ok(()),
        }
    }

    /// The break's table, third column: what each option means.
    fn check_choice(&mut self, before: &State, choice: Choice) -> Result<(), String> {
        let (chooser, other) = (before.player, before.player.other());
        // Who breaks again, or else whether the 8 returns and where the cue ball is.
        let (again, eight, in_hand) = match choice {
            Choice::Accept => (None, false, BallInHand::None),
            Choice::CueInHandKitchen => (None, false, BallInHand::Kitchen),
            Choice::Respot8Continue => (None, true, BallInHand::None),
            Choice::Respot8CueInHandKitchen => (None, true, BallInHand::Kitchen),
            Choice::RerackAndBreak | Choice::Rebreak => (Some(chooser), true, BallInHand::Kitchen),
            Choice::RerackOpponentBreaks => (Some(other), true, BallInHand::Kitchen),
            Choice::Shoot
            | Choice::PassBack
            | Choice::AskAgain
            | Choice::Play
            | Choice::PutBack
            | Choice::SpotFrozen => {
                return Err(format!("{choice:?} is no choice of eight-ball"));
            }
        };
        let after = self.referee.state();
        let balls: Vec<BallId> = match again {
            Some(_) => (1..=15).map(BallId).collect(),
            None => {
                let is_there = |ball: &BallId| {
                    before.on_table.contains(ball) || (eight && *ball == BallId::EIGHT)
                };
                (1..=15).map(BallId).filter(is_there).collect()
            }
        };
        let holds = after.player == again.unwrap_or(chooser)
            && after.is_break() == again.is_some()
            && after.ball_in_hand == in_hand
            && after.groups == Some(Groups::Open)
            && after.on_table.as_slice() == balls
            && after.options.is_empty();
        if let Some(breaker) = again {
            (self.breaker, self.dry) = (breaker, (0, false));
        }
        if holds { Ok(()) } else { Err(format!("{choice:?} of {before:?} led to {after:?}")) }
    }
}

/// The cue ball's placing before the stroke; what begins a shot; all from there until rest.
fn belongs_to_shot(phase: Phase, what: &FactKind) -> bool {
    match (phase, what) {
        (Phase::Placing | Phase::Waiting, FactKind::BallPlaced { ball, .. }) => {
            *ball == BallId::CUE
        }
        (Phase::Placing | Phase::Waiting, _) => {
            matches!(what, FactKind::CueBallStruck { .. } | FactKind::BallTouched { .. })
        }
        (Phase::Shooting, _) => !matches!(what, FactKind::BallPlaced { .. }),
        (Phase::Opening | Phase::Choosing | Phase::Over, _) => false,
    }
}
