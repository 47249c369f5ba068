//! Sound pressure and its levels.

/// What 0 dB SPL means: about the threshold of hearing [Pa] (ISO 1683).
pub const REFERENCE_PA: f32 = 20e-6;

/// The pressure that a sample of 1.0 stands for [Pa]: 124 dB SPL, the click of a hard break at 1 m,
/// is -3 dB of it.
pub const FULL_SCALE_PA: f32 = 44.77;

/// The factor on a pressure that is `db` decibels.
pub fn factor(db: f32) -> f32 {
    libm::exp10f(db / 20.0)
}

/// The pressure of a level in dB SPL [Pa].
pub fn pascal(level_db: f32) -> f32 {
    REFERENCE_PA * factor(level_db)
}

/// The level of a pressure, in dB SPL; minus infinity for silence.
pub fn decibels(pressure_pa: f32) -> f32 {
    20.0 * libm::log10f(pressure_pa.abs() / REFERENCE_PA)
}
