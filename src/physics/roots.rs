//! The first moment at which two bodies touch and approach.
//!
//! Not the smallest positive root, but the first time at which the gap is not positive and falls:
//! a root of a touching start may lie at −1e-18 (Bannerman, Strobl, Formella, Pöschel 2014, "Stable
//! algorithm for event detection in event-driven particle dynamics").

use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// First closing of two bodies in straight relative motion: `offset` between their points [m],
/// relative velocity [m/s], distance of contact [m]. Within `[0, horizon]`; contacts that close
/// more slowly than `slowest` [m/s] do not count.
pub fn straight(
    offset: DVec3,
    velocity: DVec3,
    distance_m: f64,
    horizon: Seconds,
    slowest: f64,
) -> Option<Seconds> {
    let b = offset.dot(velocity);
    if b >= 0.0 {
        return None;
    }
    let length = offset.length();
    // |x|² − D² as a product: no cancellation near the contact.
    let c = (length - distance_m) * (length + distance_m);
    if c <= 0.0 {
        return (-b > slowest * length).then_some(0.0);
    }
    let a = velocity.length_squared();
    let discriminant = b * b - a * c;
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    // The normal speed at the contact is √(b² − a c)/D.
    if root <= slowest * distance_m {
        return None;
    }
    let time = c / (root - b);
    (time <= horizon).then_some(time)
}

/// First closing when the relative motion is x + v τ + ½ a τ²: a quartic gap.
pub fn curved(
    offset: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
    distance_m: f64,
    horizon: Seconds,
) -> Option<Seconds> {
    let length = offset.length();
    let gap = [
        (length - distance_m) * (length + distance_m),
        2.0 * offset.dot(velocity),
        velocity.length_squared() + offset.dot(acceleration),
        velocity.dot(acceleration),
        0.25 * acceleration.length_squared(),
    ];

    // Between neighbouring critical points the gap is monotone; take the first falling stretch
    // that ends below zero.
    let derivative = [gap[1], 2.0 * gap[2], 3.0 * gap[3], 4.0 * gap[4]];
    let mut ends: SmallVec<[f64; 6]> = SmallVec::new();
    ends.push(0.0);
    roots_between(&derivative, horizon, &mut ends);
    ends.push(horizon);
    for pair in ends.windows(2) {
        let (start, end) = (pair[0], pair[1]);
        let (at_start, at_end) = (value(&gap, start), value(&gap, end));
        if at_end < 0.0 && at_end < at_start {
            return Some(if at_start <= 0.0 { start } else { bisect(&gap, start, end) });
        }
    }
    None
}

/// Appends the roots in (0, horizon) in ascending order: between the roots of the derivative a
/// polynomial is monotone, so each change of sign holds exactly one.
fn roots_between(polynomial: &[f64], horizon: f64, roots: &mut SmallVec<[f64; 6]>) {
    if polynomial.len() < 2 {
        return;
    }
    let derivative: SmallVec<[f64; 4]> =
        polynomial.iter().enumerate().skip(1).map(|(power, c)| power as f64 * c).collect();
    let mut ends: SmallVec<[f64; 6]> = SmallVec::new();
    ends.push(0.0);
    roots_between(&derivative, horizon, &mut ends);
    ends.push(horizon);
    for pair in ends.windows(2) {
        if value(polynomial, pair[0]) * value(polynomial, pair[1]) < 0.0 {
            roots.push(bisect(polynomial, pair[0], pair[1]));
        }
    }
}

/// The root in a bracket, to the last bits.
fn bisect(polynomial: &[f64], mut low: f64, mut high: f64) -> f64 {
    let rising = value(polynomial, low) < 0.0;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return low;
        }
        if (value(polynomial, middle) < 0.0) == rising { low = middle } else { high = middle }
    }
}

/// Horner's scheme; coefficients in ascending order of power.
fn value(polynomial: &[f64], x: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impacts_built_backwards_are_found() {
        let normal = DVec3::new(0.6, -0.48, 0.64);
        let tangent = DVec3::new(0.8, 0.36, -0.48);
        for (speed, slide) in [(1.0, 0.0), (1e-2, 3.0), (1e-3, 5.0), (4.0, 8.0)] {
            for time in [0.0, 1e-9, 1e-4, 3e-3] {
                let (distance, acceleration) = (0.0392, DVec3::new(80.0, -3.0, 5.0));
                let end = tangent * slide - normal * speed;
                let start = end - acceleration * time;
                let offset = normal * distance - start * time - 0.5 * acceleration * (time * time);
                let found = curved(offset, start, acceleration, distance, 4e-3);
                assert!(found.is_some_and(|t| (t - time).abs() < 1e-9), "{time} {found:?}");
                let offset = normal * distance - end * time;
                let found = straight(offset, end, distance, 4e-3, 0.0);
                assert!(found.is_some_and(|t| (t - time).abs() < 1e-9), "{time} {found:?}");
            }
        }
    }

    #[test]
    fn a_touching_start_that_parts_is_no_contact() {
        let offset = DVec3::X * 0.05;
        assert_eq!(straight(offset, DVec3::X, 0.05, 1.0, 0.0), None);
        assert_eq!(curved(offset, DVec3::X, DVec3::ZERO, 0.05, 1.0), None);
        assert_eq!(straight(offset, -DVec3::X, 0.05, 1.0, 0.0), Some(0.0));
    }
}
