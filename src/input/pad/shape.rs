//! What a stick says without its dead zone, and finer near the middle.

use glam::DVec2;

/// A stick that is let go rests this near to the middle [share of its way]: what is nearer is the
/// middle. Sticks that have been used for years rest up to 0.1 away.
pub const DEAD_ZONE: f64 = 0.15;

/// Right and up without the dead zone, along a curve; its length is 0 to 1.
///
/// With the length r of `at`, at most 1, and `s = (r − DEAD_ZONE) / (1 − DEAD_ZONE)`, the result
/// has the length `(s + 2 s³) / 3`: a third of the slope at the middle, all of the way at the end.
/// The dead zone is round, so that no direction is drawn to an axis.
///
/// Limits: 0 within the dead zone, and for what is no number; 1 at the rim and beyond it.
pub fn shaped(at: DVec2) -> DVec2 {
    let length = at.length();
    if !(DEAD_ZONE < length && length.is_finite()) {
        return DVec2::ZERO;
    }
    let share = (length.min(1.0) - DEAD_ZONE) / (1.0 - DEAD_ZONE);
    at / length * ((share + 2.0 * share * share * share) / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stick_is_still_in_the_middle_and_full_at_the_rim() {
        assert_eq!(shaped(DVec2::new(0.1, -0.1)), DVec2::ZERO);
        assert_eq!(shaped(DVec2::new(f64::NAN, 0.0)), DVec2::ZERO);
        assert_eq!(shaped(DVec2::new(f64::INFINITY, 0.0)), DVec2::ZERO);
        assert!((shaped(DVec2::new(0.0, -1.0)) - DVec2::NEG_Y).length() < 1e-12);
        assert!((shaped(DVec2::new(3.0, 4.0)).length() - 1.0).abs() < 1e-12);
        let lengths: Vec<f64> = (0..=100)
            .map(|n| shaped(DVec2::from_angle(1.0) * f64::from(n) / 100.0).length())
            .collect();
        assert!(lengths.is_sorted());
        // No step where the dead zone ends.
        assert!(lengths.windows(2).all(|pair| pair[1] - pair[0] < 0.04), "{lengths:?}");
    }
}
