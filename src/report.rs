//! Report: how far each method is from the truth, what it computed for that, and where it breaks.
//!
//! A [`Scene`] of the [`CATALOGUE`] is run by a [`Method`] for some starts that differ a little.
//! The truth is a closed form where there is one, and else the exact solver, whose own error is
//! then estimated. Nothing here reads a clock: whoever calls may time [`Prepared::watch`].

mod answers;
mod case;
mod catalogue;
mod chaos;
mod closed_loop;
mod felt_wall;
mod hop;
mod idle;
mod method;
mod order;
mod peers;
mod stability;
mod starts;
mod trial;

pub use case::{CaseBall, CaseStart, Ground, GroundPlane, Law, Part, Rub, SceneCase};
pub use catalogue::{CATALOGUE, Norm, Scene, Until};
pub use chaos::{Growth, Spread, growth, spread};
pub use closed_loop::{LOOP_HANDS, LoopPoint, LoopRow, closed_loop, loop_points};
pub use felt_wall::{FeltWall, RATES_HZ, SPEED_M_S, STIFFNESS_N_M, felt_wall};
pub use hop::{Form, Hop, hop, solver_hop};
pub use idle::{Idle, idle};
pub use method::{
    IN_PARTS, INTEGRATORS, Method, STEPS_MS, SUB_STEPS, Tolerances, all_methods, stepping,
};
pub use order::{computations, fitted_order, on_the_front, orders};
pub use peers::{PeerRow, PeerStatus, Peers, PeersError, Program, cheaper_and_better};
pub use stability::{
    CASES, COLUMNS, Case, Cell, Class, HertzRow, Limit, RATIOS, RestRow, STIFFNESSES, hertz_rows,
    rest_rows, spring_cell, spring_limit,
};
pub use trial::{Failure, Patience, Prepared, Row, Status, Track, judge, left_out};
