//! How easily a ball falls, wherever the cue ball will lie.

use super::Position;
use super::chance::{cue_ball_sigma_rad, gain, within};
use super::mouth::{Entry, entries};
use crate::ai::geometry::turned;
use crate::ai::noise::StrokeNoise;
use crate::ai::plan::Goal;
use crate::ai::view::TableView2d;
use crate::events::ShotKind;
use crate::ids::BallId;
use glam::DVec2;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// A usual shot: way of the cue ball to the ghost [m], and cut [rad].
const TO_GHOST_M: f64 = 0.4;
const CUT_RAD: f64 = 25.0 * DEGREE;
/// How far behind the ghost the cue ball must have room [m], and at one of which angles off the
/// line [rad].
const BEHIND_M: f64 = 0.25;
const BESIDE_RAD: [f64; 3] = [0.0, CUT_RAD, -CUT_RAD];

/// How many of these balls are shut in: each counts by how likely a usual shot into its best pocket
/// fails for a player with this noise, 1 if other balls leave no way for it or for the cue ball.
/// `gone` balls are in nobody's way.
pub fn shut_in(view: &TableView2d, noise: &StrokeNoise, balls: &[BallId], gone: &[BallId]) -> f64 {
    let sigma_rad = cue_ball_sigma_rad(noise, view.ball_radius_m);
    let goal = Goal { shot: ShotKind::Normal, own: Vec::new(), legal: Vec::new() };
    let position = Position { view, cue: DVec2::ZERO, goal: &goal, sigma_rad };
    position.lying(balls).map(|(ball, at)| 1.0 - ease(&position, ball, at, gone)).sum()
}

/// The chance of a usual shot at a ball.
fn ease(position: &Position<'_>, ball: BallId, at: DVec2, gone: &[BallId]) -> f64 {
    let ignored: Vec<BallId> = gone.iter().copied().chain([ball]).collect();
    let error_rad = position.sigma_rad * gain(TO_GHOST_M, CUT_RAD, position.radius());
    let chance = |entry: Entry| match can_be_met(position, at, entry.way, &ignored) {
        true => within(error_rad, entry.window.right, entry.window.left),
        false => 0.0,
    };
    let pockets = position.view.pockets.iter();
    let ways = pockets.flat_map(|pocket| entries(position, at, pocket, &ignored));
    ways.map(chance).fold(0.0, f64::max)
}

/// Whether there is room for the ghost, and for a cue ball that comes from somewhere behind it.
fn can_be_met(position: &Position<'_>, at: DVec2, way: DVec2, ignored: &[BallId]) -> bool {
    let has_room = |spot: DVec2| position.view.has_room_for(spot, 0.0, ignored);
    let ghost = at - 2.0 * position.radius() * way;
    has_room(ghost)
        && BESIDE_RAD.iter().any(|angle| has_room(ghost - turned(way, *angle) * BEHIND_M))
}
