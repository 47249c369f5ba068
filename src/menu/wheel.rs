//! The wheel menu: a ring of actions round the place where a pointer was when it opened (paper,
//! section 3.3.2).
//!
//! An action is meant once the pointer leaves the hub and touches it, and stays meant until another
//! one is touched: the spring that draws a stylus back to the hub changes nothing. When the wheel
//! closes, what is meant is done.

use crate::input::Action;
use crate::one_line::one_line;
use crate::shipped;
use glam::DVec2;
use serde::Deserialize;
use std::sync::Arc;

/// Lengths in heights of the window: of the hub, of the ring on which the actions stand, and of
/// each of them.
const HUB: f64 = 0.045;
const RING: f64 = 0.17;
const ITEM: f64 = 0.062;
/// Most actions on a wheel: more would be too narrow for a hand.
const ITEMS_MAX: usize = 10;

/// What is wrong with a wheel; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum WheelError {
    /// It is no TOML, or has a key that no wheel has.
    #[error("config/menus/wheel.toml: {0}")]
    Form(String),
    /// There is no such action.
    #[error("config/menus/wheel.toml: there is no action {0:?}; they are those of the keys page")]
    Action(String),
    /// Nothing to choose, or too much.
    #[error("config/menus/wheel.toml: {0} actions; a wheel has 2 to {ITEMS_MAX}")]
    Count(usize),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Form {
    actions: Vec<String>,
}

/// The actions of a wheel, clockwise from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WheelPage(Arc<[Action]>);

impl WheelPage {
    /// Reads a file.
    ///
    /// # Errors
    /// [`WheelError`]: what is wrong, and where.
    pub fn parse(text: &str) -> Result<Self, WheelError> {
        let form: Form = toml::from_str(text)
            .map_err(|error| WheelError::Form(one_line(error.to_string().trim_end(), 400)))?;
        if !(2..=ITEMS_MAX).contains(&form.actions.len()) {
            return Err(WheelError::Count(form.actions.len()));
        }
        let named = |name: &String| {
            Action::named(name).ok_or_else(|| WheelError::Action(one_line(name, 40)))
        };
        Ok(WheelPage(form.actions.iter().map(named).collect::<Result<_, _>>()?))
    }

    /// That of the game.
    ///
    /// # Errors
    /// As [`WheelPage::parse`].
    pub fn shipped() -> Result<Self, WheelError> {
        WheelPage::parse(shipped::WHEEL)
    }
}

/// An open wheel.
#[derive(Debug, Clone, PartialEq)]
pub struct Wheel {
    page: WheelPage,
    centre: DVec2,
    /// Where the pointer was when it opened [pixels], and is now in the ring.
    from: DVec2,
    pointer: DVec2,
    height: f64,
    meant: Option<usize>,
}

impl Wheel {
    /// Opens round a pointer [pixels] in a window of this size [pixels]; all of it is inside, even
    /// where the pointer is not.
    pub fn open(page: WheelPage, at: DVec2, window: DVec2) -> Self {
        let margin = DVec2::splat((RING + ITEM) * window.y).min(0.5 * window);
        let centre = at.clamp(margin, window - margin);
        Wheel { page, centre, from: at, pointer: centre, height: window.y, meant: None }
    }

    /// The pointer is here now [pixels], as it was when the wheel was opened.
    pub fn point(&mut self, at: DVec2) {
        self.touch(self.centre + (at - self.from));
    }

    fn touch(&mut self, at: DVec2) {
        self.pointer = at;
        let away = at - self.centre;
        if HUB * self.height < away.length() {
            // Clockwise from the top; pixels count downwards.
            let angle = libm::atan2(away.x, -away.y) / std::f64::consts::TAU;
            let count = self.page.0.len();
            let nearest = libm::round(angle.rem_euclid(1.0) * count as f64) as usize;
            self.meant = Some(nearest % count);
        }
    }

    /// The pointer goes so far to the right and down [pixels].
    pub fn push(&mut self, by: DVec2) {
        // One that is pushed without seeing it does not get lost outside.
        let away = (self.pointer + by - self.centre).clamp_length_max(RING * self.height);
        self.touch(self.centre + away);
    }

    /// A stick leans to the right and down, each from −1 to 1.
    pub fn lean(&mut self, to: DVec2) {
        self.touch(self.centre + to.clamp_length_max(1.0) * (RING * self.height));
    }

    /// The next action clockwise is meant, or the one before.
    pub fn step(&mut self, is_next: bool) {
        let count = self.page.0.len();
        self.meant = Some(match (self.meant, is_next) {
            (None, _) => 0,
            (Some(meant), true) => (meant + 1) % count,
            (Some(meant), false) => (meant + count - 1) % count,
        });
    }

    /// It closes: what is to be done.
    pub fn choice(&self) -> Option<Action> {
        self.meant.and_then(|meant| self.page.0.get(meant).copied())
    }

    /// Where it is open [pixels].
    pub fn centre(&self) -> DVec2 {
        self.centre
    }

    /// Where the pointer is [pixels].
    pub fn pointer(&self) -> DVec2 {
        self.pointer
    }

    /// Radius of the hub [pixels].
    pub fn hub(&self) -> f64 {
        HUB * self.height
    }

    /// The actions: each with the middle and the radius of its disc [pixels], and whether it is
    /// meant.
    pub fn items(&self) -> impl Iterator<Item = (Action, DVec2, f64, bool)> {
        let count = self.page.0.len();
        self.page.0.iter().enumerate().map(move |(n, action)| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * n as f64 / count as f64);
            let at = self.centre + DVec2::new(sin, -cos) * (RING * self.height);
            (*action, at, ITEM * self.height, self.meant == Some(n))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: DVec2 = DVec2::new(500.0, 400.0);

    fn wheel() -> Wheel {
        let page = WheelPage::parse(r#"actions = ["pause", "help", "camera", "safety"]"#).unwrap();
        Wheel::open(page, AT, DVec2::new(1600.0, 1000.0))
    }

    #[test]
    fn what_is_touched_last_is_meant_though_the_pointer_goes_back() {
        let mut wheel = wheel();
        assert_eq!(wheel.choice(), None);
        wheel.point(AT + DVec2::new(0.0, -40.0));
        assert_eq!(wheel.choice(), None, "in the hub");
        for (way, action) in [
            (DVec2::NEG_Y, Action::Pause),
            (DVec2::X, Action::Help),
            (DVec2::Y, Action::Camera),
            (DVec2::NEG_X, Action::Safety),
        ] {
            wheel.point(AT + way * 60.0);
            assert_eq!(wheel.choice(), Some(action));
            wheel.point(AT);
            assert_eq!(wheel.choice(), Some(action));
        }
        let (_, at, radius, is_meant) = wheel.items().nth(3).unwrap();
        assert!(at.x < AT.x - radius && is_meant);
    }

    #[test]
    fn a_wheel_opened_from_beside_the_window_is_inside_and_can_be_turned() {
        let page = WheelPage::parse(r#"actions = ["pause", "help", "camera", "safety"]"#).unwrap();
        let (window, outside) = (DVec2::new(1600.0, 1000.0), DVec2::new(-300.0, 1400.0));
        let mut wheel = Wheel::open(page, outside, window);
        for (_, at, radius, _) in wheel.items() {
            assert!(DVec2::splat(radius).cmple(at).all() && at.cmple(window - radius).all());
        }
        wheel.point(outside + DVec2::new(0.0, 60.0));
        assert_eq!(wheel.choice(), Some(Action::Camera));
    }

    #[test]
    fn a_pointer_that_is_pushed_stays_near() {
        let mut wheel = wheel();
        wheel.push(DVec2::new(5_000.0, 0.0));
        wheel.push(DVec2::new(-250.0, 0.0));
        assert_eq!(wheel.choice(), Some(Action::Safety));
    }

    #[test]
    fn the_shipped_wheel_is_whole_and_a_wrong_one_says_what_is_wrong() {
        WheelPage::shipped().unwrap();
        let wrong = |text: &str| WheelPage::parse(text).unwrap_err().to_string();
        assert!(wrong("actions = [\"pause\"]").contains("1 actions"));
        assert!(wrong("actions = [\"pause\", \"paws\"]").contains("\"paws\""));
        assert!(wrong("action = 3").contains("unknown field"));
    }
}
