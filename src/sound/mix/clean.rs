//! What sounds, made safe to be mixed.

/// Louder than any explosion [Pa]: whatever says so is wrong.
const PRESSURE_MAX_PA: f32 = 1e6;
/// Softer than anything heard by a factor of a million [Pa].
const PRESSURE_MIN_PA: f32 = 1e-11;

/// Takes out NaN, infinities and the numbers that are slow to reckon with: filters and delay lines
/// would keep them.
pub fn clean(samples: &mut [f32]) {
    for x in samples {
        *x = if (PRESSURE_MIN_PA..PRESSURE_MAX_PA).contains(&x.abs()) { *x } else { 0.0 };
    }
}
