//! The laws that a scene chooses act in a simulation.

use crate::physics::scenes::*;
use glam::DVec3;
use hapticbillard::ids::Rail;
use hapticbillard::mesh::Surface;
use hapticbillard::physics::laws::speed_friction::FrictionCurve;
use hapticbillard::physics::{BallLaw, CushionLaw, MultiContact, PhysicsSettings};
use hapticbillard::table::{Plane, Table};

/// The bed, with a cushion at x = 1 m that is as high as a ball's centre.
fn walled() -> Table {
    let mut table = Table::plane();
    let (point, normal) = (DVec3::X, DVec3::NEG_X);
    table.planes.push(Plane { point, normal, surface: Surface::Cushion(Rail::Foot) });
    table
}

/// Angle of the object ball from the line of centres after a stun shot at 30° [rad].
fn throw(speed: f64, law: BallLaw) -> f64 {
    let line = DVec3::new(0.75_f64.sqrt(), 0.5, 0.0);
    let object = line * (2.0 * R) + DVec3::X * 1e-6;
    let settings = PhysicsSettings { ball_law: law, ..step(1.0) };
    let balls = [
        on_bed(0, 0.0, 0.0, DVec3::X * speed, DVec3::ZERO),
        on_bed(1, object.x, object.y, DVec3::ZERO, DVec3::ZERO),
    ];
    let mut world = world(&Table::plane(), &balls, &settings);
    run(&mut world, 0.002);
    let velocity = state(&world, 1).velocity;
    libm::atan2(line.x * velocity.y - line.y * velocity.x, line.dot(velocity)).abs()
}

#[test]
fn slow_shots_are_thrown_farther_where_friction_depends_on_the_slip() {
    for speed in [0.8, 4.0] {
        let friction = FrictionCurve::ALCIATORE.at(speed * 0.5);
        let expected = libm::atan(friction.min(libm::tan(core::f64::consts::PI / 6.0) / 7.0));
        let seen = throw(speed, BallLaw::SpeedDependent);
        assert!((seen / expected - 1.0).abs() < 0.02, "{speed}: {seen} {expected}");
        let constant = throw(speed, BallLaw::Coulomb);
        assert!((constant / libm::atan(0.05) - 1.0).abs() < 0.02, "{constant}");
    }
}

#[test]
fn the_published_pair_model_differs_from_coulombs_by_little() {
    let (plain, full) = (throw(1.5, BallLaw::Coulomb), throw(1.5, BallLaw::Mathavan2014));
    assert!(plain != full && (full / plain - 1.0).abs() < 0.02, "{plain} {full}");
}

#[test]
fn the_cushion_law_of_the_scene_decides_how_fast_a_ball_comes_back() {
    let back = |law: CushionLaw, speed: f64| {
        let settings = PhysicsSettings { cushion_law: law, ..step(1.0) };
        let x = 1.0 - R - 0.0005 * speed;
        let ball = [on_bed(0, x, 0.0, DVec3::X * speed, DVec3::Y * (speed / R))];
        let mut world = world(&walled(), &ball, &settings);
        run(&mut world, 0.001);
        -state(&world, 0).velocity.x / speed
    };
    // Without side spin only the bed's part of friction comes on top of the restitution.
    assert!((back(CushionLaw::Combined, 1.0) - 0.85).abs() < 0.01);
    assert!((back(CushionLaw::Han2005, 1.0) - 0.603).abs() < 0.01);
    assert!((back(CushionLaw::Han2005, 2.0) - 0.728).abs() < 0.01);
    let published = back(CushionLaw::Mathavan2010, 1.0);
    assert!(0.9 < published && published < 1.0, "{published}");
}

#[test]
fn one_after_the_other_breaks_the_mirror_that_rounds_and_hertz_keep() {
    let sideways = |rule: MultiContact| {
        let settings = PhysicsSettings { multi_contact: rule, ..step(1.0) };
        let x = 2.0 * R * 0.75_f64.sqrt() + 0.001;
        let balls = [
            on_bed(0, 0.0, 0.0, DVec3::X * 3.0, DVec3::ZERO),
            on_bed(1, x, R, DVec3::ZERO, DVec3::ZERO),
            on_bed(2, x, -R, DVec3::ZERO, DVec3::ZERO),
        ];
        let mut world = world(&Table::plane(), &balls, &settings);
        run(&mut world, 0.002);
        let residual = world.ledger().residual_j.abs();
        assert!(residual < 1e-12, "{rule:?}: {residual}");
        state(&world, 0).velocity
    };
    for rule in [MultiContact::Rounds, MultiContact::Hertz] {
        let cue = sideways(rule);
        assert!(cue.y.abs() < 1e-12 && (cue.x + 0.5).abs() < 0.03, "{rule:?}: {cue}");
    }
    let cue = sideways(MultiContact::Pairwise);
    assert!(cue.y.abs() > 0.1, "{cue}");
}
