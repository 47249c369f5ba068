//! Balls and walls without a table.

use super::error::Trouble;
use super::observed::{Observations, Observed};
use super::probe::Probe;
use super::setup::Setup;
use super::shapes::{BallEntry, Grid};
use super::world::World;
use crate::events::{Fact, FactKind};
use crate::ids::BallId;
use crate::physics::{Simulation, SolverKind};
use glam::DVec3;

/// Where nothing else is asked for, the world is looked at this often [s].
const LOOK_S: f64 = 0.01;

pub(super) fn observe(
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    let balls = match setup.grid()? {
        Some(grid) => gas(&grid),
        None => setup.balls()?,
    };
    let walls = setup.walls()?;
    let world = World::new(setup, &balls, solver)?.walls(&walls);
    let end = setup.end_s()?;
    let start_s = setup.number_or_zero("start_time_s")?;
    let end = end - start_s;
    let average_from = setup.number_or_zero("average_from_s")? - start_s;
    let frame = setup.frames_s(end)?.first().copied().unwrap_or(LOOK_S);

    let start = world.simulation()?;
    let mut probe = Probe::new(start.clone());
    let energy = world.energy_j(&start);
    let mut facts = Vec::new();
    let (mut drift, mut squares, mut looks) = (0.0_f64, 0.0, 0_u32);
    let averages = keys.iter().any(|key| key.contains("mean_square"));
    let steps = (end / frame).ceil().max(1.0) as u64;
    for step in 1..=steps {
        let time = if step == steps { end } else { frame * step as f64 };
        probe.advance_with(time, &mut facts)?;
        if energy > 0.0 {
            drift = drift.max((world.energy_j(&probe.simulation) - energy).abs() / energy);
        }
        if averages && average_from <= time {
            looks += 1;
            squares += states(&probe.simulation, balls.len(), time)?
                .iter()
                .map(|state| state.velocity.x * state.velocity.x)
                .sum::<f64>()
                / balls.len() as f64;
        }
    }

    let mut seen = Observations::default();
    let contacts: Vec<&Fact> = facts.iter().filter(|fact| touches(fact).is_some()).collect();
    seen.set("contacts", Observed::Count(contacts.len() as u64));
    if let (Some(first), Some(last)) = (contacts.first(), contacts.last()) {
        seen.set("t_first_contact_s", first.time_s + start_s);
        seen.set("t_last_contact_s", last.time_s + start_s);
        let mut then = start.clone();
        then.advance(first.time_s, crate::events::FactSet::NONE, &mut Vec::new())?;
        let positions: Vec<DVec3> =
            states(&then, balls.len(), first.time_s)?.iter().map(|state| state.position).collect();
        match &positions[..] {
            [one] => seen.set("first_contact_position_m", *one),
            _ => seen.set("first_contact_position_m", positions),
        }
    }
    let states = states(&probe.simulation, balls.len(), end)?;
    seen.set("position_m", states.iter().map(|s| s.position).collect::<Vec<_>>());
    seen.set("velocity_m_s", states.iter().map(|s| s.velocity).collect::<Vec<_>>());
    let spins: Vec<DVec3> = states.iter().map(|s| s.angular_velocity).collect();
    seen.set("angular_velocity_rad_s", spins);
    let momentum: DVec3 = states.iter().zip(&balls).map(|(s, ball)| s.velocity * ball.m).sum();
    seen.set("momentum_Ns", momentum);
    seen.set("max_energy_rel_drift", drift);
    let left = world.energy_j(&probe.simulation);
    seen.maybe("energy_fraction", (energy > 0.0).then(|| left / energy));
    seen.maybe("mean_square_velocity_x_m2_s2", (looks > 0).then(|| squares / f64::from(looks)));
    let symmetry = mirror_error(&balls, &states.iter().map(|s| s.position).collect::<Vec<_>>());
    seen.maybe("max_symmetry_error_m", symmetry);
    averages_of(setup, &balls, &contacts, average_from, end, &mut seen)?;
    Ok(seen)
}

/// The ball of a contact with something fixed and the normal speed; the second ball is none.
fn touches(fact: &Fact) -> Option<(BallId, Option<BallId>, f64)> {
    match fact.kind {
        FactKind::BallsCollided { a, b, normal_speed_m_s, .. } => {
            Some((a, Some(b), normal_speed_m_s))
        }
        FactKind::CushionHit { ball, normal_speed_m_s, .. } => Some((ball, None, normal_speed_m_s)),
        _ => None,
    }
}

fn states(
    simulation: &Simulation,
    count: usize,
    at: f64,
) -> Result<Vec<crate::ball::BallState>, Trouble> {
    (0..count)
        .map(|place| {
            let state = simulation.sample(BallId(place as u16), at);
            state.ok_or_else(|| Trouble::Failed(format!("ball {place} is gone")))
        })
        .collect()
}

/// Pressure on the walls and collisions of balls per second, from `average_from` to `end`.
fn averages_of(
    setup: &Setup<'_>,
    balls: &[BallEntry],
    contacts: &[&Fact],
    average_from: f64,
    end: f64,
    seen: &mut Observations,
) -> Result<(), Trouble> {
    let span = end - average_from;
    if span <= 0.0 {
        return Ok(());
    }
    let e_wall = setup.number_or_zero("e_wall")?;
    let (mut impulse, mut collisions) = (0.0, 0_u64);
    for fact in contacts.iter().filter(|fact| average_from <= fact.time_s) {
        match touches(fact) {
            Some((_, Some(_), _)) => collisions += 1,
            Some((ball, None, speed)) => {
                // What turns a ball around: (1 + e) m v.
                let mass = balls.get(usize::from(ball.0)).map_or(0.0, |ball| ball.m);
                impulse += (1.0 + e_wall) * mass * speed;
            }
            None => {}
        }
    }
    seen.set("ball_contacts_per_s", collisions as f64 / span);
    seen.maybe("wall_pressure_Pa", open_area(setup, balls)?.map(|area| impulse / (area * span)));
    Ok(())
}

/// Area of the box of walls that the centres can reach [m²]; none if the walls are no box along the
/// axes.
fn open_area(setup: &Setup<'_>, balls: &[BallEntry]) -> Result<Option<f64>, Trouble> {
    let walls = setup.walls()?;
    let radius = balls.iter().map(|ball| ball.radius_m).fold(0.0, f64::max);
    let (mut low, mut high) = (DVec3::splat(f64::NEG_INFINITY), DVec3::splat(f64::INFINITY));
    for wall in &walls {
        for axis in 0..3 {
            if wall.normal[axis] > 1.0 - 1e-9 {
                low[axis] = low[axis].max(wall.point_m[axis] + radius);
            }
            if wall.normal[axis] < -1.0 + 1e-9 {
                high[axis] = high[axis].min(wall.point_m[axis] - radius);
            }
        }
    }
    let size = high - low;
    if !size.is_finite() || size.min_element() <= 0.0 {
        return Ok(None);
    }
    Ok(Some(2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)))
}

/// How far the balls are from the mirror image that they began in: for the first of the planes
/// x = 0, y = 0 and z = 0 about which the start is symmetric.
fn mirror_error(balls: &[BallEntry], ends: &[DVec3]) -> Option<f64> {
    let mirrored = |v: DVec3, axis: usize| {
        let mut v = v;
        v[axis] = -v[axis];
        v
    };
    let same = |a: DVec3, b: DVec3| (a - b).length() <= 1e-12;
    // From the third axis down: a straight row lies in z = 0 and y = 0 anyway.
    [1, 0, 2].into_iter().find_map(|axis| {
        let partner = |ball: &BallEntry| {
            balls.iter().position(|other| {
                same(mirrored(ball.position_m, axis), other.position_m)
                    && same(mirrored(ball.velocity_m_s, axis), other.velocity_m_s)
            })
        };
        let partners: Option<Vec<usize>> = balls.iter().map(partner).collect();
        let apart =
            |(place, other): (usize, &usize)| (mirrored(ends[place], axis) - ends[*other]).length();
        partners.map(|list| list.iter().enumerate().map(apart).fold(0.0, f64::max))
    })
}

/// Balls on a grid with directions spread evenly over the sphere.
fn gas(grid: &Grid) -> Vec<BallEntry> {
    let [nx, ny, nz] = grid.count.map(u64::from);
    let count = nx * ny * nz;
    let place = |k: u64| (k / (ny * nz), k / nz % ny, k % nz);
    (0..count)
        .map(|k| {
            let (ix, iy, iz) = place(k);
            let q = (617 * k % count) as f64;
            let z = 1.0 - 2.0 * (q + 0.5) / count as f64;
            let (sin, cos) = libm::sincos(2.399_963_229_728_653 * q);
            let flat = (1.0 - z * z).max(0.0).sqrt();
            BallEntry {
                id: k as i64 + 1,
                m: grid.m,
                radius_m: grid.radius_m,
                position_m: grid.first_m
                    + DVec3::new(ix as f64, iy as f64, iz as f64) * grid.spacing_m,
                velocity_m_s: DVec3::new(flat * cos, flat * sin, z) * grid.speed_m_s,
                angular_velocity_rad_s: DVec3::ZERO,
                inertia_factor: None,
            }
        })
        .collect()
}
