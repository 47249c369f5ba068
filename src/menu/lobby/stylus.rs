//! What a stylus says to menus and games, and the wheel menu.

use super::{Edge, Game, Lobby, Order, Pointed};
use crate::input::{Action, Button, HandInput, HumanMode, RawInput, Stick, StylusSays};
use crate::menu::Wheel;
use glam::DVec2;

impl Lobby {
    /// The window is so large from now on [pixels].
    pub fn resize(&mut self, window: DVec2) {
        self.window = window;
    }

    /// The wheel, while it is open.
    pub fn wheel(&self) -> Option<&Wheel> {
        self.wheel.as_ref()
    }

    /// Whether a stylus points at things in the window now, and a pointer belongs there.
    pub fn is_pointed_at(&self) -> bool {
        let mode = matches!(
            self.mode,
            HumanMode::Placing | HumanMode::Pointing | HumanMode::Choosing | HumanMode::Paused
        );
        let is_in_game = self.game == Game::Running && mode && !self.is_free;
        self.is_menu_open() || self.wheel.is_some() || is_in_game
    }

    /// A stylus that points to a place [pixels] says something; `pointed` is the line of a menu
    /// there, and `picked` that of the options.
    pub fn hear_stylus(
        &mut self,
        said: StylusSays,
        place: DVec2,
        pointed: Option<Pointed>,
        picked: Option<usize>,
    ) -> Vec<Order> {
        let mut orders = match said {
            StylusSays::Points(at) => self.stylus_points(at, pointed),
            StylusSays::Button { down, .. } => self.stylus_button(down, pointed, picked),
            StylusSays::Rear { down: true } => self.open_wheel(place),
            StylusSays::Rear { down: false } => self.close_wheel(),
            StylusSays::Lost => {
                self.wheel = None;
                self.stylus_button(false, None, None)
            }
        };
        orders.extend(self.settle());
        orders
    }

    fn stylus_points(&mut self, at: DVec2, pointed: Option<Pointed>) -> Vec<Order> {
        if let Some(wheel) = &mut self.wheel {
            wheel.point(at);
            return Vec::new();
        }
        if self.is_menu_open() {
            return self.point(pointed);
        }
        let points = matches!(self.mode, HumanMode::Placing | HumanMode::Pointing);
        if self.game != Game::Running || !points || self.is_free {
            return Vec::new();
        }
        let from_middle = (at - 0.5 * self.window) / self.window.y.max(1.0);
        let (right, up) = (from_middle.x, -from_middle.y);
        vec![Order::Tell(HandInput::Points { right, up })]
    }

    /// Its front button: a click where something can be clicked. A stroke is the servo's.
    fn stylus_button(
        &mut self,
        down: bool,
        pointed: Option<Pointed>,
        picked: Option<usize>,
    ) -> Vec<Order> {
        if self.is_menu_open() {
            return self.button(Button::Left, down, pointed);
        }
        if !down {
            self.dragged = None;
            let was_told = std::mem::take(&mut self.has_told_click);
            let up = Order::Tell(HandInput::Act { action: Action::Stroke, down: false });
            return if was_told { vec![up] } else { Vec::new() };
        }
        match (self.game, self.mode, picked) {
            _ if self.wheel.is_some() || self.is_free => Vec::new(),
            (Game::Running, HumanMode::Choosing, Some(option)) => {
                vec![Order::Tell(HandInput::Picked { option })]
            }
            (Game::Running, HumanMode::Placing | HumanMode::Pointing, _) => {
                self.has_told_click = true;
                vec![Order::Tell(HandInput::Act { action: Action::Stroke, down: true })]
            }
            _ => Vec::new(),
        }
    }

    /// Opens the wheel round a place of the window, where a game goes on. What devices say goes to
    /// the wheel then, so the game hears that everything is let go.
    pub(super) fn open_wheel(&mut self, place: DVec2) -> Vec<Order> {
        let page = self.wheel_page.clone().filter(|_| self.is_playing());
        self.wheel = page.map(|page| Wheel::open(page, place, self.window));
        self.wheel.iter().map(|_| self.tells(HandInput::FocusLost)).collect()
    }

    /// Closes it, and does what is meant.
    pub(super) fn close_wheel(&mut self) -> Vec<Order> {
        let Some(action) = self.wheel.take().and_then(|wheel| wheel.choice()) else {
            return Vec::new();
        };
        [Edge::Pressed, Edge::Released]
            .into_iter()
            .flat_map(|edge| self.act(action, edge))
            .collect()
    }

    /// The key of the wheel: it is open while that is held.
    pub(super) fn act_on_wheel(&mut self, edge: Edge) -> Vec<Order> {
        match edge {
            Edge::Pressed => self.open_wheel(0.5 * self.window),
            Edge::Repeated => Vec::new(),
            Edge::Released => self.close_wheel(),
        }
    }

    /// A key goes down beside an open wheel: those that move the tip go round it.
    pub(super) fn step_wheel(&mut self, action: Action) -> Vec<Order> {
        if let Some(wheel) = &mut self.wheel {
            match action {
                Action::TipRight | Action::TipDown => wheel.step(true),
                Action::TipLeft | Action::TipUp => wheel.step(false),
                _ => {}
            }
        }
        Vec::new()
    }

    /// The left stick of a gamepad leans towards an action; false if it is for somebody else.
    pub(super) fn lean_wheel(&mut self, input: &HandInput) -> bool {
        match (&mut self.wheel, input) {
            (Some(wheel), HandInput::Stick { stick: Stick::Left, at }) => {
                wheel.lean(DVec2::new(at.x, -at.y));
                true
            }
            (wheel, HandInput::Stick { .. } | HandInput::Trigger(_)) => wheel.is_some(),
            _ => false,
        }
    }

    /// What devices say to an open wheel; false if it is for somebody else.
    pub(super) fn turn_wheel(&mut self, report: &RawInput) -> bool {
        let (Some(wheel), RawInput::Moved { right, up }) = (&mut self.wheel, report) else {
            return false;
        };
        wheel.push(DVec2::new(*right, -*up) * self.window.y);
        true
    }
}
