//! What the program makes of bytes that come from outside, one function each, and what must hold
//! whatever they are.
//!
//! libFuzzer looks for bytes that reach new code (`tests/fuzz/coverage`), and the corpus test reads
//! again what it found. Sound files are read by the actors and stand beside: `sounds.rs`.

/// Recordings of haptic devices.
pub mod device_recordings;
/// Facts, calls and choices, as the rule console reads them.
pub mod facts;
/// Messages of a Haply service.
pub mod haply;
/// Pages of menus.
pub mod menus;
/// OBJ files, and the world that is made of them.
pub mod meshes;
/// What an OpenHaptics library reports.
pub mod openhaptics;
/// Recordings of games.
pub mod recordings;
/// Events and choices for the referee.
pub mod rules;
/// Scenarios of rules.
pub mod scenarios;
/// Scenes, read.
pub mod scenes;
/// What a player has set.
pub mod settings;
/// Lines of `simulate --batch`.
pub mod strokes;
/// What a scene names, made and begun.
pub mod worlds;

/// A name, and what is run.
type Target = (&'static str, fn(&[u8]));

/// Every target that needs nothing but the core, by name.
pub const TARGETS: [Target; 13] = [
    ("device_recordings", device_recordings::run),
    ("facts", facts::run),
    ("haply", haply::run),
    ("menus", menus::run),
    ("meshes", meshes::run),
    ("openhaptics", openhaptics::run),
    ("recordings", recordings::run),
    ("rules", rules::run),
    ("scenarios", scenarios::run),
    ("scenes", scenes::run),
    ("settings", settings::run),
    ("strokes", strokes::run),
    ("worlds", worlds::run),
];
