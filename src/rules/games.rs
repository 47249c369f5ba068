//! The games, one file each. How a new one is added stands in the README beside this file.

use super::game::Game;
use crate::ids::{GameKind, for_all_games};

macro_rules! games {
    ($($(#[$about:meta])* $kind:ident $id:literal $short:literal $rack:literal $file:ident;)*) => {
        $(mod $file;)*

        /// What distinguishes a game from the others.
        pub fn game(kind: GameKind) -> &'static Game {
            match kind {
                $(GameKind::$kind => &$file::GAME,)*
            }
        }
    };
}

for_all_games!(games);
