//! What of a table is seen, from the same parameters as what balls touch.
//!
//! The visible body comes from the same plan as the physical one, only more finely divided; what
//! no ball touches (castings, diamonds, marks, apron, legs, floor) is added. Nothing here is kept:
//! a table that nobody looks at costs nothing.

mod furniture;

mod smooth;

use super::Table;
use super::parameters::TableParameters;
use super::plan::Detail;
use super::quarter::{Part, quarter};
use crate::mesh::Surface;
use glam::{DVec2, DVec3};

/// How finely a picture divides a table.
const DETAIL: Detail = Detail {
    nose_below: 5,
    nose_above: 8,
    pocket_front: 48,
    pocket_back: 48,
    lip: 8,
    pocket_rows: 3,
    bottom_rings: 2,
    edge: 6,
    grid_m: 0.1,
};

/// What a visible part is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Material {
    /// The cloth of the bed.
    Cloth,
    /// The cloth of the cushions.
    CushionCloth,
    /// The wood of the rails.
    Wood,
    /// The wood of apron and legs.
    DarkWood,
    /// The metal trim of the pockets.
    Casting,
    /// The inside of the pockets.
    Leather,
    /// The sights on the rails.
    Diamond,
    /// Lines and spots on the cloth.
    Line,
    /// The floor of the room.
    Floor,
}

/// A visible part: triangles of one material, anticlockwise seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct DisplayPart {
    /// Its name, unique within a table.
    pub name: &'static str,
    /// What it is made of.
    pub material: Material,
    /// Vertices [m].
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, smooth where the part is round.
    pub normals: Vec<[f32; 3]>,
    /// Coordinates of a texture [m]: one texture unit is a metre; u runs along the grain of wood.
    pub uvs: Vec<[f32; 2]>,
    /// Triangles as triples of vertex numbers.
    pub indices: Vec<u32>,
}

/// A triangle of a part, with its texture coordinates [m].
#[derive(Debug, Clone, Copy)]
struct DisplayTriangle {
    corners: [DVec3; 3],
    uvs: [DVec2; 3],
}

impl DisplayTriangle {
    /// A triangle whose texture is laid on from its main direction, u along the grain: x on top,
    /// horizontal on the sides.
    fn laid_on(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).abs();
        let lay = |p: DVec3| {
            if normal.z >= normal.x.max(normal.y) {
                DVec2::new(p.x, p.y)
            } else if normal.x > normal.y {
                DVec2::new(p.y, p.z)
            } else {
                DVec2::new(p.x, p.z)
            }
        };
        DisplayTriangle { corners, uvs: corners.map(lay) }
    }
}

impl Table {
    /// The visible parts of a pool table; of any other table its mesh, made of what its surfaces
    /// say.
    pub fn display(&self) -> Vec<DisplayPart> {
        let Some(table) = &self.parameters else { return self.bare_mesh() };
        let mut parts = body(table);
        parts.extend(furniture::parts(table));
        parts.into_iter().filter(|part| !part.indices.is_empty()).collect()
    }

    fn bare_mesh(&self) -> Vec<DisplayPart> {
        let kinds: [SurfaceKind; 5] = [
            ("ground", Material::Cloth, |surface| surface == Surface::Cloth),
            ("wood", Material::Wood, |surface| surface == Surface::Wood),
            ("obstacles", Material::Casting, |surface| {
                matches!(surface, Surface::Obstacle | Surface::Cushion(_))
            }),
            ("holes", Material::Leather, |surface| {
                matches!(surface, Surface::Pocket(_) | Surface::PocketBottom(_))
            }),
            ("floor", Material::Floor, |surface| surface == Surface::Floor),
        ];
        kinds
            .into_iter()
            .map(|(name, material, belongs)| {
                let triangles: Vec<DisplayTriangle> = (0..self.mesh.faces.len())
                    .filter(|index| belongs(self.mesh.faces[*index].surface))
                    .map(|index| DisplayTriangle::laid_on(self.mesh.corners(index)))
                    .collect();
                smooth::part(name, material, &triangles)
            })
            .filter(|part| !part.indices.is_empty())
            .collect()
    }
}

/// Name, material, and which surfaces of a mesh it takes.
type SurfaceKind = (&'static str, Material, fn(Surface) -> bool);

/// Name, material, and which parts of the body it takes.
type Kind = (&'static str, Material, fn(Part) -> bool);

/// The parts that balls touch, all four quarters of them.
fn body(table: &TableParameters) -> Vec<DisplayPart> {
    // A table that exists has a plan that closes; its finer division closes too.
    let Some(quarter) = quarter(table, &DETAIL) else { return Vec::new() };
    let noses = 0.5 * DVec2::new(table.length_m, table.width_m);
    let kinds: [Kind; 4] = [
        ("bed", Material::Cloth, |part| matches!(part, Part::Bed | Part::Lip(_))),
        ("cushions", Material::CushionCloth, |part| {
            matches!(part, Part::LongCushion | Part::FootCushion)
        }),
        ("rails", Material::Wood, |part| matches!(part, Part::RailTop | Part::RailSide)),
        ("pockets", Material::Leather, |part| {
            matches!(part, Part::Wall(_) | Part::Back(_) | Part::Bottom(_))
        }),
    ];
    kinds
        .map(|(name, material, belongs)| {
            let mut triangles = Vec::new();
            for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
                for triangle in quarter.triangles.iter().filter(|t| belongs(t.part)) {
                    let mut corners = triangle.corners.map(|p| p * DVec3::new(sx, sy, 1.0));
                    if sx * sy < 0.0 {
                        corners.swap(1, 2);
                    }
                    let mut laid = DisplayTriangle::laid_on(corners);
                    if triangle.part == Part::RailTop && runs_across(&corners, noses) {
                        laid.uvs = laid.uvs.map(|uv| DVec2::new(uv.y, uv.x));
                    }
                    triangles.push(laid);
                }
            }
            smooth::part(name, material, &triangles)
        })
        .to_vec()
}

/// Metal trims of the pockets, as bare triangles [m].
pub(super) fn castings(table: &TableParameters) -> Vec<[DVec3; 3]> {
    furniture::castings(table).into_iter().map(|triangle| triangle.corners).collect()
}

/// Whether a triangle of the rails' top belongs to a short rail, whose grain runs along y.
fn runs_across(corners: &[DVec3; 3], noses: DVec2) -> bool {
    let middle = (corners[0] + corners[1] + corners[2]).truncate().abs() / 3.0 - noses;
    middle.x > middle.y
}
