//! Commands in the middle of a shot: a hand on the table, a stroke while balls roll.

use super::exact;
use crate::physics::scenes::{R, digest, on_bed, pool, state, world};
use glam::{DVec2, DVec3};
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::events::{Command, Fact, FactKind, FactSet, Zone};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Simulation, Strike};
use std::sync::Arc;

/// Three balls in motion far from each other, and one that stands.
fn scene() -> Vec<(Ball, BallState)> {
    vec![
        on_bed(0, -1.0, -0.4, DVec3::new(0.8, 0.1, 0.0), DVec3::ZERO),
        on_bed(1, -0.2, 0.2, DVec3::new(0.5, -0.2, 0.0), DVec3::ZERO),
        on_bed(2, 0.5, -0.2, DVec3::new(0.1, 0.6, 0.0), DVec3::new(0.0, 0.0, 40.0)),
        on_bed(3, 1.0, 0.4, DVec3::ZERO, DVec3::ZERO),
    ]
}

fn advance(simulation: &mut Simulation, until: f64) -> Vec<Fact> {
    let mut facts = Vec::new();
    simulation.advance(until, FactSet::NONE, &mut facts).unwrap();
    facts
}

#[test]
fn a_hand_takes_one_ball_and_the_others_go_on_bit_by_bit() {
    let (at, until) = (0.234_5, 1.0);
    let undisturbed = {
        let mut simulation = world(pool(), &scene(), &exact());
        advance(&mut simulation, until);
        simulation
    };
    let mut simulation = world(pool(), &scene(), &exact());
    advance(&mut simulation, at);
    let before = simulation.work();
    let place = DVec2::new(1.0, -0.4);
    let command = Command::PlaceBall { ball: BallId(3), position_m: place, zone: Zone::Anywhere };
    simulation.apply(at, &command).unwrap();
    let facts = advance(&mut simulation, at);
    // Only what the hand touched is predicted again: three pairs with the others.
    let spent = simulation.work().pair_tests - before.pair_tests;
    assert!(spent <= 3, "{spent}");
    let touched = |fact: &&Fact| matches!(fact.kind, FactKind::BallTouched { .. });
    assert_eq!(facts.iter().filter(touched).count(), 1, "{facts:?}");
    advance(&mut simulation, until);
    assert_eq!(state(&simulation, 3).position, place.extend(R));
    for id in 0..3 {
        assert_eq!(state(&simulation, id), state(&undisturbed, id));
    }
}

#[test]
fn a_hand_may_take_a_moving_ball_out_of_the_shot() {
    let mut simulation = world(pool(), &scene(), &exact());
    let place = DVec2::new(-0.9, 0.4);
    let command = Command::PlaceBall { ball: BallId(0), position_m: place, zone: Zone::Anywhere };
    simulation.apply(0.3, &command).unwrap();
    advance(&mut simulation, 0.3);
    assert_eq!(state(&simulation, 0).position, place.extend(R));
    assert_eq!(state(&simulation, 0).velocity, DVec3::ZERO);
    advance(&mut simulation, 60.0);
    assert!(simulation.is_still());
    let ledger = simulation.ledger();
    assert!(ledger.residual_j.abs() < 1e-12, "{}", ledger.residual_j);
}

#[test]
fn a_stroke_while_balls_roll_strikes_and_says_so() {
    let balls = [
        on_bed(0, -0.6, 0.0, DVec3::ZERO, DVec3::ZERO),
        on_bed(1, 0.0, 0.3, DVec3::new(0.6, 0.1, 0.0), DVec3::ZERO),
    ];
    let mut simulation = world(pool(), &balls, &exact());
    advance(&mut simulation, 0.5);
    let radius = exact_tip_radius();
    let ball = state(&simulation, 0).position;
    let path = Strike { speed_m_s: 2.0, ..Strike::CENTRE }.path(ball, R, radius, 0.5).unwrap();
    simulation.apply(0.5, &Command::MoveCue(Arc::new(path))).unwrap();
    let facts = advance(&mut simulation, 1.0);
    let struck = facts.iter().find_map(|fact| match fact.kind {
        FactKind::CueBallStruck { moving, .. } => Some(moving),
        _ => None,
    });
    assert_eq!(struck, Some(true));
    assert!(state(&simulation, 0).velocity.x > 1.0);
}

fn exact_tip_radius() -> f64 {
    hapticbillard::physics::Parameters::of(&exact()).tip_radius_m
}

#[test]
fn a_following_tip_hits_a_second_time_only_a_ball_that_stopped_before_it() {
    let strokes = |gap: f64| {
        let balls = [
            on_bed(0, -0.6, 0.0, DVec3::ZERO, DVec3::ZERO),
            on_bed(1, -0.6 + 2.0 * R + gap, 0.0, DVec3::ZERO, DVec3::ZERO),
        ];
        let strike = Strike { speed_m_s: 2.0, ..Strike::CENTRE };
        let mut simulation = world(pool(), &balls, &exact()).strike(strike).unwrap();
        let facts = advance(&mut simulation, 0.5);
        facts.iter().filter(|fact| matches!(fact.kind, FactKind::CueBallStruck { .. })).count()
    };
    assert_eq!(strokes(0.3), 1);
    assert_eq!(strokes(0.01), 2);
}

#[test]
fn the_same_commands_give_the_same_bits() {
    let run = || {
        let mut simulation = world(pool(), &scene(), &exact());
        for (at, x) in [(0.1, 0.0), (0.25, 0.3), (0.4, -0.3)] {
            let position_m = DVec2::new(x, 0.5);
            let command = Command::PlaceBall { ball: BallId(3), position_m, zone: Zone::Anywhere };
            simulation.apply(at, &command).unwrap();
        }
        advance(&mut simulation, 30.0);
        digest(&simulation)
    };
    assert_eq!(run(), run());
}
