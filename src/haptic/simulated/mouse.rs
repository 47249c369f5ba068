//! Somebody at a mouse moves the intent of the simulated hand, so that forces can be seen.

use super::script::Intent;
use crate::haptic::device::Buttons;
use crate::units::Seconds;
use glam::DVec3;

/// How a mouse moves the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MouseFeel {
    /// How far the intent goes when the mouse crosses the window's height [m].
    pub m_per_height: f64,
    /// How far it goes towards the user for one notch of the wheel [m].
    pub m_per_notch: f64,
    /// The intent stays within this box about the middle [m].
    pub box_m: DVec3,
    /// Reports of a mouse come in bursts; the intent goes to where they say with this time
    /// constant [s].
    pub smooth_s: Seconds,
    /// The hand lags the mouse, and so does its finger on the front button when it lets go [s]:
    /// a stroke that the mouse has made is not cut short.
    pub finger_s: Seconds,
}

impl Default for MouseFeel {
    fn default() -> Self {
        MouseFeel {
            m_per_height: 0.16,
            m_per_notch: 0.004,
            box_m: DVec3::new(0.17, 0.13, 0.09),
            smooth_s: 0.015,
            finger_s: 0.12,
        }
    }
}

/// The intent of a hand, as a mouse moves it: right and up, or, while the front button is held,
/// along the stroke; the wheel moves it towards the user and away.
#[derive(Debug, Clone)]
pub struct MouseHand {
    feel: MouseFeel,
    home: DVec3,
    wanted: DVec3,
    shown: DVec3,
    /// What is held at the mouse.
    held: Buttons,
    /// What the hand holds: the front button a little longer.
    buttons: Buttons,
    /// How long the finger still holds what was let go [s].
    lingers_s: Seconds,
    /// Then the hand draws back.
    draws_back: bool,
}

impl MouseHand {
    /// A hand in the middle of the workspace.
    pub fn new(feel: MouseFeel) -> Self {
        let home = DVec3::ZERO;
        let buttons = Buttons::default();
        MouseHand {
            feel,
            home,
            wanted: home,
            shown: home,
            held: buttons,
            buttons,
            lingers_s: 0.0,
            draws_back: false,
        }
    }

    /// The same, beginning at a place [m].
    #[must_use]
    pub fn starting_at(self, place: DVec3) -> Self {
        MouseHand { home: place, wanted: place, shown: place, ..self }
    }

    /// Goes back to where it began.
    pub fn go_home(&mut self) {
        self.wanted = self.home;
    }

    /// Draws back in depth to where it began, as soon as the finger has let go.
    pub fn draw_back(&mut self) {
        self.draws_back = true;
    }

    /// The mouse moved, in heights of the window.
    pub fn moved(&mut self, right: f64, up: f64) {
        let way = if self.held.has(Buttons::FRONT) {
            // Pushing the mouse away pushes the cue forward; sideways nothing.
            DVec3::new(0.0, 0.0, -up)
        } else {
            DVec3::new(right, up, 0.0)
        };
        self.go(way * self.feel.m_per_height);
    }

    /// The wheel turned; positive is away from the user.
    pub fn wheel(&mut self, notches: f64) {
        self.go(DVec3::new(0.0, 0.0, -notches * self.feel.m_per_notch));
    }

    /// What is held: the left button of the mouse is the front one, the right the rear one.
    pub fn hold(&mut self, buttons: Buttons) {
        let lets_go = self.held.has(Buttons::FRONT) && !buttons.has(Buttons::FRONT);
        self.held = buttons;
        self.lingers_s = if lets_go { self.feel.finger_s } else { 0.0 };
        self.buttons = if lets_go { buttons.with(Buttons::FRONT) } else { buttons };
    }

    fn go(&mut self, way: DVec3) {
        if way.is_finite() {
            let half = 0.5 * self.feel.box_m;
            self.wanted = (self.wanted + way).clamp(-half, half);
        }
    }

    pub(super) fn step(&mut self, dt: Seconds) {
        let share = -libm::expm1(-dt / self.feel.smooth_s);
        self.shown += (self.wanted - self.shown) * share;
        self.lingers_s = (self.lingers_s - dt).max(0.0);
        if self.lingers_s == 0.0 {
            self.buttons = self.held;
            if std::mem::take(&mut self.draws_back) {
                self.wanted.z = self.home.z;
            }
        }
    }

    pub(super) fn intent(&self) -> Intent {
        Intent { buttons: self.buttons, ..Intent::at(self.shown) }
    }
}
