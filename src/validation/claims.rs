//! The project's own parameters and counts, against what is published.

use super::error::{Trouble, unsupported};
use super::observed::{Observations, Observed};
use super::setup::Setup;
use super::shapes::BreakScene;
use crate::ball::{Ball, BallState};
use crate::events::{FactSet, Topic};
use crate::ids::BallId;
use crate::physics::{Equipment, PhysicsSettings, Simulation, SolverKind};
use crate::shipped;
use crate::table::{Table, TableParameters};
use glam::DVec3;

pub(super) fn parameter(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let parameters = match &*setup.word("profile")? {
        "pool" => Equipment::Pool,
        "snooker" => Equipment::Snooker,
        "carom" => Equipment::Carom,
        _ => {
            let fix = "the profiles are pool, snooker and carom";
            return Err(setup.error("profile", "is unknown", fix).into());
        }
    }
    .parameters();
    let speed = setup.number_or_zero("normal_speed_m_s")?;
    let (rolls, slides) = (parameters.rolling_resistance, parameters.cloth.friction);
    let mut seen = Observations::default();
    seen.set("mu_roll", rolls);
    seen.set("mu_slide", slides);
    seen.set("rolling_deceleration_m_s2", rolls * parameters.gravity_m_s2);
    seen.set("sliding_deceleration_m_s2", slides * parameters.gravity_m_s2);
    seen.set("e_cushion", parameters.cushion_at(speed).restitution);
    Ok(seen)
}

pub(super) fn count(setup: &Setup<'_>, keys: &[&str]) -> Result<Observations, Trouble> {
    let mut seen = Observations::default();
    let balls = setup.count("balls")?.unwrap_or(0);
    let faces = setup.count("faces")?.unwrap_or(0);
    if balls > 1_000_000 {
        return Err(setup.error("balls", "are too many to count", "at most a million").into());
    }
    seen.set("ball_pairs", Observed::Count((0..balls).sum()));
    seen.set("ball_face_pairs", Observed::Count(balls.saturating_mul(faces)));
    let subdivisions = setup.counts("subdivisions")?.unwrap_or_default();
    if subdivisions.iter().any(|times| *times > 20) {
        return unsupported("more than 20 subdivisions of a sphere");
    }
    // Each subdivision cuts every triangle of the icosahedron into four.
    let triangles: Vec<u64> = subdivisions.iter().map(|times| 20 * 4_u64.pow(*times)).collect();
    let most = triangles.iter().max().copied().unwrap_or(0);
    seen.set("triangles_all_balls", Observed::Count(most.saturating_mul(balls)));
    seen.set(
        "icosphere_triangles",
        Observed::List(triangles.into_iter().map(Observed::Count).collect()),
    );
    if keys.contains(&"max_narrow_tests_per_step") {
        let Some(scene) = setup.break_scene()? else {
            return Err(setup.error("break_scene", "missing", "say which break").into());
        };
        seen.set("max_narrow_tests_per_step", narrow_tests(setup, &scene)?);
    }
    Ok(seen)
}

/// Pair and face tests a step, on average over a break on a generated table.
fn narrow_tests(setup: &Setup<'_>, scene: &BreakScene) -> Result<f64, Trouble> {
    let wrong = |problem: String| {
        Trouble::Wrong(setup.error("break_scene", problem, "compare the shipped case"))
    };
    let pool = shipped::table("pool-9ft").unwrap_or_default();
    let parameters = TableParameters::from_toml(pool).map_err(|error| wrong(error.to_string()))?;
    let parameters =
        TableParameters { length_m: scene.bed_length_m, width_m: scene.bed_width_m, ..parameters };
    let table = Table::from_parameters("break", parameters).map_err(|e| wrong(e.to_string()))?;
    let settings = PhysicsSettings {
        solver: SolverKind::FixedStep,
        step_ms: scene.step_s * 1000.0,
        ..PhysicsSettings::default()
    };
    let mut balls =
        vec![at(scene, 0, DVec3::from((scene.cue_start_m[0], scene.cue_start_m[1], 0.0)))];
    balls[0].1.velocity = DVec3::X * scene.cue_speed_m_s;
    let pitch = 2.0 * scene.ball_radius_m + scene.gap_m;
    for row in 0..5 {
        for place in 0..=row {
            let x = scene.apex_m[0] + pitch * f64::from(row) * 0.75_f64.sqrt();
            let y = scene.apex_m[1] + pitch * (f64::from(place) - 0.5 * f64::from(row));
            balls.push(at(scene, balls.len(), DVec3::new(x, y, 0.0)));
        }
    }
    let mut simulation = Simulation::from_parts(&table, balls, &settings)?;
    let settled = FactSet::of(&[Topic::Settled]);
    if !(0.0..=1000.0).contains(&scene.end_time_s) {
        return Err(wrong(format!("{} s is no time to run to", scene.end_time_s)));
    }
    simulation.advance(scene.end_time_s, settled, &mut Vec::new())?;
    let work = simulation.work();
    Ok(work.tests() as f64 / work.steps.max(1) as f64)
}

/// A ball of the scene on the bed.
fn at(scene: &BreakScene, place: usize, position: DVec3) -> (Ball, BallState) {
    let id = BallId(place as u16);
    let ball = Ball { radius_m: scene.ball_radius_m, ..Ball::pool(id) };
    (ball, BallState::at_rest(id, position.with_z(scene.ball_radius_m)))
}
