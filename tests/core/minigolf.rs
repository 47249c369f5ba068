//! The minigolf scene: another ball game by another ground and another tip.

use super::input::desk::{Desk, shipped};
use glam::DVec2;
use hapticbillard::ball::BallPlace;
use hapticbillard::events::FactKind;
use hapticbillard::ids::BallId;
use hapticbillard::input::{Button, HumanMode};
use hapticbillard::mesh::Surface;
use hapticbillard::physics::{Shot, Simulation, SolverKind, Strike};
use hapticbillard::scene::Scene;
use hapticbillard::shipped::mesh;
use hapticbillard::table::Table;

const SOLVERS: [SolverKind; 2] = [SolverKind::FixedStep, SolverKind::EventDriven];
const HOLE: DVec2 = DVec2::new(0.9, 0.1);
const TEE: DVec2 = DVec2::new(-1.1, 0.0);

fn course(scene: &Scene) -> Table {
    scene.build_table(&mut |file| mesh(file).map(String::from).ok_or("no file".into())).unwrap()
}

/// A putt from the tee with the scene's own putter, at this speed of its head [m/s], so far to the
/// left of the hole [°].
fn putt(solver: SolverKind, speed_m_s: f64, aside_deg: f64) -> Shot {
    putt_in_steps(solver, shipped("minigolf").physics.step_ms, speed_m_s, aside_deg)
}

/// The same with a step of its own.
fn putt_in_steps(solver: SolverKind, step_ms: f64, speed_m_s: f64, aside_deg: f64) -> Shot {
    let mut scene = shipped("minigolf");
    scene.physics.solver = solver;
    scene.physics.step_ms = step_ms;
    let table = course(&scene);
    let balls = scene.build_balls(&table).unwrap();
    let start =
        Simulation::with_parameters(&table, balls, &scene.physics, scene.parameters()).unwrap();
    let azimuth_deg = (HOLE - TEE).to_angle().to_degrees() + aside_deg;
    let strike = Strike { speed_m_s, azimuth_deg, ..Strike::CENTRE };
    start.strike(strike).unwrap().run_until_rest().unwrap()
}

fn is_holed(shot: &Shot) -> bool {
    shot.facts
        .iter()
        .any(|fact| matches!(fact.kind, FactKind::BallPocketed { ball, .. } if ball == BallId::CUE))
}

fn end(shot: &Shot) -> DVec2 {
    shot.trajectory(BallId::CUE).every(0.01).last().unwrap().position.truncate()
}

#[test]
fn a_putt_at_the_hole_goes_over_the_ridge_and_in() {
    for solver in SOLVERS {
        for speed_m_s in [0.75, 0.9, 1.1] {
            assert!(is_holed(&putt(solver, speed_m_s, 0.0)), "{solver:?}, {speed_m_s} m/s");
        }
    }
}

#[test]
fn a_putt_that_is_too_slow_rolls_back_from_the_ridge() {
    for solver in SOLVERS {
        let shot = putt(solver, 0.5, 0.0);
        // The ridge is highest at x = 0.25 m.
        assert!(!is_holed(&shot) && end(&shot).x < 0.05, "{solver:?}: {}", end(&shot));
    }
}

#[test]
fn a_putt_that_is_too_fast_passes_over_the_hole() {
    for solver in SOLVERS {
        assert!(!is_holed(&putt(solver, 2.0, 0.0)), "{solver:?}");
    }
}

#[test]
fn a_putt_to_the_side_meets_the_gate_and_stays_before_it() {
    for solver in SOLVERS {
        let shot = putt(solver, 0.7, 12.0);
        assert!(!is_holed(&shot) && end(&shot).x < -0.36, "{solver:?}: {}", end(&shot));
    }
}

#[test]
fn the_ball_leaves_the_putter_as_the_two_masses_say() {
    // A light ball leaves faster than the head came: (1 + e) M / (M + m), level and in the middle.
    let expected = 1.8 * 0.35 / (0.35 + 0.0459);
    for solver in SOLVERS {
        let shot = putt(solver, 1.0, 0.0);
        let after_s = shot.facts[0].time_s + 1e-3;
        let speed = shot.trajectory(BallId::CUE).at(after_s).unwrap().velocity.length();
        // A millisecond of friction on the lawn takes 2 mm/s.
        assert!((speed / expected - 1.0).abs() < 0.005, "{solver:?}: {speed} {expected}");
    }
}

#[test]
fn the_lawn_is_closed_but_for_its_outline() {
    let table = course(&shipped("minigolf"));
    let inside = |face: &&hapticbillard::mesh::Face| {
        matches!(face.surface, Surface::Cloth | Surface::Pocket(_) | Surface::PocketBottom(_))
    };
    let mut sides = std::collections::BTreeMap::new();
    for face in table.mesh.faces.iter().filter(inside) {
        let [a, b, c] = face.corners;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            // Each side once in each direction.
            assert!(sides.insert((from, to), ()).is_none(), "{from} {to}");
        }
    }
    for &(from, to) in sides.keys().filter(|(from, to)| !sides.contains_key(&(*to, *from))) {
        let on_outline = |v: u32| {
            let place = table.mesh.vertices[v as usize];
            (place.x.abs() - 1.3).abs() < 1e-9 || (place.y.abs() - 0.5).abs() < 1e-9
        };
        assert!(on_outline(from) && on_outline(to));
    }
}

#[test]
fn a_holed_ball_goes_back_to_the_tee() {
    let mut desk = Desk::new(&shipped("minigolf"));
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    desk.turn_to((HOLE - TEE).to_angle());
    desk.stroke(0.2, 0.9, 125);
    assert_eq!(desk.tips(), 1);
    desk.wait_until(8000, |desk| desk.mode() == HumanMode::Placing);
    assert_eq!(desk.cue_ball().place, BallPlace::Pocketed);
    assert_eq!(desk.view().placing, Some(TEE));
    desk.button(Button::Left, true);
    desk.button(Button::Left, false);
    desk.wait(5);
    assert_eq!((desk.mode(), desk.cue_ball().position.truncate()), (HumanMode::Aiming, TEE));
}

/// So fast a putt hits the far rim, jumps up and falls back into the hole: a single contact decides
/// how it rises, and both solvers say the same of it, the stepper the finer its step the more so.
#[test]
fn a_putt_that_jumps_at_the_far_rim_falls_back_in_by_either_solver() {
    for speed_m_s in [1.5, 1.55, 1.6, 1.65, 1.7] {
        let jump = |solver, step_ms| {
            let shot = putt_in_steps(solver, step_ms, speed_m_s, 0.0);
            assert!(is_holed(&shot), "{solver:?}, {step_ms} ms, {speed_m_s} m/s");
            let track = shot.trajectory(BallId::CUE);
            let rising =
                track.every(0.001).find(|ball| ball.position.x > 0.8 && ball.velocity.z > 0.3);
            rising.unwrap().velocity
        };
        let exact = jump(SolverKind::EventDriven, 1.0);
        for step_ms in [1.0, 0.1] {
            let stepped = jump(SolverKind::FixedStep, step_ms);
            assert!(exact.distance(stepped) < 0.03, "{speed_m_s} m/s: {exact} {stepped}");
        }
    }
}
