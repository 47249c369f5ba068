//! Mesh: a fixed body of faces (triangles), each with a surface that says what it is.
//!
//! Faces know no billiards beyond the name of their surface; any course of obstacles fits
//! (paper, chapter 2). Meshes do not move and do not collide with each other.

mod checks;
mod obj;
pub use obj::{OBJ_COUNT_MAX, ObjError, parse_obj};

use crate::ids::{PocketId, Rail};
use glam::DVec3;

/// What a face is made of: chooses the contact law and names what a contact means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Surface {
    /// The cloth of the bed, or any flat ground that balls play on.
    Cloth,
    /// A cushion: nose, top cloth and the facings of its jaws.
    Cushion(Rail),
    /// The wall of a pocket between cloth and bottom.
    Pocket(PocketId),
    /// The bottom of a pocket: a ball that touches it stays down.
    PocketBottom(PocketId),
    /// Top of the rail, castings: a ball that stays here has left the table.
    Wood,
    /// Floor of the room: a ball that touches it has left the table.
    Floor,
    /// Anything else: an obstacle.
    Obstacle,
}

impl Surface {
    /// Which of the surfaces around an edge or corner a ball meets there: that of highest rank.
    pub(crate) fn rank(self) -> u8 {
        match self {
            Surface::Cushion(_) => 6,
            Surface::Pocket(_) => 5,
            Surface::Wood => 4,
            Surface::Obstacle => 3,
            Surface::Cloth => 2,
            Surface::PocketBottom(_) => 1,
            Surface::Floor => 0,
        }
    }
}

/// A triangle: three corners by number, anticlockwise seen from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face {
    /// Numbers of its corners in [`Mesh::vertices`].
    pub corners: [u32; 3],
    /// What it is made of.
    pub surface: Surface,
}

/// A fixed body of faces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Corners [m].
    pub vertices: Vec<DVec3>,
    /// Triangles.
    pub faces: Vec<Face>,
}

impl Mesh {
    /// The three corners of face `index` [m].
    pub fn corners(&self, index: usize) -> [DVec3; 3] {
        self.faces[index].corners.map(|corner| self.vertices[corner as usize])
    }

    /// Adds `other`; its vertices keep their identity, so seams within each part stay closed.
    pub fn append(&mut self, other: &Mesh) {
        let offset = self.vertices.len() as u32;
        self.vertices.extend_from_slice(&other.vertices);
        self.faces.extend(other.faces.iter().map(|face| Face {
            corners: face.corners.map(|corner| corner + offset),
            surface: face.surface,
        }));
    }
}
