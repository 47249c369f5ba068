//! What the computer players take to decide, and whether they win.

use hapticbillard::hash::seed_of;
use hapticbillard::ids::PlayerId;
use hapticbillard::scene::Overrides;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{Headless, Stage, play_headless};
use hapticbillard_actors::stopwatch::Stopwatch;

/// The scene in which two computers play.
const SCENE: &str = "eight_ball_headless";

/// Games of the paper's player against itself.
#[derive(Debug, Default)]
pub struct Players {
    /// How many games.
    pub games: u32,
    /// Games that each of both won.
    pub wins: [u32; 2],
    /// Shots of both.
    pub shots: u32,
    /// Fouls of both.
    pub fouls: u32,
    /// Processor time of a decision, mean over the games [ms].
    pub decision_ms: f64,
}

/// Plays `games` games.
pub fn measure(games: u32) -> Result<Players, Error> {
    let loaded = load_scene(SCENE)?;
    let stage = Stage::new(&loaded, SCENE)?;
    let mut players = Players { games, ..Players::default() };
    for game in 0..games {
        let overrides = Overrides {
            game: None,
            seed: Some(seed_of(stage.scene.about.seed, u64::from(game))),
            first_player: Some(PlayerId(1 + (game % 2) as u8)),
            ..Overrides::default()
        };
        let stopwatch = Stopwatch::default();
        let how = Headless { stopwatch: Some(stopwatch.clone()), ..Headless::default() };
        let (_, tally) = play_headless(&stage.with(overrides), how)?;
        if let Some(winner) = tally.winner {
            players.wins[winner.index()] += 1;
        }
        players.shots += tally.shots.iter().sum::<u32>();
        players.fouls += tally.fouls.iter().sum::<u32>();
        let decision_ms = stopwatch.cpu_ms_per_decision().unwrap_or(0.0);
        players.decision_ms += decision_ms / f64::from(games.max(1));
    }
    Ok(players)
}
