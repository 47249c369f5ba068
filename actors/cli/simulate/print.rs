//! What `simulate` prints.

use super::super::json_line;
use hapticbillard::ball::{BallPlace, BallState, Motion};
use hapticbillard::events::Fact;
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Simulation, Work};
use hapticbillard_actors::error::Error;
use serde::Serialize;
use std::io::Write;

/// A ball as JSON has it.
#[derive(Serialize)]
pub struct BallLine {
    id: BallId,
    position_m: [f64; 3],
    velocity_m_s: [f64; 3],
    angular_velocity_rad_s: [f64; 3],
    motion: Motion,
    place: BallPlace,
}

impl From<BallState> for BallLine {
    fn from(ball: BallState) -> Self {
        BallLine {
            id: ball.id,
            position_m: ball.position.to_array(),
            velocity_m_s: ball.velocity.to_array(),
            angular_velocity_rad_s: ball.angular_velocity.to_array(),
            motion: ball.motion,
            place: ball.place,
        }
    }
}

/// A fact as JSON has it: as in rule files, and with its long name.
#[derive(Serialize)]
pub struct FactLine<'a> {
    #[serde(flatten)]
    fact: &'a Fact,
    #[serde(rename = "fact")]
    name: &'static str,
}

impl<'a> From<&'a Fact> for FactLine<'a> {
    fn from(fact: &'a Fact) -> Self {
        FactLine { fact, name: fact.kind.name() }
    }
}

/// Energy at both ends [J].
#[derive(Serialize)]
pub struct Energy {
    start: f64,
    end: f64,
    residual: f64,
}

impl Energy {
    /// From the ledger of a simulation.
    pub fn of(simulation: &Simulation) -> Self {
        let ledger = simulation.ledger();
        Energy {
            start: ledger.start_j,
            end: ledger.kinetic_j + ledger.potential_j,
            residual: ledger.residual_j,
        }
    }
}

#[derive(Serialize)]
struct Summary {
    end_s: f64,
    facts: usize,
    cpu_ms: f64,
    work: Work,
    #[serde(rename = "energy_J")]
    energy: Energy,
    state_hash: Digest,
}

/// The hash of everything that decides the future.
pub fn state_hash(simulation: &Simulation) -> Digest {
    let mut hash = StateHash::new();
    simulation.hash(&mut hash);
    hash.finish()
}

/// All balls at one time.
pub fn balls(simulation: &Simulation, time_s: f64) -> Vec<BallLine> {
    simulation.snapshot(time_s).balls.into_iter().map(BallLine::from).collect()
}

/// One sample.
pub fn sample(
    json: bool,
    simulation: &Simulation,
    time_s: f64,
    out: &mut dyn Write,
) -> Result<(), Error> {
    let balls = balls(simulation, time_s);
    if json {
        return json_line(out, &serde_json::json!({ "t": time_s, "balls": balls }));
    }
    balls.iter().try_for_each(|ball| {
        write!(out, "{time_s:>9.4} s  ")?;
        describe(ball, out)
    })
}

fn describe(ball: &BallLine, out: &mut dyn Write) -> Result<(), Error> {
    let [x, y, z] = ball.position_m.map(|length| length * 1e3);
    let [a, b, c] = ball.velocity_m_s;
    let speed = (a * a + b * b + c * c).sqrt();
    let what = match ball.place {
        BallPlace::OnTable => format!("{:?}", ball.motion).to_lowercase(),
        BallPlace::Pocketed => "pocketed".into(),
        BallPlace::OffTable => "off the table".into(),
        BallPlace::InHand => "in hand".into(),
    };
    let id = ball.id.to_string();
    Ok(writeln!(out, "ball {id:>2}  {x:>9.2} {y:>9.2} {z:>8.2} mm  {speed:>7.3} m/s  {what}")?)
}

/// One fact.
pub fn fact(json: bool, fact: &Fact, out: &mut dyn Write) -> Result<(), Error> {
    if json {
        return json_line(out, &FactLine::from(fact));
    }
    // The fields of a fact, without the braces and the tag, read like a sentence.
    let fields = serde_json::to_value(fact.kind).unwrap_or_default();
    let fields: Vec<String> = fields
        .as_object()
        .into_iter()
        .flatten()
        .filter(|(key, _)| *key != "e")
        .map(|(key, value)| match value.as_array() {
            Some(numbers) => {
                let numbers = numbers.iter().filter_map(serde_json::Value::as_f64);
                let numbers: Vec<String> = numbers.map(|n| format!("{n:.4}")).collect();
                format!("{key} ({})", numbers.join(", "))
            }
            None => match value.as_f64() {
                Some(number) => format!("{key} {number:.4}"),
                None => format!("{key} {}", value.to_string().trim_matches('"')),
            },
        })
        .collect();
    Ok(writeln!(out, "{:>9.4} s  {:<17} {}", fact.time_s, fact.kind.name(), fields.join(", "))?)
}

/// The end of a run.
pub fn summary(
    json: bool,
    simulation: &Simulation,
    end_s: f64,
    facts: usize,
    cpu_ms: f64,
    out: &mut dyn Write,
) -> Result<(), Error> {
    let (work, energy) = (simulation.work(), Energy::of(simulation));
    let state_hash = state_hash(simulation);
    if json {
        let summary = Summary { end_s, facts, cpu_ms, work, energy, state_hash };
        return json_line(out, &serde_json::json!({ "summary": summary }));
    }
    balls(simulation, end_s).iter().try_for_each(|ball| describe(ball, out))?;
    writeln!(
        out,
        "{end_s:.4} s simulated in {cpu_ms:.2} ms of processor time; {facts} facts, {} steps, \
         {} events, {} contacts, {} pair and {} face tests",
        work.steps, work.events, work.contacts, work.pair_tests, work.face_tests
    )?;
    Ok(writeln!(
        out,
        "energy {:.6} J at the start, {:.6} J at the end, {:.1e} J unaccounted for; \
         state {state_hash}",
        energy.start, energy.end, energy.residual
    )?)
}
