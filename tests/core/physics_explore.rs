use crate::physics_scenes::*;
use hapticbillard::ids::BallId;
use hapticbillard::physics::*;
use hapticbillard::rack::Rack;
use hapticbillard::table::Table;
#[test]
fn explore() {
    let table = Table::preset("pool-9ft").unwrap();
    println!("faces {}", table.mesh.faces.len());
    let sim = world(&table, &break_shot(0.0), &PhysicsSettings::default());
    let t0 = std::time::Instant::now();
    let shot = sim.clone().run_until_rest().unwrap();
    let dt = t0.elapsed();
    println!(
        "cpu {:?} end {} work {:?} per step {}",
        dt,
        shot.end_s,
        shot.work,
        shot.work.tests() as f64 / shot.work.steps as f64
    );
    println!("{:#?}", shot.ledger);
    for f in shot.facts.iter().take(40) {
        println!("{:.6} {}", f.time_s, serde_json::to_string(&f.kind).unwrap());
    }
    println!("facts {}", shot.facts.len());
    for b in shot.end.snapshot(shot.end_s).balls {
        println!("{} {:?} {:?} {:?} v{:?}", b.id, b.place, b.motion, b.position, b.velocity);
    }
    let sim = Simulation::new(table.clone(), Rack::eight_ball(7)).unwrap();
    let t0 = std::time::Instant::now();
    let shot = sim
        .clone()
        .strike(Strike { speed_m_s: 9.0, ..Strike::CENTRE })
        .unwrap()
        .run_until_rest()
        .unwrap();
    println!(
        "cpu {:?} end {} res {} facts {}",
        t0.elapsed(),
        shot.end_s,
        shot.ledger.residual_j,
        shot.facts.len()
    );
    for f in shot.facts.iter().take(10) {
        println!("{:.6} {}", f.time_s, serde_json::to_string(&f.kind).unwrap());
    }
    println!("{}", shot.trajectory(BallId::CUE).every(0.01).count());
}
