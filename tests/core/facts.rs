//! What physics tells the rules, each fact against shots made for it, by both solvers: a shot that
//! must tell it, and its neighbour that must not.

use crate::physics::scenes::{R, ball, exact, on_bed, pool, state, stepping, world};
use glam::{DVec2, DVec3};
use hapticbillard::ai::Stroke;
use hapticbillard::ball::{Ball, BallPlace, BallState};
use hapticbillard::cue::Aim;
use hapticbillard::events::{Command, Fact, FactKind, FactSet, TouchedBy, Zone};
use hapticbillard::ids::{BallId, Rail};
use hapticbillard::physics::{PhysicsSettings, Simulation};

const ONE: BallId = BallId(1);

/// Where the middle of a ball is that touches the left rail [m]: the nose lies above it.
fn rail_y() -> f64 {
    let above = 2.0 * R * 0.635 - R;
    0.635 - (R * R - above * above).sqrt()
}

fn solvers() -> [(&'static str, PhysicsSettings); 2] {
    [("event-driven", exact()), ("fixed-step", stepping())]
}

/// A ball at rest.
fn lies(id: u16, x: f64, y: f64) -> (Ball, BallState) {
    on_bed(id, x, y, DVec3::ZERO, DVec3::ZERO)
}

/// A ball that rolls.
fn rolls(id: u16, x: f64, y: f64, velocity: DVec3) -> (Ball, BallState) {
    on_bed(id, x, y, velocity, DVec3::Z.cross(velocity) / R)
}

/// A level player's stroke at the cue ball, with its follow-through.
fn stroke(simulation: &mut Simulation, aim: Aim, speed_m_s: f64) {
    let centre = state(simulation, 0).position;
    let now = simulation.now_s();
    let path = Stroke::at_ball(aim, centre, R, speed_m_s).path(now + 0.01);
    let lift_s = path.end_s().unwrap();
    simulation.apply(now, &Command::MoveCue(path.into())).unwrap();
    simulation.apply(lift_s, &Command::LiftCue).unwrap();
}

/// Runs until everything has settled.
fn play_out(simulation: &mut Simulation) -> Vec<Fact> {
    let mut facts = Vec::new();
    simulation.advance(simulation.now_s() + 60.0, FactSet::NONE, &mut facts).unwrap();
    assert!(simulation.is_still());
    facts
}

/// A stroke at these balls, and what was told of it.
fn struck(
    settings: &PhysicsSettings,
    balls: &[(Ball, BallState)],
    aim: Aim,
    speed_m_s: f64,
) -> Vec<Fact> {
    let mut simulation = world(pool(), balls, settings);
    stroke(&mut simulation, aim, speed_m_s);
    play_out(&mut simulation)
}

/// Balls that are on their way, and what was told of them.
fn told(settings: &PhysicsSettings, balls: &[(Ball, BallState)]) -> (Simulation, Vec<Fact>) {
    let mut simulation = world(pool(), balls, settings);
    let facts = play_out(&mut simulation);
    (simulation, facts)
}

fn level() -> Aim {
    Aim { elevation_rad: 0.06, ..Aim::default() }
}

/// The contacts of the tip with the cue ball: whether each was a push.
fn tips(facts: &[Fact]) -> Vec<bool> {
    let push = |fact: &Fact| match fact.kind {
        FactKind::CueBallStruck { push, ball: BallId::CUE, .. } => Some(push),
        _ => None,
    };
    facts.iter().filter_map(push).collect()
}

/// The first meeting of a ball with a rail, and whether it was driven there.
fn onsets(facts: &[Fact], id: u16, rail: Rail) -> Vec<bool> {
    let onset = |fact: &Fact| match fact.kind {
        FactKind::CushionHit { ball, rail: at, onset, .. } if ball.0 == id && at == rail => {
            Some(onset)
        }
        _ => None,
    };
    facts.iter().filter_map(onset).collect()
}

fn pocketed(facts: &[Fact]) -> usize {
    let down = |fact: &&Fact| matches!(fact.kind, FactKind::BallPocketed { ball: ONE, .. });
    facts.iter().filter(down).count()
}

fn touched(facts: &[Fact]) -> Vec<(u16, TouchedBy)> {
    let touched = |fact: &Fact| match fact.kind {
        FactKind::BallTouched { ball, by } => Some((ball.0, by)),
        _ => None,
    };
    facts.iter().filter_map(touched).collect()
}

/// A cue ball at 1.3 times the tip's 2 m/s comes 2.6 mm far while the tip is on it.
#[test]
fn a_ball_met_while_the_tip_is_on_the_cue_ball_is_pushed() {
    for (name, settings) in solvers() {
        for (gap_mm, push) in [(0.0, false), (0.15, true), (1.0, true), (2.0, true), (5.0, false)] {
            let balls = [lies(0, -0.3, 0.0), lies(1, -0.3 + 2.0 * R + 1e-3 * gap_mm, 0.0)];
            let facts = struck(&settings, &balls, level(), 2.0);
            assert_eq!(tips(&facts)[0], push, "{name}: {gap_mm} mm");
        }
    }
}

#[test]
fn a_thin_cut_of_a_near_ball_is_no_push_if_it_comes_late() {
    for (name, settings) in solvers() {
        // 1 mm of room, but 60 degrees off the line: the cue ball has twice the way.
        let way = (2.0 * R + 3e-3) * DVec2::new(0.5, 0.75_f64.sqrt());
        let balls = [lies(0, -0.3, 0.0), lies(1, -0.3 + way.x, way.y)];
        let facts = struck(&settings, &balls, level(), 2.0);
        assert!(!tips(&facts)[0], "{name}");
    }
}

#[test]
fn a_tip_that_follows_a_stopped_ball_strikes_it_again() {
    for (name, settings) in solvers() {
        for (gap_mm, again) in [(10.0, true), (20.0, true), (200.0, false)] {
            let balls = [lies(0, -0.3, 0.0), lies(1, -0.3 + 2.0 * R + 1e-3 * gap_mm, 0.0)];
            let facts = struck(&settings, &balls, level(), 2.0);
            assert_eq!(tips(&facts).len() > 1, again, "{name}: {gap_mm} mm, {:?}", tips(&facts));
        }
    }
}

/// A single stroke is one contact of the tip, however high, low, steep or hard it is.
#[test]
fn a_plain_stroke_is_no_double_hit() {
    let held = [(0.0, 0.03), (0.4, 0.06), (-0.45, 0.06), (0.0, 0.6), (0.1, 0.9)];
    for (name, settings) in solvers() {
        for speed in [1.0, 3.0, 7.0] {
            for (height_offset, elevation_rad) in held {
                let aim = Aim { height_offset, elevation_rad, ..Aim::default() };
                let facts = struck(&settings, &[lies(0, -0.3, 0.1)], aim, speed);
                assert_eq!(tips(&facts), [false], "{name}: {speed} m/s, {aim:?}");
            }
        }
    }
}

/// A soft draw shot is slowed down by the cloth before the follow-through is over.
#[test]
fn a_long_follow_through_runs_into_a_soft_draw_shot() {
    for (name, settings) in solvers() {
        let aim = Aim { height_offset: -0.45, ..level() };
        let facts = struck(&settings, &[lies(0, -0.3, 0.1)], aim, 0.3);
        assert!(tips(&facts).len() > 1, "{name}");
    }
}

/// A ball against the cue ball takes what the tip gives, and the cue ball all but stands.
#[test]
fn a_stroke_through_a_frozen_ball_is_no_push() {
    for (name, settings) in solvers() {
        let balls = [lies(0, -0.3, 0.0), lies(1, -0.3 + 2.0 * R, 0.0)];
        let facts = struck(&settings, &balls, level(), 2.0);
        assert!(tips(&facts).iter().all(|push| !push), "{name}: {:?}", tips(&facts));
    }
}

#[test]
fn a_stroke_at_a_moving_ball_is_told_to_be_one() {
    for (name, settings) in solvers() {
        for (rolling, expected) in [(DVec3::ZERO, false), (DVec3::new(0.0, 0.3, 0.0), true)] {
            let balls = [lies(0, -0.3, 0.0), rolls(1, 0.5, -0.3, rolling)];
            let facts = struck(&settings, &balls, level(), 1.0);
            let moving = facts.iter().find_map(|fact| match fact.kind {
                FactKind::CueBallStruck { moving, .. } => Some(moving),
                _ => None,
            });
            assert_eq!(moving, Some(expected), "{name}");
        }
    }
}

/// The shaft of a level cue lies in a ball behind the cue ball; raised, it passes over it.
#[test]
fn a_ball_in_the_way_of_the_shaft_is_touched() {
    for (name, settings) in solvers() {
        for (elevation_rad, expected) in [(0.06, vec![(1, TouchedBy::Shaft)]), (0.5, vec![])] {
            let balls = [lies(0, -0.3, 0.0), lies(1, -0.4, 0.01), lies(2, -0.4, 0.2)];
            let aim = Aim { elevation_rad, ..Aim::default() };
            let mut simulation = world(pool(), &balls, &settings);
            // From a short way back: behind the ball the tip itself would meet it.
            let strike = hapticbillard::physics::Strike {
                elevation_deg: elevation_rad.to_degrees(),
                ..hapticbillard::physics::Strike::CENTRE
            };
            simulation = simulation.strike(strike).unwrap();
            let facts = play_out(&mut simulation);
            assert_eq!(touched(&facts), expected, "{name}: {aim:?}");
        }
    }
}

#[test]
fn a_hand_among_rolling_balls_touches_one_and_at_rest_it_does_not() {
    let place =
        Command::PlaceBall { ball: ONE, position_m: DVec2::new(0.4, 0.2), zone: Zone::Anywhere };
    for (name, settings) in solvers() {
        for (velocity, expected) in
            [(DVec3::ZERO, vec![]), (DVec3::Y * 0.5, vec![(1, TouchedBy::Hand)])]
        {
            let balls = [rolls(0, -0.3, 0.0, velocity), lies(1, 0.3, 0.0)];
            let mut simulation = world(pool(), &balls, &settings);
            simulation.apply(0.1, &place).unwrap();
            let facts = play_out(&mut simulation);
            assert_eq!(touched(&facts), expected, "{name}");
        }
    }
}

/// Pressed along its rail, a frozen ball is not driven there; away and back, it is.
#[test]
fn a_frozen_ball_is_driven_to_its_rail_only_after_it_has_left_it() {
    for (name, settings) in solvers() {
        // Into the rail: no onset.
        let velocity = DVec3::new(0.8, 0.4, 0.0);
        let (_, facts) = told(&settings, &[on_bed(1, -0.3, rail_y(), velocity, DVec3::ZERO)]);
        assert_eq!(onsets(&facts, 1, Rail::Left).first(), Some(&false), "{name}");
        // Across the table and back.
        let velocity = DVec3::new(0.1, -2.0, 0.0);
        let (_, facts) = told(&settings, &[rolls(1, -0.3, rail_y(), velocity)]);
        assert_eq!(onsets(&facts, 1, Rail::Right).first(), Some(&true), "{name}");
        assert_eq!(onsets(&facts, 1, Rail::Left).first(), Some(&true), "{name}");
        // From 1 mm away.
        let (_, facts) = told(&settings, &[rolls(1, -0.3, rail_y() - 1e-3, DVec3::Y * 0.5)]);
        assert_eq!(onsets(&facts, 1, Rail::Left).first(), Some(&true), "{name}");
    }
}

/// A ball that another presses against its rail, and that never leaves it by a tenth of a
/// millimetre, was not driven there, however often they meet.
#[test]
fn a_ball_held_against_its_rail_is_not_driven_there() {
    for (name, settings) in solvers() {
        let balls = [rolls(0, -0.3, 0.3, DVec3::Y * 1.5), lies(1, -0.3, rail_y())];
        let (_, facts) = told(&settings, &balls);
        assert_eq!(onsets(&facts, 1, Rail::Left).first(), Some(&false), "{name}");
    }
}

/// The next shot begins with the rails as the last one left them.
#[test]
fn a_ball_that_came_to_rest_at_a_rail_is_frozen_in_the_next_shot() {
    for (name, settings) in solvers() {
        let balls = [lies(0, -0.3, 0.0), lies(1, -0.3, rail_y())];
        let mut simulation = world(pool(), &balls, &settings);
        stroke(&mut simulation, Aim { azimuth_rad: -1.5, ..level() }, 0.3);
        play_out(&mut simulation);
        let at = state(&simulation, 0).position.truncate();
        let towards = DVec2::new(-0.3, rail_y()) - at;
        let azimuth_rad = libm::atan2(towards.y, towards.x);
        stroke(&mut simulation, Aim { azimuth_rad, ..level() }, 1.0);
        let facts = play_out(&mut simulation);
        assert_eq!(onsets(&facts, 1, Rail::Left).first(), Some(&false), "{name}");
    }
}

#[test]
fn the_head_string_is_crossed_once_and_only_towards_the_foot() {
    for (name, settings) in solvers() {
        for (x, speed, expected) in
            [(-0.8, 1.0, 1), (-0.8, 0.1, 0), (-0.5, 1.0, 0), (-0.5, -0.2, 0), (-0.64, 0.3, 1)]
        {
            let (_, facts) = told(&settings, &[rolls(0, x, 0.2, DVec3::X * speed)]);
            let crossed = |fact: &&Fact| matches!(fact.kind, FactKind::HeadStringCrossed { .. });
            let found = facts.iter().filter(crossed).count();
            assert_eq!(found, expected, "{name}: from {x} m at {speed} m/s");
        }
    }
}

#[test]
fn a_ball_struck_behind_the_head_string_is_told_so() {
    for (name, settings) in solvers() {
        for (x, expected) in [(-0.7, true), (-0.64, true), (-0.63, false), (0.2, false)] {
            let balls = [rolls(0, x, -0.3, DVec3::Y * 1.0), lies(1, x, 0.0)];
            let (_, facts) = told(&settings, &balls);
            let kitchen = facts.iter().find_map(|fact| match fact.kind {
                FactKind::BallsCollided { in_kitchen, .. } => Some(in_kitchen),
                _ => None,
            });
            assert_eq!(kitchen, Some(expected), "{name}: {x} m");
        }
    }
}

#[test]
fn a_ball_is_put_down_where_it_may_stand_and_nowhere_else() {
    let places = [
        (Zone::Anywhere, DVec2::new(0.4, 0.2), true),
        (Zone::Kitchen, DVec2::new(-0.8, 0.2), true),
        (Zone::Kitchen, DVec2::new(-0.6, 0.2), false),
        // Outside, in a cushion, on a ball, nearly on a ball, beside it.
        (Zone::Anywhere, DVec2::new(2.0, 0.0), false),
        (Zone::Anywhere, DVec2::new(0.0, 0.62), false),
        (Zone::Anywhere, DVec2::new(0.3, 0.0), false),
        (Zone::Anywhere, DVec2::new(0.3 + 1.99 * R, 0.0), false),
        (Zone::Anywhere, DVec2::new(0.3 + 2.01 * R, 0.0), true),
    ];
    for (name, settings) in solvers() {
        for (zone, position_m, expected) in places {
            let mut simulation = world(pool(), &[lies(0, -0.3, 0.0), lies(1, 0.3, 0.0)], &settings);
            let command = Command::PlaceBall { ball: BallId::CUE, position_m, zone };
            simulation.apply(0.0, &command).unwrap();
            let facts = play_out(&mut simulation);
            let placed = facts.iter().find_map(|fact| match fact.kind {
                FactKind::BallPlaced { ok, .. } => Some(ok),
                _ => None,
            });
            assert_eq!(placed, Some(expected), "{name}: {zone:?} {position_m}");
            let at = state(&simulation, 0).position.truncate();
            assert_eq!(at.distance(position_m) < 1e-12, expected, "{name}: {zone:?} {position_m}");
        }
    }
}

/// Above 7.4 m/s the back of a corner pocket throws a ball out again, however deep its lowest point
/// was in between; below, it stays.
#[test]
fn a_ball_that_the_pocket_throws_out_is_not_told_to_be_down() {
    let pocket = pool().pockets.iter().find(|pocket| pocket.centre.min_element() > 0.3).unwrap();
    let way = pocket.heading.normalize();
    for (name, settings) in solvers() {
        for (speed, expected) in [(6.6, true), (7.0, true), (7.6, false), (7.9, false)] {
            let start = pocket.centre - 0.15 * way;
            let velocity = (way * speed).extend(-0.05 * speed);
            let balls = [on_bed(1, start.x, start.y, velocity, DVec3::ZERO)];
            let mut simulation = world(pool(), &balls, &settings);
            let (mut facts, mut lowest_m) = (Vec::new(), f64::INFINITY);
            for millisecond in 1..600 {
                simulation
                    .advance(1e-3 * f64::from(millisecond), FactSet::NONE, &mut facts)
                    .unwrap();
                lowest_m = lowest_m.min(state(&simulation, 1).position.z);
            }
            let is_down = state(&simulation, 1).place == BallPlace::Pocketed;
            assert_eq!(is_down, expected, "{name}: {speed} m/s");
            assert_eq!(pocketed(&facts), usize::from(expected), "{name}: {speed} m/s");
            assert!(lowest_m < 0.7 * R, "{name}: {speed} m/s: it was in the pocket, {lowest_m}");
        }
    }
}

/// Wholly below the bed, but on its way up: down is only what cannot come back.
#[test]
fn a_ball_below_the_bed_that_rises_is_not_down_yet() {
    let pocket = pool().pockets.iter().find(|pocket| pocket.centre.min_element() > 0.3).unwrap();
    let way = pocket.heading.normalize();
    for (name, settings) in solvers() {
        for (rise_m_s, expected) in [(1.8, false), (0.5, true)] {
            let start = pocket.centre.extend(-1.3 * R);
            let velocity = (-0.6 * way).extend(rise_m_s);
            let (end, facts) = told(&settings, &[ball(1, start, velocity, DVec3::ZERO)]);
            assert_eq!(pocketed(&facts), usize::from(expected), "{name}: {rise_m_s} m/s");
            let place = state(&end, 1).place;
            assert_eq!(place == BallPlace::Pocketed, expected, "{name}: {rise_m_s} m/s");
        }
    }
}

/// The slate's edge is rounded over 4.5 mm: in front of that a ball stands, on it, it falls. A ball
/// that hangs stays in play through the settling of a shot, and drops when it is touched.
#[test]
fn a_hanging_ball_stays_until_it_is_touched() {
    let pocket = pool().pockets.iter().find(|pocket| pocket.centre.min_element() > 0.3).unwrap();
    let way = pocket.heading.normalize();
    for (name, settings) in solvers() {
        let hangs = |back_m: f64| {
            let at = pocket.centre - way * (pocket.radius_m + back_m);
            let (end, facts) = told(&settings, &[lies(1, at.x, at.y)]);
            assert_eq!(pocketed(&facts), usize::from(state(&end, 1).place != BallPlace::OnTable));
            state(&end, 1).place == BallPlace::OnTable
        };
        assert!(hangs(5e-3) && !hangs(4e-3) && !hangs(0.0), "{name}");

        let at = pocket.centre - way * (pocket.radius_m + 5e-3);
        let from = at - way * 0.3;
        let rolling = (way * 0.6).extend(0.0);
        let (end, facts) =
            told(&settings, &[rolls(0, from.x, from.y, rolling), lies(1, at.x, at.y)]);
        assert_eq!(state(&end, 1).place, BallPlace::Pocketed, "{name}");
        let hit = facts.iter().position(|f| matches!(f.kind, FactKind::BallsCollided { .. }));
        let down = facts.iter().position(|f| matches!(f.kind, FactKind::BallPocketed { .. }));
        assert!(hit < down, "{name}");
    }
}
