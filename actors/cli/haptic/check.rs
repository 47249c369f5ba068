//! `hapticbillard haptic check`: the servo's thread on this machine.

use super::load::Load;
use crate::cli::play::stop_at_interrupt;
use crate::cli::{Status, json_line, positive};
use clap::Args;
use glam::DVec3;
use hapticbillard::cue::Aim;
use hapticbillard::haptic::{
    Counters, Effect, EffectSet, HapticMesh, Reach, ReachSettings, Region,
};
use hapticbillard::ids::BallId;
use hapticbillard::scene::HapticDevice;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{
    Asked, Core, DeviceRecorder, Grant, Obtained, Plan, Recorded, Seat, Started, Telemetry, Timing,
    Watch, Written, allowed, open,
};
use hapticbillard_actors::histogram::Histogram;
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

const EXAMPLE: &str = "\
It runs the servo as a game does: the table and the 16 balls of eight_ball, 8 weak effects.
Lateness is from a deadline to the wake; other programs, a virtual machine and the system cause it.
Work is the thread's own processor time per tick. It exits with 1 if more than one tick in 1000
worked for more than half a millisecond, which is the servo's own making, or if the device is not
ready at the end.

A real device is pushed, and with its whole force where its stylus is moved against a ball: hold
it. Where a vendor's library has a scheduler of its own, that one turns the servo; --core,
--priority and --spin-us are its affair then, and lateness is from one period after the last tick.

With --record what the device says is written down, tick by tick; --device recorded:FILE says it
again, here or in a scene. Ctrl-C ends early and loses nothing.

Examples:
  hapticbillard haptic check
  hapticbillard haptic check --seconds 15 --load --json
  hapticbillard haptic check --device openhaptics
  hapticbillard haptic check --device haply --seconds 60 --record hand.jsonl
  hapticbillard haptic check --device recorded:hand.jsonl
  hapticbillard haptic check --telemetry ticks.csv";

/// The scene that is felt.
const SCENE: &str = "eight_ball";
/// Of so many ticks one may overrun: stolen time of a virtual machine counts as the thread's own.
const OVERRUN_IN: u64 = 1000;

/// Measures how punctual the haptic servo is here.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct CheckArgs {
    /// How long.
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = positive)]
    #[arg(allow_negative_numbers = true)]
    pub seconds: f64,

    /// The device, as a scene names it: see `hapticbillard haptic devices`.
    #[arg(long, value_name = "DEVICE", default_value = "simulated", value_parser = device)]
    pub device: HapticDevice,

    /// Records what the device says into this file, as JSON lines.
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,

    /// Keeps every core busy meanwhile.
    #[arg(long)]
    pub load: bool,

    /// The core to stay on, in place of the last one.
    #[arg(long, value_name = "N")]
    pub core: Option<u32>,

    /// The real-time priority to ask for, 1 to 99.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=99))]
    pub priority: Option<u8>,

    /// How long before a deadline to stop sleeping [µs].
    #[arg(long, value_name = "US", value_parser = clap::value_parser!(u32).range(0..=500))]
    pub spin_us: Option<u32>,

    /// Writes every tick into this file, as CSV.
    #[arg(long, value_name = "FILE")]
    pub telemetry: Option<PathBuf>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

fn device(text: &str) -> Result<HapticDevice, String> {
    let device = HapticDevice::named(text).filter(|device| *device != HapticDevice::None);
    device.ok_or("`hapticbillard haptic devices` lists them".to_string())
}

/// What came of it.
struct Checked {
    seat: Arc<Seat>,
    /// What the safety chain did.
    counters: Counters,
    /// Why the device was not ready, in the order in which that was seen.
    troubles: Vec<String>,
    /// Whether it is not ready now.
    is_in_trouble: bool,
    /// What was recorded, where that was wanted.
    recorded: Option<Recorded>,
    /// The telemetry that was written, where that was wanted.
    written: Option<Written>,
}

/// Runs the servo and tells.
pub fn run(args: &CheckArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let usual = Asked::default();
    let asked = Asked {
        core: args.core.map_or(usual.core, Core::Number),
        priority: args.priority.or(usual.priority),
        spin_us: args.spin_us.unwrap_or(usual.spin_us),
        ..usual
    };
    if args.seconds > 86_400.0 {
        let problem = format!("{} is longer than a day", args.seconds);
        return Err(Error::input("--seconds", problem, "write a number up to 86400"));
    }
    let stage = Stage::new(&load_scene(SCENE)?, SCENE)?;
    let checked = {
        let _load = args.load.then(Load::start);
        felt(&stage, args, asked)?
    };
    let timing = checked.seat.timing();
    let is_ours = timing.overruns() * OVERRUN_IN > timing.ticks();
    if args.json {
        json_line(out, &json!({ "summary": summary(args, &checked, asked) }))?;
    } else {
        print(&checked, asked, out)?;
        if let Some(written) = &checked.written {
            writeln!(out, "{written}")?;
        }
    }
    Ok(if is_ours || checked.is_in_trouble { Status::CheckFailed } else { Status::Success })
}

/// Lets the scene be felt for a while, its balls handed over every millisecond.
fn felt(stage: &Stage, args: &CheckArgs, asked: Asked) -> Result<Checked, Error> {
    let balls = stage.scene.build_balls(&stage.table)?;
    let simulation = stage.simulation()?;
    let aim = Aim { elevation_rad: 0.2, ..Aim::default() };
    let (parameters, settings) = (stage.scene.parameters(), ReachSettings::default());
    let cue_ball = balls.iter().find(|(ball, _)| ball.id == BallId::CUE);
    let reach =
        cue_ball.map(|(_, state)| Reach::to_ball(1, state.position, &aim, &settings, &parameters));
    let Some(opened) = open(&args.device)? else {
        return Err(Error::input("haptic check", "there is no device", "report this as a defect"));
    };
    let (opened, recorder) = match &args.record {
        Some(path) => {
            let (opened, recorder) = DeviceRecorder::tap(opened, path.clone())?;
            (opened, Some(recorder))
        }
        None => (opened, None),
    };
    let plan = Plan {
        opened,
        asked,
        mesh: Some(Arc::new(HapticMesh::of(&stage.table))),
        effects: effects(),
        reach,
        lay: None,
        bodies: balls.into_iter().map(|(ball, _)| ball).collect(),
    };
    // Ctrl-C ends it early, and in order.
    let stop = stop_at_interrupt();
    let mut watch = Watch::default();
    let telemetry = Telemetry::of(&mut watch, args.telemetry.as_deref())?;
    let Started { seat, mut world, .. } = Seat::start_watched(plan, watch)?;
    let mut held = seat.hold();
    let end = Instant::now() + Duration::from_secs_f64(args.seconds);
    let table = simulation.snapshot(simulation.now_s());
    let mut troubles = Vec::new();
    while Instant::now() < end && seat.is_running() && !stop.is_set() {
        world.show(&table);
        troubles.extend(seat.why().filter(|why| troubles.last() != Some(why)));
        std::thread::sleep(Duration::from_millis(1));
    }
    let counters = held.as_mut().map(|held| held.report().counters).unwrap_or_default();
    let is_in_trouble = !seat.is_running() || seat.why().is_some();
    troubles.extend(seat.why().filter(|why| troubles.last() != Some(why)));
    drop(held);
    let recorded = recorder.map(DeviceRecorder::finish).transpose()?;
    let written = telemetry.map(Telemetry::finish).transpose()?;
    Ok(Checked { seat, counters, troubles, is_in_trouble, recorded, written })
}

/// Eight effects, weak enough for the hand to pass through all of them.
fn effects() -> EffectSet {
    let (stiffness_n_m, damping_ns_m, region) = (30.0, 0.5, Region::Everywhere);
    let (point, direction) = (DVec3::ZERO, DVec3::Z);
    EffectSet::of(
        1,
        &[
            Effect::Constant { force: DVec3::X * 0.1 },
            Effect::Point { point, stiffness_n_m, damping_ns_m },
            Effect::Line { point, direction, stiffness_n_m, damping_ns_m },
            Effect::Plane { normal: DVec3::Z, offset_m: 0.0, stiffness_n_m, damping_ns_m },
            Effect::Sphere { centre: point, radius_m: 0.03, stiffness_n_m, damping_ns_m },
            Effect::Magnet { point, stiffness_n_m, force_max_n: 0.3, reach_m: 0.05 },
            Effect::Viscous { region, damping_ns_m },
            Effect::StickSlip { region, stiffness_n_m, force_max_n: 0.1 },
        ],
    )
}

fn us(ns: u64) -> f64 {
    ns as f64 / 1000.0
}

fn quantiles(histogram: &Histogram) -> Value {
    let [p50, p99, p99_9] = [0.5, 0.99, 0.999].map(|share| us(histogram.quantile(share)));
    json!({ "p50": p50, "p99": p99, "p99_9": p99_9, "max": us(histogram.most()) })
}

fn summary(args: &CheckArgs, checked: &Checked, asked: Asked) -> Value {
    let Checked { seat, counters, troubles, .. } = checked;
    let (timing, obtained, spec) = (seat.timing(), seat.obtained(), seat.spec());
    let rights = |wanted: Value, grant: &Grant| json!({ "asked": wanted, "outcome": grant });
    json!({
        "seconds": args.seconds,
        "load": args.load,
        "core": rights(json!(asked.core), &obtained.core),
        "priority": rights(json!(asked.priority), &obtained.priority),
        "memory": rights(json!(asked.lock_memory), &obtained.memory),
        "spin_us": asked.spin_us,
        "ticks": timing.ticks(),
        "missed": timing.missed(),
        "late_100us": timing.late(),
        "lateness_us": quantiles(&timing.lateness),
        "work_us": quantiles(&timing.work),
        "overruns": timing.overruns(),
        "device": {
            "name": args.device.name(),
            "model": spec.model,
            "rate_hz": spec.rate_hz,
            "force_max_n": spec.force_max_n,
            "latency_us": us((spec.latency_s * 1e9) as u64),
            "late_us": us((seat.device_late_s() * 1e9) as u64),
            "stiffness_max_n_m": allowed(seat),
            "recorded": checked.recorded.map(|recorded| recorded.readings),
            "recording_lost": checked.recorded.map(|recorded| recorded.lost),
            "refused": seat.device_refusal().map(ToString::to_string),
            "troubles": troubles,
        },
        "safety": {
            "not_finite": counters.not_finite,
            "late": counters.late,
            "stalls": counters.stalls,
            "too_fast": counters.too_fast,
        },
        "telemetry": checked.written.as_ref().map(|Written { path, rows, lost }| {
            json!({ "file": path, "rows": rows, "lost": lost })
        }),
    })
}

fn print(checked: &Checked, asked: Asked, out: &mut dyn Write) -> Result<(), Error> {
    let Checked { seat, counters, troubles, .. } = checked;
    let spec = seat.spec();
    let (model, force_n, rate_hz) = (spec.model, spec.force_max_n, spec.rate_hz);
    let (latency, late) = (spec.latency_s * 1000.0, seat.device_late_s() * 1000.0);
    writeln!(
        out,
        "device     {model}, {force_n} N, {rate_hz} Hz, {latency:.2} ms late and {late:.2} ms more \
         at times; {:.0} N/m at most",
        allowed(seat)
    )?;
    if let Some(Recorded { readings, lost }) = checked.recorded {
        writeln!(out, "recorded   {readings} readings, {lost} lost")?;
    }
    for trouble in seat.device_refusal().map(ToString::to_string).iter().chain(troubles) {
        writeln!(out, "trouble    {trouble}")?;
    }
    write_rights(asked, seat.obtained(), out)?;
    let timing: &Timing = seat.timing();
    let (ticks, missed, late) = (timing.ticks(), timing.missed(), timing.late());
    writeln!(out, "ticks      {ticks}; {missed} deadlines missed, {late} wakes over 100 µs late")?;
    for (name, histogram) in [("lateness", &timing.lateness), ("work", &timing.work)] {
        let [p50, p99, p99_9] = [0.5, 0.99, 0.999].map(|share| us(histogram.quantile(share)));
        let most = us(histogram.most());
        writeln!(
            out,
            "{name:<10} p50 {p50:.1} µs, p99 {p99:.1} µs, p99.9 {p99_9:.1} µs, max {most:.1} µs"
        )?;
    }
    let overruns = timing.overruns();
    writeln!(out, "overruns   {overruns} ticks worked for more than half a millisecond")?;
    let Counters { not_finite, late, stalls, too_fast, .. } = counters;
    Ok(writeln!(
        out,
        "safety     {not_finite} readings without numbers, {late} late ticks, {stalls} stalls, \
         {too_fast} times too fast"
    )?)
}

/// What was asked for and what came of it, a line each.
pub fn write_rights(asked: Asked, obtained: &Obtained, out: &mut dyn Write) -> Result<(), Error> {
    let core = asked.core.to_string();
    let priority = asked
        .priority
        .map_or("no priority".to_string(), |priority| format!("real-time priority {priority}"));
    let memory = if asked.lock_memory { "locked memory" } else { "no locked memory" };
    let parts = [core, priority, memory.to_string()];
    for ((name, grant), wanted) in obtained.parts().into_iter().zip(parts) {
        writeln!(out, "{name:<10} asked for {wanted}: {grant}")?;
    }
    if *obtained == Obtained::VENDORS {
        return Ok(());
    }
    Ok(writeln!(out, "{:<10} awake {} µs before each deadline", "spin", asked.spin_us)?)
}
