//! What a command line may change about a scene; a recording keeps it beside the scene's text.

use super::{Entrant, RackKind, Scene};
use crate::ids::{GameKind, PlayerId};
use crate::one_line::one_line;
use serde::{Deserialize, Serialize};

/// The longest name of a player that a recording gives [characters].
const NAME_MAX: usize = 100;

/// Changes to a scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Overrides {
    /// What is played, with the rack of that game.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub game: Option<GameKind>,
    /// Fixes everything random.
    pub seed: Option<u64>,
    /// Who breaks.
    pub first_player: Option<PlayerId>,
    /// Who plays, from player 1 on; empty: the scene's own.
    pub players: Vec<Entrant>,
    /// What they are called, from player 1 on; empty: as in the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
    /// Noise of all computers' strokes, in multiples of the Computer Pool Olympiad's, unless a
    /// player has one of its own.
    pub noise: Option<f64>,
}

impl Overrides {
    /// Changes `scene`.
    pub fn apply(&self, scene: &mut Scene) {
        if let (Some(game), Some(rules)) = (self.game, &mut scene.rules) {
            rules.game = game;
            let rack = game.rack().and_then(RackKind::named);
            if let (Some(rack), Some(balls)) = (rack, &mut scene.balls) {
                balls.rack = rack;
            }
        }
        if let Some(seed) = self.seed {
            scene.about.seed = seed;
        }
        if let (Some(first), Some(rules)) = (self.first_player, &mut scene.rules) {
            rules.first_player = first;
        }
        if let Some(noise) = self.noise {
            scene.players.iter_mut().for_each(|section| section.noise = Some(noise));
        }
        for (section, entrant) in scene.players.iter_mut().zip(&self.players) {
            entrant.apply(section);
        }
        for (section, name) in scene.players.iter_mut().zip(&self.names) {
            section.name = one_line(name, NAME_MAX);
        }
    }
}
