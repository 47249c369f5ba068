//! What a player does with its mail.

use super::Player;
use crate::events::{Event, FactKind, PlayerState, Turn, TurnAfter};
use crate::tick::{Delivered, Outcome};
use std::sync::Arc;

impl Player {
    /// Takes one event of a tick's mail.
    pub(super) fn hear(&mut self, event: &Event, delivered: &Delivered, out: &mut Outcome) {
        match event {
            // The referee calls again after a refused placement; by then the next is under way.
            Event::Turn(turn) if self.is_preparing(turn) => self.called_again(turn, delivered),
            Event::Turn(turn) if turn.player == self.id => {
                self.leave_table(out);
                self.begin_turn(turn.clone(), delivered, out);
            }
            Event::Turn(_) => self.leave_table(out),
            Event::Verdict(verdict) => {
                if self.state == PlayerState::Analyzing {
                    self.finish(delivered.tick, out);
                } else if verdict.turn == TurnAfter::End {
                    self.leave_table(out);
                }
            }
            Event::Fact(fact) => match fact.kind {
                FactKind::BallPlaced { ball, ok, .. } if ball == self.cue_ball() => {
                    self.placed(ok, delivered, out);
                }
                FactKind::BallPlaced { ok: true, .. } | FactKind::BallTouched { .. } => {
                    self.ponder_again(delivered);
                }
                FactKind::CueBallStruck { .. } if self.state == PlayerState::Shooting => {
                    self.withdraw(delivered, out);
                }
                FactKind::Settled { .. } if self.state == PlayerState::Analyzing => {
                    self.finish(delivered.tick, out);
                }
                _ => {}
            },
            _ => {}
        }
    }

    /// Whether this very turn has begun and its shot has not.
    fn is_preparing(&self, turn: &Turn) -> bool {
        let same = self
            .turn
            .as_ref()
            .is_some_and(|own| (own.player, own.shot_number) == (turn.player, turn.shot_number));
        same && match self.state {
            PlayerState::Idle => self.placing.is_some(),
            PlayerState::Lazing | PlayerState::Aiming | PlayerState::Shooting => true,
            PlayerState::Analyzing | PlayerState::Done => false,
        }
    }

    /// The same turn, but what may be met can have changed, where balls are put on the table by
    /// hand.
    fn called_again(&mut self, turn: &Arc<Turn>, delivered: &Delivered) {
        if self.turn.as_ref() != Some(turn) {
            self.turn = Some(turn.clone());
            self.ponder_again(delivered);
        }
    }

    /// Goes on when a state has lasted long enough.
    pub(super) fn go_on(&mut self, delivered: &Delivered, out: &mut Outcome) {
        if self.due.is_none_or(|due| delivered.tick < due) {
            return;
        }
        match self.state {
            PlayerState::Idle | PlayerState::Lazing if self.placing.is_some() => {
                self.place_next(delivered, out);
            }
            PlayerState::Idle | PlayerState::Lazing if self.must_choose() => {
                self.choose(delivered, out);
            }
            PlayerState::Idle => self.due = None,
            PlayerState::Lazing => self.aim(delivered, out),
            PlayerState::Aiming => self.shoot(delivered, out),
            PlayerState::Shooting => self.missed(delivered, out),
            PlayerState::Analyzing => self.finish(delivered.tick, out),
            PlayerState::Done => self.leave_table(out),
        }
    }
}
