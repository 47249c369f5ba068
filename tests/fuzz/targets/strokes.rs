use crate::bytes::{check_line, text};
use hapticbillard::physics::{Setup, Simulation};
use hapticbillard::rack::Rack;
use hapticbillard::table::Table;

/// Of a longer file so many lines are read.
const LINES: usize = 4;
/// So long are they played [s].
const PLAYED_S: f64 = 0.05;

thread_local! {
    static START: Simulation = {
        let table = Table::preset("pool-9ft").expect("a shipped table");
        Simulation::new(table, Rack::nine_ball(1)).expect("a shipped game")
    };
}

pub fn run(data: &[u8]) {
    START.with(|start| text(data).lines().take(LINES).for_each(|line| play(line, start)));
}

fn play(line: &str, start: &Simulation) {
    let setup = match Setup::from_json(line, &[]) {
        Ok(setup) => setup,
        Err(error) => return check_line(&error.to_string()),
    };
    let mut simulation = match setup.begin(start) {
        Ok(simulation) => simulation,
        Err(error) => return check_line(&error.to_string()),
    };
    match simulation.advance(PLAYED_S, Default::default(), &mut Vec::new()) {
        Ok(_) => {
            let balls = simulation.snapshot(PLAYED_S).balls;
            assert!(balls.iter().all(|ball| ball.position.is_finite()), "{balls:?}");
        }
        Err(error) => check_line(&error.to_string()),
    }
}
