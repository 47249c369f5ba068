//! Random facts, possible and impossible: what the referee and its actor are fed with.

use hapticbillard::events::{FactKind, TouchedBy, Zone};
use hapticbillard::ids::{BallId, PlayerId, PocketId, Rail};
use hapticbillard::rules::{Referee, legal_first};
use rand::{Rng, RngExt};

/// How often each kind of fact comes in one game; some never do.
pub struct Swarm {
    weights: [u32; 9],
    /// Facts come only in an order that a table can bring about.
    pub is_possible: bool,
    /// Chance that a fact happens at the same time as the one before.
    #[allow(dead_code, reason = "where facts come one by one there are no ties")]
    pub tie: f64,
    /// Chance that a player calls or chooses instead.
    #[allow(dead_code, reason = "where players say nothing there are no commands")]
    pub commands: f64,
    /// Chance that the next event is that of a good player.
    #[allow(dead_code, reason = "where facts come one by one nobody plays")]
    pub skill: f64,
}

impl Swarm {
    /// A choice of kinds for one game.
    pub fn new(rng: &mut impl Rng) -> Self {
        let mut weights = std::array::from_fn(|_| match rng.random_range(0..3) {
            0 => 0,
            1 => 1,
            _ => rng.random_range(2..12),
        });
        // Without strokes and rest there is no game.
        weights[1] = weights[1].max(2);
        weights[8] = weights[8].max(2);
        let is_possible = rng.random_bool(0.5);
        let tie = [0.0, 0.3, 0.9][rng.random_range(0..3)];
        let commands = [0.0, 0.05, 0.2][rng.random_range(0..3)];
        let skill = [0.0, 0.0, 0.95, 1.0][rng.random_range(0..4)];
        Swarm { weights, is_possible, tie, commands, skill }
    }

    /// What happens next.
    pub fn kind(&self, rng: &mut impl Rng, referee: &Referee) -> FactKind {
        let total = self.weights.iter().sum::<u32>();
        let mut pick = rng.random_range(0..total);
        let kind = self.weights.iter().position(|weight| {
            let hit = pick < *weight;
            pick = pick.saturating_sub(*weight);
            hit
        });
        let on_table = &referee.state().on_table;
        // A possible game uses the balls that are there.
        let ball = match on_table.as_slice() {
            balls if self.is_possible && !balls.is_empty() => {
                balls[rng.random_range(0..balls.len())]
            }
            _ => BallId(rng.random_range(0..25)),
        };
        let cue_ball = referee.state().cue_ball;
        let cue_or_ball = if rng.random_bool(0.15) { cue_ball } else { ball };
        match kind.unwrap_or(8) {
            0 => FactKind::BallPlaced {
                ball: if rng.random_bool(0.9) { cue_ball } else { ball },
                zone: [Zone::Kitchen, Zone::Anywhere, Zone::D][rng.random_range(0..3)],
                ok: rng.random_bool(0.7),
            },
            1 => FactKind::CueBallStruck {
                ball: if rng.random_bool(0.95) { cue_ball } else { ball },
                push: rng.random_bool(0.1),
                moving: rng.random_bool(0.1),
                player: rng.random_bool(0.1).then_some(PlayerId::TWO),
                miscue: false,
                position_m: Default::default(),
                normal_speed_m_s: 0.0,
            },
            2 | 3 => FactKind::BallsCollided {
                a: if rng.random_bool(0.7) { cue_ball } else { cue_or_ball },
                b: ball,
                in_kitchen: rng.random_bool(0.1),
                position_m: Default::default(),
                normal_speed_m_s: 0.0,
            },
            4 => FactKind::CushionHit {
                ball: cue_or_ball,
                rail: Rail::ALL[rng.random_range(0..4)],
                onset: rng.random_bool(0.8),
                position_m: Default::default(),
                normal_speed_m_s: 0.0,
            },
            5 => FactKind::BallPocketed {
                ball: cue_or_ball,
                pocket: PocketId::ALL[rng.random_range(0..6)],
                speed_m_s: 0.0,
            },
            6 => FactKind::BallOffTable { ball: cue_or_ball },
            7 => match rng.random_range(0..3) {
                0 => FactKind::HeadStringCrossed { ball: cue_or_ball },
                1 => FactKind::BallTouched { ball: cue_or_ball, by: TouchedBy::Hand },
                _ => FactKind::BallsFrozen { a: ball, b: BallId(rng.random_range(0..3)) },
            },
            _ => FactKind::Settled {
                snookered: rng.random_bool(0.3),
                cue_in_rack: rng.random_bool(0.3),
            },
        }
    }
}

/// Nothing happens before the stroke, the tip mostly strikes once, and the cue ball mostly meets a
/// ball that it may meet.
pub fn made_possible(
    kind: FactKind,
    is_shooting: bool,
    rng: &mut impl Rng,
    referee: &Referee,
) -> FactKind {
    let legal = legal_first(referee.game(), referee.state());
    match kind {
        FactKind::BallPlaced { .. } if !is_shooting => kind,
        _ if !is_shooting => FactKind::CueBallStruck {
            ball: referee.state().cue_ball,
            push: false,
            moving: false,
            player: None,
            miscue: false,
            position_m: Default::default(),
            normal_speed_m_s: 0.0,
        },
        FactKind::CueBallStruck { .. } if !legal.is_empty() && rng.random_bool(0.95) => {
            FactKind::BallsCollided {
                a: referee.state().cue_ball,
                b: legal[rng.random_range(0..legal.len())],
                in_kitchen: false,
                position_m: Default::default(),
                normal_speed_m_s: 0.0,
            }
        }
        _ => kind,
    }
}
