//! What a position is worth: the chance that whoever is called wins from there.

use super::race::Prospects;
use super::world::{Played, World};
use super::{Mind, choosing};
use crate::ai::ideas::{Idea, IdeaKind, Repertoire, ideas, shut_in};
use crate::ai::plan::Goal;
use crate::ai::settings::Level;
use crate::events::{BallInHand, ShotKind, TurnAfter, Zone};
use crate::ids::{BallId, GameKind, PlayerId};

/// Chance of a ball from anywhere on the bed.
const IN_HAND: f64 = 0.95;
/// The same from behind the head string, or out of the D.
const IN_KITCHEN: f64 = 0.75;
/// How much likelier than by a break a ball falls from an average position.
const BREAK: f64 = 0.55;

/// Chance that `player` wins after a shot.
pub fn after(mind: &Mind, player: PlayerId, played: &mut Played) -> f64 {
    if played.verdict.turn == TurnAfter::End {
        return match played.verdict.winner {
            Some(winner) => f64::from(u8::from(winner == player)),
            None => 0.5,
        };
    }
    let Some(world) = next(mind, played) else { return 0.5 };
    seen_by(player, &world, position(mind, &world, None))
}

/// The chance of `player` if that of whoever is at the table is `value`.
pub fn seen_by(player: PlayerId, world: &World, value: f64) -> f64 {
    if world.player() == player { value } else { 1.0 - value }
}

/// The position after a shot, if the game goes on.
fn next(mind: &Mind, played: &mut Played) -> Option<World> {
    let turn = played.turn.clone()?;
    let lies = played.lies();
    World::new(mind, &lies, played.referee.clone(), turn).ok()
}

/// What the next ball of whoever is at the table decides.
pub fn prospects(mind: &Mind, world: &World) -> Prospects {
    let state = world.referee().state();
    // The club's player only counts balls.
    let shut_in = match mind.level {
        Level::Champion => shut_in_of_groups(mind, world),
        Level::Club | Level::Paper => [0.0; 2],
    };
    mind.races.prospects(state, shut_in)
}

/// How many balls of the shooter and of the other are shut in, where each has a group; with the 8,
/// as it will lie when the group is gone.
fn shut_in_of_groups(mind: &Mind, world: &World) -> [f64; 2] {
    let state = world.referee().state();
    [state.player, state.player.other()].map(|player| {
        let Some(group) = state.groups.and_then(|groups| groups.of(player)) else { return 0.0 };
        let own: Vec<BallId> = group.among(&state.on_table).collect();
        // Of the last ball the position itself tells.
        if own.is_empty() {
            return 0.0;
        }
        let count =
            |balls: &[BallId], gone: &[BallId]| shut_in(&world.view, &mind.noise, balls, gone);
        count(&own, &[]) + count(&[BallId::EIGHT], &own)
    })
}

/// Chance that whoever is at the table wins, as far as geometry can tell.
pub fn position(mind: &Mind, world: &World, played_from: Option<Zone>) -> f64 {
    if !world.turn.options.is_empty() {
        return choosing::best(mind, world).map_or(0.5, |(_, value)| value);
    }
    let prospects = prospects(mind, world);
    if world.turn.shot == ShotKind::Break {
        return prospects.of_pot(BREAK * mind.races.pot);
    }
    // A cue ball that lies may still be taken in hand, unless this very player put it there.
    let is_in_hand = world.turn.ball_in_hand != BallInHand::None && played_from.is_none();
    let Some(cue) = world.view.cue_ball.filter(|_| !is_in_hand) else {
        return prospects.of_pot(match world.turn.ball_in_hand {
            BallInHand::Kitchen | BallInHand::D => IN_KITCHEN * mind.races.pot,
            BallInHand::Anywhere | BallInHand::None => IN_HAND.min(1.05 * mind.races.pot),
        });
    };
    if matches!(mind.game, GameKind::FreeCarom | GameKind::ThreeCushion) {
        return prospects.of_pot(carom(mind, world));
    }
    let goal = Goal::of(&world.turn, &world.view, played_from);
    let ideas = ideas(&world.view, cue, &goal, &mind.noise, Repertoire::Plain);
    of_ideas(&ideas, &prospects)
}

/// The better of the easiest pot and of a safety.
fn of_ideas(ideas: &[Idea], prospects: &Prospects) -> f64 {
    let best = |is_wanted: &dyn Fn(&Idea) -> bool| {
        ideas.iter().filter(|idea| is_wanted(idea)).map(|idea| idea.chance).fold(0.0, f64::max)
    };
    let pot = best(&|idea| idea.pocket.is_some());
    let contact = best(&|idea| idea.kind != IdeaKind::Desperate);
    prospects.of_pot(pot).max(prospects.of_contact(contact))
}

/// Chance of a carom: the closer the balls lie together the better, where a gathered lie lasts.
fn carom(mind: &Mind, world: &World) -> f64 {
    let pot = mind.races.pot;
    if mind.game == GameKind::ThreeCushion {
        return pot;
    }
    let Some(cue) = world.view.cue_ball else { return pot };
    let spread = world.view.balls.iter().map(|ball| ball.position.distance(cue));
    let nearness = libm::exp(-spread.fold(0.0, f64::max));
    pot * (0.7 + 0.5 * nearness)
}
