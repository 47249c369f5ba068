//! Scenes that several physics tests share.

use glam::{DQuat, DVec3};
use hapticbillard::ball::{Ball, BallPlace, BallState, Motion};
use hapticbillard::events::{Fact, FactSet, Topics};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Parameters, PhysicsSettings, Simulation};
use hapticbillard::table::Table;

pub const R: f64 = 0.028575;

/// A pool ball in the given state.
pub fn ball(id: u16, position: DVec3, velocity: DVec3, spin: DVec3) -> (Ball, BallState) {
    let state = BallState {
        id: BallId(id),
        position,
        velocity,
        angular_velocity: spin,
        orientation: DQuat::IDENTITY,
        motion: Motion::Rest,
        place: BallPlace::OnTable,
    };
    (Ball::pool(BallId(id)), state)
}

/// A ball on the bed.
pub fn on_bed(id: u16, x: f64, y: f64, velocity: DVec3, spin: DVec3) -> (Ball, BallState) {
    ball(id, DVec3::new(x, y, R), velocity, spin)
}

/// Settings with a step.
pub fn step(step_ms: f64) -> PhysicsSettings {
    PhysicsSettings { step_ms, ..PhysicsSettings::default() }
}

/// A world with standard parameters.
pub fn world(table: &Table, balls: &[(Ball, BallState)], settings: &PhysicsSettings) -> Simulation {
    Simulation::from_parts(table, balls.to_vec(), settings).unwrap()
}

/// A world with parameters of its own.
pub fn with(
    table: &Table,
    balls: &[(Ball, BallState)],
    settings: &PhysicsSettings,
    change: impl FnOnce(&mut Parameters),
) -> Simulation {
    let mut parameters = Parameters::of(settings);
    change(&mut parameters);
    Simulation::with_parameters(table, balls.to_vec(), settings, parameters).unwrap()
}

/// Runs to a time and returns what happened.
pub fn run(simulation: &mut Simulation, until: f64) -> Vec<Fact> {
    let mut facts = Vec::new();
    simulation.advance(until, FactSet::NONE, &mut facts).unwrap();
    facts
}

/// The state of a ball now.
pub fn state(simulation: &Simulation, id: u16) -> BallState {
    simulation.sample(BallId(id), simulation.now_s()).unwrap()
}

/// The hash of a world.
pub fn digest(simulation: &Simulation) -> Digest {
    let mut hash = StateHash::new();
    simulation.hash(&mut hash);
    hash.finish()
}

/// No fact stops.
pub const NONE: FactSet = Topics::NONE;

/// The break of the paper's figures: a tight triangle, the cue ball at 8 m/s without spin.
pub fn break_shot(gap: f64) -> Vec<(Ball, BallState)> {
    let mut balls = vec![on_bed(0, -0.635, 0.0, DVec3::X * 8.0, DVec3::ZERO)];
    let pitch = 2.0 * R + gap;
    let mut id = 1;
    for row in 0..5 {
        for place in 0..=row {
            let x = 0.635 + pitch * f64::from(row) * 0.75_f64.sqrt();
            let y = pitch * (f64::from(place) - 0.5 * f64::from(row));
            balls.push(on_bed(id, x, y, DVec3::ZERO, DVec3::ZERO));
            id += 1;
        }
    }
    balls
}
