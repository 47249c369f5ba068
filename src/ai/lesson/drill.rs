//! One practice shot: a cue ball is struck at a ball, and somebody watches where that goes.

use crate::ai::geometry::{signed_angle, turned};
use crate::ball::{Ball, BallState, POOL_RADIUS_M};
use crate::events::{Fact, FactKind, FactSet, Topic};
use crate::ids::BallId;
use crate::physics::{PhysicsError, PhysicsSettings, Simulation, Strike};
use crate::table::Table;
use crate::units::Seconds;
use glam::DVec2;

/// The ball that shall be sent somewhere.
const OBJECT: BallId = BallId(1);
/// A ball that lies in its way.
const OBSTACLE: BallId = BallId(2);
/// The observer looks this often [s]: the step of the paper.
const LOOK_S: Seconds = 0.004;
/// The direction is read this long after the contact [s], or earlier:
const WATCH_S: Seconds = 0.03;
/// as soon as the ball has come so far [m].
const WATCH_M: f64 = 2.0 * POOL_RADIUS_M;
/// A cue ball that has not met its ball by then has missed it [s].
const MISSED_S: Seconds = 10.0;
const DEGREE: f64 = core::f64::consts::PI / 180.0;

/// A practice shot on level cloth: an object ball that shall be sent along +x, struck by a cue ball
/// that a level cue hits in the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drill {
    /// Cut β: from the cue ball's direction to the wanted one, anticlockwise positive [rad].
    pub cut_rad: f64,
    /// Cut that is aimed for: cue ball's direction against the line of centres, of β's sign [rad].
    pub commanded_rad: f64,
    /// Way of the cue ball [m].
    pub to_ball_m: f64,
    /// Speed of the tip [m/s].
    pub tip_speed_m_s: f64,
    /// Middle of a third ball, from that of the object ball [m].
    pub obstacle: Option<DVec2>,
}

/// What was seen of a practice shot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sighting {
    /// α, by how much the object ball left too straight, that is towards the cue ball's line;
    /// negative if it was cut too thin [°].
    pub error_deg: f64,
    /// Speed of the cue ball when it met the ball [m/s].
    pub ball_speed_m_s: f64,
}

/// Level cloth with these contact laws, on which [`Drill`]s are played.
///
/// # Errors
/// [`PhysicsError`] if the settings fit no solver.
pub fn practice_table(settings: &PhysicsSettings) -> Result<Simulation, PhysicsError> {
    let balls = vec![at_rest(BallId::CUE, DVec2::ZERO), at_rest(OBJECT, DVec2::X)];
    Simulation::from_parts(&Table::plane(), balls, settings)
}

impl Drill {
    /// Plays the shot on a [`practice_table`] and watches from above: the object ball's direction
    /// between two looks, the last of them 30 ms or 2 R of way after the contact, and before the
    /// next contact. Only where a third ball lies in the way does nobody notice that contact. None
    /// if the ball was missed or met something else at once.
    ///
    /// # Errors
    /// [`PhysicsError`] if the balls overlap or the stroke is none.
    pub fn play(&self, start: &Simulation) -> Result<Option<Sighting>, PhysicsError> {
        let line = turned(DVec2::X, -self.cut_rad);
        let ghost = turned(line, self.commanded_rad) * (-2.0 * POOL_RADIUS_M);
        let cue = ghost - line * self.to_ball_m;
        let mut balls = vec![at_rest(BallId::CUE, cue), at_rest(OBJECT, DVec2::ZERO)];
        balls.extend(self.obstacle.map(|place| at_rest(OBSTACLE, place)));
        let strike = Strike {
            speed_m_s: self.tip_speed_m_s,
            azimuth_deg: libm::atan2(line.y, line.x) / DEGREE,
            ..Strike::CENTRE
        };
        let mut table = start.with_balls(balls)?.strike(strike)?;

        let mut facts = Vec::new();
        table.advance(MISSED_S, FactSet::of(&[Topic::BallsCollided]), &mut facts)?;
        let Some((met_s, normal_m_s)) = facts.iter().find_map(meeting) else { return Ok(None) };
        let ball_speed_m_s = normal_m_s / libm::cos(self.commanded_rad);
        let way = self.watch(&mut table, met_s)?;
        Ok(way.and_then(DVec2::try_normalize).map(|way| {
            let off_rad = signed_angle(DVec2::X, way) * self.cut_rad.signum();
            Sighting { error_deg: -off_rad / DEGREE, ball_speed_m_s }
        }))
    }

    /// Where the object ball went between the last two looks [m].
    fn watch(&self, table: &mut Simulation, met_s: Seconds) -> Result<Option<DVec2>, PhysicsError> {
        let mut before = DVec2::ZERO;
        let mut way = None;
        let mut facts = Vec::new();
        for look in 1.. {
            let at = met_s + LOOK_S * f64::from(look);
            // A solver in steps shows only what lies behind it.
            table.advance(at + LOOK_S, FactSet::of(&[]), &mut facts)?;
            let met_more = facts.iter().any(|fact| {
                let (after, before) = (met_s + 1e-9 < fact.time_s, fact.time_s <= at);
                after && before && concerns_object(fact)
            });
            if met_more && self.obstacle.is_none() {
                break;
            }
            let Some(ball) = table.sample(OBJECT, at) else { break };
            let place = ball.position.truncate();
            way = Some(place - before);
            before = place;
            if at >= met_s + WATCH_S || place.length() >= WATCH_M {
                break;
            }
        }
        Ok(way)
    }
}

/// When the cue ball met the object ball, and how fast along the line of centres.
fn meeting(fact: &Fact) -> Option<(Seconds, f64)> {
    match fact.kind {
        FactKind::BallsCollided { a: BallId::CUE, b: OBJECT, normal_speed_m_s, .. } => {
            Some((fact.time_s, normal_speed_m_s))
        }
        _ => None,
    }
}

fn concerns_object(fact: &Fact) -> bool {
    match fact.kind {
        FactKind::BallsCollided { a, b, .. } => a == OBJECT || b == OBJECT,
        FactKind::CushionHit { ball, .. } => ball == OBJECT,
        _ => false,
    }
}

fn at_rest(id: BallId, place: DVec2) -> (Ball, BallState) {
    let ball = Ball::pool(id);
    let state = BallState::at_rest(id, place.extend(ball.radius_m));
    (ball, state)
}
