//! Tests of the cores: pure, milliseconds.

// Helpers of tests may fail loudly, as tests do.
#![allow(clippy::unwrap_used)]

/// The computer player: planning, cue motion, turn states.
mod ai;
/// Carom: a table without pockets, a cue ball for each player.
mod carom;
/// An allocator that counts.
#[path = "../counting.rs"]
mod counting;
/// The exact solver over many random shots.
mod event_driven;
/// Order, delay and interest of the event manager.
mod event_manager;
/// What physics tells the rules, each against a shot made for it.
mod facts;
/// What a picture shows of a haptic device.
mod felt;
/// The last shot, seen again.
mod film;
/// Closest points by brute force, to measure meshes with.
mod geometry;
/// What a hand feels.
mod haptic;
/// A person at mouse and keyboard, from raw reports to whole games.
mod input;
/// What hands lay down: racks set up anew, shots taken back.
mod lies;
/// Menus, and whole games from the main menu and back.
mod menu;
/// The panel of the runtime.
mod meters;
/// Minigolf: another ground, ball and tip.
mod minigolf;
/// The stepper: accounts, motion, convergence, extremes, the paper's faults, same bits.
mod physics;
/// The laws that a scene chooses.
mod physics_laws;
/// How pictures are drawn: options, presets, levels of detail, eyes, films.
mod picture;
/// What follows from a verdict in the pool games.
mod pool_rules;
/// Racks: order of the balls, gaps, spotting.
mod rack;
/// Where in a picture lies what moves.
mod reach;
/// What a picture shows.
mod renderer;
/// The report: closed forms, orders, who is best, what breaks.
mod report;
/// The room round a table, and the light in it.
mod room;
/// The referee, the rule console and the scenarios of the paper's eight-ball.
mod rules;
/// Scene files: what is wrong in them is said in one exact line.
mod scene;
/// Tables and balls of right scenes.
mod scene_built;
/// Snooker: its spots, what can be seen, its table, and what follows from choices.
mod snooker;
/// What is heard.
mod sound;
/// Tables: dimensions measured back from the vertices, closed body, pockets.
mod table;
/// What a player tells of its thoughts, and how it is drawn.
mod thoughts;
/// What the clock leaves out and what it must not.
mod tick;
/// The shape of the repository.
mod tidy;
/// Training: shots taken back, balls put anywhere.
mod training;
/// Cases with known answers, and catalogues of others.
mod validation;
