//! Balls at rest on each other: contact forces and creep.

use super::error::Trouble;
use super::observed::Observations;
use super::probe::Probe;
use super::setup::Setup;
use super::shapes::{BallEntry, Cylinder, Wall};
use super::world::World;
use crate::ids::BallId;
use crate::physics::laws::Mover;
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::{Contact, SolverKind, tolerance};
use glam::DVec3;

/// Weight acts for so long to measure a force [s]; the force does not depend on it.
const PUSH_S: f64 = 1.0;
/// A cylinder is walled by so many planes, besides those where balls touch it.
const SIDES: u32 = 64;
/// Gaps up to this are contacts [m].
const TOUCHING_M: f64 = tolerance::CLUSTER_M;
/// The stack is looked at this often [s].
const LOOK_S: f64 = 0.05;

pub(super) fn observe(
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    let balls = setup.balls()?;
    let (walls, cylinders) = (setup.walls()?, setup.cylinders()?);
    let world = World::new(setup, &balls, solver)?;
    let gravity = world.parameters.gravity_m_s2;
    let mut seen = Observations::default();

    if keys.contains(&"max_shift_m") {
        let mut sides = walls.clone();
        sides.extend(cylinders.iter().flat_map(|cylinder| around(cylinder, &balls)));
        let end = setup.end_s()?;
        let mut probe = Probe::new(world.clone().walls(&sides).simulation()?);
        let mut shift = 0.0_f64;
        let steps = (end / LOOK_S).ceil().max(1.0) as u64;
        for step in 1..=steps {
            let time = if step == steps { end } else { LOOK_S * step as f64 };
            probe.advance(time)?;
            for (place, entry) in balls.iter().enumerate() {
                probe.ball = BallId(place as u16);
                shift = shift.max((probe.state()?.position - entry.position_m).length());
            }
        }
        seen.set("max_shift_m", shift);
    }
    if keys.contains(&"contact_force_N") {
        seen.set("contact_force_N", forces(setup, &balls, &walls, &cylinders, gravity)?);
    }
    Ok(seen)
}

/// The forces that hold the stack: the impulses by which the joint law stops what gravity would
/// start, over the time it would take.
fn forces(
    setup: &Setup<'_>,
    balls: &[BallEntry],
    walls: &[Wall],
    cylinders: &[Cylinder],
    gravity: f64,
) -> Result<Vec<f64>, Trouble> {
    let friction = |key| setup.number_or_zero(key);
    let (between, at_walls) = (friction("mu_ball")?, friction("mu_wall")?);
    let mut movers: Vec<Mover> = balls.iter().map(super::world::mover).collect();
    for mover in &mut movers {
        mover.velocity.z -= gravity * PUSH_S;
    }
    // Everything that touches holds, whether its force is asked for or not.
    let mut touches: Vec<(i64, i64, Touch)> = Vec::new();
    let touch = |a, b, normal, friction| {
        let law = Contact { restitution: 0.0, friction };
        Touch { carries: true, ..Touch::new(a, b, normal, law) }
    };
    for (a, one) in balls.iter().enumerate() {
        for (b, two) in balls.iter().enumerate().skip(a + 1) {
            let line = one.position_m - two.position_m;
            if line.length() - one.radius_m - two.radius_m <= TOUCHING_M {
                let normal = line.normalize_or(DVec3::Z);
                touches.push((one.id, two.id, touch(a, Some(b), normal, between)));
            }
        }
        let mut held = |number: i64, gap: f64, normal: DVec3| {
            if gap <= TOUCHING_M {
                touches.push((one.id, -number, touch(a, None, normal, at_walls)));
            }
        };
        for (wall, number) in walls.iter().zip(1..) {
            let gap = (one.position_m - wall.point_m).dot(wall.normal) - one.radius_m;
            held(number, gap, wall.normal);
        }
        for (cylinder, number) in cylinders.iter().zip(walls.len() as i64 + 1..) {
            let out = outwards(cylinder, one.position_m);
            let gap = cylinder.radius_m - out.length() - one.radius_m;
            held(number, gap, -out.normalize_or_zero());
        }
    }
    let mut contacts: Vec<Touch> = touches.iter().map(|(.., touch)| *touch).collect();
    cluster::resolve(&mut movers, &mut contacts);
    let force = |[a, b]: [i64; 2]| {
        let same = |(one, two): (i64, i64)| (one, two) == (a, b) || (two, one) == (a, b);
        let found = touches.iter().position(|(one, two, _)| same((*one, *two)));
        found.map_or(0.0, |place| {
            let touch = &contacts[place];
            touch.impulse.dot(touch.normal) / PUSH_S
        })
    };
    Ok(setup.contacts()?.into_iter().map(force).collect())
}

/// From the axis of a cylinder to a point, across the axis [m].
fn outwards(cylinder: &Cylinder, point: DVec3) -> DVec3 {
    let from = point - cylinder.point_m;
    from - cylinder.axis * from.dot(cylinder.axis)
}

/// Planes that stand for a cylinder: tangents where balls touch it, and all around.
fn around(cylinder: &Cylinder, balls: &[BallEntry]) -> Vec<Wall> {
    let (u, v) = cylinder.axis.any_orthonormal_pair();
    let even = (0..SIDES).map(|side| {
        let angle = core::f64::consts::TAU * f64::from(side) / f64::from(SIDES);
        u * libm::cos(angle) + v * libm::sin(angle)
    });
    let touched = balls.iter().filter_map(|ball| {
        let out = outwards(cylinder, ball.position_m);
        let gap = cylinder.radius_m - out.length() - ball.radius_m;
        (gap <= TOUCHING_M).then(|| out.normalize_or_zero())
    });
    touched
        .filter(|out| *out != DVec3::ZERO)
        .chain(even)
        .map(|out| Wall { point_m: cylinder.point_m + out * cylinder.radius_m, normal: -out })
        .collect()
}
