//! Who takes part: a game's cores, made from its scene and nothing else.
//!
//! Lockstep runs a cast inline; the actor runtime gives each member an actor. What the scene does
//! not name is not made.

use crate::ai::{Player, PlayerSettings};
use crate::events::Source;
use crate::ids::PlayerId;
use crate::input::Human;
use crate::physics::{PhysicsError, Simulation};
use crate::rules::{Referee, UnknownGame};
use crate::scene::{PlayerKind, Scene, SceneError};
use crate::table::Table;
use crate::tick::Participant;
use std::sync::Arc;

/// The cores of one game.
pub struct Cast {
    /// What everybody plays on.
    pub table: Arc<Table>,
    /// The simulation.
    pub simulation: Simulation,
    /// The referee, if the scene has rules.
    pub referee: Option<Referee>,
    /// The computer players.
    pub players: Vec<Player>,
    /// The hand at mouse and keyboard, if the scene has input and nobody stands in for it.
    pub human: Option<Human>,
    /// Names of player 1 and player 2.
    pub names: Vec<String>,
}

/// Why a cast cannot be put together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CastError {
    /// The scene does not fit together.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The simulation refuses its start.
    #[error(transparent)]
    Physics(#[from] PhysicsError),
    /// The rules are not known.
    #[error(transparent)]
    Game(#[from] UnknownGame),
    /// Computer players need a billiard table.
    #[error("{player} is a computer player and needs a table with pockets; add [table]")]
    NoTable {
        /// Who.
        player: String,
    },
}

/// A seed for one part of a game, so that parts do not share their randomness.
///
/// SplitMix64 (Steele, Lea and Flood 2014) over seed and part.
pub fn seed_of(seed: u64, part: u64) -> u64 {
    let mut z = seed.wrapping_add(part.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

impl Cast {
    /// Makes the cores that `scene` names. `load` hands over the text of the mesh files it names.
    ///
    /// # Errors
    /// [`CastError`] if the parts of the scene do not fit together.
    pub fn new(
        scene: &Scene,
        load: &mut dyn FnMut(&str) -> Result<String, String>,
    ) -> Result<Self, CastError> {
        let seed = scene.about.seed;
        let table = Arc::new(scene.build_table(load)?);
        let balls = scene.build_balls(&table)?;
        let simulation = Simulation::from_parts(table.clone(), balls, &scene.physics)?;
        let referee = match &scene.rules {
            Some(rules) => Some(Referee::new(rules.game.parse()?, simulation.ball_ids())),
            None => None,
        };
        let mut players = Vec::new();
        for (section, id) in scene.players.iter().zip([PlayerId::ONE, PlayerId::TWO]) {
            if section.kind != PlayerKind::Paper {
                continue;
            }
            let Some(bed) = table.bed else {
                return Err(CastError::NoTable { player: section.name.clone() });
            };
            let settings = PlayerSettings::for_scene(
                section,
                scene.physics.profile,
                seed_of(seed, u64::from(id.0)),
            );
            players.push(Player::new(id, settings, bed, table.clone()));
        }
        let stands_in = scene.actors.as_ref().is_some_and(|actors| actors.input.is_some());
        let human = (scene.input.is_some() && !stands_in).then(|| {
            let humans = scene.human_players();
            Human::new(humans, table.clone())
        });
        let names = scene.players.iter().map(|section| section.name.clone()).collect();
        Ok(Cast { table, simulation, referee, players, human, names })
    }

    /// The participants' names, in the order in which they are registered.
    pub fn sources(&self) -> Vec<Source> {
        let referee = self.referee.iter().map(|_| Source::Rules);
        referee.chain(self.players.iter().map(Participant::source)).collect()
    }
}
