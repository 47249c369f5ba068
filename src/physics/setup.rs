//! One shot of many from the same start, as a line of a file says it.

use super::{PhysicsError, Shot, Simulation, Strike};
use crate::ball::{Ball, BallState};
use crate::ids::BallId;
use crate::one_line::without_place;
use glam::DVec3;
use serde::Deserialize;

/// One shot of a batch.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Setup {
    /// Balls in place of those of the start; their states may be in motion.
    pub balls: Option<Vec<(Ball, BallState)>>,
    /// A stroke at the cue ball; without one the balls go on as they are.
    pub strike: Option<Strike>,
}

/// A line is no shot.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("column {column}: {problem}; a line is for example {{\"speed_m_s\":4,\"azimuth_deg\":10}}")]
pub struct SetupError {
    /// From 1.
    pub column: usize,
    /// What is wrong.
    pub problem: String,
}

/// A line: a stroke, and balls in place of the scene's. Without `speed_m_s` balls of its own go on
/// as they are.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Line {
    balls: Option<Vec<PlacedBall>>,
    speed_m_s: Option<f64>,
    azimuth_deg: f64,
    elevation_deg: f64,
    side: f64,
    height: f64,
}

/// A ball of a line.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct PlacedBall {
    id: BallId,
    position_m: [f64; 3],
    #[serde(default)]
    velocity_m_s: [f64; 3],
    #[serde(default)]
    angular_velocity_rad_s: [f64; 3],
}

impl PlacedBall {
    /// What it is made of is what the start says of the ball with its id, or else a pool ball.
    fn place(&self, known: &[(Ball, BallState)]) -> (Ball, BallState) {
        let of_start = known.iter().find(|(ball, _)| ball.id == self.id);
        let ball = of_start.map_or_else(|| Ball::pool(self.id), |(ball, _)| ball.clone());
        let state = BallState {
            velocity: DVec3::from_array(self.velocity_m_s),
            angular_velocity: DVec3::from_array(self.angular_velocity_rad_s),
            ..BallState::at_rest(self.id, DVec3::from_array(self.position_m))
        };
        (ball, state)
    }
}

impl Setup {
    /// Reads a shot from a line of JSON, for example
    /// `{"speed_m_s":4,"azimuth_deg":10,"elevation_deg":5,"side":0.1,"height":-0.2}`; what is
    /// missing is as in [`Strike::CENTRE`]. `balls` may hold balls in place of the start's, each
    /// with `id`, `position_m` and if it moves `velocity_m_s` and `angular_velocity_rad_s`; `known`
    /// are those of the start.
    ///
    /// # Errors
    /// [`SetupError`] with the column and the keys that there are.
    pub fn from_json(line: &str, known: &[(Ball, BallState)]) -> Result<Self, SetupError> {
        let line: Line = serde_json::from_str(line).map_err(|error| SetupError {
            column: error.column().max(1),
            problem: without_place(&error),
        })?;
        let strikes = line.balls.is_none() || line.speed_m_s.is_some();
        let strike = Strike {
            speed_m_s: line.speed_m_s.unwrap_or(Strike::CENTRE.speed_m_s),
            azimuth_deg: line.azimuth_deg,
            elevation_deg: line.elevation_deg,
            side_offset: line.side,
            height_offset: line.height,
        };
        let place = |balls: Vec<PlacedBall>| balls.iter().map(|ball| ball.place(known)).collect();
        Ok(Setup { balls: line.balls.map(place), strike: strikes.then_some(strike) })
    }

    /// This shot at its start.
    ///
    /// # Errors
    /// What is wrong with its balls or its stroke.
    pub fn begin(&self, start: &Simulation) -> Result<Simulation, PhysicsError> {
        let simulation = match &self.balls {
            Some(balls) => start.with_balls(balls.clone())?,
            None => start.clone(),
        };
        match self.strike {
            Some(strike) => simulation.strike(strike),
            None => Ok(simulation),
        }
    }

    /// Runs this shot alone.
    ///
    /// # Errors
    /// What is wrong with its balls or its stroke, or that it never comes to rest.
    pub fn run(&self, start: &Simulation) -> Result<Shot, PhysicsError> {
        self.begin(start)?.run_until_rest()
    }
}
