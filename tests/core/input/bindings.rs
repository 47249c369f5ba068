//! Which key means what: files, profiles, conflicts; nothing that is held stays held.

use hapticbillard::input::{
    Action, Beside, Bindings, BindingsError, Bound, Button, Control, Controller, Controls, Edge,
    Key, PadButton, Profile, Profiles,
};
use hapticbillard::shipped;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::BTreeSet;

const FILE: &str = "keys.toml";

fn letter(letter: char) -> Control {
    Control::Key(Key::Letter(letter))
}

fn with(text: &str) -> Result<Bindings, BindingsError> {
    Bindings::shipped().with_file(FILE, text)
}

#[test]
fn the_shipped_keys_are_those_that_hands_know() {
    let keys = Bindings::read_shipped().unwrap();
    let known = [
        (letter('a'), Profile::Cue, Action::TurnLeft),
        (Control::Key(Key::Enter), Profile::Cue, Action::Strike),
        (Control::Key(Key::Enter), Profile::Menu, Action::MenuAccept),
        (Control::Key(Key::Escape), Profile::Pause, Action::Pause),
        (Control::Key(Key::Escape), Profile::Menu, Action::MenuBack),
        (letter('q'), Profile::Menu, Action::Quit),
        (Control::Button(Button::Left), Profile::Cue, Action::Stroke),
        (Control::Pad(PadButton::A), Profile::Choice, Action::Option3),
        (Control::Key(Key::Function(1)), Profile::Camera, Action::Help),
    ];
    for (control, profile, action) in known {
        assert_eq!(keys.action(control, profile), Some(action), "{control:?} in {profile:?}");
    }
    // Who looks on plays nothing, and nobody quits by accident in the middle of a stroke.
    assert_eq!(keys.action(letter('a'), Profile::Camera), None);
    assert_eq!(keys.action(letter('q'), Profile::Cue), None);
    for action in Action::ALL {
        assert!(!keys.keys(*action).is_empty(), "{action:?} has a key");
        assert_eq!(Action::named(action.name()), Some(*action));
    }
    for name in Control::names() {
        assert_eq!(Control::named(&name).map(Control::name), Some(name));
    }
    assert_eq!(with(&keys.to_toml()).unwrap(), keys);
}

#[test]
fn a_controller_belongs_to_several_profiles_and_a_profile_to_several_controllers() {
    let profiles = Profiles::parse(shipped::PROFILES).unwrap();
    let of = |controller| {
        Profile::ALL.iter().filter(|one| profiles.is_active(controller, **one)).count()
    };
    assert_eq!(of(Controller::Window), Profile::ALL.len(), "what is always heard");
    assert_eq!((of(Controller::Cue), of(Controller::Film)), (2, 1));
    assert_eq!((of(Controller::Eye), of(Controller::Leave)), (5, 2));
    let wrong = |text: &'static str| {
        let swap = |(name, old): &(&'static str, &'static str)| {
            (*name, if *name == "cue" { text } else { *old })
        };
        let files: Vec<_> = shipped::PROFILES.iter().map(swap).collect();
        Profiles::parse(&files).unwrap_err().to_string()
    };
    assert_eq!(
        wrong("\ncontrollers = [\"cue\",\n\"ey\"]"),
        "config/profiles/cue.toml:3: there is no controller \"ey\"; is \"eye\" meant?"
    );
    assert!(wrong("controllers = 3").contains("a profile is one list"));
    assert!(wrong("controllers = []\nkeys = []").contains("a profile is one list"));
    assert!(wrong("controllers = [").starts_with("config/profiles/cue.toml: TOML parse error"));
    let missing = Profiles::parse(&shipped::PROFILES[1..]).unwrap_err().to_string();
    assert_eq!(missing, "config/profiles/always.toml is missing");
}

#[test]
fn what_is_wrong_with_a_file_is_said_in_one_line() {
    let messages = [
        (
            "# mine\nturn_lft = [\"j\"]",
            "keys.toml:2: there is no action \"turn_lft\"; is \"turn_left\" meant?",
        ),
        (
            "turn_left = [\n\"j\",\n\"pagedown\"]",
            "keys.toml:3: there is no key \"pagedown\" for turn_left; is \"page_down\" meant?",
        ),
        (
            "turn_left = \"j\"",
            "keys.toml:1: turn_left needs a list of keys, such as turn_left = [\"a\"]",
        ),
        (
            "turn_left = [3]",
            "keys.toml:1: turn_left needs a list of keys, such as turn_left = [\"a\"]",
        ),
        (
            "turn_left = [\"a\"]\n\nnext_ball = [\"a\"]",
            "keys.toml:3: `a` is bound to turn_left and to next_ball in profile cue",
        ),
        ("help = [\"up\"]", "keys.toml:1: `up` is bound to help and to menu_up in profile menu"),
        (
            "pause = [\"pad_start\"]",
            "keys.toml:1: pause needs a key: without one nobody could use the menus",
        ),
        (
            "menu_back = []",
            "keys.toml:1: menu_back needs a key: without one nobody could use the menus",
        ),
    ];
    for (text, message) in messages {
        assert_eq!(with(text).unwrap_err().to_string(), message);
    }
    let form = with("turn_left = [").unwrap_err().to_string();
    assert!(form.starts_with("keys.toml: TOML parse error at line 1") && !form.contains('\n'));
    let long = with(&format!("\"{}\n\" = []", "x".repeat(3000))).unwrap_err().to_string();
    assert!(long.len() < 500 && !long.contains('\n'), "{long}");
}

#[test]
fn a_file_says_what_it_says_and_the_rest_is_as_usual() {
    let keys = with("next_ball = [\"a\", \"mouse_back\", \"a\"]").unwrap();
    assert_eq!(keys.keys(Action::NextBall), [letter('a'), Control::Button(Button::Back)]);
    // What the file does not name loses what the file gives away, and nothing else.
    assert_eq!(keys.keys(Action::TurnLeft), []);
    assert_eq!(keys.keys(Action::TurnRight), [letter('d')]);
    // Elsewhere a key may mean something else.
    let keys = with("option_1 = [\"a\"]").unwrap();
    assert_eq!(keys.keys(Action::TurnLeft), [letter('a')]);
}

#[test]
fn whoever_loses_a_key_is_named_and_nobody_loses_the_menus() {
    let mut keys = Bindings::shipped();
    let taken = |losers: &[Action]| Bound::Done { losers: losers.to_vec() };
    assert_eq!(keys.bind(Action::TurnLeft, letter('0'), Beside::Instead), taken(&[]));
    assert_eq!(keys.keys(Action::TurnLeft), [letter('0')]);
    assert_eq!(keys.bind(Action::TurnLeft, letter('b'), Beside::Added), taken(&[Action::NextBall]));
    assert_eq!(keys.keys(Action::TurnLeft), [letter('0'), letter('b')]);
    assert_eq!(keys.keys(Action::NextBall), [Control::Pad(PadButton::Left)], "the other device's");
    let pad = Control::Pad(PadButton::Y);
    assert_eq!(keys.bind(Action::TurnLeft, pad, Beside::Instead), taken(&[Action::TipMiddle]));
    assert_eq!(keys.keys(Action::TurnLeft).len(), 3, "a gamepad's beside a keyboard's");
    // What is always heard meets everything.
    assert_eq!(keys.bind(Action::Help, letter('1'), Beside::Instead), taken(&[Action::Option1]));
    let up = Control::Key(Key::Up);
    let refused = keys.bind(Action::Help, up, Beside::Instead);
    assert_eq!(refused, Bound::Refused { of: Action::MenuUp });
    // A pause can spare one key of two.
    let [escape, p] = [Control::Key(Key::Escape), letter('p')];
    assert_eq!(keys.bind(Action::Mute, p, Beside::Instead), taken(&[Action::Pause]));
    let refused = keys.bind(Action::Mute, escape, Beside::Instead);
    assert_eq!(refused, Bound::Refused { of: Action::Pause });
    assert_eq!(with(&keys.to_toml()).unwrap(), keys);
}

#[test]
fn what_is_held_means_what_it_meant_until_it_is_let_go() {
    let mut controls = Controls::new(Bindings::shipped());
    assert!(controls.switch(Profile::Cue).is_empty());
    let turn = |edge| Some((Action::TurnLeft, edge));
    assert_eq!(controls.hear(letter('a'), true), turn(Edge::Pressed));
    assert_eq!(controls.hear(letter('a'), true), turn(Edge::Repeated));
    // Another key is bound while this one is held.
    let mut keys = Bindings::shipped();
    keys.bind(Action::TurnLeft, letter('0'), Beside::Instead);
    controls.rebind(keys);
    assert_eq!(controls.hear(letter('0'), true), None, "it goes on already");
    assert_eq!(controls.hear(letter('a'), false), None, "the other key is held");
    assert_eq!(controls.hear(letter('0'), false), turn(Edge::Released));
    assert_eq!(controls.hear(letter('a'), true), None, "it means nothing now");

    // A profile that does not hear it ends it; the key means nothing until it is pressed again.
    assert_eq!(controls.hear(letter('0'), true), turn(Edge::Pressed));
    let looks = controls.hear(letter('c'), true);
    assert_eq!(looks, Some((Action::Look, Edge::Pressed)));
    assert_eq!(controls.switch(Profile::Choice), [Action::TurnLeft]);
    assert!(controls.switch(Profile::Cue).is_empty());
    assert_eq!(controls.hear(letter('0'), false), None);
    assert_eq!(controls.hear(letter('c'), false), Some((Action::Look, Edge::Released)));
    controls.forget();
    assert_eq!(controls.hear(letter('0'), false), None);
}

#[test]
fn whatever_happens_every_action_that_begins_ends() {
    let mut random = Pcg64Mcg::seed_from_u64(8);
    let all: Vec<Control> =
        Control::names().iter().map(|name| Control::named(name).unwrap()).collect();
    let mut controls = Controls::new(Bindings::shipped());
    let mut keys = Bindings::shipped();
    let mut goes_on = BTreeSet::new();
    let mut bound = 0;
    for step in 0..100_000 {
        let control = all[random.random_range(0..all.len())];
        let ended = match random.random_range(0..100) {
            0..94 => {
                match controls.hear(control, random.random()) {
                    Some((action, Edge::Pressed)) => {
                        assert!(goes_on.insert(action) || !action.is_held(), "{action:?}");
                    }
                    Some((action, Edge::Released)) => {
                        assert!(goes_on.remove(&action), "{action:?}")
                    }
                    Some((action, Edge::Repeated)) => assert!(goes_on.contains(&action)),
                    None => {}
                }
                Vec::new()
            }
            94..97 => controls.switch(Profile::ALL[random.random_range(0..Profile::ALL.len())]),
            97..99 => {
                let action = Action::ALL[random.random_range(0..Action::ALL.len())];
                let beside = [Beside::Instead, Beside::Added][step % 2];
                bound +=
                    u32::from(matches!(keys.bind(action, control, beside), Bound::Done { .. }));
                controls.rebind(keys.clone());
                // No sequence of wishes makes a file that is refused, or loses a menu.
                if step % 50 == 0 {
                    assert_eq!(with(&keys.to_toml()).as_ref(), Ok(&keys));
                }
                Vec::new()
            }
            _ => {
                controls.forget();
                std::mem::take(&mut goes_on).into_iter().collect()
            }
        };
        ended.iter().for_each(|action| {
            goes_on.remove(action);
        });
    }
    assert!(bound > 500, "{bound}");
    for control in all {
        if let Some((action, edge)) = controls.hear(control, false) {
            assert!(edge == Edge::Released && goes_on.remove(&action));
        }
    }
    assert!(goes_on.is_empty(), "{goes_on:?} are stuck");
}
