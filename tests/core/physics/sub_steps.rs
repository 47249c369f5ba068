//! Steps in which something happens, cut into parts (paper, section 2.5).

use super::scenes::*;
use glam::DVec3;
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Integrator, PhysicsError, PhysicsSettings, Simulation, Strike};
use hapticbillard::table::Table;

fn parts(integrator: Integrator, sub_steps: u32) -> PhysicsSettings {
    PhysicsSettings { integrator, sub_steps, ..step(4.0) }
}

fn cut_shot(numbers: &mut Numbers) -> Vec<(Ball, BallState)> {
    let (y, spin) = (numbers.between(-0.04, 0.04), numbers.between(-60.0, 100.0));
    let speed = DVec3::X * numbers.between(1.5, 3.5);
    vec![
        on_bed(0, -0.4, 0.0, speed, DVec3::Y * spin),
        on_bed(1, numbers.between(0.0, 0.3), y, DVec3::ZERO, DVec3::ZERO),
    ]
}

#[test]
fn sixteen_parts_take_most_of_the_error_for_a_fraction_of_sixteenth_steps() {
    let (table, mut numbers) = (between_noses(), Numbers(5));
    let (mut nearer, mut cheaper) = (Vec::new(), Vec::new());
    for _ in 0..31 {
        let balls = cut_shot(&mut numbers);
        let end = |settings: &PhysicsSettings| {
            let mut world = world(&table, &balls, settings);
            run(&mut world, 1.2);
            (world.snapshot(1.2).balls, world.work().force_evaluations)
        };
        let (truth, _) = end(&exact());
        let off = |settings: &PhysicsSettings| {
            let (balls, cost) = end(settings);
            let pairs = balls.iter().zip(&truth);
            let off = pairs.map(|(a, b)| a.position.distance(b.position)).fold(0.0, f64::max);
            (off, cost as f64)
        };
        let (whole, cut) =
            (off(&parts(Integrator::Verlet, 1)), off(&parts(Integrator::Verlet, 16)));
        let small = off(&PhysicsSettings { integrator: Integrator::Verlet, ..step(0.25) });
        nearer.push(cut.0 / whole.0);
        cheaper.push(cut.1 / small.1);
    }
    let (nearer, cheaper) = (median(nearer), median(cheaper));
    assert!(nearer < 0.2, "{nearer}");
    assert!(cheaper < 0.4, "{cheaper}");
}

#[test]
fn where_nothing_happens_parts_change_no_bit() {
    // Verlet in its position form has to write its last place anew for every other length of step,
    // and a ball on cloth then begins with a trace of slip.
    for integrator in [Integrator::EulerCromer, Integrator::Verlet, Integrator::Rk4] {
        let rolls = on_bed(0, 0.0, 0.0, DVec3::X, DVec3::Y / R);
        let flies = ball(1, DVec3::new(0.0, 1.0, 2.0), DVec3::new(1.0, 0.0, 1.0), DVec3::Z);
        let end = |sub_steps| {
            let settings = parts(integrator, sub_steps);
            let mut world = world(&Table::plane(), &[rolls.clone(), flies.clone()], &settings);
            run(&mut world, 0.5);
            (digest(&world), world.work())
        };
        assert_eq!(end(16), end(1), "{integrator:?}");
    }
}

#[test]
fn where_time_is_cut_parts_change_no_bit_and_places_are_continuous() {
    let settings = parts(Integrator::EulerCromer, 7);
    let start = Simulation::from_parts(pool(), break_shot(2e-5), &settings).unwrap();
    let (mut whole, mut cut) = (start.clone(), start);
    let facts = run(&mut whole, 0.6);
    let mut also = Vec::new();
    let mut last = cut.snapshot(0.0).balls;
    for look in 1..=1000 {
        let at = 0.6 * f64::from(look) / 1000.0;
        also.extend(run(&mut cut, at));
        let balls = cut.snapshot(at).balls;
        for (ball, before) in balls.iter().zip(&last) {
            let way = ball.position.distance(before.position);
            assert!(way < 8.5 * 0.6e-3 + 1e-6, "{at}: {ball:?}");
        }
        last = balls;
    }
    assert!(facts.len() > 20 && facts == also);
    assert_eq!(digest(&whole), digest(&cut));
    assert!(facts.windows(2).all(|pair| pair[0].time_s <= pair[1].time_s));
}

#[test]
fn a_stroke_in_parts_adds_up() {
    for integrator in INTEGRATORS {
        let balls = vec![
            on_bed(0, -0.6, 0.0, DVec3::ZERO, DVec3::ZERO),
            on_bed(1, 0.2, 0.02, DVec3::ZERO, DVec3::ZERO),
        ];
        let start = Simulation::from_parts(pool(), balls, &parts(integrator, 16)).unwrap();
        let strike = Strike { speed_m_s: 3.0, azimuth_deg: 0.0, ..Strike::CENTRE };
        let shot = start.strike(strike).unwrap().run_until_rest().unwrap();
        assert!(shot.ledger.residual_j.abs() < 1e-9, "{integrator:?}: {:?}", shot.ledger);
        assert!(shot.ledger.momentum.residual.length() < 1e-9, "{integrator:?}");
        assert!(shot.trajectory(BallId(1)).every(0.1).count() > 10);
    }
}

#[test]
fn parts_that_make_no_sense_are_refused() {
    for settings in [
        PhysicsSettings { sub_steps: 4, ..of_2009() },
        PhysicsSettings { sub_steps: 0, ..step(4.0) },
    ] {
        let refused = Simulation::from_parts(&Table::plane(), Vec::new(), &settings);
        let said = matches!(refused, Err(PhysicsError::Setting { key: "sub_steps", .. }));
        assert!(said, "{settings:?}");
    }
}
