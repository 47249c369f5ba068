//! What a person says besides strokes: calls, options, and what is asked for in training.

use super::super::calling::{self, Calling, Sight};
use super::{Human, Stage};
use crate::events::{Command, Zone};
use crate::ids::BallId;
use crate::input::Action;
use crate::input::placing::Placing;
use crate::table::Bed;
use glam::DVec2;

impl Human {
    /// Horizontal unit vector of the aim.
    pub(super) fn aimed_along(&self) -> DVec2 {
        let (sin, cos) = libm::sincos(self.aim.azimuth_rad);
        DVec2::new(cos, sin)
    }

    /// The same for training: any ball can be put anywhere, and shots can be taken back.
    #[must_use]
    pub fn for_practice(mut self) -> Self {
        self.is_practice = true;
        self
    }

    /// Whether the player would rather not wait. Whoever holds the cue has all the time there is.
    pub(super) fn is_hurried(&self) -> bool {
        let waits = matches!(self.stage, Stage::Waiting | Stage::Struck);
        waits && !self.paused && self.held.has(Action::Hurry)
    }

    /// A ball was put down.
    pub(super) fn placed(&mut self, ball: BallId, ok: bool) {
        let cue_ball = self.cue_ball();
        match &mut self.stage {
            Stage::Placing(placing) if placing.ball == ball => {
                placing.is_put = false;
                if ok {
                    self.address();
                }
            }
            // A shot was taken back: it lies elsewhere now.
            Stage::Aiming if ball == cue_ball => self.address(),
            _ => {}
        }
    }

    /// Takes a ball in hand.
    pub(super) fn hold(&mut self, ball: BallId, zone: Zone) {
        let bed = self.table.bed.as_ref();
        self.stage = Stage::Placing(Placing::new(ball, zone, &self.seen, bed, self.tee));
    }

    /// Takes an option, if there is one of this number.
    pub(super) fn pick(&mut self, option: usize) {
        let turn = self.turn.as_ref().filter(|_| matches!(self.stage, Stage::Choosing));
        let choice = turn.and_then(|turn| turn.options.get(option).copied());
        if let (Some(choice), false) = (choice, self.paused) {
            self.command(Command::Choose(choice));
        }
    }

    pub(super) fn call_sight(&self) -> Option<Sight<'_>> {
        Some(Sight {
            turn: self.turn.as_deref()?,
            table: &self.seen,
            pockets: &self.table.pockets,
            centre: self.centre,
            direction: self.aimed_along(),
        })
    }

    /// Goes to the next thing: ball in hand, pocket, ball, or kind of call.
    pub(super) fn step(&mut self, action: Action) {
        let backwards = self.held.has(Action::Fine);
        match &self.stage {
            _ if self.paused => {}
            Stage::Placing(placing) if self.is_practice && action == Action::NextPocket => {
                let now = placing.ball;
                let ids: Vec<BallId> = self.seen.balls.iter().map(|ball| ball.id).collect();
                if let Some(ball) = calling::next(&ids, Some(now), backwards) {
                    self.hold(ball, Zone::Anywhere);
                }
            }
            Stage::Aiming => {
                self.with_call(|calling, sight| calling.change(action, backwards, sight));
            }
            _ => {}
        }
    }

    /// Does something to what is called, if there is a turn to call in.
    fn with_call<T>(&mut self, change: impl FnOnce(&mut Calling, &Sight<'_>) -> T) -> Option<T> {
        let mut calling = std::mem::take(&mut self.calling);
        let changed = self.call_sight().map(|sight| change(&mut calling, &sight));
        self.calling = calling;
        changed
    }

    /// A pocket is to be pointed at, or is no longer; only where pockets are called.
    pub(super) fn point_or_not(&mut self) {
        if self.paused || self.camera.is_free() || !matches!(self.stage, Stage::Aiming) {
            return;
        }
        let Some(sight) = self.call_sight().filter(Sight::calls_pockets) else { return };
        let called = self.calling.view(&sight).and_then(|view| view.pocket_at);
        let begin = self.on_bed(called.map_or(DVec2::ZERO, |(at, _)| at));
        self.pointing = if self.pointing.is_some() { None } else { Some(begin) };
    }

    /// What is pointed at goes so far over the bed [m].
    pub(super) fn point_on(&mut self, by: DVec2) {
        if let Some(at) = self.pointing {
            self.point_at(at + by);
        }
    }

    /// This point of the bed is pointed at [m].
    pub(super) fn point_at(&mut self, at: DVec2) {
        let at = self.on_bed(at);
        self.pointing = Some(at);
        self.with_call(|calling, sight| calling.point_at(at, sight));
    }

    fn on_bed(&self, at: DVec2) -> DVec2 {
        let half = self.table.bed.as_ref().map_or(DVec2::ZERO, Bed::half);
        at.clamp(-half, half)
    }

    /// Says what the stroke that begins is meant to do.
    pub(super) fn announce(&mut self) {
        if let Some(call) = self.with_call(Calling::say).flatten() {
            self.command(Command::Call(call));
        }
    }

    /// Training: the last shot was none.
    pub(super) fn take_shot_back(&mut self) {
        self.let_go();
        self.command(Command::Undo);
    }

    /// Training: takes a ball up, or puts it back where it was.
    pub(super) fn take_up(&mut self) {
        let cue_ball = self.cue_ball();
        match self.stage {
            Stage::Aiming => {
                self.command(Command::LiftCue);
                self.hold(cue_ball, Zone::Anywhere);
            }
            Stage::Placing(_) => self.address(),
            _ => {}
        }
    }

    /// The aim has changed: what was chosen by key for another one is forgotten.
    pub(super) fn follow_with_call(&mut self) {
        self.with_call(Calling::follow);
    }
}
