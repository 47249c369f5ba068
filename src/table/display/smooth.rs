//! Triangles to vertices with normals: smooth across round edges, sharp across real ones.

use super::{DisplayPart, DisplayTriangle, Material};
use glam::DVec3;
use std::collections::BTreeMap;

/// Edges up to this cosine of the angle between their faces look round (40°).
const CREASE_COS: f64 = 0.766;

/// Joins triangles to a part. A corner's normal is the sum of the normals, weighted by area, of
/// all triangles at its point that turn away less than the crease angle.
pub(super) fn part(
    name: &'static str,
    material: Material,
    triangles: &[DisplayTriangle],
) -> DisplayPart {
    let scaled: Vec<DVec3> = triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = triangle.corners;
            (b - a).cross(c - a)
        })
        .collect();
    let mut around: BTreeMap<[u64; 3], Vec<usize>> = BTreeMap::new();
    for (index, triangle) in triangles.iter().enumerate() {
        for corner in triangle.corners {
            around.entry(key(corner)).or_default().push(index);
        }
    }

    let mut part = DisplayPart {
        name,
        material,
        positions: Vec::new(),
        normals: Vec::new(),
        uvs: Vec::new(),
        indices: Vec::new(),
    };
    let mut numbers = BTreeMap::new();
    for (triangle, own) in triangles.iter().zip(&scaled) {
        let flat = own.normalize_or(DVec3::Z);
        for (corner, uv) in triangle.corners.iter().zip(triangle.uvs) {
            let normal = around[&key(*corner)]
                .iter()
                .map(|&other| scaled[other])
                .filter(|other| other.normalize_or_zero().dot(flat) > CREASE_COS)
                .sum::<DVec3>()
                .normalize_or(flat)
                .as_vec3()
                .to_array();
            let position = corner.as_vec3().to_array();
            let uv = uv.as_vec2().to_array();
            let bits = (position.map(f32::to_bits), normal.map(f32::to_bits), uv.map(f32::to_bits));
            let number = *numbers.entry(bits).or_insert_with(|| {
                part.positions.push(position);
                part.normals.push(normal);
                part.uvs.push(uv);
                part.positions.len() as u32 - 1
            });
            part.indices.push(number);
        }
    }
    part
}

/// A point as a key; −0 and 0 are the same.
fn key(p: DVec3) -> [u64; 3] {
    p.to_array().map(|value| (value + 0.0).to_bits())
}
