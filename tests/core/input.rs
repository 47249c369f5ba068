//! A person at mouse and keyboard, from raw reports to the game.

mod desk;

mod stroke;
