//! Which page is open, which line is meant, and what becomes of it.

use super::{Act, Effect, Item, Notice, Page, Pages, Range, Setting, Settings};
use crate::input::{Action, Beside, Bindings, Bound, Control};
use std::sync::Arc;

/// What moves a menu.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MenuInput {
    /// To the line above.
    Up,
    /// To the line below.
    Down,
    /// What is set there becomes less, or the one before.
    Less,
    /// It becomes more, or the next.
    More,
    /// The line is chosen.
    Accept,
    /// Back to where this page was opened from.
    Back,
    /// A pointer is over a line, counted from 0.
    Over(usize),
    /// A pointer chooses a line; `share` of the way along it, from its left [0 to 1].
    Press {
        /// Which line.
        line: usize,
        /// How far along what is set there; none beside it.
        share: Option<f64>,
    },
    /// This was pressed for the action that waits for a key.
    Bind(Control),
    /// No key is wanted any more.
    Never,
}

/// What a menu asks of whoever runs the games.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Deed {
    /// A game begins as it is set.
    Start,
    /// The last game begins again.
    Again,
    /// The game in which a beginner learns to play begins.
    Tutorial,
    /// The last shot is seen again.
    Replay,
    /// The game goes on.
    Resume,
    /// The game ends.
    Leave,
    /// The program ends.
    Quit,
    /// Something was set.
    Changed,
    /// A key means something else.
    Bound,
}

/// An open page.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Opened {
    page: usize,
    focus: usize,
}

/// Menus: what is open, and what is set.
#[derive(Debug, Clone, PartialEq)]
pub struct Menu {
    pages: Arc<Pages>,
    /// The page that is seen is the last; empty while nothing is open.
    opened: Vec<Opened>,
    /// What is set.
    pub settings: Settings,
    /// What keys mean.
    pub bindings: Bindings,
    /// What is to be said of the last deed, until the next.
    pub notice: Option<Notice>,
    /// The action that waits for a key, and whether the old ones stay.
    waits: Option<(Action, Beside)>,
}

impl Menu {
    /// Menus with nothing open, and the keys that are shipped.
    pub fn new(pages: Pages, settings: Settings) -> Self {
        let (pages, opened, bindings) = (Arc::new(pages), Vec::new(), Bindings::shipped());
        Menu { pages, opened, settings, bindings, notice: None, waits: None }
    }

    /// Opens a page in place of whatever is open.
    pub fn open(&mut self, name: &str) {
        self.opened.clear();
        self.waits = None;
        self.enter(name);
    }

    /// Whoever sees the program for the first time is shown where one learns to play. Whether that
    /// is so; it is known from then on.
    pub fn welcome(&mut self) -> bool {
        if self.settings.welcomed {
            return false;
        }
        self.settings.welcomed = true;
        let teaches = |item: &Item| item.effect == Effect::Does(Act::Tutorial);
        let line = self.seen().and_then(|(page, _)| page.items.iter().position(teaches));
        if let Some(line) = line {
            self.mean(line);
            self.notice = Some(Notice::Welcome);
        }
        true
    }

    /// Closes all.
    pub fn close(&mut self) {
        self.opened.clear();
        (self.notice, self.waits) = (None, None);
    }

    /// The action that waits for a key.
    pub fn waits_for_key(&self) -> Option<Action> {
        self.waits.map(|(action, _)| action)
    }

    /// Whether a page is seen.
    pub fn is_open(&self) -> bool {
        !self.opened.is_empty()
    }

    /// The page that is seen, and which of its lines is meant.
    pub fn seen(&self) -> Option<(&Page, usize)> {
        let last = self.opened.last()?;
        Some((self.pages.at(last.page)?, last.focus))
    }

    /// Whether the page that is seen has a line that does this.
    pub fn offers(&self, act: Act) -> bool {
        let does = |item: &Item| item.effect == Effect::Does(act);
        self.seen().is_some_and(|(page, _)| page.items.iter().any(does))
    }

    /// Whether a line can be chosen.
    pub fn is_live(&self, item: &Item) -> bool {
        match item.effect {
            Effect::Sets(setting) => self.settings.is_of_use(setting),
            Effect::Opens(_) | Effect::Does(_) | Effect::Binds(_) => true,
        }
    }

    /// Takes one input; nothing happens while no page is open.
    pub fn hear(&mut self, input: MenuInput) -> Option<Deed> {
        if let Some((action, beside)) = self.waits {
            // Where the pointer goes meanwhile means nothing.
            if matches!(input, MenuInput::Over(_)) {
                return None;
            }
            self.waits = None;
            match input {
                MenuInput::Bind(control) => return self.bind(action, control, beside),
                MenuInput::Press { .. } => {}
                _ => return None,
            }
        }
        let (page, focus) = self.seen()?;
        let (count, effect) = (page.items.len(), page.items.get(focus).map(|i| i.effect.clone()));
        match input {
            MenuInput::Up => self.step(count, count - 1),
            MenuInput::Down => self.step(count, 1),
            MenuInput::Less => return self.turn(effect, false),
            MenuInput::More => return self.turn(effect, true),
            MenuInput::Accept => return self.choose(effect?),
            MenuInput::Back => return self.back(),
            MenuInput::Over(line) => self.mean(line),
            MenuInput::Press { line, share } => return self.press(line, share),
            MenuInput::Bind(_) | MenuInput::Never => {}
        }
        None
    }

    fn bind(&mut self, action: Action, control: Control, beside: Beside) -> Option<Deed> {
        match self.bindings.bind(action, control, beside) {
            Bound::Done { losers } => {
                let has_lost = !losers.is_empty();
                self.notice = has_lost.then_some(Notice::Lost { control, losers });
                Some(Deed::Bound)
            }
            Bound::Refused { of } => {
                self.notice = Some(Notice::Refused { control, of });
                None
            }
        }
    }

    fn enter(&mut self, name: &str) {
        let Some(page) = self.pages.place_of(name) else { return };
        self.opened.push(Opened { page, focus: 0 });
    }

    /// To the next line that can be chosen, `by` lines on at a time.
    fn step(&mut self, count: usize, by: usize) {
        let Some((page, focus)) = self.seen() else { return };
        let lines = (1..=count).map(|n| (focus + n * by) % count);
        let next = lines.into_iter().find(|line| self.is_live(&page.items[*line]));
        if let (Some(next), Some(last)) = (next, self.opened.last_mut()) {
            last.focus = next;
        }
    }

    /// A line is meant, if it can be chosen.
    fn mean(&mut self, line: usize) {
        let is_live =
            self.seen().and_then(|(page, _)| page.items.get(line)).is_some_and(|i| self.is_live(i));
        if let Some(last) = self.opened.last_mut().filter(|_| is_live) {
            last.focus = line;
        }
    }

    fn press(&mut self, line: usize, share: Option<f64>) -> Option<Deed> {
        self.mean(line);
        let (page, focus) = self.seen()?;
        // A line that cannot be chosen.
        let effect = page.items.get(line).filter(|_| focus == line)?.effect.clone();
        match (&effect, share) {
            (Effect::Sets(setting), Some(share)) => self.slide(*setting, share),
            _ => self.choose(effect),
        }
    }

    /// Puts a setting as far along as a pointer is.
    fn slide(&mut self, setting: Setting, share: f64) -> Option<Deed> {
        let before = self.settings.place(setting);
        match Settings::range(setting) {
            Range::Scale(last) => {
                self.settings.put(setting, (share.clamp(0.0, 1.0) * last as f64).round() as usize);
            }
            Range::Choice(_) => return self.turn(Some(Effect::Sets(setting)), 0.5 <= share),
        }
        (before != self.settings.place(setting)).then_some(Deed::Changed)
    }

    fn turn(&mut self, effect: Option<Effect>, is_more: bool) -> Option<Deed> {
        if let (Some(Effect::Binds(action)), true) = (&effect, is_more) {
            (self.notice, self.waits) = (None, Some((*action, Beside::Added)));
            return None;
        }
        let Some(Effect::Sets(setting)) = effect else { return None };
        let before = self.settings.place(setting);
        let after = match (Settings::range(setting), is_more) {
            (Range::Choice(count), true) => (before + 1) % count,
            (Range::Choice(count), false) => (before + count - 1) % count,
            (Range::Scale(last), true) => (before + 1).min(last),
            (Range::Scale(_), false) => before.saturating_sub(1),
        };
        self.settings.put(setting, after);
        (before != after).then_some(Deed::Changed)
    }

    fn choose(&mut self, effect: Effect) -> Option<Deed> {
        self.notice = None;
        match effect {
            Effect::Opens(name) => {
                self.enter(&name);
                None
            }
            Effect::Sets(_) => self.turn(Some(effect), true),
            Effect::Binds(action) => {
                self.waits = Some((action, Beside::Instead));
                None
            }
            Effect::Does(Act::UsualKeys) => {
                self.bindings = Bindings::shipped();
                self.notice = Some(Notice::UsualKeys);
                Some(Deed::Bound)
            }
            Effect::Does(Act::Back) => self.back(),
            Effect::Does(Act::Start) => Some(Deed::Start),
            Effect::Does(Act::Again) => Some(Deed::Again),
            Effect::Does(Act::Tutorial) => Some(Deed::Tutorial),
            Effect::Does(Act::Replay) => Some(Deed::Replay),
            Effect::Does(Act::Resume) => Some(Deed::Resume),
            Effect::Does(Act::Leave) => Some(Deed::Leave),
            Effect::Does(Act::Quit) => Some(Deed::Quit),
        }
    }

    /// To the page before; from the first one, the way out that it offers.
    fn back(&mut self) -> Option<Deed> {
        self.notice = None;
        if 1 < self.opened.len() {
            self.opened.pop();
            return None;
        }
        match (self.offers(Act::Resume), self.offers(Act::Leave)) {
            (true, _) => Some(Deed::Resume),
            (false, true) => Some(Deed::Leave),
            // Nobody ends the program by accident.
            (false, false) => None,
        }
    }
}
