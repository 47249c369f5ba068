//! Who hears what the devices say: a menu or the game; and what becomes of either.

use super::{Act, Deed, Menu, MenuInput};
use crate::input::{Button, Key, RawInput};

/// What a window has to do next, in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Order {
    /// The game hears this.
    Tell(RawInput),
    /// A game begins in place of whatever is shown; `again`: the last one.
    Begin {
        /// See above.
        again: bool,
    },
    /// The game that is over is no longer shown.
    Clear,
    /// Something was set: it becomes true now.
    Apply,
    /// The program ends.
    Quit,
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
    /// Keys that are down, whoever has heard of it.
    held: Vec<Key>,
    /// Those of them whose press the game has heard: it hears their release too.
    told: Vec<Key>,
    /// The line of a menu whose scale the pointer holds.
    dragged: Option<usize>,
}

impl Lobby {
    /// Before the first game. Without menus there is one game, and nothing after it.
    pub fn new(menu: Option<Menu>) -> Self {
        let (is_resuming, is_leaving) = (false, false);
        let (held, told, dragged) = (Vec::new(), Vec::new(), None);
        Lobby { menu, game: Game::None, is_resuming, is_leaving, held, told, dragged }
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

    /// Whether the game that is shown is over.
    pub fn is_over(&self) -> bool {
        self.game == Game::Over
    }

    /// Opens the main menu.
    pub fn open_main(&mut self) {
        self.game = Game::None;
        self.open("main");
    }

    /// A game has begun.
    pub fn began(&mut self) {
        self.game = Game::Running;
        (self.is_resuming, self.is_leaving) = (false, false);
        self.close();
    }

    /// The game has ended: with a result, which everybody shall see, or not. What follows.
    pub fn ended(&mut self, has_result: bool) -> Vec<Order> {
        if has_result && !self.is_leaving {
            self.game = Game::Over;
            self.open("over");
            return Vec::new();
        }
        if self.menu.is_none() {
            return vec![Order::Quit];
        }
        self.open_main();
        vec![Order::Clear]
    }

    /// Something went wrong, and a menu says so; false if there is none.
    pub fn complain(&mut self, notice: String) -> bool {
        let Some(menu) = &mut self.menu else { return false };
        menu.notice = Some(notice);
        true
    }

    /// Looks whether time stands still in the game: then the menu of the pause opens, and otherwise
    /// it is not over a game that goes on.
    pub fn see(&mut self, is_paused: bool) -> Vec<Order> {
        self.is_resuming &= is_paused;
        if !is_paused && self.game == Game::Running {
            self.close();
        }
        let opens = is_paused && self.is_playing() && !self.is_resuming && !self.is_leaving;
        if opens && self.menu.is_some() {
            self.open("pause");
            return vec![Order::Tell(RawInput::FocusLost)];
        }
        Vec::new()
    }

    /// A device says something; `pointed` is where a free pointer is.
    pub fn hear(&mut self, report: RawInput, pointed: Option<Pointed>) -> Vec<Order> {
        match report {
            RawInput::Key { key, down } => self.key(key, down),
            RawInput::Button { button, down } => self.button(button, down, pointed),
            RawInput::FocusLost => {
                self.held.clear();
                self.told.clear();
                self.dragged = None;
                vec![Order::Tell(report)]
            }
            RawInput::Closed => vec![Order::Tell(report), Order::Quit],
            RawInput::Moved { right, up } => {
                let factor = self.menu.as_ref().map_or(1.0, |menu| menu.settings.mouse_factor());
                let (right, up) = (right * factor, up * factor);
                self.unless_open(RawInput::Moved { right, up })
            }
            RawInput::Wheel { .. } | RawInput::Picked { .. } | RawInput::Aid(_) => {
                self.unless_open(report)
            }
        }
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

    fn unless_open(&self, report: RawInput) -> Vec<Order> {
        if self.is_menu_open() { Vec::new() } else { vec![Order::Tell(report)] }
    }

    fn key(&mut self, key: Key, down: bool) -> Vec<Order> {
        // A held key is reported again and again.
        let is_again = self.held.contains(&key);
        self.held.retain(|held| *held != key);
        if down {
            self.held.push(key);
        }
        if self.is_menu_open() {
            return if down { self.menu_key(key, is_again) } else { Vec::new() };
        }
        if self.game == Game::Over {
            let ends = down && !is_again && matches!(key, Key::Escape | Key::Letter('q'));
            return if ends { vec![Order::Quit] } else { Vec::new() };
        }
        // The game hears of no repeats, and of no release of a key that was pressed in a menu.
        let was_told = self.told.contains(&key);
        self.told.retain(|told| *told != key);
        let is_for_game = if down { !is_again } else { was_told };
        if down && (was_told || is_for_game) {
            self.told.push(key);
        }
        if is_for_game { vec![Order::Tell(RawInput::Key { key, down })] } else { Vec::new() }
    }

    /// A key goes down in a menu, or is held there: then only lines and values go on.
    fn menu_key(&mut self, key: Key, is_again: bool) -> Vec<Order> {
        let is_arrow = matches!(key, Key::Up | Key::Down | Key::Left | Key::Right);
        if is_again && !is_arrow {
            return Vec::new();
        }
        let offers_leave = self.menu.as_ref().is_some_and(|menu| menu.offers(Act::Leave));
        match key {
            Key::Letter('q') if offers_leave => self.obey(Deed::Leave),
            _ => menu_input(key).map_or_else(Vec::new, |input| self.move_menu(input)),
        }
    }

    fn button(&mut self, button: Button, down: bool, pointed: Option<Pointed>) -> Vec<Order> {
        if !down {
            self.dragged = None;
        }
        if !self.is_menu_open() {
            return vec![Order::Tell(RawInput::Button { button, down })];
        }
        match (button, down, pointed) {
            (Button::Left, true, Some(Pointed { line, share, .. })) => {
                self.dragged = share.map(|_| line);
                self.move_menu(MenuInput::Press { line, share })
            }
            _ => Vec::new(),
        }
    }

    /// Moves the menu, and does what it asks for.
    fn move_menu(&mut self, input: MenuInput) -> Vec<Order> {
        let deed = self.menu.as_mut().and_then(|menu| menu.hear(input));
        deed.map_or_else(Vec::new, |deed| self.obey(deed))
    }

    fn obey(&mut self, deed: Deed) -> Vec<Order> {
        match deed {
            Deed::Start => vec![Order::Begin { again: false }],
            Deed::Again => vec![Order::Begin { again: true }],
            Deed::Resume => {
                self.close();
                self.is_resuming = true;
                let key = Key::Escape;
                [true, false].map(|down| Order::Tell(RawInput::Key { key, down })).to_vec()
            }
            Deed::Leave if self.game == Game::Running => {
                self.close();
                self.is_leaving = true;
                vec![Order::Tell(RawInput::Closed)]
            }
            Deed::Leave => {
                self.open_main();
                vec![Order::Clear]
            }
            Deed::Quit => vec![Order::Tell(RawInput::Closed), Order::Quit],
            Deed::Changed => vec![Order::Apply],
        }
    }

    fn open(&mut self, page: &str) {
        if let Some(menu) = &mut self.menu {
            menu.open(page);
        }
        // The game is told that everything is let go.
        self.told.clear();
        self.dragged = None;
    }

    fn close(&mut self) {
        if let Some(menu) = &mut self.menu {
            menu.close();
        }
        self.dragged = None;
    }
}

/// What a key does in a menu.
fn menu_input(key: Key) -> Option<MenuInput> {
    Some(match key {
        Key::Up => MenuInput::Up,
        Key::Down | Key::Tab => MenuInput::Down,
        Key::Left => MenuInput::Less,
        Key::Right => MenuInput::More,
        Key::Enter | Key::Space => MenuInput::Accept,
        Key::Escape | Key::Letter('p') => MenuInput::Back,
        _ => return None,
    })
}
