//! Meshes of the core as the graphics library wants them.

use hapticbillard::renderer::Shape;
use hapticbillard::table::{ClothMarks, DisplayPart};
use three_d::*;

/// Half the side of endless ground [m].
const GROUND_M: f32 = 8.0;

/// What the cloth's shader paints: the line across with the D behind it, and six spots, of which
/// so many count.
pub fn marks(marks: &ClothMarks) -> (Vec2, ([Vec2; 6], i32)) {
    let first = marks.spots.first().copied().unwrap_or_default().as_vec2();
    let mut spots = [vec2(first.x, first.y); 6];
    for (place, spot) in spots.iter_mut().zip(&marks.spots) {
        *place = vec2(spot.x as f32, spot.y as f32);
    }
    let d_radius_m = marks.d_radius_m.unwrap_or(0.0);
    // No line is one that lies beyond every table.
    let line_x_m = marks.line_x_m.unwrap_or(-1e3);
    let count = marks.spots.len().min(spots.len()) as i32;
    (vec2(line_x_m as f32, d_radius_m as f32), (spots, count))
}

/// From a body along +x to one at `at` along a unit vector, longer and wider by these factors.
pub fn laid(at: Vec3, along: Vec3, length: f32, width: f32) -> Mat4 {
    let side = vec3(0.0, 0.0, 1.0).cross(along);
    let side = if side.magnitude2() < 1e-6 { vec3(0.0, 1.0, 0.0) } else { side.normalize() };
    let up = along.cross(side);
    Mat4::from_cols(
        (along * length).extend(0.0),
        (side * width).extend(0.0),
        (up * width).extend(0.0),
        at.extend(1.0),
    )
}

fn vectors(triples: &[[f32; 3]]) -> Vec<Vec3> {
    triples.iter().map(|triple| Vec3::from(*triple)).collect()
}

/// A part of a table.
pub fn part_mesh(part: &DisplayPart) -> CpuMesh {
    CpuMesh {
        positions: Positions::F32(vectors(&part.positions)),
        normals: Some(vectors(&part.normals)),
        uvs: Some(part.uvs.iter().map(|uv| vec2(uv[0], uv[1])).collect()),
        indices: Indices::U32(part.indices.clone()),
        ..CpuMesh::default()
    }
}

/// A shape, with its colours if it has some.
pub fn shape_mesh(shape: &Shape) -> CpuMesh {
    let byte = |channel: f32| (channel * 255.0).round() as u8;
    let colours = shape.colours.iter().map(|&[r, g, b]| Srgba::new(byte(r), byte(g), byte(b), 255));
    CpuMesh {
        positions: Positions::F32(vectors(&shape.positions)),
        normals: Some(vectors(&shape.normals)),
        colors: (!shape.colours.is_empty()).then(|| colours.collect()),
        indices: Indices::U32(shape.indices.clone()),
        ..CpuMesh::default()
    }
}

/// A square from -1 to 1.
pub fn square() -> CpuMesh {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    CpuMesh {
        positions: Positions::F32(corners.iter().map(|&(x, y)| vec3(x, y, 0.0)).collect()),
        normals: Some(vec![vec3(0.0, 0.0, 1.0); 4]),
        indices: Indices::U32(vec![0, 1, 2, 0, 2, 3]),
        ..CpuMesh::default()
    }
}

/// Level ground at a height [m].
pub fn ground(height: f32) -> CpuMesh {
    let mut mesh = square();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let places = corners.map(|(x, y)| vec3(x * GROUND_M, y * GROUND_M, height));
    mesh.uvs = Some(places.iter().map(|p| vec2(p.x, p.y)).collect());
    mesh.positions = Positions::F32(places.to_vec());
    mesh
}
