//! `hapticbillard haptic check`: the servo's thread on this machine.

use crate::cli::play::stop_at_interrupt;
use crate::cli::{Status, json_line, positive};
use clap::Args;
use glam::DVec3;
use hapticbillard::cue::Aim;
use hapticbillard::haptic::{Effect, EffectSet, HapticMesh, Reach, ReachSettings, Region};
use hapticbillard::ids::BallId;
use hapticbillard::scene::HapticDevice;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{
    Asked, Core, Grant, Histogram, Obtained, Plan, Seat, Started, Telemetry, Timing, Watch,
    Written, open,
};
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const EXAMPLE: &str = "\
It runs the servo as a game does: simulated device, the table and the 16 balls of eight_ball, 8
effects. Lateness is from a deadline to the wake; other programs, a virtual machine and the system
cause it. Work is the thread's own processor time per tick. It exits with 1 only if more than one
tick in 1000 worked for more than half a millisecond, which is the servo's own making.

Examples:
  hapticbillard haptic check
  hapticbillard haptic check --seconds 15 --load --json
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

    /// Writes every tick into this file, as CSV.
    #[arg(long, value_name = "FILE")]
    pub telemetry: Option<PathBuf>,

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
    let mut watch = Watch::default();
    let telemetry = match &args.telemetry {
        None => None,
        Some(file) => {
            let (telemetry, port) = Telemetry::begin(file, watch.timing.clone())?;
            watch.telemetry = Some(port);
            Some(telemetry)
        }
    };
    let seat = {
        let _load = args.load.then(Load::start);
        felt(&stage, asked, watch, Duration::from_secs_f64(args.seconds))?
    };
    let written = telemetry.map(Telemetry::finish).transpose()?;
    let timing = seat.timing();
    let is_ours = timing.overruns() * OVERRUN_IN > timing.ticks();
    if args.json {
        json_line(out, &json!({ "summary": summary(args, &seat, asked, written.as_ref()) }))?;
    } else {
        print(&seat, asked, out)?;
        if let Some(written) = written {
            writeln!(out, "{written}")?;
        }
    }
    Ok(if is_ours || !seat.is_running() { Status::CheckFailed } else { Status::Success })
}

/// Lets the scene be felt for a while, its balls handed over every millisecond.
fn felt(stage: &Stage, asked: Asked, watch: Watch, duration: Duration) -> Result<Arc<Seat>, Error> {
    let balls = stage.scene.build_balls(&stage.table)?;
    let simulation = stage.simulation()?;
    let aim = Aim { elevation_rad: 0.2, ..Aim::default() };
    let (parameters, settings) = (stage.scene.parameters(), ReachSettings::default());
    let cue_ball = balls.iter().find(|(ball, _)| ball.id == BallId::CUE);
    let reach =
        cue_ball.map(|(_, state)| Reach::to_ball(1, state.position, &aim, &settings, &parameters));
    let Some(opened) = open(&HapticDevice::Simulated)? else {
        return Err(Error::input("haptic check", "there is no device", "report this as a defect"));
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
    let Started { seat, mut world, .. } = Seat::start_watched(plan, watch)?;
    let held = seat.hold();
    let end = Instant::now() + duration;
    let table = simulation.snapshot(simulation.now_s());
    while Instant::now() < end && seat.is_running() && !stop.is_set() {
        world.show(&table);
        std::thread::sleep(Duration::from_millis(1));
    }
    drop(held);
    Ok(seat)
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

fn summary(args: &CheckArgs, seat: &Seat, asked: Asked, written: Option<&Written>) -> Value {
    let (timing, obtained) = (seat.timing(), seat.obtained());
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
        "telemetry": written.map(|Written { path, rows, lost }| {
            json!({ "file": path, "rows": rows, "lost": lost })
        }),
    })
}

fn print(seat: &Seat, asked: Asked, out: &mut dyn Write) -> Result<(), Error> {
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
