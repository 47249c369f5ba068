//! A turn by a gamepad: what its sticks move in a tick, and a stroke by its trigger.

use super::super::Stick;
use super::super::feel::{
    AIM_RAD_PER_S, ELEVATION_RAD_PER_S, LOOK_RAD_PER_S, OFFSET_PER_S, PLACING_M_PER_S,
    STICK_PLACING, STICK_TURN,
};
use super::super::pad::{Pulled, TriggerPull};
use super::{Human, KeyStroke, Stage};
use crate::units::TICK_S;
use glam::DVec2;

/// What the sticks and the trigger that strokes say; let go, they say nothing.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Sticks {
    left: DVec2,
    right: DVec2,
    pressed: f64,
    trigger: TriggerPull,
}

impl Sticks {
    /// A stick is here now.
    pub fn put(&mut self, stick: Stick, at: DVec2) {
        match stick {
            Stick::Left => self.left = at,
            Stick::Right => self.right = at,
        }
    }

    /// Where the left stick is.
    pub fn left(&self) -> DVec2 {
        self.left
    }

    /// The trigger is pressed so far now [0 to 1].
    pub fn pull(&mut self, pressed: f64) {
        self.pressed = pressed;
    }
}

impl Human {
    /// What the sticks do in one tick.
    pub(super) fn hold_sticks(&mut self) {
        let Sticks { left, right, .. } = self.sticks;
        let looks = self.looks_round();
        if looks && right != DVec2::ZERO {
            let by = right * (LOOK_RAD_PER_S * TICK_S);
            self.camera.look(-by.x, by.y);
        }
        if self.paused || self.camera.is_free() {
            return;
        }
        let fine = self.fine() * TICK_S;
        if left != DVec2::ZERO {
            match &mut self.stage {
                Stage::Aiming if self.pointing.is_some() => {
                    self.point_on(left * (STICK_PLACING * PLACING_M_PER_S * TICK_S));
                }
                Stage::Placing(placing) => {
                    let by = left * (STICK_PLACING * PLACING_M_PER_S * fine);
                    placing.moved(by, self.table.bed.as_ref(), self.radius_m);
                }
                _ => {
                    self.turn(-left.x * STICK_TURN * AIM_RAD_PER_S * fine);
                    if left.y != 0.0 {
                        self.raise(left.y * ELEVATION_RAD_PER_S * fine);
                    }
                }
            }
        }
        if !looks && right != DVec2::ZERO {
            let by = right * (OFFSET_PER_S * fine);
            self.shift_tip(by.x, by.y);
        }
    }

    /// What the trigger that strokes does in one tick.
    pub(super) fn hold_trigger(&mut self) {
        let pulled = self.sticks.trigger.step(self.sticks.pressed);
        if self.paused {
            return;
        }
        match (pulled, &mut self.key_stroke) {
            // Whoever points at a pocket clicks.
            (Pulled::Holds(_), None) if self.pointing.is_some() => {}
            (Pulled::Holds(share), None) if matches!(self.stage, Stage::Aiming) && 0.0 < share => {
                self.press();
                if matches!(self.stage, Stage::Stroking(_)) {
                    self.key_stroke = Some(KeyStroke::drawn_to(share));
                }
            }
            (Pulled::Holds(share), Some(stroke)) if stroke.is_drawn() => {
                stroke.draw_to(share);
                // Eased off: nothing is meant to be struck.
                if share <= 0.0 {
                    self.let_go();
                }
            }
            (Pulled::LetGo, Some(stroke)) if stroke.is_drawn() => stroke.push(),
            _ => {}
        }
    }
}
