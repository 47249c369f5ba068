//! Menus: pages, focus, settings, words, places; who hears a device; whole games.

/// A whole game by a stylus alone.
mod by_stylus;
/// Whole games from the main menu and back, by one device each.
mod games;
/// The page of keys, help, and gamepads in menus.
mod keys;

mod replay;
/// A simulated hand at a simulated device.
mod stylus_hand;

use crate::input::desk;
use games::{Device, PadPort, whole_game};
use glam::DVec2;
use hapticbillard::ids::PlayerId;
use hapticbillard::input::{
    Action, Button, HandInput, HumanMode, HumanView, Key, PadAxis, PadButton, PadInput, RawInput,
};
use hapticbillard::menu::{
    Act, Begin, Deed, Effect, GameChoice, Lobby, Menu, MenuInput, Order, Pages, Pointed, Range,
    Seat, Setting, Settings, TableChoice, Tongue, Wheel, WheelPage,
};
use hapticbillard::renderer::{MenuLayout, MenuPanel, Words, player_names};
use hapticbillard::rules::Language;
use hapticbillard::scene::{PlayerKind, Scene};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// What is seen of a hand that plays, or where time stands still.
fn paused(is_paused: bool) -> HumanView {
    let mode = if is_paused { HumanMode::Paused } else { HumanMode::Aiming };
    HumanView { mode, ..HumanView::default() }
}

fn menu() -> Menu {
    Menu::new(Pages::shipped().unwrap(), Settings::default())
}

/// How many places a setting has.
fn places(setting: Setting) -> usize {
    match Settings::range(setting) {
        Range::Choice(count) => count,
        Range::Scale(last) => last + 1,
    }
}

fn seen(menu: &Menu) -> (String, String) {
    let (page, focus) = menu.seen().unwrap();
    (page.name.clone(), page.items[focus].text.clone())
}

#[test]
fn the_pages_lead_where_the_paper_says() {
    let pages = Pages::shipped().unwrap();
    let leads = |from: &str, to: &str| {
        let page = pages.get(from).unwrap();
        page.items.iter().any(|item| item.effect == Effect::Opens(to.into()))
    };
    let does = |from: &str, act: Act| {
        let page = pages.get(from).unwrap();
        page.items.iter().any(|item| item.effect == Effect::Does(act))
    };
    assert!(leads("main", "mode") && leads("main", "options") && leads("pause", "options"));
    assert!(does("mode", Act::Start) && does("mode", Act::Back) && does("options", Act::Back));
    for page in ["pause", "over"] {
        assert!(does(page, Act::Leave) && does(page, Act::Quit), "{page}");
    }
    assert!(does("main", Act::Quit) && does("pause", Act::Resume) && does("over", Act::Again));
}

#[test]
fn what_is_wrong_with_a_page_is_said_in_one_line() {
    let wrong = |text: &str| Pages::parse(&[("main", text)]).unwrap_err().to_string();
    let item = |rest: &str| format!("title = \"main\"\n[[item]]\ntext = \"x\"\n{rest}\n");
    let messages = [
        (wrong("title = \"main\"\n"), "config/menus/main.toml: a page needs at least one [[item]]"),
        (wrong(&item("")), "item 1 (\"x\") needs one of 'opens', 'does', 'sets' and 'binds'"),
        (wrong(&item("binds = \"jump\"")), "item 1 binds \"jump\", which is no action"),
        (wrong(&item("does = \"quit\"\nopens = \"main\"")), "needs one of"),
        (wrong(&item("opens = \"attic\"")), "item 1 opens \"attic\", but the pages are main"),
        (wrong(&item("does = \"dance\"")), "unknown variant `dance`"),
        (wrong(&item("sets = \"gravity\"")), "unknown variant `gravity`"),
        (wrong(&item("colour = 3")), "unknown field `colour`"),
    ];
    for (message, part) in messages {
        assert!(
            message.contains(part) && message.starts_with("config/menus/main.toml"),
            "{message}"
        );
        assert!(!message.contains('\n'));
    }
}

#[test]
fn every_word_of_the_menus_is_there_in_both_languages() {
    let [english, german] = Language::ALL.map(Words::of_menus);
    assert!(english.keys().eq(german.keys()));
    for words in [&english, &german] {
        let has = |key: &str| words.keys().any(|known| known == key);
        for page in Pages::shipped().unwrap().iter() {
            assert!(has(&format!("title_{}", page.title)), "{}", page.title);
            assert!(page.items.iter().all(|item| has(&item.text)), "{}", page.name);
        }
        let wheel = Wheel::open(WheelPage::shipped().unwrap(), DVec2::ZERO, DVec2::splat(720.0));
        assert!(wheel.items().all(|(action, ..)| has(&format!("wheel_{}", action.name()))));
        // Whatever is set has a name: no line shows a key.
        let mut menu = menu();
        for name in ["mode", "options"] {
            menu.open(name);
            for setting in Setting::all() {
                for place in 0..places(setting) {
                    menu.settings.put(setting, place);
                    let panel = MenuPanel::new(&menu, words).unwrap();
                    let values = panel.lines.iter().filter_map(|line| line.value.as_ref());
                    assert!(values.into_iter().all(|value| !value.contains('_')), "{panel:?}");
                }
            }
        }
    }
}

#[test]
fn every_place_of_every_setting_is_kept() {
    let mut settings = Settings::default();
    for setting in Setting::all() {
        for place in (0..places(setting)).rev() {
            settings.put(setting, place);
            assert_eq!(settings.place(setting), place, "{setting:?}");
            assert_eq!(Settings::parse(&settings.to_toml()).unwrap(), settings);
        }
        settings.put(setting, usize::MAX);
        assert_eq!(settings.place(setting), places(setting) - 1);
    }
    let problem = Settings::parse("volume_percent = \"loud\"").unwrap_err();
    assert!(problem.contains("line 1") && !problem.contains('\n'), "{problem}");
    // What somebody wrote by hand is brought into its range.
    let odd = Settings::parse("mouse_percent = 0\nvolume_percent = 60000").unwrap();
    assert!(odd.mouse_factor() == 0.25 && odd.volume_factor() == 1.3);
    assert_eq!(Tongue::System.language(Language::German), Language::German);
    assert_eq!(Tongue::English.language(Language::German), Language::English);
}

#[test]
fn every_game_of_the_menu_is_a_scene_with_its_players() {
    let words = Words::of_menus(Language::English);
    for game in GameChoice::ALL {
        let settings = Settings { game, player_1: Seat::Computer, ..Settings::default() };
        let scene = Scene::parse(game.scene(), &settings.scene_text()).unwrap();
        assert_eq!(scene.players.len(), game.seats(), "{game:?}");
        assert!(scene.renderer.is_some(), "{game:?} has a picture");
        let table = TableChoice::SevenFoot;
        assert_eq!(settings.is_of_use(Setting::Table), game.is_pool());
        let small = Settings { table, ..settings.clone() }.scene_text();
        let table = Scene::parse(game.scene(), &small).unwrap().build_table(&mut |_| panic!());
        let length_m = table.unwrap().bed.unwrap().length_m;
        assert_eq!(length_m < 2.0, game.is_pool(), "{game:?}: {length_m} m");
        let kinds: Vec<_> = settings.entrants().into_iter().map(|one| one.kind.unwrap()).collect();
        let names = player_names(&settings, &words);
        match game.seats() {
            1 => assert_eq!((kinds, names), (vec![PlayerKind::Human], vec!["Player".into()])),
            _ => {
                assert_eq!(kinds, [PlayerKind::Computer(50); 2]);
                assert_eq!(names, ["Computer 1 (50)", "Computer 2 (50)"]);
            }
        }
    }
    let against = player_names(&Settings::default(), &words);
    assert_eq!(against, ["Player", "Computer (50)"]);
    assert_eq!(Settings::default().seat(PlayerId::ONE), Seat::Human);
}

#[test]
fn keys_go_round_over_what_is_of_use() {
    let mut menu = menu();
    menu.open("main");
    assert_eq!(menu.hear(MenuInput::Accept), None);
    assert_eq!(seen(&menu), ("mode".into(), "start".into()));
    let mut lines = Vec::new();
    for _ in 0..7 {
        menu.hear(MenuInput::Down);
        lines.push(seen(&menu).1);
    }
    // A person has no strength to set.
    assert_eq!(lines, ["game", "table", "player_1", "player_2", "strength", "back", "start"]);
    menu.hear(MenuInput::Up);
    assert_eq!(menu.hear(MenuInput::Accept), None);
    assert_eq!(seen(&menu), ("main".into(), "play".into()));
    // Nobody ends the program by accident.
    assert_eq!(menu.hear(MenuInput::Back), None);
    assert!(menu.is_open());
}

#[test]
fn a_pointer_means_chooses_and_pulls() {
    let mut menu = menu();
    menu.open("options");
    menu.hear(MenuInput::Over(1));
    assert_eq!(seen(&menu).1, "volume");
    let press = |line, share| MenuInput::Press { line, share };
    assert_eq!(menu.hear(press(1, Some(0.25))), Some(Deed::Changed));
    assert_eq!(menu.settings.volume_percent, 30);
    assert_eq!(menu.hear(press(1, Some(0.25))), None, "nothing new");
    assert_eq!(menu.hear(press(0, Some(0.1))), Some(Deed::Changed), "the arrow on the left");
    assert_eq!(menu.settings.language, Tongue::German);
    assert_eq!(menu.hear(press(0, Some(0.9))), Some(Deed::Changed));
    assert_eq!(menu.settings.language, Tongue::System);
    menu.open("mode");
    assert_eq!(menu.hear(press(4, Some(1.0))), None, "a person has no strength");
    assert_eq!(menu.settings.strength_1, 50);
    assert_eq!(menu.hear(press(0, None)), Some(Deed::Start));
    assert_eq!(menu.hear(press(99, None)), None);
}

#[test]
fn lines_are_found_where_they_are_drawn_in_windows_of_any_size() {
    let mut menu = menu();
    let words = Words::of_menus(Language::English);
    let mut random = Pcg64Mcg::seed_from_u64(4);
    for n in 0..2000 {
        menu.open(["main", "mode", "options", "pause", "over"][n % 5]);
        let panel = MenuPanel::new(&menu, &words).unwrap();
        let (width, height) =
            (random.random_range(320.0..4000.0), random.random_range(200.0..2400.0));
        let layout = MenuLayout::new((width, height), panel.lines.len());
        let page = layout.page;
        let is_inside = -0.01 <= page.x && page.x + page.width <= width + 0.01;
        assert!(is_inside && -0.01 <= page.y && page.y + page.height <= height + 0.01);
        for (n, line) in panel.lines.iter().enumerate() {
            let area = layout.line(n);
            let middle = (area.x + 0.1 * area.width, area.y + 0.5 * area.height);
            let found = layout.line_at(&panel, middle).unwrap();
            assert_eq!((found.line, found.share), (n, None));
            if let Some(fill) = line.fill {
                let scale = layout.scale(n);
                let at = (scale.x + fill * scale.width, scale.y + 0.5 * scale.height);
                let found = layout.line_at(&panel, at).unwrap();
                assert!(found.is_scale && (found.share.unwrap() - fill).abs() < 1e-9);
            }
        }
        assert_eq!(layout.line_at(&panel, (page.x - 1.0, page.y)), None);
    }
}

#[test]
fn a_pause_opens_a_menu_and_escape_leads_back_into_the_game() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    let key = |key| RawInput::Key { key, down: true };
    assert!(lobby.hear(key(Key::Letter('p')), None).is_empty(), "the game hears nothing");
    lobby.began();
    let pause = |down| Order::Tell(HandInput::Act { action: Action::Pause, down });
    assert_eq!(lobby.hear(key(Key::Escape), None), [pause(true)]);
    let up = RawInput::Key { key: Key::Escape, down: false };
    assert_eq!(lobby.hear(up, None), [pause(false)]);
    assert!(lobby.see(&paused(false)).is_empty() && lobby.is_playing());
    assert_eq!(lobby.see(&paused(true)), [Order::Tell(HandInput::FocusLost)]);
    assert!(lobby.is_menu_open() && lobby.see(&paused(true)).is_empty());
    let back = lobby.hear(key(Key::Escape), None);
    assert_eq!(back, [pause(true), pause(false)]);
    // Time still stands until the game has heard it.
    assert!(lobby.see(&paused(true)).is_empty() && !lobby.is_menu_open());
    assert!(lobby.see(&paused(false)).is_empty() && lobby.is_playing());
    assert_eq!(lobby.see(&paused(true)).len(), 1, "the next pause");
}

#[test]
fn a_held_key_goes_along_lines_and_chooses_nothing_twice() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    let key = |key, down| RawInput::Key { key, down };
    let page = |lobby: &Lobby| seen(lobby.menu().unwrap());
    // Held on a line that opens a page: the page opens, and nothing of it is chosen.
    for _ in 0..5 {
        assert!(lobby.hear(key(Key::Enter, true), None).is_empty());
    }
    assert_eq!(page(&lobby), ("mode".into(), "start".into()));
    lobby.hear(key(Key::Enter, false), None);
    for _ in 0..2 {
        lobby.hear(key(Key::Down, true), None);
    }
    assert_eq!(page(&lobby).1, "table");
    lobby.hear(key(Key::Up, true), None);
    lobby.hear(key(Key::Up, true), None);
    assert_eq!(lobby.hear(key(Key::Enter, true), None), [Order::Begin(Begin::Set)]);
    lobby.began();
    // The game hears nothing of the key that began it, and all of the next press.
    assert!(lobby.hear(key(Key::Enter, true), None).is_empty());
    assert!(lobby.hear(key(Key::Enter, false), None).is_empty());
    assert_eq!(lobby.hear(key(Key::Enter, true), None).len(), 1);
    assert!(lobby.hear(key(Key::Enter, true), None).is_empty(), "a repeat");
    assert_eq!(lobby.hear(key(Key::Enter, false), None).len(), 1);

    // `q` in a pause ends the game, and a menu is never over a game that goes on.
    lobby.see(&paused(true));
    assert!(lobby.is_menu_open());
    lobby.see(&paused(false));
    assert!(lobby.is_playing());
    lobby.see(&paused(true));
    assert_eq!(lobby.hear(key(Key::Letter('q'), true), None), [Order::Tell(HandInput::Closed)]);
    assert_eq!(lobby.ended(false), [Order::Clear]);
    assert_eq!(page(&lobby).0, "main");
}

#[test]
fn a_scale_is_pulled_only_while_the_button_is_held() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    for key in [Key::Down, Key::Down, Key::Enter, Key::Down] {
        lobby.hear(RawInput::Key { key, down: true }, None);
    }
    let at = |share| Some(Pointed { line: 1, share: Some(share), is_scale: true });
    let button = |down| RawInput::Button { button: Button::Left, down };
    let volume = |lobby: &Lobby| lobby.menu().unwrap().settings.volume_percent;
    assert!(lobby.point(at(0.0)).is_empty());
    assert_eq!(lobby.hear(button(true), at(0.1)), [Order::Apply]);
    assert_eq!(lobby.point(at(0.8)), [Order::Apply]);
    assert_eq!(volume(&lobby), 100);
    lobby.hear(button(false), at(0.8));
    assert!(lobby.point(at(0.2)).is_empty());
    assert_eq!(volume(&lobby), 100);
}

/// A game that only pauses, goes on and ends, and knows what is held.
#[derive(Default)]
struct Toy {
    is_paused: bool,
    is_over: bool,
    held: Vec<Action>,
}

impl Toy {
    fn hear(&mut self, input: HandInput) {
        match input {
            HandInput::Closed => self.is_over = true,
            HandInput::FocusLost => self.held.clear(),
            HandInput::Paused(paused) => self.is_paused = paused,
            HandInput::PadLost => {
                self.held.clear();
                self.is_paused = true;
            }
            HandInput::Act { action, down } => {
                let was_held = self.held.contains(&action);
                self.held.retain(|held| *held != action);
                if down {
                    assert!(!(was_held && action.is_held()), "{action:?} begins twice");
                    self.held.push(action);
                    self.is_paused ^= action == Action::Pause;
                }
            }
            _ => {}
        }
    }
}

#[test]
fn no_sequence_of_events_loses_a_menu_or_leaves_a_button_stuck() {
    const KEYS: [Key; 15] = [
        Key::Letter('y'),
        Key::Up,
        Key::Down,
        Key::Left,
        Key::Right,
        Key::Enter,
        Key::Escape,
        Key::Tab,
        Key::Space,
        Key::Letter('p'),
        Key::Letter('q'),
        Key::Letter('d'),
        Key::Function(1),
        Key::Shift,
        Key::Letter('1'),
    ];
    const PAD: [PadButton; 5] =
        [PadButton::A, PadButton::B, PadButton::Start, PadButton::Down, PadButton::LeftShoulder];
    let mut random = Pcg64Mcg::seed_from_u64(6);
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    let mut toy: Option<Toy> = None;
    let (mut games, mut quits, mut films) = (0, 0, 0);
    for step in 0..100_000 {
        let place = DVec2::new(random.random(), random.random());
        let line = (place.x * 8.0) as usize;
        let pointed = Some(Pointed { line, share: Some(place.y), is_scale: step % 2 == 0 })
            .filter(|_| step % 3 != 0);
        let down = random.random();
        let mut orders = match random.random_range(0..16) {
            0..6 => {
                let key = KEYS[random.random_range(0..KEYS.len())];
                lobby.hear(RawInput::Key { key, down }, pointed)
            }
            6..8 => {
                let button = [Button::Left, Button::Right][step % 2];
                lobby.hear(RawInput::Button { button, down }, pointed)
            }
            8..10 => lobby.point(pointed),
            10 => lobby.hear(RawInput::Moved { right: place.x, up: place.y }, pointed),
            11..13 => {
                let button = PAD[random.random_range(0..PAD.len())];
                lobby.hear(RawInput::Pad(PadInput::Button { button, down }), pointed)
            }
            13 => {
                let axis = PadAxis::ALL[step % PadAxis::ALL.len()];
                let value = 4.0 * place.x - 2.0;
                lobby.hear(RawInput::Pad(PadInput::Axis { axis, value }), pointed)
            }
            14 if step % 31 == 0 => {
                let report = if down { PadInput::Connected } else { PadInput::Lost };
                lobby.hear(RawInput::Pad(report), pointed)
            }
            15 if step % 2 == 0 && lobby.is_replaying() => lobby.end_replay(),
            _ => lobby.hear(RawInput::FocusLost, pointed),
        };
        if let Some(game) = &toy {
            orders.extend(lobby.see(&paused(game.is_paused)));
        }
        for order in orders {
            match order {
                Order::Tell(report) => {
                    toy.iter_mut().for_each(|game| game.hear(report));
                }
                Order::Begin(_) => {
                    (games, toy) = (games + 1, Some(Toy::default()));
                    lobby.began();
                    lobby.see_film(true);
                }
                Order::Clear => toy = None,
                Order::Replay(_) => films += 1,
                Order::Apply | Order::Rebound | Order::Say(_) | Order::Do(_) => {}
                Order::Onlook(_) => {}
                Order::Quit => {
                    // As if the program were started again.
                    (quits, toy) = (quits + 1, None);
                    lobby.open_main();
                }
            }
        }
        if let Some(game) = toy.as_ref().filter(|game| game.is_over || step % 997 == 0)
            && !lobby.is_over()
        {
            let has_result = !game.is_over;
            toy = toy.filter(|_| has_result);
            lobby.ended(has_result);
        }
        let goes_on = toy.as_ref().is_some_and(|game| !game.is_paused);
        assert!(
            lobby.is_menu_open() || goes_on || lobby.is_playing() || lobby.is_replaying(),
            "step {step}: nothing is open"
        );
        let stands = lobby.is_menu_open() || lobby.is_replaying();
        if let Some(game) = toy.as_ref().filter(|_| stands && !lobby.is_over()) {
            assert!(game.held.is_empty(), "step {step}: {:?} are stuck", game.held);
        }
    }
    assert!(games > 100 && quits > 100, "{games} games, {quits} ends");
    assert!(films > 100, "{films} films");
}

/// No gamepad between the player and the window, or one that says at once what is done.
fn straight() -> PadPort {
    Box::new(|done| done.to_vec())
}

#[test]
fn whole_game_by_mouse_only() {
    whole_game(Device::Mouse, straight());
}

#[test]
fn whole_game_by_keyboard_only() {
    whole_game(Device::Keyboard, straight());
}

#[test]
fn whole_game_by_reports_of_a_gamepad_only() {
    whole_game(Device::Pad, straight());
}
