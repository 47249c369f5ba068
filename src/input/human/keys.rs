//! A turn by keys alone: what held keys move in a tick, and a stroke without a mouse.

use super::super::feel::{
    AIM_RAD_PER_S, ELEVATION_MAX_RAD, ELEVATION_RAD_PER_S, KEY_PULL_M_PER_S, KEY_SPEED_LEAST_M_S,
    KEY_SPEED_MOST_M_S, OFFSET_PER_S, PLACING_M_PER_S, PULL_MAX_M, STROKE_FILTER_RAD_S,
    STROKE_M_PER_HEIGHT, TRIGGER_PULL_M_PER_S,
};
use super::super::tip::Tip;
use super::{Human, Stage};
use crate::cue::Aim;
use crate::input::Action;
use crate::units::TICK_S;
use glam::DVec2;

/// So far beyond the ball a hand goes that strikes by a key [m].
const THROUGH_M: f64 = 0.1;

/// A stroke without a mouse: the farther the tip is pulled back, the harder it strikes in the end.
/// A key pulls as long as it is held; a trigger says how far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct KeyStroke {
    /// How far the hand has pulled back, or has still to push [m].
    way_m: f64,
    /// How hard it is pushed [m/s]; none while it is held.
    push_m_s: Option<f64>,
    /// How far a trigger wants it pulled back [m]; none where a key does it.
    drawn_m: Option<f64>,
}

impl KeyStroke {
    const BEGIN: KeyStroke = KeyStroke { way_m: 0.0, push_m_s: None, drawn_m: None };

    /// A trigger begins it, with this share of the way.
    pub fn drawn_to(share: f64) -> Self {
        KeyStroke { drawn_m: Some(share * PULL_MAX_M), ..KeyStroke::BEGIN }
    }

    /// A trigger wants it pulled back by this share of the way.
    pub fn draw_to(&mut self, share: f64) {
        self.drawn_m = Some(share * PULL_MAX_M);
    }

    /// Whether a trigger holds it.
    pub fn is_drawn(&self) -> bool {
        self.drawn_m.is_some() && self.push_m_s.is_none()
    }

    /// The speed that the stroke has, or would have now [m/s]: fine where it is soft.
    pub fn speed_m_s(&self) -> f64 {
        let share = self.way_m / PULL_MAX_M;
        let range = KEY_SPEED_MOST_M_S - KEY_SPEED_LEAST_M_S;
        self.push_m_s.unwrap_or(KEY_SPEED_LEAST_M_S + range * share * share)
    }

    /// It is let go.
    pub fn push(&mut self) {
        if self.push_m_s.is_none() {
            let speed_m_s = self.speed_m_s();
            self.push_m_s = Some(speed_m_s);
            // The tip lags the hand by two time constants, and shall not brake before the ball.
            self.way_m += THROUGH_M + 2.0 * speed_m_s / STROKE_FILTER_RAD_S;
        }
    }

    /// How far the hand moves forwards in one tick [m]; none if it is through.
    fn step(&mut self) -> Option<f64> {
        match (self.push_m_s, self.drawn_m) {
            (None, Some(drawn_m)) => {
                let most = TRIGGER_PULL_M_PER_S * TICK_S;
                let by = (drawn_m - self.way_m).clamp(-most, most);
                self.way_m += by;
                Some(-by)
            }
            (None, None) => {
                let by = (KEY_PULL_M_PER_S * TICK_S).min(PULL_MAX_M - self.way_m);
                self.way_m += by;
                Some(-by)
            }
            (Some(_), _) if self.way_m <= 0.0 => None,
            (Some(speed_m_s), _) => {
                self.way_m -= speed_m_s * TICK_S;
                Some(speed_m_s * TICK_S)
            }
        }
    }
}

impl Human {
    /// What held keys do in one tick.
    pub(super) fn hold_keys(&mut self) {
        if self.paused || self.camera.is_free() {
            return;
        }
        let fine = self.fine() * TICK_S;
        let right = self.held.balance(Action::TipRight, Action::TipLeft);
        let up = self.held.balance(Action::TipUp, Action::TipDown);
        if (right, up) != (0.0, 0.0) {
            let by = DVec2::new(right, up);
            match &mut self.stage {
                Stage::Aiming if self.pointing.is_some() => {
                    self.point_on(by * (2.0 * PLACING_M_PER_S * TICK_S));
                }
                Stage::Placing(placing) => {
                    let by = by * (PLACING_M_PER_S * fine);
                    placing.moved(by, self.table.bed.as_ref(), self.radius_m);
                }
                _ => self.shift_tip(right * OFFSET_PER_S * fine, up * OFFSET_PER_S * fine),
            }
        }
        let raise = self.held.balance(Action::Raise, Action::Lower);
        if raise != 0.0 {
            self.raise(raise * ELEVATION_RAD_PER_S * fine);
        }
        let left = self.held.balance(Action::TurnLeft, Action::TurnRight);
        self.turn(left * AIM_RAD_PER_S * fine);
    }

    /// Moves the tip on the ball [ball radii].
    pub(super) fn shift_tip(&mut self, right: f64, upwards: f64) {
        self.change_aim(|aim| {
            aim.side_offset += right;
            aim.height_offset += upwards;
        });
    }

    /// Turns the cue to the left, or the workspace of a stylus.
    pub(super) fn turn(&mut self, by_rad: f64) {
        if by_rad != 0.0 && !self.turn_workspace(by_rad, 0.0) {
            self.change_aim(|aim: &mut Aim| aim.azimuth_rad += by_rad);
        }
    }

    /// A key that strikes goes down: it puts a ball down, or begins a stroke.
    pub(super) fn press_key(&mut self) {
        // A stroke that goes on already is not this key's.
        let is_stroking = matches!(self.stage, Stage::Stroking(_));
        self.press();
        if !is_stroking && matches!(self.stage, Stage::Stroking(_)) {
            self.key_stroke = Some(KeyStroke::BEGIN);
        }
    }

    /// It is let go.
    pub(super) fn release_key(&mut self) {
        if let Some(stroke) = self.key_stroke.as_mut().filter(|stroke| !stroke.is_drawn()) {
            stroke.push();
        }
    }

    /// How far a hand that strikes by a key moves in this tick [heights of a window].
    pub(super) fn key_movement(&mut self) -> f64 {
        let Some(stroke) = &mut self.key_stroke else { return 0.0 };
        let Stage::Stroking(tip) = &mut self.stage else {
            self.key_stroke = None;
            return 0.0;
        };
        let step = stroke.step();
        if step.is_none() {
            Tip::let_go(tip, 0.0);
            self.key_stroke = None;
        }
        step.unwrap_or(0.0) / STROKE_M_PER_HEIGHT
    }

    /// Raises the butt.
    pub(super) fn raise(&mut self, by_rad: f64) {
        let is_aiming = matches!(self.stage, Stage::Aiming);
        if self.paused || !is_aiming || self.turn_workspace(0.0, by_rad) {
            return;
        }
        // From what is seen, so that lowering a cue that something holds up acts at once.
        self.raised_rad = (self.aim.elevation_rad + by_rad).clamp(0.0, ELEVATION_MAX_RAD);
        self.change_aim(|_| {});
    }
}
