//! Tables and balls of the catalogue. Start `n` differs a little from start 0, so that the events
//! of several starts lie elsewhere in their steps.

use super::answers;
use crate::ball::{Ball, BallFlags, BallState, POOL_RADIUS_M, Spring};
use crate::ids::{BallId, Rail};
use crate::mesh::Surface;
use crate::physics::sample_shots::{self, Start};
use crate::physics::{Contact, Parameters};
use crate::table::{Bed, Plane, Table};
use crate::units::Seconds;
use glam::{DVec2, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

pub(super) const R: f64 = POOL_RADIUS_M;
/// Restitution of the ball that bounces to rest.
const BOUNCY: f64 = 0.5;
/// Half the side of the square that holds a thousand balls [m].
const SQUARE_M: f64 = 1.7;
/// How much springs of the catalogue are damped, over critical.
const DAMPING: f64 = 0.02;

/// A pool ball.
pub(super) fn ball(id: u16, position: DVec3, velocity: DVec3, spin: DVec3) -> (Ball, BallState) {
    let state =
        BallState { velocity, angular_velocity: spin, ..BallState::at_rest(BallId(id), position) };
    (Ball::pool(BallId(id)), state)
}

/// A pool ball on the bed.
pub(super) fn on_bed(id: u16, x: f64, y: f64, v: DVec3, spin: DVec3) -> (Ball, BallState) {
    ball(id, DVec3::new(x, y, R), v, spin)
}

/// Start `n` differs by this factor.
fn factor(n: usize) -> f64 {
    1.0 + 0.0137 * n as f64
}

// Tables.

pub(super) fn cloth() -> Table {
    Table::plane()
}

pub(super) fn nothing() -> Table {
    Table::default()
}

pub(super) fn pool() -> Table {
    // The preset is shipped and tested; without it the scene has no balls and says so.
    Table::preset("pool-9ft").unwrap_or_default()
}

/// A bed between four noses: planes alone.
pub(super) fn noses() -> Table {
    let bed = Bed { length_m: 2.54, width_m: 1.27 };
    Table { bed: Some(bed), ..between(0.5 * bed.length_m, 0.5 * bed.width_m) }
}

pub(super) fn square() -> Table {
    between(SQUARE_M, SQUARE_M)
}

fn between(half_x: f64, half_y: f64) -> Table {
    // A nose at 0.635 of a ball's diameter leans over by asin(0.27).
    let sine: f64 = 2.0 * 0.635 - 1.0;
    let cosine = (1.0 - sine * sine).sqrt();
    let mut table = Table::plane();
    for (towards, far, rail) in [
        (DVec3::X, half_x, Rail::Foot),
        (DVec3::NEG_X, half_x, Rail::Head),
        (DVec3::Y, half_y, Rail::Left),
        (DVec3::NEG_Y, half_y, Rail::Right),
    ] {
        table.planes.push(Plane {
            point: towards * far + DVec3::Z * (R * (1.0 + sine)),
            normal: -towards * cosine - DVec3::Z * sine,
            surface: Surface::Cushion(rail),
        });
    }
    table
}

// Parameters.

pub(super) fn standard(_: &mut Parameters) {}

pub(super) fn without_friction(parameters: &mut Parameters) {
    parameters.cloth.friction = 0.0;
    parameters.cloth.restitution = BOUNCY;
}

/// No loss, no friction, no weight.
pub(super) fn ideal(parameters: &mut Parameters) {
    let smooth = Contact { restitution: 1.0, friction: 0.0 };
    parameters.ball = smooth;
    parameters.cloth = smooth;
    parameters.obstacle = smooth;
    parameters.rolling_resistance = 0.0;
    parameters.gravity_m_s2 = 0.0;
}

// One ball on the cloth.

fn one_ball(velocity: DVec3, spin: DVec3) -> Start {
    vec![on_bed(0, 0.0, 0.0, velocity, spin)]
}

pub(super) fn sliding(n: usize) -> Start {
    one_ball(DVec3::X * 1.5 * factor(n), DVec3::ZERO)
}

pub(super) fn draw(n: usize) -> Start {
    one_ball(DVec3::X * 1.8 * factor(n), DVec3::NEG_Y * 110.0)
}

pub(super) fn masse(n: usize) -> Start {
    one_ball(DVec3::new(1.2, 0.1, 0.0) * factor(n), DVec3::new(-90.0, -60.0, 40.0))
}

/// The closed form of all three.
pub(super) fn cloth_answer(start: &Start, law: &Parameters, t: Seconds) -> Vec<DVec3> {
    let state = &start[0].1;
    let moved = answers::on_cloth(state.velocity, state.angular_velocity, law, t);
    vec![state.position + moved]
}

// Shots of two balls between noses.

pub(super) fn cut(n: usize) -> Start {
    vec![
        on_bed(0, -0.5, 0.0, DVec3::X * 1.3 * factor(n), DVec3::Y * 20.0),
        on_bed(1, 0.0, 0.021, DVec3::ZERO, DVec3::ZERO),
    ]
}

pub(super) fn cut_and_cushion(n: usize) -> Start {
    vec![
        on_bed(0, -0.3, 0.2, DVec3::new(2.4, 0.2, 0.0) * factor(n), DVec3::new(0.0, 40.0, 30.0)),
        on_bed(1, 0.1, 0.255, DVec3::ZERO, DVec3::ZERO),
    ]
}

pub(super) fn rail_first(n: usize) -> Start {
    vec![
        on_bed(0, -0.3, 0.3, DVec3::new(1.5, 1.7, 0.0) * factor(n), DVec3::Z * 30.0),
        on_bed(1, 0.35, 0.25, DVec3::ZERO, DVec3::ZERO),
    ]
}

// Flights.

pub(super) fn jump(n: usize) -> Start {
    let (v, spin) = (DVec3::new(1.6, 0.2, 1.1) * factor(n), DVec3::new(20.0, -30.0, 10.0));
    vec![on_bed(0, -0.5, 0.0, v, spin)]
}

fn drop_m(n: usize) -> f64 {
    0.3 * factor(n)
}

pub(super) fn dropped(n: usize) -> Start {
    vec![ball(0, DVec3::Z * (R + drop_m(n)), DVec3::ZERO, DVec3::ZERO)]
}

pub(super) fn dropped_answer(start: &Start, law: &Parameters, t: Seconds) -> Vec<DVec3> {
    let height = start[0].1.position.z - R;
    vec![DVec3::Z * (R + answers::bounce(height, BOUNCY, law.gravity_m_s2, t))]
}

pub(super) fn pocket_drop(n: usize) -> Start {
    let table = pool();
    let corner = table.pockets.iter().find(|pocket| pocket.centre.min_element() > 0.3);
    let Some(pocket) = corner else { return Start::new() };
    let way: DVec2 = pocket.heading.normalize_or_zero();
    let from = pocket.target() - 0.4 * way;
    let velocity = (1.2 * factor(n) * way).extend(0.0);
    vec![on_bed(0, from.x, from.y, velocity, DVec3::Z.cross(velocity) / R)]
}

// Springs.

fn sprung(n: usize, stiffness_n_m: f64) -> Start {
    let anchor_m = DVec3::new(0.1, -0.2, 1.0);
    let offset = DVec3::new(0.01, 0.02, 0.015) * factor(n);
    let (held, state) = ball(0, anchor_m + offset, DVec3::ZERO, DVec3::ZERO);
    let damping_ns_m = 2.0 * DAMPING * (stiffness_n_m * held.mass_kg).sqrt();
    let flags = BallFlags { gravity: false, ..BallFlags::default() };
    let spring = Spring { anchor_m, stiffness_n_m, damping_ns_m, ..Spring::default() };
    vec![(Ball { spring: Some(spring), flags, ..held }, state)]
}

pub(super) fn soft_spring(n: usize) -> Start {
    sprung(n, 30.0)
}

pub(super) fn spring(n: usize) -> Start {
    sprung(n, 3e3)
}

pub(super) fn stiff_spring(n: usize) -> Start {
    sprung(n, 3e5)
}

pub(super) fn spring_answer(start: &Start, _: &Parameters, t: Seconds) -> Vec<DVec3> {
    let place = |(ball, state): &(Ball, BallState)| {
        let spring = ball.spring.unwrap_or_default();
        let omega = (spring.stiffness_n_m / ball.mass_kg).sqrt();
        let offset = state.position - spring.anchor_m;
        let moved = answers::on_spring(omega, DAMPING, offset, state.velocity, t);
        spring.anchor_m + moved
    };
    start.iter().map(place).collect()
}

// Many balls.

pub(super) fn cradle(n: usize) -> Start {
    let place = |id: u16| f64::from(id) * (2.0 * R + 0.005) + if id == 0 { -0.2 } else { 0.0 };
    let speed = 1.0 * factor(n);
    let velocity = |id: u16| if id == 0 { DVec3::X * speed } else { DVec3::ZERO };
    (0..5).map(|id| ball(id, DVec3::X * place(id), velocity(id), DVec3::ZERO)).collect()
}

pub(super) fn cradle_answer(start: &Start, _: &Parameters, t: Seconds) -> Vec<DVec3> {
    let places: Vec<f64> = start.iter().map(|(_, state)| state.position.x).collect();
    let speeds: Vec<f64> = start.iter().map(|(_, state)| state.velocity.x).collect();
    let ends = answers::in_line(&places, &speeds, 2.0 * R, t);
    ends.into_iter().map(|x| DVec3::X * x).collect()
}

pub(super) fn racked(n: usize) -> Start {
    let mut random = Pcg64Mcg::seed_from_u64(n as u64);
    sample_shots::break_shot(&noses(), &mut random).unwrap_or_default()
}

pub(super) fn thousand(n: usize) -> Start {
    let mut random = Pcg64Mcg::seed_from_u64(1000 + n as u64);
    let mut one = || random.random_range(-1.0..1.0);
    let place = |k: u16| 0.1 * (f64::from(k) - 15.5);
    (0..1000_u16)
        .map(|id| {
            let (x, y) = (place(id % 32), place(id / 32));
            let velocity = DVec3::new(one(), one(), 0.0);
            on_bed(id, x + 0.01 * one(), y + 0.01 * one(), velocity, DVec3::ZERO)
        })
        .collect()
}
