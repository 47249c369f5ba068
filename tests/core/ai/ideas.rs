//! Ideas: what geometry proposes, held against the simulation.

use super::random_view;
use hapticbillard::ai::{Goal, Idea, IdeaKind, Repertoire, StrokeNoise, TableView2d, ideas};
use hapticbillard::events::ShotKind;

pub fn all(view: &TableView2d) -> Goal {
    let balls: Vec<_> = view.balls.iter().map(|ball| ball.id).collect();
    Goal { shot: ShotKind::Normal, own: balls.clone(), legal: balls }
}

pub fn full(view: &TableView2d) -> Vec<Idea> {
    let cue = view.cue_ball.expect("the cue ball lies on the table");
    ideas(view, cue, &all(view), &StrokeNoise::OLYMPIAD, Repertoire::Full)
}

fn is_sound(idea: &Idea) -> bool {
    let numbers = [idea.cut_rad, idea.to_ball_m, idea.to_end_m, idea.speed_least_m_s];
    numbers.iter().all(|number| number.is_finite())
        && idea.ghost.is_finite()
        && (idea.direction.length() - 1.0).abs() < 1e-9
        && idea.first_way.is_none_or(|way| (way.length() - 1.0).abs() < 1e-9)
        && (0.0..=1.0).contains(&idea.chance)
        && 0.0 < idea.speed_least_m_s
}

#[test]
fn every_idea_is_sound_and_the_best_comes_first() {
    let mut kinds = Vec::new();
    for seed in 0..300 {
        let view = random_view(seed, 1 + (seed % 15) as u16);
        let found = full(&view);
        assert!(!found.is_empty());
        for idea in &found {
            assert!(is_sound(idea), "{seed}: {idea:?}");
        }
        assert!(found.is_sorted_by(|a, b| a.chance >= b.chance));
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
        println!("{kind:?}: {count}");
        assert!(count > 100, "{kind:?}: {count}");
    }
}
