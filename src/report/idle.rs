//! What a scene leaves out changes no bit of what it has.

use crate::ball::{Ball, BallFlags, BallState};
use crate::events::FactSet;
use crate::ids::BallId;
use crate::mesh::Surface;
use crate::physics::{Parameters, PhysicsError, PhysicsSettings, Simulation};
use crate::table::{Plane, Table};
use crate::units::Seconds;
use glam::DVec3;

/// How far away the things are put that have nothing to do [m].
const AWAY_M: f64 = 500.0;
/// How often the two worlds are compared.
const LOOKS: u32 = 40;

/// A scene beside the same with things in it that have nothing to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Idle {
    /// Numbers that were compared: places, velocities and spins at 40 times.
    pub compared: u64,
    /// Those of which a bit differs.
    pub differ: u64,
}

/// Runs a world of balls for `until_s` as it is, and again with a plane, an obstacle and a ball far
/// away, and counts the numbers of the common balls that differ in any bit.
///
/// # Errors
/// [`PhysicsError`] if a solver does not get on.
pub fn idle(
    table: &Table,
    balls: &[(Ball, BallState)],
    settings: &PhysicsSettings,
    until_s: Seconds,
) -> Result<Idle, PhysicsError> {
    let parameters = Parameters::of(settings);
    let mut alone =
        Simulation::with_parameters(table, balls.to_vec(), settings, parameters.clone())?;
    let mut more = table.clone();
    for normal in [DVec3::Z, DVec3::X] {
        let (point, surface) = (-AWAY_M * normal, Surface::Obstacle);
        more.planes.push(Plane { point, normal, surface });
    }
    let mut all = balls.to_vec();
    if let Some((ball, state)) = balls.first() {
        let id = BallId(balls.iter().map(|(ball, _)| ball.id.0).max().unwrap_or(0) + 1);
        let flags = BallFlags { gravity: false, ..BallFlags::default() };
        let (velocity, angular_velocity) = (DVec3::ZERO, DVec3::ZERO);
        let position = DVec3::new(0.0, 0.0, 0.5 * AWAY_M);
        let state = BallState { id, position, velocity, angular_velocity, ..*state };
        all.push((Ball { id, flags, spring: None, ..ball.clone() }, state));
    }
    let mut crowded = Simulation::with_parameters(&more, all, settings, parameters)?;
    let (mut compared, mut differ) = (0, 0);
    let mut facts = Vec::new();
    for look in 1..=LOOKS {
        let at = until_s * f64::from(look) / f64::from(LOOKS);
        facts.clear();
        alone.advance(at, FactSet::NONE, &mut facts)?;
        crowded.advance(at, FactSet::NONE, &mut facts)?;
        for (ball, _) in balls {
            let numbers = |world: &Simulation| {
                world
                    .sample(ball.id, at)
                    .map(|b| [b.position, b.velocity, b.angular_velocity].map(|v| v.to_array()))
            };
            let (one, other) = (numbers(&alone), numbers(&crowded));
            for (a, b) in one.iter().flatten().flatten().zip(other.iter().flatten().flatten()) {
                compared += 1;
                differ += u64::from(a.to_bits() != b.to_bits());
            }
        }
    }
    Ok(Idle { compared, differ })
}
