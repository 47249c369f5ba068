//! Searching players by themselves: one question, one answer.

use super::{BED, R, table};
use glam::{DQuat, DVec2, DVec3};
use hapticbillard::ai::{
    Decision, Deliberation, IdeaKind, Inline, Level, Mind, MindSetup, Outcome, PlannedShot,
    StrokeNoise, Task, TaskKind, ThrowTable, Workers,
};
use hapticbillard::ball::{Ball, BallPlace, BallState};
use hapticbillard::events::{
    BallInHand, Call, CallKind, Event, Group, Groups, ShotKind, Turn, Zone,
};
use hapticbillard::ids::{BallId, GameKind, PlayerId, PocketId};
use hapticbillard::physics::{Simulation, Strike};
use hapticbillard::rack::Rack;
use hapticbillard::rules::{Referee, State};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn prepared() -> Simulation {
    Simulation::new(table().clone(), Rack::eight_ball(7)).unwrap()
}

fn mind(level: Level, noise: f64, simulations: u32) -> Mind {
    Mind::new(MindSetup {
        simulation: prepared(),
        balls: (0..16).map(|n| Ball::pool(BallId(n))).collect(),
        table: Arc::new(table().clone()),
        bed: BED,
        ball_radius_m: R,
        game: GameKind::WpaEightBall,
        level,
        noise: StrokeNoise::olympiad(noise),
        throw: ThrowTable::shipped(),
        simulations,
    })
}

/// Player 1 with the solids, and these balls.
fn task(kind: TaskKind, balls: &[(u16, DVec2)], ball_in_hand: BallInHand) -> Task {
    let on_table: Vec<BallId> =
        balls.iter().map(|(id, _)| BallId(*id)).filter(|id| *id != BallId::CUE).collect();
    let state = State {
        player: PlayerId::ONE,
        shot: ShotKind::Normal,
        groups: Some(Groups::assigned(PlayerId::ONE, Group::Solids)),
        on_table: on_table.iter().copied().collect(),
        ball_in_hand,
        ..State::default()
    };
    let mut referee = Referee::resume(GameKind::WpaEightBall, state);
    let turn: Arc<Turn> = referee
        .begin(on_table)
        .into_iter()
        .find_map(|event| match event {
            Event::Turn(turn) => Some(turn),
            _ => None,
        })
        .unwrap();
    let lie = |n: u16| match balls.iter().find(|(id, _)| *id == n) {
        Some((_, at)) => BallState::at_rest(BallId(n), at.extend(R)),
        None => BallState {
            place: BallPlace::Pocketed,
            ..BallState::at_rest(BallId(n), DVec3::new(0.1 * f64::from(n), 3.0, -0.5))
        },
    };
    let lies = (0..16).map(lie).collect();
    Task { kind, lies, referee, turn, played_from: None, has_asked: false, seed: 11 }
}

fn shot(deliberation: &Deliberation) -> &PlannedShot {
    match &deliberation.decision {
        Decision::Shoot(shot) => shot,
        other => panic!("{other:?}"),
    }
}

/// An easy 3, a 9 in nobody's way, and the 8.
fn easy() -> Task {
    let balls = [
        (0, DVec2::new(0.6, 0.1)),
        (3, DVec2::new(1.0, 0.4)),
        (8, DVec2::new(-0.8, -0.3)),
        (9, DVec2::new(-1.0, 0.4)),
    ];
    task(TaskKind::Shoot, &balls, BallInHand::None)
}

#[test]
fn an_easy_ball_is_called_and_falls() {
    for (level, simulations) in [(Level::Club, 20), (Level::Champion, 500)] {
        let (mind, task) = (mind(level, 1.0, simulations), easy());
        let answer = mind.deliberate(&task, &Inline);
        let shot = shot(&answer);
        assert_eq!(shot.idea.kind, IdeaKind::Pot);
        let pocket = Some(PocketId::Fl);
        assert_eq!(shot.call, Some(Call::Ball { ball: BallId(3), pocket }));
        assert!(0.8 < shot.success && 0.5 < shot.value, "{level:?} {shot:?}");

        let on_table = |lie: &&BallState| lie.place == BallPlace::OnTable;
        let balls = task.lies.iter().filter(on_table).map(|lie| (Ball::pool(lie.id), *lie));
        let start = prepared().with_balls(balls.collect()).unwrap();
        let strike = Strike::held(&shot.aim, shot.speed_m_s);
        let end = start.strike(strike).unwrap().run_until_rest().unwrap().end;
        let three = end.sample(BallId(3), end.now_s()).unwrap();
        assert_eq!(three.place, BallPlace::Pocketed, "{level:?}");
    }
}

/// Does the jobs from the last to the first, as any schedule may.
struct Backwards;

impl Workers for Backwards {
    fn run(&self, jobs: usize, job: &(dyn Fn(usize) -> Outcome + Sync)) -> Vec<Outcome> {
        let mut outcomes: Vec<_> = (0..jobs).rev().map(job).collect();
        outcomes.reverse();
        outcomes
    }
}

#[test]
fn the_order_of_the_work_decides_nothing() {
    let mind = mind(Level::Champion, 1.0, 400);
    let task = easy();
    let answer = mind.deliberate(&task, &Inline);
    assert_eq!(answer, mind.deliberate(&task, &Backwards));
    assert_eq!(answer, mind.deliberate(&task.clone(), &Inline));
    let other = mind.deliberate(&Task { seed: 12, ..task }, &Inline);
    assert_ne!(answer.thoughts, other.thoughts, "other errors");
}

#[test]
fn what_cannot_be_seen_changes_nothing() {
    let mind = mind(Level::Champion, 1.0, 400);
    let task = easy();
    let mut hidden = task.clone();
    for lie in &mut hidden.lies {
        lie.orientation = DQuat::from_rotation_x(f64::from(lie.id.0));
        lie.velocity = DVec3::new(1e-5, 0.0, 0.0);
        lie.angular_velocity = DVec3::new(0.0, 0.0, 3.0);
    }
    assert_eq!(mind.deliberate(&task, &Inline), mind.deliberate(&hidden, &Inline));
}

#[test]
fn the_budget_bounds_the_simulations() {
    for (level, budget) in [
        (Level::Club, 20),
        (Level::Club, 200),
        (Level::Champion, 40),
        (Level::Champion, 300),
        (Level::Champion, 600),
        (Level::Champion, 4000),
    ] {
        for task in [crowded(), hidden()] {
            let answer = mind(level, 1.0, budget).deliberate(&task, &Inline);
            // A scan ends when it has begun.
            let most = budget + budget / 4;
            assert!(answer.simulations <= most, "{budget}: {}", answer.simulations);
            let candidates = &answer.thoughts.candidates;
            let chosen = candidates.iter().find(|one| one.chosen).unwrap();
            assert!(0 < chosen.samples, "{level:?} {budget}: decided without a single error");
            for one in candidates {
                for share in [one.legal, one.success, one.value] {
                    assert!((0.0..=1.0).contains(&share), "{one:?}");
                }
            }
        }
    }
}

/// A full table.
fn crowded() -> Task {
    let spots = (0..16).map(|n| {
        let (column, row) = (f64::from(n % 4), f64::from(n / 4));
        (n as u16, DVec2::new(-0.9 + 0.55 * column + 0.05 * row, -0.4 + 0.26 * row))
    });
    task(TaskKind::Shoot, &spots.collect::<Vec<_>>(), BallInHand::None)
}

/// Whoever works, and gives up after some jobs.
struct GivesUp(AtomicUsize);

impl Workers for GivesUp {
    fn run(&self, jobs: usize, job: &(dyn Fn(usize) -> Outcome + Sync)) -> Vec<Outcome> {
        self.0.fetch_add(1, Ordering::Relaxed);
        Inline.run(jobs, job)
    }

    fn is_cancelled(&self) -> bool {
        0 < self.0.load(Ordering::Relaxed)
    }
}

#[test]
fn who_is_not_waited_for_ends_after_the_round_that_runs() {
    let workers = GivesUp(AtomicUsize::new(0));
    let answer = mind(Level::Champion, 1.0, 4000).deliberate(&crowded(), &workers);
    assert_eq!(workers.0.load(Ordering::Relaxed), 1);
    assert!(matches!(answer.decision, Decision::Shoot(_)), "any answer will do");
}

/// The 3 hides behind the 9; only a cushion leads to it.
fn hidden() -> Task {
    let balls = [
        (0, DVec2::new(-0.9, 0.0)),
        (3, DVec2::new(0.3, 0.0)),
        (9, DVec2::new(-0.1, 0.0)),
        (10, DVec2::new(-0.1, 0.0575)),
        (11, DVec2::new(-0.1, -0.0575)),
        (8, DVec2::new(1.0, 0.5)),
    ];
    task(TaskKind::Shoot, &balls, BallInHand::None)
}

#[test]
fn without_a_pot_the_ball_is_met_and_a_safety_called() {
    let task = hidden();
    let answer = mind(Level::Champion, 0.0, 2000).deliberate(&task, &Inline);
    let shot = shot(&answer);
    assert_eq!(shot.idea.first, Some(BallId(3)), "{shot:?}");
    assert!(shot.success == 1.0, "no foul: {shot:?}");
    let named = matches!(shot.call, Some(Call::Ball { ball: BallId(3), .. }));
    assert!(named || shot.call == Some(Call::Kind(CallKind::Safety)), "{shot:?}");
}

#[test]
fn a_ball_in_hand_is_put_where_the_next_shot_is_easy() {
    let balls =
        [(3, DVec2::new(1.0, 0.4)), (8, DVec2::new(-0.8, -0.3)), (9, DVec2::new(-1.0, 0.4))];
    // From behind the head string each way to the 3 is two metres long.
    for (in_hand, zone, easy) in
        [(BallInHand::Anywhere, Zone::Anywhere, 0.9), (BallInHand::Kitchen, Zone::Kitchen, 0.75)]
    {
        let mind = mind(Level::Champion, 1.0, 1000);
        let question = task(TaskKind::Place(zone), &balls, in_hand);
        let answer = mind.deliberate(&question, &Inline);
        let Decision::Place(spots) = answer.decision else { panic!("{:?}", answer.decision) };
        assert!(4 <= spots.len());
        for spot in &spots {
            assert!(BED.holds(*spot, R), "{spot}");
            assert!(zone == Zone::Anywhere || spot.x < BED.head_string_x(), "{spot}");
        }
        let mut with_cue = balls.to_vec();
        with_cue.push((0, spots[0]));
        let next = task(TaskKind::Shoot, &with_cue, BallInHand::None);
        let next = mind.deliberate(&next, &Inline);
        assert!(easy < shot(&next).success, "{zone:?} {:?}", shot(&next));
    }
}

#[test]
fn a_perfect_arm_leaves_no_legal_shot_unplayed() {
    let mind = mind(Level::Champion, 0.0, 400);
    for seed in 0..12 {
        let view = super::random_view(seed, 15);
        let mut balls = vec![(0, view.cue_ball.unwrap())];
        balls.extend(view.balls.iter().map(|ball| (ball.id.0, ball.position)));
        let task = task(TaskKind::Shoot, &balls, BallInHand::None);
        let answer = mind.deliberate(&task, &Inline);
        let chosen = answer.thoughts.candidates.iter().find(|one| one.chosen).unwrap();
        let any = answer.thoughts.candidates.iter().any(|one| one.legal == 1.0);
        assert!(chosen.legal == 1.0 || !any, "{seed}: {:?}", shot(&answer));
    }
}
