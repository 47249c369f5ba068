//! `hapticbillard haptic check`: the servo's thread on this machine.

use crate::cli::play::stop_at_interrupt;
use crate::cli::{Status, json_line, positive};
use clap::Args;
use glam::DVec3;
use hapticbillard::cue::Aim;
use hapticbillard::haptic::{
    DeviceStatus, Effect, EffectSet, HapticMesh, Reach, ReachSettings, Region,
};
use hapticbillard::ids::BallId;
use hapticbillard::scene::HapticDevice;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{
    Asked, Core, DeviceRecorder, Grant, Histogram, Obtained, Opened, Plan, Recorded, Seat, Started,
    Timing, allowed, open,
};
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const EXAMPLE: &str = "\
It runs the servo as a game does: a device, the table and the 16 balls of eight_ball, 8 effects.
Lateness is from a deadline to the wake; other programs, a virtual machine and the system cause it.
Work is the thread's own processor time per tick. It exits with 1 only if more than one tick in 1000
worked for more than half a millisecond, which is the servo's own making, or if the device was not
ready at the end.

With --device the hand feels weak effects; hold the device loosely. With --record what the device
says is written down, tick by tick, for --device recorded:FILE here or in a scene. Ctrl-C ends early.

Examples:
  hapticbillard haptic check
  hapticbillard haptic check --seconds 15 --load --json
  hapticbillard haptic check --device haply --seconds 60 --record hand.jsonl
  hapticbillard haptic check --device recorded:hand.jsonl";

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

    /// The device: simulated, mouse, haply, haply:HOST:PORT, recorded:FILE (see `haptic devices`).
    #[arg(long, value_name = "NAME", default_value = "simulated", value_parser = device)]
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
    #[arg(long, value_name = "US", value_parser = clap::value_parser!(u32).range(0..=1000))]
    pub spin_us: Option<u32>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
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
    let Some(opened) = open(&args.device)? else {
        let fix = "write one of those that `hapticbillard haptic devices` lists";
        return Err(Error::input("--device", "none can be felt", fix));
    };
    let (opened, recorder) = match &args.record {
        Some(path) => {
            let (opened, recorder) = DeviceRecorder::tap(opened, path.clone())?;
            (opened, Some(recorder))
        }
        None => (opened, None),
    };
    let (seat, is_ready) = {
        let _load = args.load.then(Load::start);
        felt(&stage, opened, asked, Duration::from_secs_f64(args.seconds))?
    };
    let recorded = recorder.map(DeviceRecorder::finish).transpose()?;
    let timing = seat.timing();
    let is_ours = timing.overruns() * OVERRUN_IN > timing.ticks();
    let why = match is_ready {
        true => None,
        false => Some(seat.why().unwrap_or("the device was not ready".to_string())),
    };
    if args.json {
        let mut summary = summary(args, &seat, asked);
        summary["why"] = json!(why);
        summary["recorded"] = json!(recorded.map(|recorded| recorded.readings));
        summary["recording_lost"] = json!(recorded.map(|recorded| recorded.lost));
        json_line(out, &json!({ "summary": summary }))?;
    } else {
        print(&seat, asked, out)?;
        if let (Some(Recorded { readings, lost }), Some(path)) = (recorded, &args.record) {
            writeln!(out, "recorded   {readings} readings, {lost} lost: {}", path.display())?;
        }
        if let Some(why) = &why {
            writeln!(out, "device     {why}")?;
        }
    }
    let is_wrong = is_ours || !seat.is_running() || why.is_some();
    Ok(if is_wrong { Status::CheckFailed } else { Status::Success })
}

/// A device by its name.
fn device(name: &str) -> Result<HapticDevice, String> {
    HapticDevice::named(name)
        .ok_or_else(|| "there is no such device; see `hapticbillard haptic devices`".to_string())
}

/// Lets the scene be felt for a while, its balls handed over every millisecond. Says also whether
/// the device was ready at the end.
fn felt(
    stage: &Stage,
    opened: Opened,
    asked: Asked,
    duration: Duration,
) -> Result<(Arc<Seat>, bool), Error> {
    let balls = stage.scene.build_balls(&stage.table)?;
    let simulation = stage.simulation()?;
    let aim = Aim { elevation_rad: 0.2, ..Aim::default() };
    let (parameters, settings) = (stage.scene.parameters(), ReachSettings::default());
    let cue_ball = balls.iter().find(|(ball, _)| ball.id == BallId::CUE);
    let reach =
        cue_ball.map(|(_, state)| Reach::to_ball(1, state.position, &aim, &settings, &parameters));
    let plan = Plan {
        opened,
        asked,
        mesh: Some(Arc::new(HapticMesh::of(&stage.table))),
        effects: effects(),
        reach,
        lay: None,
        bodies: balls.into_iter().map(|(ball, _)| ball).collect(),
    };
    let Started { seat, mut world, .. } = Seat::start(plan)?;
    let mut held = seat.hold();
    let stop = stop_at_interrupt();
    let end = Instant::now() + duration;
    let table = simulation.snapshot(simulation.now_s());
    while Instant::now() < end && seat.is_running() && !stop.is_set() {
        world.show(&table);
        std::thread::sleep(Duration::from_millis(1));
    }
    let report = held.as_mut().map(|held| held.report());
    let is_ready = report.is_none_or(|report| {
        report.sample.tick == 0 || report.sample.device.status == DeviceStatus::Ready
    });
    drop(held);
    Ok((seat, is_ready))
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

/// Threads that compute for nothing, one for each core, until they are dropped.
struct Load {
    stop: Arc<AtomicBool>,
    threads: Vec<std::thread::JoinHandle<()>>,
}

impl Load {
    fn start() -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = (0..cores).map(|_| {
            let stop = stop.clone();
            std::thread::spawn(move || {
                let mut x = 0_u64;
                while !stop.load(Ordering::Relaxed) {
                    x = std::hint::black_box(x.wrapping_mul(6_364_136_223_846_793_005) + 1);
                }
            })
        });
        Load { threads: threads.collect(), stop }
    }
}

impl Drop for Load {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        for thread in self.threads.drain(..) {
            // It computes nothing that it could fail at.
            let _ = thread.join();
        }
    }
}

fn us(ns: u64) -> f64 {
    ns as f64 / 1000.0
}

fn quantiles(histogram: &Histogram) -> Value {
    let [p50, p99, p99_9] = [0.5, 0.99, 0.999].map(|share| us(histogram.quantile(share)));
    json!({ "p50": p50, "p99": p99, "p99_9": p99_9, "max": us(histogram.most()) })
}

fn summary(args: &CheckArgs, seat: &Seat, asked: Asked) -> Value {
    let (timing, obtained) = (seat.timing(), seat.obtained());
    let rights = |wanted: Value, grant: &Grant| json!({ "asked": wanted, "outcome": grant });
    json!({
        "seconds": args.seconds,
        "device": args.device.name(),
        "device_latency_us": us((seat.spec().latency_s * 1e9) as u64),
        "device_late_us": us((seat.device_late_s() * 1e9) as u64),
        "stiffness_max_n_m": allowed(seat),
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
    })
}

fn print(seat: &Seat, asked: Asked, out: &mut dyn Write) -> Result<(), Error> {
    write_rights(asked, seat.obtained(), out)?;
    let (latency, late) = (seat.spec().latency_s * 1000.0, seat.device_late_s() * 1000.0);
    let (model, stiffness) = (seat.spec().model, allowed(seat));
    writeln!(
        out,
        "device     {model}: {latency:.2} ms late, {late:.2} ms more at times; {stiffness:.0} N/m \
         at most"
    )?;
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
    Ok(writeln!(out, "overruns   {overruns} ticks worked for more than half a millisecond")?)
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
    Ok(writeln!(out, "{:<10} awake {} µs before each deadline", "spin", asked.spin_us)?)
}
