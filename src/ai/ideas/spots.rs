//! Ball in hand: places from which a shot is easy.

use super::chance::cue_ball_sigma_rad;
use super::mouth::entries;
use super::opening::breaks;
use super::pot::{pot, pots};
use super::{Idea, Position};
use crate::ai::geometry::turned;
use crate::ai::noise::StrokeNoise;
use crate::ai::place::{random_spot, zone_holds};
use crate::ai::plan::Goal;
use crate::ai::view::TableView2d;
use crate::events::{ShotKind, Zone};
use glam::{DVec2, dvec2};
use rand::Rng;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// How many are handed out at most.
pub const SPOTS: usize = 24;
/// How many of them at most for one ball and pocket.
const SPOTS_ALIKE: usize = 5;
/// Spots that are nearer to each other are one [m].
const APART_M: f64 = 0.02;
/// Distances behind the ghost [m].
const BEHIND_M: [f64; 5] = [0.12, 0.2, 0.35, 0.55, 0.9];
/// Angles off the pocket line [rad]: small cuts, to send the cue ball to either side.
const BESIDE_RAD: [f64; 9] = [
    0.0,
    6.0 * DEGREE,
    -6.0 * DEGREE,
    14.0 * DEGREE,
    -14.0 * DEGREE,
    25.0 * DEGREE,
    -25.0 * DEGREE,
    38.0 * DEGREE,
    -38.0 * DEGREE,
];
/// Random spots that fill up what the balls leave open.
const RANDOM_SPOTS: usize = 12;
/// Break: distances behind the line over the zone's depth, and beside its middle over half its
/// width.
const BREAK_BEHIND: [f64; 2] = [0.03, 0.35];
/// See [`BREAK_BEHIND`].
const BREAK_BESIDE: [f64; 11] = [0.0, 0.2, -0.2, 0.4, -0.4, 0.55, -0.55, 0.7, -0.7, 0.85, -0.85];

/// Places for the cue ball, the best estimated chance of a pot (or of a break) first.
///
/// At most 24; all lie in `zone` and touch nothing. Empty only if the zone is so full that no place
/// was found.
pub fn spots(
    view: &TableView2d,
    zone: Zone,
    goal: &Goal,
    noise: &StrokeNoise,
    rng: &mut impl Rng,
) -> Vec<DVec2> {
    let sigma_rad = cue_ball_sigma_rad(noise, view.ball_radius_m);
    let position = Position { view, cue: DVec2::ZERO, goal, sigma_rad };
    let allowed = |spot: DVec2| zone_holds(zone, &view.bed, spot) && view.has_room(spot);

    let mut found = if goal.shot == ShotKind::Break {
        break_spots(&position, zone, allowed)
    } else {
        behind_balls(&position, allowed)
    };
    for _ in 0..RANDOM_SPOTS {
        let Some(spot) = random_spot(view, zone, rng) else { break };
        found.push((best_chance(&position, spot), spot));
    }
    // Stable: equal chances stay in the order in which they were found.
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut spots: Vec<DVec2> = Vec::new();
    for (_, spot) in found {
        if spots.len() < SPOTS && spots.iter().all(|other| other.distance(spot) > APART_M) {
            spots.push(spot);
        }
    }
    spots
}

/// The best that can be done from a spot.
fn best_chance(position: &Position<'_>, spot: DVec2) -> f64 {
    let position = Position { cue: spot, ..*position };
    let mut found: Vec<Idea> = Vec::new();
    if position.goal.shot == ShotKind::Break {
        breaks(&position, &mut found);
    } else {
        pots(&position, &mut found);
    }
    found.iter().map(|idea| idea.chance).fold(0.0, f64::max)
}

/// Behind own balls that have a free way to a pocket, the best few of each pair, with their chance.
fn behind_balls(position: &Position<'_>, allowed: impl Fn(DVec2) -> bool) -> Vec<(f64, DVec2)> {
    let mut found = Vec::new();
    for (ball, at) in position.lying(&position.goal.own) {
        for pocket in &position.view.pockets {
            for entry in entries(position, at, pocket, &[ball]) {
                let ghost = at - 2.0 * position.radius() * entry.way;
                let chance = |spot: DVec2| {
                    let position = Position { cue: spot, ..*position };
                    pot(&position, ball, at, pocket.id, &entry).map(|shot| shot.chance)
                };
                // One of each angle, so that the cue ball can be sent to all sides.
                let mut alike: Vec<_> = BESIDE_RAD
                    .into_iter()
                    .filter_map(|angle| {
                        BEHIND_M
                            .into_iter()
                            .map(|behind| ghost - turned(entry.way, angle) * behind)
                            .filter(|spot| allowed(*spot))
                            .filter_map(|spot| Some((chance(spot)?, spot)))
                            .reduce(|best, next| if next.0 > best.0 { next } else { best })
                    })
                    .collect();
                alike.sort_by(|a, b| b.0.total_cmp(&a.0));
                alike.truncate(SPOTS_ALIKE);
                found.append(&mut alike);
            }
        }
    }
    found
}

/// Across the kitchen or the D.
fn break_spots(
    position: &Position<'_>,
    zone: Zone,
    allowed: impl Fn(DVec2) -> bool,
) -> Vec<(f64, DVec2)> {
    let bed = &position.view.bed;
    let (line_x, depth_m, half_m) = match zone {
        Zone::D => (bed.baulk_line_x(), bed.d_radius_m(), bed.d_radius_m()),
        Zone::Anywhere | Zone::Kitchen => {
            let line_x = bed.head_string_x();
            (line_x, line_x + 0.5 * bed.length_m, 0.5 * bed.width_m)
        }
    };
    BREAK_BEHIND
        .into_iter()
        .flat_map(|behind| {
            BREAK_BESIDE.map(|beside| dvec2(line_x - behind * depth_m, beside * half_m))
        })
        .filter(|spot| allowed(*spot))
        .map(|spot| (best_chance(position, spot), spot))
        .collect()
}
