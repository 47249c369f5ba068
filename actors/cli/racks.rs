//! Racks between two computer players, as `match` and `tournament` play them.

use super::Driver;
use hapticbillard::hash::seed_of;
use hapticbillard::ids::{GameKind, PlayerId};
use hapticbillard::rules;
use hapticbillard::scene::{Entrant, Overrides};
use hapticbillard::tally::Tally;
use hapticbillard::tick::Finished;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{Headless, Stage, play_headless};
use hapticbillard_actors::stopwatch::{Stopwatch, Took};
use std::path::PathBuf;
use std::time::Instant;

/// A scene with rules and two players, for the game that is asked for.
///
/// # Errors
/// The scene is wrong, or two computers cannot play it to an end.
pub fn stage(scene: &str, game: Option<GameKind>) -> Result<Stage, Error> {
    let stage = Stage::new(&load_scene(scene)?, scene)?.for_game(game)?;
    let what = format!("--scene {scene}");
    if stage.scene.rules.is_none() || stage.scene.players.len() != 2 {
        let fix = "choose a scene with [rules] and two [[player]], such as eight_ball_headless";
        return Err(Error::input(what, "a match needs rules and two players", fix));
    }
    if let Some(rules) = stage.scene.rules
        && rules::game(rules.game).is_practice
    {
        let what = format!("{what} --game {}", rules.game);
        return Err(Error::input(what, "this game never ends", "play it in a window with `play`"));
    }
    Ok(stage)
}

/// How two players play rack after rack.
pub struct Racks<'a> {
    /// The scene.
    pub stage: &'a Stage,
    /// The game in place of the scene's.
    pub game: Option<GameKind>,
    /// Fixes everything random.
    pub seed: u64,
    /// Who plays; empty: the scene's own.
    pub players: Vec<Entrant>,
    /// Noise of all who have none of their own.
    pub noise: Option<f64>,
    /// The runtime.
    pub driver: Driver,
    /// Where racks are recorded.
    pub record: Option<PathBuf>,
    /// Decisions are timed.
    pub is_timed: bool,
}

/// A rack that was played.
pub struct Rack {
    /// How it ended.
    pub finished: Finished,
    /// What it came to.
    pub tally: Tally,
    /// How long player 1's and player 2's decisions took, if they were timed.
    pub decisions: [Vec<Took>; 2],
    /// Processor time per decision [ms], if they were timed.
    pub cpu_ms_per_decision: Option<f64>,
    /// How long it took [ms].
    pub wall_ms: f64,
}

impl Racks<'_> {
    /// The scene with these players.
    fn stage_for(&self, rack: u32) -> Stage {
        self.stage.with(Overrides {
            game: self.game,
            seed: Some(seed_of(self.seed, u64::from(rack))),
            // They break in turn.
            first_player: Some(PlayerId(1 + (rack % 2) as u8)),
            players: self.players.clone(),
            noise: self.noise,
            ..Overrides::default()
        })
    }

    /// Whether two computers play.
    ///
    /// # Errors
    /// A person, or a recording, plays in the scene.
    pub fn check(&self) -> Result<(), Error> {
        let players = &self.stage_for(0).scene.players;
        if players.iter().all(|player| player.kind.is_computer()) {
            return Ok(());
        }
        let fix = "add --players paper,paper, or play it in a window with `play`";
        Err(Error::input("--scene", "a person plays in this scene", fix))
    }

    /// Plays the rack of this number, counted from 0. Player 1 breaks in the even ones.
    ///
    /// # Errors
    /// It cannot begin, go on, or be recorded.
    pub fn play(&self, rack: u32) -> Result<Rack, Error> {
        let file = format!("game_{:04}.jsonl", rack + 1);
        let record = self.record.as_ref().map(|folder| folder.join(file));
        let stopwatch = self.is_timed.then(Stopwatch::default);
        let driver = self.driver.into();
        let how = Headless { driver, record, stopwatch: stopwatch.clone(), ..Headless::default() };
        let start = Instant::now();
        let (finished, tally) = play_headless(&self.stage_for(rack), how)?;
        let wall_ms = start.elapsed().as_secs_f64() * 1e3;
        let cpu_ms_per_decision = stopwatch.as_ref().and_then(Stopwatch::cpu_ms_per_decision);
        let decisions = stopwatch.map(|watch| watch.decisions()).unwrap_or_default();
        Ok(Rack { finished, tally, decisions, cpu_ms_per_decision, wall_ms })
    }
}
