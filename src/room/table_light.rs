//! Where the table lies in the light map: its upper side from above, apron and legs all round.

use super::builder::{Builder, Group, Vertex};
use super::finish::of_table;
use crate::table::{DisplayPart, Material, TableParameters};
use glam::{DVec2, DVec3, Vec3};

/// Texels per metre on the bed, on rails and cushions, and on apron and legs.
const BED: f64 = 72.0;
const RAILS: f64 = 64.0;
const APRON: f64 = 30.0;
const LEG_COLUMNS: u32 = 14;
const LEG_ROWS: u32 = 12;

/// A chart that is seen from above: `light = at + scale * (x, y)`, in texels once it has a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FromAbove {
    /// Its chart.
    pub(super) chart: u16,
    /// The texel of the table's middle, from the chart's corner.
    pub(super) middle: DVec2,
    /// Texels per metre.
    pub(super) scale: DVec2,
}

/// Where a table's light is.
#[derive(Debug, Clone)]
pub(super) struct TableLight {
    /// Its bed.
    pub bed: FromAbove,
    /// Rails, cushions, castings and sights.
    pub rails: FromAbove,
    /// Charts of the four sides of its apron.
    pub sides: Vec<u16>,
}

/// Adds a table.
pub(super) fn build(b: &mut Builder, table: &TableParameters, parts: &[DisplayPart]) -> TableLight {
    let half = 0.5 * DVec2::new(table.length_m, table.width_m);
    // The fronts of the pockets' lips lie a little beyond the noses.
    let bed = from_above(b, half + DVec2::splat(0.04), BED);
    let rails = from_above(b, DVec2::new(table.outer_x_m(), table.outer_y_m()), RAILS);
    let mut sides = Vec::new();
    for part in parts {
        match part.name {
            "bed" => upper_side(b, part, &bed),
            "cushions" | "rails" | "castings" | "diamonds" => upper_side(b, part, &rails),
            "pockets" => pockets(b, part),
            "apron" => sides = apron(b, part),
            "legs" => legs(b, part),
            // Marks are paint, and the floor is the room's.
            _ => {}
        }
    }
    TableLight { bed, rails, sides }
}

fn from_above(b: &mut Builder, half: DVec2, per_m: f64) -> FromAbove {
    let size = (half * 2.0 * per_m).ceil().as_uvec2() + 1;
    let chart = b.chart(size.x, size.y);
    let last = (size - 1).as_dvec2();
    FromAbove { chart, middle: 0.5 * last, scale: last / (2.0 * half) }
}

/// A vertex of a part, with its place in the light map.
fn vertex(part: &DisplayPart, index: u32, chart: u16, finish: u16, light: DVec2) -> Vertex {
    let of = |triples: &[[f32; 3]]| Vec3::from(triples[index as usize]).as_dvec3();
    let [u, v] = part.uvs[index as usize].map(f64::from);
    Vertex {
        position: of(&part.positions),
        normal: of(&part.normals),
        grain: DVec2::new(u, v),
        light,
        finish,
        chart,
    }
}

/// Adds triangles whose place in the light map follows from their corners.
fn add(
    b: &mut Builder,
    part: &DisplayPart,
    finish: u16,
    place: impl Fn([DVec3; 3]) -> Option<(u16, [DVec2; 3])>,
) {
    for triangle in part.indices.chunks_exact(3) {
        let numbers = [triangle[0], triangle[1], triangle[2]];
        let corners = numbers.map(|n| Vec3::from(part.positions[n as usize]).as_dvec3());
        let Some((chart, lights)) = place(corners) else { continue };
        let first = b.vertices.len() as u32;
        for (number, light) in numbers.into_iter().zip(lights) {
            b.vertices.push(vertex(part, number, chart, finish, light));
        }
        b.triangle([first, first + 1, first + 2]);
    }
}

fn upper_side(b: &mut Builder, part: &DisplayPart, place: &FromAbove) {
    b.begin(Group::TableTop);
    let finish = b.finish(of_table(part.material));
    add(b, part, finish, |corners| {
        // The backs of the pockets' lips lie beyond the bed.
        let last = 2.0 * place.middle;
        let lights =
            corners.map(|p| (place.middle + place.scale * p.truncate()).clamp(DVec2::ZERO, last));
        Some((place.chart, lights))
    });
}

/// Dark holes; a single texel is enough for all of them.
fn pockets(b: &mut Builder, part: &DisplayPart) {
    b.begin(Group::TableTop);
    let finish = b.finish(of_table(Material::Leather));
    let chart = b.chart(2, 2);
    add(b, part, finish, |_| Some((chart, [DVec2::ZERO; 3])));
}

/// Four sides and what is seen from below, each as a plane; returns the charts of the sides.
fn apron(b: &mut Builder, part: &DisplayPart) -> Vec<u16> {
    b.begin(Group::Standing);
    let finish = b.finish(of_table(part.material));
    let points: Vec<DVec3> = part.positions.iter().map(|p| Vec3::from(*p).as_dvec3()).collect();
    let least = points.iter().copied().fold(DVec3::MAX, DVec3::min);
    let most = points.iter().copied().fold(DVec3::MIN, DVec3::max);
    let plane = |p: DVec3, axis: usize| match axis {
        0 | 1 => DVec2::new(p.y, p.z),
        2 | 3 => DVec2::new(p.x, p.z),
        _ => DVec2::new(p.x, p.y),
    };
    let charts: Vec<(u16, DVec2, DVec2)> = (0..5)
        .map(|axis| {
            let (low, high) = (plane(least, axis), plane(most, axis));
            // The shadow below has no detail.
            let per_m = if axis == 4 { 0.4 * APRON } else { APRON };
            let size = ((high - low) * per_m).ceil().as_uvec2() + 1;
            (b.chart(size.x, size.y), low, (size - 1).as_dvec2() / (high - low))
        })
        .collect();
    add(b, part, finish, |corners| {
        let [p, q, r] = corners;
        let normal = (q - p).cross(r - p);
        let side = normal.abs();
        let axis = if side.z > side.x.max(side.y) {
            4
        } else if side.x > side.y {
            usize::from(normal.x < 0.0)
        } else {
            2 + usize::from(normal.y < 0.0)
        };
        let (chart, low, scale) = charts[axis];
        Some((chart, corners.map(|p| (plane(p, axis) - low) * scale)))
    });
    charts[..4].iter().map(|(chart, ..)| *chart).collect()
}

/// Four turned legs, each unrolled.
fn legs(b: &mut Builder, part: &DisplayPart) {
    b.begin(Group::Standing);
    let finish = b.finish(of_table(part.material));
    let points: Vec<DVec3> = part.positions.iter().map(|p| Vec3::from(*p).as_dvec3()).collect();
    let low = points.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    let high = points.iter().map(|p| p.z).fold(f64::MIN, f64::max);
    let quarter = |p: DVec3| usize::from(p.x < 0.0) + 2 * usize::from(p.y < 0.0);
    let axes: [DVec2; 4] = core::array::from_fn(|k| {
        let own = points.iter().filter(|p| quarter(**p) == k).map(|p| p.truncate());
        let (least, most) = own.fold((DVec2::MAX, DVec2::MIN), |(a, c), p| (a.min(p), c.max(p)));
        0.5 * (least + most)
    });
    let charts: [u16; 4] = core::array::from_fn(|_| b.chart(LEG_COLUMNS, LEG_ROWS));
    add(b, part, finish, |corners| {
        let leg = quarter(corners[0]);
        let mut turns = corners.map(|p| {
            let away = p.truncate() - axes[leg];
            libm::atan2(away.y, away.x) / core::f64::consts::TAU + 0.5
        });
        // A triangle over the seam goes on beyond it.
        let most = turns.iter().copied().fold(0.0, f64::max);
        turns.iter_mut().filter(|turn| **turn + 0.5 < most).for_each(|turn| *turn += 1.0);
        let lights = core::array::from_fn(|k| {
            let up = (corners[k].z - low) / (high - low);
            let columns = f64::from(LEG_COLUMNS - 1);
            // The first and the last column lie a step apart round the leg's seam.
            DVec2::new((turns[k] * columns).min(columns), up * f64::from(LEG_ROWS - 1))
        });
        Some((charts[leg], lights))
    });
}
