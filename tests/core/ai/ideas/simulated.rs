//! Banks, kicks, combinations and caroms: near what is proposed there is a stroke that does it.

use super::full;
use crate::ai::{random_view, table};
use glam::DVec2;
use hapticbillard::ai::{Idea, IdeaKind, SeenBall, TableView2d};
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::events::{Fact, FactKind, FactSet, Topic};
use hapticbillard::ids::{BallId, PocketId};
use hapticbillard::physics::{PhysicsSettings, Simulation, Strike};
use hapticbillard::table::Table;
use std::sync::OnceLock;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// A table on which shots can be simulated.
pub struct Parlour {
    pub table: &'static Table,
    ball: fn(BallId) -> Ball,
    start: Simulation,
}

fn parlour(table: &'static Table, ball: fn(BallId) -> Ball) -> Parlour {
    let lone = [at_rest(ball(BallId::CUE), DVec2::ZERO)].to_vec();
    let start = Simulation::from_parts(table, lone, &PhysicsSettings::default()).unwrap();
    Parlour { table, ball, start }
}

pub fn pool() -> &'static Parlour {
    static POOL: OnceLock<Parlour> = OnceLock::new();
    POOL.get_or_init(|| parlour(table(), Ball::pool))
}

pub fn snooker() -> &'static Parlour {
    static TABLE: OnceLock<Table> = OnceLock::new();
    static SNOOKER: OnceLock<Parlour> = OnceLock::new();
    let table = TABLE.get_or_init(|| Table::preset("snooker-12ft").unwrap());
    SNOOKER.get_or_init(|| parlour(table, Ball::snooker))
}

fn carom() -> &'static Parlour {
    static TABLE: OnceLock<Table> = OnceLock::new();
    static CAROM: OnceLock<Parlour> = OnceLock::new();
    let table = TABLE.get_or_init(|| Table::preset("carom-10ft").unwrap());
    CAROM.get_or_init(|| parlour(table, Ball::carom))
}

fn at_rest(ball: Ball, at: DVec2) -> (Ball, BallState) {
    let state = BallState::at_rest(ball.id, at.extend(ball.radius_m));
    (ball, state)
}

impl Parlour {
    /// A random table of the pool table's layout, stretched to this one.
    pub fn random(&self, seed: u64, count: u16) -> TableView2d {
        let view = random_view(seed, count);
        let (bed, old) = (self.table.bed.unwrap(), view.bed);
        let scale = DVec2::new(bed.length_m / old.length_m, bed.width_m / old.width_m);
        TableView2d {
            cue_ball: view.cue_ball.map(|cue| cue * scale),
            balls: view
                .balls
                .iter()
                .map(|ball| SeenBall { id: ball.id, position: ball.position * scale })
                .collect(),
            ball_radius_m: (self.ball)(BallId::CUE).radius_m,
            bed,
            pockets: self.table.pockets.clone(),
        }
    }

    pub fn lay(&self, view: &TableView2d) -> Simulation {
        let cue = (BallId::CUE, view.cue_ball.unwrap());
        let balls = view.balls.iter().map(|ball| (ball.id, ball.position));
        let balls = std::iter::once(cue).chain(balls).map(|(id, at)| at_rest((self.ball)(id), at));
        self.start.with_balls(balls.collect()).unwrap()
    }
}

/// What happens until all is at rest.
pub fn play(start: &Simulation, strike: Strike) -> Vec<Fact> {
    let mut simulation = start.clone().strike(strike).unwrap();
    let mut facts = Vec::new();
    let settled = FactSet::of(&[Topic::Settled]);
    while !simulation.is_still() && simulation.now_s() < 60.0 {
        let limit = simulation.now_s() + 1.0;
        simulation.advance(limit, settled, &mut facts).unwrap();
        if facts.last().is_some_and(|fact| fact.kind.topic() == Topic::Settled) {
            break;
        }
    }
    facts
}

fn falls(facts: &[Fact], wanted: BallId) -> Option<PocketId> {
    facts.iter().find_map(|fact| match fact.kind {
        FactKind::BallPocketed { ball, pocket, .. } if ball == wanted => Some(pocket),
        _ => None,
    })
}

/// Balls that the cue ball meets, and the cushions until then.
fn meetings(facts: &[Fact]) -> Vec<(BallId, u8)> {
    let mut cushions = 0;
    let mut met = Vec::new();
    for fact in facts {
        match fact.kind {
            FactKind::CushionHit { ball: BallId::CUE, onset: true, .. } => cushions += 1,
            FactKind::BallsCollided { a: BallId::CUE, b, .. } => met.push((b, cushions)),
            _ => {}
        }
    }
    met
}

/// Whether a shot did what its idea wants.
pub fn succeeds(idea: &Idea, facts: &[Fact]) -> bool {
    let met = meetings(facts);
    let first = met.first().map(|(ball, _)| *ball);
    if first != idea.first {
        return false;
    }
    match (idea.pocket, idea.ball) {
        (Some(pocket), Some(ball)) => falls(facts, ball) == Some(pocket),
        (None, Some(ball)) => {
            // Three cushions or more are what a three-cushion player wants of it.
            let cushions = met.iter().find(|(other, _)| *other == ball).map(|(_, n)| *n);
            cushions.is_some_and(|cushions| cushions >= idea.cushions.min(3))
        }
        (_, None) => true,
    }
}

/// Whether some stroke within ±2° and at one of these speeds and heights does it.
fn can_be_done(start: &Simulation, idea: &Idea) -> bool {
    /// Steps to either side: the widest of a tenth of a degree.
    const STEPS: i32 = 40;
    let azimuth_deg = libm::atan2(idea.direction.y, idea.direction.x) / DEGREE;
    [1.2, 1.6].iter().any(|factor| {
        [0.0, 0.3, -0.3].iter().any(|higher| {
            // From the middle outwards.
            (0..=2 * STEPS).any(|step| {
                let side = if step % 2 == 0 { 0.5 } else { -0.5 };
                let off_deg = 2.0 * side * f64::from(step + step % 2) / f64::from(STEPS);
                let strike = Strike {
                    speed_m_s: (factor * idea.speed_least_m_s).min(6.0),
                    azimuth_deg: azimuth_deg + off_deg,
                    height_offset: (idea.height_offset + higher).clamp(-0.45, 0.45),
                    ..Strike::CENTRE
                };
                succeeds(idea, &play(start, strike))
            })
        })
    })
}

/// Share of the two best ideas of every table that can be done.
#[track_caller]
fn check(
    parlour: &Parlour,
    seeds: std::ops::Range<u64>,
    balls: u16,
    share_least: f64,
    is_meant: impl Fn(&Idea) -> bool,
) {
    let (mut done, mut count) = (0, 0);
    for seed in seeds {
        let view = parlour.random(seed, balls);
        let start = parlour.lay(&view);
        for idea in full(&view).iter().filter(|idea| is_meant(idea)).take(2) {
            count += 1;
            done += i32::from(can_be_done(&start, idea));
        }
    }
    let share = f64::from(done) / f64::from(count);
    println!("{done} of {count}: {share:.2}");
    assert!(count >= 20 && share >= share_least, "{done} of {count}");
}

#[test]
fn nine_of_ten_banks_can_be_done() {
    check(pool(), 0..25, 3, 0.9, |idea| idea.kind == IdeaKind::Bank);
}

#[test]
fn nine_of_ten_kicks_into_a_pocket_can_be_done() {
    let pots = |idea: &Idea| idea.kind == IdeaKind::Kick && idea.pocket.is_some();
    check(pool(), 0..20, 3, 0.9, pots);
}

#[test]
fn all_kicks_that_only_meet_a_ball_can_be_done() {
    let meets = |idea: &Idea| idea.kind == IdeaKind::Kick && idea.pocket.is_none();
    check(pool(), 0..40, 4, 0.98, meets);
}

#[test]
fn kicks_by_two_cushions_can_be_done() {
    let two = |idea: &Idea| idea.kind == IdeaKind::Kick && idea.cushions == 2;
    check(pool(), 0..40, 4, 0.9, two);
}

#[test]
fn four_of_five_combinations_can_be_done() {
    check(pool(), 0..20, 4, 0.8, |idea| idea.kind == IdeaKind::Combination);
}

#[test]
fn four_of_five_caroms_into_a_pocket_can_be_done() {
    check(pool(), 0..20, 4, 0.8, |idea| idea.kind == IdeaKind::Carom);
}

#[test]
fn nine_of_ten_caroms_can_be_done() {
    check(carom(), 0..20, 2, 0.9, |idea| idea.kind == IdeaKind::Carom);
}

#[test]
fn four_of_five_three_cushion_caroms_can_be_done() {
    let three = |idea: &Idea| idea.kind == IdeaKind::Carom && idea.cushions >= 3;
    check(carom(), 0..20, 2, 0.8, three);
}
