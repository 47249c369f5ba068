//! The exact solver over many random shots: what must hold whatever happens.

use super::exact;
use crate::physics::scenes::{R, digest, on_bed, pool, world};
use glam::DVec3;
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::events::FactSet;
use hapticbillard::physics::Simulation;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// How many random shots: a few by default, as many as `SHOTS` says.
pub fn shots(default: u64) -> u64 {
    std::env::var("SHOTS").ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// The number of the first one: to look at a single shot.
fn first_shot() -> u64 {
    std::env::var("FIRST_SHOT").ok().and_then(|text| text.parse().ok()).unwrap_or(0)
}

fn seed() -> u64 {
    std::env::var("FUZZ_SEED").ok().and_then(|text| text.parse().ok()).unwrap_or(1)
}

fn vector(random: &mut Pcg64, size: f64) -> DVec3 {
    let mut one = || random.random_range(-size..size);
    DVec3::new(one(), one(), one())
}

/// A random shot: a break of 15 balls, or 1 to 4 balls anywhere, some of them flying.
pub fn random_shot(case: u64) -> Vec<(Ball, BallState)> {
    let mut random = Pcg64::seed_from_u64(seed() << 32 | case);
    let speed = random.random_range(0.2..14.0);
    if case.is_multiple_of(4) {
        let gap = [0.0, 1e-7, 1e-5, 1e-4][random.random_range(0..4)];
        let mut balls = crate::physics::scenes::break_shot(gap);
        let spin = vector(&mut random, 300.0);
        let aside = random.random_range(-0.2..0.2);
        balls[0] = on_bed(0, -0.635, aside, DVec3::new(speed, -0.5 * aside * speed, 0.0), spin);
        return balls;
    }
    let count = random.random_range(1..5u16);
    let mut balls: Vec<(Ball, BallState)> = Vec::new();
    while balls.len() < usize::from(count) {
        let x = random.random_range(-1.2..1.2);
        let y = random.random_range(-0.58..0.58);
        let free = |other: &(Ball, BallState)| {
            other.1.position.truncate().distance(glam::DVec2::new(x, y)) > 2.0 * R
        };
        if !balls.iter().all(free) {
            continue;
        }
        let moves = balls.is_empty() || random.random_range(0..4) == 0;
        let flies = moves && random.random_range(0..5) == 0;
        let mut velocity = if moves { vector(&mut random, speed) } else { DVec3::ZERO };
        let spin = if moves { vector(&mut random, 300.0) } else { DVec3::ZERO };
        velocity.z = if flies { 0.3 * velocity.z.abs() } else { 0.0 };
        balls.push(on_bed(balls.len() as u16, x, y, velocity, spin));
    }
    balls
}

fn mechanical(simulation: &Simulation) -> f64 {
    let ledger = simulation.ledger();
    ledger.kinetic_j + ledger.potential_j + ledger.removed_j
}

/// The deepest overlap of two balls [m], and which.
fn deepest(simulation: &Simulation) -> (f64, String) {
    let snapshot = simulation.snapshot(simulation.now_s());
    let balls: Vec<_> = snapshot.on_table().collect();
    let mut deepest = (0.0_f64, String::new());
    for (place, a) in balls.iter().enumerate() {
        for b in &balls[place + 1..] {
            let depth = 2.0 * R - a.position.distance(b.position);
            if depth > deepest.0 {
                deepest = (depth, format!("{a:?} {b:?}"));
            }
        }
    }
    deepest
}

#[test]
fn random_shots_end_lose_energy_and_do_not_overlap() {
    let start = world(pool(), &random_shot(0), &exact());
    let mut failed = Vec::new();
    for case in first_shot()..first_shot() + shots(60) {
        let mut simulation = start.with_balls(random_shot(case)).unwrap();
        let mut facts = Vec::new();
        let mut energy = mechanical(&simulation);
        // Looked at whenever anything is told, and in between.
        let problem = loop {
            let limit = simulation.now_s() + 0.25;
            if let Err(error) = simulation.advance(limit, FactSet::ALL, &mut facts) {
                break Some(error.to_string());
            }
            let now_s = simulation.now_s();
            let now = mechanical(&simulation);
            if now > energy + 1e-12 {
                let snapshot = simulation.snapshot(now_s);
                let moving: Vec<_> =
                    snapshot.on_table().filter(|ball| ball.velocity != DVec3::ZERO).collect();
                break Some(format!("gained {:.1e} J at {now_s} s: {moving:?}", now - energy));
            }
            energy = now;
            let (depth, balls) = deepest(&simulation);
            if depth > 1e-6 {
                break Some(format!("overlap {depth:.1e} m at {now_s} s: {balls}"));
            }
            if simulation.is_still() {
                break None;
            }
            if now_s > 200.0 {
                break Some("does not end".into());
            }
        };
        let ledger = simulation.ledger();
        let residual = ledger.residual_j.abs().max(ledger.momentum.residual.length());
        if let Some(problem) = problem {
            failed.push(format!("case {case}: {problem}"));
        } else if residual > 1e-8 {
            failed.push(format!("case {case}: residual {residual:.1e}"));
        }
    }
    assert!(failed.is_empty(), "{} failed:\n{}", failed.len(), failed.join("\n"));
}

#[test]
fn where_time_is_cut_changes_no_bit() {
    let first = world(pool(), &random_shot(0), &exact());
    for case in 0..shots(8).min(200) {
        let start = first.with_balls(random_shot(case)).unwrap();
        let mut whole = start.clone();
        let mut facts = Vec::new();
        whole.advance(4.0, FactSet::NONE, &mut facts).unwrap();
        let mut cut = start;
        let mut cut_facts = Vec::new();
        let mut random = Pcg64::seed_from_u64(case);
        let mut limit: f64 = 0.0;
        while limit < 4.0 {
            limit = (limit + random.random_range(1e-4..0.1)).min(4.0);
            cut.advance(limit, FactSet::NONE, &mut cut_facts).unwrap();
        }
        assert_eq!(facts, cut_facts, "case {case}");
        assert_eq!(digest(&whole), digest(&cut), "case {case}");
    }
}
