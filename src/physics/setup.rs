//! One of many shots from the same start: a stroke, or balls of its own, or both.

use super::{PhysicsError, Shot, Simulation, Strike, StrikeError};
use crate::ball::{Ball, BallPlace, BallState, Motion};
use crate::ids::BallId;
use crate::one_line::without_place;
use glam::{DQuat, DVec3};
use serde::Deserialize;

/// What is different in one of many shots.
#[derive(Debug, Clone, Default)]
pub struct Setup {
    /// Balls in place of those of the start; they may be in motion.
    pub balls: Option<Vec<(Ball, BallState)>>,
    /// A stroke at the cue ball; without one the balls go on as they are.
    pub strike: Option<Strike>,
}

/// A line with balls.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Layout {
    balls: Vec<PlacedBall>,
    strike: Option<Strike>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlacedBall {
    id: BallId,
    position_m: DVec3,
    #[serde(default)]
    velocity_m_s: DVec3,
    #[serde(default)]
    angular_velocity_rad_s: DVec3,
}

/// Tells a line with balls from a stroke.
#[derive(Deserialize)]
struct Probe {
    balls: Option<serde::de::IgnoredAny>,
}

impl PlacedBall {
    /// What it is made of is what is known of the ball with its id, or else a pool ball.
    fn place(&self, known: &[(Ball, BallState)]) -> (Ball, BallState) {
        let of_start = known.iter().find(|(ball, _)| ball.id == self.id);
        let ball = of_start.map_or_else(|| Ball::pool(self.id), |(ball, _)| ball.clone());
        let state = BallState {
            id: self.id,
            position: self.position_m,
            velocity: self.velocity_m_s,
            angular_velocity: self.angular_velocity_rad_s,
            orientation: DQuat::IDENTITY,
            motion: Motion::Rest,
            place: BallPlace::OnTable,
        };
        (ball, state)
    }
}

impl Setup {
    /// Reads a shot from a line of JSON: a stroke as [`Strike::from_json`] reads it, or balls of
    /// its own, of the materials in `known`, and perhaps a stroke:
    /// `{"balls":[{"id":0,"position_m":[0,0,0.028575],"velocity_m_s":[2,0,0]}],"strike":{}}`.
    ///
    /// # Errors
    /// [`StrikeError`] with the column and what is wrong there.
    pub fn from_json(line: &str, known: &[(Ball, BallState)]) -> Result<Self, StrikeError> {
        let with_balls = matches!(serde_json::from_str(line), Ok(Probe { balls: Some(_) }));
        if !with_balls {
            return Ok(Setup { balls: None, strike: Some(Strike::from_json(line)?) });
        }
        let layout: Layout = serde_json::from_str(line).map_err(|error| StrikeError {
            column: error.column().max(1),
            problem: without_place(&error),
        })?;
        let balls = layout.balls.iter().map(|ball| ball.place(known)).collect();
        Ok(Setup { balls: Some(balls), strike: layout.strike })
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
