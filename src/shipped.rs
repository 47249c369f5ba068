//! Configuration that is compiled in, so that the program runs from any folder.

/// The tables, by name: the text of `config/tables/NAME.toml`.
pub const TABLES: [(&str, &str); 1] = [("pool-9ft", "")];

/// The scenes, by name: the text of `config/scenes/NAME.toml`.
pub const SCENES: [(&str, &str); 6] = [
    ("eight_ball", include_str!("../config/scenes/eight_ball.toml")),
    ("eight_ball_headless", include_str!("../config/scenes/eight_ball_headless.toml")),
    ("free_play", include_str!("../config/scenes/free_play.toml")),
    ("break_shot", include_str!("../config/scenes/break_shot.toml")),
    ("one_ball", include_str!("../config/scenes/one_ball.toml")),
    ("minigolf", include_str!("../config/scenes/minigolf.toml")),
];

/// The text of a shipped scene.
pub fn scene(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
