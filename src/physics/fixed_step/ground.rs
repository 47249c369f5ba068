//! What does not move: planes, and faces in their hash table, prepared once.

use super::narrow::{Triangle, triangle_meets_box};
use super::spatial_hash::{Bounds, Seen, SpatialHash};
use crate::mesh::{Mesh, Surface};
use crate::physics::tolerance;
use crate::rack::Spots;
use crate::table::{Bed, Plane, Pocket, Table};
use glam::DVec3;
use std::collections::BTreeMap;

/// The fixed part of a world; shared by all clones of a simulation.
#[derive(Debug)]
pub struct Ground {
    /// Half spaces.
    pub planes: Vec<Plane>,
    /// Faces.
    pub faces: Vec<Triangle>,
    /// The playing area.
    pub bed: Option<Bed>,
    /// Where balls return to.
    pub spots: Spots,
    /// Pockets.
    pub pockets: Vec<Pocket>,
    /// Nothing is below this [m].
    pub lowest_m: f64,
    hash: SpatialHash,
}

impl Ground {
    /// Prepares a table with cells of `cell_m`.
    pub fn new(table: &Table, cell_m: f64) -> Self {
        let faces = triangles(&table.mesh);
        let mut hash = SpatialHash::new(cell_m, faces.len());
        for (index, face) in faces.iter().enumerate() {
            let slack = tolerance::SUPPORT_M;
            hash.insert(index as u32, &face.bounds, |cell| {
                triangle_meets_box(&face.corners, cell, slack)
            });
        }
        let of_faces = faces.iter().map(|face| face.bounds.min.z);
        let of_planes = table.planes.iter().map(|plane| plane.point.z);
        Ground {
            planes: table
                .planes
                .iter()
                .map(|plane| Plane { normal: plane.normal.normalize_or(DVec3::Z), ..*plane })
                .collect(),
            bed: table.bed,
            spots: table.spots,
            pockets: table.pockets.clone(),
            lowest_m: of_faces.chain(of_planes).fold(0.0, f64::min),
            faces,
            hash,
        }
    }

    /// Collects the faces whose boxes meet `bounds`, each once, in ascending order.
    pub fn faces_near(&self, bounds: &Bounds, seen: &mut Seen, found: &mut Vec<u32>) {
        found.clear();
        seen.begin(self.faces.len());
        self.hash.visit(bounds, |face| {
            if seen.first(face) && self.faces[face as usize].bounds.overlap(bounds) {
                found.push(face);
            }
        });
        found.sort_unstable();
    }

    /// x of the head string [m].
    pub fn head_string_x(&self) -> Option<f64> {
        self.bed.map(|bed| bed.head_string_x())
    }
}

/// The faces of a mesh, those without area left out, grouped into flat patches: seams inside a flat
/// bed then do not exist.
fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let mut patches: BTreeMap<([i64; 4], Surface), (u32, DVec3, f64)> = BTreeMap::new();
    let mut triangles = Vec::with_capacity(mesh.faces.len());
    for (index, face) in mesh.faces.iter().enumerate() {
        let corners = mesh.corners(index);
        let [a, b, c] = corners;
        let Some(mut normal) = (b - a).cross(c - a).try_normalize() else { continue };
        // One sign for both sides of a plane: z up, else y, else x positive.
        let leading = [normal.z, normal.y, normal.x].into_iter().find(|x| x.abs() > 1e-6);
        if leading.is_some_and(|x| x < 0.0) {
            normal = -normal;
        }
        let offset = normal.dot(a);
        let key = [normal.x, normal.y, normal.z, offset].map(|x| (x * 1e6).round() as i64);
        let next = patches.len() as u32;
        let found = *patches.entry((key, face.surface)).or_insert((next, normal, offset));
        let flat = corners
            .iter()
            .all(|corner| (found.1.dot(*corner) - found.2).abs() <= tolerance::COPLANAR);
        // Nearly, but not quite, in the patch's plane: a patch of its own.
        let (patch, normal, offset) =
            if flat { found } else { (u32::MAX - index as u32, normal, offset) };
        triangles.push(Triangle {
            corners,
            normal,
            offset,
            patch,
            surface: face.surface,
            bounds: Bounds { min: a.min(b).min(c), max: a.max(b).max(c) },
        });
    }
    triangles
}
