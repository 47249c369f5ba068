//! Ideas: what geometry proposes, alone and held against the simulation.

mod crowded;
mod pots;
mod simulated;
mod spots;

use super::{random_view, table, view};
use glam::{DVec2, dvec2};
use hapticbillard::ai::{Goal, Idea, IdeaKind, Repertoire, StrokeNoise, TableView2d, ideas};
use hapticbillard::events::ShotKind;
use hapticbillard::ids::{BallId, PocketId};
use hapticbillard::rack::Rack;

pub fn all(view: &TableView2d) -> Goal {
    let balls: Vec<_> = view.balls.iter().map(|ball| ball.id).collect();
    Goal { shot: ShotKind::Normal, own: balls.clone(), legal: balls }
}

pub fn full(view: &TableView2d) -> Vec<Idea> {
    let cue = view.cue_ball.expect("the cue ball lies on the table");
    ideas(view, cue, &all(view), &StrokeNoise::OLYMPIAD, Repertoire::Full)
}

pub fn is_sound(idea: &Idea) -> bool {
    let numbers = [idea.cut_rad, idea.to_ball_m, idea.to_end_m, idea.speed_least_m_s];
    numbers.iter().all(|number| number.is_finite())
        && idea.ghost.is_finite()
        && (idea.direction.length() - 1.0).abs() < 1e-9
        && idea.first_way.is_none_or(|way| (way.length() - 1.0).abs() < 1e-9)
        && (0.0..=1.0).contains(&idea.chance)
        && 0.0 < idea.speed_least_m_s
        && idea.lines.iter().all(|line| line.from.is_finite() && line.to.is_finite())
}

#[test]
fn every_idea_is_sound_and_the_best_comes_first() {
    let mut kinds = Vec::new();
    for seed in 0..300 {
        let view = random_view(seed, 1 + (seed % 15) as u16);
        let found = full(&view);
        for idea in &found {
            assert!(is_sound(idea), "{seed}: {idea:?}");
        }
        assert!(found.is_sorted_by(|a, b| a.chance >= b.chance - 0.001));
        assert_eq!(found, full(&view), "the same table, the same ideas");
        kinds.extend(found.iter().map(|idea| idea.kind));
    }
    for kind in [
        IdeaKind::Pot,
        IdeaKind::Combination,
        IdeaKind::Bank,
        IdeaKind::Kick,
        IdeaKind::Carom,
        IdeaKind::Contact,
    ] {
        let count = kinds.iter().filter(|found| **found == kind).count();
        assert!(count > 1000, "{kind:?}: {count}");
    }
}

fn mirrored_pocket(pocket: PocketId) -> PocketId {
    match pocket {
        PocketId::Hl => PocketId::Hr,
        PocketId::Hr => PocketId::Hl,
        PocketId::Ml => PocketId::Mr,
        PocketId::Mr => PocketId::Ml,
        PocketId::Fl => PocketId::Fr,
        PocketId::Fr => PocketId::Fl,
    }
}

#[test]
fn the_mirrored_table_gives_the_mirrored_ideas() {
    let flip = |p: DVec2| dvec2(p.x, -p.y);
    for seed in 0..200 {
        let view = random_view(seed, 1 + (seed % 15) as u16);
        let mut mirror = view.clone();
        mirror.cue_ball = view.cue_ball.map(flip);
        mirror.balls.iter_mut().for_each(|ball| ball.position = flip(ball.position));

        let (found, mut others) = (full(&view), full(&mirror));
        assert_eq!(found.len(), others.len(), "{seed}");
        for idea in &found {
            let twin = others.iter().position(|other| {
                (other.kind, other.first, other.ball) == (idea.kind, idea.first, idea.ball)
                    && other.pocket == idea.pocket.map(mirrored_pocket)
                    && other.direction.distance(flip(idea.direction)) < 1e-9
                    && (other.chance - idea.chance).abs() < 1e-9
                    && (other.speed_least_m_s - idea.speed_least_m_s).abs() < 1e-9
                    && (other.cut_rad + idea.cut_rad).abs() < 1e-9
            });
            let twin = twin.unwrap_or_else(|| panic!("{seed}: no twin of {idea:?}"));
            others.swap_remove(twin);
        }
    }
}

#[test]
fn plain_ideas_are_pots_and_contacts_only() {
    for seed in 0..50 {
        let view = random_view(seed, 7);
        let cue = view.cue_ball.unwrap();
        let found = ideas(&view, cue, &all(&view), &StrokeNoise::OLYMPIAD, Repertoire::Plain);
        let plain = [IdeaKind::Pot, IdeaKind::Contact, IdeaKind::Desperate];
        assert!(found.iter().all(|idea| plain.contains(&idea.kind)));
        let both: Vec<_> =
            full(&view).into_iter().filter(|idea| plain.contains(&idea.kind)).collect();
        assert_eq!(found, both, "the full repertoire has them as well");
    }
}

#[test]
fn the_first_contacts_differ_in_ball_and_cut() {
    let view = view(
        dvec2(-0.5, 0.1),
        &[(1, dvec2(0.5, 0.0)), (2, dvec2(0.3, 0.4)), (3, dvec2(0.0, -0.4))],
    );
    let contacts: Vec<_> =
        full(&view).into_iter().filter(|idea| idea.kind == IdeaKind::Contact).take(6).collect();
    let mut balls: Vec<_> = contacts.iter().map(|idea| idea.first).collect();
    balls.sort();
    balls.dedup();
    assert_eq!(balls.len(), 3);
    assert!(contacts.iter().any(|idea| idea.cut_rad.abs() > 0.8));
}

#[test]
fn more_noise_makes_every_pot_less_likely() {
    for seed in 0..50 {
        let view = random_view(seed, 5);
        let cue = view.cue_ball.unwrap();
        let best = |times| {
            ideas(&view, cue, &all(&view), &StrokeNoise::olympiad(times), Repertoire::Plain)
                .into_iter()
                .filter(|idea| idea.kind == IdeaKind::Pot)
                .map(|idea| idea.chance)
                .reduce(f64::max)
        };
        let chances = [0.0, 0.5, 1.0, 2.0, 5.0].map(best);
        assert!(chances.is_sorted_by(|a, b| a >= b), "{seed}: {chances:?}");
    }
}

#[test]
fn a_ball_half_hidden_behind_another_goes_past_it() {
    // Ball 2 covers the right half of the foot right corner's mouth from ball 1.
    let (at, pocket) = (dvec2(0.6, -0.2), table().pockets[5]);
    let way = (pocket.target() - at).normalize();
    let beside = pocket.target() - way * 0.25 - way.perp() * 0.06;
    let open = view(at - way * 0.5, &[(1, at)]);
    let hidden = view(at - way * 0.5, &[(1, at), (2, beside)]);
    let pot = |view: &TableView2d| {
        full(view)
            .into_iter()
            .find(|idea| {
                idea.kind == IdeaKind::Pot
                    && (idea.ball, idea.pocket) == (Some(BallId(1)), Some(pocket.id))
            })
            .expect("it can be potted")
    };
    let (free, past) = (pot(&open), pot(&hidden));
    let turned = way.perp().dot(past.first_way.unwrap() - free.first_way.unwrap());
    assert!(turned > 0.002, "it is sent to the left of the middle: {turned}");
    assert!(past.chance < free.chance);
}

#[test]
fn the_break_meets_apex_and_corners_of_the_rack() {
    for rack in [Rack::eight_ball(7), Rack::nine_ball(7)] {
        let balls = rack.place(table()).unwrap();
        let lying: Vec<_> =
            balls[1..].iter().map(|(ball, state)| (ball.id.0, state.position.truncate())).collect();
        let view = view(dvec2(-0.7, 0.2), &lying);
        let goal = Goal { shot: ShotKind::Break, ..all(&view) };
        let cue = view.cue_ball.unwrap();
        let found = ideas(&view, cue, &goal, &StrokeNoise::OLYMPIAD, Repertoire::Full);
        assert!(found.iter().all(|idea| idea.kind == IdeaKind::Break && is_sound(idea)));
        let apex = lying.iter().min_by(|a, b| a.1.x.total_cmp(&b.1.x)).unwrap();
        let full = found.iter().find(|i| i.first == Some(BallId(apex.0)) && i.cut_rad == 0.0);
        assert!(full.is_some_and(|idea| idea.chance > 0.99), "{full:?}");
        assert_eq!(found[0].first, Some(BallId(apex.0)), "full at the apex is the first idea");
        let corners = found[..6].iter().filter(|idea| idea.cut_rad.abs() > 0.8).count();
        assert!(corners >= 1, "a corner from outside is among the first");
        let mut firsts: Vec<_> = found.iter().filter_map(|idea| idea.first).collect();
        firsts.sort();
        firsts.dedup();
        assert!(firsts.len() >= 3, "balls of the front and the corners: {firsts:?}");
    }
}

#[test]
fn touching_balls_that_point_into_a_pocket_are_a_combination() {
    let pocket = table().pockets[5];
    let second = pocket.target() - dvec2(0.5, -0.35);
    let way = (pocket.target() - second).normalize();
    let first = second - way * (2.0 * super::R);
    let view = view(first - way * 0.4 + way.perp() * 0.15, &[(1, first), (2, second)]);
    let combination = full(&view).into_iter().find(|idea| {
        idea.kind == IdeaKind::Combination
            && (idea.first, idea.ball) == (Some(BallId(1)), Some(BallId(2)))
    });
    assert!(combination.is_some_and(|idea| idea.chance > 0.5));
}
