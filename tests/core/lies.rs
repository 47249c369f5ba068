//! What hands lay down: racks set up anew, and shots taken back; in both solvers.

use crate::physics::scenes::{digest, exact, on_bed, pool, run, state, stepping};
use glam::{DVec2, DVec3};
use hapticbillard::ball::{BallPlace, BallState};
use hapticbillard::events::{Command, FactKind, Racked, Racking, Zone};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{PhysicsSettings, Racks, Simulation, Strike};
use hapticbillard::rack::{Rack, overlaps};

fn racks() -> Racks {
    Racks::new(Rack::eight_ball(7), Vec::new(), pool())
}

/// A racked table that remembers its shots.
fn racked(settings: &PhysicsSettings) -> Simulation {
    let balls = racks().balls(0).unwrap();
    Simulation::from_parts(pool(), balls, settings).unwrap().with_racks(racks()).with_memory(3)
}

fn rack(serial: u32) -> Command {
    Command::Rack(Racking { serial, balls: Racked::All })
}

/// Has a command carried out, and waits until it is.
fn have(simulation: &mut Simulation, command: &Command) {
    let now_s = simulation.now_s();
    simulation.apply(now_s, command).unwrap();
    run(simulation, now_s + 0.01);
}

/// Strikes the cue ball and runs until everything has settled.
fn shot(simulation: Simulation, speed_m_s: f64, azimuth_deg: f64) -> Simulation {
    let strike = Strike { speed_m_s, azimuth_deg, ..Strike::CENTRE };
    simulation.strike(strike).unwrap().run_until_rest().unwrap().end
}

fn states(simulation: &Simulation) -> Vec<BallState> {
    simulation.snapshot(simulation.now_s()).balls
}

fn places(simulation: &Simulation) -> Vec<(BallPlace, DVec3)> {
    states(simulation).iter().map(|ball| (ball.place, ball.position)).collect()
}

#[test]
fn every_rack_of_a_game_stands_a_little_otherwise_and_none_overlaps() {
    let racks = racks();
    assert_eq!(racks.balls(0), Rack::eight_ball(7).place(pool()));
    let orders: std::collections::BTreeSet<Vec<u64>> = (0..50)
        .map(|serial| {
            let balls = racks.balls(serial).unwrap();
            assert_eq!(overlaps(&balls), None, "rack {serial}");
            balls.iter().map(|(_, state)| state.position.x.to_bits()).collect()
        })
        .collect();
    assert_eq!(orders.len(), 50);
    assert_eq!(racks.balls(3), racks.balls(3));
    // Listed balls lie as they were listed.
    let listed = vec![on_bed(0, 0.1, 0.2, DVec3::ZERO, DVec3::ZERO)];
    let alone = Racks::new(Rack::from_balls(listed.clone()), Vec::new(), pool());
    assert_eq!(alone.balls(9).unwrap(), listed);
}

#[test]
fn a_rack_is_laid_down_whatever_fell_and_plays_like_a_first_one() {
    for settings in [exact(), stepping()] {
        let mut played = shot(racked(&settings), 9.0, 0.5);
        have(&mut played, &rack(2));
        let wanted = racks().balls(2).unwrap();
        for (seen, (ball, state)) in states(&played).iter().zip(&wanted) {
            assert_eq!((seen.place, ball.id), (BallPlace::OnTable, seen.id), "{settings:?}");
            assert!(seen.position.distance(state.position) < 1e-9, "{settings:?} {}", ball.id);
        }
        assert!(played.is_still(), "{settings:?}");
        // It breaks as that rack does in a world of its own.
        let again = played.with_balls(wanted).unwrap();
        let (one, other) = (shot(played, 8.0, 0.0), shot(again, 8.0, 0.0));
        let fell = |end: &Simulation| {
            let balls = states(end);
            balls.into_iter().filter(|ball| ball.place != BallPlace::OnTable).count()
        };
        assert!(fell(&one) <= 15 && fell(&other) <= 15);
        assert!(one.ledger().residual_j.abs() < 1e-3, "{:?}", one.ledger());
    }
}

#[test]
fn a_ball_that_no_rack_has_is_taken_off() {
    for settings in [exact(), stepping()] {
        let mut balls = racks().balls(0).unwrap();
        balls.push(on_bed(40, -0.2, 0.3, DVec3::ZERO, DVec3::ZERO));
        let world = Simulation::from_parts(pool(), balls, &settings).unwrap();
        let mut world = world.with_racks(racks());
        have(&mut world, &rack(1));
        assert_eq!(state(&world, 40).place, BallPlace::InHand);
        assert_eq!(state(&world, 15).place, BallPlace::OnTable);
    }
}

#[test]
fn undo_brings_back_every_ball_shot_by_shot_and_no_further() {
    for settings in [exact(), stepping()] {
        let first = racked(&settings);
        let start = places(&first);
        let second = shot(first, 9.0, 0.5);
        let between = places(&second);
        assert_ne!(start, between);
        let mut end = shot(second, 6.0, 77.0);
        assert_ne!(between, places(&end));
        for wanted in [&between, &start, &start] {
            have(&mut end, &Command::Undo);
            for (seen, wanted) in places(&end).iter().zip(wanted) {
                assert_eq!(seen.0, wanted.0, "{settings:?}");
                // Out of play it does not matter where.
                let is_out = seen.0 != BallPlace::OnTable;
                assert!(is_out || seen.1.distance(wanted.1) < 1e-9, "{settings:?}");
            }
        }
        assert!(end.is_still());
    }
}

#[test]
fn a_shot_that_is_taken_back_can_be_played_again_to_the_same_end() {
    let first = racked(&exact());
    let once = shot(first, 9.0, 0.5);
    let mut again = once.clone();
    have(&mut again, &Command::Undo);
    let again = shot(again, 9.0, 0.5);
    for (one, other) in places(&once).iter().zip(&places(&again)) {
        // The same from another time on: equal but for what the clock rounds, which a break grows.
        assert_eq!(one.0 == BallPlace::OnTable, other.0 == BallPlace::OnTable);
    }
}

#[test]
fn a_shot_under_way_is_taken_back_at_once() {
    for settings in [exact(), stepping()] {
        let first = racked(&settings);
        let start = places(&first);
        let strike = Strike { speed_m_s: 8.0, ..Strike::CENTRE };
        let mut world = first.strike(strike).unwrap();
        let until = world.now_s() + 1.0;
        let facts = run(&mut world, until);
        assert!(facts.iter().any(|fact| matches!(fact.kind, FactKind::BallsCollided { .. })));
        have(&mut world, &Command::Undo);
        have(&mut world, &Command::LiftCue);
        for (seen, wanted) in places(&world).iter().zip(&start) {
            assert_eq!(seen.0, wanted.0);
            assert!(seen.1.distance(wanted.1) < 1e-9, "{settings:?}");
        }
        let until = world.now_s() + 2.0;
        run(&mut world, until);
        assert!(world.is_still());
    }
}

#[test]
fn memory_keeps_the_last_shots_only_and_none_where_nobody_asked_for_it() {
    for settings in [exact(), stepping()] {
        let mut world = racked(&settings);
        let mut seen = Vec::new();
        for angle in [0.5, 60.0, 120.0, 200.0] {
            seen.push(places(&world));
            world = shot(world, 3.0, angle);
        }
        for _ in 0..5 {
            have(&mut world, &Command::Undo);
        }
        let cue_ball = |places: &[(BallPlace, DVec3)]| places[0].1;
        let apart = |wanted: usize| cue_ball(&places(&world)).distance(cue_ball(&seen[wanted]));
        assert!(apart(1) < 1e-9 && apart(0) > 0.1, "the oldest of three");

        let forgetful = Simulation::from_parts(pool(), racks().balls(0).unwrap(), &settings);
        let mut world = shot(forgetful.unwrap(), 3.0, 0.5);
        let mut other = world.clone();
        have(&mut world, &Command::Undo);
        let until = world.now_s();
        run(&mut other, until);
        assert_eq!(digest(&world), digest(&other));
    }
}

#[test]
fn where_object_balls_are_left_alone_a_hand_takes_up_the_cue_ball_only() {
    for settings in [exact(), stepping()] {
        let mut world = racked(&settings).with_object_balls_left_alone();
        let start = state(&world, 5).position;
        let place = |ball: u16| Command::PlaceBall {
            ball: BallId(ball),
            position_m: DVec2::new(-0.3, 0.3),
            zone: Zone::Anywhere,
        };
        have(&mut world, &place(5));
        assert_eq!(state(&world, 5).position, start);
        have(&mut world, &place(0));
        assert!(state(&world, 0).position.truncate().distance(DVec2::new(-0.3, 0.3)) < 1e-12);
    }
}

#[test]
fn where_a_run_is_cut_changes_no_bit_of_a_rack_or_of_an_undo() {
    for settings in [exact(), stepping()] {
        let run_in = |cuts: u32| {
            let strike = Strike { speed_m_s: 8.0, azimuth_deg: 1.0, ..Strike::CENTRE };
            let mut world = racked(&settings).strike(strike).unwrap();
            let commands = [(0.5, Command::Undo), (1.5, rack(1)), (2.5, Command::Undo)];
            let mut facts = Vec::new();
            for (until, command) in commands {
                let from = world.now_s();
                for cut in 1..=cuts {
                    let to = from + (until - from) * f64::from(cut) / f64::from(cuts);
                    facts.extend(run(&mut world, to));
                }
                world.apply(until, &command).unwrap();
            }
            facts.extend(run(&mut world, 4.0));
            (digest(&world), facts)
        };
        assert_eq!(run_in(1), run_in(17), "{settings:?}");
    }
}
