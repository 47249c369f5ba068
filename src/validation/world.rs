//! Worlds to be simulated, made from a setup.

use super::error::Trouble;
use super::setup::Setup;
use super::shapes::{BallEntry, Wall};
use crate::ball::{Ball, BallPlace, BallState, Motion, SOLID_SPHERE};
use crate::ids::{BallId, Rail};
use crate::mesh::Surface;
use crate::physics::laws::Mover;
use crate::physics::laws::speed_friction::FrictionCurve;
use crate::physics::{BallLaw, Contact, Parameters, PhysicsSettings, Simulation, SolverKind};
use crate::table::{Plane, Table};
use glam::{DQuat, DVec3};

/// What a simulation is made from.
#[derive(Clone)]
pub(super) struct World {
    pub table: Table,
    pub balls: Vec<(Ball, BallState)>,
    pub parameters: Parameters,
    pub solver: SolverKind,
}

impl World {
    /// Balls in empty space, with the coefficients of the setup; what it does not name is zero.
    pub fn new(
        setup: &Setup<'_>,
        balls: &[BallEntry],
        solver: SolverKind,
    ) -> Result<World, Trouble> {
        let slides = setup.number_or_zero("mu_slide")?;
        let wall = Contact {
            restitution: setup.number_or_zero("e_wall")?,
            friction: setup.number_or_zero("mu_wall")?,
        };
        let parameters = Parameters {
            ball: Contact {
                restitution: setup.number_or_zero("e_ball")?,
                friction: setup.number_or_zero("mu_ball")?,
            },
            cloth: Contact { friction: slides, ..wall },
            cushion: wall,
            obstacle: wall,
            wood: wall,
            pocket: wall,
            rolling_resistance: setup.number_or_zero("mu_roll")?,
            spin_deceleration_rad_s2: setup.number_or_zero("spin_decel_rad_s2")?,
            gravity_m_s2: setup.gravity()?,
            ..laws(setup)?
        };
        parameters.check()?;
        let balls = balls.iter().enumerate().map(|(i, entry)| ball(i, entry)).collect();
        Ok(World { table: Table::default(), balls, parameters, solver })
    }

    /// Adds a half space.
    pub fn plane(mut self, wall: &Wall, surface: Surface) -> Self {
        self.table.planes.push(Plane { point: wall.point_m, normal: wall.normal, surface });
        self
    }

    /// Adds the plane z = 0, covered with cloth.
    pub fn bed(self) -> Self {
        self.plane(&Wall { point_m: DVec3::ZERO, normal: DVec3::Z }, Surface::Cloth)
    }

    /// Adds walls that tell when a ball meets them.
    pub fn walls(self, walls: &[Wall]) -> Self {
        walls
            .iter()
            .zip(Rail::ALL.iter().cycle())
            .fold(self, |world, (wall, rail)| world.plane(wall, Surface::Cushion(*rail)))
    }

    /// The simulation at its start.
    pub fn simulation(&self) -> Result<Simulation, Trouble> {
        let settings = PhysicsSettings { solver: self.solver, ..PhysicsSettings::default() };
        let balls = self.balls.clone();
        let parameters = self.parameters.clone();
        Ok(Simulation::with_parameters(&self.table, balls, &settings, parameters)?)
    }

    /// Kinetic energy, and weight times height, of all balls [J].
    pub fn energy_j(&self, simulation: &Simulation) -> f64 {
        let ledger = simulation.ledger();
        ledger.kinetic_j + ledger.potential_j
    }
}

/// The contact laws that the law of the setup means for a simulation.
fn laws(setup: &Setup<'_>) -> Result<Parameters, Trouble> {
    let pool = Parameters::pool();
    match setup.law {
        "default" | "constant_friction" | "tip_then_table_in_sequence" => Ok(pool),
        "speed_dependent_friction" => Ok(Parameters {
            ball_law: BallLaw::SpeedDependent,
            ball_friction_curve: curve(setup)?,
            ..pool
        }),
        "mathavan_2014" => Ok(Parameters { ball_law: BallLaw::Mathavan2014, ..pool }),
        law => super::error::unsupported(format!("law {law} has no meaning for this kind of run")),
    }
}

/// The friction curve of the setup, or the published one.
pub(super) fn curve(setup: &Setup<'_>) -> Result<FrictionCurve, Trouble> {
    let given = setup.curve()?;
    Ok(given.map_or(FrictionCurve::ALCIATORE, |c| FrictionCurve { a: c.a, b: c.b, c_s_m: c.c_s_m }))
}

/// A ball of the list: its name in the simulation is its place, so that results come in order.
pub(super) fn ball(place: usize, entry: &BallEntry) -> (Ball, BallState) {
    let id = BallId(place as u16);
    let ball = Ball {
        radius_m: entry.radius_m,
        mass_kg: entry.m,
        inertia_factor: entry.inertia_factor.unwrap_or(SOLID_SPHERE),
        ..Ball::pool(id)
    };
    let state = BallState {
        id,
        position: entry.position_m,
        velocity: entry.velocity_m_s,
        angular_velocity: entry.angular_velocity_rad_s,
        orientation: DQuat::IDENTITY,
        motion: Motion::Rest,
        place: BallPlace::OnTable,
    };
    (ball, state)
}

/// A ball of the list as the contact laws see it.
pub(super) fn mover(entry: &BallEntry) -> Mover {
    let (ball, state) = ball(0, entry);
    Mover::new(&ball, state.velocity, state.angular_velocity)
}
