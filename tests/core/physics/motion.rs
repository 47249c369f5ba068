//! Closed forms of billiards at the game's step of 4 ms.

use super::scenes::*;
use glam::{DVec2, DVec3};
use hapticbillard::ball::{BallState, Motion};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Parameters, PhysicsSettings, Strike};
use hapticbillard::table::Table;

fn degrees(direction: DVec2) -> f64 {
    libm::atan2(direction.y, direction.x) * (180.0 / core::f64::consts::PI)
}

fn heading(state: &BallState) -> f64 {
    degrees(state.velocity.truncate())
}

/// No rolling resistance: the final roll is then constant.
fn ideal(parameters: &mut Parameters) {
    parameters.rolling_resistance = 0.0;
}

/// The cue ball at `speed` with `spin`, and a ball that it meets at a cut angle after `way`.
fn cut_shot(
    speed: f64,
    spin: DVec3,
    cut_deg: f64,
    way: f64,
    change: impl Fn(&mut Parameters),
) -> [BallState; 2] {
    let (sin, cos) = libm::sincos(cut_deg * core::f64::consts::PI / 180.0);
    let object = DVec2::new(way + 2.0 * R * cos, 2.0 * R * sin);
    let balls = [
        on_bed(0, 0.0, 0.0, DVec3::X * speed, spin),
        on_bed(1, object.x, object.y, DVec3::ZERO, DVec3::ZERO),
    ];
    let mut world = with(&Table::plane(), &balls, &step(4.0), change);
    let collides =
        hapticbillard::events::FactSet::of(&[hapticbillard::events::Topic::BallsCollided]);
    let mut facts = Vec::new();
    world.advance(5.0, collides, &mut facts).unwrap();
    let at = facts.last().unwrap().time_s;
    // The step that holds the contact is computed: this is right after it.
    [0, 1].map(|id| world.sample(BallId(id), at + 1e-9).unwrap())
}

#[test]
fn a_sliding_ball_rolls_at_five_sevenths_after_the_right_way() {
    for speed in [0.3, 1.0, 3.0, 7.0] {
        let start = on_bed(0, 0.0, 0.0, DVec3::X * speed, DVec3::ZERO);
        let mut world = with(&Table::plane(), &[start], &step(4.0), ideal);
        let time = 2.0 * speed / (7.0 * 0.2 * 9.81);
        run(&mut world, time + 0.02);
        let end = state(&world, 0);
        assert_eq!(end.motion, Motion::Rolling);
        assert!((end.velocity.x / (5.0 / 7.0 * speed) - 1.0).abs() < 1e-12);
        let way = 12.0 / 49.0 * speed * speed / (0.2 * 9.81) + 0.02 * 5.0 / 7.0 * speed;
        assert!((end.position.x - way).abs() < 0.004 * speed, "{} {way}", end.position.x);
    }
}

#[test]
fn without_spin_and_loss_the_balls_part_at_a_right_angle() {
    for cut in [10.0, 30.0, 45.0, 60.0, 75.0] {
        for phase in 0..5 {
            // So close that the cue ball still slides without spin.
            let way = 0.003 + 0.0017 * f64::from(phase);
            let [cue, object] = cut_shot(3.0, DVec3::ZERO, cut, way, |p| {
                p.ball.restitution = 1.0;
                p.ball.friction = 0.0;
                p.cloth.friction = 0.0;
            });
            let angle = heading(&object) - heading(&cue);
            assert!((angle - 90.0).abs() < 1.0, "{cut}: {angle}");
            assert!((heading(&object) - cut).abs() < 1.0);
            let expected = 3.0 * libm::cos(cut * core::f64::consts::PI / 180.0);
            assert!((object.velocity.length() / expected - 1.0).abs() < 0.01);
        }
    }
}

#[test]
fn throw_is_that_of_the_published_formula() {
    for cut in [5.0, 20.0, 40.0, 60.0] {
        let [_, object] = cut_shot(2.0, DVec3::ZERO, cut, 0.01, |p| p.cloth.friction = 0.0);
        let slope = libm::tan(cut * core::f64::consts::PI / 180.0);
        let throw = libm::atan((2.0 * slope / (7.0 * 1.95)).min(0.05));
        let expected = cut - throw * 180.0 / core::f64::consts::PI;
        assert!((heading(&object) - expected).abs() < 0.05, "{cut}: {}", heading(&object));
    }
}

#[test]
fn without_ball_friction_nothing_is_thrown() {
    let [_, object] = cut_shot(2.0, DVec3::Z * 80.0, 30.0, 0.01, |p| {
        p.ball.friction = 0.0;
        p.cloth.friction = 0.0;
    });
    assert!((heading(&object) - 30.0).abs() < 1e-9);
}

#[test]
fn draw_and_follow_end_in_the_roll_that_the_spin_leaves() {
    // Final roll = (5 v + 2 R (ω_y, −ω_x))/7, whatever happens on the way.
    for spin_over_roll in [-1.0, -0.5, 0.0, 0.5, 1.0] {
        let speed = 2.5;
        let spin = DVec3::Y * (spin_over_roll * speed / R);
        let balls = [
            on_bed(0, 0.0, 0.0, DVec3::X * speed, spin),
            on_bed(1, 2.0 * R + 1e-5, 0.0, DVec3::ZERO, DVec3::ZERO),
        ];
        let mut world = with(&Table::plane(), &balls, &step(4.0), |p| {
            ideal(p);
            p.ball.friction = 0.0;
        });
        run(&mut world, 2.0);
        let (cue, object) = (state(&world, 0), state(&world, 1));
        let after = speed * 0.5 * (1.0 - 0.95);
        let expected = (5.0 * after + 2.0 * speed * spin_over_roll) / 7.0;
        assert!((cue.velocity.x - expected).abs() < 0.01 * speed, "{spin_over_roll}");
        let expected = 5.0 / 7.0 * speed * 0.5 * 1.95;
        assert!((object.velocity.x / expected - 1.0).abs() < 0.01);
    }
}

#[test]
fn a_rolling_ball_is_bent_to_the_thirty_degree_rule() {
    // Maximum deflection of a rolling cue ball: 33.749° at a cut of 28.1255°.
    let cut = 28.125_5_f64;
    let (sin, cos) = libm::sincos(cut * core::f64::consts::PI / 180.0);
    let balls = [
        on_bed(0, 0.0, 0.0, DVec3::X * 2.0, DVec3::Y * (2.0 / R)),
        on_bed(1, 0.1 + 2.0 * R * cos, 2.0 * R * sin, DVec3::ZERO, DVec3::ZERO),
    ];
    let mut world = with(&Table::plane(), &balls, &step(4.0), |p| {
        ideal(p);
        p.ball.restitution = 1.0;
        p.ball.friction = 0.0;
    });
    run(&mut world, 2.0);
    let angle = heading(&state(&world, 0));
    assert!((angle.abs() - 33.749).abs() < 1.0, "{angle}");
}

#[test]
fn a_flight_lands_where_the_parabola_does() {
    let velocity = DVec3::new(1.5, 0.4, 1.2);
    let start = ball(0, DVec3::new(0.0, 0.0, R), velocity, DVec3::ZERO);
    let mut world = with(&Table::plane(), &[start], &step(4.0), |p| p.cloth.restitution = 0.0);
    let flight = 2.0 * velocity.z / 9.81;
    run(&mut world, 0.5 * flight);
    let top = state(&world, 0).position.z - R;
    assert!((top - velocity.z * velocity.z / (2.0 * 9.81)).abs() < 0.01 * top + 0.003);
    assert_eq!(state(&world, 0).motion, Motion::Airborne);
    run(&mut world, flight + 0.005);
    let landed = state(&world, 0);
    assert!((landed.position.z - R).abs() < 1e-6, "{}", landed.position.z - R);
    let way = landed.position.truncate() - velocity.truncate() * (flight + 0.005);
    assert!(way.length() < 0.02 * flight * velocity.truncate().length(), "{way}");
}

#[test]
fn a_steep_stroke_jumps_and_a_level_one_stays_on_the_bed() {
    let highest = |elevation_deg: f64, settings: &PhysicsSettings| {
        let start = on_bed(0, 0.0, 0.0, DVec3::ZERO, DVec3::ZERO);
        let strike = Strike { speed_m_s: 4.0, elevation_deg, ..Strike::CENTRE };
        let shot = world(&Table::plane(), &[start], settings)
            .strike(strike)
            .unwrap()
            .run_until_rest()
            .unwrap();
        let heights = shot.trajectory(BallId::CUE).every(0.002);
        heights.map(|state| state.position.z - R).fold(0.0, f64::max)
    };
    let game = step(4.0);
    assert!(highest(0.0, &game) < 1e-6, "{}", highest(0.0, &game));
    let jump = highest(45.0, &game);
    assert!(R < jump && jump < 0.5, "{jump}");
    // The height goes with the square of the speed: 1 % of speed is 2 % of height.
    for elevation_deg in [20.0, 30.0, 45.0, 60.0] {
        let (jump, expected) = (highest(elevation_deg, &game), highest(elevation_deg, &exact()));
        assert!((jump / expected - 1.0).abs() < 0.02, "{elevation_deg}: {jump} {expected}");
    }
}

#[test]
fn a_masse_curves_to_the_side_of_its_spin_and_ends_as_coriolis_says() {
    // Final roll = (5 v + 2 R (ω_y, −ω_x))/7.
    for side in [-1.0, 1.0] {
        let spin = DVec3::new(side * 60.0, -40.0, 20.0);
        let start = on_bed(0, 0.0, 0.0, DVec3::X * 2.0, spin);
        let mut world = with(&Table::plane(), &[start], &step(4.0), ideal);
        run(&mut world, 3.0);
        let end = state(&world, 0);
        let expected = (DVec2::X * 10.0 + 2.0 * R * DVec2::new(spin.y, -spin.x)) / 7.0;
        assert!((end.velocity.length() / expected.length() - 1.0).abs() < 0.01);
        assert!((heading(&end) - degrees(expected)).abs() < 1.0);
        assert!(end.velocity.y * side < 0.0);
    }
}
