//! Many shots at once: the same bits as one by one, whoever computes them.

use crate::cli::{folder, lines as lines_of, program, text};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::physics::{PhysicsError, PhysicsSettings, Simulation, SolverKind, Strike};
use hapticbillard::physics::{Shot, sample_shots};
use hapticbillard::rack::Rack;
use hapticbillard::table::Table;
use hapticbillard_actors::batch::{self, Setup};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};

fn start(solver: SolverKind) -> (Table, Simulation) {
    let table = Table::preset("pool-9ft").unwrap();
    let balls = Rack::eight_ball(3).place(&table).unwrap();
    let settings = PhysicsSettings { solver, ..PhysicsSettings::default() };
    let start = Simulation::from_parts(&table, balls, &settings).unwrap();
    (table, start)
}

/// Strokes at the rack, and layouts that are already in motion.
fn setups(table: &Table, count: u32) -> Vec<Setup> {
    let mut random = Pcg64::seed_from_u64(5);
    (0..count)
        .map(|n| match n % 3 {
            0 => {
                let azimuth_deg = f64::from(n) - 3.0;
                let strike = Strike { speed_m_s: 3.0, azimuth_deg, ..Strike::CENTRE };
                Setup { strike: Some(strike), balls: None }
            }
            1 => {
                let balls = sample_shots::break_shot(table, &mut random).unwrap();
                Setup { balls: Some(balls), strike: None }
            }
            _ => {
                let balls = sample_shots::small_shot(table, &mut random).unwrap();
                Setup { balls: Some(balls), strike: None }
            }
        })
        .collect()
}

fn digest(result: Result<Shot, PhysicsError>) -> (usize, Digest) {
    let shot = result.unwrap();
    let mut hash = StateHash::new();
    shot.end.hash(&mut hash);
    (shot.facts.len(), hash.finish())
}

#[test]
fn a_batch_has_the_bits_of_its_shots_run_one_by_one_on_any_number_of_threads() {
    for (solver, count) in [(SolverKind::EventDriven, 40), (SolverKind::FixedStep, 6)] {
        let (table, start) = start(solver);
        let setups = setups(&table, count);
        let alone: Vec<_> = setups.iter().map(|setup| digest(setup.run(&start))).collect();
        for threads in [Some(1), Some(2), Some(7), None] {
            let threads = threads.and_then(NonZeroUsize::new);
            let mut together = Vec::new();
            let done = AtomicUsize::new(0);
            let count_one = || {
                done.fetch_add(1, Ordering::Relaxed);
            };
            batch::run(&start, &setups, threads, count_one, |n, result| {
                assert_eq!(n, together.len());
                together.push(digest(result));
                Ok::<(), ()>(())
            })
            .unwrap();
            assert_eq!(alone, together, "{solver:?} {threads:?}");
            assert_eq!(done.into_inner(), setups.len());
        }
    }
}

#[test]
fn balls_on_a_shared_table_have_the_bits_of_balls_on_a_table_of_their_own() {
    for solver in [SolverKind::EventDriven, SolverKind::FixedStep] {
        let (table, start) = start(solver);
        let mut random = Pcg64::seed_from_u64(6);
        for size in [1.0, 0.9, 1.1] {
            let mut balls = sample_shots::small_shot(&table, &mut random).unwrap();
            for (ball, state) in &mut balls {
                ball.radius_m *= size;
                state.position.z = ball.radius_m;
            }
            let settings = PhysicsSettings { solver, ..PhysicsSettings::default() };
            let own = Simulation::from_parts(&table, balls.clone(), &settings).unwrap();
            let shared = start.with_balls(balls).unwrap();
            assert_eq!(digest(own.run_until_rest()), digest(shared.run_until_rest()), "{solver:?}");
        }
    }
}

#[test]
fn a_batch_ends_with_the_first_result_that_nobody_wants() {
    let (table, start) = start(SolverKind::EventDriven);
    let setups = setups(&table, 90);
    let mut taken = 0;
    let ended = batch::run(
        &start,
        &setups,
        NonZeroUsize::new(2),
        || {},
        |_, _| {
            taken += 1;
            if taken == 3 { Err("enough") } else { Ok(()) }
        },
    );
    assert_eq!(ended, Err("enough"));
    assert_eq!(taken, 3);
}

/// A file of shots in a folder of this test's own.
fn batch_file(name: &str, shots: &str) -> String {
    let path = folder(&format!("batch-{name}")).join("shots.jsonl");
    std::fs::write(&path, shots).unwrap();
    path.to_str().unwrap().to_string()
}

#[test]
fn a_batch_prints_its_shots_in_the_order_of_the_file_on_any_number_of_threads() {
    let shots = "{\"speed_m_s\":4,\"azimuth_deg\":10}\n\n{\"speed_m_s\":0.5}\n\
        {\"balls\":[{\"id\":0,\"position_m\":[0,0,0.028575],\"velocity_m_s\":[2,0,0]}]}\n";
    let path = batch_file("order", shots);
    let run = |threads: &str| {
        let scene = ["simulate", "--scene", "free_play", "--json"];
        program(&[&scene[..], &["--batch", path.as_str(), "--threads", threads]].concat())
    };
    let (one, three) = (run("1"), run("3"));
    assert!(one.status.success(), "{}", text(&one.stderr));
    assert_eq!(text(&one.stdout), text(&three.stdout));
    let lines = lines_of(&one.stdout);
    assert_eq!(lines.len(), 4);
    for (place, line) in lines[..3].iter().enumerate() {
        assert_eq!(line["shot"], place + 1);
        assert!(line["end_s"].as_f64().unwrap() > 0.5);
    }
    // The ball of the third shot stands for the whole rack.
    assert_eq!(lines[2]["balls"].as_array().unwrap().len(), 1);
    assert_eq!(lines[3]["summary"]["shots"], 3);
}

#[test]
fn a_wrong_line_of_a_batch_is_named_with_its_number_and_exits_with_2() {
    for (name, line, says) in [
        ("key", "{\"sped_m_s\":4}", "sped_m_s"),
        ("number", "{\"speed_m_s\":\"fast\"}", "expected f64"),
        ("miss", "{\"speed_m_s\":4,\"side\":1.5}", "1.5"),
        ("still", "{\"speed_m_s\":-1}", "speed_m_s"),
        (
            "twice",
            "{\"balls\":[{\"id\":1,\"position_m\":[0,0,0.1]},\
            {\"id\":1,\"position_m\":[1,0,0.1]}]}",
            "1",
        ),
    ] {
        let shots = format!("{{\"speed_m_s\":1}}\n\n{line}\n{{\"speed_m_s\":1}}\n");
        let path = batch_file(name, &shots);
        let output = program(&["simulate", "--scene", "free_play", "--batch", &path]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        let error = text(&output.stderr);
        assert!(error.contains(&format!("{path}:3")) && error.contains(says), "{error}");
    }
}

#[test]
fn a_bench_prints_times_events_and_the_ratio_to_the_stepper() {
    let output = program(&["simulate", "--bench", "2", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let lines = lines_of(&output.stdout);
    assert_eq!(lines.len(), 9);
    let groups = lines[8]["summary"]["groups"].as_array().unwrap();
    let names = ["break", "small", "planar break", "planar small"];
    assert_eq!(groups.len(), names.len());
    for (group, name) in groups.iter().zip(names) {
        assert_eq!(group["group"], name);
        let looks = group["work"]["pocket_tests"].as_u64().unwrap();
        assert!(!name.starts_with("planar") || looks == 0, "{name}: {looks}");
        for key in ["events_per_shot", "us_per_event"] {
            assert!(group[key].as_f64().unwrap() > 0.0, "{key}");
        }
        assert!(group["cpu_us_per_shot"]["mean"].as_f64().unwrap() > 0.0);
        assert!(group["fixed_step"]["ratio"].as_f64().unwrap() > 0.0);
    }
    let output = program(&["simulate", "--scene", "one_ball", "--bench", "2", "--json"]);
    let lines = lines_of(&output.stdout);
    assert_eq!(lines[0]["summary"]["shots"], 2);
}
