//! What each shipped scene has and has not, and that what is left out changes no bit.

use hapticbillard::report::{self, Idle};
use hapticbillard::scene::{PlanKind, PlanLine};
use hapticbillard::shipped;
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;

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
    /// The proof.
    pub idle: Idle,
}

impl Line {
    /// How many lines of a kind its plan has.
    pub fn count(&self, kind: PlanKind) -> usize {
        self.plan.iter().filter(|line| line.kind == kind).count()
    }
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
    let mesh = &stage.table.mesh;
    Ok(Line {
        name,
        plan: stage.scene.plan(),
        faces: mesh.faces.len(),
        table_bytes: size_of_val(&mesh.vertices[..]) + size_of_val(&mesh.faces[..]),
        start_ms,
        idle: report::idle(&stage.table, &balls, &stage.scene.physics, COMPARED_S)?,
    })
}
