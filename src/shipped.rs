//! Configuration that is compiled in, so that the program runs from any folder.

/// The tables, by name: the text of `config/tables/NAME.toml`.
pub const TABLES: &[(&str, &str)] = &[
    ("pool-9ft", include_str!("../config/tables/pool-9ft.toml")),
    ("pool-8ft", include_str!("../config/tables/pool-8ft.toml")),
    ("pool-7ft", include_str!("../config/tables/pool-7ft.toml")),
    ("snooker-12ft", include_str!("../config/tables/snooker-12ft.toml")),
    ("carom-10ft", include_str!("../config/tables/carom-10ft.toml")),
];

/// The scenes, by name: the text of `config/scenes/NAME.toml`.
pub const SCENES: &[(&str, &str)] = &[
    ("eight_ball", include_str!("../config/scenes/eight_ball.toml")),
    ("eight_ball_headless", include_str!("../config/scenes/eight_ball_headless.toml")),
    ("wpa_eight_ball", include_str!("../config/scenes/wpa_eight_ball.toml")),
    ("nine_ball", include_str!("../config/scenes/nine_ball.toml")),
    ("straight", include_str!("../config/scenes/straight.toml")),
    ("training", include_str!("../config/scenes/training.toml")),
    ("tutorial", include_str!("../config/scenes/tutorial.toml")),
    ("free_play", include_str!("../config/scenes/free_play.toml")),
    ("snooker", include_str!("../config/scenes/snooker.toml")),
    ("three_cushion", include_str!("../config/scenes/three_cushion.toml")),
    ("free_carom", include_str!("../config/scenes/free_carom.toml")),
    ("break_shot", include_str!("../config/scenes/break_shot.toml")),
    ("one_ball", include_str!("../config/scenes/one_ball.toml")),
    ("minigolf", include_str!("../config/scenes/minigolf.toml")),
    ("haptic_touch", include_str!("../config/scenes/haptic_touch.toml")),
];

/// The pages of menus, by name: the text of `config/menus/NAME.toml`.
pub const MENUS: &[(&str, &str)] = &[
    ("main", include_str!("../config/menus/main.toml")),
    ("mode", include_str!("../config/menus/mode.toml")),
    ("options", include_str!("../config/menus/options.toml")),
    ("graphics", include_str!("../config/menus/graphics.toml")),
    ("graphics_eye", include_str!("../config/menus/graphics_eye.toml")),
    ("keys", include_str!("../config/menus/keys.toml")),
    ("keys_cue", include_str!("../config/menus/keys_cue.toml")),
    ("keys_say", include_str!("../config/menus/keys_say.toml")),
    ("keys_see", include_str!("../config/menus/keys_see.toml")),
    ("keys_again", include_str!("../config/menus/keys_again.toml")),
    ("pause", include_str!("../config/menus/pause.toml")),
    ("over", include_str!("../config/menus/over.toml")),
];

/// The wheel menu, as TOML; see [`crate::menu::WheelPage`].
pub const WHEEL: &str = include_str!("../config/menus/wheel.toml");

/// The profiles of controllers, by name: the text of `config/profiles/NAME.toml`.
pub const PROFILES: &[(&str, &str)] = &[
    ("always", include_str!("../config/profiles/always.toml")),
    ("menu", include_str!("../config/profiles/menu.toml")),
    ("cue", include_str!("../config/profiles/cue.toml")),
    ("choice", include_str!("../config/profiles/choice.toml")),
    ("camera", include_str!("../config/profiles/camera.toml")),
    ("pause", include_str!("../config/profiles/pause.toml")),
    ("replay", include_str!("../config/profiles/replay.toml")),
];

/// What keys and buttons mean, as TOML; see [`crate::input::Bindings`].
pub const KEYS: &str = include_str!("../config/profiles/keys.toml");

/// The meshes of scenes, by file name: the text of `config/scenes/NAME`.
pub const MESHES: &[(&str, &str)] =
    &[("minigolf.obj", include_str!("../config/scenes/minigolf.obj"))];

/// The catalogue of cases with known answers.
pub const CASES: &str = include_str!("../config/validation/cases.json");

/// The same for the haptic renderer.
pub const HAPTIC_CASES: &str = include_str!("../config/validation/haptic_cases.json");

/// Throw compensation over cut and speed, as TOML; see [`crate::ai::ThrowTable`].
pub const THROW_TABLE: &str = include_str!("../config/ai/throw.toml");

/// Parameters of the shipped table `name`, as TOML.
pub fn table(name: &str) -> Option<&'static str> {
    TABLES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// The text of the mesh file `name` of a shipped scene.
pub fn mesh(name: &str) -> Option<&'static str> {
    MESHES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// The text of the shipped scene `name`.
pub fn scene(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
