//! Whatever lies wherever: in jaws, at rails, frozen, even on top of each other.

use super::{full, is_sound};
use crate::ai::table;
use glam::{DVec2, dvec2};
use hapticbillard::ai::{SeenBall, TableView2d};
use hapticbillard::ids::BallId;
use hapticbillard::table::Table;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::OnceLock;

fn tables() -> [(&'static Table, f64); 3] {
    static OTHERS: OnceLock<[Table; 2]> = OnceLock::new();
    let [snooker, carom] =
        OTHERS.get_or_init(|| ["snooker-12ft", "carom-10ft"].map(|n| Table::preset(n).unwrap()));
    [(table(), 0.028575), (snooker, 0.02625), (carom, 0.03075)]
}

/// Somewhere awkward more often than not; balls may even overlap.
fn awkward(view: &TableView2d, rng: &mut impl Rng) -> DVec2 {
    let radius = view.ball_radius_m;
    let half = 0.5 * dvec2(view.bed.length_m, view.bed.width_m) - DVec2::splat(radius);
    let anywhere = dvec2(rng.random_range(-half.x..half.x), rng.random_range(-half.y..half.y));
    match rng.random_range(0..6) {
        // Frozen to a long rail, to a short one.
        0 => dvec2(anywhere.x, half.y.copysign(anywhere.y)),
        1 => dvec2(half.x.copysign(anywhere.x), anywhere.y),
        // In the jaws, up to the very middle of mouth and opening.
        2 if !view.pockets.is_empty() => {
            let pocket = &view.pockets[rng.random_range(0..view.pockets.len())];
            let share = [0.0, 1.0, rng.random_range(-0.5..1.0)][rng.random_range(0..3)];
            pocket.target().lerp(pocket.centre, share)
        }
        // Frozen to another ball.
        3 if !view.balls.is_empty() => {
            let other = view.balls[rng.random_range(0..view.balls.len())].position;
            let angle = std::f64::consts::TAU * rng.random_range(0..12) as f64 / 12.0;
            other + dvec2(libm::cos(angle), libm::sin(angle)) * (2.0 * radius)
        }
        _ => anywhere,
    }
}

fn crowd(seed: u64) -> TableView2d {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    // Carom is the slowest: one in ten.
    let (table, ball_radius_m) = tables()[[0, 0, 0, 0, 0, 1, 1, 1, 1, 2][(seed % 10) as usize]];
    let count = if table.pockets.is_empty() { 2 } else { rng.random_range(1..10) };
    let mut view = TableView2d {
        cue_ball: None,
        balls: Vec::new(),
        ball_radius_m,
        bed: table.bed.unwrap(),
        pockets: table.pockets.clone(),
    };
    for id in 1..=count {
        let position = awkward(&view, &mut rng);
        view.balls.push(SeenBall { id: BallId(id), position });
    }
    view.cue_ball = Some(awkward(&view, &mut rng));
    view
}

#[test]
fn ten_thousand_crowded_tables_give_sound_ideas() {
    for seed in 0..10_000 {
        let view = crowd(seed);
        let found = full(&view);
        assert!(!found.is_empty(), "{seed}: there is a ball");
        for idea in &found {
            assert!(is_sound(idea), "{seed}: {idea:?}");
        }
    }
}

#[test]
fn balls_on_one_place_and_no_balls_are_no_trouble() {
    let mut view = crowd(0);
    view.balls.truncate(1);
    view.cue_ball = Some(view.balls[0].position);
    assert!(full(&view).iter().all(is_sound) && !full(&view).is_empty());
    view.balls.clear();
    assert!(full(&view).is_empty());
}
