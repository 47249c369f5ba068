//! Facts and samples out of JSON lines.
#![cfg(feature = "sound")]

use glam::{DQuat, DVec3};
use hapticbillard::ball::{BallPlace, BallState, Motion};
use hapticbillard::events::Fact;
use hapticbillard::ids::BallId;
use hapticbillard::physics::Snapshot;
use hapticbillard::sound::Foley;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::open_lines;
use hapticbillard_actors::sound::{Score, score_of_facts};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use std::sync::Arc;

/// The most that is read [bytes].
const BYTES_MAX: u64 = 1 << 30;
/// Radii of balls [m].
const RADII_M: std::ops::RangeInclusive<f64> = 0.01..=0.1;
/// Where a scene says nothing [m/s²].
const GRAVITY_M_S2: f64 = 9.81;

/// A line of `simulate --json`.
#[derive(Deserialize)]
#[serde(untagged)]
enum Line {
    Fact(Fact),
    Sample { t: f64, balls: Vec<BallLine> },
    Other {},
}

#[derive(Deserialize)]
struct BallLine {
    id: BallId,
    position_m: DVec3,
    velocity_m_s: DVec3,
    angular_velocity_rad_s: DVec3,
    motion: Motion,
    place: BallPlace,
}

impl From<BallLine> for BallState {
    fn from(line: BallLine) -> Self {
        BallState {
            id: line.id,
            position: line.position_m,
            velocity: line.velocity_m_s,
            angular_velocity: line.angular_velocity_rad_s,
            orientation: DQuat::IDENTITY,
            motion: line.motion,
            place: line.place,
        }
    }
}

/// The score of a file, or of stdin.
pub fn score(file: &Path, rate_hz: u32, seed: u64) -> Result<Score, Error> {
    let is_stdin = file == Path::new("-");
    let name = if is_stdin { "stdin".to_string() } else { file.display().to_string() };
    let input: Box<dyn Read> =
        if is_stdin { Box::new(io::stdin().lock()) } else { Box::new(open_lines(file)?) };
    let (mut facts, mut snapshots) = (Vec::new(), Vec::new());
    for (i, line) in BufReader::new(input.take(BYTES_MAX)).lines().enumerate() {
        let line = line.map_err(|reason| Error::Read { path: file.to_path_buf(), reason })?;
        if line.trim().is_empty() {
            continue;
        }
        match parse(&line) {
            Ok(Line::Fact(fact)) => facts.push(fact),
            Ok(Line::Sample { t, balls }) => snapshots.push(snapshot(t, balls)),
            Ok(Line::Other {}) => {}
            Err(problem) => {
                let fix = "write lines as `simulate --json` prints them";
                return Err(Error::input(format!("{name}:{}", i + 1), problem, fix));
            }
        }
    }
    facts.sort_by(|a: &Fact, b: &Fact| a.time_s.total_cmp(&b.time_s));
    snapshots.sort_by(|a: &Arc<Snapshot>, b| a.time_s.total_cmp(&b.time_s));
    if facts.is_empty() && snapshots.is_empty() {
        let fix = "pipe the output of `simulate --json` in";
        return Err(Error::input(name, "there is no fact in it", fix));
    }
    let first = snapshots.first().cloned().unwrap_or_default();
    let foley = Foley::new(radii(&snapshots), GRAVITY_M_S2, seed, first);
    Ok(score_of_facts(&facts, &snapshots, foley, rate_hz))
}

/// Radius of each ball [m], which no line says: the height at which its centre lies or rolls on the
/// bed, the least of all where it hops a little.
fn radii(snapshots: &[Arc<Snapshot>]) -> BTreeMap<BallId, f64> {
    let mut radii = BTreeMap::new();
    for ball in snapshots.iter().flat_map(|snapshot| snapshot.on_table()) {
        let height_m = ball.position.z;
        let lies = ball.motion != Motion::Airborne && RADII_M.contains(&height_m);
        if lies {
            let radius_m = radii.entry(ball.id).or_insert(height_m);
            *radius_m = height_m.min(*radius_m);
        }
    }
    radii
}

fn snapshot(time_s: f64, lines: Vec<BallLine>) -> Arc<Snapshot> {
    let mut balls: Vec<BallState> = lines.into_iter().map(BallState::from).collect();
    balls.sort_by_key(|ball| ball.id);
    Arc::new(Snapshot { time_s, balls, cue: None })
}

/// A line; numbers that are none or too large for a stream are wrong.
fn parse(line: &str) -> Result<Line, String> {
    let value: serde_json::Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let is_fact = value.get("e").is_some();
    let parsed: Result<Line, _> = if is_fact {
        serde_json::from_value(value).map(Line::Fact)
    } else {
        serde_json::from_value(value)
    };
    let parsed = parsed.map_err(|error| error.to_string())?;
    let t = match &parsed {
        Line::Fact(fact) => fact.time_s,
        Line::Sample { t, .. } => *t,
        Line::Other {} => 0.0,
    };
    if (0.0..1e6).contains(&t) { Ok(parsed) } else { Err(format!("t = {t}: no time of a game")) }
}
