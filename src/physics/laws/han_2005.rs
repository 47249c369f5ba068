//! Restitution of a cushion that depends on the speed into it.

/// e(v) = 0.39 + 0.257 v − 0.044 v², v the speed into the cushion [m/s].
///
/// Han, Dynamics in carom and three cushion billiards, J. Mech. Sci. Technol. 19 (2005) 976,
/// eq. 26 (second-hand transcription). Limits: a fit to carom cushions up to about 3 m/s; it has
/// its maximum at 2.92 m/s and would turn negative above 7 m/s, so from the maximum on it is held
/// there. The impact itself is Coulomb's, at cushion and bed ([`super::cushion`]); Han's own planar
/// equations leave the bed out.
pub fn restitution(speed_into_m_s: f64) -> f64 {
    const LINEAR: f64 = 0.257;
    const SQUARE: f64 = 0.044;
    let v = speed_into_m_s.clamp(0.0, LINEAR / (2.0 * SQUARE));
    0.39 + LINEAR * v - SQUARE * v * v
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_to_its_maximum_and_stays_there() {
        assert!((restitution(1.0) - 0.603).abs() < 1e-15);
        assert!((restitution(2.5) - 0.7575).abs() < 1e-15);
        assert!(restitution(2.9) < restitution(3.0));
        assert_eq!(restitution(3.0), restitution(30.0));
        assert!(restitution(30.0) < 1.0);
    }
}
