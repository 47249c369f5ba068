//! Validation: cases with a known answer, and whether this build meets them.
//!
//! A catalogue is a JSON text: each case names a kind of run, the values that it needs, and what
//! must come out within which tolerance. One runner per kind computes what is expected from the
//! project's own laws and solvers. The shipped catalogue is [`crate::shipped::CASES`]; any other
//! of the same format can be read, with other values, other balls, other runs.

mod catalogue;
mod error;
mod judge;
mod kinds;
mod observed;
mod probe;
mod setup;
mod shapes;
mod world;

mod claims;
mod cue_strike;
mod flight;
mod free;
pub(crate) mod haptic;
mod impacts;
mod learner;
mod on_mesh;
mod on_plane;
mod springs;
mod stack;
mod step_2009;
mod table_shot;
mod walls;

pub use catalogue::{Case, Catalogue};
pub use error::CatalogueError;
pub use judge::{Outcome, Status};

use crate::physics::SolverKind;
use error::Trouble;
use observed::Observations;
use setup::Setup;

/// Runs a case with a solver and judges what came out.
///
/// # Examples
/// ```
/// use hapticbillard::physics::SolverKind;
/// use hapticbillard::shipped;
/// use hapticbillard::validation::{Catalogue, Status, run};
///
/// let catalogue = Catalogue::parse(shipped::CASES)?;
/// let case = &catalogue.cases[0];
/// let outcome = run(case, SolverKind::EventDriven)?;
/// assert_eq!(outcome.status, Status::Pass);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(case: &Case, solver: SolverKind) -> Result<Outcome, CatalogueError> {
    judge::judge(case, solver)
}

/// What one run of a case shows.
fn observe(
    kind: &str,
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    match kind {
        "single_ball_on_plane" => on_plane::observe(setup, keys, solver),
        "ball_ball_impact" => impacts::observe(setup),
        "ball_ball_impact_then_roll" => impacts::observe_roll(setup),
        "balls_free" => free::observe(setup, keys, solver),
        "ball_wall_impact" => walls::observe(setup),
        "ball_mesh" => on_mesh::observe(setup, keys, solver),
        "cue_strike" => cue_strike::observe(setup, keys),
        "flight_and_bounce" => flight::observe(setup, keys, solver),
        "static_stack" => stack::observe(setup, keys, solver),
        "spring" => springs::spring(setup),
        "angular_spring" => springs::angular(setup),
        "spring_two_masses" => springs::two_masses(setup),
        "spring_frequency_response" => springs::frequency_response(setup),
        "sampled_wall" => springs::sampled_wall(setup),
        "fixed_step_spring" => step_2009::spring(setup),
        "table_shot" => table_shot::observe(setup, keys, solver),
        "parameter" => claims::parameter(setup),
        "count" => claims::count(setup, keys),
        "fixed_step_figures" => step_2009::figures(setup),
        "push_out" => step_2009::push_out(setup),
        "learner" => learner::observe(setup),
        "late_detection" => step_2009::late_detection(setup),
        "stability_limit_by_bisection" => haptic::stability_limit(setup),
        "bounce_gain" => haptic::bounce_gain(setup),
        "energy_observer" => haptic::energy_observer(setup),
        "wall_settles" => haptic::wall_settles(setup),
        "passivity_controller" => haptic::passivity_controller(setup),
        "strike_repeatability" => haptic::strike_repeatability(setup),
        "hold_still" => haptic::hold_still(setup),
        "divergence_sign" => haptic::divergence_sign(setup),
        other => Err(Trouble::Unsupported(format!("this build has no runner for {other}"))),
    }
}
