//! The tally: what a game comes to, counted by somebody who only watches.

mod account;
mod interval;

pub use account::Account;
pub use interval::{Decision, SequentialTest, wilson};

use crate::events::{
    BallInHand, Call, CallKind, Command, Event, FactKind, IdeaKind, Insight, ShotKind, Source,
    Topic, Topics, Turn, TurnAfter, Verdict,
};
use crate::hash::StateHash;
use crate::ids::{BallId, PlayerId, PocketId};
use crate::physics::Snapshot;
use crate::tick::{Delivered, Outcome, Participant};
use serde::Serialize;
use std::sync::{Arc, Mutex, PoisonError};

/// What a game came to. Arrays hold player 1, then player 2.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Who won; none in a draw or while it goes on.
    pub winner: Option<PlayerId>,
    /// The rules ended it.
    pub over: bool,
    /// Shots that were judged.
    pub shots: [u32; 2],
    /// Shots that were fouls.
    pub fouls: [u32; 2],
    /// Fouls of a computer player that had considered a shot which was no foul in any of its
    /// simulations.
    pub avoidable: [u32; 2],
    /// Object balls that fell.
    pub pots: [u32; 2],
    /// The winner cleared his group and the 8 in one visit to the table: eight balls or more.
    pub run_out: bool,
    /// Shots that were meant to pocket a ball: it was called, or a computer player chose a shot
    /// that pockets it.
    pub aimed: [u32; 2],
    /// Those of them that did: that ball fell into that pocket, and the shot was no foul.
    pub made: [u32; 2],
    /// Shots that were meant to pocket nothing: called as safety or push-out, or chosen by a
    /// computer player to meet a ball only. A break is none.
    pub safeties: [u32; 2],
    /// Breaks.
    pub breaks: [u32; 2],
    /// Visits to the table that began with the cue ball in hand anywhere.
    pub in_hand: [u32; 2],
    /// Those of them in which the game was won.
    pub in_hand_won: [u32; 2],
    /// The winner won in the visit that began with the break.
    pub break_and_run: bool,
    /// The visit that goes on.
    #[serde(skip)]
    visit: Option<Visit>,
    #[serde(skip)]
    shot: Shot,
}

/// A player's time at the table.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
struct Visit {
    player: PlayerId,
    /// Object balls that fell.
    pots: u32,
    began_with_break: bool,
    began_in_hand: bool,
}

/// What is known of the next shot before it is judged.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
struct Shot {
    is_break: bool,
    is_in_hand: bool,
    intent: Intent,
    had_legal: bool,
    fell: Vec<(BallId, PocketId)>,
}

/// What a shot is meant to do.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
enum Intent {
    /// Nobody said.
    #[default]
    Unknown,
    /// To pocket this ball, here.
    Pot(BallId, PocketId),
    /// To pocket nothing.
    Safety,
}

impl Tally {
    /// Takes one event.
    pub fn hear(&mut self, event: &Event) {
        match event {
            Event::Turn(turn) => self.begin(turn),
            Event::Insight(insight) => self.intend(insight),
            Event::Command(Command::Call(call)) => self.announce(call),
            Event::Fact(fact) => {
                if let FactKind::BallPocketed { ball, pocket, .. } = fact.kind {
                    self.shot.fell.push((ball, pocket));
                }
            }
            Event::Verdict(verdict) => self.count(verdict),
            Event::Command(_) | Event::Player(_) | Event::Menu(_) | Event::Health(_) => {}
        }
    }

    fn begin(&mut self, turn: &Turn) {
        self.shot = Shot {
            is_break: turn.shot == ShotKind::Break,
            is_in_hand: turn.ball_in_hand == BallInHand::Anywhere,
            ..Shot::default()
        };
    }

    fn intend(&mut self, insight: &Insight) {
        let mut others = insight.prospects.iter().filter(|prospect| !prospect.is_chosen);
        self.shot.had_legal = others.any(|other| other.legal == Some(1.0));
        let Some(chosen) = insight.chosen() else { return };
        self.shot.intent = match (chosen.kind, chosen.pot()) {
            (IdeaKind::Break, _) => Intent::Unknown,
            (_, Some((ball, pocket))) => Intent::Pot(ball, pocket),
            (_, None) => Intent::Safety,
        };
    }

    /// What is called counts, whatever was thought.
    fn announce(&mut self, call: &Call) {
        self.shot.intent = match *call {
            Call::Ball { ball, pocket: Some(pocket) } => Intent::Pot(ball, pocket),
            Call::Ball { pocket: None, .. } => self.shot.intent,
            Call::Kind(CallKind::Safety | CallKind::PushOut) => Intent::Safety,
            Call::Kind(CallKind::Nothing) => Intent::Unknown,
        };
    }

    /// Counts one verdict.
    pub fn count(&mut self, verdict: &Verdict) {
        let Some(player) = verdict.player else {
            return;
        };
        let seat = player.index();
        let shot = std::mem::take(&mut self.shot);
        let pots = verdict.pocketed.len() as u32;
        self.shots[seat] += 1;
        self.fouls[seat] += u32::from(!verdict.legal);
        self.avoidable[seat] += u32::from(!verdict.legal && shot.had_legal);
        self.pots[seat] += pots;
        self.breaks[seat] += u32::from(shot.is_break);
        match shot.intent {
            Intent::Unknown => {}
            Intent::Safety => self.safeties[seat] += 1,
            Intent::Pot(ball, pocket) => {
                self.aimed[seat] += 1;
                self.made[seat] += u32::from(verdict.legal && shot.fell.contains(&(ball, pocket)));
            }
        }

        let mut visit = match self.visit.take() {
            Some(visit) if visit.player == player => visit,
            _ => {
                self.in_hand[seat] += u32::from(shot.is_in_hand);
                let (began_with_break, began_in_hand) = (shot.is_break, shot.is_in_hand);
                Visit { player, pots: 0, began_with_break, began_in_hand }
            }
        };
        visit.pots += pots;
        match verdict.turn {
            TurnAfter::Continue => self.visit = Some(visit),
            TurnAfter::Pass => {}
            TurnAfter::End => {
                self.over = true;
                self.winner = verdict.winner;
                let won = verdict.winner == Some(player);
                self.run_out = won && visit.pots >= 8;
                self.break_and_run = won && visit.began_with_break;
                self.in_hand_won[seat] += u32::from(won && visit.began_in_hand);
            }
        }
    }
}

/// Watches a game and shares its tally with whoever holds the other end.
#[derive(Debug, Default, Clone)]
pub struct Scorer(Arc<Mutex<Tally>>);

impl Scorer {
    /// The tally so far.
    pub fn tally(&self) -> Tally {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Participant for Scorer {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[
            Topic::BallPocketed,
            Topic::Command,
            Topic::Insight,
            Topic::Turn,
            Topic::Verdict,
        ])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut tally = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for stamped in delivered.events.iter() {
            tally.hear(&stamped.event);
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::{Fact, Prospect};
    use glam::DVec2;
    use smallvec::SmallVec;

    #[test]
    fn eight_pots_in_one_visit_are_a_run_out() {
        let mut tally = Tally::default();
        let shot = |pocketed: &[u16], turn, winner| Verdict {
            player: Some(PlayerId::ONE),
            legal: true,
            turn,
            winner,
            pocketed: pocketed.iter().map(|id| BallId(*id)).collect(),
            ..Verdict::default()
        };
        tally.count(&shot(&[1, 2, 3, 4], TurnAfter::Continue, None));
        tally.count(&shot(&[5, 6, 7], TurnAfter::Continue, None));
        tally.count(&shot(&[8], TurnAfter::End, Some(PlayerId::ONE)));
        assert_eq!((tally.shots, tally.pots, tally.run_out), ([3, 0], [8, 0], true));

        let mut tally = Tally::default();
        tally.count(&shot(&[1, 2, 3, 4], TurnAfter::Pass, None));
        tally.count(&shot(&[5, 6, 7, 8], TurnAfter::End, Some(PlayerId::ONE)));
        assert!(!tally.run_out);
    }

    /// A shot of player 1 as it is told: turn, thoughts or call, facts, verdict.
    fn told(
        turn: Turn,
        thought: Option<Event>,
        fell: &[(u16, PocketId)],
        verdict: Verdict,
    ) -> Tally {
        let mut tally = Tally::default();
        tally.hear(&Event::Turn(Arc::new(turn)));
        thought.iter().for_each(|event| tally.hear(event));
        for (ball, pocket) in fell {
            let kind =
                FactKind::BallPocketed { ball: BallId(*ball), pocket: *pocket, speed_m_s: 1.0 };
            tally.hear(&Event::Fact(Fact { time_s: 1.0, kind }));
        }
        tally.hear(&Event::Verdict(Arc::new(verdict)));
        tally
    }

    fn verdict(legal: bool, turn: TurnAfter, winner: Option<PlayerId>) -> Verdict {
        Verdict { player: Some(PlayerId::ONE), legal, turn, winner, ..Verdict::default() }
    }

    fn call(ball: u16, pocket: PocketId) -> Option<Event> {
        let call = Call::Ball { ball: BallId(ball), pocket: Some(pocket) };
        Some(Event::Command(Command::Call(call)))
    }

    #[track_caller]
    fn check_intent(thought: Option<Event>, legal: bool, expected: [u32; 3]) {
        let fell = [(3, PocketId::Fl)];
        let tally = told(Turn::default(), thought, &fell, verdict(legal, TurnAfter::Pass, None));
        assert_eq!([tally.aimed[0], tally.made[0], tally.safeties[0]], expected);
    }

    #[test]
    fn a_shot_succeeds_if_its_ball_falls_into_its_pocket_without_a_foul() {
        check_intent(None, true, [0, 0, 0]);
        check_intent(call(3, PocketId::Fl), true, [1, 1, 0]);
        check_intent(call(3, PocketId::Fl), false, [1, 0, 0]);
        check_intent(call(3, PocketId::Fr), true, [1, 0, 0]);
        check_intent(call(4, PocketId::Fl), true, [1, 0, 0]);
        let safety = Event::Command(Command::Call(Call::Kind(CallKind::Safety)));
        check_intent(Some(safety), true, [0, 0, 1]);
    }

    fn thought(kind: IdeaKind, pocket: Option<PocketId>) -> Option<Event> {
        let chosen = Prospect {
            kind,
            ball: Some(BallId(3)),
            pocket,
            ghost: DVec2::ZERO,
            ways: SmallVec::new(),
            chance: None,
            legal: None,
            value: None,
            samples: 0,
            is_chosen: true,
        };
        let (ball, legal) = (Some(BallId(7)), Some(1.0));
        let other = Prospect { is_chosen: false, ball, legal, ..chosen.clone() };
        Some(Event::Insight(Arc::new(Insight {
            player: PlayerId::ONE,
            cue_ball: DVec2::ZERO,
            ways: Vec::new(),
            prospects: vec![other, chosen],
        })))
    }

    #[test]
    fn where_nothing_is_called_the_chosen_thought_is_the_intent() {
        check_intent(thought(IdeaKind::Bank, Some(PocketId::Fl)), true, [1, 1, 0]);
        check_intent(thought(IdeaKind::Contact, None), true, [0, 0, 1]);
        check_intent(thought(IdeaKind::Break, None), true, [0, 0, 0]);
    }

    #[test]
    fn a_foul_is_avoidable_if_another_shot_was_never_one() {
        let foul = || verdict(false, TurnAfter::Pass, None);
        let tally = told(Turn::default(), thought(IdeaKind::Pot, None), &[], foul());
        assert_eq!((tally.fouls[0], tally.avoidable[0]), (1, 1));
        let tally = told(Turn::default(), call(3, PocketId::Fl), &[], foul());
        assert_eq!((tally.fouls[0], tally.avoidable[0]), (1, 0));
    }

    #[test]
    fn a_visit_that_wins_is_counted_by_how_it_began() {
        let end = verdict(true, TurnAfter::End, Some(PlayerId::ONE));
        let in_hand = Turn { ball_in_hand: BallInHand::Anywhere, ..Turn::default() };
        let tally = told(in_hand.clone(), None, &[], end.clone());
        assert_eq!((tally.in_hand, tally.in_hand_won), ([1, 0], [1, 0]));
        assert!(!tally.break_and_run);

        let opening = Turn { shot: ShotKind::Break, ..Turn::default() };
        let mut tally = told(opening, None, &[], verdict(true, TurnAfter::Continue, None));
        // In hand in the midst of a visit is no visit of its own.
        tally.hear(&Event::Turn(Arc::new(in_hand)));
        tally.hear(&Event::Verdict(Arc::new(end)));
        assert_eq!((tally.breaks, tally.break_and_run, tally.in_hand), ([1, 0], true, [0, 0]));
        let account = Account::of(&tally, PlayerId::ONE);
        assert_eq!(account.break_and_run(), Some(1.0));
        assert_eq!(Account::of(&tally, PlayerId::TWO).losses, 1);
    }
}
