//! One quarter of a table without pockets: two cushions that meet in a mitre at the corner.

use super::parameters::TableParameters;
use super::plan::{Detail, ProfilePoint, nose_profile};
use super::quarter::{Body, Part, bed, frame, sweep};
use glam::{DVec2, DVec3};

/// Builds the quarter x ≥ 0, y ≥ 0; `None` if its lines cross.
pub(super) fn quarter(table: &TableParameters, detail: &Detail) -> Option<Body> {
    let noses = 0.5 * DVec2::new(table.length_m, table.width_m);
    let (mut profile, ..) = nose_profile(table, detail);
    profile.push(ProfilePoint { v: table.cushion_width_m, z: table.rail_height_m });
    let line = |place: &dyn Fn(f64) -> DVec2| -> Vec<DVec3> {
        profile.iter().map(|p| place(p.v).extend(p.z)).collect()
    };
    let long_middle = line(&|v| DVec2::new(0.0, noses.y + v));
    let foot_middle = line(&|v| DVec2::new(noses.x + v, 0.0));
    let corner = line(&|v| noses + DVec2::splat(v));

    let mut body = Body::default();
    let lines = |start: &[DVec3]| -> Vec<Vec<DVec3>> {
        let count = (start[0].distance(corner[0]) / detail.grid_m).round().max(1.0) as usize;
        start.iter().zip(&corner).map(|(a, b)| straight(*a, *b, count)).collect()
    };
    let (long_lines, foot_lines) = (lines(&long_middle), lines(&foot_middle));
    sweep(&mut body, Part::LongCushion, &long_lines);
    sweep(&mut body, Part::FootCushion, &foot_lines);
    let mut edge = foot_lines[0].clone();
    edge.extend(long_lines[0].iter().rev().skip(1));
    bed(&mut body, detail, &edge, &[])?;
    let last = profile.len() - 1;
    let mut inner = long_lines[last].clone();
    inner.extend(foot_lines[last].iter().rev().skip(1));
    frame(&mut body, table, detail, &inner, &[])?;
    Some(body)
}

/// From `a` to `b` in `count` steps, both ends included. Points of a line along an axis are exactly
/// in line: a hair's breadth beside it a flat part would get faces without area.
fn straight(a: DVec3, b: DVec3, count: usize) -> Vec<DVec3> {
    let mut points: Vec<DVec3> =
        (0..count).map(|i| a + (b - a) * (i as f64 / count as f64)).collect();
    points.push(b);
    points
}
