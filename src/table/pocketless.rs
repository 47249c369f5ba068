//! One quarter of a table without pockets: two cushions that meet in a mitre at the corner.

use super::parameters::TableParameters;
use super::plan::{Detail, ProfilePoint, nose_profile};
use super::quarter::{Body, Part, bed, cushion, frame};
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
    let grid_m = detail.grid_m;
    let long_lines = cushion(&mut body, Part::LongCushion, &long_middle, &corner, grid_m);
    let foot_lines = cushion(&mut body, Part::FootCushion, &foot_middle, &corner, grid_m);
    let mut edge = foot_lines[0].clone();
    edge.extend(long_lines[0].iter().rev().skip(1));
    bed(&mut body, detail, &edge, &[])?;
    let last = profile.len() - 1;
    let mut inner = long_lines[last].clone();
    inner.extend(foot_lines[last].iter().rev().skip(1));
    frame(&mut body, table, detail, &inner, &[])?;
    Some(body)
}
