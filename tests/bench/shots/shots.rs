//! Run times of breaks and of small shots until rest, by both solvers, and of making a world.
//!
//! `cargo bench --manifest-path tests/bench/shots/Cargo.toml [-- NAME]`
//!
//! The shots are those of `simulate --bench`: fifteen racked balls and a cue ball at 8 to 10 m/s,
//! and two or three balls at 0.5 to 5 m/s, on the full mesh of the nine-foot table, flight
//! included. An iteration is one shot, each in its turn. Criterion measures real time; where other
//! work runs on the machine, `simulate --bench` is the better clock.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use hapticbillard::events::{FactSet, Topic};
use hapticbillard::physics::sample_shots::{Start, break_shot, small_shot};
use hapticbillard::physics::{PhysicsSettings, Simulation, SolverKind};
use hapticbillard::table::Table;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// Shots of each kind.
const SHOTS: usize = 100;
/// Nobody waits longer for rest [s].
const LONGEST_S: f64 = 600.0;

fn settings(solver: SolverKind) -> PhysicsSettings {
    PhysicsSettings { solver, ..PhysicsSettings::default() }
}

fn shots(table: &Table, name: &str) -> Vec<Start> {
    let mut random = Pcg64::seed_from_u64(7);
    let one = |random: &mut Pcg64| match name {
        "break" => break_shot(table, random),
        _ => small_shot(table, random),
    };
    (0..SHOTS).map(|_| one(&mut random).expect("the table has a bed")).collect()
}

fn until_rest(mut simulation: Simulation) -> Simulation {
    let mut facts = Vec::new();
    let settled = FactSet::of(&[Topic::Settled]);
    simulation.advance(LONGEST_S, settled, &mut facts).expect("these shots end");
    simulation
}

fn run(criterion: &mut Criterion) {
    let table = Table::preset("pool-9ft").expect("a shipped table");
    for (solver, label) in
        [(SolverKind::EventDriven, "event-driven"), (SolverKind::FixedStep, "fixed-step at 4 ms")]
    {
        for name in ["break", "small"] {
            let shots = shots(&table, name);
            let first = Simulation::from_parts(&table, shots[0].clone(), &settings(solver));
            let first = first.expect("the shots are possible");
            let starts: Vec<Simulation> = shots
                .into_iter()
                .map(|balls| first.with_balls(balls).expect("the shots are possible"))
                .collect();
            let mut turn = 0;
            let mut group = criterion.benchmark_group(label);
            if solver == SolverKind::FixedStep {
                group.sample_size(10);
            }
            group.bench_function(name, |bencher| {
                let next = || {
                    turn = (turn + 1) % starts.len();
                    starts[turn].clone()
                };
                bencher.iter_batched(next, until_rest, BatchSize::SmallInput);
            });
            group.finish();
        }
    }

    let balls = shots(&table, "break").swap_remove(0);
    let exact = settings(SolverKind::EventDriven);
    let mut group = criterion.benchmark_group("make");
    group.sample_size(10);
    group.bench_function("world", |bencher| {
        bencher.iter(|| Simulation::from_parts(&table, balls.clone(), &exact));
    });
    let world = Simulation::from_parts(&table, balls.clone(), &exact).expect("possible");
    group.bench_function("world on a shared table", |bencher| {
        bencher.iter(|| world.with_balls(balls.clone()));
    });
    group.finish();
}

criterion_group!(benches, run);
criterion_main!(benches);
