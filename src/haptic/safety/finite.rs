//! Stage 1: a number that is none becomes no force.

use glam::DVec3;

/// `force`, or zero if a component is none. The second value says which it was.
pub(super) fn checked(force: DVec3) -> (DVec3, bool) {
    if force.is_finite() { (force, true) } else { (DVec3::ZERO, false) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_component_that_is_no_number_makes_the_whole_force_zero() {
        assert_eq!(checked(DVec3::new(1.0, -2.0, 3.0)), (DVec3::new(1.0, -2.0, 3.0), true));
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for i in 0..3 {
                let mut force = DVec3::ONE;
                force[i] = bad;
                assert_eq!(checked(force), (DVec3::ZERO, false));
            }
        }
    }
}
