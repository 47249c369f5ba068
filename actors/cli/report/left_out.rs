//! What each shipped scene has and has not, and that what is left out changes no bit.

use hapticbillard::events::FactSet;
use hapticbillard::physics::{Simulation, Work};
use hapticbillard::report::{self, Idle};
use hapticbillard::scene::{PlanKind, PlanLine};
use hapticbillard::shipped;
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use std::process::{Command, Stdio};
use std::time::Instant;

/// How long a scene is run with and without things that have nothing to do [s].
pub const COMPARED_S: f64 = 3.0;

/// A scene.
pub struct Line {
    /// Its name.
    pub name: &'static str,
    /// What it starts, computes and leaves out.
    pub plan: Vec<PlanLine>,
    /// Triangles of its meshes.
    pub faces: usize,
    /// Bytes of its table: corners and triangles.
    pub table_bytes: usize,
    /// Processor time from its text to a world that can be run [ms].
    pub start_ms: f64,
    /// What its physics computed in the time that was compared.
    pub work: Work,
    /// Threads that its actors need, beside those of the pool of tasks.
    pub threads: usize,
    /// Features that are built by default and that it does not use.
    pub unused: Vec<&'static str>,
    /// A process of its own that runs its physics, if it could be watched.
    pub process: Option<Process>,
    /// The proof.
    pub idle: Idle,
}

impl Line {
    /// How many lines of a kind its plan has.
    pub fn count(&self, kind: PlanKind) -> usize {
        self.plan.iter().filter(|line| line.kind == kind).count()
    }
}

/// A process that runs the physics of a scene.
#[derive(Debug, Clone, Copy)]
pub struct Process {
    /// From its start to its end, for a millisecond of simulated time [ms].
    pub wall_ms: f64,
    /// The most memory that it had [KiB].
    pub peak_kib: u64,
}

/// Measures all shipped scenes.
pub fn measure() -> Result<Vec<Line>, Error> {
    shipped::SCENES.iter().map(|(name, _)| line(name)).collect()
}

fn line(name: &'static str) -> Result<Line, Error> {
    let begin = thread_cpu_time();
    let loaded = load_scene(name)?;
    let stage = Stage::new(&loaded, name)?;
    let simulation = stage.simulation()?;
    let start_ms = (thread_cpu_time() - begin).as_secs_f64() * 1e3;
    drop(simulation);
    let mut balls = stage.scene.build_balls(&stage.table)?;
    // Where nothing moves there would be nothing to compare.
    if let Some((_, state)) = balls.first_mut().filter(|(_, state)| state.velocity.length() == 0.0)
    {
        state.velocity = glam::DVec3::new(2.0, 0.3, 0.0);
    }
    let mut world = Simulation::from_parts(&stage.table, balls.clone(), &stage.scene.physics)?;
    world.advance(COMPARED_S, FactSet::NONE, &mut Vec::new())?;
    let plan = stage.scene.plan();
    let starts =
        |actor: &str| plan.iter().any(|line| line.kind == PlanKind::Actor && line.name == actor);
    // The default features that link an actor of the same name.
    let unused = ["renderer", "sound"].into_iter().filter(|feature| !starts(feature)).collect();
    // The main thread draws; physics has one if the scene asks.
    let threads = usize::from(starts("renderer")) + usize::from(stage.scene.physics.thread);
    let mesh = &stage.table.mesh;
    Ok(Line {
        name,
        work: world.work(),
        threads,
        unused,
        process: process(name),
        faces: mesh.faces.len(),
        table_bytes: size_of_val(&mesh.vertices[..]) + size_of_val(&mesh.faces[..]),
        start_ms,
        idle: report::idle(&stage.table, &balls, &stage.scene.physics, COMPARED_S)?,
        plan,
    })
}

/// Starts this program on a scene and watches its memory until it ends. None where the system does
/// not tell.
fn process(name: &str) -> Option<Process> {
    let begin = Instant::now();
    let mut child = Command::new(std::env::current_exe().ok()?)
        .args(["simulate", "--scene", name, "--until", "0.001"])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let file = format!("/proc/{}/status", child.id());
    let mut peak_kib = None;
    while child.try_wait().ok()?.is_none() {
        // Before the program is loaded and once it has ended there is little or nothing to read.
        peak_kib = peak_kib.max(hapticbillard_actors::files::peak_memory_kib(&file));
    }
    Some(Process { wall_ms: begin.elapsed().as_secs_f64() * 1e3, peak_kib: peak_kib? })
}
