//! Where in a picture lies what moves, with its shadows: the rest of the picture is as it was.

use super::draw_list::DrawList;
use crate::cue::{BUTT_RADIUS_M, CUE_LENGTH_M, CuePose};
use glam::{Mat4, Vec2, Vec3};

/// Half the side of the square that a ball darkens, in radii.
const SHADOW_REACH: f32 = 4.4;
/// The same for each metre that a ball is above the cloth: lamps stand low over far ends.
const SHADOW_REACH_PER_M: f32 = 2.0;
/// A ball that is higher throws no shadow that is worth drawing [radii].
const SHADOW_HEIGHT: f32 = 12.0;
/// How far beside a cue its shadow can be [m].
const CUE_SHADOW_M: f32 = 0.3;
/// Length and half width of a stylus that is drawn as large as it is [m].
const STYLUS_M: (f32, f32) = (0.112, 0.0042);
/// What is longer is looked at in pieces [m]: a box round all of it would hold much else.
const PIECE_M: f32 = 0.15;
/// Shadows lie no higher over the cloth [m].
const LIFT_M: f32 = 0.002;
/// Edges of what is drawn may lie in the pixel beside [pixels].
const MARGIN: f32 = 2.0;
/// What is nearer to the eye is not drawn [m].
const NEAREST_M: f32 = 0.05;
/// So many tiles, across and up, are looked at one by one.
const TILES: [usize; 2] = [48, 30];

/// A part of a picture: from the lower left to the upper right corner, each from -1 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Left and lower edge.
    pub least: [f32; 2],
    /// Right and upper edge.
    pub most: [f32; 2],
}

impl Patch {
    /// The whole picture.
    pub const WHOLE: Patch = Patch { least: [-1.0; 2], most: [1.0; 2] };
}

/// Half the side of the square on the cloth that a ball of this radius darkens, if its middle is so
/// high over the cloth [m]; none if it is very high, or on its way down a pocket.
pub fn shadow_reach_m(radius_m: f32, height_m: f32) -> Option<f32> {
    let throws_one = (0.5 * radius_m..SHADOW_HEIGHT * radius_m).contains(&height_m);
    let above_m = (height_m - radius_m).max(0.0);
    throws_one.then_some(SHADOW_REACH * radius_m + SHADOW_REACH_PER_M * above_m)
}

/// The part of the cloth that a cue can darken, anticlockwise seen from above; `half_bed` is half
/// its length and width [m], zero without a table.
pub fn cue_shadow(cue: &CuePose, half_bed: Vec2) -> Vec<Vec2> {
    let (tip, along) = (cue.tip.as_vec3().truncate(), cue.direction.as_vec3().truncate());
    let butt = tip - along * CUE_LENGTH_M as f32;
    let ahead = along.normalize_or_zero() * CUE_SHADOW_M;
    let (from, to, aside) = (butt - ahead, tip + ahead, ahead.perp());
    let mut area = vec![from - aside, to - aside, to + aside, from + aside];
    if half_bed.x > 0.0 {
        for (normal, reach) in [
            (Vec2::X, half_bed.x),
            (Vec2::NEG_X, half_bed.x),
            (Vec2::Y, half_bed.y),
            (Vec2::NEG_Y, half_bed.y),
        ] {
            area = on_this_side(&area, normal, reach);
        }
    }
    area
}

/// What is left of a convex area on one side of a line (Sutherland and Hodgman 1974).
fn on_this_side(area: &[Vec2], normal: Vec2, reach: f32) -> Vec<Vec2> {
    let mut left = Vec::with_capacity(area.len() + 1);
    for (a, b) in area.iter().zip(area.iter().cycle().skip(1)) {
        let [inside_a, inside_b] = [a, b].map(|at| reach - at.dot(normal));
        if inside_a >= 0.0 {
            left.push(*a);
        }
        if (inside_a >= 0.0) != (inside_b >= 0.0) {
            left.push(a.lerp(*b, inside_a / (inside_a - inside_b)));
        }
    }
    left
}

/// Patches that together hold everything of a list that the eye of this matrix sees, in a picture
/// of this size [pixels]; none lies on another. `half_bed` is as for [`cue_shadow`].
pub fn patches(
    list: &DrawList,
    half_bed: Vec2,
    view_projection: Mat4,
    size: (u32, u32),
) -> Vec<Patch> {
    let margin = 2.0 * MARGIN / Vec2::new(size.0.max(1) as f32, size.1.max(1) as f32);
    let mut is_touched = [[false; TILES[0]]; TILES[1]];
    for (least, most) in boxes(list, half_bed) {
        let patch = match seen(least, most, view_projection, margin) {
            Seen::Nothing => continue,
            Seen::Somewhere => return vec![Patch::WHOLE],
            Seen::In(patch) => patch,
        };
        let [across, up] = [0, 1].map(|axis| {
            let tile = |at: f32| (0.5 + 0.5 * at) * TILES[axis] as f32;
            let last = tile(patch.most[axis]).ceil() as usize;
            tile(patch.least[axis]) as usize..last.min(TILES[axis])
        });
        is_touched[up].iter_mut().for_each(|row| row[across.clone()].fill(true));
    }
    is_touched.iter().enumerate().flat_map(|(up, row)| runs(row, up)).collect()
}

/// A patch for each run of tiles that are touched.
fn runs(row: &[bool], up: usize) -> Vec<Patch> {
    let edge = |axis: usize, tile: usize| 2.0 * tile as f32 / TILES[axis] as f32 - 1.0;
    let mut across = 0;
    let tiles = row.chunk_by(|a, b| a == b).map(|run| {
        let from = across;
        across += run.len();
        (run[0], from, across)
    });
    tiles
        .filter(|(is_touched, ..)| *is_touched)
        .map(|(_, from, to)| Patch {
            least: [edge(0, from), edge(1, up)],
            most: [edge(0, to), edge(1, up + 1)],
        })
        .collect()
}

/// Boxes round everything, by their least and greatest corners [m].
fn boxes(list: &DrawList, half_bed: Vec2) -> Vec<(Vec3, Vec3)> {
    let mut boxes = Vec::new();
    let balls = list.balls.iter().map(|ball| (ball.position, ball.radius_m));
    let ghosts = list.ghosts.iter().map(|ghost| (ghost.position, ghost.radius_m));
    for (position, radius_m) in balls.chain(ghosts) {
        let middle = Vec3::from(position);
        boxes.push((middle - radius_m, middle + radius_m));
        if let Some(reach_m) = shadow_reach_m(radius_m, middle.z) {
            let (under, aside) = (middle.with_z(0.0), Vec3::new(reach_m, reach_m, LIFT_M));
            boxes.push((under - aside, under + aside));
        }
    }
    if let Some(cue) = &list.cue {
        let (tip, along) = (cue.tip.as_vec3(), cue.direction.as_vec3());
        let butt = tip - along * CUE_LENGTH_M as f32;
        boxes.extend(rod(tip, butt, BUTT_RADIUS_M as f32));
        let area = cue_shadow(cue, half_bed);
        let on_cloth = |at: Vec2| at.extend(0.0);
        boxes.extend(
            pieces(&area).map(|(least, most)| (on_cloth(least) - LIFT_M, on_cloth(most) + LIFT_M)),
        );
    }
    for line in &list.lines {
        boxes.extend(rod(line.from.into(), line.to.into(), line.half_width_m));
    }
    for solid in &list.solids {
        boxes.extend(rod(solid.from.into(), solid.to.into(), solid.radius_m));
    }
    if let Some(stylus) = &list.stylus {
        let (length, width) = (STYLUS_M.0 * stylus.scale, STYLUS_M.1 * stylus.scale);
        let tip = Vec3::from(stylus.tip);
        boxes.extend(rod(tip, tip - Vec3::from(stylus.direction) * length, width));
    }
    boxes
}

/// Boxes round the pieces of a convex area, cut across where it is long.
fn pieces(area: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    let least = area.iter().fold(Vec2::MAX, |a, b| a.min(*b));
    let most = area.iter().fold(Vec2::MIN, |a, b| a.max(*b));
    let side = (most - least).max(Vec2::ZERO);
    let axis = if side.x < side.y { Vec2::Y } else { Vec2::X };
    let count = (side.max_element() / PIECE_M).ceil().clamp(0.0, 64.0) as u32;
    (0..count).filter_map(move |piece| {
        let at = |piece: u32| least.dot(axis) + side.max_element() * piece as f32 / count as f32;
        let piece = on_this_side(&on_this_side(area, axis, at(piece + 1)), -axis, -at(piece));
        let least = piece.iter().copied().reduce(Vec2::min)?;
        Some((least, piece.iter().copied().reduce(Vec2::max)?))
    })
}

/// Boxes round the pieces of a rod with round ends.
fn rod(from: Vec3, to: Vec3, radius_m: f32) -> impl Iterator<Item = (Vec3, Vec3)> {
    // A rod without end would have pieces without end; nothing is that long.
    let pieces = (from.distance(to) / PIECE_M).ceil().clamp(1.0, 64.0) as u32;
    let at = move |piece: u32| from.lerp(to, piece as f32 / pieces as f32);
    (0..pieces).map(move |piece| {
        let (a, b) = (at(piece), at(piece + 1));
        (a.min(b) - radius_m, a.max(b) + radius_m)
    })
}

enum Seen {
    /// It is behind the eye or beside the picture.
    Nothing,
    /// It reaches up to the eye.
    Somewhere,
    In(Patch),
}

fn seen(least: Vec3, most: Vec3, view_projection: Mat4, margin: Vec2) -> Seen {
    let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| {
        let pick = |bit: u8, a: f32, b: f32| if corner & (1 << bit) == 0 { a } else { b };
        let at =
            Vec3::new(pick(0, least.x, most.x), pick(1, least.y, most.y), pick(2, least.z, most.z));
        view_projection * at.extend(1.0)
    });
    // Not a number is not behind the eye.
    if corners.iter().all(|corner| corner.w < NEAREST_M) {
        return Seen::Nothing;
    }
    if !corners.iter().all(|corner| NEAREST_M <= corner.w) {
        return Seen::Somewhere;
    }
    let places = corners.map(|corner| corner.truncate().truncate() / corner.w);
    let least = places.iter().fold(Vec2::MAX, |a, b| a.min(*b)) - margin;
    let most = places.iter().fold(Vec2::MIN, |a, b| a.max(*b)) + margin;
    if least.cmpgt(Vec2::ONE).any() || most.cmplt(Vec2::NEG_ONE).any() {
        return Seen::Nothing;
    }
    let (low, high) = (Vec2::NEG_ONE, Vec2::ONE);
    Seen::In(Patch { least: least.max(low).to_array(), most: most.min(high).to_array() })
}
