//! Tests of the runtime.

// Helpers of tests may fail loudly, as tests do.
#![allow(clippy::unwrap_used)]

/// The program away from its source.
mod anywhere;
/// Many shots at once.
mod batch;
/// Bytes from outside, as the fuzz tests of the core take them.
#[cfg(feature = "sound")]
#[path = "../fuzz/bytes.rs"]
#[allow(dead_code)]
mod bytes;
/// The program as a shell sees it: what it prints where, and its exit codes.
mod cli;
/// Forces that end when something fails while a wall is felt.
mod contact;
/// An allocator that counts.
#[path = "../counting.rs"]
mod counting;
/// A stylus without a game.
#[cfg(feature = "renderer")]
mod desk_stylus;
/// Recordings of haptic devices as files.
mod device_recordings;
/// What the program says of a machine.
mod doctor;
/// Random facts for the referee, as the fuzz tests of the core make them.
#[path = "../fuzz/facts.rs"]
mod facts;
/// The table of failures, cell by cell.
mod failures;
/// Files: sizes, kinds, writing whole.
mod files;
/// From the stylus to the mouse and back.
mod hand_over;
/// A Haply device at a service of our own.
mod haply;
/// The haptic renderer on the bench.
mod haptic;
/// Somebody who hears events and keeps them.
mod hearing;
/// What `--json` prints, and what options change.
mod json;
/// The chapter of what is left out.
mod left_out;
/// The licences of what is linked.
mod licences;
/// Shipped light fits its room and is the light of it.
#[cfg(feature = "renderer")]
mod light;
/// Full queues and slow listeners.
mod load;
/// What the program says about itself, and where.
mod logging;
/// Completions and manual pages.
mod manual;
/// Who stands in for whom.
mod mocks;
/// Devices of the vendor's HD library, in front of a stub of it.
mod openhaptics;
/// What enters from outside: pauses, wrong files.
mod outside;
/// Gamepads: the driver's thread, and a whole game by a mock device in front of it.
mod pads;
/// Pictures without a window.
#[cfg(feature = "renderer")]
mod pictures;
/// Real-time rights for ordinary users.
#[cfg(all(target_os = "linux", feature = "rtkit"))]
mod realtime_kit;
/// Recordings of games that were interrupted or killed.
#[cfg(unix)]
mod recordings;
/// Threads and memory, counted from outside.
mod resources;
/// Random events against the actor of the referee, through its mailbox.
mod rule_actor;
/// Actors against lockstep, replays, a mock hand.
mod same_bits;
/// The servo's thread, and the actor that controls it.
mod servo;
/// Disturbed games, held against undisturbed ones.
mod soak;
/// Sound: the actor in front of a speaker of our own, and the system's real audio library.
mod sound;
/// What libFuzzer found among sound files.
#[cfg(feature = "sound")]
mod sound_corpus;
/// Sound files: a player's recordings, and every class written.
#[cfg(feature = "sound")]
mod sound_files;
/// The line to a device that comes and goes.
mod sound_line;
/// The stub of the vendor's HD library.
mod stub_hd;
/// Who dies and what then.
mod supervision;
/// The progress bar.
#[cfg(unix)]
mod terminal;
/// A break of a thousand balls.
#[path = "../thousand.rs"]
mod thousand;
/// Tournaments and matches.
mod tournament;
/// A whole game in a window.
#[cfg(feature = "renderer")]
mod whole_game;
/// Wrong input to every command.
mod wrong_input;
