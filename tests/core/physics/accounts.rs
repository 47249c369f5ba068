//! Energy and momentum: the residual of the ledger holds rounding and nothing else.

use super::scenes::*;
use glam::DVec3;
use hapticbillard::ball::{Ball, Spring};
use hapticbillard::physics::{PhysicsSettings, Simulation, Strike};
use hapticbillard::table::Table;

fn adds_up(simulation: &Simulation, what: &str) {
    let ledger = simulation.ledger();
    let turnover = ledger.start_j.abs()
        + ledger.cue_j.abs()
        + ledger.spring_j.abs()
        + ledger.lost_j().abs()
        + ledger.integration_j.abs();
    let momentum = ledger.momentum.table.length() + ledger.momentum.smooth.length() + 1.0;
    assert!(ledger.residual_j.abs() <= 1e-11 * turnover.max(1.0), "{what}: {ledger:#?}");
    assert!(ledger.momentum.residual.length() <= 1e-11 * momentum, "{what}: {ledger:#?}");
}

fn profiles() -> [PhysicsSettings; 2] {
    [stepping(), of_2009()]
}

#[test]
fn random_shots_add_up_in_both_profiles() {
    for seed in 0..if slow() { 300 } else { 8 } {
        for settings in profiles() {
            let mut world = world(pool(), &random_balls(seed), &settings);
            run(&mut world, 3.0);
            adds_up(&world, &format!("seed {seed}, {:?}", settings.profile));
        }
    }
}

#[test]
fn breaks_add_up_in_both_profiles() {
    for gap in [0.0, 5e-5, 1e-3] {
        for settings in profiles() {
            let mut world = world(pool(), &break_shot(gap), &settings);
            run(&mut world, 3.0);
            let ledger = world.ledger();
            adds_up(&world, &format!("gap {gap}, {:?}", settings.profile));
            assert!(0.5 < ledger.ball_ball_j && 0.5 < ledger.cushion_j && 0.5 < ledger.cloth_j);
        }
    }
}

#[test]
fn springs_add_up_with_every_integrator_and_profile() {
    for profile in profiles() {
        for integrator in INTEGRATORS {
            let spring = Spring {
                anchor_m: DVec3::new(0.0, 0.0, 0.1),
                stiffness_n_m: 40.0,
                damping_ns_m: 0.1,
                angular_stiffness_nm_rad: 0.01,
                angular_damping_nms_rad: 1e-5,
                ..Spring::default()
            };
            let position = DVec3::new(0.1, 0.05, 0.2);
            let (held, state) = ball(1, position, DVec3::Y, DVec3::new(1.0, 20.0, 3.0));
            let held = Ball { spring: Some(spring), ..held };
            let passer = on_bed(2, -0.5, 0.0, DVec3::X * 2.0, DVec3::ZERO);
            let settings = PhysicsSettings { integrator, ..profile.clone() };
            let mut world = world(&Table::plane(), &[(held, state), passer], &settings);
            run(&mut world, 2.0);
            assert!(1e-4 < world.ledger().spring_j.abs());
            adds_up(&world, &format!("{integrator:?} {:?}", settings.profile));
        }
    }
}

#[test]
fn flights_add_up_in_both_profiles() {
    for settings in profiles() {
        let mut numbers = Numbers(7);
        for _ in 0..6 {
            let (x, y) = (numbers.between(-1.0, 1.0), numbers.between(-0.5, 0.5));
            let velocity = numbers.vector(3.0);
            let start = ball(0, DVec3::new(x, y, 0.3), velocity, numbers.vector(60.0));
            let mut world = world(pool(), &[start], &settings);
            run(&mut world, 2.0);
            adds_up(&world, "flight");
        }
    }
}

#[test]
fn strokes_add_up_and_the_cue_gives_what_the_ball_gets() {
    for settings in profiles() {
        for (side, height, elevation) in
            [(0.0, 0.0, 0.0), (0.4, 0.2, 5.0), (-0.3, -0.4, 3.0), (0.2, 0.3, 60.0), (0.7, 0.5, 2.0)]
        {
            let strike = Strike {
                speed_m_s: 4.0,
                elevation_deg: elevation,
                side_offset: side,
                height_offset: height,
                ..Strike::CENTRE
            };
            let balls = [
                on_bed(0, -0.5, 0.0, DVec3::ZERO, DVec3::ZERO),
                on_bed(1, 0.4, 0.02, DVec3::ZERO, DVec3::ZERO),
            ];
            let mut world = world(pool(), &balls, &settings).strike(strike).unwrap();
            run(&mut world, 2.0);
            assert!(0.0 < world.ledger().cue_j, "{side} {height}");
            adds_up(&world, &format!("{side} {height} {elevation} {:?}", settings.profile));
        }
    }
}

#[test]
fn sliding_loses_a_seventh_of_m_u_squared() {
    let start = on_bed(0, 0.0, 0.0, DVec3::X * 2.0, DVec3::ZERO);
    let mut world = with(&Table::plane(), &[start], &step(4.0), |p| p.rolling_resistance = 0.0);
    run(&mut world, 2.0);
    let loss = world.ledger().cloth_j;
    assert!((loss - 0.17 * 4.0 / 7.0).abs() < 1e-12, "{loss}");
}

#[test]
fn a_head_on_hit_loses_what_restitution_says() {
    let balls = [
        on_bed(0, 0.0, 0.0, DVec3::X * 2.0, DVec3::Y * (2.0 / R)),
        on_bed(1, 0.0571, 0.0, DVec3::ZERO, DVec3::ZERO),
    ];
    // The balls nearly touch, so that the cloth has no time to change the speed.
    let balls = [balls[0].clone(), {
        let mut second = balls[1].clone();
        second.1.position.x = 2.0 * R + 1e-6;
        second
    }];
    let change = |p: &mut hapticbillard::physics::Parameters| {
        p.ball.friction = 0.0;
        p.rolling_resistance = 0.0;
    };
    let mut world = with(&Table::plane(), &balls, &step(4.0), change);
    run(&mut world, 0.1);
    let loss = world.ledger().ball_ball_j;
    let expected = 0.25 * 0.17 * 4.0 * (1.0 - 0.95 * 0.95);
    assert!((loss - expected).abs() < 1e-9, "{loss} {expected}");
}
