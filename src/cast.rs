//! Who takes part: a game's cores, made from its scene and nothing else.
//!
//! Lockstep runs a cast inline; the actor runtime gives each member an actor. What the scene does
//! not name is not made.

mod computer;

use crate::ai::{Adviser, Player};
use crate::ball::POOL_RADIUS_M;
use crate::ids::BallId;
use crate::input::Human;
use crate::physics::{PhysicsError, Simulation};
use crate::rack::Sight;
use crate::rules::{Referee, game};
use crate::scene::{Scene, SceneError};
use crate::table::Table;
use computer::{Surroundings, computers};
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
    /// Who tells that person what to play.
    pub adviser: Option<Adviser>,
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
    /// Computer players need a billiard table.
    #[error("{player} is a computer player and needs a table; add [table]")]
    NoTable {
        /// Who.
        player: String,
    },
    /// The paper's player needs pockets.
    #[error(
        "{player} is the paper's player, who aims at pockets, and this table has none; choose \
         club, champion or a strength"
    )]
    NoPockets {
        /// Who.
        player: String,
    },
}

impl Cast {
    /// Makes the cores that `scene` names, on a table that [`Scene::build_table`] made.
    ///
    /// # Errors
    /// [`CastError`] if the parts of the scene do not fit together.
    pub fn new(scene: &Scene, table: Arc<Table>) -> Result<Self, CastError> {
        let balls = scene.build_balls(&table)?;
        let cue_ball = balls.iter().find(|(ball, _)| ball.id == BallId::CUE);
        let radius_m = cue_ball.map_or(POOL_RADIUS_M, |(ball, _)| ball.radius_m);
        let parameters = scene.parameters();
        let tip_radius_m = parameters.tip_radius_m;
        let simulation =
            Simulation::with_parameters(&table, balls.clone(), &scene.physics, parameters)?
                .with_racks(scene.racks(&table));
        let played = scene.rules.map(|rules| game(rules.game));
        let is_practice = played.is_some_and(|game| game.is_practice);
        let simulation = match played {
            None => simulation,
            Some(game) if is_practice => simulation.with_memory(game.takes_back),
            Some(game) => simulation.with_object_balls_left_alone().with_memory(game.takes_back),
        };
        let knows_snookers = played.is_some_and(|game| game.knows_snookers);
        let referee = scene.rules.as_ref().map(|rules| {
            let referee = Referee::new(rules.game).first_player(rules.first_player);
            let referee = if scene.players.len() == 1 { referee.alone() } else { referee };
            match table.bed.filter(|_| knows_snookers) {
                Some(bed) => referee.with_sight(Sight { bed, spots: table.spots, radius_m }),
                None => referee,
            }
        });
        let surroundings = Surroundings {
            scene,
            table: &table,
            balls: &balls,
            simulation: &simulation,
            referee: referee.as_ref(),
            ball_radius_m: radius_m,
        };
        let players = computers(&surroundings)?;
        let human = scene.has_hand().then(|| {
            Human::new(scene.human_players(), table.clone())
                .with_ball_radius(radius_m)
                .with_tip_radius(tip_radius_m)
        });
        let tried_on = surroundings.tried_on()?;
        let human = match (human, &tried_on) {
            (Some(human), Some(simulation)) => {
                Some(human.with_foresight(surroundings.foresight(simulation.clone())))
            }
            (human, _) => human,
        };
        let adviser = tried_on.and_then(|simulation| surroundings.adviser(simulation));
        let human = human.map(|human| if is_practice { human.for_practice() } else { human });
        let names = scene.players.iter().map(|section| section.name.clone()).collect();
        Ok(Cast { table, simulation, referee, players, human, adviser, names })
    }
}
