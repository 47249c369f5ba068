//! Flat parts of a table: a boundary and some points within, joined to triangles.
//!
//! The triangulation is Delaunay's under the constraint that every boundary edge stays (Chew
//! 1989), by the crate `spade`, whose predicates are exact. Boundary points keep their number, so
//! parts that share a boundary leave no crack.

use glam::DVec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::BTreeMap;

/// A point that may be added within a boundary, and how much room it wants [m].
pub(super) type Candidate = (DVec2, f64);

/// A boundary, filled: points (those of the boundary first) and triangles of their numbers.
#[derive(Debug, Clone)]
pub(super) struct Filled {
    pub points: Vec<DVec2>,
    pub triangles: Vec<[usize; 3]>,
}

/// Fills the inside of `boundary` with triangles. Of the candidates those are taken, in order,
/// that lie inside with room to boundary and other points. `None` if the boundary crosses itself.
pub(super) fn fill(boundary: &[DVec2], candidates: &[Candidate]) -> Option<Filled> {
    let mut points = boundary.to_vec();
    for &(candidate, room) in candidates {
        let has_room = inside(boundary, candidate)
            && edges(boundary).all(|(a, b)| distance_to_segment(candidate, a, b) > 0.45 * room)
            && points[boundary.len()..].iter().all(|p| p.distance(candidate) > 0.6 * room);
        if has_room {
            points.push(candidate);
        }
    }

    let mut delaunay = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut number = BTreeMap::new();
    let mut handles = Vec::with_capacity(points.len());
    for (index, point) in points.iter().enumerate() {
        let handle = delaunay.insert(Point2::new(point.x, point.y)).ok()?;
        number.entry(handle.index()).or_insert(index);
        handles.push(handle);
    }
    for i in 0..boundary.len() {
        let (a, b) = (handles[i], handles[(i + 1) % boundary.len()]);
        if a == b {
            continue;
        }
        if !delaunay.can_add_constraint(a, b) {
            return None;
        }
        delaunay.add_constraint(a, b);
    }

    let mut triangles = Vec::new();
    for face in delaunay.inner_faces() {
        let corners = face.vertices().map(|vertex| number[&vertex.fix().index()]);
        let middle = corners.iter().map(|&c| points[c]).sum::<DVec2>() / 3.0;
        if inside(boundary, middle) {
            triangles.push(corners);
        }
    }
    Some(Filled { points, triangles })
}

/// Points of a square grid over the bounds of `boundary`, at whole multiples of `spacing`.
pub(super) fn grid(boundary: &[DVec2], spacing: f64) -> Vec<Candidate> {
    let least = boundary.iter().copied().fold(DVec2::INFINITY, DVec2::min) / spacing;
    let most = boundary.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) / spacing;
    let range = |least: f64, most: f64| least.floor() as i64..=most.ceil() as i64;
    let mut points = Vec::new();
    for i in range(least.x, most.x) {
        for j in range(least.y, most.y) {
            points.push((DVec2::new(i as f64 * spacing, j as f64 * spacing), spacing));
        }
    }
    points
}

fn edges(boundary: &[DVec2]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    (0..boundary.len()).map(|i| (boundary[i], boundary[(i + 1) % boundary.len()]))
}

/// Whether `point` lies inside `boundary`, by the parity of crossings to its right.
fn inside(boundary: &[DVec2], point: DVec2) -> bool {
    let mut inside = false;
    for (a, b) in edges(boundary) {
        if (a.y > point.y) != (b.y > point.y) {
            let x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
            if point.x < x {
                inside = !inside;
            }
        }
    }
    inside
}

fn distance_to_segment(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let length_squared = along.length_squared();
    if length_squared == 0.0 {
        return point.distance(a);
    }
    let s = ((point - a).dot(along) / length_squared).clamp(0.0, 1.0);
    point.distance(a + along * s)
}
