//! Textures that are computed: numbers, the nap of the cloth, the grain of wood.

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};
use hapticbillard::noise::{between, lattice};
use three_d::egui::FontDefinitions;
use three_d::*;

/// Side of the texture of scratches [pixels].
const SCRATCH_SIDE: u32 = 512;
/// Side of the textures of cloth and wood [pixels].
const GRAIN_SIDE: u32 = 512;

fn texture(name: &str, side: u32, data: Vec<u8>) -> CpuTexture {
    CpuTexture {
        name: name.to_string(),
        data: TextureData::RU8(data),
        width: side,
        height: side,
        min_filter: Interpolation::Linear,
        mag_filter: Interpolation::Linear,
        mipmap: Some(Mipmap::default()),
        wrap_s: Wrapping::Repeat,
        wrap_t: Wrapping::Repeat,
    }
}

/// The numbers 1 to 15, one layer each, ink on nothing, as many pixels wide as high.
pub fn digits(context: &Context, side: u32) -> Texture2DArray {
    let layers: Vec<CpuTexture> = (1..=15)
        .map(|number| {
            let edge = Wrapping::ClampToEdge;
            let plain = texture("number", side, number_layer(number, side));
            CpuTexture { wrap_s: edge, wrap_t: edge, ..plain }
        })
        .collect();
    Texture2DArray::new(context, &layers.iter().collect::<Vec<_>>())
}

/// One number in the middle of a square of this side, rows from the top; 6 and 9 are underlined.
pub fn number_layer(number: u16, side: u32) -> Vec<u8> {
    let wide = side as usize;
    let mut ink = vec![0.0f32; wide * wide];
    let fonts = FontDefinitions::default();
    // The font comes with the library of the head-up display; without it balls have no numbers.
    let bytes = fonts.font_data.get("Hack").map(|data| data.font.to_vec()).unwrap_or_default();
    let Ok(font) = FontRef::try_from_slice(&bytes) else { return vec![0; wide * wide] };
    // Lengths are those of a square of 128.
    let unit = side as f32 / 128.0;
    let text = number.to_string();
    let (width, height) = if text.len() == 1 { (110.0, 100.0) } else { (80.0, 84.0) };
    let scale = PxScale { x: width * unit, y: height * unit };
    let scaled = font.as_scaled(scale);
    let advance: f32 = text.chars().map(|c| scaled.h_advance(font.glyph_id(c))).sum();
    let mut x = 0.5 * (side as f32 - advance);
    // Digits have no descender: their middle lies half a capital above the base line.
    let base = 0.5 * side as f32 + 0.315 * height * unit;
    for c in text.chars() {
        let id = font.glyph_id(c);
        // Several times, a little apart: a bolder stroke than the font has.
        for shift in [-2.2f32, -1.1, 0.0, 1.1, 2.2] {
            let at = point(x + shift * unit, base);
            let glyph: Glyph = id.with_scale_and_position(scale, at);
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let bounds = outline.px_bounds();
            outline.draw(|gx, gy, coverage| {
                let (px, py) = (gx as i32 + bounds.min.x as i32, gy as i32 + bounds.min.y as i32);
                if (0..side as i32).contains(&px) && (0..side as i32).contains(&py) {
                    let at = &mut ink[py as usize * wide + px as usize];
                    *at = at.max(coverage);
                }
            });
        }
        x += scaled.h_advance(id);
    }
    if matches!(number, 6 | 9) {
        let half = (22.0 * unit) as usize;
        for y in (base + 8.0 * unit) as usize..(base + 15.0 * unit) as usize {
            ink[y * wide + wide / 2 - half..y * wide + wide / 2 + half].fill(1.0);
        }
    }
    ink.iter().map(|ink| (ink * 255.0) as u8).collect()
}

/// Fine scratches as slopes: red to the right, green up, nothing in the middle. Most are arcs, as
/// balls get them from each other and from the cloth.
pub fn scratches(context: &Context) -> Texture2D {
    const COUNT: i64 = 130;
    let side = SCRATCH_SIDE as usize;
    let mut slopes = vec![[0.0f64; 2]; side * side];
    for n in 0..COUNT {
        let chance = |what: i64| lattice(n, what);
        let (x, y) = (chance(1) * side as f64, chance(2) * side as f64);
        let (heading, bend) = (chance(3) * std::f64::consts::TAU, 0.02 * (chance(4) - 0.5));
        let length = 20.0 + 160.0 * chance(5) * chance(5);
        let deep = 0.15 + 0.85 * chance(6) * chance(6);
        let (mut x, mut y, mut heading) = (x, y, heading);
        for step in 0..(2.0 * length) as usize {
            let (sin, cos) = libm::sincos(heading);
            // Deepest in the middle; both its flanks look away from it.
            let along = step as f64 / (2.0 * length);
            let depth = deep * (1.0 - (2.0 * along - 1.0) * (2.0 * along - 1.0));
            for (aside, slope) in [(-1.0, 1.0), (-0.5, 0.7), (0.5, -0.7), (1.0, -1.0)] {
                let (px, py) = (x - sin * aside, y + cos * aside);
                let at = py.rem_euclid(side as f64) as usize * side
                    + px.rem_euclid(side as f64) as usize;
                slopes[at.min(side * side - 1)] = [-sin * slope * depth, cos * slope * depth];
            }
            (x, y, heading) = (x + 0.5 * cos, y + 0.5 * sin, heading + 0.5 * bend);
        }
    }
    let byte = |slope: f64| ((0.5 + 0.5 * slope) * 255.0).round() as u8;
    let data = slopes.iter().map(|slope| slope.map(byte)).collect();
    let plain = texture("scratches", SCRATCH_SIDE, Vec::new());
    Texture2D::new(context, &CpuTexture { data: TextureData::RgU8(data), ..plain })
}

/// Smooth noise that repeats after `period` cells.
fn noise(x: f64, y: f64, period: i64) -> f64 {
    between(x, y, |i, j| lattice(i.rem_euclid(period), j.rem_euclid(period)))
}

fn grain(context: &Context, name: &str, at: impl Fn(f64, f64) -> f64) -> Texture2D {
    let side = f64::from(GRAIN_SIDE);
    let data = (0..GRAIN_SIDE * GRAIN_SIDE).map(|i| {
        let (x, y) = (f64::from(i % GRAIN_SIDE) / side, f64::from(i / GRAIN_SIDE) / side);
        (at(x, y).clamp(0.0, 1.0) * 255.0) as u8
    });
    Texture2D::new(context, &texture(name, GRAIN_SIDE, data.collect()))
}

/// The nap of worsted cloth.
pub fn nap(context: &Context) -> Texture2D {
    grain(context, "nap", |x, y| {
        let fine = noise(x * 256.0, y * 256.0, 256);
        let fibre = noise(x * 64.0, y * 200.0, 200);
        let patch = noise(x * 8.0, y * 8.0, 8);
        0.5 * fine + 0.25 * fibre + 0.25 * patch
    })
}

/// The grain of wood, along u.
pub fn wood(context: &Context) -> Texture2D {
    grain(context, "wood", |x, y| {
        let bend = 0.10 * noise(x * 2.0, y * 4.0, 4) + 0.02 * noise(x * 8.0, y * 16.0, 16);
        // Year by year: light in spring, darker and darker to a hard edge.
        let year = (8.0 * (y + bend)).rem_euclid(1.0);
        let rings = (1.0 - year * year) * (year * 12.0).min(1.0);
        let pores = noise(x * 8.0, y * 256.0, 256);
        let tone = noise(x * 3.0, y * 9.0, 9);
        0.42 * rings + 0.33 * pores + 0.25 * tone
    })
}
