//! The last shot is seen again: who hears what meanwhile, and what is afterwards.

use hapticbillard::input::{
    Action, Button, HandInput, HumanMode, HumanView, Key, PadInput, RawInput,
};
use hapticbillard::menu::{Lobby, Menu, Order, Pages, Settings};

fn lobby() -> Lobby {
    let mut lobby = Lobby::new(Some(Menu::new(Pages::shipped().unwrap(), Settings::default())));
    lobby.began();
    lobby.see(&view(HumanMode::Aiming));
    lobby.see_film(true);
    lobby
}

fn view(mode: HumanMode) -> HumanView {
    HumanView { mode, ..HumanView::default() }
}

fn press(lobby: &mut Lobby, key: Key) -> Vec<Order> {
    let mut orders = lobby.hear(RawInput::Key { key, down: true }, None);
    orders.extend(lobby.hear(RawInput::Key { key, down: false }, None));
    orders
}

fn act(action: Action, down: bool) -> HandInput {
    HandInput::Act { action, down }
}

fn stands(paused: bool) -> Order {
    Order::Tell(HandInput::Paused(paused))
}

const LET_GO: Order = Order::Tell(HandInput::FocusLost);

const REPLAY: Key = Key::Letter('y');

#[test]
fn time_stands_still_while_the_shot_is_seen_and_goes_on_after_it() {
    let mut lobby = lobby();
    // What is held when it begins is let go in the game.
    assert_eq!(press(&mut lobby, REPLAY), [LET_GO, stands(true), Order::Replay(true)]);
    assert!(lobby.is_replaying());
    // The pause that it needs opens no menu.
    assert!(lobby.see(&view(HumanMode::Paused)).is_empty() && !lobby.is_menu_open());
    // What moves eyes is for whoever looks, and so is everything else; the game hears nothing.
    let wheel = RawInput::Wheel { notches: 1.0 };
    assert_eq!(lobby.hear(wheel, None), [Order::Onlook(HandInput::Wheel { notches: 1.0 })]);
    let click = RawInput::Button { button: Button::Left, down: true };
    assert_eq!(lobby.hear(click, None), [Order::Onlook(act(Action::Stroke, true))]);
    let views = press(&mut lobby, Key::Letter('w'));
    assert_eq!(views[0], Order::Onlook(act(Action::NextView, true)));
    assert_eq!(press(&mut lobby, Key::Letter('+')), [Order::Do(Action::FilmFaster)]);
    assert_eq!(press(&mut lobby, Key::Letter('h')), [Order::Do(Action::FilmHold)]);
    // Escape leads back: the game goes on, and no menu opens on the way.
    let orders = press(&mut lobby, Key::Escape);
    assert_eq!(orders[..2], [Order::Replay(false), stands(false)]);
    assert!(lobby.see(&view(HumanMode::Paused)).is_empty() && !lobby.is_menu_open());
    lobby.see(&view(HumanMode::Aiming));
    assert!(lobby.is_playing() && !lobby.is_replaying());
    // From here on a pause is a pause.
    lobby.see(&view(HumanMode::Paused));
    assert!(lobby.is_menu_open());
}

#[test]
fn the_key_that_began_it_ends_it_and_a_pause_meant_at_its_end_is_one() {
    let mut lobby = lobby();
    press(&mut lobby, REPLAY);
    lobby.see(&view(HumanMode::Paused));
    assert_eq!(press(&mut lobby, REPLAY)[..2], [Order::Replay(false), stands(false)]);
    // The game has not gone on yet when somebody stops it: that is meant, and a menu opens.
    press(&mut lobby, Key::Escape);
    lobby.see(&view(HumanMode::Paused));
    assert!(lobby.is_menu_open());
    // A game that was told to go on goes on after a film that was wanted at once.
    let mut lobby = self::lobby();
    lobby.see(&view(HumanMode::Paused));
    press(&mut lobby, Key::Enter);
    assert_eq!(press(&mut lobby, REPLAY), [LET_GO, stands(true), Order::Replay(true)]);
    assert!(lobby.end_replay().contains(&stands(false)));
    // Who has lost the gamepad meanwhile finds time standing still.
    let mut lobby = self::lobby();
    press(&mut lobby, REPLAY);
    lobby.hear(RawInput::Pad(PadInput::Lost), None);
    assert!(!lobby.end_replay().contains(&stands(false)));
}

#[test]
fn from_the_pause_it_leads_back_to_the_pause() {
    let mut lobby = lobby();
    lobby.see(&view(HumanMode::Paused));
    press(&mut lobby, Key::Down);
    assert_eq!(press(&mut lobby, Key::Enter), [Order::Replay(true)]);
    assert!(!lobby.is_menu_open());
    lobby.see(&view(HumanMode::Paused));
    assert!(!lobby.is_menu_open());
    // The film ends by itself.
    assert_eq!(lobby.end_replay(), [Order::Replay(false)]);
    lobby.see(&view(HumanMode::Paused));
    assert!(lobby.is_menu_open(), "time still stands still");
}

#[test]
fn after_the_game_it_leads_back_to_how_it_ended() {
    let mut lobby = lobby();
    assert!(lobby.ended(true).is_empty() && lobby.is_over());
    press(&mut lobby, Key::Down);
    assert_eq!(press(&mut lobby, Key::Enter), [Order::Replay(true)]);
    assert!(!lobby.is_menu_open());
    assert_eq!(press(&mut lobby, Key::Letter('p')), [Order::Replay(false)]);
    let page = lobby.menu().unwrap().seen().unwrap().0.name.clone();
    assert_eq!(page, "over");
}

#[test]
fn without_a_shot_it_is_said_and_a_game_that_ends_takes_its_film_along() {
    let mut lobby = lobby();
    lobby.see_film(false);
    assert_eq!(press(&mut lobby, REPLAY), [Order::Say("no_replay")]);
    lobby.see_film(true);
    press(&mut lobby, REPLAY);
    lobby.see(&view(HumanMode::Paused));
    assert_eq!(lobby.ended(false), [Order::Replay(false), Order::Clear]);
    assert!(!lobby.is_replaying());
    assert!(press(&mut lobby, REPLAY).is_empty(), "no game, no film");
    // Whoever goes to another window lets go of everything on both sides.
    let mut lobby = self::lobby();
    press(&mut lobby, REPLAY);
    let lost = [Order::Onlook(HandInput::FocusLost), Order::Tell(HandInput::FocusLost)];
    assert_eq!(lobby.hear(RawInput::FocusLost, None), lost);
}

#[test]
fn a_newcomer_is_shown_the_tutorial_once() {
    let settings = Settings::default();
    let mut lobby = Lobby::new(Some(Menu::new(Pages::shipped().unwrap(), settings)));
    lobby.open_main();
    assert!(lobby.welcome());
    let menu = lobby.menu().unwrap();
    let (page, line) = menu.seen().unwrap();
    assert_eq!(page.items[line].text, "tutorial");
    assert!(menu.notice.is_some());
    let known = Settings::parse(&menu.settings.to_toml()).unwrap();
    let mut lobby = Lobby::new(Some(Menu::new(Pages::shipped().unwrap(), known)));
    lobby.open_main();
    assert!(!lobby.welcome() && lobby.menu().unwrap().notice.is_none());
}
