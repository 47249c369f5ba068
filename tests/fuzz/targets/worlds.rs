use super::scenes::COURSE;
use crate::bytes::{check_line, text};
use hapticbillard::cast::Cast;
use hapticbillard::haptic::HapticMesh;
use hapticbillard::physics::{Simulation, SolverKind};
use hapticbillard::scene::Scene;
use std::sync::Arc;

/// So many steps of fixed-step are computed, but no more time than this [s].
const STEPS: f64 = 4.0;
const LONGEST_S: f64 = 0.02;

/// Makes everything that a scene names, and lets it begin.
pub fn run(data: &[u8]) {
    let Ok(scene) = Scene::parse("scene.toml", &text(data)) else { return };
    let table = match scene.build_table(&mut |_| Ok(COURSE.into())) {
        Ok(table) => Arc::new(table),
        Err(error) => return check_line(&error.to_string()),
    };
    if scene.haptic.is_some() {
        HapticMesh::of(&table);
    }
    match Cast::new(&scene, table) {
        Ok(cast) => begin(&scene, cast.simulation),
        Err(error) => check_line(&error.to_string()),
    }
}

fn begin(scene: &Scene, mut simulation: Simulation) {
    let end_s = match scene.physics.solver {
        SolverKind::FixedStep => LONGEST_S.min(STEPS * scene.physics.step_ms / 1000.0),
        SolverKind::EventDriven => LONGEST_S,
    };
    match simulation.advance(end_s, Default::default(), &mut Vec::new()) {
        Ok(_) => {
            let balls = simulation.snapshot(end_s).balls;
            assert!(
                balls.iter().all(|ball| ball.position.is_finite() && ball.velocity.is_finite())
            );
        }
        Err(error) => check_line(&error.to_string()),
    }
}
