//! What a scene has not costs nothing, and having it in vain changes no bit.

use super::exact;
use crate::physics::scenes::{R, ball, on_bed, pool, run, state, with, world};
use glam::DVec3;
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::mesh::{Surface, parse_obj};
use hapticbillard::physics::{Simulation, Work, sample_shots};
use hapticbillard::table::{Plane, Table};
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// A cue ball that slides, rolls and stops, without spin about the vertical.
fn cue_ball() -> (Ball, BallState) {
    on_bed(0, -0.5, 0.1, DVec3::new(1.2, 0.3, 0.0), DVec3::ZERO)
}

/// What became of a ball, to the last bit, and what was computed.
fn end(mut simulation: Simulation) -> ([[u64; 3]; 3], Work) {
    run(&mut simulation, 20.0);
    let ball = state(&simulation, 0);
    let bits = [ball.position, ball.velocity, ball.angular_velocity]
        .map(|vector| vector.to_array().map(f64::to_bits));
    (bits, simulation.work())
}

/// An obstacle far beyond what the cue ball comes near to.
fn far_box() -> Table {
    let corner = |k: u32| {
        let [x, y, z] = [k & 1, k >> 1 & 1, k >> 2 & 1].map(f64::from);
        format!("v {} {} {}\n", 5.0 + x, 5.0 + y, z)
    };
    let corners: String = (0..8).map(corner).collect();
    let faces = "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\n\
        f 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
    let mesh = parse_obj(&(corners + faces), Surface::Obstacle).unwrap();
    Table { mesh, ..Table::plane() }
}

#[test]
fn one_ball_alone_on_a_plane_costs_its_events_and_nothing_else() {
    let (_, work) = end(world(&Table::plane(), &[cue_ball()], &exact()));
    // Sliding ends, rolling ends, and it has settled.
    let expected = Work { events: 3, ..Work::default() };
    assert_eq!(work, expected);
}

#[test]
fn a_second_ball_is_tested_only_where_there_is_one_and_changes_no_bit_from_afar() {
    let (alone, without) = end(world(&Table::plane(), &[cue_ball()], &exact()));
    let moving = on_bed(1, -0.5, 3.0, DVec3::new(1.0, -1.0, 0.0), DVec3::ZERO);
    let (beside, with) = end(world(&Table::plane(), &[cue_ball(), moving], &exact()));
    assert_eq!(without.pair_tests, 0);
    assert!(0 < with.pair_tests);
    assert_eq!(alone, beside);
}

#[test]
fn faces_are_tested_only_where_there_are_some_and_change_no_bit_from_afar() {
    let (alone, without) = end(world(&Table::plane(), &[cue_ball()], &exact()));
    let (beside, work) = end(world(&far_box(), &[cue_ball()], &exact()));
    assert_eq!((without.face_tests, work.face_tests), (0, 0));
    assert_eq!(alone, beside);
    // Not because nothing is ever tested: a ball that comes to the box meets it.
    let to_it = on_bed(0, 4.0, 5.5, DVec3::X * 3.0, DVec3::ZERO);
    assert!(0 < end(world(&far_box(), &[to_it], &exact())).1.face_tests);
}

#[test]
fn planes_that_nobody_comes_to_change_no_bit() {
    let floor = Plane { point: DVec3::Z * -9.0, normal: DVec3::Z, surface: Surface::Floor };
    let mut table = Table::plane();
    table.planes.push(floor);
    let (alone, _) = end(world(&Table::plane(), &[cue_ball()], &exact()));
    let (above, _) = end(world(&table, &[cue_ball()], &exact()));
    assert_eq!(alone, above);
}

#[test]
fn flight_is_computed_only_for_who_flies_and_its_laws_change_no_bit_of_the_others() {
    let start = [cue_ball()];
    let bed = |restitution: f64| {
        end(with(&Table::plane(), &start, &exact(), |p| p.cloth.restitution = restitution))
    };
    let ((dull, work), (bouncy, _)) = (bed(0.0), bed(0.9));
    assert_eq!(work.flights, 0);
    assert_eq!(dull, bouncy);
    let dropped = ball(0, DVec3::Z * (R + 0.1), DVec3::X, DVec3::ZERO);
    assert!(0 < end(world(&Table::plane(), &[dropped], &exact())).1.flights);
}

#[test]
fn spin_is_computed_only_for_who_spins_and_its_decay_changes_no_bit_of_the_others() {
    let start = [cue_ball()];
    let decay = |rate: f64| {
        end(with(&Table::plane(), &start, &exact(), |p| p.spin_deceleration_rad_s2 = rate))
    };
    let ((without, _), (with_decay, work)) = (decay(0.0), decay(10.0));
    assert_eq!(work.spins, 0);
    assert_eq!(without, with_decay);
    let spinning = on_bed(0, 0.0, 0.0, DVec3::X, DVec3::Z * 30.0);
    assert!(0 < end(world(&Table::plane(), &[spinning], &exact())).1.spins);
}

#[test]
fn pockets_are_looked_for_only_by_who_may_fall_and_change_no_bit_of_the_others() {
    let closed = Table { pockets: Vec::new(), ..pool().clone() };
    let start = [cue_ball()];
    let (without, none) = end(world(&closed, &start, &exact()));
    let (beside, some) = end(world(pool(), &start, &exact()));
    assert_eq!((none.pocket_tests, some.pocket_tests), (0, 0));
    assert_eq!(without, beside);
    // A ball that hops may fall, and without pockets it is not looked at all the same.
    let hopping = [ball(0, DVec3::Z * (R + 0.02), DVec3::X * 0.3, DVec3::ZERO)];
    let (without, none) = end(world(&closed, &hopping, &exact()));
    let (beside, some) = end(world(pool(), &hopping, &exact()));
    assert!(none.pocket_tests == 0 && 0 < some.pocket_tests);
    assert_eq!(without, beside);
}

#[test]
fn a_table_without_balls_is_made_at_once_and_has_nothing_to_do() {
    let mut empty = world(pool(), &[], &exact());
    assert!(run(&mut empty, 1.0).is_empty());
    assert_eq!(empty.work(), Work::default());
    let one = empty.with_balls(vec![cue_ball()]).unwrap();
    assert_eq!(end(one).0, end(world(pool(), &[cue_ball()], &exact())).0);
}

#[test]
fn on_a_planar_table_nobody_looks_for_pockets_and_without_flight_nobody_flies() {
    let planar = sample_shots::planar(pool());
    let work = |breaks: bool, flight: bool| {
        let table = &planar;
        let mut random = Pcg64::seed_from_u64(4);
        let mut all = Work::default();
        for _ in 0..10 {
            let balls = if breaks {
                sample_shots::break_shot(table, &mut random)
            } else {
                sample_shots::small_shot(table, &mut random)
            };
            let mut world = with(table, &balls.unwrap(), &exact(), |parameters| {
                parameters.flight = flight;
            });
            run(&mut world, 60.0);
            assert!(world.is_still());
            all += world.work();
        }
        all
    };
    let each = |count: u64, work: &Work| count as f64 / work.events as f64;
    for breaks in [true, false] {
        let flat = work(breaks, true);
        assert!(flat.pocket_tests == 0 && 0 < flat.contacts, "{flat:?}");
        // Five planes are all there is to ask, while a mesh has jaws and rims.
        assert!(each(flat.face_tests, &flat) <= 5.0, "{flat:?}");
        // The friction of balls on each other lifts them; without flight they stay down.
        let without = work(breaks, false);
        assert!(0 < flat.flights && without.flights == 0, "{without:?}");
        assert!(without.events < flat.events, "{without:?}");
    }
}
