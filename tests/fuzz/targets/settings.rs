use crate::bytes::{check_line, text};
use hapticbillard::input::Bindings;
use hapticbillard::menu::{Setting, Settings};
use hapticbillard::scene::Scene;

pub fn run(data: &[u8]) {
    keys(&text(data));
    let settings = match Settings::parse(&text(data)) {
        Ok(settings) => settings,
        Err(problem) => return check_line(&problem),
    };
    assert_eq!(Settings::parse(&settings.to_toml()).as_ref(), Ok(&settings));
    for setting in Setting::all() {
        let place = settings.place(setting);
        let last = Settings::range(setting).last();
        assert!(place <= last, "{setting:?}: {place}");
        let mut moved = settings.clone();
        moved.put(setting, place + 1);
        assert_eq!(moved.place(setting), (place + 1).min(last), "{setting:?}");
    }
    assert!((0.0..10.0).contains(&settings.mouse_factor()));
    assert!((0.0..10.0).contains(&settings.volume_factor()));
    // The game that is set can be begun.
    let mut scene = Scene::parse("game.toml", &settings.scene_text()).expect("a shipped scene");
    for (section, entrant) in scene.players.iter_mut().zip(settings.entrants()) {
        entrant.apply(section);
    }
}

/// The same bytes as the player's file of keys: understood, it is the same when it was written.
fn keys(text: &str) {
    let usual = Bindings::shipped();
    match usual.with_file("keys.toml", text) {
        Ok(keys) => assert_eq!(usual.with_file("keys.toml", &keys.to_toml()), Ok(keys)),
        Err(problem) => check_line(&problem.to_string()),
    }
}
