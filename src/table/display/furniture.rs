//! What no ball touches: castings, diamonds, marks, apron, legs and the floor.

use super::{DisplayPart, DisplayTriangle, Material, smooth};
use crate::table::marks::{HALF_LINE_M, SPOT_RADIUS_M};
use crate::table::parameters::{PocketParameters, TableParameters};
use crate::table::plan::{Detail, corner_centre, direction, rim_radius, side_centre};
use crate::table::quarter::outline;
use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use glam::{DVec2, DVec3};

/// How far marks lie above what they are on [m]: no ball notices, every depth buffer does.
const MARK_LIFT_M: f64 = 0.0005;
/// Chords of a leg, a spot and a quarter of the apron's corners.
const ROUND_CHORDS: usize = 28;

/// All of it.
pub(super) fn parts(table: &TableParameters) -> Vec<DisplayPart> {
    let mut parts = vec![
        smooth::part("castings", Material::Casting, &castings(table)),
        smooth::part("diamonds", Material::Diamond, &diamonds(table)),
        smooth::part("marks", Material::Line, &marks(table)),
        smooth::part("apron", Material::DarkWood, &apron(table)),
        smooth::part("legs", Material::DarkWood, &legs(table)),
        smooth::part("floor", Material::Floor, &floor(table)),
    ];
    // A snooker table has no diamonds.
    parts.retain(|part| !part.indices.is_empty());
    parts
}

/// Adds the strip between two lines, seen from the side where `upper` lies left of `lower`.
fn strip(triangles: &mut Vec<DisplayTriangle>, lower: &[DVec3], upper: &[DVec3]) {
    for (low, high) in lower.windows(2).zip(upper.windows(2)) {
        for corners in [[low[0], low[1], high[1]], [low[0], high[1], high[0]]] {
            triangles.push(DisplayTriangle::laid_on(corners));
        }
    }
}

/// Adds a fan round `middle`, seen from where `rim` runs anticlockwise.
fn fan(triangles: &mut Vec<DisplayTriangle>, middle: DVec3, rim: &[DVec3]) {
    triangles
        .extend(rim.windows(2).map(|pair| DisplayTriangle::laid_on([middle, pair[0], pair[1]])));
}

/// A triangle and its mirror images in the four quarters.
fn mirrored(quarter: &[DisplayTriangle]) -> Vec<DisplayTriangle> {
    let mut triangles = Vec::new();
    for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        triangles.extend(quarter.iter().map(|triangle| {
            let mut corners = triangle.corners.map(|p| p * DVec3::new(sx, sy, 1.0));
            if sx * sy < 0.0 {
                corners.swap(1, 2);
            }
            DisplayTriangle::laid_on(corners)
        }));
    }
    triangles
}

/// Metal trims round the back of the pockets: a plate on the rail with a collar into the hole.
pub(super) fn castings(table: &TableParameters) -> Vec<DisplayTriangle> {
    let mut triangles = Vec::new();
    let Some([corner, side]) = table.pockets() else { return triangles };
    casting(&mut triangles, table, corner, corner_centre(table, corner), FRAC_PI_4, -1.0);
    casting(&mut triangles, table, side, side_centre(table, side), FRAC_PI_2, 0.0);
    mirrored(&triangles)
}

/// A casting, from `first` times its half angle to −1 or 1 times it about the heading.
fn casting(
    triangles: &mut Vec<DisplayTriangle>,
    table: &TableParameters,
    pocket: &PocketParameters,
    centre: DVec2,
    heading: f64,
    first: f64,
) {
    let (height, width, collar) = (0.0015, 0.028, 0.012);
    let rim = rim_radius(table, pocket);
    let wood = 0.5 * DVec2::new(table.length_m, table.width_m)
        + DVec2::splat(table.cushion_width_m + 0.001);
    let edge = DVec2::new(table.outer_x_m(), table.outer_y_m())
        - DVec2::splat(table.rail_edge_radius_m + 0.003);
    // Seen from the hole, the plate ends where its inner or outer corner would leave the wood.
    let fits = |angle: f64| {
        [rim, rim + width].iter().all(|radius| {
            let p = centre + *radius * direction(heading + angle);
            p.x > wood.x || p.y > wood.y
        })
    };
    let mut half_angle = 0.0;
    while half_angle < PI && fits(-half_angle) && fits(if first == 0.0 { 0.0 } else { half_angle })
    {
        half_angle += 0.01;
    }
    let count = ROUND_CHORDS as f64;
    let side = if first == 0.0 { -1.0 } else { 1.0 };
    let angles: Vec<f64> = (0..=ROUND_CHORDS)
        .map(|k| {
            let s = k as f64 / count;
            half_angle * (first + (side - first) * s)
        })
        .collect();
    let top = table.rail_height_m;
    let rows: [(f64, f64); 5] = [
        (rim - 0.001, top - collar),
        (rim - 0.001, top + height - 0.0005),
        (rim, top + height),
        (rim + width - 0.001, top + height),
        (rim + width, top),
    ];
    let lines = rows.map(|(radius, z)| -> Vec<DVec3> {
        angles
            .iter()
            .map(|angle| {
                let along = direction(heading + angle);
                // Plates stay on the flat part of the rail.
                let room = (edge - centre) / along.max(DVec2::splat(1e-6));
                let radius = radius.min(room.x.min(room.y).max(rim));
                (centre + radius * along).extend(z)
            })
            .collect()
    });
    for pair in lines.windows(2) {
        // Angles rise on the corner's casting and fall on the side's half.
        if first == 0.0 {
            strip(triangles, &pair[0], &pair[1]);
        } else {
            strip(triangles, &pair[1], &pair[0]);
        }
    }
}

/// The sights.
fn diamonds(table: &TableParameters) -> Vec<DisplayTriangle> {
    let mut triangles = Vec::new();
    let z = table.rail_height_m + MARK_LIFT_M;
    let (half_length, half_width) = (0.5 * table.diamond_length_m, 0.5 * table.diamond_width_m);
    let mut add = |centre: DVec2, across: DVec2| {
        let along = across.perp() * half_width;
        let across = across * half_length;
        let rim = [across, along, -across, -along, across].map(|p| (centre + p).extend(z));
        fan(&mut triangles, centre.extend(z), &rim);
    };
    table.sights().into_iter().for_each(|(centre, across)| add(centre, across));
    triangles
}

/// The line across the bed, the D, and the spots, as far as the table has them.
fn marks(table: &TableParameters) -> Vec<DisplayTriangle> {
    let marks = table.cloth_marks();
    let y = 0.5 * table.width_m;
    let across = |x: f64| [-y, 0.0, y].map(|y| DVec3::new(x, y, MARK_LIFT_M));
    let mut triangles = Vec::new();
    if let Some(x) = marks.line_x_m {
        strip(&mut triangles, &across(x + HALF_LINE_M), &across(x - HALF_LINE_M));
    }
    if let (Some(x), Some(radius)) = (marks.line_x_m, marks.d_radius_m) {
        let arc = |radius: f64| half_circle(DVec2::new(x, 0.0), radius);
        strip(&mut triangles, &arc(radius + HALF_LINE_M), &arc(radius - HALF_LINE_M));
    }
    for spot in marks.spots {
        // Spots lie on the line.
        let lift = 1.5 * MARK_LIFT_M;
        fan(&mut triangles, spot.extend(lift), &circle(spot, SPOT_RADIUS_M, lift));
    }
    triangles
}

/// A half circle towards −x, anticlockwise from above.
fn half_circle(centre: DVec2, radius: f64) -> Vec<DVec3> {
    (0..=ROUND_CHORDS)
        .map(|k| {
            let angle = PI * (0.5 + k as f64 / ROUND_CHORDS as f64);
            (centre + radius * direction(angle)).extend(MARK_LIFT_M)
        })
        .collect()
}

/// A closed circle, anticlockwise from above.
fn circle(centre: DVec2, radius: f64, z: f64) -> Vec<DVec3> {
    (0..=ROUND_CHORDS)
        .map(|k| {
            let angle = 2.0 * PI * (k % ROUND_CHORDS) as f64 / ROUND_CHORDS as f64;
            (centre + radius * direction(angle)).extend(z)
        })
        .collect()
}

/// The panel under the rails, drawn in towards the bottom.
fn apron(table: &TableParameters) -> Vec<DisplayTriangle> {
    let detail = Detail {
        nose_below: 1,
        nose_above: 1,
        pocket_front: 1,
        pocket_back: 1,
        lip: 1,
        pocket_rows: 1,
        bottom_rings: 1,
        edge: 6,
        grid_m: 0.2,
    };
    let lines = [
        (0.0, -0.055),
        (0.012, -0.056),
        (0.012, -0.066),
        (0.018, -0.07),
        (0.021, -0.16),
        (0.045, -0.225),
        (0.05, -0.24),
        (0.085, -0.24),
    ]
    .map(|(inset, z)| outline(table, &detail, inset, z));
    let mut quarter = Vec::new();
    for pair in lines.windows(2) {
        strip(&mut quarter, &pair[1], &pair[0]);
    }
    let underside: Vec<DVec3> = lines[lines.len() - 1].iter().rev().copied().collect();
    let z = underside[0].z;
    fan(&mut quarter, DVec3::new(0.0, 0.0, z), &underside);
    mirrored(&quarter)
}

/// Four turned legs.
fn legs(table: &TableParameters) -> Vec<DisplayTriangle> {
    let floor = -table.bed_height_m;
    let top = -0.235;
    let profile: [(f64, f64); 11] = [
        (0.0, 0.055),
        (0.03, 0.055),
        (0.05, 0.047),
        (0.10, 0.045),
        (0.13, 0.062),
        (0.55, 0.078),
        (0.82, 0.072),
        (0.86, 0.056),
        (0.89, 0.06),
        (0.93, 0.085),
        (1.0, 0.085),
    ];
    let place = DVec2::new(table.outer_x_m() - 0.32, table.outer_y_m() - 0.24);
    let mut quarter = Vec::new();
    let lines = profile.map(|(share, radius)| circle(place, radius, floor + share * (top - floor)));
    for pair in lines.windows(2) {
        strip(&mut quarter, &pair[0], &pair[1]);
    }
    mirrored(&quarter)
}

/// A floor that reaches three metres beyond the table.
fn floor(table: &TableParameters) -> Vec<DisplayTriangle> {
    let half = DVec2::new(table.outer_x_m(), table.outer_y_m()) + DVec2::splat(3.0);
    let z = -table.bed_height_m;
    let mut triangles = Vec::new();
    let line = |y: f64| [DVec3::new(-half.x, y, z), DVec3::new(half.x, y, z)];
    strip(&mut triangles, &line(-half.y), &line(half.y));
    triangles
}
