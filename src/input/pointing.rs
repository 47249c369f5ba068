//! A stylus as a mouse: where it points in a window, and what its buttons are there (paper, section
//! 3.3.2).

use super::Button;
use crate::haptic::{ButtonEdge, Buttons, DeviceState, DeviceStatus};
use glam::{DVec2, DVec3};

/// d: how far ahead of the tip the stylus points [m]. With it the wrist reaches what the arm would
/// have to go to.
const AHEAD_M: f64 = 0.1;
/// The hand trembles: the pointer goes on when it would go farther than this, in heights of the
/// window. So one that lies on a table leaves the pointer to the mouse.
const TREMBLE: f64 = 0.002;

/// How places and directions of a stylus become places in a window:
/// (x, y) = diag(s) ((X, Y) + d (z_x, z_y)) + t, z where the stylus points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pointing {
    /// s [pixels/m]: to the right, and downwards, which is negative.
    pub scale: DVec2,
    /// t: where the middle of the workspace is [pixels].
    pub middle: DVec2,
    /// d [m].
    pub ahead_m: f64,
}

impl Pointing {
    /// The whole workspace [m] on the whole window [pixels]; faster by a factor, a part of it.
    pub fn on(window: DVec2, workspace_m: DVec3, faster: f64) -> Self {
        let scale = faster * window / workspace_m.truncate();
        Pointing { scale: DVec2::new(scale.x, -scale.y), middle: 0.5 * window, ahead_m: AHEAD_M }
    }

    /// Where a stylus at a place [m] that points along a unit vector points to [pixels].
    pub fn at(&self, position: DVec3, pointing: DVec3) -> DVec2 {
        let place = position.truncate() + self.ahead_m * pointing.truncate();
        self.scale * place + self.middle
    }
}

/// What a stylus says as a mouse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StylusSays {
    /// It points here [pixels], in the window or beside it.
    Points(DVec2),
    /// The front button is the left button of a mouse.
    Button {
        /// Which.
        button: Button,
        /// Pressed, not released.
        down: bool,
    },
    /// The rear button, which opens the wheel menu.
    Rear {
        /// Pressed, not released.
        down: bool,
    },
    /// It is gone: whatever it held is let go, and nothing is meant by that.
    Lost,
}

/// A stylus before a window. Of its places only the newest counts, of its buttons every edge.
#[derive(Debug, Clone)]
pub struct StylusMouse {
    place: Option<DVec2>,
    held: Buttons,
    faster: f64,
}

impl Default for StylusMouse {
    fn default() -> Self {
        StylusMouse { place: None, held: Buttons::default(), faster: 1.0 }
    }
}

impl StylusMouse {
    /// The pointer moves faster by this factor, from now on.
    pub fn set_faster(&mut self, factor: f64) {
        self.faster = factor;
    }

    /// Takes the newest state of a device with this workspace [m], and every edge since the last
    /// time, for a window of this size [pixels]; what it says to that: at most one place, then the
    /// edges in their order. A device that is lost lets go of everything.
    pub fn hear(
        &mut self,
        state: &DeviceState,
        edges: impl IntoIterator<Item = ButtonEdge>,
        window: DVec2,
        workspace_m: DVec3,
    ) -> Vec<StylusSays> {
        let mut said = Vec::new();
        let is_there = state.status != DeviceStatus::Lost && state.is_finite();
        if is_there {
            let pointing = Pointing::on(window, workspace_m, self.faster);
            let wanted = pointing.at(state.position, state.pointing());
            let is_near = |place: DVec2| place.distance(wanted) <= TREMBLE * window.y;
            if !self.place.is_some_and(is_near) {
                // The first place is where it lay: it has not pointed yet.
                let had_place = self.place.replace(wanted).is_some();
                said.extend(had_place.then_some(StylusSays::Points(wanted)));
            }
        }
        for ButtonEdge { button, down, .. } in edges {
            said.extend(self.edge(button, down));
        }
        if !is_there {
            said.extend(self.let_go());
        }
        said
    }

    /// The device is another one, or gone: nothing is held any more, and it has pointed nowhere.
    pub fn let_go(&mut self) -> Option<StylusSays> {
        let was = std::mem::replace(self, StylusMouse { faster: self.faster, ..Self::default() });
        (was.place.is_some() || was.held != Buttons::default()).then_some(StylusSays::Lost)
    }

    /// Where it points [pixels], once it has been seen; it may be outside of the window.
    pub fn place(&self) -> Option<DVec2> {
        self.place
    }

    /// A press, or a release of what was pressed.
    fn edge(&mut self, button: Buttons, down: bool) -> Option<StylusSays> {
        if self.held.has(button) == down {
            return None;
        }
        self.held = if down { self.held.with(button) } else { self.held.without(button) };
        match button {
            Buttons::FRONT => Some(StylusSays::Button { button: Button::Left, down }),
            Buttons::REAR => Some(StylusSays::Rear { down }),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: DVec2 = DVec2::new(1920.0, 1080.0);
    const OMNI_M: DVec3 = DVec3::new(0.160, 0.120, 0.070);

    #[test]
    fn a_stylus_points_as_the_formula_says() {
        let pointing = Pointing::on(WINDOW, OMNI_M, 1.0);
        let tilted = DVec3::new(0.1736, 0.0, -0.9848);
        let at = pointing.at(DVec3::new(0.010, 0.020, -0.005), tilted);
        // s = (12, -9) px/mm, t = (960, 540), d = 100 mm.
        assert!(at.distance(DVec2::new(1288.32, 360.0)) < 1e-9, "{at}");
        assert_eq!(pointing.at(DVec3::ZERO, DVec3::NEG_Z), DVec2::new(960.0, 540.0));
    }

    /// 1 kHz of motion with 200 edges, and somebody who looks 20 times a second.
    #[test]
    fn of_places_the_newest_counts_and_of_buttons_every_edge() {
        let mut mouse = StylusMouse::default();
        let (mut pushed, mut heard) = (Vec::new(), Vec::new());
        let (mut waiting, mut down) = (Vec::new(), false);
        for tick in 0..4_000_u64 {
            if tick % 20 == 7 {
                down = !down;
                waiting.push(ButtonEdge { tick, button: Buttons::FRONT, down });
                pushed.push(down);
            }
            if tick % 50 != 49 {
                continue;
            }
            let x = 0.07 * libm::sin(tick as f64 * 0.003);
            let state = DeviceState { position: DVec3::X * x, ..DeviceState::default() };
            let said = mouse.hear(&state, waiting.drain(..), WINDOW, OMNI_M);
            let is_place = |said: &&StylusSays| matches!(said, StylusSays::Points(_));
            assert!(said.iter().filter(is_place).count() <= 1, "{said:?}");
            let newest = Pointing::on(WINDOW, OMNI_M, 1.0).at(state.position, DVec3::NEG_Z);
            assert!(mouse.place().unwrap().distance(newest) <= TREMBLE * WINDOW.y);
            heard.extend(said.iter().filter_map(|said| match said {
                StylusSays::Button { down, .. } => Some(*down),
                _ => None,
            }));
        }
        assert_eq!(pushed.len(), 200);
        assert_eq!(heard, pushed);
    }

    #[test]
    fn one_that_lies_still_says_nothing_and_one_that_is_lost_lets_go() {
        let mut mouse = StylusMouse::default();
        let state = DeviceState::default();
        let press = |button| Some(ButtonEdge { tick: 1, button, down: true });
        assert!(mouse.hear(&state, None, WINDOW, OMNI_M).is_empty());
        assert!(mouse.hear(&state, None, WINDOW, OMNI_M).is_empty());
        let rear = StylusSays::Rear { down: true };
        assert_eq!(mouse.hear(&state, press(Buttons::REAR), WINDOW, OMNI_M), [rear]);
        // The same press again is none.
        assert!(mouse.hear(&state, press(Buttons::REAR), WINDOW, OMNI_M).is_empty());
        let lost = DeviceState { status: DeviceStatus::Lost, ..state };
        assert_eq!(mouse.hear(&lost, None, WINDOW, OMNI_M), [StylusSays::Lost]);
        assert!(mouse.hear(&lost, None, WINDOW, OMNI_M).is_empty());
        let nan = DeviceState { position: DVec3::NAN, ..state };
        assert!(mouse.hear(&nan, None, WINDOW, OMNI_M).is_empty());
    }
}
