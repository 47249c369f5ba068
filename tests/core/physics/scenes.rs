//! Scenes that several physics tests share.

use glam::DVec3;
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::events::{Fact, FactSet};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, Rail};
use hapticbillard::mesh::Surface;
use hapticbillard::physics::fixed_step::FixedStep;
use hapticbillard::physics::{
    Integrator, Parameters, PhysicsSettings, Profile, Simulation, Solver, SolverKind,
};
use hapticbillard::table::{Plane, Table};
use std::sync::OnceLock;

pub const R: f64 = 0.028575;

/// A pool ball in the given state.
pub fn ball(id: u16, position: DVec3, velocity: DVec3, spin: DVec3) -> (Ball, BallState) {
    let state =
        BallState { velocity, angular_velocity: spin, ..BallState::at_rest(BallId(id), position) };
    (Ball::pool(BallId(id)), state)
}

/// A ball on the bed.
pub fn on_bed(id: u16, x: f64, y: f64, velocity: DVec3, spin: DVec3) -> (Ball, BallState) {
    ball(id, DVec3::new(x, y, R), velocity, spin)
}

/// The default settings, solved by fixed steps.
pub fn stepping() -> PhysicsSettings {
    PhysicsSettings { solver: SolverKind::FixedStep, ..PhysicsSettings::default() }
}

/// Settings with a step.
pub fn step(step_ms: f64) -> PhysicsSettings {
    PhysicsSettings { step_ms, ..stepping() }
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

/// The stepper with cells of a size of its own.
pub fn stepper(table: &Table, balls: &[(Ball, BallState)], cell_m: f64) -> FixedStep {
    let settings = PhysicsSettings::default();
    let parameters = Parameters::of(&settings);
    FixedStep::new(table, balls.to_vec(), &settings, parameters, cell_m).unwrap()
}

/// The hash of a solver.
pub fn solver_digest(solver: &impl Solver) -> Digest {
    let mut hash = StateHash::new();
    solver.hash(&mut hash);
    hash.finish()
}

/// The 9-foot table; made once.
pub fn pool() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| Table::preset("pool-9ft").unwrap())
}

/// A bed with four noses and no pockets: planes alone, so that all shots stay on it.
pub fn between_noses() -> Table {
    // A nose at 0.635 of a ball's diameter leans over by asin(0.27).
    let sine = 2.0 * 0.635 - 1.0;
    let cosine = (1.0_f64 - sine * sine).sqrt();
    let mut table = Table::plane();
    for (towards, far, rail) in [
        (DVec3::X, 1.27, Rail::Foot),
        (DVec3::NEG_X, 1.27, Rail::Head),
        (DVec3::Y, 0.635, Rail::Left),
        (DVec3::NEG_Y, 0.635, Rail::Right),
    ] {
        table.planes.push(Plane {
            point: towards * far + DVec3::Z * (R * (1.0 + sine)),
            normal: -towards * cosine - DVec3::Z * sine,
            surface: Surface::Cushion(rail),
        });
    }
    table
}

/// Settings of the exact solver: a reference that shares no step and no search of contacts.
pub fn exact() -> PhysicsSettings {
    PhysicsSettings { solver: SolverKind::EventDriven, ..PhysicsSettings::default() }
}

/// All ways to integrate a step.
pub const INTEGRATORS: [Integrator; 4] =
    [Integrator::EulerCromer, Integrator::Verlet, Integrator::PositionVerlet, Integrator::Rk4];

/// Settings of the 2009 profile.
pub fn of_2009() -> PhysicsSettings {
    PhysicsSettings { profile: Profile::Paper2009, ..stepping() }
}

/// Whether heavy sweeps are asked for.
pub fn slow() -> bool {
    std::env::var_os("SLOW_TESTS").is_some()
}

/// The middle of some values.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Seeded numbers, evenly spread (SplitMix64).
pub struct Numbers(pub u64);

impl Numbers {
    /// The next number between two others.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A vector with components up to `size`.
    pub fn vector(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }
}

/// Balls in the quarters of the table, moving and spinning at random.
pub fn random_balls(seed: u64) -> Vec<(Ball, BallState)> {
    let mut numbers = Numbers(seed);
    let quarters = [(-0.6, -0.3), (-0.6, 0.3), (0.6, -0.3), (0.6, 0.3)];
    (0..4)
        .zip(quarters)
        .map(|(id, (x, y))| {
            let (dx, dy) = (numbers.between(-0.4, 0.4), numbers.between(-0.2, 0.2));
            let velocity = numbers.vector(4.0).with_z(0.0);
            on_bed(id, x + dx, y + dy, velocity, numbers.vector(100.0))
        })
        .collect()
}
