//! The lamp over the table: three shades on a bar, hung from the vault.

use super::builder::{Builder, Group, Lay};
use super::finish::{BRASS, LAMP_GLASS, LAMP_TOP, SHADE, SHADE_INSIDE};
use glam::{DVec2, DVec3};

/// Lower rim of the shades above the cloth [m]; the light of the shaders comes from there.
pub const LAMP_HEIGHT_M: f64 = 1.05;
/// From the middle of one shade to that of the next, along the table [m].
pub const LAMP_PITCH_M: f64 = 0.78;
/// Radius of a shade's rim [m].
const SHADE_RADIUS_M: f64 = 0.25;
/// Radius of the glass that gives the light [m].
const GLASS_RADIUS_M: f64 = 0.19;
/// The glass hangs so much above the rim [m].
const GLASS_INSIDE_M: f64 = 0.05;
/// Height of a shade [m].
const SHADE_HEIGHT_M: f64 = 0.27;
/// The bar over the shades [m above the rim].
const BAR_M: f64 = 0.42;
/// How strong the glass shines, chosen so that the middle of the cloth of a 9-foot table gets what
/// the shaders' own lamps give it.
pub(super) const RADIANCE: f32 = 20.4;

/// The middles of the three shades [m].
pub(super) fn shades() -> [DVec2; 3] {
    [-1.0, 0.0, 1.0].map(|k| DVec2::new(k * LAMP_PITCH_M, 0.0))
}

/// The lamp; `crown` is where the vault is, above the cloth [m].
pub(super) fn build(b: &mut Builder, crown: f64) {
    b.begin(Group::Lamp);
    let lay = Lay::of(14.0);
    for shade in shades() {
        b.stand(shade.extend(LAMP_HEIGHT_M), 0.0);
        let (rim, top) = (SHADE_RADIUS_M, SHADE_HEIGHT_M);
        // A bell: steep at the rim, flat above, a brass cap.
        let bell = [
            (rim + 0.004, -0.004),
            (rim + 0.004, 0.008),
            (rim - 0.010, 0.045),
            (0.190, 0.100),
            (0.135, 0.150),
            (0.085, 0.200),
            (0.060, 0.245),
            (0.056, top),
        ];
        b.lathe(&bell, 24, SHADE, lay);
        let inside: Vec<(f64, f64)> =
            bell.iter().rev().map(|&(r, z)| ((r - 0.006_f64).max(0.0), z - 0.004)).collect();
        b.lathe(&inside, 24, SHADE_INSIDE, lay);
        b.lathe(&[(rim - 0.002, -0.008), (rim + 0.004, -0.004)], 24, BRASS, lay);
        // The glass shines downwards; what leaves the cap at the top lights the vault.
        b.lathe(&[(0.0, GLASS_INSIDE_M), (GLASS_RADIUS_M, GLASS_INSIDE_M)], 24, LAMP_GLASS, lay);
        b.lathe(&[(0.046, top + 0.006), (0.0, top + 0.006)], 12, LAMP_TOP, lay);
        b.lathe(&[(0.060, top - 0.01), (0.060, top + 0.012), (0.048, top + 0.012)], 12, BRASS, lay);
        b.rod(DVec3::new(0.0, 0.0, top), DVec3::new(0.0, 0.0, BAR_M), 0.008, BRASS, lay);
    }
    b.stand(DVec3::new(0.0, 0.0, LAMP_HEIGHT_M + BAR_M), 0.0);
    let end = LAMP_PITCH_M + 0.16;
    b.rod(DVec3::new(-end, 0.0, 0.0), DVec3::new(end, 0.0, 0.0), 0.015, BRASS, lay);
    for side in [-1.0, 1.0] {
        let x = side * 0.5 * LAMP_PITCH_M;
        let top = crown - LAMP_HEIGHT_M - BAR_M;
        b.rod(DVec3::new(x, 0.0, 0.0), DVec3::new(x, 0.0, top), 0.006, BRASS, lay);
        b.stand(DVec3::new(side * end, 0.0, LAMP_HEIGHT_M + BAR_M), 0.0);
        let knob = [(0.0, -0.03), (0.024, -0.018), (0.03, 0.0), (0.024, 0.018), (0.0, 0.03)];
        b.lathe(&knob, 10, BRASS, lay);
        b.stand(DVec3::new(x, 0.0, crown - 0.05), 0.0);
        b.lathe(&[(0.0, 0.0), (0.05, 0.02), (0.06, 0.06)], 10, BRASS, lay);
        b.stand(DVec3::new(0.0, 0.0, LAMP_HEIGHT_M + BAR_M), 0.0);
    }
}

/// How much of the lamp an eye sees: 1, or less where it would cover the table, down to 0.
///
/// A shade covers a table where the line from the eye through it meets the bed, whose half length
/// and width are `half` [m]; within a hand's breadth round the rails it fades.
pub fn lamp_opacity(eye: DVec3, half: DVec2) -> f64 {
    let low = LAMP_HEIGHT_M - 0.01;
    if eye.z <= low {
        return 1.0;
    }
    let mut opacity: f64 = 1.0;
    for shade in shades() {
        // The nearest and the farthest point of the rim, and its sides.
        let away = (shade - eye.truncate()).normalize_or(DVec2::X);
        for aside in [away, -away, away.perp(), -away.perp(), DVec2::ZERO] {
            let rim = (shade + aside * SHADE_RADIUS_M).extend(low);
            let far = eye.z / (eye.z - rim.z);
            let hit = eye + (rim - eye) * far;
            let beyond = (hit.truncate().abs() - half).max_element();
            opacity = opacity.min((beyond - 0.1) / 0.5);
        }
    }
    opacity.clamp(0.0, 1.0)
}
