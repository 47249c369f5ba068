//! How fast the error falls with the step.
//!
//! The forces between contacts are constant or smooth, so on a spring the finer integrators reach
//! their orders. With events all fall to first order: a ball that starts to roll or meets something
//! does so within a step, and what the step's force does before and after is not told apart.
//!
//! The error of a shot jumps with where in their steps its events lie: a single ratio of two errors
//! lies between a third and thrice its mean. Hence medians over many random shots. The reference is
//! the exact solver, which has no step.

use super::scenes::*;
use glam::DVec3;
use hapticbillard::ball::{Ball, BallFlags, BallPlace, BallState, Spring};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Integrator, PhysicsSettings, Simulation};
use hapticbillard::table::Table;

/// Where the balls are at `until`.
fn places(
    table: &Table,
    balls: &[(Ball, BallState)],
    settings: &PhysicsSettings,
    until: f64,
) -> Vec<DVec3> {
    let mut world: Simulation = world(table, balls, settings);
    run(&mut world, until);
    world.snapshot(until).balls.iter().map(|ball| ball.position).collect()
}

#[test]
fn the_error_of_one_ball_falls_to_a_tenth_with_the_step() {
    // From sliding to rolling on the endless cloth, until it stops: the end is known exactly.
    let mut numbers = Numbers(3);
    let mut ratios = Vec::new();
    for _ in 0..21 {
        let speed = numbers.between(0.5, 3.0);
        let start = on_bed(0, 0.0, 0.0, DVec3::X * speed, DVec3::ZERO);
        let exact = 12.0 / 49.0 * speed * speed / (0.2 * 9.81)
            + 25.0 / 49.0 * speed * speed / (2.0 * 0.01 * 9.81);
        let errors = [4.0, 0.4].map(|step_ms| {
            let balls = std::slice::from_ref(&start);
            let end = places(&Table::plane(), balls, &step(step_ms), 30.0)[0];
            (end.x - exact).abs()
        });
        ratios.push(errors[1] / errors[0]);
    }
    let ratio = median(ratios.clone());
    assert!((0.08..=0.12).contains(&ratio), "{ratio}: {ratios:?}");
}

/// A ball with any spin, sent to meet cushions.
fn one_ball(numbers: &mut Numbers) -> Vec<(Ball, BallState)> {
    let spin = numbers.vector(80.0);
    let velocity = DVec3::new(numbers.between(1.0, 2.5), numbers.between(-1.5, 1.5), 0.0);
    vec![on_bed(0, numbers.between(-0.6, 0.0), numbers.between(-0.3, 0.3), velocity, spin)]
}

/// A cut shot of one ball at another, both free to meet cushions and each other again.
fn two_balls(numbers: &mut Numbers) -> Vec<(Ball, BallState)> {
    let (x, y) = (numbers.between(0.0, 0.3), numbers.between(-0.04, 0.04));
    let (speed, spin) = (numbers.between(1.5, 3.5), numbers.between(-60.0, 100.0));
    vec![
        on_bed(0, -0.4, 0.0, DVec3::X * speed, DVec3::Y * spin),
        on_bed(1, x, y, DVec3::ZERO, DVec3::ZERO),
    ]
}

/// Over some shots, the median of what is left of the error at rest, that of the worst ball, when
/// the step falls from 4 ms to a tenth.
fn left_of_the_error(
    integrator: Integrator,
    shots: usize,
    make: fn(&mut Numbers) -> Vec<(Ball, BallState)>,
) -> f64 {
    // In the slow run on the pool table itself, without the shots that lose a ball in a pocket.
    let (noses, shots) = (between_noses(), if slow() { 4 * shots } else { shots });
    let table = if slow() { pool() } else { &noses };
    let end = |balls: &[(Ball, BallState)], settings: &PhysicsSettings| {
        let mut world = world(table, balls, settings);
        run(&mut world, 60.0);
        assert!(world.is_still(), "{settings:?}");
        world.snapshot(60.0).balls
    };
    let mut numbers = Numbers(11);
    let mut ratios = Vec::new();
    while ratios.len() < shots {
        let balls = make(&mut numbers);
        let reference = end(&balls, &exact());
        if reference.iter().any(|ball| ball.place != BallPlace::OnTable) {
            continue;
        }
        let [coarse, fine] = [4.0, 0.4].map(|step_ms| {
            let settings = PhysicsSettings { integrator, ..step(step_ms) };
            let balls = end(&balls, &settings);
            let off = balls.iter().zip(&reference).map(|(a, b)| a.position.distance(b.position));
            off.fold(0.0, f64::max)
        });
        ratios.push(fine / coarse);
    }
    median(ratios)
}

#[test]
fn so_does_that_of_a_ball_with_spin_between_cushions() {
    for integrator in INTEGRATORS {
        let ratio = left_of_the_error(integrator, 61, one_ball);
        assert!((0.08..=0.12).contains(&ratio), "{integrator:?}: {ratio}");
    }
}

#[test]
fn two_balls_converge_with_first_order_whatever_the_integrator() {
    for integrator in INTEGRATORS {
        let order = -libm::log10(left_of_the_error(integrator, 61, two_balls));
        assert!((0.9..1.3).contains(&order), "{integrator:?}: {order}");
    }
}

/// Position of a ball on a damped spring after 1 s, in the air.
fn on_spring(integrator: Integrator, step_ms: f64) -> DVec3 {
    let spring = Spring {
        anchor_m: DVec3::new(0.1, -0.2, 1.0),
        stiffness_n_m: 30.0,
        damping_ns_m: 0.05,
        ..Spring::default()
    };
    let start = DVec3::new(0.3, 0.0, 1.1);
    let (held, state) = ball(0, start, DVec3::new(0.5, 1.0, -0.4), DVec3::ZERO);
    let flags = BallFlags { gravity: false, ..BallFlags::default() };
    let held = Ball { spring: Some(spring), flags, ..held };
    let settings = PhysicsSettings { integrator, ..step(step_ms) };
    let mut world = world(&Table::plane(), &[(held, state)], &settings);
    run(&mut world, 1.0);
    world.sample(BallId(0), 1.0).unwrap().position
}

#[test]
fn on_a_spring_every_integrator_has_its_own_order() {
    // x″ = −ω² x − 2 ζ ω x′, the closed form.
    let (stiffness, mass, damping) = (30.0_f64, 0.17, 0.05);
    let (omega, sigma) = ((stiffness / mass).sqrt(), damping / (2.0 * mass));
    let rate = (omega * omega - sigma * sigma).sqrt();
    let (x, v) = (DVec3::new(0.2, 0.2, 0.1), DVec3::new(0.5, 1.0, -0.4));
    let (sin, cos) = libm::sincos(rate);
    let decay = libm::exp(-sigma);
    let exact = DVec3::new(0.1, -0.2, 1.0) + decay * (x * cos + (v + sigma * x) / rate * sin);
    for (integrator, order) in [
        (Integrator::EulerCromer, 1.0),
        (Integrator::Verlet, 2.0),
        (Integrator::PositionVerlet, 2.0),
        (Integrator::Rk4, 4.0),
    ] {
        let errors = [4.0, 2.0].map(|h| on_spring(integrator, h).distance(exact));
        let observed = libm::log2(errors[0] / errors[1]);
        assert!((observed - order).abs() < 0.2, "{integrator:?}: {observed} {errors:?}");
    }
}

#[test]
fn in_free_flight_euler_cromer_falls_too_far_and_the_others_are_exact() {
    let fall = |integrator| {
        let start = ball(0, DVec3::Z * 2.0, DVec3::X, DVec3::ZERO);
        let settings = PhysicsSettings { integrator, ..step(4.0) };
        places(&Table::plane(), &[start], &settings, 0.4)[0]
    };
    let exact = DVec3::new(0.4, 0.0, 2.0 - 0.5 * 9.81 * 0.16);
    let late = 0.5 * 9.81 * 0.004 * 0.4;
    assert!((fall(Integrator::EulerCromer) - exact + DVec3::Z * late).length() < 1e-12);
    assert!((fall(Integrator::Verlet) - exact).length() < 1e-12);
    assert!((fall(Integrator::PositionVerlet) - exact).length() < 1e-12);
    assert!((fall(Integrator::Rk4) - exact).length() < 1e-12);
}
