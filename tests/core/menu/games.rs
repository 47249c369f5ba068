//! The same whole game by different devices: intents of one player, translated for each.

use crate::input::desk::Desk;
use crate::input::play::turn;
use glam::DVec2;
use hapticbillard::ai::{Goal, TableView2d, plan_shot};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::events::{ShotKind, TurnAfter};
use hapticbillard::ids::PlayerId;
use hapticbillard::input::feel::{
    AIM_RAD_PER_S, FINE, KEY_PULL_M_PER_S, KEY_SPEED_LEAST_M_S, KEY_SPEED_MOST_M_S,
    PLACING_M_PER_HEIGHT, PLACING_M_PER_S, PULL_MAX_M,
};
use hapticbillard::input::{Button, HumanMode, Key, RawInput};
use hapticbillard::menu::{GameChoice, Lobby, Menu, Order, Pages, Pointed, Settings};
use hapticbillard::renderer::{MenuLayout, MenuPanel, Words};
use hapticbillard::rules::Language;
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::table::Table;
use hapticbillard::tick::{End, Pace};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// What is at hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Device {
    Mouse,
    Keyboard,
}

const WINDOW: (f64, f64) = (1280.0, 720.0);

/// A window with a player before it.
struct Seated {
    device: Device,
    /// Where it is while no game is on.
    lobby: Option<Lobby>,
    desk: Option<Desk>,
    words: Words,
    random: Pcg64Mcg,
}

impl Seated {
    fn new(device: Device) -> Self {
        let mut lobby = Lobby::new(Some(Menu::new(Pages::shipped().unwrap(), Settings::default())));
        lobby.open_main();
        Seated {
            device,
            lobby: Some(lobby),
            desk: None,
            words: Words::of_menus(Language::English),
            random: Pcg64Mcg::seed_from_u64(3),
        }
    }

    fn lobby(&mut self) -> &mut Lobby {
        match &mut self.desk {
            Some(desk) => desk.lobby.as_mut().unwrap(),
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
                orders.extend(self.lobby().hear(RawInput::Key { key, down }, None));
            }
        }
        orders
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
        desk.lobby = Some(lobby);
        desk.lobby.as_mut().unwrap().began();
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
            if self.device == Device::Mouse {
                let by = by / PLACING_M_PER_HEIGHT;
                self.desk.as_mut().unwrap().moved(by.x, by.y);
            } else {
                self.hold_for([Key::Left, Key::Right], by.x, PLACING_M_PER_S * 1e-3);
                self.hold_for([Key::Down, Key::Up], by.y, PLACING_M_PER_S * 1e-3);
            }
            if self.desk.as_ref().unwrap().view().placing_allowed {
                break;
            }
        }
        let desk = self.desk.as_mut().unwrap();
        if self.device == Device::Mouse {
            desk.button(Button::Left, true);
            desk.button(Button::Left, false);
        } else {
            desk.key(Key::Enter);
        }
        desk.wait(3);
    }

    fn shoot(&mut self, table: &Table) {
        let desk = self.desk.as_mut().unwrap();
        let bed = table.bed.unwrap();
        let view = TableView2d::of(desk.table(), &bed, &table.pockets, POOL_RADIUS_M);
        let turn = turn(desk).unwrap();
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
        self.hold_for([Key::Letter('d'), Key::Letter('a')], off, AIM_RAD_PER_S * 1e-3);
        let desk = self.desk.as_mut().unwrap();
        let aimed = desk.view().aim.azimuth_rad - azimuth_rad;
        let aimed = aimed - whole * libm::round(aimed / whole);
        assert!(aimed.abs() < 5e-5, "{aimed}");
        let range = KEY_SPEED_MOST_M_S - KEY_SPEED_LEAST_M_S;
        let share = ((speed_m_s - KEY_SPEED_LEAST_M_S) / range).clamp(0.0, 1.0).sqrt();
        let ticks = (share * PULL_MAX_M / KEY_PULL_M_PER_S * 1e3).round().max(1.0);
        desk.hold(Key::Enter, ticks as u64);
        let meant = desk.view().strength_m_s;
        desk.wait_until(3000, |desk| desk.mode() != HumanMode::Stroking);
        let made = desk.view().strength_m_s;
        assert!((made / meant - 1.0).abs() < 0.05, "{made} m/s, {meant} m/s were meant");
    }
}

/// Plays from the main menu through a game and back to the end of the program.
fn whole_game(device: Device) {
    let mut seated = Seated::new(device);
    assert!(seated.choose("play", None).is_empty());
    assert_eq!(seated.choose("game", Some(0.9)), [Order::Apply]);
    let game = seated.lobby().menu().unwrap().settings.game;
    assert_eq!(game, GameChoice::EightBall);
    assert_eq!(seated.choose("start", None), [Order::Begin { again: false }]);
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
    assert_eq!(desk.finished.as_ref().unwrap().end, End::Over);
    let verdicts = desk.verdicts();
    let own = || verdicts.iter().filter(|verdict| verdict.player == Some(PlayerId::ONE));
    assert!(own().any(|verdict| verdict.legal && !verdict.pocketed.is_empty()), "a pot");
    assert_eq!(verdicts.last().unwrap().turn, TurnAfter::End);
    assert!(desk.orders.is_empty(), "{:?}", desk.orders);
    assert!(desk.lobby.as_mut().unwrap().ended(true).is_empty());
    assert_eq!(seated.choose("leave", None), [Order::Clear]);
    seated.lobby = seated.desk.take().unwrap().lobby;
    let quits = seated.choose("quit", None);
    assert_eq!(quits.last(), Some(&Order::Quit));
}

fn pause_and_go_on(seated: &mut Seated) {
    let desk = seated.desk.as_mut().unwrap();
    desk.key(Key::Escape);
    desk.wait(2);
    assert_eq!(desk.mode(), HumanMode::Paused);
    let orders = seated.choose("resume", None);
    let told: Vec<RawInput> = orders
        .into_iter()
        .map(|order| match order {
            Order::Tell(report) => report,
            other => panic!("{other:?}"),
        })
        .collect();
    let desk = seated.desk.as_mut().unwrap();
    desk.tick(&told);
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
}

#[test]
fn whole_game_by_mouse_only() {
    whole_game(Device::Mouse);
}

#[test]
fn whole_game_by_keyboard_only() {
    whole_game(Device::Keyboard);
}
