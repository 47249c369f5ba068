//! The lamps over a table, in `f32` as graphics cards want them.

use crate::room;

/// Height of the lamps over the cloth [m].
pub const LAMP_HEIGHT_M: f32 = room::LAMP_HEIGHT_M as f32;
/// How far they hang from each other along the table [m].
pub const LAMP_APART_M: f32 = room::LAMP_PITCH_M as f32;

/// The middles of the lamps' shades [m].
pub const LAMPS: [[f32; 3]; 3] = [
    [-LAMP_APART_M, 0.0, LAMP_HEIGHT_M],
    [0.0, 0.0, LAMP_HEIGHT_M],
    [LAMP_APART_M, 0.0, LAMP_HEIGHT_M],
];

/// A corner of the body of darkness behind a rod.
pub type Corner = [f32; 3];

/// How far shadows reach from a lamp [m].
const REACH_M: f32 = 4.0;

/// The body of darkness that a rod with round ends throws behind it: its outline as a lamp sees it,
/// first near, then far from the lamp, in the same order; it ends at the height `lowest` [m]. None
/// if the lamp looks along the rod.
pub fn rod_shadow(lamp: [f32; 3], ends: [([f32; 3], f32); 2], lowest: f32) -> Option<[Corner; 8]> {
    use glam::Vec3;
    let lamp = Vec3::from(lamp);
    let [(a, a_radius), (b, b_radius)] = ends.map(|(at, radius)| (Vec3::from(at), radius));
    let side = (b - a).cross(0.5 * (a + b) - lamp).try_normalize()?;
    let near = [a + side * a_radius, a - side * a_radius, b - side * b_radius, b + side * b_radius];
    let far = near.map(|corner| {
        let way = (corner - lamp).normalize_or_zero();
        let down_m = (lowest - lamp.z) / way.z.min(-0.01);
        lamp + way * down_m.clamp(corner.distance(lamp), REACH_M)
    });
    let all = [near[0], near[1], near[2], near[3], far[0], far[1], far[2], far[3]];
    Some(all.map(|corner| corner.to_array()))
}

/// The triangles of such a body, anticlockwise seen from outside.
pub const ROD_SHADOW_TRIANGLES: [u32; 36] = [
    0, 1, 2, 0, 2, 3, // towards the lamp
    4, 6, 5, 4, 7, 6, // away from it
    0, 5, 1, 0, 4, 5, // the four sides
    1, 6, 2, 1, 5, 6, //
    2, 7, 3, 2, 6, 7, //
    3, 4, 0, 3, 7, 4, //
];
