//! Ball in hand: where to put the cue ball.

use super::geometry::turned;
use super::plan::{self, Candidate, Goal};
use super::view::TableView2d;
use crate::events::{ShotKind, Zone};
use crate::table::Bed;
use glam::DVec2;
use rand::{Rng, RngExt};

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Spots that are drawn at random, besides those behind the balls.
const RANDOM_SPOTS: usize = 40;
/// Draws until a random spot is given up.
const DRAWS: usize = 200;
/// Distances behind the ghost at which the cue ball is tried [m].
const BEHIND_M: [f64; 4] = [0.12, 0.25, 0.45, 0.8];
/// Angles off the pocket line at which it is tried [rad]: a small cut keeps the cue ball out of
/// the pocket.
const BESIDE_RAD: [f64; 5] = [8.0 * DEGREE, -8.0 * DEGREE, 0.0, 25.0 * DEGREE, -25.0 * DEGREE];
/// How many spots are handed out, best first.
const SPOTS: usize = 8;

/// Whether a ball's middle at `position` lies in `zone`.
pub fn zone_holds(zone: Zone, bed: &Bed, position: DVec2) -> bool {
    match zone {
        Zone::Anywhere => true,
        Zone::Kitchen => position.x < bed.head_string_x(),
        Zone::D => bed.in_zone(Zone::D, position),
    }
}

/// Spots for the cue ball, best first: those with the cheapest open pot, then any with room.
///
/// All lie in `zone` and touch nothing. Empty only if the zone is so full that no draw found room.
pub fn placements(
    view: &TableView2d,
    zone: Zone,
    goal: &Goal,
    throw_factor: f64,
    rng: &mut impl Rng,
) -> Vec<DVec2> {
    let allowed = |spot: &DVec2| zone_holds(zone, &view.bed, *spot) && view.has_room(*spot);
    if goal.shot == ShotKind::Break {
        return (0..SPOTS).filter_map(|_| break_spot(view, zone, rng)).collect();
    }

    let mut spots: Vec<(f64, DVec2)> = behind_balls(view, goal, throw_factor)
        .filter(|(_, spot)| allowed(spot))
        .filter_map(|(shot, spot)| Some((pot_cost(view, &shot, spot, throw_factor)?, spot)))
        .collect();
    for _ in 0..RANDOM_SPOTS {
        let Some(spot) = random_spot(view, zone, rng) else { break };
        let pot = plan::best_pot(view, spot, &goal.own, throw_factor);
        spots.push((pot.map_or(f64::INFINITY, |shot| shot.cost), spot));
    }
    // Stable: equal costs stay in the order in which they were found.
    spots.sort_by(|a, b| a.0.total_cmp(&b.0));
    spots.truncate(SPOTS);
    spots.into_iter().map(|(_, spot)| spot).collect()
}

/// Places from which an own ball goes almost straight into a pocket with a free way.
fn behind_balls<'a>(
    view: &'a TableView2d,
    goal: &'a Goal,
    throw_factor: f64,
) -> impl Iterator<Item = (Candidate, DVec2)> + 'a {
    let pairs =
        goal.own.iter().flat_map(|ball| view.pockets.iter().map(move |pocket| (*ball, pocket)));
    pairs
        .filter_map(move |(ball, pocket)| {
            let position = view.position(ball)?;
            let way = (pocket.target() - position).try_normalize()?;
            let behind = position - way * (3.0 * view.ball_radius_m);
            let shot = plan::candidate(view, behind, ball, pocket, throw_factor)?;
            plan::pocket_is_free(view, &shot).then_some((shot, way))
        })
        .flat_map(|(shot, way)| {
            BESIDE_RAD.into_iter().flat_map(move |angle| {
                BEHIND_M.into_iter().map(move |d| (shot, shot.ghost - turned(way, angle) * d))
            })
        })
}

/// What the same ball and pocket cost from `spot`, if the shot is open from there.
fn pot_cost(view: &TableView2d, shot: &Candidate, spot: DVec2, throw_factor: f64) -> Option<f64> {
    let pocket = view.pockets.iter().find(|pocket| pocket.id == shot.pocket)?;
    let shot = plan::candidate(view, spot, shot.ball, pocket, throw_factor)?;
    plan::is_open(view, spot, &shot).then_some(shot.cost)
}

/// Somewhere in the kitchen near the head string, not too far from the middle.
fn break_spot(view: &TableView2d, zone: Zone, rng: &mut impl Rng) -> Option<DVec2> {
    let bed = &view.bed;
    (0..DRAWS)
        .map(|_| {
            let behind = rng.random_range(0.005..0.06) * bed.length_m;
            let beside = rng.random_range(-0.3..0.3) * bed.width_m;
            DVec2::new(bed.head_string_x() - behind, beside)
        })
        .find(|spot| zone_holds(zone, bed, *spot) && view.has_room(*spot))
        .or_else(|| random_spot(view, zone, rng))
}

/// A spot with room, evenly drawn from the zone.
pub(super) fn random_spot(view: &TableView2d, zone: Zone, rng: &mut impl Rng) -> Option<DVec2> {
    let bed = &view.bed;
    let half = bed.half();
    let foot_end = match zone {
        Zone::Anywhere => half.x,
        Zone::Kitchen => bed.head_string_x(),
        Zone::D => bed.baulk_line_x(),
    };
    if half.y <= 0.0 || foot_end <= -half.x {
        return None;
    }
    (0..DRAWS)
        .map(|_| DVec2::new(rng.random_range(-half.x..foot_end), rng.random_range(-half.y..half.y)))
        .find(|spot| zone_holds(zone, bed, *spot) && view.has_room(*spot))
}
