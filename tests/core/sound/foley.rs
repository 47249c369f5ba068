//! What facts and snapshots sound like.

use glam::{DVec3, Vec3};
use hapticbillard::ball::{BallState, Motion, POOL_RADIUS_M};
use hapticbillard::cue::CuePose;
use hapticbillard::events::{Fact, FactKind, FactSet, Topic};
use hapticbillard::ids::{BallId, PocketId};
use hapticbillard::physics::{Simulation, Snapshot, Strike};
use hapticbillard::rack::Rack;
use hapticbillard::sound::{Foley, SoundClass};
use hapticbillard::table::Table;
use std::sync::Arc;

const R: f64 = POOL_RADIUS_M;
const G: f64 = 9.81;

fn ball(id: u16, position: DVec3, velocity: DVec3, motion: Motion) -> BallState {
    BallState { velocity, motion, ..BallState::at_rest(BallId(id), position) }
}

fn world(time_s: f64, balls: Vec<BallState>) -> Arc<Snapshot> {
    Arc::new(Snapshot { time_s, balls, cue: None })
}

fn foley(first: &Arc<Snapshot>) -> Foley {
    Foley::new([(BallId(0), R), (BallId(1), R)], G, 1, first.clone())
}

#[test]
fn the_line_of_a_click_goes_through_both_centres_also_a_millisecond_away() {
    // The cue ball comes along +x at 9 m/s and meets the other half full at t = 1.0004 s.
    let (target, way) = (DVec3::new(0.0, 0.0, R), DVec3::X * 9.0);
    let axis = DVec3::new(0.75_f64.sqrt(), 0.5, 0.0);
    let met = target - axis * (2.0 * R);
    let before = world(
        1.0,
        vec![
            ball(0, met - way * 0.0004, way, Motion::Sliding),
            ball(1, target, DVec3::ZERO, Motion::Rest),
        ],
    );
    let leaves = axis * (9.0 * 0.75_f64.sqrt());
    let after = world(
        1.001,
        vec![
            ball(0, met + (way - leaves) * 0.0006, way - leaves, Motion::Sliding),
            ball(1, target + leaves * 0.0006, leaves, Motion::Sliding),
        ],
    );
    let fact = Fact {
        time_s: 1.0004,
        kind: FactKind::BallsCollided {
            a: BallId(0),
            b: BallId(1),
            in_kitchen: false,
            position_m: target - axis * R,
            normal_speed_m_s: leaves.length(),
        },
    };
    for after in [Some(&*after), None] {
        let onset = foley(&before).hear(&fact, after).unwrap();
        assert_eq!((onset.class, onset.time_s), (SoundClass::BallClick, 1.0004));
        assert!((onset.axis - axis.as_vec3()).length() < 1e-4, "{:?}", onset.axis);
        assert_eq!(onset.speed_m_s, leaves.length() as f32);
    }
    // The one before is useless where the ball was elsewhere a moment ago.
    let other = world(1.0, vec![ball(0, DVec3::ONE, -way, Motion::Rolling)]);
    let onset = foley(&other).hear(&fact, Some(&after)).unwrap();
    assert!((onset.axis - axis.as_vec3()).length() < 1e-4, "{:?}", onset.axis);
}

#[test]
fn a_ball_that_hopped_is_heard_to_land_where_and_when_it_does() {
    // Thrown up at 0.5 m/s: it is back after 2 v / g.
    let up = DVec3::new(1.0, 0.0, 0.5);
    let first = world(2.0, vec![ball(0, DVec3::Z * R, up, Motion::Airborne)]);
    let mut foley = foley(&first);
    let back_s = 2.0 + 2.0 * 0.5 / G;
    let mut landings = Vec::new();
    for ms in 1..200 {
        let time_s = 2.0 + f64::from(ms) * 1e-3;
        let t = time_s - 2.0;
        let seen = if time_s < back_s {
            let fall = DVec3::NEG_Z * G;
            let position = DVec3::Z * R + up * t + fall * (0.5 * t * t);
            ball(0, position, up + fall * t, Motion::Airborne)
        } else {
            ball(0, DVec3::new(t, 0.0, R), DVec3::X, Motion::Sliding)
        };
        landings.extend(foley.see(&world(time_s, vec![seen])).0);
    }
    let [landing] = landings[..] else { panic!("{landings:?}") };
    assert_eq!(landing.class, SoundClass::Landing);
    assert!((landing.time_s - back_s).abs() < 1e-9 && (landing.speed_m_s - 0.5).abs() < 1e-6);
    assert!((landing.position_m - Vec3::X * (2.0 * 0.5 / G) as f32).length() < 1e-6);
}

#[test]
fn balls_roll_until_they_stop_and_slide_by_their_lowest_point() {
    let first = world(0.0, vec![BallState::at_rest(BallId(0), DVec3::Z * R)]);
    let mut foley = foley(&first);
    let mut sliding = ball(0, DVec3::Z * R, DVec3::X * 2.0, Motion::Sliding);
    sliding.angular_velocity = DVec3::Y * (1.5 / R);
    let (_, rolling) = foley.see(&world(0.1, vec![sliding]));
    assert!((rolling[0].slip_m_s - 0.5).abs() < 1e-5);
    let mut rolls = ball(0, DVec3::Z * R, DVec3::X * 2.0, Motion::Rolling);
    rolls.angular_velocity = DVec3::Y * (2.0 / R);
    assert_eq!(foley.see(&world(0.2, vec![rolls])).1[0].slip_m_s, 0.0);
    let lies = world(0.3, vec![BallState::at_rest(BallId(0), DVec3::Z * R)]);
    assert_eq!(foley.see(&lies).1[0].velocity_m_s, Vec3::ZERO);
    // It is told once, and an old snapshot says nothing.
    assert!(foley.see(&world(0.4, lies.balls.clone())).1.is_empty());
    assert!(foley.see(&world(0.2, vec![rolls])).1.is_empty());
}

#[test]
fn a_potted_ball_falls_and_then_runs_through_the_gully() {
    let first = world(1.0, vec![ball(1, DVec3::X, DVec3::Y, Motion::Rolling)]);
    let mut foley = foley(&first);
    let kind = FactKind::BallPocketed { ball: BallId(1), pocket: PocketId::ALL[2], speed_m_s: 1.5 };
    let onset = foley.hear(&Fact { time_s: 1.001, kind }, None).unwrap();
    assert_eq!((onset.class, onset.position_m), (SoundClass::Pocket, Vec3::X));
    let mut later = Vec::new();
    for ms in 2..1000 {
        later.extend(foley.see(&world(1.0 + f64::from(ms) * 1e-3, Vec::new())).0);
    }
    assert_eq!(later.iter().map(|onset| onset.class).collect::<Vec<_>>(), [SoundClass::Gully]);
    assert!(0.2 < later[0].time_s - 1.001 && later[0].time_s - 1.001 < 0.6);
}

#[test]
fn the_tip_is_chalked_before_about_every_other_shot_where_the_cue_is() {
    let cue = CuePose { tip: DVec3::Z, velocity: DVec3::ZERO, direction: DVec3::X, solid: false };
    let chalked = |cue: Option<CuePose>| {
        let at = |time_s| Arc::new(Snapshot { time_s, balls: Vec::new(), cue });
        let mut foley = foley(&at(0.0));
        let mut times = Vec::new();
        for shot in 1..=100 {
            let settled_s = 10.0 * f64::from(shot);
            let kind = FactKind::Settled { snookered: false, cue_in_rack: false };
            assert!(foley.hear(&Fact { time_s: settled_s, kind }, None).is_none());
            for onset in foley.see(&at(settled_s + 5.0)).0 {
                assert_eq!((onset.class, onset.position_m), (SoundClass::Chalk, Vec3::Z));
                times.push(onset.time_s - settled_s);
            }
        }
        times
    };
    let times = chalked(Some(cue));
    assert!((30..70).contains(&times.len()), "{}", times.len());
    assert!(times.iter().all(|after_s| (0.5..2.0).contains(after_s)));
    assert!(chalked(None).is_empty());
}

#[test]
fn whoever_subscribes_to_its_topics_misses_nothing() {
    let first = world(0.0, vec![BallState::at_rest(BallId(1), DVec3::Z * R)]);
    let (position_m, normal_speed_m_s) = (DVec3::ZERO, 1.0);
    let kinds = [
        FactKind::CueBallStruck {
            ball: BallId(1),
            push: false,
            moving: false,
            miscue: false,
            player: None,
            position_m,
            normal_speed_m_s,
        },
        FactKind::BallPocketed { ball: BallId(1), pocket: PocketId::ALL[0], speed_m_s: 1.0 },
        FactKind::BallOffTable { ball: BallId(1) },
        FactKind::HeadStringCrossed { ball: BallId(1) },
        FactKind::BallsFrozen { a: BallId(0), b: BallId(1) },
    ];
    for kind in kinds {
        let is_heard = foley(&first).hear(&Fact { time_s: 0.5, kind }, None).is_some();
        assert_eq!(is_heard, Foley::TOPICS.contains(kind.topic()), "{kind:?}");
    }
    // What is chalked after it has settled comes later.
    assert!(Foley::TOPICS.contains(Topic::Settled));
}

#[test]
fn a_tip_that_slips_is_told_and_sounds_otherwise() {
    let class = |side: f64| {
        let table = Table::preset("pool-9ft").unwrap();
        let start = Simulation::new(table, Rack::eight_ball(1)).unwrap();
        let first = Arc::new(start.snapshot(0.0));
        let strike = Strike { speed_m_s: 2.0, side_offset: side, ..Strike::CENTRE };
        let mut struck = start.strike(strike).unwrap();
        let mut facts = Vec::new();
        struck.advance(0.5, FactSet::NONE, &mut facts).unwrap();
        let is_tip = |fact: &&Fact| matches!(fact.kind, FactKind::CueBallStruck { .. });
        let fact = facts.iter().find(is_tip).unwrap();
        foley(&first).hear(fact, None).unwrap().class
    };
    assert_eq!(class(0.0), SoundClass::CueStrike);
    assert_eq!(class(0.4), SoundClass::CueStrike);
    assert_eq!(class(0.75), SoundClass::Miscue);
}

#[test]
fn the_same_fact_sounds_the_same_and_another_one_does_not() {
    let first = world(0.0, Vec::new());
    let fact = |time_s| {
        let kind = FactKind::CushionHit {
            ball: BallId(0),
            rail: hapticbillard::ids::Rail::Foot,
            onset: true,
            position_m: DVec3::X,
            normal_speed_m_s: 1.0,
        };
        Fact { time_s, kind }
    };
    let seed = |time_s| foley(&first).hear(&fact(time_s), None).unwrap().seed;
    assert_eq!(seed(1.0), seed(1.0));
    assert_ne!(seed(1.0), seed(1.000_000_1));
}

#[test]
fn a_ball_meets_the_floor_as_hard_as_it_falls_however_fast_it_flies_on() {
    let heard = |velocity: DVec3| {
        let first =
            world(1.0, vec![ball(1, DVec3::new(2.0, 0.0, -0.7), velocity, Motion::Airborne)]);
        let fact = Fact { time_s: 1.01, kind: FactKind::BallOffTable { ball: BallId(1) } };
        foley(&first).hear(&fact, None).unwrap()
    };
    let falls = heard(DVec3::new(5.0, 0.0, -3.0));
    assert_eq!((falls.class, falls.axis), (SoundClass::Floor, Vec3::NEG_Z));
    assert!((falls.speed_m_s - 3.0 - 0.0981).abs() < 1e-5, "{}", falls.speed_m_s);
    assert!((falls.position_m.x - 2.05).abs() < 1e-6);
    // One that is carried up by something else does not meet it.
    assert_eq!(heard(DVec3::new(5.0, 0.0, 1.0)).speed_m_s, 0.0);
}

#[test]
fn a_ball_that_no_snapshot_shows_falls_where_it_last_touched_something() {
    let first = world(0.0, Vec::new());
    let mut foley = foley(&first);
    let mut hear = |time_s, kind| foley.hear(&Fact { time_s, kind }, None).unwrap();
    let pocket = PocketId::ALL[2];
    let potted = |ball| FactKind::BallPocketed { ball: BallId(ball), pocket, speed_m_s: 1.5 };
    let middle = hear(0.5, potted(1));
    assert_eq!((middle.class, middle.position_m), (SoundClass::Pocket, Vec3::ZERO));
    for (time_s, x) in [(1.0, 0.25), (1.1, 0.75)] {
        let clicked = FactKind::BallsCollided {
            a: BallId(3),
            b: BallId(2),
            in_kitchen: false,
            position_m: DVec3::X * x,
            normal_speed_m_s: 1.0,
        };
        hear(time_s, clicked);
    }
    assert_eq!(hear(1.5, potted(2)).position_m, Vec3::X * 0.75);
    let floor = hear(1.6, FactKind::BallOffTable { ball: BallId(3) });
    assert_eq!((floor.class, floor.position_m), (SoundClass::Floor, Vec3::X * 0.75));
    assert!((3.0..5.0).contains(&floor.speed_m_s));
    // Both are still on their way through the gully.
    let rest = foley.rest();
    assert_eq!(rest.iter().map(|onset| onset.class).collect::<Vec<_>>(), [SoundClass::Gully; 2]);
    assert_eq!(rest[1].position_m, Vec3::X * 0.75);
}
