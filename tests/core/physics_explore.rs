use crate::physics_scenes::*;
use glam::DVec3;
use hapticbillard::ids::BallId;
use hapticbillard::physics::*;
use hapticbillard::rack::Rack;
use hapticbillard::table::Table;
#[test]
fn explore() {
    let table = Table::preset("pool-9ft").unwrap();
    let exact = PhysicsSettings { solver: SolverKind::EventDriven, ..PhysicsSettings::default() };
    let t0 = std::time::Instant::now();
    let sim = world(&table, &break_shot(0.0), &exact);
    println!("built in {:?}", t0.elapsed());
    for name in ["one", "two", "break"] {
        let balls = match name {
            "one" => vec![on_bed(0, -0.6, 0.1, DVec3::new(3.0, 1.0, 0.0), DVec3::new(10.0, -20.0, 30.0))],
            "two" => vec![on_bed(0, -0.6, 0.1, DVec3::new(3.0, 0.0, 0.0), DVec3::new(10.0, -20.0, 30.0)), on_bed(1, 0.2, 0.12, DVec3::ZERO, DVec3::ZERO)],
            _ => break_shot(0.0),
        };
        let sim = world(&table, &balls, &exact);
        let shot = sim.clone().run_until_rest().unwrap();
        let t0 = std::time::Instant::now();
        let n = 100;
        for _ in 0..n { let _ = sim.clone().run_until_rest().unwrap(); }
        println!("{name} {:?} per shot, end {} work {:?}\n {:?}", t0.elapsed() / n, shot.end_s, shot.work, shot.ledger);
        for f in shot.facts.iter().take(if name == "break" { 200 } else { 40 }) {
            println!("{:.6} {}", f.time_s, serde_json::to_string(&f.kind).unwrap());
        }
        for b in shot.end.snapshot(shot.end_s).balls {
            println!("{} {:?} {:?} {:?}", b.id, b.place, b.motion, b.position);
        }
        for h in [4.0, 1.0, 0.1] {
            let other = world(&table, &balls, &step(h)).run_until_rest().unwrap();
            println!("fixed {h}: end {} facts {}", other.end_s, other.facts.len());
            for b in other.end.snapshot(other.end_s).balls.iter().take(2) {
                println!("   {} {:?} {:?}", b.id, b.place, b.position);
            }
            if name == "break" { break }
        }
    }
    let _ = (sim, BallId::CUE, Rack::eight_ball(7));
}
