//! The same whole game by different devices: intents of one player, translated for each.

use super::desk::Desk;
use glam::DVec2;
use hapticbillard::ai::{Goal, TableView2d, plan_shot};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::events::ShotKind;
use hapticbillard::input::feel::{
    AIM_RAD_PER_S, FINE, KEY_PULL_M_PER_S, KEY_SPEED_LEAST_M_S, KEY_SPEED_MOST_M_S,
    PLACING_M_PER_HEIGHT, PLACING_M_PER_S, PULL_MAX_M, STICK_PLACING, STICK_TURN, TRIGGER_BEGIN,
};
use hapticbillard::input::{
    Button, HandInput, HumanMode, Key, PadAxis, PadButton, PadInput, RawInput, shaped,
};
use hapticbillard::menu::{Begin, GameChoice, Lobby, Menu, Order, Pages, Pointed, Settings};
use hapticbillard::renderer::{MenuLayout, MenuPanel, Words};
use hapticbillard::rules::Language;
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::table::Table;
use hapticbillard::tick::Pace;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// What is at hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Device {
    Mouse,
    Keyboard,
    Pad,
}

/// The way from a gamepad to the window: what is done there becomes what is heard here.
pub type PadPort = Box<dyn FnMut(&[PadInput]) -> Vec<PadInput>>;

const WINDOW: (f64, f64) = (1280.0, 720.0);

/// A window with a player before it.
struct Seated {
    device: Device,
    /// Where it is while no game is on.
    lobby: Option<Lobby>,
    desk: Option<Desk>,
    words: Words,
    random: Pcg64Mcg,
    port: PadPort,
}

impl Seated {
    fn new(device: Device, port: PadPort) -> Self {
        let mut lobby = Lobby::new(Some(Menu::new(Pages::shipped().unwrap(), Settings::default())));
        lobby.open_main();
        Seated {
            device,
            lobby: Some(lobby),
            desk: None,
            words: Words::of_menus(Language::English),
            random: Pcg64Mcg::seed_from_u64(3),
            port,
        }
    }

    fn lobby(&mut self) -> &mut Lobby {
        match &mut self.desk {
            Some(desk) => &mut desk.lobby,
            None => self.lobby.as_mut().unwrap(),
        }
    }

    /// Chooses the line with this text; `share`: what is set there, this far along.
    fn choose(&mut self, text: &str, share: Option<f64>) -> Vec<Order> {
        let words = self.words.clone();
        let (page, focus) = {
            let (page, focus) = self.lobby().menu().unwrap().seen().expect("a menu is open");
            (page.clone(), focus)
        };
        let line = page.items.iter().position(|item| item.text == text).expect("such a line");
        if self.device == Device::Mouse {
            let panel = MenuPanel::new(self.lobby().menu().unwrap(), &words).unwrap();
            let layout = MenuLayout::new(WINDOW, panel.lines.len());
            let area = layout.line(line);
            let value = layout.value(line);
            let x = share.map_or(area.x + 20.0, |share| value.x + share * value.width);
            let at: Option<Pointed> = layout.line_at(&panel, (x, area.y + 0.5 * area.height));
            assert_eq!(at.map(|at| at.line), Some(line));
            let mut orders = self.lobby().point(at);
            for down in [true, false] {
                orders
                    .extend(self.lobby().hear(RawInput::Button { button: Button::Left, down }, at));
            }
            return orders;
        }
        // Downwards and round, over lines that can be chosen.
        let menu = self.lobby().menu().unwrap();
        let count = page.items.len();
        let way = (line + count - focus) % count;
        let lines = (1..=way).map(|n| &page.items[(focus + n) % count]);
        let mut keys: Vec<Key> =
            lines.filter(|item| menu.is_live(item)).map(|_| Key::Down).collect();
        keys.push(match share {
            None => Key::Enter,
            Some(share) if share < 0.5 => Key::Left,
            Some(_) => Key::Right,
        });
        let mut orders = Vec::new();
        for key in keys {
            for down in [true, false] {
                let reports = match self.device {
                    Device::Pad => self.pad(&[PadInput::Button { button: button_for(key), down }]),
                    _ => vec![RawInput::Key { key, down }],
                };
                for report in reports {
                    orders.extend(self.lobby().hear(report, None));
                }
            }
        }
        orders
    }

    /// What the window hears when this is done at the gamepad.
    fn pad(&mut self, done: &[PadInput]) -> Vec<RawInput> {
        (self.port)(done).into_iter().map(RawInput::Pad).collect()
    }

    /// One tick in which this is done at the gamepad.
    fn pad_tick(&mut self, done: &[PadInput]) {
        let reports = self.pad(done);
        self.desk.as_mut().unwrap().tick(&reports);
    }

    fn press(&mut self, button: PadButton) {
        for down in [true, false] {
            self.pad_tick(&[PadInput::Button { button, down }]);
        }
    }

    /// Holds a stick until it has moved something so far at so much a tick, when it is pushed out
    /// fully: whole ticks, then one with less.
    fn push(&mut self, axis: PadAxis, way: f64, a_tick: f64) {
        let ticks = (way.abs() / a_tick).floor();
        let rest = way.abs() / a_tick - ticks;
        if 0.0 < ticks {
            self.pad_tick(&[PadInput::Axis { axis, value: way.signum() }]);
            self.desk.as_mut().unwrap().wait(ticks as u64 - 1);
        }
        self.pad_tick(&[PadInput::Axis { axis, value: way.signum() * pushed(rest) }]);
        self.pad_tick(&[PadInput::Axis { axis, value: 0.0 }]);
    }

    /// Begins what is set, as a window does when it is told to.
    fn begin(&mut self) {
        let lobby = self.lobby.take().unwrap();
        let settings = lobby.menu().unwrap().settings.clone();
        let name = settings.game.scene();
        let mut scene = Scene::parse(name, &settings.scene_text()).unwrap();
        let players = settings.entrants();
        Overrides { seed: Some(11), players, ..Overrides::default() }.apply(&mut scene);
        let table = Arc::new(Table::preset("pool-9ft").unwrap());
        let mut desk = Desk::at(&scene, table, Pace::EveryTick);
        desk.lobby = lobby;
        desk.lobby.began();
        self.desk = Some(desk);
    }

    /// Holds a key until it has moved something so far at so much a tick, finely at the end.
    fn hold_for(&mut self, keys: [Key; 2], way: f64, a_tick: f64) {
        let key = if way < 0.0 { keys[0] } else { keys[1] };
        let desk = self.desk.as_mut().unwrap();
        let coarse = (way.abs() / a_tick).floor();
        let fine = ((way.abs() - coarse * a_tick) / (a_tick * FINE)).round();
        // The tick in which a key goes up does not count.
        if 0.0 < coarse {
            desk.hold(key, coarse as u64);
        }
        if 0.0 < fine {
            desk.tick(&[RawInput::Key { key: Key::Shift, down: true }]);
            desk.hold(key, fine as u64);
            desk.tick(&[RawInput::Key { key: Key::Shift, down: false }]);
        }
    }

    /// Puts a ball in hand down at an allowed place near the head spot.
    fn place(&mut self) {
        for i in 0..400 {
            let (column, row) = (i % 20, i / 20);
            let wanted = DVec2::new(-0.7 - 0.02 * f64::from(row), -0.4 + 0.04 * f64::from(column));
            let by = wanted - self.desk.as_ref().unwrap().view().placing.unwrap();
            match self.device {
                Device::Mouse => {
                    let by = by / PLACING_M_PER_HEIGHT;
                    self.desk.as_mut().unwrap().moved(by.x, by.y);
                }
                Device::Keyboard => {
                    self.hold_for([Key::Left, Key::Right], by.x, PLACING_M_PER_S * 1e-3);
                    self.hold_for([Key::Down, Key::Up], by.y, PLACING_M_PER_S * 1e-3);
                }
                Device::Pad => {
                    self.push(PadAxis::LeftX, by.x, STICK_PLACING * PLACING_M_PER_S * 1e-3);
                    self.push(PadAxis::LeftY, by.y, STICK_PLACING * PLACING_M_PER_S * 1e-3);
                }
            }
            if self.desk.as_ref().unwrap().view().placing_allowed {
                break;
            }
        }
        if self.device == Device::Pad {
            self.press(PadButton::A);
        }
        let desk = self.desk.as_mut().unwrap();
        match self.device {
            Device::Mouse => {
                desk.button(Button::Left, true);
                desk.button(Button::Left, false);
            }
            Device::Keyboard => desk.key(Key::Enter),
            Device::Pad => {}
        }
        desk.wait(3);
    }

    fn shoot(&mut self, table: &Table) {
        let desk = self.desk.as_mut().unwrap();
        let bed = table.bed.unwrap();
        let view = TableView2d::of(desk.table(), &bed, &table.pockets, POOL_RADIUS_M);
        let turn = desk.turn().unwrap();
        let goal = Goal::of(&turn, &view, turn.ball_in_hand.zone());
        let cue_ball = desk.cue_ball().position.truncate();
        let plan = plan_shot(&view, cue_ball, &goal, 0.07, &mut self.random);
        let azimuth_rad = libm::atan2(plan.direction.y, plan.direction.x);
        let speed_m_s = if turn.shot == ShotKind::Break { 6.0 } else { plan.speed_m_s };
        if self.device == Device::Mouse {
            desk.turn_to(azimuth_rad);
            desk.stroke((0.1 + 0.06 * speed_m_s).min(0.4), speed_m_s, 125);
            return;
        }
        let off = azimuth_rad - desk.view().aim.azimuth_rad;
        let whole = std::f64::consts::TAU;
        let off = off - whole * libm::round(off / whole);
        match self.device {
            // To the left is negative.
            Device::Pad => self.push(PadAxis::LeftX, -off, STICK_TURN * AIM_RAD_PER_S * 1e-3),
            _ => self.hold_for([Key::Letter('d'), Key::Letter('a')], off, AIM_RAD_PER_S * 1e-3),
        }
        let desk = self.desk.as_mut().unwrap();
        let aimed = desk.view().aim.azimuth_rad - azimuth_rad;
        let aimed = aimed - whole * libm::round(aimed / whole);
        assert!(aimed.abs() < 5e-5, "{aimed}");
        let range = KEY_SPEED_MOST_M_S - KEY_SPEED_LEAST_M_S;
        let share = ((speed_m_s - KEY_SPEED_LEAST_M_S) / range).clamp(0.0, 1.0).sqrt();
        if self.device == Device::Pad {
            let axis = PadAxis::RightTrigger;
            let value = TRIGGER_BEGIN + share.max(0.01) * (1.0 - TRIGGER_BEGIN);
            self.pad_tick(&[PadInput::Axis { axis, value }]);
            self.desk.as_mut().unwrap().wait(450);
            self.pad_tick(&[PadInput::Axis { axis, value: 0.0 }]);
            return self.strike();
        }
        let ticks = (share * PULL_MAX_M / KEY_PULL_M_PER_S * 1e3).round().max(1.0);
        desk.hold(Key::Enter, ticks as u64);
        self.strike();
    }

    /// The stroke that was let go is as hard as it was shown.
    fn strike(&mut self) {
        let desk = self.desk.as_mut().unwrap();
        let meant = desk.view().strength_m_s;
        desk.wait_until(3000, |desk| desk.mode() != HumanMode::Stroking);
        let made = desk.view().strength_m_s;
        assert!((made / meant - 1.0).abs() < 0.05, "{made} m/s, {meant} m/s were meant");
    }
}

/// The button of a gamepad that does in a menu what a key does.
fn button_for(key: Key) -> PadButton {
    match key {
        Key::Down => PadButton::Down,
        Key::Left => PadButton::Left,
        Key::Right => PadButton::Right,
        _ => PadButton::A,
    }
}

/// How far a stick is pushed that says this without its dead zone.
fn pushed(wanted: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let is_less = shaped(DVec2::new(middle, 0.0)).x < wanted;
        (low, high) = if is_less { (middle, high) } else { (low, middle) };
    }
    low
}

/// Plays from the main menu through a game and back to the end of the program.
pub fn whole_game(device: Device, port: PadPort) {
    let mut seated = Seated::new(device, port);
    assert!(seated.choose("play", None).is_empty());
    assert_eq!(seated.choose("game", Some(0.9)), [Order::Apply]);
    let game = seated.lobby().menu().unwrap().settings.game;
    assert_eq!(game, GameChoice::EightBall);
    assert_eq!(seated.choose("start", None), [Order::Begin(Begin::Set)]);
    seated.begin();

    let table = Table::preset("pool-9ft").unwrap();
    let mut strokes = 0;
    while seated.desk.as_ref().unwrap().finished.is_none() {
        match seated.desk.as_ref().unwrap().mode() {
            HumanMode::Placing => seated.place(),
            HumanMode::Aiming => {
                strokes += 1;
                // Once in a game something else is to be done.
                if strokes == 2 {
                    pause_and_go_on(&mut seated);
                }
                seated.shoot(&table);
            }
            _ => seated.desk.as_mut().unwrap().tick(&[]),
        }
        assert!(strokes < 200, "the game does not end");
    }

    let desk = seated.desk.as_mut().unwrap();
    desk.assert_won_or_lost();
    assert!(desk.orders.is_empty(), "{:?}", desk.orders);
    assert!(desk.lobby.ended(true).is_empty());
    assert_eq!(seated.choose("leave", None), [Order::Clear]);
    seated.lobby = Some(seated.desk.take().unwrap().lobby);
    let quits = seated.choose("quit", None);
    assert_eq!(quits.last(), Some(&Order::Quit));
}

fn pause_and_go_on(seated: &mut Seated) {
    match seated.device {
        Device::Pad => seated.press(PadButton::Start),
        _ => seated.desk.as_mut().unwrap().key(Key::Escape),
    }
    let desk = seated.desk.as_mut().unwrap();
    desk.wait(2);
    assert_eq!(desk.mode(), HumanMode::Paused);
    let orders = seated.choose("resume", None);
    let told: Vec<HandInput> = orders
        .into_iter()
        .map(|order| match order {
            Order::Tell(input) => input,
            other => panic!("{other:?}"),
        })
        .collect();
    let desk = seated.desk.as_mut().unwrap();
    desk.hear(&told);
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
}
