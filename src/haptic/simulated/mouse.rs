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
}

impl Default for MouseFeel {
    fn default() -> Self {
        MouseFeel {
            m_per_height: 0.16,
            m_per_notch: 0.004,
            box_m: DVec3::new(0.17, 0.13, 0.09),
            smooth_s: 0.015,
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
    buttons: Buttons,
}

impl MouseHand {
    /// A hand in the middle of the workspace.
    pub fn new(feel: MouseFeel) -> Self {
        let home = DVec3::ZERO;
        MouseHand { feel, home, wanted: home, shown: home, buttons: Buttons::default() }
    }

    /// The same, beginning at a place [m].
    #[must_use]
    pub fn starting_at(self, place: DVec3) -> Self {
        MouseHand { home: place, wanted: place, shown: place, ..self }
    }

    /// Goes back to where it began: altogether, or only towards the user and away.
    pub fn go_back(&mut self, altogether: bool) {
        if altogether {
            self.wanted = self.home;
        }
        self.wanted.z = self.home.z;
    }

    /// The mouse moved, in heights of the window.
    pub fn moved(&mut self, right: f64, up: f64) {
        let way = if self.buttons.has(Buttons::FRONT) {
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
        self.buttons = buttons;
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
    }

    pub(super) fn intent(&self) -> Intent {
        Intent { buttons: self.buttons, ..Intent::at(self.shown) }
    }
}
