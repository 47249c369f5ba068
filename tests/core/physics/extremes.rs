//! What no table offers, but a scene or a hand may.

use super::scenes::*;
use glam::DVec3;
use hapticbillard::ball::{Ball, BallState, Spring};
use hapticbillard::events::FactSet;
use hapticbillard::ids::{BallId, Rail};
use hapticbillard::mesh::Surface;
use hapticbillard::physics::{Parameters, PhysicsError, PhysicsSettings, Simulation};
use hapticbillard::table::{Plane, Table};

fn sound(simulation: &Simulation, what: &str) {
    for ball in simulation.snapshot(simulation.now_s()).balls {
        assert!(ball.position.is_finite() && ball.velocity.is_finite(), "{what}: {ball:?}");
    }
    let residual = simulation.ledger().residual_j.abs();
    assert!(residual <= 1e-9 * (1.0 + simulation.ledger().start_j), "{what}: {residual}");
}

#[test]
fn a_dropped_ball_comes_to_rest_for_every_restitution_and_step() {
    for restitution in [0.0, 0.3, 0.5, 0.8, 0.9] {
        for step_ms in [0.5, 1.0, 4.0, 10.0] {
            for integrator in INTEGRATORS {
                let start = ball(0, DVec3::new(0.0, 0.0, 0.3), DVec3::X * 0.2, DVec3::ZERO);
                let settings = PhysicsSettings { integrator, ..step(step_ms) };
                let mut world = with(&Table::plane(), &[start], &settings, |p| {
                    p.cloth.restitution = restitution;
                });
                run(&mut world, 15.0);
                sound(&world, "drop");
                let (end, what) = (state(&world, 0), (restitution, step_ms, integrator));
                assert!(world.is_still(), "{what:?}: {end:?}");
                assert!((end.position.z - R).abs() <= 1e-9, "{what:?}: {end:?}");
            }
        }
    }
}

#[test]
fn hops_take_the_time_and_the_height_that_restitution_leaves() {
    // Fall h, then hops of e² h, e⁴ h …; the n-th impact at √(2h/g) (1 + 2e + … + 2eⁿ).
    let (height, restitution) = (0.3 - R, 0.8_f64);
    let fall = (2.0 * height / 9.81).sqrt();
    for (step_ms, tolerance) in [(1.0, 1e-3), (4.0, 1e-2)] {
        for integrator in INTEGRATORS {
            let start = ball(0, DVec3::Z * 0.3, DVec3::ZERO, DVec3::ZERO);
            let settings = PhysicsSettings { integrator, ..step(step_ms) };
            let mut world = with(&Table::plane(), &[start], &settings, |p| {
                p.cloth.restitution = restitution;
            });
            let (mut impact, mut hop) = (fall, 1.0);
            for _ in 0..6 {
                hop *= restitution;
                run(&mut world, impact + hop * fall);
                let top = (state(&world, 0).position.z - R) / (hop * hop * height);
                assert!((top - 1.0).abs() < tolerance, "{step_ms} {integrator:?} {hop}: {top}");
                impact += 2.0 * hop * fall;
            }
        }
    }
}

#[test]
fn a_small_ball_does_not_pass_through_faces() {
    for speed in [5.0, 10.0, 20.0] {
        for radius_m in [0.001, 0.005] {
            let (one, state_) =
                ball(0, DVec3::new(0.0, 0.0, radius_m), DVec3::X * speed, DVec3::ZERO);
            let small = Ball { radius_m, ..one };
            let mut world = world(pool(), &[(small, state_)], &step(4.0));
            for time in 1..40 {
                run(&mut world, 0.025 * f64::from(time));
                let now = state(&world, 0);
                // It may roll under the nose, but never through the body of the table.
                let outer = pool().parameters.as_ref().unwrap().outer_x_m();
                let inside = now.position.x.abs() < outer - radius_m;
                assert!(inside, "{speed} {radius_m}: {}", now.position);
                assert!(now.position.z > 0.5 * radius_m, "{speed} {radius_m}");
            }
        }
    }
}

#[test]
fn a_ball_a_million_times_as_heavy_is_not_felt_to_be_hit() {
    for (heavy_speed, light_speed) in [(2.0, 0.0), (0.0, -2.0)] {
        let (mut heavy, start) =
            on_bed(0, 0.0, 0.0, DVec3::X * heavy_speed, DVec3::Y * (heavy_speed / R));
        heavy.mass_kg *= 1e6;
        let light = on_bed(1, 0.2, 0.0, DVec3::X * light_speed, DVec3::Y * (light_speed / R));
        let balls = [(heavy, start), light];
        let mut world = with(&Table::plane(), &balls, &step(4.0), |p| p.cloth.friction = 0.0);
        run(&mut world, 0.2);
        let (heavy, light) = (state(&world, 0), state(&world, 1));
        assert!((heavy.velocity.x - heavy_speed).abs() < 0.03, "{}", heavy.velocity);
        let expected = heavy_speed + 0.95 * (heavy_speed - light_speed);
        assert!((light.velocity.x - expected).abs() < 0.2, "{} {expected}", light.velocity);
        sound(&world, "mass ratio");
    }
}

#[test]
fn fifteen_touching_balls_at_rest_stay_where_they_are_to_the_last_bit() {
    let mut balls = break_shot(0.0);
    balls.remove(0);
    let mut world = world(pool(), &balls, &step(4.0));
    run(&mut world, 5.0);
    for (ball, start) in &balls {
        let now = state(&world, ball.id.0);
        assert_eq!((now.position, now.velocity), (start.position, DVec3::ZERO));
    }
}

#[test]
fn a_table_at_rest_for_an_hour_changes_no_bit() {
    let mut skipping = world(pool(), &break_shot(1e-3)[1..], &step(4.0));
    let before = skipping.snapshot(0.0).balls;
    let facts = run(&mut skipping, 3600.0);
    assert!(facts.is_empty());
    assert_eq!(skipping.snapshot(3600.0).balls, before);
    assert!(skipping.work().steps < 10);
}

#[test]
fn steps_over_two_decades_break_the_rack_without_harm() {
    for step_ms in [0.5, 1.0, 4.0, 20.0, 50.0] {
        let mut world = world(pool(), &break_shot(0.0), &step(step_ms));
        run(&mut world, if slow() { 20.0 } else { 1.0 });
        sound(&world, &format!("{step_ms} ms"));
    }
}

#[test]
fn any_friction_and_restitution_are_borne() {
    for friction in [0.0, 1e6] {
        for restitution in [0.0, 1.0] {
            let change = |p: &mut Parameters| {
                for contact in [&mut p.ball, &mut p.cloth, &mut p.cushion, &mut p.pocket] {
                    contact.friction = friction;
                    contact.restitution = restitution;
                }
            };
            let mut world = with(pool(), &break_shot(0.0), &step(4.0), change);
            run(&mut world, 1.0);
            sound(&world, &format!("{friction} {restitution}"));
            let ledger = world.ledger();
            assert!(-1e-9 <= ledger.lost_j(), "{friction} {restitution} {ledger:?}");
        }
    }
}

#[test]
fn balls_stacked_in_a_pocket_come_to_rest_or_are_taken_out() {
    let centre = pool().pockets[0].centre;
    let balls: Vec<(Ball, BallState)> = (0..5_u16)
        .map(|id| {
            let z = 0.05 + 2.1 * R * f64::from(id);
            let x = centre.x + 1e-3 * f64::from(id % 2);
            ball(id, DVec3::new(x, centre.y, z), DVec3::ZERO, DVec3::ZERO)
        })
        .collect();
    let mut world = world(pool(), &balls, &step(4.0));
    let facts = run(&mut world, 6.0);
    sound(&world, "stack");
    let down = facts.iter().filter(|fact| fact.kind.name() == "BallPocketed").count();
    assert!(1 <= down, "{facts:?}");
}

#[test]
fn a_ball_jammed_between_a_ball_and_a_cushion_is_pressed_by_neither() {
    let wall = Plane {
        point: DVec3::X * 0.5,
        normal: DVec3::NEG_X,
        surface: Surface::Cushion(Rail::Foot),
    };
    let mut table = Table::plane();
    table.planes.push(wall);
    let balls = [
        on_bed(0, 0.0, 0.0, DVec3::X * 3.0, DVec3::Y * (6.0 / R)),
        on_bed(1, 0.5 - R, 0.0, DVec3::ZERO, DVec3::ZERO),
    ];
    let mut world = world(&table, &balls, &step(4.0));
    run(&mut world, 10.0);
    sound(&world, "jam");
    let (cue, jammed) = (state(&world, 0).position, state(&world, 1).position);
    assert!(jammed.x <= 0.5 - R + 1e-6);
    assert!(2.0 * R - 1e-6 <= cue.distance(jammed));
}

#[test]
fn a_spring_too_stiff_for_the_step_is_an_error_not_silence() {
    let (held, state) = ball(3, DVec3::new(0.01, 0.0, 0.5), DVec3::ZERO, DVec3::ZERO);
    let spring = Spring { stiffness_n_m: 1e6, ..Spring::default() };
    let held = Ball { spring: Some(spring), ..held };
    let mut world = world(&Table::plane(), &[(held, state)], &step(4.0));
    let result = world.advance(100.0, FactSet::NONE, &mut Vec::new());
    let error = result.unwrap_err();
    assert!(matches!(error, PhysicsError::NonFinite { ball: BallId(3), .. }), "{error}");
}

#[test]
fn impossible_worlds_are_refused() {
    let start = |change: fn(&mut (Ball, BallState))| {
        let mut one = on_bed(0, 0.0, 0.0, DVec3::ZERO, DVec3::ZERO);
        change(&mut one);
        let balls = vec![one, on_bed(1, 0.2, 0.0, DVec3::ZERO, DVec3::ZERO)];
        Simulation::from_parts(&Table::plane(), balls, &PhysicsSettings::default()).unwrap_err()
    };
    use PhysicsError::{DuplicateBall, NonFinite, Overlap, Setting};
    assert!(matches!(start(|b| b.1.velocity.x = f64::NAN), NonFinite { .. }));
    assert!(matches!(start(|b| b.1.position.x = 0.15), Overlap { .. }));
    assert!(matches!(start(|b| b.0.mass_kg = 0.0), Setting { key: "mass_kg", .. }));
    assert!(matches!(start(|b| b.0.id = BallId(1)), DuplicateBall(BallId(1))));
}
