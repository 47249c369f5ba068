//! What a real table does: jaws, lips, drops, jumps, balls that leave it.

use super::exact;
use crate::physics::scenes::{R, on_bed, pool, state, world};
use glam::{DVec2, DVec3};
use hapticbillard::ball::BallPlace;
use hapticbillard::events::{Fact, FactKind, FactSet};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Simulation, Strike};
use std::sync::OnceLock;

/// A ball shot from a place in a direction.
fn shot(from: DVec2, velocity: DVec3, spin: DVec3) -> (Simulation, Vec<Fact>) {
    let balls = [on_bed(0, from.x, from.y, velocity, spin)];
    static START: OnceLock<Simulation> = OnceLock::new();
    let start = START.get_or_init(|| world(pool(), &balls, &exact()));
    let mut simulation = start.with_balls(balls.to_vec()).unwrap();
    let mut facts = Vec::new();
    simulation.advance(60.0, FactSet::NONE, &mut facts).unwrap();
    assert!(simulation.is_still(), "{from} {velocity}");
    (simulation, facts)
}

fn corner() -> DVec2 {
    let pocket = pool().pockets.iter().find(|pocket| pocket.centre.min_element() > 0.3);
    pocket.unwrap().centre
}

#[test]
fn a_ball_rolled_at_a_pocket_drops_at_any_speed_that_reaches_it() {
    let pocket = pool().pockets.iter().find(|pocket| pocket.centre.min_element() > 0.3).unwrap();
    let way = pocket.heading;
    let start = 0.5 * (pocket.mouth[0] + pocket.mouth[1]) - 0.6 * way;
    for speed in [0.45, 0.6, 1.0, 2.0, 4.0] {
        let velocity = (way.normalize() * speed).extend(0.0);
        let spin = DVec3::Z.cross(velocity) / R;
        let (end, facts) = shot(start, velocity, spin);
        assert_eq!(state(&end, 0).place, BallPlace::Pocketed, "{speed} m/s");
        let told = facts.iter().any(|fact| matches!(fact.kind, FactKind::BallPocketed { .. }));
        assert!(told, "{speed} m/s");
    }
}

#[test]
fn between_stopping_short_and_dropping_a_ball_may_hang_on_the_lip() {
    // The slower ball stops on the bed, the faster one drops; the border is sharp, and around it
    // every ball comes to rest or drops: none hovers, none is lost.
    let start = DVec2::new(0.9, 0.35);
    let way = corner() - start;
    let run = |speed: f64| {
        let velocity = (way.normalize() * speed).extend(0.0);
        let (end, _) = shot(start, velocity, DVec3::Z.cross(velocity) / R);
        state(&end, 0)
    };
    let (mut stops, mut drops) = (0.05, 1.0);
    assert_eq!(run(stops).place, BallPlace::OnTable);
    assert_eq!(run(drops).place, BallPlace::Pocketed);
    while drops - stops > 1e-6 {
        let speed = 0.5 * (stops + drops);
        let end = run(speed);
        match end.place {
            BallPlace::OnTable => stops = speed,
            _ => drops = speed,
        }
        // Hanging: nearer to the pocket than a ball on the bed can be, hardly lower.
        assert!(end.place != BallPlace::OnTable || end.position.z > 0.9 * R, "{end:?}");
    }
    let hanging = run(stops);
    assert!(hanging.velocity == DVec3::ZERO && hanging.position.z > 0.98 * R, "{hanging:?}");
}

#[test]
fn a_ball_may_rattle_in_the_jaws_and_come_out() {
    // Along the rail into the far jaw: some of a fan of shots rattle and stay up.
    let (mut up, mut down) = (0, 0);
    for step in 0..40 {
        let start = DVec2::new(0.2, 0.56);
        let aim = corner() + DVec2::new(0.0, -0.05 + 0.002 * f64::from(step));
        let velocity = ((aim - start).normalize() * 3.0).extend(0.0);
        let (end, facts) = shot(start, velocity, DVec3::ZERO);
        let cushions = facts
            .iter()
            .filter(|fact| matches!(fact.kind, FactKind::CushionHit { .. }) && fact.time_s < 1.0)
            .count();
        match state(&end, 0).place {
            BallPlace::OnTable if cushions >= 2 => up += 1,
            BallPlace::Pocketed => down += 1,
            _ => {}
        }
    }
    assert!(up > 0 && down > 0, "{up} rattled out, {down} dropped");
}

#[test]
fn a_steep_stroke_jumps_over_a_ball_and_a_level_one_hits_it() {
    for (elevation_deg, jumps) in [(0.0, false), (45.0, true)] {
        let balls = [
            on_bed(0, -0.6, 0.0, DVec3::ZERO, DVec3::ZERO),
            on_bed(1, -0.42, 0.0, DVec3::ZERO, DVec3::ZERO),
        ];
        let strike = Strike { speed_m_s: 6.0, elevation_deg, ..Strike::CENTRE };
        let mut simulation = world(pool(), &balls, &exact()).strike(strike).unwrap();
        let mut facts = Vec::new();
        simulation.advance(0.25, FactSet::NONE, &mut facts).unwrap();
        let hit = facts.iter().any(|fact| matches!(fact.kind, FactKind::BallsCollided { .. }));
        assert_eq!(hit, !jumps, "{elevation_deg}");
        assert!(!jumps || state(&simulation, 0).position.x > -0.42, "{elevation_deg}");
    }
}

#[test]
fn a_ball_that_flies_over_the_rail_is_told_and_gone() {
    let velocity = DVec3::new(4.0, 0.3, 2.5);
    let (end, facts) = shot(DVec2::new(0.5, 0.0), velocity, DVec3::ZERO);
    assert_eq!(state(&end, 0).place, BallPlace::OffTable);
    let off = |fact: &&Fact| matches!(fact.kind, FactKind::BallOffTable { ball: BallId(0), .. });
    assert_eq!(facts.iter().filter(off).count(), 1);
}

#[test]
fn a_ball_that_lands_on_the_rail_stays_there_or_falls_on_a_side() {
    let mut places = std::collections::BTreeMap::new();
    for step in 0..60 {
        let velocity = DVec3::new(1.5 + 0.02 * f64::from(step), 0.0, 1.6);
        let (end, _) = shot(DVec2::new(0.75, 0.1), velocity, DVec3::ZERO);
        *places.entry(format!("{:?}", state(&end, 0).place)).or_insert(0) += 1;
    }
    assert!(places.len() >= 2, "{places:?}");
}
