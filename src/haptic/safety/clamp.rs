//! Stage 7: no force above the greatest. This is the only place that knows it; what comes after
//! makes the force smaller.

use glam::DVec3;

/// `wanted` with its direction and at most `limit_n` [N], and whether that is less.
pub(super) fn clamped(wanted: DVec3, limit_n: f64) -> (DVec3, bool) {
    let is_over = wanted.length() > limit_n;
    if !is_over {
        return (wanted, false);
    }
    // Rounding may leave the length an ulp above the limit.
    let clamped = wanted * (limit_n / wanted.length() * (1.0 - 1e-15));
    (clamped, true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_direction_stays_and_the_size_is_at_most_the_limit() {
        let mut size: f64 = 1e-6;
        while size < 1e9 {
            let wanted = DVec3::new(3.0, -4.0, 12.0) / 13.0 * size;
            let (force, is_over) = clamped(wanted, 3.3);
            assert!(force.length() <= 3.3);
            assert_eq!(is_over, size > 3.3);
            assert!(force.normalize().dot(wanted.normalize()) > 1.0 - 1e-12);
            size *= 1.37;
        }
        assert_eq!(clamped(DVec3::X * 2.0, 3.3), (DVec3::X * 2.0, false));
        assert_eq!(clamped(DVec3::X * 1e9, f64::INFINITY), (DVec3::X * 1e9, false));
    }
}
