//! What stands and hangs along the walls: cues, a slate, a bench, a dartboard, barrels, lights.

use super::bar::stool;
use super::builder::{Builder, Lay};
use super::finish::*;
use super::shell::{PANEL_DEPTH_M, RIB_DEPTH_M};
use super::{Obstacle, RIBS_M, WEST_M, WIDE_M};
use core::f64::consts::{PI, TAU};
use glam::DVec3;

const LAY: Lay = Lay::of(18.0);
const FINE: Lay = Lay::of(30.0);
/// Where the walls are that things hang on: above the panels, and before them [m].
const WALL_M: f64 = WIDE_M;
const PANEL_FACE_M: f64 = WIDE_M - PANEL_DEPTH_M;

pub(super) fn build(b: &mut Builder, floor: f64) {
    let on_wall = |b: &mut Builder, x: f64, side: f64, z: f64| {
        // Own x to the right, own y into the wall, as seen from the room.
        let turn = if side > 0.0 { 0.0 } else { PI };
        b.stand(DVec3::new(x, side * WALL_M, floor + z), turn);
    };
    on_wall(b, -0.8, 1.0, 0.0);
    cue_rack(b);
    on_wall(b, 1.6, 1.0, 1.32);
    slate(b);
    b.stand(DVec3::new(1.6, PANEL_FACE_M, floor), 0.0);
    bench(b);
    on_wall(b, -0.8, -1.0, 1.30);
    poster(b);
    on_wall(b, 1.6, -1.0, 1.73);
    dartboard(b);
    for (x, side) in [(-3.2, 1.0), (4.0, 1.0), (4.0, -1.0), (-3.2, -1.0)] {
        on_wall(b, x, side, 1.34);
        picture(b, if x * side > 0.0 { [0.10, 0.13, 0.10] } else { [0.16, 0.10, 0.055] });
    }
    for x in RIBS_M {
        for side in [-1.0, 1.0] {
            let y = side * (WIDE_M - RIB_DEPTH_M);
            b.stand(DVec3::new(x, y, floor + 1.62), if side > 0.0 { 0.0 } else { PI });
            sconce(b);
        }
    }

    let (x, y) = (-0.75, -2.75);
    b.stand(DVec3::new(x, y, floor), 0.0);
    high_table(b);
    for (x, y) in [(-1.35, -2.95), (-0.2, -3.0)] {
        b.stand(DVec3::new(x, y, floor), x);
        stool(b, 0.74);
    }
    for (x, y) in [(WEST_M + 0.42, -2.9), (WEST_M + 0.50, -2.14)] {
        b.stand(DVec3::new(x, y, floor), y);
        barrel(b);
    }
}

/// What stands together is one obstacle, up to its wall: nobody is caught in between. They stand at
/// z = 0.
pub(super) fn obstacles() -> [Obstacle; 4] {
    [
        Obstacle { least: DVec3::new(-1.56, -WIDE_M, 0.0), most: DVec3::new(0.01, -2.39, 1.12) },
        Obstacle {
            least: DVec3::new(WEST_M, -WIDE_M, 0.0),
            most: DVec3::new(WEST_M + 0.86, -1.78, 0.92),
        },
        Obstacle {
            least: DVec3::new(-1.35, WIDE_M - 0.2, 0.0),
            most: DVec3::new(-0.25, WIDE_M, 2.1),
        },
        Obstacle {
            least: DVec3::new(0.66, WIDE_M - 0.56, 0.0),
            most: DVec3::new(2.54, WIDE_M, 0.95),
        },
    ]
}

/// Six cues before a board.
fn cue_rack(b: &mut Builder) {
    let half = 0.5;
    let board = DVec3::new(-half, -0.025, 1.12);
    b.cuboid(board, DVec3::new(half, 0.0, 1.95), "n", OAK, LAY);
    let shelf = DVec3::new(-half, -PANEL_DEPTH_M - 0.13, 0.50);
    b.cuboid(shelf, DVec3::new(half, -PANEL_DEPTH_M, 0.54), "n", OAK, LAY);
    let lip = DVec3::new(-half, -PANEL_DEPTH_M - 0.13, 0.54);
    b.cuboid(lip, DVec3::new(half, -PANEL_DEPTH_M - 0.115, 0.565), "b", OAK, FINE);
    let clip = DVec3::new(-half, -0.085, 1.66);
    b.cuboid(clip, DVec3::new(half, -0.025, 1.69), "n", OAK, LAY);
    let place = b.place();
    for k in 0..6 {
        let x = -0.41 + 0.164 * f64::from(k);
        b.stand_in(place, DVec3::new(x, -PANEL_DEPTH_M - 0.065, 0.54));
        b.lean(-0.028);
        let butt = [(0.015, 0.0), (0.0145, 0.30), (0.0142, 0.30), (0.0125, 0.62)];
        b.lathe(&butt[..2], 8, EBONY, FINE);
        let wrap = if k % 2 == 0 { paint([0.05, 0.05, 0.055]) } else { LEATHER };
        b.lathe(&butt[2..], 8, wrap, FINE);
        b.lathe(&[(0.0125, 0.62), (0.0122, 0.66)], 8, BRASS, FINE);
        b.lathe(&[(0.0118, 0.66), (0.0066, 1.43)], 8, MAPLE, FINE);
        b.lathe(&[(0.0066, 1.43), (0.0064, 1.452), (0.0, 1.455)], 8, CHALK, FINE);
    }
    b.stand_in(place, DVec3::ZERO);
    // A box of chalk, and cubes of it.
    for (x, colour) in
        [(-0.33, [0.03, 0.10, 0.30]), (0.0, [0.02, 0.17, 0.16]), (0.33, [0.03, 0.10, 0.30])]
    {
        let least = DVec3::new(x - 0.011, -0.075, 1.69);
        b.cuboid(least, DVec3::new(x + 0.011, -0.053, 1.712), "b", paint(colour), FINE);
    }
}

/// A frame round a rectangle on the wall: half width and height [m]; returns its inner edge.
fn frame(b: &mut Builder, half: f64, height: f64, width: f64, finish: Finish) {
    let depth = 0.035;
    for (least, most) in [
        ([-half - width, -width], [half + width, 0.0]),
        ([-half - width, height], [half + width, height + width]),
        ([-half - width, 0.0], [-half, height]),
        ([half, 0.0], [half + width, height]),
    ] {
        let least = DVec3::new(least[0], -depth, least[1]);
        b.cuboid(least, DVec3::new(most[0], 0.0, most[1]), "n", finish, LAY);
    }
}

/// A plate on the wall, `depth` before it.
fn plate(b: &mut Builder, at: [f64; 2], size: [f64; 2], depth: f64, finish: Finish) {
    let corner = DVec3::new(at[0], -depth, at[1]);
    b.quad(corner, DVec3::X * size[0], DVec3::Z * size[1], finish, LAY);
}

/// A slate with the score of an old game.
fn slate(b: &mut Builder) {
    plate(b, [-0.55, 0.0], [1.1, 0.6], 0.012, SLATE);
    frame(b, 0.55, 0.6, 0.06, OAK);
    plate(b, [-0.004, 0.05], [0.008, 0.5], 0.014, CHALK);
    plate(b, [-0.50, 0.47], [1.0, 0.007], 0.014, CHALK);
    // Tallies: four strokes and one across.
    for (column, row, count) in
        [(-0.48, 0.30, 5), (-0.30, 0.30, 5), (-0.48, 0.10, 3), (0.06, 0.30, 5), (0.24, 0.30, 4)]
    {
        for k in 0..count.min(4) {
            let lean = 0.004 * f64::from(k % 3) - 0.004;
            let corner = DVec3::new(column + 0.026 * f64::from(k), -0.014, row);
            b.quad(corner, DVec3::X * 0.006, DVec3::new(lean, 0.0, 0.12), CHALK, LAY);
        }
        if count == 5 {
            let corner = DVec3::new(column - 0.02, -0.0145, row + 0.02);
            b.quad(corner, DVec3::new(0.125, 0.0, 0.07), DVec3::Z * 0.007, CHALK, LAY);
        }
    }
    let least = DVec3::new(-0.3, -0.06, -0.072);
    b.cuboid(least, DVec3::new(0.3, -0.03, -0.06), "", OAK, LAY);
    b.cuboid(DVec3::new(0.1, -0.055, -0.06), DVec3::new(0.18, -0.043, -0.048), "b", CHALK, LAY);
}

/// A bench of leather along the panels.
fn bench(b: &mut Builder) {
    let half = 0.92;
    let base = DVec3::new(-half, -0.50, 0.06);
    b.cuboid(base, DVec3::new(half, -0.05, 0.36), "n", PANELS, LAY.planar());
    for side in [-1.0, 1.0] {
        let (a, c) = (side * (half - 0.06), side * half);
        let least = DVec3::new(a.min(c), -0.48, 0.0);
        b.cuboid(least, DVec3::new(a.max(c), -0.05, 0.06), "btn", OAK, LAY);
    }
    // Seat and back: cushions, rounded at their edges.
    for k in 0..3 {
        let (a, c) =
            (half * (2.0 * f64::from(k) / 3.0 - 1.0), half * (2.0 * f64::from(k + 1) / 3.0 - 1.0));
        let (a, c) = (a + 0.008, c - 0.008);
        cushion(
            b,
            [a, c],
            &[
                (-0.51, 0.36),
                (-0.525, 0.40),
                (-0.50, 0.445),
                (-0.42, 0.46),
                (-0.18, 0.455),
                (-0.13, 0.44),
            ],
        );
        cushion(
            b,
            [a, c],
            &[
                (-0.16, 0.42),
                (-0.15, 0.60),
                (-0.125, 0.80),
                (-0.09, 0.85),
                (-0.04, 0.86),
                (0.0, 0.85),
            ],
        );
    }
    let least = DVec3::new(-half, -0.03, 0.85);
    b.cuboid(least, DVec3::new(half, 0.0, 0.92), "n", OAK, LAY);
}

/// A cushion over the length `a..c`, with the outline (depth, height) from front to back.
fn cushion(b: &mut Builder, [a, c]: [f64; 2], outline: &[(f64, f64)]) {
    let middle = outline.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0, sum.1 + p.1));
    let middle = (middle.0 / outline.len() as f64, middle.1 / outline.len() as f64);
    // A point of the outline, drawn in by this share.
    let at = |x: f64, share: f64, (y, z): (f64, f64)| {
        DVec3::new(x, y + (middle.0 - y) * share, z + (middle.1 - z) * share)
    };
    const DRAWN: f64 = 1.0 / 6.0;
    let columns = [(a, DRAWN), (a + 0.03, 0.0), (c - 0.03, 0.0), (c, DRAWN)];
    let row = |&p: &(f64, f64)| columns.iter().map(|&(x, share)| at(x, share, p)).collect();
    let rows: Vec<Vec<DVec3>> = outline.iter().map(row).collect();
    b.grid(&rows, LEATHER, LAY);
    // Its two ends.
    let ring = || outline.iter().chain(outline.first());
    let east: Vec<DVec3> = ring().map(|p| at(c, DRAWN, *p)).collect();
    let west: Vec<DVec3> = ring().rev().map(|p| at(a, DRAWN, *p)).collect();
    for end in [east, west] {
        let centre = vec![DVec3::new(end[0].x, middle.0, middle.1); end.len()];
        b.grid(&[centre, end], LEATHER, LAY);
    }
}

/// Fifteen balls in their triangle, painted.
fn poster(b: &mut Builder) {
    let (half, height) = (0.36, 0.72);
    plate(b, [-half, 0.0], [2.0 * half, height], 0.010, PAPER);
    plate(
        b,
        [-half + 0.05, 0.05],
        [2.0 * half - 0.1, height - 0.1],
        0.012,
        paint([0.022, 0.10, 0.075]),
    );
    frame(b, half, height, 0.03, EBONY);
    const PAINTS: [[f32; 3]; 5] = [
        [0.62, 0.42, 0.03],
        [0.03, 0.07, 0.30],
        [0.45, 0.03, 0.02],
        [0.60, 0.18, 0.02],
        [0.02, 0.02, 0.02],
    ];
    let mut number = 0;
    for row in 0..5 {
        for k in 0..=row {
            let x = 0.104 * (f64::from(k) - 0.5 * f64::from(row));
            let z = 0.56 - 0.091 * f64::from(row);
            disc(b, [x, z], 0.05, 0.014, paint(PAINTS[number * 3 % 5]));
            if number % 3 == 1 {
                disc(b, [x, z], 0.022, 0.016, PAPER);
            }
            number += 1;
        }
    }
}

/// A disc on the wall.
fn disc(b: &mut Builder, [x, z]: [f64; 2], radius: f64, depth: f64, finish: Finish) {
    let count = if radius < 0.06 { 12 } else { 28 };
    let at = |k: i32, r: f64| {
        let (sin, cos) = libm::sincos(TAU * f64::from(k % count) / f64::from(count));
        DVec3::new(x + r * sin, -depth, z + r * cos)
    };
    let ring = |r: f64| (0..=count).map(|k| at(k, r)).collect();
    b.grid(&[ring(0.0), ring(radius)], finish, Lay::of(18.0));
}

/// A dartboard on cork, under its own light.
fn dartboard(b: &mut Builder) {
    disc(b, [0.0, 0.0], 0.36, 0.012, CORK);
    disc(b, [0.0, 0.0], 0.226, 0.03, IRON);
    let (black, cream) = (paint([0.015, 0.014, 0.013]), paint([0.50, 0.42, 0.28]));
    let (red, green) = (paint([0.32, 0.018, 0.012]), paint([0.012, 0.13, 0.04]));
    let rings =
        [(0.016, 0.099, false), (0.099, 0.107, true), (0.107, 0.162, false), (0.162, 0.170, true)];
    for sector in 0..20 {
        for (inner, outer, is_ring) in rings {
            let finish = match (sector % 2 == 0, is_ring) {
                (true, false) => black,
                (false, false) => cream,
                (true, true) => red,
                (false, true) => green,
            };
            let at = |k: f64, r: f64| {
                let (sin, cos) = libm::sincos(TAU * (k - 0.5) / 20.0);
                DVec3::new(r * sin, -0.032, r * cos)
            };
            let k = f64::from(sector);
            let rows =
                [vec![at(k, inner), at(k + 1.0, inner)], vec![at(k, outer), at(k + 1.0, outer)]];
            b.grid(&rows, finish, Lay::of(8.0));
        }
    }
    disc(b, [0.0, 0.0], 0.016, 0.033, green);
    disc(b, [0.0, 0.0], 0.0065, 0.034, red);
    // A small lamp on an arm above it.
    b.rod(DVec3::new(0.0, 0.0, 0.44), DVec3::new(0.0, -0.22, 0.47), 0.008, BRASS, FINE);
    let least = DVec3::new(-0.16, -0.26, 0.455);
    b.cuboid(least, DVec3::new(0.16, -0.18, 0.49), "b", BRASS, FINE);
    let light = DVec3::new(-0.15, -0.19, 0.456);
    b.quad(light, DVec3::X * 0.3, -DVec3::Y * 0.06, SMALL_LAMP, Lay::of(6.0));
}

/// A dark old painting: sky, a hill, a meadow.
fn picture(b: &mut Builder, tone: [f32; 3]) {
    let (half, height) = (0.34, 0.46);
    let shade = |by: f32| paint(tone.map(|channel| channel * by));
    plate(b, [-half, 0.0], [2.0 * half, 0.17], 0.010, shade(0.55));
    plate(b, [-half, 0.17], [2.0 * half, 0.09], 0.010, shade(0.9));
    plate(b, [-half, 0.26], [2.0 * half, 0.20], 0.010, shade(1.7));
    frame(b, half, height, 0.045, Finish { gloss: 0.9, ..CORK });
}

/// A small shade of brass with warm light above and below.
fn sconce(b: &mut Builder) {
    let place = b.place();
    let least = DVec3::new(-0.04, -0.02, -0.10);
    b.cuboid(least, DVec3::new(0.04, 0.0, 0.10), "n", BRASS, FINE);
    b.rod(DVec3::new(0.0, -0.02, -0.03), DVec3::new(0.0, -0.11, -0.03), 0.008, BRASS, FINE);
    b.stand_in(place, DVec3::new(0.0, -0.11, 0.0));
    b.lathe(&[(0.0, -0.075), (0.03, -0.07), (0.035, -0.05)], 10, BRASS, FINE);
    let glass = [(0.030, -0.05), (0.042, -0.02), (0.045, 0.02), (0.036, 0.06)];
    b.lathe(&glass, 10, SMALL_LAMP, FINE);
    b.lathe(&[(0.038, 0.06), (0.030, 0.072), (0.0, 0.076)], 10, BRASS, FINE);
    b.stand_in(place, DVec3::ZERO);
}

/// A round table to stand at, with two glasses of beer.
fn high_table(b: &mut Builder) {
    let foot = [(0.27, 0.0), (0.27, 0.02), (0.06, 0.05), (0.035, 0.10), (0.035, 1.02)];
    b.lathe(&foot, 16, IRON, LAY);
    let top = [(0.0, 1.02), (0.33, 1.02), (0.35, 1.03), (0.35, 1.05), (0.34, 1.06), (0.0, 1.06)];
    b.lathe(&top, 24, POLISHED, LAY);
    let place = b.place();
    for (x, y, level) in [(-0.12, 0.10, 0.115), (0.15, -0.06, 0.05)] {
        b.stand_in(place, DVec3::new(x, y, 1.06));
        let beer = [(0.030, 0.0), (0.031 + 0.04 * level, level)];
        b.lathe(&beer, 10, glass([0.42, 0.20, 0.025]), FINE);
        let foam = [
            (0.031 + 0.04 * level, level),
            (0.034 + 0.04 * level, level + 0.02),
            (0.0, level + 0.022),
        ];
        b.lathe(&foam, 10, CHALK, FINE);
    }
    b.stand_in(place, DVec3::new(0.02, 0.12, 1.06));
    let tray = [(0.0, 0.0), (0.05, 0.0), (0.055, 0.02), (0.045, 0.02), (0.04, 0.008), (0.0, 0.008)];
    b.lathe(&tray[1..], 10, BRASS, FINE);
    b.stand_in(place, DVec3::ZERO);
}

/// A barrel with hoops of iron.
fn barrel(b: &mut Builder) {
    let at = |z: f64| 0.27 + 0.07 * libm::sin(PI * z / 0.9);
    let heights = [0.0, 0.1, 0.22, 0.34, 0.45, 0.56, 0.68, 0.80, 0.9];
    let staves: Vec<(f64, f64)> = heights.iter().map(|&z| (at(z), z)).collect();
    b.lathe(&staves, 20, OAK, LAY.across());
    b.lathe(
        &[(at(0.9), 0.9), (0.24, 0.9), (0.24, 0.9), (0.235, 0.875), (0.235, 0.875), (0.0, 0.875)],
        20,
        OAK,
        LAY,
    );
    for z in [0.06, 0.22, 0.66, 0.82] {
        let hoop = [(at(z) + 0.004, z), (at(z + 0.035) + 0.004, z + 0.035)];
        b.lathe(&hoop, 20, IRON, LAY);
    }
}
