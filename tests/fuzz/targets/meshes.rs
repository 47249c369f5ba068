use crate::bytes::{check_line, chosen, text};
use hapticbillard::haptic::HapticMesh;
use hapticbillard::ids::BallId;
use hapticbillard::mesh::{Surface, parse_obj};
use hapticbillard::physics::{PhysicsError, Simulation};
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;

/// So long does a ball move on what is built [s].
const PLAYED_S: f64 = 0.1;

const SOLVERS: [&str; 2] = ["event-driven", "fixed-step"];
const SCALES: [&str; 3] = ["1", "1e-3", "1e6"];

pub fn run(data: &[u8]) {
    let (choice, data) = chosen(data);
    let text = text(data);
    match parse_obj(&text, Surface::Obstacle) {
        Ok(mesh) => {
            let mut corners = mesh.faces.iter().flat_map(|face| face.corners);
            assert!(corners.all(|corner| (corner as usize) < mesh.vertices.len()));
            assert!(mesh.vertices.iter().all(|vertex| vertex.is_finite()));
        }
        Err(error) => return check_line(&error.to_string()),
    }
    let scene = scene(SOLVERS[choice % 2], SCALES[choice / 2 % 3]);
    let table = match scene.build_table(&mut |_| Ok(text.clone().into_owned())) {
        Ok(table) => table,
        Err(error) => return check_line(&error.to_string()),
    };
    // Its millions of cells take much longer than all the rest.
    if choice / 6 % 2 == 0 {
        HapticMesh::of(&table);
    }
    match play(&scene, &table) {
        Ok(is_sound) => assert!(is_sound),
        Err(line) => check_line(&line),
    }
}

/// A ball above a mesh.
fn scene(solver: &str, scale: &str) -> Scene {
    let text = format!(
        "[scene]\nname = \"mesh\"\n[physics]\nsolver = \"{solver}\"\nstep_ms = 4\n[[mesh]]\n\
         file = \"a.obj\"\nscale = {scale}\n[[ball]]\nid = 1\nposition_m = [0.5, 0.4, 1.1]\n\
         velocity_m_s = [0.3, 0.2, -1]\n"
    );
    Scene::parse("mesh.toml", &text).expect("this scene is right")
}

/// Whether the ball is somewhere at the end; one line if it cannot be played.
fn play(scene: &Scene, table: &Table) -> Result<bool, String> {
    let balls = scene.build_balls(table).map_err(|error| error.to_string())?;
    let advanced = || -> Result<bool, PhysicsError> {
        let mut simulation = Simulation::from_parts(table, balls, &scene.physics)?;
        simulation.advance(PLAYED_S, Default::default(), &mut Vec::new())?;
        let ball = simulation.sample(BallId(1), PLAYED_S);
        Ok(ball.is_some_and(|ball| ball.position.is_finite() && ball.velocity.is_finite()))
    };
    advanced().map_err(|error| error.to_string())
}
