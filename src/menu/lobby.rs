//! Who hears what the devices say: a menu or the game; and what becomes of either.

mod repeat;
use repeat::Repeat;

mod replay;
use replay::ends_replay;

mod stylus;

use super::{Act, Deed, Menu, MenuInput, Notice, Wheel, WheelPage};
use crate::input::{
    Action, Bindings, Button, Control, Controller, Controls, Edge, HandInput, HumanMode, HumanView,
    Key, PadInput, PadMeaning, PadState, Profile, RawInput,
};
use glam::DVec2;

/// What a window has to do next, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Order {
    /// The game hears this.
    Tell(HandInput),
    /// The window does this.
    Do(Action),
    /// The player is told this; the key of a text over the picture.
    Say(&'static str),
    /// A game begins in place of whatever is shown.
    Begin(Begin),
    /// The last shot is seen again, or no longer.
    Replay(bool),
    /// Whoever sees it hears this.
    Onlook(HandInput),
    /// The game that is over is no longer shown.
    Clear,
    /// Something was set: it becomes true now.
    Apply,
    /// Keys mean something else from now on.
    Rebound,
    /// The program ends.
    Quit,
}

/// Which game begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Begin {
    /// The one that is set.
    Set,
    /// The last one.
    Again,
    /// The one in which a beginner learns to play.
    Tutorial,
}

/// The line of a menu under a pointer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pointed {
    /// Which, counted from 0.
    pub line: usize,
    /// How far along what is set there [0 to 1]; none beside it.
    pub share: Option<f64>,
    /// There is a scale, along which it can be pulled.
    pub is_scale: bool,
}

/// Where the game stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Game {
    /// There is none.
    None,
    /// It goes on, or time stands still in it.
    Running,
    /// It was won, and everybody sees how it ended.
    Over,
}

/// A window's menus and its game.
#[derive(Debug, Clone)]
pub struct Lobby {
    menu: Option<Menu>,
    game: Game,
    /// The game was told to go on, and has not yet done so.
    is_resuming: bool,
    /// Whoever plays has had enough of it.
    is_leaving: bool,
    /// What the game's hand does, as it was seen last, and whether anybody plays.
    mode: HumanMode,
    looks_on: bool,
    /// What is held, and what it means.
    controls: Controls,
    pad: PadState,
    /// The last that was pressed was on a gamepad.
    is_by_pad: bool,
    /// What there is to press is shown.
    shows_help: bool,
    /// The gamepad went in the middle of a game, and no menu has said so yet.
    has_lost_pad: bool,
    /// The line of a menu whose scale the pointer holds.
    dragged: Option<usize>,
    /// Size of the window [pixels].
    window: DVec2,
    wheel_page: Option<WheelPage>,
    wheel: Option<Wheel>,
    /// The game has heard that a stylus clicks, and not yet that it lets go.
    has_told_click: bool,
    /// The eye is led by hand.
    is_free: bool,
    /// What a gamepad holds in a menu.
    repeat: Option<Repeat>,
    /// There is a shot that can be seen again.
    has_film: bool,
    /// It is seen again; `Some(true)`: time goes on after that.
    replay: Option<bool>,
}

impl Lobby {
    /// Before the first game. Without menus there is one game, and nothing after it.
    pub fn new(menu: Option<Menu>) -> Self {
        let bindings = menu.as_ref().map_or_else(Bindings::shipped, |menu| menu.bindings.clone());
        Lobby {
            menu,
            game: Game::None,
            is_resuming: false,
            is_leaving: false,
            mode: HumanMode::default(),
            looks_on: false,
            controls: Controls::new(bindings),
            pad: PadState::default(),
            is_by_pad: false,
            shows_help: false,
            has_lost_pad: false,
            dragged: None,
            window: WINDOW,
            // A test reads the file.
            wheel_page: WheelPage::shipped().ok(),
            wheel: None,
            has_told_click: false,
            is_free: false,
            repeat: None,
            has_film: false,
            replay: None,
        }
    }

    /// The same with other keys.
    #[must_use]
    pub fn with_bindings(mut self, bindings: Bindings) -> Self {
        if let Some(menu) = &mut self.menu {
            menu.bindings = bindings.clone();
        }
        self.controls.rebind(bindings);
        self
    }

    /// What keys mean.
    pub fn bindings(&self) -> &Bindings {
        self.controls.bindings()
    }

    /// Whether what there is to press is to be shown.
    pub fn shows_help(&self) -> bool {
        self.shows_help
    }

    /// Whether the player holds a gamepad.
    pub fn is_by_pad(&self) -> bool {
        self.is_by_pad
    }

    /// The menus.
    pub fn menu(&self) -> Option<&Menu> {
        self.menu.as_ref()
    }

    /// Whether a page of a menu is seen.
    pub fn is_menu_open(&self) -> bool {
        self.menu.as_ref().is_some_and(Menu::is_open)
    }

    /// Whether somebody may be playing: a game goes on and no menu is over it.
    pub fn is_playing(&self) -> bool {
        self.game == Game::Running && !self.is_menu_open()
    }

    /// Whether a game goes on, or time stands still in it.
    pub fn has_game(&self) -> bool {
        self.game == Game::Running
    }

    /// Whether the game that is shown is over.
    pub fn is_over(&self) -> bool {
        self.game == Game::Over
    }

    /// Opens the main menu.
    pub fn open_main(&mut self) {
        self.game = Game::None;
        self.open("main");
    }

    /// See [`Menu::welcome`].
    pub fn welcome(&mut self) -> bool {
        self.menu.as_mut().is_some_and(Menu::welcome)
    }

    /// A game has begun.
    pub fn began(&mut self) {
        self.game = Game::Running;
        (self.is_resuming, self.is_leaving, self.has_lost_pad) = (false, false, false);
        (self.mode, self.looks_on) = (HumanMode::default(), false);
        (self.has_film, self.replay) = (false, None);
        self.close();
    }

    /// The game has ended: with a result, which everybody shall see, or not. What follows.
    pub fn ended(&mut self, has_result: bool) -> Vec<Order> {
        let mut orders = self.leave_replay();
        if has_result && !self.is_leaving {
            self.game = Game::Over;
            self.open("over");
            return orders;
        }
        if self.menu.is_none() {
            return vec![Order::Quit];
        }
        self.open_main();
        orders.push(Order::Clear);
        orders
    }

    /// Something went wrong, and a menu says so; false if there is none.
    pub fn complain(&mut self, notice: String) -> bool {
        let Some(menu) = &mut self.menu else { return false };
        menu.notice = Some(Notice::Wrong(notice));
        true
    }

    /// Looks what the game's hand does. If time stands still, the menu of the pause opens, and
    /// otherwise it is not over a game that goes on.
    pub fn see(&mut self, view: &HumanView) -> Vec<Order> {
        (self.mode, self.looks_on) = (view.mode, view.looks_on);
        self.is_free = view.look.free;
        let is_paused = view.mode == HumanMode::Paused;
        self.is_resuming &= is_paused;
        if !is_paused && self.game == Game::Running && self.is_menu_open() {
            self.close();
        }
        let is_meant = !self.is_resuming && !self.is_leaving && self.replay.is_none();
        let opens = is_paused && self.is_playing() && is_meant;
        if opens && self.menu.is_some() {
            self.open("pause");
            if let (Some(menu), true) = (&mut self.menu, std::mem::take(&mut self.has_lost_pad)) {
                menu.notice = Some(Notice::PadLost);
            }
            return vec![Order::Tell(HandInput::FocusLost)];
        }
        self.settle()
    }

    /// A device says something; `pointed` is where a free pointer is.
    pub fn hear(&mut self, report: RawInput, pointed: Option<Pointed>) -> Vec<Order> {
        if self.turn_wheel(&report) {
            return Vec::new();
        }
        let mut orders = match report {
            RawInput::Key { key, down } => {
                self.is_by_pad = false;
                self.control(Control::Key(key), down)
            }
            RawInput::Button { button, down } => {
                self.is_by_pad = false;
                self.button(button, down, pointed)
            }
            RawInput::Pad(report) => self.pad(report),
            RawInput::FocusLost => {
                self.controls.forget();
                (self.dragged, self.wheel, self.has_told_click) = (None, None, false);
                // What sticks do meanwhile nobody hears.
                self.pad = PadState::default();
                self.move_menu(MenuInput::Never);
                let seen = self.replay.map(|_| Order::Onlook(HandInput::FocusLost));
                seen.into_iter().chain([Order::Tell(HandInput::FocusLost)]).collect()
            }
            RawInput::Closed => vec![Order::Tell(HandInput::Closed), Order::Quit],
            RawInput::Moved { right, up } => {
                let factor = self.menu.as_ref().map_or(1.0, |menu| menu.settings.mouse_factor());
                let (right, up) = (right * factor, up * factor);
                self.unless_open(HandInput::Moved { right, up })
            }
            RawInput::Wheel { notches } => self.unless_open(HandInput::Wheel { notches }),
            RawInput::Picked { option } => self.unless_open(HandInput::Picked { option }),
        };
        orders.extend(self.settle());
        orders
    }

    /// A free pointer moves.
    pub fn point(&mut self, pointed: Option<Pointed>) -> Vec<Order> {
        let Some(Pointed { line, share, is_scale }) = pointed.filter(|_| self.is_menu_open())
        else {
            return Vec::new();
        };
        match self.dragged {
            // What goes round is not turned by a trembling hand.
            Some(dragged) if dragged == line && is_scale && share.is_some() => {
                self.move_menu(MenuInput::Press { line, share })
            }
            Some(_) => Vec::new(),
            None => self.move_menu(MenuInput::Over(line)),
        }
    }

    fn unless_open(&self, input: HandInput) -> Vec<Order> {
        if self.is_menu_open() { Vec::new() } else { vec![self.tells(input)] }
    }

    /// The profile of now becomes active; the game hears what that ends.
    fn settle(&mut self) -> Vec<Order> {
        let is_open = self.is_menu_open();
        let profile = match (self.game, self.mode) {
            _ if is_open => Profile::Menu,
            _ if self.replay.is_some() => Profile::Replay,
            (Game::None | Game::Over, _) => Profile::Pause,
            (Game::Running, HumanMode::Paused) if !self.is_resuming => Profile::Pause,
            (Game::Running, HumanMode::Choosing) => Profile::Choice,
            // Whoever leads an eye by hand moves it with the keys of the tip.
            (Game::Running, _) if self.looks_on && !self.is_free => Profile::Camera,
            (Game::Running, _) => Profile::Cue,
        };
        let ended = self.controls.switch(profile);
        let told = ended.into_iter().filter(|action| !is_open && is_for_hand(*action));
        told.map(|action| self.tells(HandInput::Act { action, down: false })).collect()
    }

    /// A key or a button is pressed, or held and repeated, or let go.
    fn control(&mut self, control: Control, down: bool) -> Vec<Order> {
        let is_new = down && !self.controls.holds(control);
        if is_new && self.menu.as_ref().is_some_and(|menu| menu.waits_for_key().is_some()) {
            // It means nothing else.
            self.controls.swallow(control);
            let is_never = control == Control::Key(Key::Escape);
            let input = if is_never { MenuInput::Never } else { MenuInput::Bind(control) };
            return self.move_menu(input);
        }
        if is_new && self.shows_help && self.is_menu_open() {
            self.controls.swallow(control);
            self.shows_help = false;
            return Vec::new();
        }
        match self.controls.hear(control, down) {
            Some((action, edge)) => self.act(action, edge),
            None => Vec::new(),
        }
    }

    fn act(&mut self, action: Action, edge: Edge) -> Vec<Order> {
        match (action.controller(), edge) {
            (Controller::Menu, edge) => self.act_in_menu(action, edge),
            // Nobody else wants to know that a key is still held.
            (_, Edge::Repeated) => Vec::new(),
            (Controller::Leave, Edge::Pressed) if self.is_menu_open() => {
                let offers = self.menu.as_ref().is_some_and(|menu| menu.offers(Act::Leave));
                if offers { self.obey(Deed::Leave) } else { Vec::new() }
            }
            _ if self.replay.is_some() && ends_replay(action) => {
                if edge == Edge::Pressed {
                    self.end_replay()
                } else {
                    Vec::new()
                }
            }
            (_, Edge::Pressed) if action == Action::Replay => self.begin_replay(),
            _ if self.game == Game::Over && matches!(action, Action::Pause | Action::Quit) => {
                if edge == Edge::Pressed {
                    vec![Order::Quit]
                } else {
                    Vec::new()
                }
            }
            _ if action == Action::Wheel => self.act_on_wheel(edge),
            _ if self.wheel.is_some() && edge == Edge::Pressed => self.step_wheel(action),
            _ if action == Action::Help => {
                self.shows_help ^= edge == Edge::Pressed;
                Vec::new()
            }
            _ if is_for_hand(action) => {
                let down = edge == Edge::Pressed;
                // Whoever stops time means it, whatever was told before.
                self.is_resuming &= !(down && action == Action::Pause);
                vec![self.tells(HandInput::Act { action, down })]
            }
            (_, Edge::Pressed) => vec![Order::Do(action)],
            (_, Edge::Released) => Vec::new(),
        }
    }

    /// A held key goes on along lines and values only.
    fn act_in_menu(&mut self, action: Action, edge: Edge) -> Vec<Order> {
        let input = match (action, edge) {
            (_, Edge::Released) => return Vec::new(),
            (Action::MenuUp, _) => MenuInput::Up,
            (Action::MenuDown, _) => MenuInput::Down,
            (Action::MenuLess, _) => MenuInput::Less,
            (Action::MenuMore, _) => MenuInput::More,
            (Action::MenuAccept, Edge::Pressed) => MenuInput::Accept,
            (Action::MenuBack, Edge::Pressed) => MenuInput::Back,
            _ => return Vec::new(),
        };
        self.move_menu(input)
    }

    fn button(&mut self, button: Button, down: bool, pointed: Option<Pointed>) -> Vec<Order> {
        if !down {
            self.dragged = None;
        }
        if !self.is_menu_open() || button != Button::Left {
            return self.control(Control::Button(button), down);
        }
        if !down {
            self.controls.hear(Control::Button(button), down);
            return Vec::new();
        }
        self.controls.swallow(Control::Button(button));
        if std::mem::take(&mut self.shows_help) {
            return Vec::new();
        }
        match pointed {
            Some(Pointed { line, share, .. }) => {
                self.dragged = share.map(|_| line);
                self.move_menu(MenuInput::Press { line, share })
            }
            None => self.move_menu(MenuInput::Never),
        }
    }

    fn pad(&mut self, report: PadInput) -> Vec<Order> {
        match self.pad.hear(report) {
            Some(PadMeaning::Button(button, down)) => {
                self.is_by_pad = true;
                self.control(Control::Pad(button), down)
            }
            Some(PadMeaning::Hand(_)) if self.is_menu_open() => {
                let pushed = self.pad.pushed();
                pushed.map_or_else(Vec::new, |action| self.act_in_menu(action, Edge::Pressed))
            }
            Some(PadMeaning::Hand(input)) if self.lean_wheel(&input) => Vec::new(),
            Some(PadMeaning::Hand(input)) => {
                self.is_by_pad |= input.is_moved();
                vec![self.tells(input)]
            }
            Some(PadMeaning::There(true)) => vec![Order::Say("pad_found")],
            Some(PadMeaning::There(false)) => self.lose_pad(),
            None => Vec::new(),
        }
    }

    /// A gamepad is gone: everything counts as let go, and a game stands still until somebody has
    /// something else in their hands.
    fn lose_pad(&mut self) -> Vec<Order> {
        self.controls.forget();
        self.wheel = None;
        self.is_by_pad = false;
        self.move_menu(MenuInput::Never);
        if self.game != Game::Running {
            return vec![Order::Say("pad_lost")];
        }
        self.has_lost_pad = !self.is_menu_open();
        // After a film time stands still too.
        self.replay = self.replay.map(|_| false);
        vec![Order::Tell(HandInput::PadLost), Order::Say("pad_lost")]
    }

    /// Moves the menu, and does what it asks for.
    fn move_menu(&mut self, input: MenuInput) -> Vec<Order> {
        let deed = self.menu.as_mut().and_then(|menu| menu.hear(input));
        deed.map_or_else(Vec::new, |deed| self.obey(deed))
    }

    fn obey(&mut self, deed: Deed) -> Vec<Order> {
        match deed {
            Deed::Start => vec![Order::Begin(Begin::Set)],
            Deed::Again => vec![Order::Begin(Begin::Again)],
            Deed::Tutorial => vec![Order::Begin(Begin::Tutorial)],
            Deed::Replay => self.begin_replay(),
            Deed::Resume => {
                self.close();
                self.is_resuming = true;
                let action = Action::Pause;
                [true, false].map(|down| Order::Tell(HandInput::Act { action, down })).to_vec()
            }
            Deed::Leave if self.game == Game::Running => {
                self.close();
                self.is_leaving = true;
                vec![Order::Tell(HandInput::Closed)]
            }
            Deed::Leave => {
                self.open_main();
                vec![Order::Clear]
            }
            Deed::Quit => vec![Order::Tell(HandInput::Closed), Order::Quit],
            Deed::Changed => vec![Order::Apply],
            Deed::Bound => {
                if let Some(menu) = &self.menu {
                    self.controls.rebind(menu.bindings.clone());
                }
                vec![Order::Rebound]
            }
        }
    }

    fn open(&mut self, page: &str) {
        if let Some(menu) = &mut self.menu {
            menu.open(page);
        }
        (self.dragged, self.wheel, self.has_told_click) = (None, None, false);
        // The game is told that everything is let go.
        self.settle();
    }

    fn close(&mut self) {
        if let Some(menu) = &mut self.menu {
            menu.close();
        }
        (self.dragged, self.wheel, self.has_told_click) = (None, None, false);
        self.settle();
    }
}

/// Before anybody has said how large a window is [pixels].
const WINDOW: DVec2 = DVec2::new(1280.0, 720.0);

/// Whether an action is one of the game's hand; the window does the others itself.
fn is_for_hand(action: Action) -> bool {
    match action.controller() {
        Controller::Cue | Controller::Choice | Controller::Leave => true,
        Controller::Eye => action != Action::Traces,
        Controller::Clock => action != Action::Replay,
        Controller::Show => action == Action::Panel,
        Controller::Sound | Controller::Film | Controller::Window | Controller::Menu => false,
    }
}
