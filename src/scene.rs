//! Scenes: what exists in a game.
