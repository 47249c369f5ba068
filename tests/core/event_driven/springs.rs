//! Balls on springs that meet something.

use super::exact;
use crate::physics::scenes::{R, ball, on_bed, pool, run, state, step, with, world};
use glam::{DQuat, DVec3};
use hapticbillard::ball::{Ball, BallState, Spring};
use hapticbillard::mesh::Surface;
use hapticbillard::physics::{Contact, Integrator, PhysicsSettings};
use hapticbillard::table::{Plane, Table};

fn spring(anchor_m: DVec3, stiffness_n_m: f64, damping_ns_m: f64) -> Spring {
    Spring {
        anchor_m,
        stiffness_n_m,
        damping_ns_m,
        anchor_orientation: DQuat::IDENTITY,
        angular_stiffness_nm_rad: 0.0,
        angular_damping_nms_rad: 0.0,
    }
}

fn sprung(id: u16, place: DVec3, velocity: DVec3, spring: Spring) -> (Ball, BallState) {
    let (ball, state) = ball(id, place, velocity, DVec3::ZERO);
    (Ball { spring: Some(spring), ..ball }, state)
}

#[test]
fn a_spring_presses_a_ball_on_the_ground_and_it_stays_there() {
    for stiffness in [10.0, 1e3, 1e5, 1e7, 1e9] {
        let place = DVec3::new(0.0, 0.0, 0.1);
        let below = spring(DVec3::new(0.0, 0.0, -0.05), stiffness, 0.5);
        let balls = [sprung(0, place, DVec3::ZERO, below)];
        let mut world = world(&Table::plane(), &balls, &exact());
        run(&mut world, 30.0);
        let end = state(&world, 0);
        assert!((end.position.z - R).abs() < 1e-6, "{stiffness}: {}", end.position);
        assert!(end.velocity.length() < 1e-3, "{stiffness}: {}", end.velocity);
    }
}

#[test]
fn a_ball_on_a_spring_takes_a_blow_and_hands_it_back() {
    // Without loss or weight: the struck ball swings for half a period, returns and gives the
    // striker its speed back. m = n: velocities are exchanged each time.
    for stiffness in [10.0, 1e3, 1e5, 1e7, 1e9] {
        let held = spring(DVec3::new(0.0, 0.0, 1.0), stiffness, 0.0);
        let balls = [
            sprung(0, DVec3::new(0.0, 0.0, 1.0), DVec3::ZERO, held),
            ball(1, DVec3::new(-2.0 * R - 0.1, 0.0, 1.0), DVec3::X, DVec3::ZERO),
        ];
        let mut world = with(&Table::default(), &balls, &exact(), |parameters| {
            parameters.gravity_m_s2 = 0.0;
            parameters.ball = Contact { restitution: 1.0, friction: 0.0 };
        });
        let half_period = std::f64::consts::PI * (0.17 / stiffness).sqrt();
        run(&mut world, 0.1 + half_period + 0.2);
        let back = state(&world, 1);
        assert!((back.velocity.x + 1.0).abs() < 1e-6, "{stiffness}: {}", back.velocity);
        let expected = -2.0 * R - 0.2;
        assert!((back.position.x - expected).abs() < 1e-6, "{stiffness}: {}", back.position);
        let swings_m = state(&world, 0).velocity.length() * (0.17_f64 / stiffness).sqrt();
        assert!(swings_m < 1e-9, "{stiffness}: {swings_m}");
        let ledger = world.ledger();
        assert!(ledger.residual_j.abs() < 1e-9, "{stiffness}: {}", ledger.residual_j);
    }
}

/// Position and velocity by the textbook's three cases, at `t`, from an offset at rest.
fn textbook(omega: f64, ratio: f64, offset: f64, t: f64) -> f64 {
    let sigma = ratio * omega;
    if ratio < 1.0 {
        let rate = omega * (1.0 - ratio * ratio).sqrt();
        let (sin, cos) = libm::sincos(rate * t);
        offset * libm::exp(-sigma * t) * (cos + sigma / rate * sin)
    } else if ratio == 1.0 {
        offset * libm::exp(-omega * t) * (1.0 + omega * t)
    } else {
        let root = omega * (ratio * ratio - 1.0).sqrt();
        let (slow, fast) = (omega * omega / (sigma + root), sigma + root);
        offset * (fast * libm::exp(-slow * t) - slow * libm::exp(-fast * t)) / (fast - slow)
    }
}

#[test]
fn a_free_spring_costs_a_few_events_however_stiff_and_damped() {
    for ratio in [0.0, 0.05, 1.0, 3.0] {
        let mut counts = Vec::new();
        for stiffness in [10.0, 1e3, 1e5, 1e7, 1e9] {
            let omega = (stiffness / 0.17_f64).sqrt();
            let damping = 2.0 * ratio * (stiffness * 0.17_f64).sqrt();
            // High above a bed, beside a ball that stands and one that rolls by, with weight.
            let sag = DVec3::Z * (9.81 / (omega * omega));
            let anchor = DVec3::new(0.3, 0.2, 3.0);
            let held = spring(anchor, stiffness, damping);
            let start = anchor - sag + DVec3::X * 0.01;
            let balls = [
                sprung(0, start, DVec3::ZERO, held),
                on_bed(1, 0.3, 0.2, DVec3::ZERO, DVec3::ZERO),
                on_bed(2, -0.5, -0.2, DVec3::X * 0.3, DVec3::ZERO),
            ];
            let mut world = world(pool(), &balls, &exact());
            run(&mut world, 4.0);
            let offset = (state(&world, 0).position - anchor + sag).x;
            let expected = textbook(omega, ratio, 0.01, 4.0);
            assert!((offset - expected).abs() < 1e-11, "{stiffness} {ratio}: {offset} {expected}");
            counts.push(world.work().events);
        }
        // Those of the rolling ball, and the ends of what dies away.
        assert!(counts.iter().all(|events| *events <= 8), "{ratio}: {counts:?}");
    }
}

#[test]
fn a_damped_spring_comes_to_rest_where_its_forces_balance() {
    for ratio in [0.01, 1.0, 3.0] {
        for stiffness in [10.0, 1e5, 1e9] {
            let held = Spring {
                angular_stiffness_nm_rad: 0.1,
                angular_damping_nms_rad: 1e-4,
                ..spring(DVec3::Z, stiffness, 2.0 * ratio * (stiffness * 0.17_f64).sqrt())
            };
            let balls = [sprung(0, DVec3::new(0.02, 0.0, 1.0), DVec3::Y * 0.1, held)];
            let mut world = world(&Table::plane(), &balls, &exact());
            run(&mut world, 600.0);
            let rest = DVec3::Z * (1.0 - 9.81 * 0.17 / stiffness);
            let off = state(&world, 0).position.distance(rest);
            assert!(world.is_still() && off < 1e-9, "{ratio} {stiffness}: {off}");
            assert!(world.work().events < 12, "{:?}", world.work());
        }
    }
}

#[test]
fn without_a_linear_spring_the_others_act_all_the_same() {
    // An angular spring alone: the ball flies, and turns to and fro.
    let alone = Spring { angular_stiffness_nm_rad: 0.01, ..Spring::default() };
    // A damper alone: v falls by d/m, and weight pulls it down at m g/d in the end.
    let damper = Spring { damping_ns_m: 0.5, ..Spring::default() };
    let (mut turning, mut falling) =
        (sprung(0, DVec3::Z, DVec3::X, alone), sprung(1, DVec3::Y, DVec3::X, damper));
    turning.1.angular_velocity = DVec3::Z * 0.5;
    falling.1.angular_velocity = DVec3::Z;
    let mut world = world(&Table::default(), &[turning, falling], &exact());
    run(&mut world, 2.0);
    let (turning, falling) = (state(&world, 0), state(&world, 1));
    let expected = DVec3::new(2.0, 0.0, 1.0 - 0.5 * 9.81 * 4.0);
    assert!((turning.position - expected).length() < 1e-12, "{}", turning.position);
    let omega = (0.01 / (0.4 * 0.17 * R * R)).sqrt();
    let spin = 0.5 * libm::cos(omega * 2.0);
    assert!((turning.angular_velocity.z - spin).abs() < 1e-9, "{}", turning.angular_velocity);
    let (rate, end) = (0.5 / 0.17, 9.81 * 0.17 / 0.5);
    let gone = -libm::expm1(-rate * 2.0) / rate;
    let expected = DVec3::new(gone, 1.0, -end * (2.0 - gone));
    assert!((falling.position - expected).length() < 1e-12, "{}", falling.position);
}

#[test]
fn a_swing_that_reaches_a_wall_meets_it_when_it_gets_there() {
    // Let go at rest, a quarter of a period and the angle whose sine is the share of the way.
    for stiffness in [10.0, 1e4, 1e9] {
        let held = spring(DVec3::Z, stiffness, 0.0);
        let balls = [sprung(0, DVec3::new(0.02, 0.0, 1.0), DVec3::ZERO, held)];
        let wall =
            Plane { point: DVec3::X * (-0.01 - R), normal: DVec3::X, surface: Surface::Obstacle };
        let mut table = Table::default();
        table.planes.push(wall);
        let mut world = with(&table, &balls, &exact(), |parameters| {
            parameters.gravity_m_s2 = 0.0;
            parameters.obstacle = Contact { restitution: 1.0, friction: 0.0 };
        });
        let omega = (stiffness / 0.17_f64).sqrt();
        let meets = (0.5 * std::f64::consts::PI + libm::asin(0.5)) / omega;
        run(&mut world, meets * (1.0 - 1e-9));
        assert_eq!(world.work().contacts, 0, "{stiffness}");
        run(&mut world, meets * (1.0 + 1e-9));
        assert_eq!(world.work().contacts, 1, "{stiffness}");
        // Lossless it is where it began after twice that.
        run(&mut world, 2.0 * meets);
        let off = state(&world, 0).position.distance(DVec3::new(0.02, 0.0, 1.0));
        assert!(off < 1e-9, "{stiffness}: {off}");
    }
}

#[test]
fn a_ball_that_comes_through_the_reach_of_a_swing_meets_the_ball_on_it() {
    // The stepper, as fine as it takes, says where and when they meet.
    for stiffness in [10.0, 1e3, 1e5] {
        let scene = |settings: &PhysicsSettings| {
            let held = spring(DVec3::ZERO, stiffness, 0.2);
            let balls = [
                sprung(0, DVec3::new(0.0, 0.05, 0.0), DVec3::ZERO, held),
                ball(1, DVec3::new(-0.5, 0.02, 0.0), DVec3::X, DVec3::ZERO),
            ];
            let mut world = with(&Table::default(), &balls, settings, |parameters| {
                parameters.gravity_m_s2 = 0.0;
            });
            run(&mut world, 0.55);
            (state(&world, 1).velocity, world.ledger())
        };
        let (found, ledger) = scene(&exact());
        let fine = PhysicsSettings { integrator: Integrator::Rk4, ..step(0.002) };
        let (expected, _) = scene(&fine);
        assert!((found - DVec3::X).length() > 0.1, "{stiffness}: they meet");
        let off = found.distance(expected);
        assert!(off < 2e-3, "{stiffness}: {found} {expected}");
        assert!(ledger.residual_j.abs() < 1e-12, "{stiffness}: {}", ledger.residual_j);
    }
}

#[test]
fn a_stiff_spring_that_presses_a_ball_against_a_wall_or_a_ball_comes_to_rest() {
    for stiffness in [1e2, 1e5, 1e9] {
        let held = spring(DVec3::X * 0.001, stiffness, 0.1 * (stiffness * 0.17_f64).sqrt());
        let wall = Plane { point: DVec3::X * R, normal: DVec3::NEG_X, surface: Surface::Obstacle };
        let mut table = Table::default();
        table.planes.push(wall);
        let balls = [sprung(0, DVec3::X * -0.002, DVec3::ZERO, held)];
        let mut world = with(&table, &balls, &exact(), |parameters| parameters.gravity_m_s2 = 0.0);
        run(&mut world, 3.0);
        let end = state(&world, 0);
        assert!(end.position.length() < 1e-6, "{stiffness}: {}", end.position);
        assert!(end.velocity.length() < 1e-3, "{stiffness}: {}", end.velocity);
    }
}
