//! A break of a thousand balls: the most that a scene of ours lets happen at once.

use glam::DVec3;
use hapticbillard::ball::{Ball, BallState, Motion, POOL_RADIUS_M};
use hapticbillard::ids::{BallId, Rail};
use hapticbillard::mesh::Surface;
use hapticbillard::physics::{PhysicsSettings, Simulation};
use hapticbillard::table::{Plane, Table};
use hapticbillard::tick;
use hapticbillard::units::Tick;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Rows of the triangle: 990 balls, and the cue ball.
const ROWS: u16 = 44;
/// Speed of the cue ball [m/s]: a hard break.
const SPEED_M_S: f64 = 10.0;
/// Balls stand apart by so much at most [m]: as a hand racks them.
const GAP_M: f64 = 2e-4;
/// The walls are so far from the middle [m].
const WALLS_M: f64 = 2.5;

/// What a break makes.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Busiest {
    /// Facts in the busiest tick.
    pub in_a_tick: usize,
    /// Facts in the busiest second.
    pub in_a_second: usize,
}

/// A triangle of balls between four walls, and a cue ball on its way to the first of them.
pub fn rack() -> Simulation {
    let mut random = Pcg64Mcg::seed_from_u64(1000);
    let spacing = 2.0 * POOL_RADIUS_M + GAP_M;
    let first = DVec3::new(-1.1, 0.0, POOL_RADIUS_M);
    let mut balls = Vec::new();
    let mut lay = |position: DVec3, velocity: DVec3| {
        let id = BallId(balls.len() as u16);
        let mut state = BallState::at_rest(id, position);
        if velocity != DVec3::ZERO {
            (state.velocity, state.motion) = (velocity, Motion::Sliding);
        }
        balls.push((Ball::pool(id), state));
    };
    lay(first - DVec3::X * 0.5, DVec3::X * SPEED_M_S);
    for row in 0..ROWS {
        for column in 0..=row {
            let mut off = || random.random_range(-0.25..0.25) * GAP_M;
            let x = f64::from(row) * spacing * 0.75_f64.sqrt() + off();
            let y = (f64::from(column) - 0.5 * f64::from(row)) * spacing + off();
            lay(first + DVec3::new(x, y, 0.0), DVec3::ZERO);
        }
    }
    let mut table = Table::plane();
    for (towards, rail) in [
        (DVec3::X, Rail::Foot),
        (DVec3::NEG_X, Rail::Head),
        (DVec3::Y, Rail::Left),
        (DVec3::NEG_Y, Rail::Right),
    ] {
        let point = towards * WALLS_M;
        table.planes.push(Plane { point, normal: -towards, surface: Surface::Cushion(rail) });
    }
    Simulation::from_parts(&table, balls, &PhysicsSettings::default()).unwrap()
}

/// Runs it for so many ticks, and counts.
pub fn busiest(mut simulation: Simulation, ticks: u64) -> Busiest {
    let mut facts = Vec::new();
    for number in 1..=ticks {
        facts.push(tick::advance(&mut simulation, Tick(number), &[]).unwrap().facts.len());
    }
    let in_a_second = facts.windows(facts.len().min(1000)).map(|second| second.iter().sum());
    Busiest {
        in_a_tick: facts.iter().copied().max().unwrap_or_default(),
        in_a_second: in_a_second.max().unwrap_or_default(),
    }
}
