//! A table of one's own, to try shots on.

use super::Mind;
use crate::ai::view::TableView2d;
use crate::ball::{BallPlace, BallState};
use crate::cue::Aim;
use crate::events::{
    Call, Command, Event, Fact, FactKind, FactSet, Source, Topic, Turn, TurnAfter, Verdict, Zone,
};
use crate::ids::{BallId, PlayerId, PocketId};
use crate::physics::{PhysicsError, Simulation, Strike};
use crate::rules::Referee;
use crate::units::Seconds;
use glam::{DQuat, DVec2, DVec3};
use std::sync::Arc;

/// A shot that lasts longer is given up [s].
const LONGEST_SHOT_S: Seconds = 120.0;
/// After so long, balls that were spotted lie [s].
const SPOTTING_S: Seconds = 0.01;

/// A position: where the balls lie and how the game stands, before a shot.
#[derive(Debug, Clone)]
pub struct World {
    start: Simulation,
    /// Knows the game; has heard where the cue ball was put.
    referee: Referee,
    /// The position from above.
    pub view: TableView2d,
    /// Which ball is struck, and where it lies [m]; none if it is in hand.
    pub cue_ball: Option<DVec3>,
    /// What the game asks for.
    pub turn: Arc<Turn>,
}

/// What came of a shot.
#[derive(Debug)]
pub struct Played {
    /// What happened, in time order.
    pub facts: Vec<Fact>,
    /// What the rules say of it.
    pub verdict: Arc<Verdict>,
    /// The game after it.
    pub referee: Referee,
    /// Who is called to the table, and for what; none if the game is over.
    pub turn: Option<Arc<Turn>>,
    end: Simulation,
    /// Balls that the rules lay down after it.
    laying: Vec<Command>,
}

impl World {
    /// A position of a game. `referee` has announced `turn`.
    ///
    /// # Errors
    /// [`PhysicsError`] if the balls cannot lie so.
    pub fn new(
        mind: &Mind,
        lies: &[BallState],
        referee: Referee,
        turn: Arc<Turn>,
    ) -> Result<Self, PhysicsError> {
        let start = mind.simulation.with_balls(mind.balls_at(lies))?;
        let lying = lies.iter().find(|ball| ball.id == turn.cue_ball);
        let cue_ball = lying.filter(|ball| ball.place == BallPlace::OnTable).map(|b| b.position);
        let (bed, pockets) = (&mind.bed, &mind.table.pockets);
        let view = TableView2d::of_balls(lies, turn.cue_ball, bed, pockets, mind.ball_radius_m);
        Ok(World { start, referee, view, cue_ball, turn })
    }

    /// The same with the cue ball put down in a zone [m].
    ///
    /// # Errors
    /// [`PhysicsError`] if it cannot lie there.
    pub fn with_cue_ball(&self, mind: &Mind, zone: Zone, at: DVec2) -> Result<Self, PhysicsError> {
        let mut lies = self.start.snapshot(self.start.now_s()).balls;
        let cue_ball = self.turn.cue_ball;
        for ball in lies.iter_mut().filter(|ball| ball.id == cue_ball) {
            *ball = BallState::at_rest(cue_ball, at.extend(mind.ball_radius_m));
        }
        let mut referee = self.referee.clone();
        let kind = FactKind::BallPlaced { ball: cue_ball, zone, ok: true };
        referee.handle(&Fact { time_s: 0.0, kind });
        Self::new(mind, &lies, referee, self.turn.clone())
    }

    /// The position after commands of the rules: balls on their spots, a rack.
    ///
    /// # Errors
    /// [`PhysicsError`] if the balls cannot lie so.
    pub fn changed_by(
        &self,
        mind: &Mind,
        commands: &[Command],
        referee: Referee,
        turn: Arc<Turn>,
    ) -> Result<Self, PhysicsError> {
        let mut simulation = self.start.clone();
        lay(&mut simulation, commands)?;
        Self::new(mind, &lies_of(&simulation), referee, turn)
    }

    /// Who shoots.
    pub fn player(&self) -> PlayerId {
        self.turn.player
    }

    /// How the game stands.
    pub fn referee(&self) -> &Referee {
        &self.referee
    }

    /// The struck world, before anything has happened.
    fn struck(&self, aim: Aim, speed_m_s: f64) -> Result<Simulation, PhysicsError> {
        let cue_ball = self.turn.cue_ball;
        // One that is in hand is nowhere.
        self.cue_ball.ok_or(PhysicsError::UnknownBall(cue_ball))?;
        self.start.clone().strike_ball(cue_ball, Strike::held(&aim, speed_m_s))
    }

    /// Which way `ball` goes right after the cue ball met it; none if the cue ball meets something
    /// else first, or nothing.
    pub fn first_way(&self, aim: Aim, speed_m_s: f64, ball: BallId) -> Option<DVec2> {
        let mut simulation = self.struck(aim, speed_m_s).ok()?;
        let stop = FactSet::of(&[Topic::BallsCollided, Topic::Settled]);
        let mut facts = Vec::new();
        simulation.advance(LONGEST_SHOT_S, stop, &mut facts).ok()?;
        let met = facts.iter().find_map(|fact| match fact.kind {
            FactKind::BallsCollided { a, b, .. } => Some((a, b)),
            _ => None,
        })?;
        let cue_ball = self.turn.cue_ball;
        if met != (cue_ball, ball) && met != (ball, cue_ball) {
            return None;
        }
        let state = simulation.sample(ball, simulation.now_s())?;
        state.velocity.truncate().try_normalize()
    }

    /// Plays a shot and hears the rules on it.
    ///
    /// # Errors
    /// [`PhysicsError`] if the simulation cannot go on.
    pub fn play(
        &self,
        aim: Aim,
        speed_m_s: f64,
        call: Option<&Call>,
    ) -> Result<Played, PhysicsError> {
        let mut end = self.struck(aim, speed_m_s)?;
        let mut referee = self.referee.clone();
        if let Some(call) = call {
            referee.obey(Source::Ai(self.player()), &Command::Call(call.clone()));
        }
        let mut facts = Vec::with_capacity(32);
        let settled = FactSet::of(&[Topic::Settled]);
        end.advance(LONGEST_SHOT_S, settled, &mut facts)?;
        let is_settled = matches!(facts.last(), Some(Fact { kind: FactKind::Settled { .. }, .. }));
        if !is_settled {
            return Err(PhysicsError::NeverRests { limit_s: LONGEST_SHOT_S });
        }
        let sayings = referee.watch_shot(&facts, &end.snapshot(end.now_s()));
        let (mut verdict, mut turn, mut laying) = (None, None, Vec::new());
        for saying in sayings {
            match saying {
                Event::Verdict(said) => verdict = Some(said),
                Event::Turn(called) => turn = Some(called),
                Event::Command(command) => laying.push(command),
                _ => {}
            }
        }
        // The tip has met nothing: no shot, no verdict.
        let verdict = verdict.unwrap_or_else(|| {
            let turn = TurnAfter::Continue;
            Arc::new(Verdict { legal: false, turn, ..Verdict::default() })
        });
        Ok(Played { facts, verdict, referee, turn, end, laying })
    }
}

impl Played {
    /// The balls after the shot, with those that the rules laid down.
    pub fn lies(&mut self) -> Vec<BallState> {
        // What cannot be laid down stays off the table; the next turn says what follows.
        let _ = lay(&mut self.end, &std::mem::take(&mut self.laying));
        lies_of(&self.end)
    }

    /// Whether a ball fell, and where if that matters.
    pub fn has_pocketed(&self, ball: BallId, pocket: Option<PocketId>) -> bool {
        self.facts.iter().any(|fact| match fact.kind {
            FactKind::BallPocketed { ball: fell, pocket: into, .. } => {
                fell == ball && pocket.is_none_or(|wanted| wanted == into)
            }
            _ => false,
        })
    }
}

/// Has commands of the rules carried out: balls on their spots, a rack.
fn lay(simulation: &mut Simulation, commands: &[Command]) -> Result<(), PhysicsError> {
    let now = simulation.now_s();
    for command in commands {
        simulation.apply(now, command)?;
    }
    if !commands.is_empty() {
        simulation.advance(now + SPOTTING_S, FactSet::NONE, &mut Vec::new())?;
    }
    Ok(())
}

/// Where the balls lie now.
fn lies_of(simulation: &Simulation) -> Vec<BallState> {
    simulation.snapshot(simulation.now_s()).balls.into_iter().map(at_rest).collect()
}

/// A ball that lies, as anybody can see it: not how it moves or is turned.
pub(super) fn at_rest(ball: BallState) -> BallState {
    BallState {
        orientation: DQuat::IDENTITY,
        place: ball.place,
        ..BallState::at_rest(ball.id, ball.position)
    }
}
