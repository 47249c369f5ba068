//! Numbers and smooth noise for places: what textures and grains are computed from.

/// A number from 0 to 1 for a place of a lattice.
pub fn lattice(x: i64, y: i64) -> f64 {
    let (x, y) = (x as u64, y as u64);
    let mut z = x.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ y.wrapping_mul(0xc2b2_ae3d_27d4_eb4f);
    z = (z ^ (z >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 32)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// What lies smoothly between the values that `at` gives the places of a lattice.
pub fn between(x: f64, y: f64, at: impl Fn(i64, i64) -> f64) -> f64 {
    let (i, j) = (x.floor(), y.floor());
    let ease = |t: f64| t * t * (3.0 - 2.0 * t);
    let (a, b) = (ease(x - i), ease(y - j));
    let at = |right: i64, up: i64| at(i as i64 + right, j as i64 + up);
    let low = at(0, 0) + (at(1, 0) - at(0, 0)) * a;
    let high = at(0, 1) + (at(1, 1) - at(0, 1)) * a;
    low + (high - low) * b
}
