//! Cells and boxes leave few exact tests, and leave out none that matters.

use super::scenes::*;
use glam::DVec3;
use hapticbillard::events::FactSet;
use hapticbillard::physics::Solver;
use hapticbillard::table::Table;
use proptest::prelude::*;

#[test]
fn a_break_needs_at_most_three_hundred_tests_a_step() {
    let shot = world(pool(), &break_shot(0.0), &step(4.0)).run_until_rest().unwrap();
    let mean = shot.work.tests() as f64 / shot.work.steps as f64;
    assert!(1000 < shot.work.steps && mean <= 300.0, "{mean}");
}

#[test]
fn without_cells_and_boxes_every_ball_meets_every_face_and_every_other_ball() {
    // In the air, so that nothing but the broad phase can leave a face out. Each face is met twice:
    // for the first contact along the path, and for what carries the ball at its end.
    let mut balls = Vec::new();
    for id in 0..16_u16 {
        let place = DVec3::new(0.12 * f64::from(id) - 0.9, 0.0, 0.5);
        balls.push(ball(id, place, DVec3::Y * 0.1, DVec3::ZERO));
    }
    let mut facts = Vec::new();
    let faces = (pool().mesh.faces.len() + pool().planes.len()) as u64;
    let mut brute = stepper(pool(), &balls, 0.1).without_broad_phase();
    let before = brute.work();
    brute.advance(0.004, FactSet::NONE, &mut facts).unwrap();
    assert_eq!(brute.work().pair_tests - before.pair_tests, 120);
    assert_eq!(brute.work().face_tests - before.face_tests, 2 * 16 * faces);

    let mut fine = stepper(pool(), &balls, 0.1);
    let before = fine.work();
    fine.advance(0.004, FactSet::NONE, &mut facts).unwrap();
    assert!(fine.work().tests() - before.tests() <= 16 * 2 + 120);
    assert_eq!(solver_digest(&brute), solver_digest(&fine));
}

#[test]
fn no_pair_is_tested_twice_in_a_step_without_contacts() {
    // A tight rack of balls that all move the same way: all neighbours are near, none closes.
    let mut balls = break_shot(1e-6);
    for (_, state) in &mut balls {
        state.velocity = DVec3::X * 0.5;
    }
    let mut solver = stepper(&Table::plane(), &balls, 0.03);
    let mut facts = Vec::new();
    let before = solver.work().pair_tests;
    solver.advance(0.004, FactSet::NONE, &mut facts).unwrap();
    let tests = solver.work().pair_tests - before;
    assert_eq!(solver.work().events, 0);
    // 30 touching pairs, and boxes that overlap without a contact.
    assert!((30..=42).contains(&tests), "{tests}");
}

#[test]
fn cells_of_any_size_and_none_at_all_give_the_same_bits() {
    let until = if slow() { 12.0 } else { 1.2 };
    let run = |cell_m: f64, broad: bool| {
        let mut solver = stepper(pool(), &break_shot(0.0), cell_m);
        if !broad {
            solver = solver.without_broad_phase();
        }
        let mut facts = Vec::new();
        solver.advance(until, FactSet::NONE, &mut facts).unwrap();
        (solver_digest(&solver), facts)
    };
    let reference = run(0.1, true);
    assert!(30 < reference.1.len());
    for cell_m in [0.03, 0.37, 5.0] {
        assert_eq!(run(cell_m, true), reference, "{cell_m}");
    }
    if slow() {
        assert_eq!(run(0.1, false), reference);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, ..ProptestConfig::default() })]

    #[test]
    fn random_shots_do_not_depend_on_the_cells(seed in 0_u64..1000, cell_m in 0.02_f64..3.0) {
        let run = |cell_m: f64, broad: bool| {
            let mut solver = stepper(pool(), &random_balls(seed), cell_m);
            if !broad {
                solver = solver.without_broad_phase();
            }
            let mut facts = Vec::new();
            solver.advance(0.3, FactSet::NONE, &mut facts).unwrap();
            (solver_digest(&solver), facts)
        };
        let reference = run(0.1, true);
        prop_assert_eq!(run(cell_m, true), reference.clone());
        prop_assert_eq!(run(cell_m, false), reference);
    }
}
