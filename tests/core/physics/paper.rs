//! The paper's method (profile 2009) with its faults, measured; and the standard one without them.

use super::scenes::*;
use glam::{DVec2, DVec3};
use hapticbillard::ball::{Ball, BallFlags, BallState};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Contact, Parameters, PhysicsSettings, Simulation};
use hapticbillard::table::Table;

const DEGREE: f64 = core::f64::consts::PI / 180.0;

fn weightless(start: (Ball, BallState)) -> (Ball, BallState) {
    let flags = BallFlags { gravity: false, ..BallFlags::default() };
    (Ball { flags, ..start.0 }, start.1)
}

/// Where the object ball goes after a hit at `cut_deg`, the cue ball at 2 m/s after `way` [°].
fn object_deg(settings: &PhysicsSettings, law: Contact, cut_deg: f64, way: f64) -> f64 {
    let (sin, cos) = libm::sincos(cut_deg * DEGREE);
    let place = DVec3::new(way + 2.0 * R * cos, 2.0 * R * sin, 0.5);
    let balls = [
        weightless(ball(0, DVec3::Z * 0.5, DVec3::X * 2.0, DVec3::ZERO)),
        weightless(ball(1, place, DVec3::ZERO, DVec3::ZERO)),
    ];
    let mut world: Simulation =
        with(&Table::plane(), &balls, settings, |p: &mut Parameters| p.ball = law);
    run(&mut world, 0.06);
    let direction: DVec2 = state(&world, 1).velocity.truncate();
    libm::atan2(direction.y, direction.x) / DEGREE
}

const SMOOTH: Contact = Contact { restitution: 0.95, friction: 0.0 };

#[test]
fn late_detection_turns_the_normal_as_derived_and_back_dating_ends_it() {
    // Mean and maximum over the phase of the step: validation formula
    // φ' = atan2(2R sin φ, 2R cos φ − v dt), 0 < dt < h.
    for (cut, mean, maximum) in [(10.0, 0.7677, 1.615), (30.0, 2.1813, 4.5538)] {
        let phases = 80;
        let mut errors = [Vec::new(), Vec::new()];
        for phase in 0..phases {
            let way = 0.02 + 0.008 * (f64::from(phase) + 0.5) / f64::from(phases);
            for (place, back_dating) in [false, true].into_iter().enumerate() {
                let settings = PhysicsSettings { contact_back_dating: back_dating, ..of_2009() };
                errors[place].push(object_deg(&settings, SMOOTH, cut, way) - cut);
            }
        }
        let average = errors[0].iter().sum::<f64>() / f64::from(phases);
        assert!((average - mean).abs() < 0.01, "{cut}: {average}");
        assert!(errors[0].iter().all(|e| 0.0 <= *e && *e <= maximum), "{cut}: {:?}", errors[0]);
        assert!(errors[1].iter().all(|e| e.abs() < 1e-9), "{cut}: {:?}", errors[1]);
    }
}

#[test]
fn the_friction_clamp_throws_twice_as_much_as_spheres_do() {
    // Throw over cut for small cuts: 2/(7 (1 + e)) for spheres, twice that with the clamp.
    let grips = Contact { restitution: 0.9, friction: 1.0 };
    let ratio = |settings: &PhysicsSettings| {
        let cut = 0.2;
        1.0 - object_deg(settings, grips, cut, 0.021) / cut
    };
    assert!((ratio(&stepping()) - 0.150_38).abs() < 1e-3);
    assert!((ratio(&of_2009()) - 0.300_75).abs() < 1e-3, "{}", ratio(&of_2009()));
}

#[test]
fn ball_friction_can_be_switched_off() {
    for profile in [stepping(), of_2009()] {
        let settings = PhysicsSettings { ball_friction: false, ..profile };
        assert_eq!(Parameters::of(&settings).ball.friction, 0.0);
        let ball = Parameters::of(&settings).ball;
        assert!((object_deg(&settings, ball, 30.0, 0.021) - 30.0).abs() < 1e-9);
        let rough = PhysicsSettings { ball_friction: true, ..settings };
        let ball = Parameters::of(&rough).ball;
        assert!(1.0 < 30.0 - object_deg(&rough, ball, 30.0, 0.021));
    }
}

#[test]
fn lying_balls_hop_in_2009_by_less_than_a_tenth_of_a_millimetre_and_not_at_all_now() {
    let highest = |settings: &PhysicsSettings| {
        let start = on_bed(0, 0.3, 0.2, DVec3::ZERO, DVec3::ZERO);
        let mut world = world(pool(), &[start], settings);
        let mut highest = 0.0_f64;
        for tick in 1..300 {
            run(&mut world, 0.004 * f64::from(tick));
            highest = highest.max((state(&world, 0).position.z - R).abs());
        }
        highest
    };
    assert_eq!(highest(&stepping()), 0.0);
    let hop = highest(&of_2009());
    assert!(1e-5 < hop && hop < 1.6e-4, "{hop}");
}

#[test]
fn only_the_deepest_face_acts_in_2009_and_all_act_now() {
    // Into a right-angled corner at 45°: both walls must throw the ball back.
    let mut table = Table::default();
    for normal in [DVec3::NEG_X, DVec3::NEG_Y] {
        table.planes.push(hapticbillard::table::Plane {
            point: DVec3::ZERO,
            normal,
            surface: hapticbillard::mesh::Surface::Obstacle,
        });
    }
    let first_step = |settings: &PhysicsSettings| {
        let place = DVec3::new(-R - 0.001, -R - 0.001, 0.0);
        let start = weightless(ball(0, place, DVec3::new(1.0, 1.0, 0.0), DVec3::ZERO));
        let mut world = world(&table, &[start], settings);
        run(&mut world, 0.004);
        world.sample(BallId(0), 0.004).unwrap().velocity
    };
    let now = first_step(&stepping());
    assert!(now.x < 0.0 && now.y < 0.0, "{now}");
    let then = first_step(&of_2009());
    assert!(then.x * then.y < 0.0, "{then}");
}

#[test]
fn a_fast_small_ball_tunnels_in_2009() {
    let speed = 12.0;
    let radius_m = 0.004;
    let run_on = |settings: &PhysicsSettings| {
        let (one, start) = ball(0, DVec3::new(-0.11, 0.0, 0.0), DVec3::X * speed, DVec3::ZERO);
        let small = weightless((Ball { radius_m, ..one }, start));
        let wall = "v 0 -1 -1\nv 0 1 -1\nv 0 1 1\nv 0 -1 1\nf 1 2 3\nf 1 3 4\n";
        let mut world = world(&Table::from_mesh(wall).unwrap(), &[small], settings);
        run(&mut world, 0.1);
        state(&world, 0).position.x
    };
    assert!(run_on(&stepping()) < -radius_m);
    assert!(0.5 < run_on(&of_2009()));
}
