//! `simulate --batch`: many independent shots from one start, on all cores.

use super::super::{Status, json_line, progress};
use super::SimulateArgs;
use super::print::{BallLine, Energy, FactLine, balls, state_hash};
use glam::{DQuat, DVec3};
use hapticbillard::ball::{Ball, BallPlace, BallState, Motion};
use hapticbillard::events::FactKind;
use hapticbillard::hash::Digest;
use hapticbillard::ids::BallId;
use hapticbillard::physics::Strike;
use hapticbillard_actors::batch::{self, Setup};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::read_text;
use hapticbillard_actors::game::Stage;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::Path;

/// The largest file of shots that is read [bytes].
const SIZE_MAX: u64 = 256 << 20;

/// One line of the file: a stroke, and balls in place of the scene's. Without `speed_m_s` balls of
/// its own go on as they are.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SetupLine {
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
    /// What it is made of is what the scene says of the ball with its id, or else a pool ball.
    fn place(&self, known: &[(Ball, BallState)]) -> (Ball, BallState) {
        let of_scene = known.iter().find(|(ball, _)| ball.id == self.id);
        let ball = of_scene.map_or_else(|| Ball::pool(self.id), |(ball, _)| ball.clone());
        let state = BallState {
            id: self.id,
            position: DVec3::from_array(self.position_m),
            velocity: DVec3::from_array(self.velocity_m_s),
            angular_velocity: DVec3::from_array(self.angular_velocity_rad_s),
            orientation: DQuat::IDENTITY,
            motion: Motion::Rest,
            place: BallPlace::OnTable,
        };
        (ball, state)
    }
}

impl SetupLine {
    fn setup(&self, known: &[(Ball, BallState)]) -> Setup {
        let balls = self.balls.as_ref();
        let strikes = balls.is_none() || self.speed_m_s.is_some();
        let strike = Strike {
            speed_m_s: self.speed_m_s.unwrap_or(Strike::CENTRE.speed_m_s),
            azimuth_deg: self.azimuth_deg,
            elevation_deg: self.elevation_deg,
            side_offset: self.side,
            height_offset: self.height,
        };
        Setup {
            balls: balls.map(|balls| balls.iter().map(|ball| ball.place(known)).collect()),
            strike: strikes.then_some(strike),
        }
    }
}

#[derive(Serialize)]
struct ShotLine<'a> {
    shot: usize,
    end_s: f64,
    facts: Vec<FactLine<'a>>,
    balls: Vec<BallLine>,
    #[serde(rename = "energy_J")]
    energy: Energy,
    state_hash: Digest,
}

/// Runs all shots of `file`.
pub fn run(
    args: &SimulateArgs,
    stage: &Stage,
    file: &Path,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let start = stage.simulation()?;
    let shots = read(stage, file)?;
    let setups: Vec<Setup> = shots.iter().map(|(_, setup)| setup.clone()).collect();
    let bar = progress(setups.len() as u64, "shots");
    let done = || bar.inc(1);
    batch::run(&start, &setups, args.threads, done, |shot, result| {
        let result = result.map_err(|error| wrong(file, shots[shot].0, error))?;
        let (number, end_s, facts) = (shot + 1, result.end_s, &result.facts);
        if args.json {
            let line = ShotLine {
                shot: number,
                end_s,
                facts: facts.iter().map(FactLine::from).collect(),
                balls: balls(&result.end, end_s),
                energy: Energy::of(&result.end),
                state_hash: state_hash(&result.end),
            };
            return json_line(out, &line);
        }
        let pots: Vec<String> = facts
            .iter()
            .filter_map(|fact| match fact.kind {
                FactKind::BallPocketed { ball, pocket, .. } => Some(format!("{ball} in {pocket}")),
                _ => None,
            })
            .collect();
        let pots = if pots.is_empty() { String::from("nothing falls") } else { pots.join(", ") };
        Ok(writeln!(out, "shot {number:>4}: {end_s:>7.3} s, {} facts; {pots}", facts.len())?)
    })?;
    bar.finish_and_clear();
    if args.json {
        json_line(out, &serde_json::json!({ "summary": { "shots": setups.len() } }))?;
    }
    Ok(Status::Success)
}

/// The shots of a file, with their lines.
pub fn read(stage: &Stage, file: &Path) -> Result<Vec<(usize, Setup)>, Error> {
    let known = stage.scene.build_balls(&stage.table)?;
    let text = read_text(file, SIZE_MAX)?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(index, line)| match serde_json::from_str::<SetupLine>(line) {
            Ok(line) => Ok((index + 1, line.setup(&known))),
            Err(error) => Err(wrong(file, index + 1, error)),
        })
        .collect()
}

/// What is wrong with a line.
pub fn wrong(file: &Path, line: usize, error: impl std::fmt::Display) -> Error {
    let fix = "a line is for example {\"speed_m_s\":4,\"azimuth_deg\":10}; see simulate --help";
    Error::input(format!("{}:{line}", file.display()), error.to_string(), fix)
}
