//! The bar at the east wall: counter, stools, shelves with bottles under small lights.

use super::builder::{Builder, Lay};
use super::finish::*;
use super::{EAST_M, Obstacle};
use glam::DVec3;

/// Texels of the light map per metre.
const LAY: Lay = Lay::of(18.0);
/// For what is small.
const FINE: Lay = Lay::of(30.0);
/// Half the length of the counter [m].
const HALF_M: f64 = 1.75;
/// The counter's front and back [m].
const FRONT_M: f64 = EAST_M - 1.32;
const BACK_M: f64 = EAST_M - 0.78;
/// Height of the counter [m].
const COUNTER_M: f64 = 1.06;

pub(super) fn build(b: &mut Builder, floor: f64) {
    let at = DVec3::new(0.0, 0.0, floor);
    b.stand(at, 0.0);
    counter(b);
    shelves(b);
    for y in [-1.15, -0.1, 1.0] {
        b.stand(at + DVec3::new(FRONT_M - 0.42, y, 0.0), 0.3 * y);
        stool(b, 0.74);
    }
}

/// Stools, counter, and who serves there; shelves above. They stand at z = 0.
pub(super) fn obstacles() -> [Obstacle; 2] {
    [
        Obstacle {
            least: DVec3::new(FRONT_M - 0.65, -HALF_M - 0.08, 0.0),
            most: DVec3::new(EAST_M, HALF_M + 0.08, COUNTER_M + 0.05),
        },
        Obstacle {
            least: DVec3::new(EAST_M - 0.36, -HALF_M, 0.0),
            most: DVec3::new(EAST_M, HALF_M, 2.08),
        },
    ]
}

fn counter(b: &mut Builder) {
    let body = DVec3::new(BACK_M, HALF_M, COUNTER_M);
    b.cuboid(DVec3::new(FRONT_M, -HALF_M, 0.0), body, "bt", PANELS, LAY.planar());
    // Pilasters of oak divide the front.
    for k in 0..=4 {
        let y = -HALF_M + 0.045 + (2.0 * HALF_M - 0.09) * f64::from(k) / 4.0;
        let least = DVec3::new(FRONT_M - 0.03, y - 0.045, 0.0);
        b.cuboid(least, DVec3::new(FRONT_M, y + 0.045, COUNTER_M), "bte", OAK, LAY);
    }
    for (low, high) in [(0.0, 0.13), (COUNTER_M - 0.10, COUNTER_M)] {
        let least = DVec3::new(FRONT_M - 0.04, -HALF_M - 0.01, low);
        let most = DVec3::new(FRONT_M, HALF_M + 0.01, high);
        b.cuboid(least, most, if low > 0.0 { "te" } else { "be" }, OAK, LAY);
    }
    let least = DVec3::new(FRONT_M - 0.14, -HALF_M - 0.08, COUNTER_M);
    let most = DVec3::new(BACK_M + 0.06, HALF_M + 0.08, COUNTER_M + 0.05);
    b.cuboid(least, most, "", POLISHED, Lay::of(22.0));
    // A rail for feet.
    let rail = |y: f64| DVec3::new(FRONT_M - 0.16, y, 0.2);
    b.rod(rail(-HALF_M), rail(HALF_M), 0.022, BRASS, LAY);
    for k in 0..=3 {
        let y = -HALF_M + 0.1 + (2.0 * HALF_M - 0.2) * f64::from(k) / 3.0;
        b.rod(rail(y), DVec3::new(FRONT_M - 0.03, y, 0.2), 0.014, BRASS, LAY);
    }
    // A tap, and glasses.
    let top = COUNTER_M + 0.05;
    let place = DVec3::new(FRONT_M + 0.32, 0.55, top);
    b.rod(place, place + DVec3::Z * 0.34, 0.03, BRASS, FINE);
    let arm = place + DVec3::Z * 0.30;
    b.rod(arm, arm + DVec3::new(0.16, 0.0, -0.03), 0.014, BRASS, FINE);
    b.rod(arm, arm + DVec3::new(0.0, 0.0, 0.22), 0.014, EBONY, FINE);
}

/// Shelves against the wall, each lit from the one above it.
fn shelves(b: &mut Builder) {
    let (front, wall) = (EAST_M - 0.34, EAST_M);
    let cupboard = DVec3::new(wall, HALF_M, 0.92);
    b.cuboid(DVec3::new(front, -HALF_M, 0.0), cupboard, "bte", PANELS, LAY.planar());
    let least = DVec3::new(front - 0.03, -HALF_M - 0.02, 0.92);
    b.cuboid(least, DVec3::new(wall, HALF_M + 0.02, 0.96), "e", POLISHED, LAY);
    // A mirror behind the bottles.
    let pane = DVec3::new(wall - 0.02, HALF_M - 0.12, 0.96);
    b.quad(pane, -DVec3::Y * 2.0 * (HALF_M - 0.12), DVec3::Z * 1.08, MIRROR, LAY);
    for side in [-1.0, 1.0] {
        let (a, c) = (side * (HALF_M - 0.12), side * HALF_M);
        let least = DVec3::new(wall - 0.24, a.min(c), 0.96);
        b.cuboid(least, DVec3::new(wall, a.max(c), 2.04), "be", OAK, LAY);
    }
    for z in [1.34, 1.68] {
        let least = DVec3::new(wall - 0.20, -HALF_M + 0.12, z);
        b.cuboid(least, DVec3::new(wall - 0.02, HALF_M - 0.12, z + 0.025), "ens", OAK, LAY);
        // A lip hides the light.
        let least = DVec3::new(wall - 0.215, -HALF_M + 0.12, z - 0.03);
        b.cuboid(least, DVec3::new(wall - 0.20, HALF_M - 0.12, z + 0.03), "ns", OAK, LAY);
        strip(b, z);
    }
    let least = DVec3::new(wall - 0.28, -HALF_M - 0.04, 2.04);
    b.cuboid(least, DVec3::new(wall, HALF_M + 0.04, 2.12), "e", OAK, LAY);
    let least = DVec3::new(wall - 0.28, -HALF_M - 0.04, 2.0);
    b.cuboid(least, DVec3::new(wall - 0.265, HALF_M + 0.04, 2.04), "t", OAK, LAY);
    strip(b, 2.04);

    // Bottles: kind, colour and gap run through primes, so that no two shelves are alike.
    let mut number = 0;
    for (z, kinds) in [(0.96, 4), (1.365, 3), (1.705, 3)] {
        let mut y = -HALF_M + 0.24;
        while y < HALF_M - 0.2 {
            let (kind, colour) = (number * 7 % kinds, number * 5 % COLOURS.len());
            // Here and there one is missing.
            if number * 11 % 13 != 4 {
                let x = wall - 0.12 + 0.02 * f64::from(number as i32 * 3 % 4 - 2);
                let floor = b.floor();
                b.stand(DVec3::new(x, y, floor + z), 0.0);
                bottle(b, kind, COLOURS[colour]);
                b.stand(DVec3::new(0.0, 0.0, floor), 0.0);
            }
            y += 0.125 + 0.02 * f64::from(number as i32 * 5 % 4);
            number += 1;
        }
    }
}

/// Light under a board.
fn strip(b: &mut Builder, under: f64) {
    let from = DVec3::new(EAST_M - 0.18, -HALF_M + 0.2, under - 0.006);
    b.quad(from, DVec3::Y * 2.0 * (HALF_M - 0.2), DVec3::X * 0.02, STRIP, Lay::of(6.0));
}

const COLOURS: [[f32; 3]; 7] = [
    [0.018, 0.070, 0.022],
    [0.190, 0.070, 0.012],
    [0.260, 0.190, 0.110],
    [0.085, 0.020, 0.010],
    [0.045, 0.090, 0.085],
    [0.300, 0.130, 0.020],
    [0.020, 0.030, 0.060],
];

fn bottle(b: &mut Builder, kind: usize, colour: [f32; 3]) {
    let (radius, body, height) = match kind {
        0 => (0.038, 0.19, 0.30),
        1 => (0.044, 0.15, 0.25),
        2 => (0.034, 0.21, 0.29),
        _ => (0.042, 0.22, 0.32),
    };
    let outline = [
        (radius, 0.0),
        (radius, 0.08),
        (radius, 0.08),
        (radius, body),
        (0.6 * radius, body + 0.04),
        (0.013, body + 0.06),
        (0.013, height),
        (0.0, height),
    ];
    b.lathe(&outline, 7, glass(colour), FINE);
    // Its label.
    let outline = [(radius + 0.001, 0.04), (radius + 0.001, 0.11)];
    b.lathe(&outline, 7, if kind == 1 { CHALK } else { PAPER }, FINE);
}

/// A stool with a seat of leather on a foot of brass.
pub(super) fn stool(b: &mut Builder, seat: f64) {
    let foot = [(0.20, 0.0), (0.20, 0.012), (0.05, 0.035), (0.026, 0.06)];
    b.lathe(&foot, 16, BRASS, LAY);
    b.lathe(&[(0.026, 0.06), (0.026, seat - 0.08)], 10, IRON, LAY);
    let ring = [(0.150, 0.26), (0.158, 0.268), (0.150, 0.276), (0.142, 0.268), (0.150, 0.26)];
    b.lathe(&ring, 16, BRASS, LAY);
    for turn in 0..3 {
        let (sin, cos) = libm::sincos(f64::from(turn) * 2.1);
        let out = DVec3::new(cos, sin, 0.0);
        let z = DVec3::Z * 0.268;
        b.rod(out * 0.02 + z, out * 0.15 + z, 0.008, BRASS, LAY);
    }
    let under =
        [(0.0, seat - 0.08), (0.13, seat - 0.08), (0.17, seat - 0.06), (0.175, seat - 0.05)];
    b.lathe(&under, 16, EBONY, LAY);
    let cushion = [
        (0.175, seat - 0.05),
        (0.185, seat - 0.025),
        (0.175, seat - 0.004),
        (0.12, seat + 0.008),
        (0.0, seat + 0.010),
    ];
    b.lathe(&cushion, 16, LEATHER, LAY);
}
