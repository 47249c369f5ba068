//! A menu as it stands in the window: words, and where they are.

use super::Words;
use crate::ids::PlayerId;
use crate::input::{AimAid, Steering};
use crate::menu::{Effect, Item, Menu, Notice, Pointed, Range, Seat, Setting, Settings};
use crate::picture::{PictureOption, Preset};

/// A page of a menu, in words.
#[derive(Debug, Clone, PartialEq)]
pub struct MenuPanel {
    /// The title of the page.
    pub title: String,
    /// Its lines, from above.
    pub lines: Vec<MenuLine>,
    /// Something went wrong, or became otherwise than somebody may think.
    pub notice: Option<String>,
    /// Which keys there are.
    pub hint: String,
}

/// A line of a page, in words.
#[derive(Debug, Clone, PartialEq)]
pub struct MenuLine {
    /// What it says.
    pub text: String,
    /// What is set there.
    pub value: Option<String>,
    /// How far along a scale that is [0 to 1]; none where there is no scale.
    pub fill: Option<f64>,
    /// It is meant: keys act on it.
    pub is_meant: bool,
    /// It can be chosen.
    pub is_live: bool,
    /// What is set there is one of several, before and after which there are others.
    pub is_choice: bool,
}

impl MenuPanel {
    /// The page that is open, if any.
    pub fn new(menu: &Menu, words: &Words) -> Option<Self> {
        let (page, focus) = menu.seen()?;
        let line = |(n, item): (usize, &Item)| {
            let setting = match item.effect {
                Effect::Sets(setting) => Some(setting),
                Effect::Opens(_) | Effect::Does(_) | Effect::Binds(_) => None,
            };
            MenuLine {
                text: words.get(&item.text),
                value: match item.effect {
                    Effect::Sets(setting) => Some(value(&menu.settings, setting, words)),
                    Effect::Binds(action) if menu.waits_for_key() == Some(action) => {
                        Some(words.get("press_key"))
                    }
                    Effect::Binds(action) => Some(words.all_keys_of(action, &menu.bindings)),
                    Effect::Opens(_) | Effect::Does(_) => None,
                },
                fill: setting.and_then(|setting| fill(&menu.settings, setting)),
                is_meant: n == focus,
                is_live: menu.is_live(item),
                is_choice: setting
                    .is_some_and(|setting| matches!(Settings::range(setting), Range::Choice(_))),
            }
        };
        let binds = page.items.iter().any(|item| matches!(item.effect, Effect::Binds(_)));
        let hint = match menu.waits_for_key() {
            Some(action) => words.fill("keys_wait", "action", &words.action(action)),
            None if binds => words.get("keys_bind"),
            None => words.get("keys"),
        };
        Some(MenuPanel {
            title: words.get(&format!("title_{}", page.title)),
            lines: page.items.iter().enumerate().map(line).collect(),
            notice: menu.notice.as_ref().map(|notice| said(notice, words)),
            hint,
        })
    }
}

/// A notice in words.
fn said(notice: &Notice, words: &Words) -> String {
    match notice {
        Notice::Wrong(text) => text.clone(),
        Notice::Lost { control, losers } => {
            let names: Vec<String> = losers.iter().map(|action| words.action(*action)).collect();
            words
                .fill("key_lost", "key", &words.key(*control))
                .replace("{actions}", &names.join(", "))
        }
        Notice::Refused { control, of } => words
            .fill("key_refused", "key", &words.key(*control))
            .replace("{action}", &words.action(*of)),
        Notice::UsualKeys => words.get("keys_usual"),
        Notice::Welcome => words.get("welcome"),
        Notice::PadLost => words.get("pad_lost"),
    }
}

/// What the players of the game that is set are called.
pub fn player_names(settings: &Settings, words: &Words) -> Vec<String> {
    let players = [PlayerId::ONE, PlayerId::TWO];
    let people = players.iter().filter(|player| settings.seat(**player) == Seat::Human).count();
    let number = |player: PlayerId| (player.index() + 1).to_string();
    let name = |player: PlayerId| match settings.seat(player) {
        Seat::Computer => {
            let key = if people == 0 { "name_computers" } else { "name_computer" };
            let strength = settings.strength(player).to_string();
            words.fill(key, "strength", &strength).replace("{number}", &number(player))
        }
        Seat::Human if people == 1 => words.get("name_alone"),
        Seat::Human => words.fill("name_human", "number", &number(player)),
    };
    match settings.game.seats() {
        1 => vec![words.get("name_alone")],
        _ => players.map(name).to_vec(),
    }
}

/// What is set, in words.
fn value(settings: &Settings, setting: Setting, words: &Words) -> String {
    let percent = |value: u16| words.fill("percent", "value", &value.to_string());
    match setting {
        Setting::Game => words.get(settings.game.key()),
        Setting::Table => words.get(settings.table.key()),
        Setting::PlayerOne => words.get(settings.player_1.key()),
        Setting::PlayerTwo => words.get(settings.player_2.key()),
        Setting::StrengthOne => settings.strength_1.to_string(),
        Setting::StrengthTwo => settings.strength_2.to_string(),
        Setting::Language => words.get(settings.language.key()),
        Setting::Volume => percent(settings.volume_percent),
        Setting::MouseSpeed => percent(settings.mouse_percent),
        Setting::StylusSpeed => percent(settings.stylus_percent),
        Setting::AimAid => words.get(match settings.aim_aid {
            AimAid::None => "aid_none",
            AimAid::Line => "aid_line",
            AimAid::Ways => "aid_ways",
        }),
        Setting::Haptic => words.get(settings.haptic.key()),
        Setting::Steering => words.get(match settings.steering {
            Steering::ByPlace => "by_place",
            Steering::ByPointing => "by_pointing",
        }),
        Setting::FullScreen => words.get(if settings.full_screen { "on" } else { "off" }),
        Setting::Rumble => words.get(if settings.rumble { "on" } else { "off" }),
        Setting::Preset => {
            words.get(Preset::of(&settings.picture).map_or("preset_own", Preset::key))
        }
        Setting::Picture(option) => {
            let value = settings.picture.value(option);
            match option {
                PictureOption::RenderScale | PictureOption::HudScale => {
                    words.fill("percent", "value", value)
                }
                // Numbers are the same in every language.
                _ if value.parse::<u16>().is_ok() => value.into(),
                _ => words.get(&picture_key(option, value)),
            }
        }
    }
}

/// The key of what an option can be; most say no more than on and off.
fn picture_key(option: PictureOption, value: &str) -> String {
    match (option, value) {
        (PictureOption::FrameLimit, "off") => String::from("unlimited"),
        (_, "on" | "off" | "auto") => value.into(),
        _ => format!("{}_{value}", option.key()),
    }
}

/// How far along its scale a setting is.
fn fill(settings: &Settings, setting: Setting) -> Option<f64> {
    match Settings::range(setting) {
        Range::Scale(last) => Some(settings.place(setting) as f64 / last.max(1) as f64),
        Range::Choice(_) => None,
    }
}

/// Lengths in a window that is 720 pixels high; everything grows with it.
const WIDTH: f64 = 500.0;
const MARGIN: f64 = 70.0;
const LINE: f64 = 46.0;
const TITLE: f64 = 96.0;
const FOOT: f64 = 64.0;
const PAD: f64 = 20.0;
/// What is set stands in this part of a line, and its scale in this part of that.
const VALUE_FROM: f64 = 0.46;
const SCALE_TO: f64 = 0.84;

/// A rectangle of the window [pixels], from its upper left corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Area {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Area {
    fn has(&self, x: f64, y: f64) -> bool {
        (self.x..self.x + self.width).contains(&x) && (self.y..self.y + self.height).contains(&y)
    }
}

/// Where a page stands in a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MenuLayout {
    /// The whole page.
    pub page: Area,
    /// Pixels per unit of length.
    pub unit: f64,
    lines: usize,
}

impl MenuLayout {
    /// For a page of so many lines in a window of this size [pixels].
    pub fn new((width, height): (f64, f64), lines: usize) -> Self {
        let whole = TITLE + LINE * lines as f64 + FOOT;
        // It grows with the window, and shrinks to fit in.
        let unit = (height / 720.0).clamp(0.6, 3.0).min(height / whole).min(width / WIDTH);
        let size = (WIDTH * unit, whole * unit);
        let x = (MARGIN * unit).min(0.5 * (width - size.0));
        let page = Area { x, y: 0.5 * (height - size.1), width: size.0, height: size.1 };
        MenuLayout { page, unit, lines }
    }

    /// Where the title stands.
    pub fn title(&self) -> Area {
        let height = TITLE * self.unit;
        Area { height, ..self.page }
    }

    /// Where the keys and what went wrong stand.
    pub fn foot(&self) -> Area {
        let height = FOOT * self.unit;
        Area { y: self.page.y + self.page.height - height, height, ..self.page }
    }

    /// Where a line stands, counted from 0.
    pub fn line(&self, n: usize) -> Area {
        let (height, pad) = (LINE * self.unit, PAD * self.unit);
        let y = self.page.y + TITLE * self.unit + height * n as f64;
        Area { x: self.page.x + pad, y, width: self.page.width - 2.0 * pad, height }
    }

    /// Where in a line stands what is set there.
    pub fn value(&self, n: usize) -> Area {
        let line = self.line(n);
        let from = VALUE_FROM * line.width;
        Area { x: line.x + from, width: line.width - from, ..line }
    }

    /// Where in a line the scale is.
    pub fn scale(&self, n: usize) -> Area {
        let line = self.line(n);
        let (from, to) = (VALUE_FROM * line.width, SCALE_TO * line.width);
        let height = 8.0 * self.unit;
        let y = line.y + 0.5 * (line.height - height);
        Area { x: line.x + from, y, width: to - from, height }
    }

    /// The line under a pointer.
    pub fn line_at(&self, panel: &MenuPanel, (x, y): (f64, f64)) -> Option<Pointed> {
        let line = (0..self.lines).find(|n| self.line(*n).has(x, y))?;
        let shown = panel.lines.get(line)?;
        let area = match (&shown.value, shown.fill) {
            (None, _) => return Some(Pointed { line, share: None, is_scale: false }),
            (Some(_), Some(_)) => self.scale(line),
            (Some(_), None) => self.value(line),
        };
        let share = (x - area.x) / area.width;
        // A little beside the end of a scale is its end.
        let is_there = (-0.08..=1.08).contains(&share);
        let share = is_there.then_some(share.clamp(0.0, 1.0));
        Some(Pointed { line, share, is_scale: shown.fill.is_some() })
    }
}
