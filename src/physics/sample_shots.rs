//! Shots to measure on: breaks, and shots of two or three balls, drawn from a seeded generator.
//!
//! The cue ball is already on its way, so that solvers and other programs start from the same
//! numbers whatever they think of cues.

use crate::ball::{Ball, BallState, Motion, POOL_RADIUS_M};
use crate::ids::{BallId, Rail};
use crate::mesh::Surface;
use crate::rack::{Rack, RackError};
use crate::table::{Bed, Plane, Table};
use glam::{DVec2, DVec3};
use rand::{Rng, RngExt};

/// Balls, and how they move at the start.
pub type Start = Vec<(Ball, BallState)>;

/// Speeds of the cue ball in a break [m/s].
const BREAK_M_S: core::ops::Range<f64> = 8.0..10.0;
/// Speeds of the cue ball in a small shot [m/s].
const SMALL_M_S: core::ops::Range<f64> = 0.5..5.0;
/// Height of a cushion's nose over the diameter of a ball.
const NOSE: f64 = 0.635;
/// How far from straight a small shot meets its ball [°].
const CUT_DEG: f64 = 60.0;
/// How far from the middle the cue hits, over the ball's radius.
const OFFSET: f64 = 0.3;
/// Balls of a small shot keep this far from each other and from cushions, over their radius.
const ROOM: f64 = 2.5;

/// Fifteen balls racked by hand, and a cue ball without spin at 8 to 10 m/s, aimed at the first of
/// them within a millimetre.
///
/// # Errors
/// [`RackError`] if the table has no spots.
pub fn break_shot(table: &Table, random: &mut impl Rng) -> Result<Start, RackError> {
    let mut balls = Rack::eight_ball(random.next_u64()).place(table)?;
    let speed = random.random_range(BREAK_M_S);
    let aside = random.random_range(-1e-3..1e-3);
    let apex = balls[1..].iter().map(|(_, state)| state.position);
    let apex = apex.min_by(|a, b| a.x.total_cmp(&b.x)).unwrap_or(DVec3::X);
    let cue = &mut balls[0].1;
    let line = (apex + DVec3::Y * aside - cue.position).with_z(0.0).normalize_or(DVec3::X);
    cue.velocity = line * speed;
    cue.motion = Motion::Sliding;
    Ok(balls)
}

/// Two or three balls anywhere on the bed; the cue ball runs at the first of the others at 0.5 to
/// 5 m/s, cut by up to 60°, with the spin of a cue that hits up to 0.3 radii off the middle.
///
/// # Errors
/// [`RackError`] if the table has no bed.
pub fn small_shot(table: &Table, random: &mut impl Rng) -> Result<Start, RackError> {
    let bed = table.bed.ok_or_else(|| RackError::NoBed { table: table.name.clone() })?;
    let count = random.random_range(2..=3);
    let mut places: Vec<DVec2> = Vec::new();
    while places.len() < count {
        let place = anywhere(&bed, random);
        if places.iter().all(|other| other.distance(place) > ROOM * POOL_RADIUS_M) {
            places.push(place);
        }
    }
    let mut balls: Start = (0..).zip(&places).map(|(id, place)| at_rest(id, *place)).collect();

    // Through the ghost ball: where the cue ball's centre is when it meets the other.
    let cut = random.random_range(-CUT_DEG..CUT_DEG) * (core::f64::consts::PI / 180.0);
    let line = (places[1] - places[0]).normalize_or(DVec2::X);
    let (sin, cos) = libm::sincos(cut);
    let ghost = places[1] - DVec2::new(cos, sin).rotate(line) * (2.0 * POOL_RADIUS_M);
    let heading = (ghost - places[0]).normalize_or(line).extend(0.0);
    let speed = random.random_range(SMALL_M_S);
    let side = random.random_range(-OFFSET..OFFSET);
    let height = random.random_range(-OFFSET..OFFSET);
    let cue = &mut balls[0].1;
    cue.velocity = heading * speed;
    // m v b = I ω: a blow off the middle by b radii.
    let spin = speed / (crate::ball::SOLID_SPHERE * POOL_RADIUS_M);
    let across = DVec3::Z.cross(heading);
    cue.angular_velocity = across * (spin * height) + DVec3::Z * (spin * side);
    cue.motion = Motion::Sliding;
    Ok(balls)
}

/// What a planar game needs of a table: a level bed, and four cushions of which each is the plane
/// through its nose, leaning over as a nose does, so that it holds balls down. No mesh, no pockets.
pub fn planar(table: &Table) -> Table {
    let Some(bed) = table.bed else { return Table::plane() };
    // A nose at 0.635 of a ball's diameter leans over by asin(0.27).
    let sine: f64 = 2.0 * NOSE - 1.0;
    let cosine = (1.0 - sine * sine).sqrt();
    let half = DVec3::new(0.5 * bed.length_m, 0.5 * bed.width_m, 0.0);
    let height = DVec3::Z * (2.0 * NOSE * POOL_RADIUS_M);
    let mut flat = Table { name: table.name.clone(), bed: Some(bed), ..Table::plane() };
    for (towards, rail) in [
        (DVec3::X, Rail::Foot),
        (DVec3::NEG_X, Rail::Head),
        (DVec3::Y, Rail::Left),
        (DVec3::NEG_Y, Rail::Right),
    ] {
        flat.planes.push(Plane {
            point: half * towards + height,
            normal: -towards * cosine - DVec3::Z * sine,
            surface: Surface::Cushion(rail),
        });
    }
    flat
}

fn anywhere(bed: &Bed, random: &mut impl Rng) -> DVec2 {
    let room = ROOM * POOL_RADIUS_M;
    let mut along = |size: f64| {
        let reach = 0.5 * size - room;
        random.random_range(-reach..reach)
    };
    DVec2::new(along(bed.length_m), along(bed.width_m))
}

fn at_rest(id: u16, place: DVec2) -> (Ball, BallState) {
    let ball = Ball::pool(BallId(id));
    let state = BallState::at_rest(ball.id, place.extend(ball.radius_m));
    (ball, state)
}
