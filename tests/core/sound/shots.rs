//! Real shots, from physics to samples.

use super::measure;
use glam::{DVec3, Vec3};
use hapticbillard::ball::{Ball, BallState, POOL_RADIUS_M};
use hapticbillard::events::{Fact, FactKind, FactSet};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{PhysicsSettings, Simulation, Strike};
use hapticbillard::rack::Rack;
use hapticbillard::sound::{
    Bank, Foley, Listener, MixSettings, Mixer, Script, Told, perform, render_offline,
};
use hapticbillard::table::Table;
use std::sync::Arc;

const RATE: f64 = 48_000.0;

/// Facts and score of a simulation up to `end_s`, looked at every 2 ms.
fn score(mut simulation: Simulation, end_s: f64) -> (Vec<Fact>, Vec<(u64, Told)>) {
    let first = Arc::new(simulation.snapshot(simulation.now_s()));
    let radii = first.balls.iter().map(|ball| (ball.id, POOL_RADIUS_M)).collect::<Vec<_>>();
    let mut script = Script::new(Foley::new(radii, 9.81, 7, first), RATE);
    let mut all = Vec::new();
    for step in 1..=(end_s * 500.0) as u32 {
        let time_s = f64::from(step) / 500.0;
        let mut facts = Vec::new();
        simulation.advance(time_s, FactSet::NONE, &mut facts).unwrap();
        let table = Arc::new(simulation.snapshot(time_s));
        facts.iter().for_each(|fact| script.hear(fact, Some(&table)));
        script.see(&table);
        all.extend(facts);
    }
    (all, script.finish())
}

fn break_shot() -> Simulation {
    let table = Table::preset("pool-9ft").unwrap();
    let strike = Strike { speed_m_s: 8.0, ..Strike::CENTRE };
    Simulation::new(table, Rack::eight_ball(7)).unwrap().strike(strike).unwrap()
}

fn mixer(listener: Listener) -> Mixer {
    let settings = MixSettings { rate_hz: RATE as f32, ..MixSettings::default() };
    let mut mixer = Mixer::new(settings, Arc::new(Bank::default()));
    mixer.set_listener(listener);
    mixer
}

fn render(listener: Listener, score: &[(u64, Told)], frames: u64) -> Vec<[f32; 2]> {
    let mut heard = Vec::new();
    let hand_on = |frames: &[[f32; 2]]| {
        heard.extend_from_slice(frames);
        Ok::<(), ()>(())
    };
    render_offline(&mut mixer(listener), score.iter().copied(), frames, hand_on).unwrap();
    heard
}

/// What a callback does with a ring, in blocks of these lengths.
fn perform_in(blocks: &[usize], score: &[(u64, Told)], frames: usize) -> Vec<[f32; 2]> {
    let mut mixer = mixer(Listener::default());
    let mut heard = vec![[0.0; 2]; frames];
    let (mut rest, mut told, mut lengths) = (&mut heard[..], score, blocks.iter().cycle());
    while !rest.is_empty() {
        let length = lengths.next().unwrap().min(&rest.len()).to_owned();
        let (now, later) = rest.split_at_mut(length);
        let next = |end| {
            let (first, others) = told.split_first().filter(|(first, _)| first.0 < end)?;
            told = others;
            Some(*first)
        };
        perform(&mut mixer, next, now);
        rest = later;
    }
    heard
}

#[test]
fn a_callback_plays_what_a_file_holds_however_it_is_cut() {
    let (_, score) = score(break_shot(), 1.2);
    let frames = 48_000;
    let file = render(Listener::default(), &score, frames);
    assert!(file.iter().any(|[left, _]| left.abs() > 0.01));
    for blocks in [&[512][..], &[1, 7, 64, 113, 2048], &[240]] {
        let heard = perform_in(blocks, &score, frames as usize);
        let first = file.iter().zip(&heard).position(|(a, b)| a != b);
        assert_eq!(first, None, "blocks of {blocks:?}");
    }
}

#[test]
fn every_onset_of_a_break_stands_at_its_fact_to_the_frame() {
    let (facts, score) = score(break_shot(), 3.0);
    let mut begun: Vec<(u64, f64)> = score
        .iter()
        .filter_map(|(frame, told)| match told {
            Told::Start { at_frame, onset } => {
                assert_eq!(frame, at_frame);
                Some((*at_frame, onset.time_s))
            }
            _ => None,
        })
        .collect();
    assert!(begun.len() > 20);
    for fact in facts.iter().filter(|fact| {
        matches!(fact.kind, FactKind::BallsCollided { .. } | FactKind::CushionHit { .. })
    }) {
        let place = begun.iter().position(|(_, time_s)| *time_s == fact.time_s).unwrap();
        let (frame, _) = begun.remove(place);
        assert!((frame as f64 - fact.time_s * RATE).abs() <= 0.5 + 1e-6);
    }
}

/// Two balls on a plane that meet at `speed_m_s`; the second lies at x = `at_x`.
fn meeting(speed_m_s: f64, at_x: f64) -> Simulation {
    let r = POOL_RADIUS_M;
    let mut comes = BallState::at_rest(BallId(0), DVec3::new(at_x, -0.01 - 2.0 * r, r));
    comes.velocity = DVec3::Y * speed_m_s;
    let lies = BallState::at_rest(BallId(1), DVec3::new(at_x, 0.0, r));
    let balls = vec![(Ball::pool(BallId(0)), comes), (Ball::pool(BallId(1)), lies)];
    Simulation::from_parts(&Table::plane(), balls, &PhysicsSettings::default()).unwrap()
}

/// The click alone, heard from where the listener is.
fn click(speed_m_s: f64, at_x: f64, listener: Listener) -> Vec<[f32; 2]> {
    let (facts, score) = score(meeting(speed_m_s, at_x), 0.01 / speed_m_s + 0.1);
    let score: Vec<_> =
        score.into_iter().filter(|(_, told)| matches!(told, Told::Start { .. })).collect();
    assert_eq!((facts.is_empty(), score.len()), (false, 1), "{facts:?}");
    let [(frame, _)] = score[..] else { return Vec::new() };
    let heard = render(listener, &score, frame + 4800);
    heard[frame as usize..].to_vec()
}

fn peak(heard: &[[f32; 2]], ear: usize) -> f64 {
    heard.iter().map(|frame| f64::from(frame[ear].abs())).fold(0.0, f64::max)
}

fn decibel(ratio: f64) -> f64 {
    20.0 * libm::log10(ratio)
}

/// Faces the line of the balls from `away_m` in front of them; +x is on the right.
fn in_front(away_m: f32) -> Listener {
    Listener::looking(Vec3::new(0.0, -away_m, 0.03), Vec3::Y, Vec3::Z)
}

#[test]
fn a_harder_shot_is_louder_and_brighter() {
    let (slow, fast) = (click(1.0, 0.0, in_front(1.0)), click(5.0, 0.0, in_front(1.0)));
    let louder = decibel(peak(&fast, 0) / peak(&slow, 0));
    assert!((15.0..23.0).contains(&louder), "{louder} dB");
    let bright = |heard: &[[f32; 2]]| {
        let left: Vec<f32> = heard.iter().map(|frame| frame[0]).collect();
        measure::centroid_hz(&left)
    };
    let (dull, bright) = (bright(&slow), bright(&fast));
    assert!(dull * 1.1 < bright, "{dull} Hz, {bright} Hz");
}

#[test]
fn left_is_left_and_twice_as_far_is_half_as_loud() {
    let left = click(3.0, -1.0, in_front(1.0));
    assert!(decibel(peak(&left, 0) / peak(&left, 1)) > 2.0);
    let right = click(3.0, 1.0, in_front(1.0));
    assert!(decibel(peak(&right, 1) / peak(&right, 0)) > 2.0);
    let fall = decibel(peak(&click(3.0, 0.0, in_front(4.0)), 0))
        - decibel(peak(&click(3.0, 0.0, in_front(2.0)), 0));
    assert!((fall + 6.0).abs() < 0.7, "{fall} dB");
}
