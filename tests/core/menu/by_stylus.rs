//! A whole game by a stylus alone: menus are pointed at, a ball in hand too, the wheel pauses and
//! leads to the camera, and the hand strikes.

use super::stylus_hand::{Hand, stroke};
use crate::input::desk::Desk;
use glam::{DVec2, DVec3};
use hapticbillard::ai::{Goal, TableView2d, plan_shot};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::events::ShotKind;
use hapticbillard::haptic::simulated::Leg;
use hapticbillard::haptic::{Buttons, ReachSettings};
use hapticbillard::input::{Action, HandInput, HumanMode, StylusSays};
use hapticbillard::menu::{Begin, Lobby, Menu, Order, Pages, Pointed, Settings};
use hapticbillard::renderer::{MenuLayout, MenuPanel, Words};
use hapticbillard::rules::Language;
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::table::Table;
use hapticbillard::units::TICK_S;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

const WINDOW: DVec2 = DVec2::new(1280.0, 720.0);
/// Where the hand waits behind the ball [m].
const BEHIND: DVec3 = DVec3::new(0.0, 0.0, 0.03);
/// Metres of the tip per metre of the hand in a stroke.
fn gain() -> f64 {
    let settings = ReachSettings::default();
    settings.scale * settings.stroke_gain
}

/// A window, and somebody before it who has nothing but a stylus.
struct Seated {
    /// Where it is while no game is on.
    lobby: Option<Lobby>,
    desk: Option<Desk>,
    orders: Vec<Order>,
    hand: Hand,
    table: Table,
    words: Words,
    random: Pcg64Mcg,
}

impl Seated {
    fn new() -> Self {
        let settings = Settings { strength_2: 20, ..Settings::default() };
        let mut lobby = Lobby::new(Some(Menu::new(Pages::shipped().unwrap(), settings)));
        lobby.resize(WINDOW);
        lobby.open_main();
        let table = Table::preset("pool-9ft").unwrap();
        let mut seated = Seated {
            lobby: Some(lobby),
            desk: None,
            orders: Vec::new(),
            hand: Hand::new(&table, WINDOW),
            table,
            words: Words::of_menus(Language::English),
            random: Pcg64Mcg::seed_from_u64(3),
        };
        seated.wait(0.1);
        seated
    }

    fn lobby(&self) -> &Lobby {
        self.desk.as_ref().map_or_else(|| self.lobby.as_ref().unwrap(), |desk| &desk.lobby)
    }

    fn desk(&self) -> &Desk {
        self.desk.as_ref().unwrap()
    }

    fn mode(&self) -> HumanMode {
        self.desk().mode()
    }

    /// The line of a menu that the stylus points at.
    fn pointed(&self) -> Option<Pointed> {
        let panel = MenuPanel::new(self.lobby().menu()?, &self.words)?;
        let layout = MenuLayout::new((WINDOW.x, WINDOW.y), panel.lines.len());
        let place = self.hand.place();
        layout.line_at(&panel, (place.x, place.y))
    }

    /// A millisecond of hand, device, servo, window and game.
    fn tick(&mut self) {
        let Some(desk) = &self.desk else {
            let says = self.hand.rest();
            let orders = self.say(says);
            self.orders.extend(orders);
            return;
        };
        let start_s = (desk.frames_asked() - 1) as f64 * TICK_S;
        let (word, says) = self.hand.play(desk.leads(), desk.table(), start_s);
        let view = desk.view();
        let mut orders = self.desk.as_mut().unwrap().lobby.see(&view);
        orders.extend(self.say(says));
        let (mut told, mut others): (Vec<HandInput>, Vec<Order>) = (Vec::new(), Vec::new());
        for order in orders {
            match order {
                Order::Tell(input) => told.push(input),
                order => others.push(order),
            }
        }
        self.orders.extend(others);
        self.desk.as_mut().unwrap().hear_beside(&told, word);
    }

    fn say(&mut self, says: Vec<StylusSays>) -> Vec<Order> {
        let mut orders = Vec::new();
        for said in says {
            let (place, pointed) = (self.hand.place(), self.pointed());
            let lobby = match &mut self.desk {
                Some(desk) => &mut desk.lobby,
                None => self.lobby.as_mut().unwrap(),
            };
            orders.extend(lobby.hear_stylus(said, place, pointed, None));
        }
        orders
    }

    fn wait(&mut self, seconds: f64) {
        (0..Hand::ticks(seconds)).for_each(|_| self.tick());
    }

    /// The hand does this, and the time for it passes.
    fn follow(&mut self, legs: Vec<Leg>) {
        let seconds: f64 = legs.iter().map(|leg| leg.duration_s).sum();
        self.hand.follow(legs);
        self.wait(seconds);
    }

    /// Points to a place of the window [pixels], and clicks there.
    fn click(&mut self, pixel: DVec2) {
        let to = self.hand.pointing_at(pixel);
        self.follow(vec![Leg::to(to, 0.3), Leg::to(to, 0.1)]);
        self.follow(vec![Leg::to(to, 0.04).holding(Buttons::FRONT), Leg::to(to, 0.04)]);
    }

    /// Chooses the line with this text; `share`: what is set there, this far along. What is ordered
    /// by that.
    fn choose(&mut self, text: &str, share: Option<f64>) -> Vec<Order> {
        let (page, _) = self.lobby().menu().unwrap().seen().expect("a menu is open");
        let line = page.items.iter().position(|item| item.text == text).expect("such a line");
        let layout = MenuLayout::new((WINDOW.x, WINDOW.y), page.items.len());
        let (area, value) = (layout.line(line), layout.value(line));
        let x = share.map_or(area.x + 60.0, |share| value.x + share * value.width);
        self.orders.clear();
        self.click(DVec2::new(x, area.y + 0.5 * area.height));
        std::mem::take(&mut self.orders)
    }

    /// Chooses the action that lies in this direction on the wheel.
    fn turn_wheel(&mut self, way: DVec2) {
        let from = self.hand.position();
        let to = from + (way * 0.025).extend(0.0);
        let held = |to| Leg::to(to, 0.3).holding(Buttons::REAR);
        self.follow(vec![Leg::to(from, 0.05), held(from)]);
        assert!(self.lobby().wheel().is_some(), "the wheel does not open");
        self.follow(vec![held(to), held(from), Leg::to(from, 0.1)]);
        assert!(self.lobby().wheel().is_none(), "the wheel does not close");
    }

    /// Begins what is set, as a window does when it is told to.
    fn begin(&mut self) {
        let lobby = self.lobby.take().unwrap();
        let settings = lobby.menu().unwrap().settings.clone();
        let name = settings.game.scene();
        let mut scene = Scene::parse(name, &settings.scene_text()).unwrap();
        let players = settings.entrants();
        Overrides { seed: Some(11), players, ..Overrides::default() }.apply(&mut scene);
        let mut desk = Desk::with_stylus(&scene);
        desk.tick(&[]);
        desk.lobby = lobby;
        desk.lobby.began();
        self.desk = Some(desk);
    }

    /// Puts a ball in hand down near the head spot, where it may lie.
    fn place(&mut self) {
        // The camera goes over the table first.
        self.wait(0.5);
        for i in 0..60 {
            let (column, row) = (i % 6, i / 6);
            let wanted = DVec2::new(-0.75 - 0.05 * f64::from(row), -0.25 + 0.1 * f64::from(column));
            let camera = self.desk().view().camera;
            let shares =
                camera.place_of(wanted.extend(POOL_RADIUS_M), WINDOW.x / WINDOW.y).unwrap();
            let to = self.hand.pointing_at(DVec2::from(shares) * WINDOW);
            self.follow(vec![Leg::to(to, 0.3), Leg::to(to, 0.1)]);
            let held_at = self.desk().view().placing.unwrap();
            assert!(held_at.distance(wanted) < 0.05, "{held_at}, not {wanted}");
            if self.desk().view().placing_allowed {
                break;
            }
        }
        let to = self.hand.pointing_at(self.hand.place());
        self.follow(vec![Leg::to(to, 0.04).holding(Buttons::FRONT), Leg::to(to, 0.04)]);
    }

    /// How far the workspace is still to be turned to the left [rad].
    fn off(&self, azimuth_rad: f64) -> f64 {
        let off = azimuth_rad - self.hand.report().azimuth_rad;
        off - TAU * libm::round(off / TAU)
    }

    /// Turns the workspace by its edges until the wrist does the rest.
    fn turn_to(&mut self, azimuth_rad: f64) {
        while 0.15 < self.off(azimuth_rad).abs() {
            // The left edge turns to the left.
            let side = -self.off(azimuth_rad).signum();
            self.follow(vec![Leg::to(BEHIND + DVec3::X * (side * 0.084), 0.4)]);
            for _ in 0..20_000 {
                if self.off(azimuth_rad) * -side < 0.1 {
                    break;
                }
                self.tick();
            }
            self.follow(vec![Leg::to(BEHIND, 0.4)]);
        }
    }

    /// Raises the butt by the upper edge.
    fn raise_to(&mut self, elevation_rad: f64) {
        self.follow(vec![Leg::to(BEHIND + DVec3::Y * 0.064, 0.4)]);
        for _ in 0..5_000 {
            if elevation_rad < self.hand.report().elevation_rad {
                break;
            }
            self.tick();
        }
        self.follow(vec![Leg::to(BEHIND, 0.4)]);
    }

    fn shoot(&mut self) {
        let bed = self.table.bed.unwrap();
        let desk = self.desk.as_ref().unwrap();
        let view = TableView2d::of(desk.table(), &bed, &self.table.pockets, POOL_RADIUS_M);
        let turn = desk.turn().unwrap();
        let goal = Goal::of(&turn, &view, turn.ball_in_hand.zone());
        let cue_ball = desk.cue_ball().position.truncate();
        let plan = plan_shot(&view, cue_ball, &goal, 0.07, &mut self.random);
        let azimuth_rad = libm::atan2(plan.direction.y, plan.direction.x);
        let speed_m_s = if turn.shot == ShotKind::Break { 6.0 } else { plan.speed_m_s };
        self.hand.lay(desk.table());
        self.follow(vec![Leg::to(BEHIND, 0.4)]);
        self.turn_to(azimuth_rad);
        // Where a rail is in the way of the cue the butt goes up.
        for elevation_rad in [0.0, 0.35, 0.7] {
            if 0.0 < elevation_rad {
                self.raise_to(elevation_rad);
            }
            let left_rad = self.off(azimuth_rad);
            self.follow(stroke((speed_m_s / gain()).max(0.05), left_rad));
            if self.mode() != HumanMode::HoldingStylus {
                return;
            }
        }
        panic!("the stroke meets nothing");
    }

    /// Pauses by the wheel, and goes on by the menu.
    fn pause_and_go_on(&mut self) {
        self.turn_wheel(DVec2::NEG_Y);
        assert_eq!(self.mode(), HumanMode::Paused);
        self.wait(0.05);
        self.choose("resume", None);
        self.wait(0.05);
        assert_eq!(self.mode(), HumanMode::HoldingStylus);
    }

    /// Leads the camera to the left, and takes the cue again.
    fn look_round(&mut self) {
        self.turn_wheel(DVec2::Y);
        assert!(self.desk().view().look.free);
        let before = self.desk().view().camera;
        let from = self.hand.position();
        let aside = from - DVec3::X * 0.03;
        self.follow(vec![Leg::to(aside, 0.3), Leg::to(aside, 0.5), Leg::to(from, 0.3)]);
        let after = self.desk().view().camera;
        assert_eq!(after.eye, before.eye, "without the front button it only turns");
        let way = |camera: hapticbillard::input::CameraPose| camera.target - camera.eye;
        let turned = way(before).truncate().angle_to(way(after).truncate());
        assert!(0.1 < turned, "{turned}");
        let ahead = from - DVec3::Z * 0.03;
        self.follow(vec![Leg::to(ahead, 0.3), Leg::to(from, 0.3)]);
        assert!(0.05 < self.desk().view().camera.eye.distance(after.eye));
        self.turn_wheel(DVec2::Y);
        assert!(!self.desk().view().look.free);
        assert_eq!(self.mode(), HumanMode::HoldingStylus);
    }
}

#[test]
fn whole_game_by_stylus_only() {
    let mut seated = Seated::new();
    assert!(seated.choose("play", None).is_empty());
    assert_eq!(seated.choose("game", Some(0.9)), [Order::Apply]);
    assert_eq!(seated.choose("start", None), [Order::Begin(Begin::Set)]);
    seated.begin();

    let mut strokes = 0;
    while seated.desk().finished.is_none() {
        match seated.mode() {
            HumanMode::Placing => seated.place(),
            HumanMode::HoldingStylus => {
                strokes += 1;
                // Once in a game something else is to be done.
                match strokes {
                    2 => seated.pause_and_go_on(),
                    3 => seated.look_round(),
                    _ => {}
                }
                seated.shoot();
            }
            // Balls roll, or somebody else plays.
            _ => seated.desk.as_mut().unwrap().tick(&[]),
        }
        assert!(strokes < 200, "the game does not end");
    }

    let desk = seated.desk.as_mut().unwrap();
    desk.assert_won_or_lost();
    assert!(strokes > 3, "there was a stroke after the pause, and one after the camera");
    assert!(desk.lobby.ended(true).is_empty());
    seated.lobby = Some(seated.desk.take().unwrap().lobby);
    assert_eq!(seated.choose("leave", None), [Order::Clear]);
    assert_eq!(seated.choose("quit", None).last(), Some(&Order::Quit));
}

#[test]
fn a_wheel_opens_by_a_key_too_and_only_in_a_game() {
    use hapticbillard::input::{Key, RawInput};
    let mut lobby = Lobby::new(None);
    let key = |down| RawInput::Key { key: Key::Letter('e'), down };
    assert!(lobby.hear(key(true), None).is_empty() && lobby.wheel().is_none());
    lobby.hear(key(false), None);
    lobby.began();
    // The game hears that all is let go, since nothing else is heard meanwhile.
    assert_eq!(lobby.hear(key(true), None), [Order::Tell(HandInput::FocusLost)]);
    assert!(lobby.wheel().is_some());
    // The mouse moves nothing else meanwhile; downwards is the pause.
    assert!(lobby.hear(RawInput::Moved { right: 0.0, up: -0.1 }, None).is_empty());
    let act = |down| Order::Tell(HandInput::Act { action: Action::Pause, down });
    assert_eq!(lobby.hear(key(false), None), [act(true), act(false)]);
    assert!(lobby.wheel().is_none());
    // Without a choice nothing is done, and whoever loses the keyboard has chosen nothing.
    lobby.hear(key(true), None);
    assert!(lobby.hear(key(false), None).is_empty());
    lobby.hear(key(true), None);
    lobby.hear(RawInput::Moved { right: 0.1, up: 0.0 }, None);
    lobby.hear(RawInput::FocusLost, None);
    assert!(lobby.wheel().is_none() && lobby.hear(key(false), None).is_empty());
}
