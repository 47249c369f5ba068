//! What of a pool table only a finger notices: castings, diamonds, well rounded edges.
//!
//! No ball comes near them, so the mesh of the physics does not have them (paper, section 4.1.2);
//! a haptic device feels them. They are laid over that mesh, made when somebody asks.

use super::Table;
use super::display::castings;
use super::parameters::TableParameters;
use super::plan::Detail;
use super::quarter::{Part, quarter};
use crate::mesh::{Face, Mesh, Surface};
use glam::{DVec2, DVec3};

/// How high the middle of a diamond stands above the rail [m]: an inlay that can be felt.
const DIAMOND_M: f64 = 0.001;

/// Round edges are divided more finely than for balls; the rest is not used.
const DETAIL: Detail = Detail {
    nose_below: 1,
    nose_above: 1,
    pocket_front: 8,
    pocket_back: 8,
    lip: 1,
    pocket_rows: 1,
    bottom_rings: 1,
    edge: 8,
    grid_m: 0.3,
};

impl Table {
    /// The faces that are felt besides those that balls touch; none unless it is a pool table.
    pub fn trim(&self) -> Mesh {
        let mut mesh = Mesh::default();
        let Some(table) = &self.parameters else { return mesh };
        for corners in rounded_edges(table).into_iter().chain(diamonds(table)) {
            add(&mut mesh, corners);
        }
        castings(table).into_iter().for_each(|corners| add(&mut mesh, corners));
        mesh
    }
}

fn add(mesh: &mut Mesh, corners: [DVec3; 3]) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners);
    mesh.faces.push(Face { corners: [first, first + 1, first + 2], surface: Surface::Wood });
}

/// The outer edge of the rails and the corners of the table, in all four quarters. The chords of
/// a coarser division lie inside of these.
fn rounded_edges(table: &TableParameters) -> Vec<[DVec3; 3]> {
    let Some(body) = quarter(table, &DETAIL) else { return Vec::new() };
    let mut faces = Vec::new();
    for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        for triangle in body.triangles.iter().filter(|t| t.part == Part::RailSide) {
            let mut corners = triangle.corners.map(|p| p * DVec3::new(sx, sy, 1.0));
            if sx * sy < 0.0 {
                corners.swap(1, 2);
            }
            faces.push(corners);
        }
    }
    faces
}

/// The eighteen sights, each a flat pyramid.
fn diamonds(table: &TableParameters) -> Vec<[DVec3; 3]> {
    let mut faces = Vec::new();
    let foot_z = table.rail_height_m;
    for (centre, across) in table.sights() {
        let along = across.perp() * (0.5 * table.diamond_width_m);
        let across = across * (0.5 * table.diamond_length_m);
        let rim: [DVec2; 5] = [across, along, -across, -along, across];
        for pair in rim.windows(2) {
            let foot = |offset: DVec2| (centre + offset).extend(foot_z);
            faces.push([centre.extend(foot_z + DIAMOND_M), foot(pair[0]), foot(pair[1])]);
        }
    }
    faces
}
