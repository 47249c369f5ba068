//! The fixed-step solver, theme by theme.

/// Energy and momentum: where they come from and where they go.
mod accounts;
/// Few exact tests, the same contacts for any size of cell.
mod broad_phase;
/// How fast the error falls with the step.
mod convergence;
/// What no table offers: tiny, heavy, caught and jammed balls.
mod extremes;
/// Closed forms of billiards at the game's step.
mod motion;
/// The paper's method with its known faults.
mod paper;
/// Same inputs, same bits, however a run is cut.
mod same_bits;
/// Scenes that several physics tests share.
pub mod scenes;
/// Steps cut into parts where something happens.
mod sub_steps;
/// Seams, edges and slopes of what carries a ball.
mod surfaces;
