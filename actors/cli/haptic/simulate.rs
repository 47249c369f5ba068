//! `hapticbillard haptic simulate`: a simulated hand on a simulated device, through the servo that
//! the game runs.

use crate::cli::validate::{Judged, judge};
use crate::cli::{Status, json_line, positive};
use clap::{Args, ValueEnum};
use hapticbillard::ball::{Ball, BallState, POOL_RADIUS_M};
use hapticbillard::cue::Aim;
use hapticbillard::events::FactKind;
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, SimulatedDevice};
use hapticbillard::haptic::{
    Device, DeviceSpec, Reading, RecordedDevice, RecordingWriter, Rehearsal, StylusSample,
    telemetry,
};
use hapticbillard::ids::BallId;
use hapticbillard::shipped;
use hapticbillard::table::Table;
use hapticbillard::units::TICK_S;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use hapticbillard_actors::haptic::load_recording;
use serde_json::json;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLE: &str = "\
Without --stroke it runs cases of the closed loop: stability limits found by bisection, bounces,
walls under hands, strokes at every phase. Each row is a case, as `validate` prints it; exits with 1
if one fails.

With --stroke a simulated hand strikes the cue ball on a 9-foot table with a simulated PHANTOM
Omni; --out writes every tick of the servo as CSV, --record what the device said, for a scene
(device = \"recorded:FILE\") or for --device recorded:FILE. With --recording a device that was
recorded strikes instead; the same servo gives the same forces, bit by bit.

Examples:
  hapticbillard haptic simulate
  hapticbillard haptic simulate --cases haptic_cases.json --json
  hapticbillard haptic simulate --stroke 1.0 --hand firm --out stroke.csv
  hapticbillard haptic simulate --stroke 1.0 --record hand.jsonl
  hapticbillard haptic simulate --recording hand.jsonl --json";

/// How long the hand waits before it strikes [s].
const PAUSE_S: f64 = 0.3;

/// Runs the closed loop of hand, device and renderer without hardware.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct SimulateArgs {
    /// A catalogue in JSON; without it the one that is compiled in.
    #[arg(long, value_name = "FILE", conflicts_with = "stroke")]
    pub cases: Option<PathBuf>,

    /// Runs only these cases.
    #[arg(long, value_name = "ID", num_args = 1.., conflicts_with = "stroke")]
    pub only: Vec<String>,

    /// A stroke: speed of the hand [m/s].
    #[arg(long, value_name = "SPEED", value_parser = positive, allow_negative_numbers = true)]
    pub stroke: Option<f64>,

    /// The hand that strikes.
    #[arg(long, value_enum, default_value_t, requires = "stroke")]
    pub hand: Hand,

    /// A stroke of a recorded device.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["stroke", "cases", "only"])]
    pub recording: Option<PathBuf>,

    /// Every tick of the stroke, as CSV.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["cases", "only"])]
    pub out: Option<PathBuf>,

    /// What the device said during the stroke, as JSON lines.
    #[arg(long, value_name = "FILE", requires = "stroke")]
    pub record: Option<PathBuf>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// Who holds the stylus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Hand {
    /// L: light fingers.
    Light,
    /// G: an arm with a soft grip.
    #[default]
    Grip,
    /// F: an arm with a firm grip.
    Firm,
    /// A: an arm that holds it stiffly.
    Arm,
}

impl Hand {
    fn model(self) -> HandModel {
        match self {
            Hand::Light => HandModel::LIGHT,
            Hand::Grip => HandModel::GRIP,
            Hand::Firm => HandModel::FIRM,
            Hand::Arm => HandModel::ARM,
        }
    }
}

/// Runs cases, or a stroke.
pub fn run(args: &SimulateArgs, out: &mut dyn Write) -> Result<Status, Error> {
    if let Some(path) = &args.recording {
        return replayed(args, path, out);
    }
    if let Some(speed_m_s) = args.stroke {
        return stroke(args, speed_m_s, out);
    }
    if args.out.is_some() {
        let fix = "add --stroke SPEED or --recording FILE";
        return Err(Error::input("--out", "no stroke is asked for", fix));
    }
    let cases = Judged {
        cases: args.cases.as_ref(),
        shipped: shipped::HAPTIC_CASES,
        solver: None,
        only: &args.only,
        json: args.json,
        command: "haptic simulate",
    };
    judge(&cases, out)
}

/// Fastest stroke that has a script [m/s].
const STROKE_MAX_M_S: f64 = 5.0;

/// A stroke of a simulated hand.
fn stroke(args: &SimulateArgs, speed_m_s: f64, out: &mut dyn Write) -> Result<Status, Error> {
    if !(0.05..=STROKE_MAX_M_S).contains(&speed_m_s) {
        let problem = format!("no hand strikes at {speed_m_s} m/s");
        return Err(Error::input("--stroke", problem, "write a speed from 0.05 to 5 m/s"));
    }
    let script = HandScript::stroke(speed_m_s, PAUSE_S);
    let ticks = (script.duration_s() / TICK_S) as u64;
    let guide = Guide::Script(script);
    strike(args, SimulatedDevice::new(DeviceSpec::OMNI, args.hand.model(), guide), ticks, out)
}

/// A stroke of a recorded hand.
fn replayed(args: &SimulateArgs, path: &Path, out: &mut dyn Write) -> Result<Status, Error> {
    let recording = load_recording(path)?;
    let ticks = recording.readings.len() as u64;
    strike(args, RecordedDevice::new(Arc::new(recording)), ticks, out)
}

/// A stroke along the table at the middle of the cue ball on its spot.
fn strike(
    args: &SimulateArgs,
    device: impl Device,
    ticks: u64,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    let wrong = |error: String| Error::input("the table", error, "report this as a defect");
    let table = Table::preset("pool-9ft").map_err(|error| wrong(error.to_string()))?;
    let spot = table.bed.map(|bed| bed.head_spot()).unwrap_or_default();
    let ball = Ball::pool(BallId::CUE);
    let state = BallState::at_rest(BallId::CUE, spot.extend(POOL_RADIUS_M));
    let aim = Aim { elevation_rad: 0.06, ..Aim::default() };
    let mut said = RecordingWriter::default();
    let mut recording = format!("{}\n", RecordingWriter::head(&device.spec()));
    let mut rehearsal = Rehearsal::with(&table, vec![(ball, state)], device, &aim)?;

    let mut rows = format!("{}\n", telemetry::COLUMNS);
    let (mut contact, mut peak_n, mut ball_m_s) = (None, 0.0_f64, 0.0_f64);
    for _ in 0..ticks {
        let report = rehearsal.tick()?;
        contact = contact.or(report.contact);
        peak_n = peak_n.max(report.force.0.length());
        let ball = rehearsal.ball(BallId::CUE);
        ball_m_s = ball_m_s.max(ball.map_or(0.0, |ball| ball.velocity.length()));
        if args.out.is_some() {
            rows += &telemetry::row(&report, 0.0);
            rows.push('\n');
        }
        if args.record.is_some() {
            let StylusSample { dt, device: state, .. } = report.sample;
            recording += &said.line(&Reading { dt, state });
            recording.push('\n');
        }
    }
    for (path, text) in [(&args.out, rows), (&args.record, recording)] {
        if let Some(path) = path {
            write_whole(path, text.as_bytes())?;
        }
    }
    let struck = rehearsal.facts.iter().find_map(|fact| match fact.kind {
        FactKind::CueBallStruck { normal_speed_m_s, .. } => Some((fact.time_s, normal_speed_m_s)),
        _ => None,
    });
    let counters = rehearsal.servo.report().counters;
    let summary = json!({
        "ticks": ticks,
        "contact_tick": contact.map(|contact| contact.tick),
        "struck_s": struck.map(|(time_s, _)| time_s),
        "tip_m_s": struck.map(|(_, speed)| speed),
        "ball_m_s": ball_m_s,
        "impulse_ns": contact.map(|contact| contact.impulse.length()),
        "force_peak_n": peak_n,
        "clamped_ticks": counters.clamp,
        "passivity_ticks": counters.passivity,
    });
    if args.json {
        json_line(out, &json!({ "summary": summary }))?;
    } else if let (Some((time_s, tip_m_s)), Some(contact)) = (struck, contact) {
        writeln!(out, "tip {tip_m_s:.2} m/s, ball {ball_m_s:.2} m/s, struck at {time_s:.4} s")?;
        let impulse = contact.impulse.length();
        writeln!(out, "felt at tick {}: {impulse:.3} N s, at most {peak_n:.2} N", contact.tick)?;
    } else {
        writeln!(out, "the stroke missed the ball")?;
    }
    Ok(if struck.is_some() && contact.is_some() { Status::Success } else { Status::CheckFailed })
}
