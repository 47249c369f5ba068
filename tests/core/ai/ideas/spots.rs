//! Places for a cue ball in hand.

use super::all;
use crate::ai::{R, random_view, table, view};
use glam::{DVec2, dvec2};
use hapticbillard::ai::{
    Goal, IdeaKind, Repertoire, StrokeNoise, TableView2d, ideas, spots, zone_holds,
};
use hapticbillard::events::{ShotKind, Zone};
use hapticbillard::rack::Rack;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

fn found(view: &TableView2d, zone: Zone, goal: &Goal) -> Vec<DVec2> {
    spots(view, zone, goal, &StrokeNoise::OLYMPIAD, &mut Pcg64Mcg::seed_from_u64(3))
}

fn best_pot(view: &TableView2d, cue: DVec2) -> f64 {
    ideas(view, cue, &all(view), &StrokeNoise::OLYMPIAD, Repertoire::Plain)
        .iter()
        .filter(|idea| idea.kind == IdeaKind::Pot)
        .map(|idea| idea.chance)
        .fold(0.0, f64::max)
}

#[test]
fn all_spots_lie_in_the_zone_with_room_and_apart() {
    for seed in 0..100 {
        let view = random_view(seed, 1 + (seed % 15) as u16);
        for zone in [Zone::Anywhere, Zone::Kitchen, Zone::D] {
            let spots = found(&view, zone, &all(&view));
            assert!((1..=24).contains(&spots.len()));
            for (i, spot) in spots.iter().enumerate() {
                assert!(zone_holds(zone, &view.bed, *spot) && view.has_room(*spot));
                assert!(spots[..i].iter().all(|other| other.distance(*spot) > 0.02));
            }
            assert_eq!(spots, found(&view, zone, &all(&view)), "same seed, same spots");
        }
    }
}

#[test]
fn with_ball_in_hand_some_pot_is_nearly_sure() {
    let chances: Vec<f64> = (0..100)
        .map(|seed| {
            let view = random_view(seed, 8);
            best_pot(&view, found(&view, Zone::Anywhere, &all(&view))[0])
        })
        .collect();
    let sure = chances.iter().filter(|chance| **chance > 0.98).count();
    assert!(sure >= 98, "{sure} of 100");
}

#[test]
fn the_first_spot_is_as_good_as_any() {
    for seed in 0..30 {
        let view = random_view(seed, 6);
        let spots = found(&view, Zone::Kitchen, &all(&view));
        let first = best_pot(&view, spots[0]);
        let best = spots.iter().map(|spot| best_pot(&view, *spot)).fold(0.0, f64::max);
        assert!(first > 0.6 * best, "{seed}: {first} of {best}");
    }
}

#[test]
fn break_spots_spread_over_the_kitchen() {
    let balls = Rack::nine_ball(1).place(table()).unwrap();
    let lying: Vec<_> =
        balls[1..].iter().map(|(ball, state)| (ball.id.0, state.position.truncate())).collect();
    let view = view(dvec2(-0.7, 0.0), &lying);
    let goal = Goal { shot: ShotKind::Break, ..all(&view) };
    let spots = found(&view, Zone::Kitchen, &goal);
    let beside = |least: f64, most: f64| spots.iter().any(|s| (least..most).contains(&s.y));
    assert!(beside(-0.6, -0.4) && beside(0.4, 0.6) && beside(-R, R), "{spots:?}");
}
