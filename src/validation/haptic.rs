//! The closed loop of hand, device and renderer.
//!
//! Every run goes through [`Servo::tick`](crate::haptic::Servo::tick) and the
//! [`SimulatedDevice`](crate::haptic::simulated::SimulatedDevice), as in the game. Positions count
//! along x, positive into the wall, whose surface lies at 0. Stability limits are found by
//! bisection between loops that grow and loops that die, not by a formula.

mod bench;
mod limits;
mod setup;
mod strike;
mod walls;

pub(crate) use bench::{Bench, wall};
pub(super) use limits::{divergence_sign, stability_limit};
pub(crate) use limits::{limit, stiffest_wall};
pub(super) use strike::strike_repeatability;
pub(super) use walls::{
    bounce_gain, energy_observer, hold_still, passivity_controller, wall_settles,
};
