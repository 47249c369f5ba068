//! One ball and a mesh: the first contact, or a run to an end.

use super::error::{Trouble, unsupported};
use super::observed::{Observations, Observed};
use super::probe::Probe;
use super::setup::Setup;
use super::shapes::MeshEntry;
use super::world::World;
use crate::ball::BallState;
use crate::events::{FactKind, FactSet, Topic};
use crate::ids::Rail;
use crate::mesh::{Face, Mesh, Surface};
use crate::physics::{SolverKind, spring};
use glam::DVec3;

/// Without an end, a first contact is awaited for so long [s].
const WAIT_S: f64 = 100.0;
/// Without frames of its own, the world is looked at this often [s].
const LOOK_S: f64 = 0.01;

pub(super) fn observe(
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    let entry = setup.ball()?;
    let mesh = setup.mesh()?;
    if !setup.switch("two_sided")? {
        return unsupported("faces collide from both sides in this build");
    }
    // A mesh that balls slide on is cloth; any other one tells when it is met.
    let played_on = ["mu_slide", "mu_roll", "spin_decel_rad_s2"]
        .iter()
        .any(|key| setup.values.contains_key(*key));
    let surface = if played_on { Surface::Cloth } else { Surface::Cushion(Rail::Head) };
    let mut world = World::new(setup, core::slice::from_ref(&entry), solver)?;
    world.table.mesh = body(&mesh, surface);

    let mut seen = Observations::default();
    let asks = |part: &str| keys.iter().any(|key| key.contains(part));
    if asks("contact") || asks("normal") || asks("after") {
        first_contact(&world, &mesh, &mut seen)?;
    }
    let runs = ["position_m", "velocity_m_s", "angular_velocity_rad_s", "passed_through"];
    if asks("max_") || keys.iter().any(|key| runs.contains(key)) {
        run_to_end(setup, keys, &world, &mesh, &mut seen)?;
    }
    Ok(seen)
}

fn body(entry: &MeshEntry, surface: Surface) -> Mesh {
    Mesh {
        vertices: entry.vertices_m.clone(),
        faces: entry.triangles.iter().map(|corners| Face { corners: *corners, surface }).collect(),
    }
}

fn first_contact(world: &World, mesh: &MeshEntry, seen: &mut Observations) -> Result<(), Trouble> {
    let mut world = world.clone();
    world.table.mesh = body(mesh, Surface::Cushion(Rail::Head));
    let mut simulation = world.simulation()?;
    let mut facts = Vec::new();
    simulation.advance(WAIT_S, FactSet::of(&[Topic::CushionHit]), &mut facts)?;
    let Some(fact) = facts.last() else { return Ok(()) };
    let FactKind::CushionHit { position_m, .. } = fact.kind else { return Ok(()) };
    let probe = Probe::new(simulation);
    let state = probe.ahead(fact.time_s)?;
    seen.set("t_first_contact_s", fact.time_s);
    seen.set("contact_point_m", position_m);
    seen.set("normal_to_ball", (state.position - position_m).normalize_or_zero());
    seen.set("velocity_after_m_s", state.velocity);
    Ok(())
}

/// The largest of what may not happen, over all frames, frame lengths and starts.
#[derive(Default)]
struct Largest {
    z_velocity: f64,
    z_error: f64,
    shift: f64,
    turn: f64,
    passed: u64,
}

impl Largest {
    fn look(&mut self, start: &BallState, state: &BallState) {
        self.z_velocity = self.z_velocity.max(state.velocity.z.abs());
        self.z_error = self.z_error.max((state.position.z - start.position.z).abs());
        self.shift = self.shift.max((state.position - start.position).length());
        let turned = state.orientation * start.orientation.inverse();
        let axis = spring::rotation_vector(turned);
        self.turn = self.turn.max(axis.length());
    }
}

fn run_to_end(
    setup: &Setup<'_>,
    keys: &[&str],
    world: &World,
    mesh: &MeshEntry,
    seen: &mut Observations,
) -> Result<(), Trouble> {
    let end = setup.end_s()?;
    let mut frames = setup.frames_s(end)?;
    if frames.is_empty() {
        frames.push(LOOK_S);
    }
    let watches = keys.iter().any(|key| key.starts_with("max_"));
    let mut largest = Largest::default();
    let mut last = None;
    for start in starts(setup, world)? {
        let mut own = world.clone();
        own.balls[0].1 = start;
        let fresh = own.simulation()?;
        for frame in &frames {
            let mut probe = Probe::new(fresh.clone());
            let steps = (end / frame).ceil().max(1.0) as u64;
            for step in 1..=steps {
                let time = if step == steps { end } else { frame * step as f64 };
                probe.advance(time)?;
                if watches {
                    largest.look(&start, &probe.state()?);
                }
            }
            let state = probe.state()?;
            largest.passed += u64::from(crosses(mesh, start.position, state.position));
            last.get_or_insert(state);
        }
    }
    if let Some(state) = last {
        seen.set("position_m", state.position);
        seen.set("velocity_m_s", state.velocity);
        seen.set("angular_velocity_rad_s", state.angular_velocity);
    }
    seen.set("max_abs_z_velocity_m_s", largest.z_velocity);
    seen.set("max_abs_z_error_m", largest.z_error);
    seen.set("max_shift_m", largest.shift);
    seen.set("max_orientation_change_rad", largest.turn);
    seen.set("passed_through", Observed::Count(largest.passed));
    Ok(())
}

/// The starts of a run: the ball's own, or many on a line.
fn starts(setup: &Setup<'_>, world: &World) -> Result<Vec<BallState>, Trouble> {
    let own = world.balls[0].1;
    let Some(repeat) = setup.repeat()? else { return Ok(vec![own]) };
    let mut starts = Vec::new();
    for k in 0..repeat.count {
        let share = f64::from(k) / f64::from((repeat.count - 1).max(1));
        let position = repeat.first_start_m.lerp(repeat.last_start_m, share);
        starts.push(BallState { position, ..own });
        if repeat.mirror_z {
            let flip = |v: DVec3| v.with_z(-v.z);
            let velocity = flip(own.velocity);
            starts.push(BallState { position: flip(position), velocity, ..own });
        }
    }
    Ok(starts)
}

/// Whether the straight line from one point to another goes through a face. A ball that bounced
/// off ends where it began; one that ends beyond the mesh went through it, or around it, and the
/// line tells which.
fn crosses(mesh: &MeshEntry, from: DVec3, to: DVec3) -> bool {
    let way = to - from;
    mesh.triangles.iter().any(|corners| {
        let [a, b, c] = corners.map(|corner| mesh.vertices_m[corner as usize]);
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let along = way.dot(normal);
        if along == 0.0 {
            return false;
        }
        let share = (a - from).dot(normal) / along;
        let inside = from + way * share - a;
        let area = normal.length_squared();
        let (u, v) = (inside.cross(ac).dot(normal) / area, ab.cross(inside).dot(normal) / area);
        (0.0..=1.0).contains(&share) && u >= 0.0 && v >= 0.0 && u + v <= 1.0
    })
}
