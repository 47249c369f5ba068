//! The cellar itself: floor, walls, a vault on ribs, panels, a door, a slit to the night.

use super::builder::{Builder, Group, Lay};
use super::finish::*;
use super::{CROWN_M, EAST_M, RIBS_M, SPRING_M, WEST_M, WIDE_M};
use glam::DVec3;

/// Texels per metre on floor, walls, vault.
const FLOOR: f64 = 20.0;
const WALL: f64 = 14.0;
const VAULT_DENSITY: f64 = 10.0;
/// Pieces of the vault's arc.
const ARC: usize = 14;
/// How far pilasters and ribs stand out, and how wide they are [m].
pub(super) const RIB_DEPTH_M: f64 = 0.16;
const RIB_WIDTH_M: f64 = 0.36;
/// Height of the panels along the long walls, and how far they stand out [m].
pub(super) const PANEL_M: f64 = 1.0;
pub(super) const PANEL_DEPTH_M: f64 = 0.03;

/// Height of the vault above the floor, `y` beside the middle, `under` below its surface [m].
pub(super) fn vault(y: f64, under: f64) -> f64 {
    let rise = CROWN_M - SPRING_M;
    let radius = (WIDE_M * WIDE_M + rise * rise) / (2.0 * rise);
    let r = radius - under;
    CROWN_M - radius + (r * r - y * y).max(0.0).sqrt()
}

pub(super) fn build(b: &mut Builder, floor: f64) {
    let at = DVec3::new(0.0, 0.0, floor);
    b.begin(Group::Standing);
    b.stand(at, 0.0);
    let long = EAST_M - WEST_M;
    let south_west = DVec3::new(WEST_M, -WIDE_M, 0.0);
    let (x, y) = (DVec3::X * long, DVec3::Y * 2.0 * WIDE_M);
    b.quad(south_west, x, y, BOARDS, Lay::of(FLOOR).planar());
    let wall = Lay::of(WALL).planar();
    let above = DVec3::Z * (SPRING_M - PANEL_M);
    let up = DVec3::Z * PANEL_M;
    b.quad(DVec3::new(WEST_M, WIDE_M, PANEL_M), x, above, BRICK, wall);
    b.quad(DVec3::new(EAST_M, -WIDE_M, PANEL_M), -x, above, BRICK, wall);
    for (x, sign) in [(WEST_M, 1.0), (EAST_M, -1.0)] {
        let at = |k: usize| sign * WIDE_M * (2.0 * k as f64 / ARC as f64 - 1.0);
        let low = (0..=ARC).map(|k| DVec3::new(x, at(k), 0.0)).collect();
        let high = (0..=ARC).map(|k| DVec3::new(x, at(k), vault(at(k), 0.0))).collect();
        b.grid(&[low, high], BRICK, wall);
    }

    // Panels with a skirting and a rail.
    for side in [-1.0, 1.0] {
        let (from, way) = if side > 0.0 { (WEST_M, x) } else { (EAST_M, -x) };
        let face = side * (WIDE_M - PANEL_DEPTH_M);
        b.quad(DVec3::new(from, face, 0.0), way, up, PANELS, wall);
        let rail = |depth: f64, low: f64, high: f64| {
            let (a, c) = (side * (WIDE_M - depth), side * WIDE_M);
            (DVec3::new(WEST_M, a.min(c), low), DVec3::new(EAST_M, a.max(c), high))
        };
        let without = if side > 0.0 { "bnwe" } else { "bswe" };
        let (least, most) = rail(0.05, 0.0, 0.14);
        b.cuboid(least, most, without, OAK, Lay::of(WALL));
        let (least, most) = rail(0.075, PANEL_M - 0.02, PANEL_M + 0.03);
        b.cuboid(least, most, &without.replace('b', ""), OAK, Lay::of(WALL));
    }
    for x in RIBS_M {
        for side in [-1.0, 1.0] {
            pilaster(b, x, side);
        }
    }
    door(b);
    slit(b);

    b.begin(Group::Ceiling);
    b.stand(at, 0.0);
    let row = |k: usize| {
        let y = WIDE_M * (1.0 - 2.0 * k as f64 / ARC as f64);
        let z = vault(y, 0.0);
        vec![DVec3::new(WEST_M, y, z), DVec3::new(EAST_M, y, z)]
    };
    let rows: Vec<_> = (0..=ARC).map(row).collect();
    b.grid(&rows, VAULT, Lay::of(VAULT_DENSITY).across());
    RIBS_M.iter().for_each(|x| rib(b, *x));
}

fn pilaster(b: &mut Builder, x: f64, side: f64) {
    let (half, depth) = (0.5 * RIB_WIDTH_M, RIB_DEPTH_M);
    let body = |grow: f64, low: f64, high: f64| {
        let (a, c) = (side * (WIDE_M - depth - grow), side * WIDE_M);
        let least = DVec3::new(x - half - grow, a.min(c), low);
        (least, DVec3::new(x + half + grow, a.max(c), high))
    };
    let back = if side > 0.0 { 'n' } else { 's' };
    let top = vault(WIDE_M - depth, depth);
    let (least, most) = body(0.0, 0.0, top);
    b.cuboid(least, most, &format!("bt{back}"), STONE, Lay::of(WALL).planar());
    let (least, most) = body(0.03, 0.0, 0.2);
    b.cuboid(least, most, &format!("b{back}"), STONE, Lay::of(WALL).planar());
    let (least, most) = body(0.04, top - 0.13, top);
    b.cuboid(least, most, &back.to_string(), STONE, Lay::of(WALL).planar());
}

/// An arch from pilaster to pilaster.
fn rib(b: &mut Builder, x: f64) {
    let half = 0.5 * RIB_WIDTH_M;
    let point = |x: f64, k: usize, under: f64| {
        let y = (WIDE_M - if under > 0.0 { RIB_DEPTH_M } else { 0.0 })
            * (1.0 - 2.0 * k as f64 / ARC as f64);
        DVec3::new(x, y, vault(y, under))
    };
    let lay = Lay::of(VAULT_DENSITY).across();
    let below: Vec<_> = (0..=ARC)
        .map(|k| vec![point(x - half, k, RIB_DEPTH_M), point(x + half, k, RIB_DEPTH_M)])
        .collect();
    b.grid(&below, STONE, lay);
    let west: Vec<_> =
        (0..=ARC).map(|k| vec![point(x - half, k, 0.0), point(x - half, k, RIB_DEPTH_M)]).collect();
    b.grid(&west, STONE, lay);
    let east: Vec<_> =
        (0..=ARC).map(|k| vec![point(x + half, k, RIB_DEPTH_M), point(x + half, k, 0.0)]).collect();
    b.grid(&east, STONE, lay);
}

/// A door of planks in the west wall.
fn door(b: &mut Builder) {
    let (south, north, height) = (0.9, 1.86, 2.02);
    let lay = Lay::of(WALL);
    let leaf = DVec3::new(WEST_M, south, 0.0);
    b.cuboid(leaf, DVec3::new(WEST_M + 0.04, north, height), "bwtns", PANELS, lay.planar());
    for (a, c, low, high) in [
        (south - 0.1, south, 0.0, height + 0.1),
        (north, north + 0.1, 0.0, height + 0.1),
        (south, north, height, height + 0.1),
    ] {
        let most = DVec3::new(WEST_M + 0.08, c, high);
        b.cuboid(DVec3::new(WEST_M, a, low), most, "bw", OAK, lay);
    }
    for z in [0.35, 1.55] {
        let least = DVec3::new(WEST_M + 0.04, south + 0.02, z);
        b.cuboid(least, DVec3::new(WEST_M + 0.05, south + 0.72, z + 0.06), "w", IRON, lay);
    }
    let handle = DVec3::new(WEST_M + 0.09, north - 0.12, 0.98);
    b.rod(handle, handle - DVec3::Y * 0.13, 0.011, BRASS, lay);
    b.rod(handle - DVec3::X * 0.05, handle, 0.009, BRASS, lay);
}

/// A slit under the vault, with bars before the night.
fn slit(b: &mut Builder) {
    let (half, low, high) = (0.42, 2.26, 2.62);
    let lay = Lay::of(WALL);
    let frame = WEST_M + 0.05;
    b.quad(
        DVec3::new(WEST_M + 0.012, -half, low),
        DVec3::Y * 2.0 * half,
        DVec3::Z * (high - low),
        NIGHT,
        lay,
    );
    for (a, c, low, high) in [
        (-half - 0.08, -half, low - 0.08, high + 0.08),
        (half, half + 0.08, low - 0.08, high + 0.08),
        (-half, half, high, high + 0.08),
        (-half, half, low - 0.08, low),
    ] {
        b.cuboid(DVec3::new(WEST_M, a, low), DVec3::new(frame, c, high), "w", STONE, lay);
    }
    for k in -2..=2 {
        let y = 0.14 * f64::from(k);
        let foot = DVec3::new(WEST_M + 0.03, y, low);
        b.rod(foot, foot + DVec3::Z * (high - low), 0.008, IRON, lay);
    }
}
