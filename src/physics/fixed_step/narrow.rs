//! The exact tests of a ball against a face: nearest point, and first contact along a straight
//! path.
//!
//! Both have two stages (paper, section 2.1): first the distance to the face's plane, which rejects
//! most, then the exact geometry. Faces are solid from both sides; a ball is on the side where its
//! centre is.

use super::spatial_hash::Bounds;
use crate::mesh::Surface;
use crate::physics::roots;
use crate::units::Seconds;
use glam::DVec3;

/// A face with what the tests need.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    /// Its corners [m].
    pub corners: [DVec3; 3],
    /// Unit normal of the flat patch that it belongs to.
    pub normal: DVec3,
    /// Distance of that plane from the origin along the normal [m].
    pub offset: f64,
    /// The patch: all faces in one plane share its number.
    pub patch: u32,
    /// What it is made of.
    pub surface: Surface,
    /// Box around it.
    pub bounds: Bounds,
}

/// What is nearest to a ball's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Near {
    /// Unit vector from the surface to the centre.
    pub normal: DVec3,
    /// Distance of the centre [m].
    pub distance_m: f64,
    /// Whether the nearest point lies inside the face, not on an edge or corner.
    pub inside: bool,
}

/// The nearest point of `face`, if it is within `reach_m` of `centre` (the paper's `iNormal`).
pub fn nearest(face: &Triangle, centre: DVec3, reach_m: f64) -> Option<Near> {
    let height = face.normal.dot(centre) - face.offset;
    if height.abs() > reach_m {
        return None;
    }
    let side = if height < 0.0 { -face.normal } else { face.normal };
    if inside(face, centre) {
        return Some(Near { normal: side, distance_m: height.abs(), inside: true });
    }

    let [a, b, c] = face.corners;
    let mut best = DVec3::INFINITY;
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let offset = centre - on_edge(from, to, centre);
        if offset.length_squared() < best.length_squared() {
            best = offset;
        }
    }
    let distance_m = best.length();
    let normal = if distance_m > 0.0 { best / distance_m } else { side };
    (distance_m <= reach_m).then_some(Near { normal, distance_m, inside: false })
}

/// First moment in `[0, horizon]` at which a ball that moves straight touches `face` and closes
/// faster than `slowest`; with the normal there.
pub fn first_contact(
    face: &Triangle,
    centre: DVec3,
    velocity: DVec3,
    radius_m: f64,
    horizon: Seconds,
    slowest: f64,
) -> Option<(Seconds, DVec3)> {
    let height = face.normal.dot(centre) - face.offset;
    let (normal, height) =
        if height < 0.0 { (-face.normal, -height) } else { (face.normal, height) };
    let speed = velocity.dot(normal);
    if height >= radius_m && height + speed * horizon >= radius_m {
        return None;
    }

    // The face itself comes before its edges unless the centre passes beside it.
    if speed < -slowest {
        let time = ((radius_m - height) / speed).max(0.0);
        if time <= horizon && inside(face, centre + velocity * time) {
            return Some((time, normal));
        }
    }

    let [a, b, c] = face.corners;
    let mut first: Option<(Seconds, DVec3)> = None;
    let mut earlier = |time: Seconds, from: DVec3| {
        if first.is_none_or(|(best, _)| time < best) {
            first = Some((time, (centre + velocity * time - from).normalize_or(normal)));
        }
    };
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let edge = to - from;
        let length = edge.length();
        if length == 0.0 {
            continue;
        }
        let along = edge / length;
        let across = |v: DVec3| v - along * v.dot(along);
        let offset = across(centre - from);
        if let Some(time) = roots::straight(offset, across(velocity), radius_m, horizon, slowest) {
            let place = (centre + velocity * time - from).dot(along);
            if 0.0 <= place && place <= length {
                earlier(time, from + along * place);
            }
        }
        if let Some(time) = roots::straight(centre - from, velocity, radius_m, horizon, slowest) {
            earlier(time, from);
        }
    }
    first
}

/// Whether the foot of the perpendicular from `point` lies in the face, its border included.
fn inside(face: &Triangle, point: DVec3) -> bool {
    let [a, b, c] = face.corners;
    let side = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(face.normal);
    let (ab, bc, ca) = (side(a, b), side(b, c), side(c, a));
    // The patch's normal may point to either side of the corners' order.
    (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0)
}

fn on_edge(from: DVec3, to: DVec3, point: DVec3) -> DVec3 {
    let edge = to - from;
    let square = edge.length_squared();
    if square == 0.0 {
        return from;
    }
    from + edge * ((point - from).dot(edge) / square).clamp(0.0, 1.0)
}

/// Whether a triangle and a box have a point in common, or nearly: separating axes (Akenine-Möller
/// 2001), widened by `slack_m`.
pub fn triangle_meets_box(corners: &[DVec3; 3], cell: &Bounds, slack_m: f64) -> bool {
    let centre = 0.5 * (cell.min + cell.max);
    let half = 0.5 * (cell.max - cell.min) + slack_m;
    let [a, b, c] = corners.map(|corner| corner - centre);
    let separated = |axis: DVec3| {
        let reach = half.dot(axis.abs());
        let (p, q, r) = (a.dot(axis), b.dot(axis), c.dot(axis));
        p.min(q).min(r) > reach || p.max(q).max(r) < -reach
    };
    let edges = [b - a, c - b, a - c];
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    !(axes.into_iter().any(separated)
        || separated(edges[0].cross(edges[1]))
        || edges.iter().any(|edge| axes.iter().any(|axis| separated(axis.cross(*edge)))))
}
