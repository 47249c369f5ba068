//! Ball in hand: where the cue ball is put down.

use super::aim::{self, Touch};
use super::decision::{Decision, Deliberation, Thoughts};
use super::world::World;
use super::{Mind, Outcome, Task, Workers, trial, value};
use crate::ai::ideas::{Idea, IdeaKind, Repertoire, SPOTS, ideas, spots};
use crate::ai::plan::Goal;
use crate::ai::settings::Level;
use crate::events::{ShotKind, Zone};
use crate::hash::seed_of;
use crate::ids::GameKind;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// Ideas that are tried from each spot.
const IDEAS: usize = 3;
/// Tries of each break, at least and at most. From the best place 85 in 100 breaks pocket a ball
/// without a foul, from others 55: few tries find a lucky place, not a good one.
const BREAKS: [u32; 2] = [6, 40];
/// Breaks that the champion tries from each spot.
const BREAK_IDEAS: usize = 5;
/// Speeds over the least one.
const SPEEDS: [f64; 3] = [1.2, 1.7, 2.5];
/// Contact points upwards.
const HEIGHTS: [f64; 3] = [0.0, -0.3, 0.3];

/// Decides where in `zone` the cue ball is put down: where the best shot is to be had.
pub fn place(
    mind: &Mind,
    task: &Task,
    world: &World,
    zone: Zone,
    workers: &dyn Workers,
) -> Option<Deliberation> {
    let goal = Goal::of(&world.turn, &world.view, Some(zone));
    let mut rng = Pcg64Mcg::seed_from_u64(task.seed);
    let spots = spots(&world.view, zone, &goal, &mind.noise, &mut rng);
    let per_spot = IDEAS * SPEEDS.len() * HEIGHTS.len();
    let affordable = (mind.simulations as usize / per_spot).max(1);
    let tried = spots.len().min(affordable);
    let outcomes = workers.run(tried, &|job| {
        let Ok(world) = world.with_cue_ball(mind, zone, spots[job]) else {
            return Outcome { value: -1.0, ..Outcome::default() };
        };
        best_shot(mind, &world, zone, task.seed)
    });
    let mut order: Vec<usize> = (0..tried).collect();
    order.sort_by(|a, b| outcomes[*b].value.total_cmp(&outcomes[*a].value));
    let simulations = outcomes.iter().map(|outcome| outcome.simulations).sum();
    // What was not tried comes last, as geometry ranks it.
    let order = order.into_iter().chain(tried..spots.len());
    let decision = Decision::Place(order.map(|n| spots[n]).collect());
    Some(Deliberation { decision, thoughts: Thoughts::default(), simulations })
}

/// What a break is worth on the average: no two of them are alike.
fn broken(mind: &Mind, world: &World, idea: &Idea, seed: u64) -> Outcome {
    // Where an open table is no gain, it is opened softly.
    let speed_m_s = match mind.game {
        GameKind::Straight | GameKind::Snooker => SPEEDS[1] * idea.speed_least_m_s,
        _ => mind.break_speed_m_s(),
    };
    let touch = Touch { speed_m_s, side: 0.0, height: 0.0 };
    let Some(stroke) = aim::along(mind, world, idea, touch) else { return Outcome::default() };
    let count = breaks(mind);
    let tried = (0..count)
        .map(|n| trial::with_noise(mind, world, idea, stroke, seed_of(seed, u64::from(n))));
    let value = tried.map(|outcome| outcome.value).sum::<f64>() / f64::from(count);
    Outcome { value, simulations: count, ..Outcome::default() }
}

/// How often each break is tried.
fn breaks(mind: &Mind) -> u32 {
    let shots = (SPOTS * BREAK_IDEAS) as u32;
    match mind.level {
        Level::Champion => (mind.simulations / shots).clamp(BREAKS[0], BREAKS[1]),
        Level::Club | Level::Paper => BREAKS[0],
    }
}

/// What the best shot from here is worth.
fn best_shot(mind: &Mind, world: &World, zone: Zone, seed: u64) -> Outcome {
    let value = value::position(mind, world, Some(zone));
    let mut best = Outcome { value: 0.5 * value, ..Outcome::default() };
    let Some(cue) = world.view.cue_ball else { return best };
    let goal = Goal::of(&world.turn, &world.view, Some(zone));
    let prospects = value::prospects(mind, world);
    let ideas = ideas(&world.view, cue, &goal, &mind.noise, Repertoire::Plain);
    let mut simulations = 0;
    // Whoever has the ball in hand pots; only without any pot it matters what else there is.
    let (pots, others): (Vec<&Idea>, Vec<&Idea>) =
        ideas.iter().partition(|idea| idea.kind == IdeaKind::Pot);
    let is_break = world.turn.shot == ShotKind::Break && mind.level == Level::Champion;
    let count = if is_break { BREAK_IDEAS } else { IDEAS };
    for idea in pots.into_iter().chain(others).take(count) {
        if idea.kind == IdeaKind::Break {
            let outcome = broken(mind, world, idea, seed);
            simulations += outcome.simulations;
            best.value = best.value.max(outcome.value);
            continue;
        }
        let (worth, tried) = aim::worth(mind, world, idea, &SPEEDS, &HEIGHTS, &prospects);
        simulations += tried;
        best.value = worth.map_or(best.value, |worth| best.value.max(worth));
    }
    Outcome { simulations, ..best }
}
