//! From the call to the table to the decision what to play: choosing, placing, a pause.

use super::{Placing, Player, command};
use crate::ai::choose::{Outlook, choose};
use crate::ai::mind::{Decision, TaskKind};
use crate::ai::place::placements;
use crate::ai::plan::Goal;
use crate::ai::view::TableView2d;
use crate::events::{Choice, Command, PlayerState, Turn, Zone};
use crate::tick::{Delivered, Outcome};
use glam::DVec2;
use std::sync::Arc;

/// How long the answer to a placement or to a choice may take [ticks].
const PLACING_TICKS: u64 = 100;
/// How often the cue ball is put down in vain until it is played as it lies.
const PLACING_TRIES: u32 = 40;

impl Player {
    pub(super) fn begin_turn(&mut self, turn: Arc<Turn>, delivered: &Delivered, out: &mut Outcome) {
        self.turn = Some(turn.clone());
        let lies_there = self.look(&delivered.table).cue_ball.is_some();
        let zone = match turn.ball_in_hand.zone() {
            // A cue ball that is nowhere must be put down whatever the turn says.
            None if !lies_there => Some(Zone::Anywhere),
            zone => zone,
        };
        match zone {
            // Nobody takes the ball up before it is decided how it goes on.
            _ if self.must_choose() => self.laze(delivered, out),
            Some(zone) => {
                self.placing = Some(Placing { zone, spots: Vec::new(), tries: 0 });
                match self.search {
                    None => self.place_next(delivered, out),
                    Some(_) => self.pause(TaskKind::Place(zone), delivered, out),
                }
            }
            None => self.laze(delivered, out),
        }
    }

    pub(super) fn must_choose(&self) -> bool {
        self.turn.as_ref().is_some_and(|turn| !turn.options.is_empty())
    }

    /// Takes one of the options; if nobody answers, it is said again.
    pub(super) fn choose(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let Some(turn) = self.turn.clone() else { return };
        let choice = match self.decided(|kind| kind == TaskKind::Choose) {
            Some(Decision::Choose(choice)) if turn.options.contains(&choice) => Some(choice),
            _ => self.choice_from_above(&turn, &self.look(&delivered.table)),
        };
        if let Some(choice) = choice {
            self.has_asked = matches!(choice, Choice::AskAgain | Choice::PutBack);
            command(Command::Choose(choice), out);
        }
        self.report(PlayerState::Idle, out);
        self.due = Some(delivered.tick.after(PLACING_TICKS));
    }

    fn choice_from_above(&self, turn: &Turn, view: &TableView2d) -> Option<Choice> {
        let goal = Goal::of(turn, view, None);
        let outlook = Outlook::of(view, &goal, self.settings.throw_factor);
        choose(&turn.options, outlook, self.has_asked)
    }

    /// Puts the cue ball on the next of the spots, and thinks of new ones if there is none left.
    pub(super) fn place_next(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let view = self.look(&delivered.table);
        let (Some(mut placing), Some(turn)) = (self.placing.take(), self.turn.clone()) else {
            return;
        };
        if placing.tries >= PLACING_TRIES && view.cue_ball.is_some() {
            self.laze(delivered, out);
            return;
        }
        if placing.spots.is_empty() {
            let first = placing.tries == 0;
            let thought = first.then(|| self.spots_thought_of()).flatten();
            placing.spots = thought.unwrap_or_else(|| {
                let goal = Goal::of(&turn, &view, Some(placing.zone));
                let f = self.settings.throw_factor;
                placements(&view, placing.zone, &goal, f, &mut self.rng)
            });
            placing.spots.reverse();
        }
        if let Some(position_m) = placing.spots.pop() {
            let (ball, zone) = (turn.cue_ball, placing.zone);
            command(Command::PlaceBall { ball, position_m, zone }, out);
        }
        placing.tries += 1;
        self.placing = Some(placing);
        self.due = Some(delivered.tick.after(PLACING_TICKS));
    }

    /// The spots that the search found, best first; none if it found none.
    fn spots_thought_of(&mut self) -> Option<Vec<DVec2>> {
        match self.decided(|kind| matches!(kind, TaskKind::Place(_))) {
            Some(Decision::Place(spots)) if !spots.is_empty() => Some(spots),
            _ => None,
        }
    }

    /// The cue ball was put down, or could not be.
    pub(super) fn placed(&mut self, ok: bool, delivered: &Delivered, out: &mut Outcome) {
        match &self.placing {
            Some(placing) if ok => {
                self.played_from = Some(placing.zone);
                self.placing = None;
                self.laze(delivered, out);
            }
            Some(_) => self.place_next(delivered, out),
            None if ok => self.ponder_again(delivered),
            None => {}
        }
    }

    /// A pause before a choice or a stroke.
    pub(super) fn laze(&mut self, delivered: &Delivered, out: &mut Outcome) {
        self.reaims = 0;
        let kind = if self.must_choose() { TaskKind::Choose } else { TaskKind::Shoot };
        self.pause(kind, delivered, out);
    }

    /// A pause whose length is fixed now. Who searches thinks in it, and is waited for at its end.
    fn pause(&mut self, kind: TaskKind, delivered: &Delivered, out: &mut Outcome) {
        self.due = Some(delivered.tick.after(self.pause_ticks()));
        self.ponder(kind, delivered);
        self.report(PlayerState::Lazing, out);
    }

    /// Gives up the turn, if it is at the table at all.
    pub(super) fn leave_table(&mut self, out: &mut Outcome) {
        match self.state {
            PlayerState::Idle | PlayerState::Done => {}
            PlayerState::Analyzing => {
                command(Command::LiftCue, out);
                self.report(PlayerState::Done, out);
            }
            PlayerState::Lazing | PlayerState::Aiming | PlayerState::Shooting => {
                command(Command::LiftCue, out);
            }
        }
        self.report(PlayerState::Idle, out);
        self.due = None;
        self.placing = None;
        self.played_from = None;
        self.turn = None;
        if let Some(search) = &mut self.search {
            search.forget();
        }
    }
}
