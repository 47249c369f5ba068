//! One shot that is tried: as it is meant, or as the player's arm would make of it.

use super::world::{Played, World};
use super::{Mind, Outcome, value};
use crate::ai::ideas::{Idea, IdeaKind};
use crate::ai::stroke::TIP_SPEED_MAX_M_S;
use crate::cue::Aim;
use crate::events::{Call, CallKind, Calls, TurnAfter};
use crate::ids::PlayerId;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// A shot that might be played.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Which of the ideas.
    pub idea: usize,
    /// How the cue is held.
    pub aim: Aim,
    /// Speed of the tip at the contact [m/s].
    pub speed_m_s: f64,
}

/// Tries a shot as it is meant.
pub fn exactly(mind: &Mind, world: &World, idea: &Idea, aim: Aim, speed_m_s: f64) -> Outcome {
    outcome(mind, world, idea, (aim, speed_m_s), (aim, speed_m_s))
}

/// Tries a shot as the player's arm makes it; the same seed errs in the same way.
pub fn with_noise(
    mind: &Mind,
    world: &World,
    idea: &Idea,
    (aim, speed_m_s): (Aim, f64),
    seed: u64,
) -> Outcome {
    let erred = erred(mind, (aim, speed_m_s), seed);
    outcome(mind, world, idea, (aim, speed_m_s), erred)
}

/// What the player's arm makes of a stroke.
pub fn erred(mind: &Mind, (aim, speed_m_s): (Aim, f64), seed: u64) -> (Aim, f64) {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let (aim, speed_m_s) = mind.noise.err(aim, speed_m_s, mind.ball_radius_m, &mut rng);
    (aim, speed_m_s.min(TIP_SPEED_MAX_M_S))
}

fn outcome(
    mind: &Mind,
    world: &World,
    idea: &Idea,
    meant: (Aim, f64),
    (aim, speed_m_s): (Aim, f64),
) -> Outcome {
    let call = call(idea, world.turn.calls);
    let bad = Outcome { aim: meant.0, speed_m_s: meant.1, simulations: 1, ..Outcome::default() };
    // A shot that cannot be simulated is not played.
    let Ok(mut played) = world.play(aim, speed_m_s, call.as_ref()) else { return bad };
    let player = world.player();
    Outcome {
        success: succeeds(world, idea, &played),
        legal: played.verdict.legal,
        value: value::after(mind, player, &mut played),
        ..bad
    }
}

/// Whether a shot did what it was meant to: the ball fell where it was called, and the player goes
/// on or has won; where nothing shall fall, it is no foul.
pub fn succeeds(world: &World, idea: &Idea, played: &Played) -> bool {
    if !played.verdict.legal {
        return false;
    }
    let player = world.player();
    let goes_on = match played.verdict.turn {
        TurnAfter::End => played.verdict.winner == Some(player),
        _ => played.verdict.next_player == Some(player),
    };
    match (idea.kind, idea.ball) {
        (IdeaKind::Break, _) => goes_on,
        (_, Some(ball)) if idea.pocket.is_some() => {
            goes_on && played.has_pocketed(ball, idea.pocket)
        }
        (IdeaKind::Carom, _) => goes_on,
        _ => goes_on_or_wins(played, player),
    }
}

/// A safety does not lose the game.
fn goes_on_or_wins(played: &Played, player: PlayerId) -> bool {
    played.verdict.turn != TurnAfter::End || played.verdict.winner == Some(player)
}

/// What is announced with an idea, as far as anything may be announced.
pub fn call(idea: &Idea, calls: Calls) -> Option<Call> {
    let first = idea.first.filter(|_| calls.ball);
    let named = idea.ball.filter(|_| calls.ball && idea.pocket.is_some());
    match (idea.kind, named) {
        (IdeaKind::Break, _) => None,
        // Without pockets to name, the ball that is met is what is named.
        _ if !calls.pocket => first.map(|ball| Call::Ball { ball, pocket: None }).or_else(|| {
            (calls.push_out && idea.pocket.is_none()).then_some(Call::Kind(CallKind::PushOut))
        }),
        (_, Some(ball)) => Some(Call::Ball { ball, pocket: idea.pocket }),
        (_, None) => calls.safety.then_some(Call::Kind(CallKind::Safety)),
    }
}
