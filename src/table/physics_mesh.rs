//! The faces of a pool table that balls touch: one closed, outward-oriented body.
//!
//! Every edge belongs to exactly two faces, so no ball slips through a seam. The body is solid
//! down to the underside of the frame; pockets are blind holes in it. Flat parts are cut into a
//! grid of about 10 cm, the size of a cell of the spatial hash (paper, chapter 2.1, which speaks
//! of about 10 000 faces).

use super::TableError;
use super::parameters::TableParameters;
use super::plan::Detail;
use super::quarter::{Hole, Part, quarter};
use crate::ids::{PocketId, Rail};
use crate::mesh::{Face, Mesh, Surface};
use glam::DVec3;
use std::collections::BTreeMap;

/// How finely physics divides a table.
const DETAIL: Detail = Detail {
    nose_below: 3,
    nose_above: 4,
    pocket_front: 24,
    pocket_back: 20,
    lip: 5,
    pocket_rows: 4,
    bottom_rings: 3,
    edge: 2,
    grid_m: 0.1,
};

/// Builds the body from its parameters.
pub(super) fn physics_mesh(table: &TableParameters) -> Result<Mesh, TableError> {
    let body = quarter(table, &DETAIL).ok_or(TableError::Shape)?;
    let mut mesh = Mesh::default();
    let mut numbers = BTreeMap::new();
    for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        for triangle in &body.triangles {
            let mut corners = triangle.corners.map(|p| {
                // Adding zero turns −0 into 0, which has other bits.
                let p = DVec3::new(p.x * sx + 0.0, p.y * sy + 0.0, p.z + 0.0);
                *numbers.entry(p.to_array().map(f64::to_bits)).or_insert_with(|| {
                    mesh.vertices.push(p);
                    mesh.vertices.len() as u32 - 1
                })
            });
            if sx * sy < 0.0 {
                corners.swap(1, 2);
            }
            mesh.faces.push(Face { corners, surface: surface(triangle.part, sx, sy) });
        }
    }
    // Parameters that pass their checks one by one may still not fit each other.
    if mesh.open_edges().is_empty() { Ok(mesh) } else { Err(TableError::Shape) }
}

/// What a part is made of in the quarter with the given signs of x and y.
fn surface(part: Part, sx: f64, sy: f64) -> Surface {
    match part {
        Part::Bed => Surface::Cloth,
        Part::LongCushion => Surface::Cushion(if sy > 0.0 { Rail::Left } else { Rail::Right }),
        Part::FootCushion => Surface::Cushion(if sx > 0.0 { Rail::Foot } else { Rail::Head }),
        Part::Lip(hole) | Part::Wall(hole) | Part::Back(hole) => {
            Surface::Pocket(pocket_id(hole, sx, sy))
        }
        Part::Bottom(hole) => Surface::PocketBottom(pocket_id(hole, sx, sy)),
        Part::RailTop | Part::RailSide | Part::Frame | Part::Underside => Surface::Wood,
    }
}

/// The pocket of the quarter with the given signs of x and y.
pub(super) fn pocket_id(hole: Hole, sx: f64, sy: f64) -> PocketId {
    match (hole, sx > 0.0, sy > 0.0) {
        (Hole::Side, _, true) => PocketId::Ml,
        (Hole::Side, _, false) => PocketId::Mr,
        (Hole::Corner, true, true) => PocketId::Fl,
        (Hole::Corner, true, false) => PocketId::Fr,
        (Hole::Corner, false, true) => PocketId::Hl,
        (Hole::Corner, false, false) => PocketId::Hr,
    }
}
