//! Which game is played as which number.

use crate::cli::racks;
use hapticbillard::hash::seed_of;
use hapticbillard::ids::{GameKind, PlayerId};
use hapticbillard::scene::{Entrant, Overrides};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::Stage;

/// What is played, in turn.
const GAMES: [GameKind; 3] =
    [GameKind::PaperEightBall, GameKind::WpaEightBall, GameKind::WpaNineBall];
/// Every so many games players search, on threads of their own.
const SEARCHED: u64 = 8;
const SEARCHING: &str = "club:25";

/// The games, by their number.
pub struct Games {
    stages: Vec<Stage>,
    seed: u64,
}

impl Games {
    /// Builds their tables.
    ///
    /// # Errors
    /// A shipped scene is wrong.
    pub fn new(seed: u64) -> Result<Self, Error> {
        let stage = |game| racks::stage("eight_ball_headless", Some(game));
        let stages = GAMES.into_iter().map(stage).collect::<Result<_, _>>()?;
        Ok(Games { stages, seed })
    }

    /// A game, and the seed of everything about it.
    ///
    /// # Errors
    /// The players are wrong.
    pub fn at(&self, number: u64) -> Result<(Stage, u64), Error> {
        let seed = seed_of(self.seed, number);
        let players: Vec<Entrant> = match number % SEARCHED {
            7 => vec![searching()?; 2],
            _ => Vec::new(),
        };
        let overrides = Overrides {
            game: Some(GAMES[(number % GAMES.len() as u64) as usize]),
            seed: Some(seed),
            first_player: Some(PlayerId(1 + (number % 2) as u8)),
            players,
            ..Overrides::default()
        };
        let stage = &self.stages[(number % self.stages.len() as u64) as usize];
        Ok((stage.with(overrides), seed))
    }
}

fn searching() -> Result<Entrant, Error> {
    let wrong = |error: String| Error::input("players", error, "this is a fault of the program");
    SEARCHING.parse().map_err(|error| wrong(format!("{error}")))
}
