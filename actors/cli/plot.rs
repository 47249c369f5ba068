//! What figures have in common.

use hapticbillard_actors::error::Error;
use plotters::prelude::*;
use std::fmt::Display;

/// Okabe and Ito's colours (2008), which colour-blind readers can tell.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// Why a figure could not be drawn.
pub fn failed(error: impl Display) -> Error {
    Error::Output(std::io::Error::other(format!("a figure could not be drawn: {error}")))
}
