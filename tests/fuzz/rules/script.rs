//! Shots as good players make them: a legal ball first, a rail, the called ball in its pocket, and
//! now and then a mistake. Without them a random game would hardly ever get beyond its break.

use hapticbillard::events::{Call, CallKind, Command, FactKind};
use hapticbillard::ids::{BallId, PocketId, Rail};
use hapticbillard::rules::{GameKind, Phase, Referee, game, legal_first};
use rand::{Rng, RngExt};
use std::collections::VecDeque;

/// What comes next.
pub enum Step {
    /// A player says something.
    Say(Command),
    /// Something happens.
    Happen(FactKind),
}

/// The rest of a shot.
#[derive(Default)]
pub struct Script(VecDeque<Step>);

impl Script {
    /// The next step; none if there is nothing to do in this phase.
    pub fn next(&mut self, referee: &Referee, rng: &mut impl Rng) -> Option<Step> {
        if matches!(referee.phase(), Phase::Placing | Phase::Waiting) && !self.is_begun() {
            self.write(referee, rng);
        }
        self.0.pop_front()
    }

    fn is_begun(&self) -> bool {
        self.0.iter().any(|step| matches!(step, Step::Happen(FactKind::CueBallStruck { .. })))
    }

    fn write(&mut self, referee: &Referee, rng: &mut impl Rng) {
        self.0.clear();
        let state = referee.state();
        let cue_ball = state.cue_ball;
        let zone = state.ball_in_hand.zone();
        if let (Phase::Placing, Some(zone)) = (referee.phase(), zone) {
            self.happen(FactKind::BallPlaced { ball: cue_ball, zone, ok: true });
        }
        let legal = legal_first(referee.game(), state);
        let on = if legal.is_empty() { &state.on_table } else { &legal };
        let target = match on.as_slice() {
            [] => BallId(rng.random_range(0..3)),
            balls => balls[rng.random_range(0..balls.len())],
        };
        let pocket = PocketId::ALL[rng.random_range(0..6)];
        let calls = (game(referee.game()).calls)(state);
        if calls.push_out && rng.random_bool(0.3) {
            self.say(Call::Kind(CallKind::PushOut));
        } else if calls.safety && rng.random_bool(0.1) {
            self.say(Call::Kind(CallKind::Safety));
        } else if calls.ball {
            self.say(Call::Ball { ball: target, pocket: calls.pocket.then_some(pocket) });
        }

        self.happen(struck(cue_ball));
        if matches!(referee.game(), GameKind::ThreeCushion | GameKind::FreeCarom) {
            return self.write_carom(cue_ball, target, &state.on_table, rng);
        }
        self.happen(met(cue_ball, target));
        let rails = rng.random_range(0..5);
        for rail in 0..rails {
            let ball = if rng.random_bool(0.5) { cue_ball } else { target };
            self.happen(cushion(ball, Rail::ALL[rail % 4]));
        }
        if state.is_break() && rng.random_bool(0.7) {
            for ball in state.on_table.iter().take(5) {
                self.happen(cushion(*ball, Rail::Foot));
            }
        }
        if rng.random_bool(0.6) {
            self.happen(down(target, pocket));
        }
        // Whatever else may fall: another ball, the cue ball.
        if let [.., last] = state.on_table.as_slice()
            && rng.random_bool(0.2)
        {
            self.happen(met(cue_ball, *last));
            self.happen(down(*last, pocket));
        }
        if rng.random_bool(0.05) {
            self.happen(down(cue_ball, pocket));
        }
        self.happen(FactKind::Settled {
            snookered: rng.random_bool(0.2),
            cue_in_rack: rng.random_bool(0.2),
        });
    }

    /// One ball, cushions, mostly the other ball.
    fn write_carom(
        &mut self,
        cue_ball: BallId,
        first: BallId,
        object_balls: &[BallId],
        rng: &mut impl Rng,
    ) {
        self.happen(met(cue_ball, first));
        for rail in 0..rng.random_range(0..8) {
            self.happen(cushion(cue_ball, Rail::ALL[rail % 4]));
        }
        for other in object_balls.iter().filter(|ball| **ball != first && rng.random_bool(0.8)) {
            self.happen(met(cue_ball, *other));
        }
        if rng.random_bool(0.1) {
            self.happen(FactKind::BallsFrozen { a: BallId(0), b: BallId(2) });
        }
        self.happen(FactKind::Settled { snookered: false, cue_in_rack: false });
    }

    fn say(&mut self, call: Call) {
        self.0.push_back(Step::Say(Command::Call(call)));
    }

    fn happen(&mut self, kind: FactKind) {
        self.0.push_back(Step::Happen(kind));
    }
}

pub fn struck(ball: BallId) -> FactKind {
    FactKind::CueBallStruck {
        ball,
        push: false,
        moving: false,
        player: None,
        miscue: false,
        position_m: Default::default(),
        normal_speed_m_s: 0.0,
    }
}

pub fn met(a: BallId, b: BallId) -> FactKind {
    FactKind::BallsCollided {
        a,
        b,
        in_kitchen: false,
        position_m: Default::default(),
        normal_speed_m_s: 0.0,
    }
}

pub fn cushion(ball: BallId, rail: Rail) -> FactKind {
    FactKind::CushionHit {
        ball,
        rail,
        onset: true,
        position_m: Default::default(),
        normal_speed_m_s: 0.0,
    }
}

pub fn down(ball: BallId, pocket: PocketId) -> FactKind {
    FactKind::BallPocketed { ball, pocket, speed_m_s: 0.0 }
}
