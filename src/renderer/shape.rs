//! Shapes that are computed: the sphere of a ball and the cue.

use crate::cue::{BUTT_RADIUS_M, CUE_LENGTH_M, SHAFT_RADIUS_M, TIP_RADIUS_M};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Triangles, anticlockwise seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shape {
    /// Vertices [m].
    pub positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// Colours in sRGB, 0 to 1; empty if whoever draws has one.
    pub colours: Vec<[f32; 3]>,
    /// Triangles as triples of vertex numbers.
    pub indices: Vec<u32>,
}

/// A unit sphere: an icosahedron whose triangles are divided into four, `level` times.
///
/// Levels 2, 3 and 4 have 320, 1280 and 5120 triangles, as in the paper. There are no texture
/// coordinates, and so no seam: what is painted on a ball follows from the direction alone.
pub fn sphere(level: u32) -> Shape {
    let g = 0.5 * (1.0 + 5.0f64.sqrt());
    let mut corners: Vec<DVec3> = [(-1.0, g), (1.0, g), (-1.0, -g), (1.0, -g)]
        .iter()
        .flat_map(|&(a, b)| [DVec3::new(a, b, 0.0), DVec3::new(0.0, a, b), DVec3::new(b, 0.0, a)])
        .map(DVec3::normalize)
        .collect();
    // The faces are the triples that are an edge's length apart from each other.
    let edge = 2.0 / (1.0 + g * g).sqrt();
    let near = |a: DVec3, b: DVec3| (a.distance(b) - edge).abs() < 1e-9;
    let mut faces = Vec::new();
    for a in 0..12u32 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|i| corners[i as usize]);
                if near(p, q) && near(q, r) && near(r, p) {
                    let is_outward = (q - p).cross(r - p).dot(p) > 0.0;
                    faces.push(if is_outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..level {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                corners.push((corners[a as usize] + corners[b as usize]).normalize());
                corners.len() as u32 - 1
            })
        };
        faces = faces
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            })
            .collect();
    }
    let positions: Vec<[f32; 3]> = corners.iter().map(|p| p.as_vec3().to_array()).collect();
    Shape {
        normals: positions.clone(),
        positions,
        colours: Vec::new(),
        indices: faces.into_iter().flatten().collect(),
    }
}

const LEATHER: [f32; 3] = [0.16, 0.33, 0.47];
const FERRULE: [f32; 3] = [0.94, 0.92, 0.86];
const MAPLE: [f32; 3] = [0.83, 0.65, 0.42];
const COLLAR: [f32; 3] = [0.75, 0.75, 0.77];
const EBONY: [f32; 3] = [0.13, 0.07, 0.05];
const WRAP: [f32; 3] = [0.30, 0.28, 0.26];
const RUBBER: [f32; 3] = [0.04, 0.04, 0.04];

/// A cue along +x: the middle of its tip sphere at the origin, the butt at −x.
pub fn cue_shape() -> Shape {
    let taper = |back: f64| {
        let s = ((back - 0.02) / (CUE_LENGTH_M - 0.02)).clamp(0.0, 1.0);
        SHAFT_RADIUS_M + (BUTT_RADIUS_M - SHAFT_RADIUS_M) * libm::pow(s, 1.25)
    };
    // The cap of the tip, then rings down to the butt: distance behind the tip's middle, radius.
    let cap_angle = libm::asin(SHAFT_RADIUS_M / TIP_RADIUS_M);
    let mut rings: Vec<(f64, f64, [f32; 3])> = (0..=6)
        .map(|k| {
            let (sin, cos) = libm::sincos(cap_angle * f64::from(k) / 6.0);
            (-TIP_RADIUS_M * cos, TIP_RADIUS_M * sin, LEATHER)
        })
        .collect();
    let start = rings[6].0;
    let parts: [(f64, f64, [f32; 3]); 8] = [
        (0.0, 0.006, LEATHER),
        (0.006, 0.026, FERRULE),
        (0.026, 0.72, MAPLE),
        (0.72, 0.735, COLLAR),
        (0.735, 0.98, EBONY),
        (0.98, 1.28, WRAP),
        (1.28, 1.445, EBONY),
        (1.445, CUE_LENGTH_M, RUBBER),
    ];
    for (from, to, colour) in parts {
        // Both ends, so that colours do not run into each other; long parts bend a little.
        for k in 0..=4 {
            let back = from + (to - from) * f64::from(k) / 4.0;
            rings.push((start + back, taper(back), colour));
        }
    }
    rings.push((start + CUE_LENGTH_M, 0.0, RUBBER));

    turned(&rings)
}

/// A body of revolution about x from rings: distance behind the origin, radius, colour.
fn turned(rings: &[(f64, f64, [f32; 3])]) -> Shape {
    const CHORDS: u32 = 20;
    let mut shape = Shape::default();
    let slopes: Vec<DVec2> = (0..rings.len())
        .map(|i| {
            let (before, after) = (rings[i.saturating_sub(1)], rings[(i + 1).min(rings.len() - 1)]);
            DVec2::new(after.0 - before.0, after.1 - before.1).normalize_or(DVec2::X)
        })
        .collect();
    for ((back, radius, colour), slope) in rings.iter().zip(&slopes) {
        for k in 0..=CHORDS {
            let angle = f64::from(k) * 2.0 * core::f64::consts::PI / f64::from(CHORDS);
            let (sin, cos) = libm::sincos(angle);
            let round = DVec3::new(0.0, cos, sin);
            let normal = (DVec3::X * slope.y + round * slope.x).normalize_or(DVec3::X);
            shape.positions.push((DVec3::X * -back + round * *radius).as_vec3().to_array());
            shape.normals.push(normal.as_vec3().to_array());
            shape.colours.push(*colour);
        }
    }
    for ring in 0..rings.len() as u32 - 1 {
        for k in 0..CHORDS {
            let a = ring * (CHORDS + 1) + k;
            let b = a + CHORDS + 1;
            shape.indices.extend([a, b, b + 1, a, b + 1, a + 1]);
        }
    }
    shape
}

const STEEL: [f32; 3] = [0.55, 0.57, 0.60];
const BODY: [f32; 3] = [0.10, 0.11, 0.13];
const GRIP: [f32; 3] = [0.20, 0.22, 0.26];
const BUTTON: [f32; 3] = [0.62, 0.64, 0.68];

/// A stylus along +x without its tip, whose middle is the origin [m].
pub fn stylus_shape() -> Shape {
    // Distance behind the tip and radius, each part from its begin to its end.
    let parts: [(f64, f64, f64, f64, [f32; 3]); 6] = [
        (0.001, 0.0011, 0.024, 0.0014, STEEL),
        (0.024, 0.0014, 0.034, 0.0032, BODY),
        (0.034, 0.0032, 0.056, 0.0036, GRIP),
        (0.056, 0.0041, 0.061, 0.0041, BUTTON),
        (0.061, 0.0036, 0.108, 0.0030, BODY),
        (0.108, 0.0030, 0.111, 0.0, BODY),
    ];
    let ends =
        parts.iter().flat_map(|&(from, r, to, s, colour)| [(from, r, colour), (to, s, colour)]);
    turned(&std::iter::once((0.001, 0.0, STEEL)).chain(ends).collect::<Vec<_>>())
}

/// A rod along +x from 0 to 1 with radius 1, closed at both ends.
pub fn cylinder() -> Shape {
    let white = [1.0; 3];
    Shape {
        colours: Vec::new(),
        ..turned(&[(-1.0, 0.0, white), (-1.0, 1.0, white), (0.0, 1.0, white), (0.0, 0.0, white)])
    }
}

/// A cone along +x with its point at 1, and radius 1 at 0.
pub fn cone() -> Shape {
    let white = [1.0; 3];
    Shape {
        colours: Vec::new(),
        ..turned(&[(-1.0, 0.0, white), (0.0, 1.0, white), (0.0, 0.0, white)])
    }
}
