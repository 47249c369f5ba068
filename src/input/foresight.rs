//! Where the balls would go: the game's own laws, on a copy of the table, for the stroke that is
//! aimed.

use crate::ball::{Ball, BallPlace, BallState};
use crate::cue::Aim;
use crate::events::FactKind;
use crate::ids::BallId;
use crate::physics::{PhysicsError, Shot, Simulation, Snapshot, Strike};
use crate::units::Seconds;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Time between two points of a way [s].
const STEP_S: Seconds = 0.02;
/// Points nearer than this to the straight line between their neighbours are left out [m].
const FLAT_M: f64 = 0.001;

/// How much help a player wants while aiming.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AimAid {
    /// None.
    None,
    /// The straight way to what is met first, and which way that goes.
    #[default]
    Line,
    /// Where the cue ball and the ball that it meets first will go, to their end.
    Ways,
}

impl AimAid {
    /// All of them, from the least to the most.
    pub const ALL: [AimAid; 3] = [AimAid::None, AimAid::Line, AimAid::Ways];

    /// The one after it.
    #[must_use]
    pub fn next(self) -> Self {
        match self {
            AimAid::None => AimAid::Line,
            AimAid::Line => AimAid::Ways,
            AimAid::Ways => AimAid::None,
        }
    }
}

/// The way of one ball.
#[derive(Debug, Clone, PartialEq)]
pub struct BallWay {
    /// Which ball.
    pub ball: BallId,
    /// Places of its middle, from where it lies to where it ends [m].
    pub points: Vec<DVec3>,
    /// It comes to rest at the last one; otherwise it falls or leaves the table there.
    pub rests: bool,
}

/// A table of one's own, to look ahead on.
#[derive(Debug, Clone)]
pub struct Foresight {
    /// Shared: whoever holds it is copied every tick.
    simulation: Arc<Simulation>,
    balls: Arc<Vec<Ball>>,
}

impl Foresight {
    /// Looks ahead with this simulation, whose balls may be anywhere.
    pub fn new(simulation: Simulation, balls: Vec<Ball>) -> Self {
        Foresight { simulation: Arc::new(simulation), balls: Arc::new(balls) }
    }

    /// Where the cue ball goes, and the ball that it meets first, if the tip meets it so fast
    /// [m/s].
    ///
    /// # Errors
    /// [`PhysicsError`] if there can be no such stroke, or the balls never come to rest.
    pub fn ways(
        &self,
        lies: &Snapshot,
        cue_ball: BallId,
        aim: Aim,
        speed_m_s: f64,
    ) -> Result<Vec<BallWay>, PhysicsError> {
        let shot = self.struck(lies, cue_ball, aim, speed_m_s)?.run_until_rest()?;
        let first = shot.facts.iter().find_map(|fact| match fact.kind {
            FactKind::BallsCollided { a, b, .. } if a == cue_ball => Some(b),
            FactKind::BallsCollided { a, b, .. } if b == cue_ball => Some(a),
            _ => None,
        });
        let balls = std::iter::once(cue_ball).chain(first);
        Ok(balls.map(|ball| way(&shot, ball)).filter(|way| 1 < way.points.len()).collect())
    }

    /// The table with the cue on its way.
    fn struck(
        &self,
        lies: &Snapshot,
        cue_ball: BallId,
        aim: Aim,
        speed_m_s: f64,
    ) -> Result<Simulation, PhysicsError> {
        let at_rest = |state: &BallState| BallState::at_rest(state.id, state.position);
        let ball = |id: BallId| self.balls.iter().find(|ball| ball.id == id);
        let lying: Vec<(Ball, BallState)> =
            lies.on_table().filter_map(|s| Some((ball(s.id)?.clone(), at_rest(s)))).collect();
        self.simulation.with_balls(lying)?.strike_ball(cue_ball, Strike::held(&aim, speed_m_s))
    }
}

/// The way of a ball as few points: where it rests or falls is the last.
fn way(shot: &Shot, ball: BallId) -> BallWay {
    let last = shot.end.snapshot(shot.end_s).ball(ball).copied();
    let rests = last.is_some_and(|state| state.place == BallPlace::OnTable);
    // A ball that goes down is seen until its middle is below the bed.
    let states = shot.trajectory(ball).every(STEP_S).take_while(|state| 0.0 <= state.position.z);
    let mut points: Vec<DVec3> = states.map(|state| state.position).collect();
    points.extend(last.filter(|_| rests).map(|state| state.position));
    BallWay { ball, points: thinned(&points), rests }
}

/// Without points that lie on the straight line between those that are kept.
fn thinned(points: &[DVec3]) -> Vec<DVec3> {
    let Some((first, rest)) = points.split_first() else { return Vec::new() };
    let mut kept = vec![*first];
    let mut from = 0;
    for next in 1..rest.len() {
        // From the last point that was kept to the next one after this.
        let (a, b) = (points[from], points[next + 1]);
        let along = (b - a).normalize_or_zero();
        let is_flat = points[from + 1..=next].iter().all(|p| {
            let to = *p - a;
            let beside = to - along * to.dot(along);
            beside.length() < FLAT_M && 0.0 <= to.dot(along) && to.length() <= (b - a).length()
        });
        if !is_flat {
            kept.push(points[next]);
            from = next;
        }
    }
    kept.extend(rest.last().filter(|end| **end != points[from]));
    kept
}
