//! The page of keys, help, and gamepads in menus.

use super::{menu, paused, seen};
use glam::DVec2;
use hapticbillard::input::{
    Action, Bindings, Button, HandInput, Key, PadAxis, PadButton, PadInput, RawInput,
};
use hapticbillard::menu::{Effect, Item, Lobby, Order, Pointed};
use hapticbillard::renderer::{MenuPanel, Words};
use hapticbillard::rules::Language;

#[test]
fn a_key_is_chosen_on_its_page_and_conflicts_are_said() {
    let words = Words::of_menus(Language::English);
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    let press = |lobby: &mut Lobby, key| {
        let mut orders = lobby.hear(RawInput::Key { key, down: true }, None);
        orders.extend(lobby.hear(RawInput::Key { key, down: false }, None));
        orders
    };
    let open = |lobby: &mut Lobby| {
        lobby.open_main();
        for page in ["options", "keys", "keys_cue"] {
            let menu = lobby.menu().unwrap();
            let opens = |item: &Item| item.effect == Effect::Opens(page.into());
            let line = menu.seen().unwrap().0.items.iter().position(opens).unwrap();
            let at = Some(Pointed { line, share: None, is_scale: false });
            lobby.hear(RawInput::Button { button: Button::Left, down: true }, at);
            lobby.hear(RawInput::Button { button: Button::Left, down: false }, at);
        }
    };
    let panel = |lobby: &Lobby| MenuPanel::new(lobby.menu().unwrap(), &words).unwrap();
    open(&mut lobby);
    let shown = panel(&lobby);
    assert_eq!(
        (shown.lines[0].text.as_str(), shown.lines[0].value.as_deref()),
        ("Turn left", Some("a"))
    );
    // A key that nobody has: it is so, and nothing is to be said. The key that chose the line is
    // still held, and repeated.
    lobby.hear(RawInput::Key { key: Key::Enter, down: true }, None);
    assert!(lobby.hear(RawInput::Key { key: Key::Enter, down: true }, None).is_empty());
    assert_eq!(panel(&lobby).lines[0].value.as_deref(), Some("press a key"));
    lobby.hear(RawInput::Key { key: Key::Enter, down: false }, None);
    assert_eq!(press(&mut lobby, Key::Letter('j')), [Order::Rebound]);
    assert_eq!(panel(&lobby).lines[0].value.as_deref(), Some("j"));
    // One more, taken from another action, which is said.
    press(&mut lobby, Key::Right);
    assert_eq!(press(&mut lobby, Key::Letter('b')), [Order::Rebound]);
    assert_eq!(panel(&lobby).lines[0].value.as_deref(), Some("j, b"));
    assert_eq!(panel(&lobby).notice.unwrap(), "b is taken from: Next ball.");
    // What the menus cannot be without is refused; Escape changes nothing.
    press(&mut lobby, Key::Up);
    press(&mut lobby, Key::Up);
    press(&mut lobby, Key::Enter);
    press(&mut lobby, Key::Escape);
    assert_eq!(panel(&lobby).title, "Cue", "still on the page");
    // By mouse and for a side button of it.
    let at = Some(Pointed { line: 0, share: Some(0.5), is_scale: false });
    lobby.hear(RawInput::Button { button: Button::Left, down: true }, at);
    lobby.hear(RawInput::Button { button: Button::Left, down: false }, at);
    let back = |down| RawInput::Button { button: Button::Back, down };
    assert_eq!(lobby.hear(back(true), at), [Order::Rebound]);
    assert!(lobby.hear(back(false), at).is_empty());
    assert_eq!(panel(&lobby).lines[0].value.as_deref(), Some("hind button"));
    assert_eq!(lobby.bindings(), &lobby.menu().unwrap().bindings);

    // In the game it is so, and a key that is held while a menu is open is not stuck.
    lobby.began();
    lobby.see(&paused(false));
    let turn = |down| Order::Tell(HandInput::Act { action: Action::TurnLeft, down });
    assert_eq!(lobby.hear(back(true), None), [turn(true)]);
    assert_eq!(lobby.see(&paused(true)), [Order::Tell(HandInput::FocusLost)]);
    assert!(lobby.hear(back(false), None).is_empty());
    // Everything as at first.
    open(&mut lobby);
    press(&mut lobby, Key::Escape);
    for _ in 0..4 {
        press(&mut lobby, Key::Down);
    }
    assert_eq!(press(&mut lobby, Key::Enter), [Order::Rebound]);
    assert_eq!(lobby.bindings(), &Bindings::shipped());
}

#[test]
fn help_is_shown_in_menus_and_in_games_and_any_key_closes_it_in_a_menu() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    let press = |lobby: &mut Lobby, key| {
        lobby.hear(RawInput::Key { key, down: true }, None);
        lobby.hear(RawInput::Key { key, down: false }, None);
        lobby.shows_help()
    };
    assert!(press(&mut lobby, Key::Function(1)));
    assert!(!press(&mut lobby, Key::Enter));
    assert_eq!(seen(lobby.menu().unwrap()).0, "main", "and nothing is chosen");
    lobby.began();
    lobby.see(&paused(false));
    assert!(press(&mut lobby, Key::Function(1)));
    assert!(press(&mut lobby, Key::Letter('d')), "somebody reads while playing");
    assert!(!press(&mut lobby, Key::Function(1)));
}

#[test]
fn what_a_gamepad_holds_goes_on_along_the_lines_and_nothing_else_does() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.open_main();
    let line = |lobby: &Lobby| seen(lobby.menu().unwrap()).1;
    let stick = |value| RawInput::Pad(PadInput::Axis { axis: PadAxis::LeftY, value });
    lobby.hear(stick(-0.9), None);
    assert_eq!(line(&lobby), "tutorial");
    // For so long it is one push; then it goes on, at its own pace and not at the window's.
    let mut now_s = 10.0;
    let mut wait = |lobby: &mut Lobby, seconds: f64| {
        for _ in 0..(seconds * 1000.0) as u32 {
            now_s += 0.001;
            assert!(lobby.pass(now_s).is_empty());
        }
    };
    wait(&mut lobby, 0.4);
    assert_eq!(line(&lobby), "tutorial");
    wait(&mut lobby, 0.1);
    assert_eq!(line(&lobby), "options");
    wait(&mut lobby, 0.2);
    assert_ne!(line(&lobby), "options");
    lobby.hear(stick(0.0), None);
    let stays = line(&lobby);
    wait(&mut lobby, 2.0);
    assert_eq!(line(&lobby), stays);
    // A button of the cross likewise; the one that chooses chooses once.
    let button = |button, down| RawInput::Pad(PadInput::Button { button, down });
    lobby.hear(button(PadButton::Up, true), None);
    let once = line(&lobby);
    wait(&mut lobby, 0.5);
    assert_ne!(line(&lobby), once);
    lobby.hear(button(PadButton::Up, false), None);
    while line(&lobby) != "options" {
        lobby.hear(button(PadButton::Down, true), None);
        lobby.hear(button(PadButton::Down, false), None);
    }
    lobby.hear(button(PadButton::A, true), None);
    let stays = line(&lobby);
    wait(&mut lobby, 2.0);
    assert_eq!(line(&lobby), stays);
}

#[test]
fn a_gamepad_that_goes_lets_go_of_everything_stops_time_and_is_said() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.began();
    lobby.see(&paused(false));
    let fine = RawInput::Pad(PadInput::Button { button: PadButton::LeftShoulder, down: true });
    let held = Order::Tell(HandInput::Act { action: Action::Fine, down: true });
    assert_eq!(lobby.hear(fine, None), [held]);
    assert!(lobby.is_by_pad());
    let lost = lobby.hear(RawInput::Pad(PadInput::Lost), None);
    assert_eq!(lost, [Order::Tell(HandInput::PadLost), Order::Say("pad_lost")]);
    assert!(!lobby.is_by_pad());
    assert_eq!(lobby.see(&paused(true)), [Order::Tell(HandInput::FocusLost)]);
    let words = Words::of_menus(Language::English);
    let panel = MenuPanel::new(lobby.menu().unwrap(), &words).unwrap();
    assert_eq!(
        (panel.title.as_str(), panel.notice.as_deref()),
        ("Paused", Some("The gamepad is gone."))
    );
    // A stick moves the menu, one line a push.
    let stick = |value| RawInput::Pad(PadInput::Axis { axis: PadAxis::LeftY, value });
    for value in [-0.7, -1.0, -0.5, -0.9] {
        lobby.hear(stick(value), None);
    }
    assert_eq!(seen(lobby.menu().unwrap()).1, "replay");
    lobby.hear(stick(0.0), None);
    lobby.hear(stick(-0.7), None);
    assert_eq!(seen(lobby.menu().unwrap()).1, "options");
}

#[test]
fn a_stick_that_moved_while_nobody_listened_is_forgotten() {
    let mut lobby = Lobby::new(Some(menu()));
    lobby.began();
    lobby.see(&paused(false));
    let axis = |axis, value| RawInput::Pad(PadInput::Axis { axis, value });
    let at = |orders: Vec<Order>| match orders[..] {
        [Order::Tell(HandInput::Stick { at, .. })] => at,
        _ => panic!("{orders:?}"),
    };
    assert_eq!(at(lobby.hear(axis(PadAxis::LeftX, 1.0), None)), DVec2::X);
    assert!(lobby.is_by_pad());
    lobby.hear(RawInput::FocusLost, None);
    // Its way back to the middle was not heard.
    assert_eq!(at(lobby.hear(axis(PadAxis::LeftY, 1.0), None)), DVec2::Y);
}
