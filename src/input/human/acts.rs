//! What a person begins.

use super::{Human, Stage};
use crate::cue::Aim;
use crate::events::{Event, MenuAction};
use crate::input::{Action, View};

impl Human {
    /// An action begins. True if the game shall end.
    pub(super) fn begin(&mut self, action: Action) -> bool {
        match action {
            Action::Stroke => self.press(),
            Action::Strike => self.press_key(),
            Action::Pause => self.pause_or_resume(),
            Action::Quit => return self.paused,
            Action::BirdsEye if self.view == View::Bird => self.view = View::Usual,
            Action::BirdsEye => self.view = View::Bird,
            Action::NextView => self.view = self.view.next(),
            Action::Camera => self.lead_camera_or_cue(),
            Action::TipMiddle if !self.paused => {
                let middle = |aim: &mut Aim| {
                    (aim.side_offset, aim.height_offset) = (0.0, 0.0);
                };
                self.change_aim(middle);
            }
            Action::Option1 | Action::Option2 | Action::Option3 => {
                action.option().into_iter().for_each(|option| self.pick(option));
            }
            Action::UndoShot if self.is_practice && !self.paused => self.take_shot_back(),
            Action::TakeUpBall if self.is_practice && !self.paused => self.take_up(),
            Action::NextPocket | Action::NextBall | Action::Safety | Action::PushOut => {
                self.step(action);
            }
            Action::PointPocket => self.point_or_not(),
            Action::AimAid => self.ahead.aid = self.ahead.aid.next(),
            Action::Panel => self.overlay = !self.overlay,
            _ => {}
        }
        false
    }

    /// The cue is held as somebody has proposed.
    pub(super) fn hold_so(&mut self, aim: Aim) {
        if self.paused || self.camera.is_free() || !matches!(self.stage, Stage::Aiming) {
            return;
        }
        self.camera.set_out();
        self.raised_rad = aim.elevation_rad;
        self.change_aim(|held| *held = aim);
    }

    /// Time stands still, or goes on: the other of the two.
    pub(super) fn pause_or_resume(&mut self) {
        self.set_paused(!self.paused);
    }

    /// Time stands still, or goes on.
    pub(super) fn set_paused(&mut self, paused: bool) {
        if std::mem::replace(&mut self.paused, paused) == paused {
            return;
        }
        if self.paused {
            // Nobody holds a cue through a pause.
            self.let_go();
            self.say(Event::Menu(MenuAction::Pause));
        } else {
            self.say(Event::Menu(MenuAction::Resume));
        }
    }
}
