//! A stylus in the hand of the person at mouse and keyboard. It strikes; the mouse puts the cue
//! ball down, turns the workspace, looks round.

use super::super::hand_over::{Change, HandOver, StylusWord};
use super::{Human, Stage};
use crate::ai::withdrawal;
use crate::cue::Aim;
use crate::events::{Command, Event, Fact, Health};
use crate::units::Tick;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The stylus' name in what the player is told.
pub const STYLUS: &str = "stylus";
const GONE: &str = "the haptic device is gone: the mouse strikes";

impl Human {
    /// The same with a stylus: it strikes as long as its device is there.
    #[must_use]
    pub fn with_stylus(mut self) -> Self {
        self.stylus = Some(HandOver::new());
        self
    }

    /// The same where the mouse itself is what moves the stylus: it turns nothing then.
    #[must_use]
    pub fn whose_mouse_is_the_stylus(mut self) -> Self {
        self.is_mouse_felt = true;
        self
    }

    /// Whether time stands still.
    pub fn is_paused(&self) -> bool {
        self.paused
    }

    /// How far the workspace of the stylus is to be turned to the left and raised since this was
    /// asked last [rad].
    pub fn take_turn(&mut self) -> DVec2 {
        self.stylus.as_mut().map_or(DVec2::ZERO, |stylus| std::mem::take(&mut stylus.turn_rad))
    }

    /// Whether the stylus leads the cue.
    pub(super) fn stylus_leads(&self) -> bool {
        self.stylus.as_ref().is_some_and(HandOver::leads)
    }

    /// Whether what the stylus meets is struck.
    pub(super) fn is_stylus_armed(&self) -> bool {
        self.stylus.as_ref().is_some_and(HandOver::is_armed)
    }

    /// The cue is put to a ball; says so if the stylus is back for it.
    pub(super) fn address_with_stylus(&mut self) {
        let Some(stylus) = &mut self.stylus else { return };
        stylus.address();
        if stylus.leads() && std::mem::take(&mut stylus.is_missed) {
            let back = Health::ActorRestarted { actor: STYLUS.into() };
            self.say(Event::Health(Arc::new(back)));
        }
    }

    /// The mouse turns the workspace to the left and raises it, unless a stroke is armed. False if
    /// the stylus does not lead the cue.
    pub(super) fn turn_workspace(&mut self, left_rad: f64, up_rad: f64) -> bool {
        let is_felt = self.is_mouse_felt;
        let is_aiming = matches!(self.stage, Stage::Aiming);
        match &mut self.stylus {
            Some(stylus) if is_aiming && stylus.leads() => {
                if !is_felt && !stylus.is_armed() {
                    stylus.turn_rad += DVec2::new(left_rad, up_rad);
                }
                true
            }
            _ => false,
        }
    }

    /// Follows the stylus for a tick.
    pub(super) fn follow_stylus(&mut self, tick: Tick, word: &StylusWord) {
        let Some(stylus) = &mut self.stylus else { return };
        let was_armed = stylus.is_armed();
        let change = stylus.hear(word);
        let is_begun = stylus.is_armed() && !was_armed;
        if change.is_some() {
            stylus.is_missed = true;
            let (actor, reason) = (STYLUS.into(), GONE.into());
            self.say(Event::Health(Arc::new(Health::ActorFailed { actor, reason })));
        }
        if let Some(Change::Drops { armed }) = change {
            self.take_over(tick, armed);
        }
        if let Some(hand) = word.camera() {
            self.fly_by(hand);
        }
        let StylusWord::Held { direction, path: Some(path), .. } = word else { return };
        if self.stylus_leads()
            && !self.paused
            && matches!(self.stage, Stage::Aiming | Stage::Struck)
        {
            self.aim = aim_along(*direction);
            // A stroke that begins is announced as it is aimed.
            if is_begun && matches!(self.stage, Stage::Aiming) {
                self.announce();
            }
            self.path = Some((**path).clone());
            self.command(Command::MoveCue(path.clone()));
        }
    }

    /// The mouse takes the cue; in the middle of a stroke it takes a rest first.
    fn take_over(&mut self, tick: Tick, armed: bool) {
        self.path = None;
        match self.stage {
            Stage::Aiming => {
                self.raised_rad = 0.0;
                self.aim.elevation_rad = 0.0;
                self.change_aim(|_| {});
                self.is_aim_new = true;
                self.sight();
                if armed && !self.paused {
                    self.pause_or_resume();
                }
            }
            Stage::Struck => self.withdraw_cue(tick),
            Stage::Waiting | Stage::Choosing | Stage::Placing(_) | Stage::Stroking(_) => {}
        }
    }

    /// Whatever comes now, what the stylus leads touches nothing.
    pub(super) fn disarm_stylus(&mut self) {
        if self.stylus_leads()
            && let Some(path) = self.path.as_mut().filter(|path| path.solid)
        {
            path.solid = false;
            let path = Arc::new(path.clone());
            self.command(Command::MoveCue(path));
        }
    }

    /// The stylus has struck the cue ball.
    pub(super) fn stylus_struck(&mut self, fact: &Fact) {
        self.strength_m_s = self.path_speed(fact);
        self.stage = Stage::Struck;
    }

    /// Speed of the tip on its path at a fact [m/s].
    pub(super) fn path_speed(&self, fact: &Fact) -> f64 {
        let piece = self.path.as_ref().and_then(|path| path.piece_at(fact.time_s));
        piece.map_or(0.0, |piece| piece.at(fact.time_s).1.length())
    }

    /// Speed of the tip now [m/s].
    pub(super) fn tip_speed_m_s(&self) -> f64 {
        let piece = self.path.as_ref().and_then(|path| path.pieces.first());
        piece.map_or(0.0, |piece| piece.velocity.length())
    }

    /// Takes the cue back from where it is.
    pub(super) fn withdraw_cue(&mut self, tick: Tick) {
        if let Some(from) = self.seen.cue {
            let path = withdrawal(&from, tick.end_s());
            self.command(Command::MoveCue(Arc::new(path)));
        }
    }
}

/// A cue held along a unit vector, to the middle of the ball.
fn aim_along(direction: DVec3) -> Aim {
    Aim {
        azimuth_rad: libm::atan2(direction.y, direction.x),
        elevation_rad: libm::asin((-direction.z).clamp(-1.0, 1.0)),
        ..Aim::default()
    }
}
