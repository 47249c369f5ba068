//! Texels to surfaces: which point of which triangle a texel of the light map lies on.

use super::Surfaces;
use glam::{DVec2, DVec3, Vec3};

/// Samples of a texel along each axis.
const SUB: u32 = 2;

/// Where light is asked for: the points of a texel's quarters that lie on a surface.
#[derive(Debug, Clone, Default)]
pub(super) struct Texel {
    /// Its number, row by row.
    pub number: u32,
    /// Its chart.
    pub chart: u16,
    /// The points.
    pub points: Vec<Point>,
}

/// A point of a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub position: Vec3,
    /// The shaded normal.
    pub normal: Vec3,
    /// The triangle's own.
    pub flat: Vec3,
}

/// All texels that lie on a surface, by number.
pub(super) fn texels(surfaces: &Surfaces) -> Vec<Texel> {
    let [width, height] = surfaces.size;
    let across = width * SUB;
    let mut found: Vec<Option<(f64, u16, Point)>> = vec![None; (across * height * SUB) as usize];
    for (corners, _) in &surfaces.triangles {
        let corners = corners.map(|corner| &surfaces.vertices[corner as usize]);
        let [a, b, c] = corners.map(|corner| corner.light * f64::from(SUB));
        let area = (b - a).perp_dot(c - a);
        if area.abs() < 1e-9 {
            continue;
        }
        let [p, q, r] = corners.map(|corner| corner.position);
        let flat = (q - p).cross(r - p).normalize_or(DVec3::Z);
        let least = a.min(b).min(c).floor().max(DVec2::ZERO).as_uvec2();
        let most = a.max(b).max(c).ceil().as_uvec2();
        for y in least.y..most.y.min(height * SUB) {
            for x in least.x..most.x.min(across) {
                let at = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let second = (at - a).perp_dot(c - a) / area;
                let third = (b - a).perp_dot(at - a) / area;
                let first = 1.0 - second - third;
                if first.min(second).min(third) < -1e-6 {
                    continue;
                }
                let mix = |of: [DVec3; 3]| of[0] * first + of[1] * second + of[2] * third;
                let position = mix([p, q, r]);
                let normal = mix(corners.map(|corner| corner.normal)).normalize_or(flat);
                let slot = &mut found[(y * across + x) as usize];
                // Where a chart that is seen from above has two surfaces, the upper one is seen.
                if slot.as_ref().is_none_or(|(z, ..)| *z < position.z) {
                    let point = Point {
                        position: position.as_vec3(),
                        normal: normal.as_vec3(),
                        flat: flat.as_vec3(),
                    };
                    *slot = Some((position.z, corners[0].chart, point));
                }
            }
        }
    }
    let mut texels = Vec::new();
    for number in 0..width * height {
        let (x, y) = (number % width, number / width);
        let mut texel = Texel { number, ..Texel::default() };
        for k in 0..SUB * SUB {
            let at = (y * SUB + k / SUB) * across + x * SUB + k % SUB;
            if let Some((_, chart, point)) = &found[at as usize] {
                texel.chart = *chart;
                texel.points.push(*point);
            }
        }
        if !texel.points.is_empty() {
            texels.push(texel);
        }
    }
    texels
}
