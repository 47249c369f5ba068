//! Balls on springs that meet something.

use super::exact;
use crate::physics::scenes::{R, ball, run, state, with, world};
use glam::{DQuat, DVec3};
use hapticbillard::ball::{Ball, BallState, Spring};
use hapticbillard::physics::Contact;
use hapticbillard::table::Table;

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
    for stiffness in [10.0, 1e3, 1e5] {
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
    for stiffness in [10.0, 1e3, 1e5, 1e7] {
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
        // Detection sees parabolas that are off by no more than 2e-7 m; so much it swings on.
        let swings_m = state(&world, 0).velocity.length() * (0.17_f64 / stiffness).sqrt();
        assert!(swings_m < 2e-7, "{stiffness}: {swings_m}");
        let ledger = world.ledger();
        assert!(ledger.residual_j.abs() < 1e-9, "{stiffness}: {}", ledger.residual_j);
    }
}
