//! What is drawn on the cloth.

use super::parameters::{Marks, TableParameters};
use super::{Bed, CAROM_START_M};
use crate::ids::BallId;
use crate::rack::Spots;
use glam::DVec2;

/// A line across the bed, the D and spots, as far as the table has them.
#[derive(Debug, Clone, PartialEq)]
pub struct ClothMarks {
    /// x of the line across: the head string or the baulk line, if there is one [m].
    pub line_x_m: Option<f64>,
    /// Radius of the half circle behind the middle of the line, if there is one [m].
    pub d_radius_m: Option<f64>,
    /// The spots [m].
    pub spots: Vec<DVec2>,
}

/// Half the width of a line on the cloth [m].
pub const HALF_LINE_M: f64 = 0.0008;
/// Radius of a spot [m].
pub const SPOT_RADIUS_M: f64 = 0.006;

impl TableParameters {
    /// What is drawn on the cloth.
    pub fn cloth_marks(&self) -> ClothMarks {
        let bed = Bed { length_m: self.length_m, width_m: self.width_m };
        match self.marks {
            Marks::Pool => ClothMarks {
                line_x_m: Some(bed.head_string_x()),
                d_radius_m: None,
                spots: vec![bed.foot_spot(), bed.head_spot()],
            },
            Marks::Snooker => ClothMarks {
                line_x_m: Some(bed.baulk_line_x()),
                d_radius_m: Some(bed.d_radius_m()),
                spots: (16..=21).map(|id| Spots::Snooker.of(&bed, BallId(id))).collect(),
            },
            Marks::Carom => {
                let (head, beside) = (bed.head_spot(), DVec2::Y * CAROM_START_M);
                ClothMarks {
                    line_x_m: None,
                    d_radius_m: None,
                    spots: vec![bed.foot_spot(), DVec2::ZERO, head, head + beside, head - beside],
                }
            }
        }
    }
}
