//! The first moment at which two things touch and close, for quadratic paths.
//!
//! Not the smallest positive root: rounding puts the root of a touching start at −1e-18 as often as
//! not. The event is the first time at which the gap is not positive and falls (Bannerman, Strobl,
//! Formella, Pöschel 2014). A contact that closes too slowly to be an impact counts only once it
//! has pressed in a little, so two things that lie together do not collide for ever.

use crate::physics::tolerance;
use crate::units::Seconds;
use glam::DVec3;

/// A contact grazes if no more than this share of the squared speed closes.
const GRAZES: f64 = 1e-4;

/// Relative motion of two points: x + v τ + ½ a τ².
#[derive(Debug, Clone, Copy)]
pub struct Relative {
    /// x [m].
    pub offset: DVec3,
    /// v [m/s].
    pub velocity: DVec3,
    /// a [m/s²].
    pub acceleration: DVec3,
}

/// When the distance of two points first closes to `distance_m`, within `[0, horizon]`.
pub fn spheres(motion: &Relative, distance_m: f64, horizon: Seconds) -> Option<Seconds> {
    let Relative { offset: x, velocity: v, acceleration: a } = *motion;
    let (xx, xv, vv) = (x.length_squared(), x.dot(v), v.length_squared());
    let (xa, va, aa) = (x.dot(a), v.dot(a), a.length_squared());

    // Most pairs stay apart, and this is how to see it without a root.
    let rounding = 1e-12 * xx;
    let start = xx - distance_m * distance_m;
    let polynomial = [start, 2.0 * xv, vv + xa, va, 0.25 * aa];
    if start > rounding && bernstein(&polynomial, horizon).iter().all(|b| *b > rounding) {
        return None;
    }
    let length = xx.sqrt();

    // Out of reach?
    let gap = length - distance_m;
    let reach = if aa == 0.0 {
        vv.sqrt() * horizon
    } else {
        (vv.sqrt() + 0.5 * aa.sqrt() * horizon) * horizon
    };
    // The horizon may be infinite and the speed zero.
    if gap > reach || vv == 0.0 && aa == 0.0 {
        return None;
    }

    let polynomial = |distance: f64| {
        let c0 = (length - distance) * (length + distance);
        [c0, 2.0 * xv, vv + xa, va, 0.25 * aa]
    };
    let exact = polynomial(distance_m);
    let time = first_falling(&exact, horizon)?;
    let speed = -slope(&exact, time) / (2.0 * distance_m);
    if speed >= tolerance::STRUCK_M_S {
        let grazes = speed * speed < GRAZES * (v + a * time).length_squared();
        return Some(if grazes { polished(motion, distance_m, time, horizon) } else { time });
    }
    // Lying together, or grazing: it counts when it has pressed in. What lies on top of the other
    // is not put aside then, and would sink from multiple to multiple.
    let level = x.z * x.z <= 0.75 * xx;
    let pressed = if level { next_press_m(-gap) } else { tolerance::PRESS_M };
    first_falling(&polynomial(distance_m - pressed), horizon)
}

/// The time of a grazing contact, put right from the place where it was found.
///
/// With cos θ the share of the speed that closes, the distance beyond contact D cos θ follows from
/// D² cos² θ, which far from contact is the difference of squares of the whole way: its rounding is
/// that of |x|², and cos θ is wrong by some ε |x|²/(D² cos² θ). At the contact itself the gap is
/// (|x| − D)(|x| + D), with the rounding of D alone. What is left is that of the places: ε/cos² θ,
/// 1e-8 for balls that overlap by 1e-8 of their distance when they pass, and no formula helps.
fn polished(motion: &Relative, distance_m: f64, time: Seconds, horizon: Seconds) -> Seconds {
    let Relative { offset, velocity, acceleration } = *motion;
    let there = offset + (velocity + acceleration * (0.5 * time)) * time;
    let slope = 2.0 * there.dot(velocity + acceleration * time);
    let length = there.length();
    let better = time - (length - distance_m) * (length + distance_m) / slope;
    if slope < 0.0 && 0.0 <= better && better <= horizon { better } else { time }
}

/// When a height h + v τ + ½ a τ² above a surface first falls to zero, within `[0, horizon]`.
pub fn height(h: f64, v: f64, a: f64, horizon: Seconds) -> Option<Seconds> {
    let time = falling_quadratic(h, v, a, horizon)?;
    if -(v + a * time) >= tolerance::STRUCK_M_S {
        return Some(time);
    }
    falling_quadratic(h + tolerance::PRESS_M, v, a, horizon)
}

/// The overlap at which balls that overlap by `depth_m` count as pressed in: the next multiple of a
/// press. One that they have passed already would count at this moment, and so for ever; one from
/// where they are now would move with each new prediction, and they would creep into each other.
fn next_press_m(depth_m: f64) -> f64 {
    // A meeting at a multiple leaves them beside it by rounding.
    let passed = (depth_m.max(0.0) / tolerance::PRESS_M + 1e-3).floor();
    (passed + 1.0) * tolerance::PRESS_M
}

/// First time in `[0, horizon]` at which h + v τ + ½ a τ² is not positive and falls.
#[inline]
pub fn falling_quadratic(h: f64, v: f64, a: f64, horizon: Seconds) -> Option<Seconds> {
    if h <= 0.0 && (v < 0.0 || v == 0.0 && a < 0.0) {
        return Some(0.0);
    }
    if h <= 0.0 {
        // Below but rising; it may turn and fall again only if it is pulled down.
        if a >= 0.0 {
            return None;
        }
        let turn = -v / a;
        let top = h + 0.5 * v * turn;
        let time = if top <= 0.0 { turn } else { turn + (2.0 * top / -a).sqrt() };
        return (time <= horizon).then_some(time);
    }
    if v >= 0.0 && a >= 0.0 {
        return None;
    }
    let discriminant = v * v - 2.0 * a * h;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    // Of the two roots, the one at which it falls: the sum without cancellation.
    let time = if v <= 0.0 { 2.0 * h / (root - v) } else { (v + root) / -a };
    (time <= horizon).then_some(time)
}

/// First time in `[0, horizon]` at which a quartic is not positive and falls.
///
/// Bernstein coefficients rule most out; else the critical points cut the range into stretches on
/// which it is monotone.
fn first_falling(c: &[f64; 5], horizon: Seconds) -> Option<Seconds> {
    if c[3] == 0.0 && c[4] == 0.0 {
        return falling_quadratic(c[0], c[1], 2.0 * c[2], horizon);
    }
    let t = horizon;
    if c[0] > 0.0 && bernstein(c, t).iter().all(|b| *b > 0.0) {
        return None;
    }

    let mut ends = Ends::new();
    cubic_roots(&[c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4]], horizon, &mut ends);
    let mut start = 0.0;
    let mut at_start = c[0];
    for end in ends.iter().chain([horizon]) {
        let at_end = value(c, end);
        if at_end < 0.0 && at_end < at_start {
            return Some(if at_start <= 0.0 { start } else { root(c, start, end) });
        }
        (start, at_start) = (end, at_end);
    }
    None
}

/// All but the first of the Bernstein coefficients of a quartic on `[0, t]`: where they are
/// positive, it is.
fn bernstein(c: &[f64; 5], t: Seconds) -> [f64; 4] {
    let (a, b, d) = (c[1] * t, c[2] * t * t, c[3] * t * t * t);
    [
        c[0] + 0.25 * a,
        c[0] + 0.5 * a + b / 6.0,
        c[0] + 0.75 * a + 0.5 * b + 0.25 * d,
        c[0] + a + b + d + c[4] * t * t * t * t,
    ]
}

/// At most three numbers, without a heap.
struct Ends {
    list: [f64; 3],
    count: usize,
}

impl Ends {
    fn new() -> Self {
        Ends { list: [0.0; 3], count: 0 }
    }

    fn push(&mut self, x: f64) {
        self.list[self.count] = x;
        self.count += 1;
    }

    fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.list[..self.count].iter().copied()
    }
}

/// Appends the roots of a cubic in (0, horizon), ascending: one at most between neighbouring
/// critical points.
fn cubic_roots(c: &[f64; 4], horizon: f64, ends: &mut Ends) {
    let mut start = 0.0;
    let mut at_start = c[0];
    // Critical points: 3 c3 x² + 2 c2 x + c1.
    let (a, half_b, k) = (3.0 * c[3], c[2], c[1]);
    let discriminant = half_b * half_b - a * k;
    let mut turns = [f64::INFINITY; 2];
    if discriminant > 0.0 {
        let q = -(half_b + discriminant.sqrt().copysign(half_b));
        let pair = if a != 0.0 { [q / a, k / q] } else { [k / q, f64::INFINITY] };
        turns = if pair[0] <= pair[1] { pair } else { [pair[1], pair[0]] };
    }
    let inside = turns.into_iter().filter(|x| 0.0 < *x && *x < horizon);
    for end in inside.chain([horizon]) {
        let at_end = value(c, end);
        if at_start * at_end < 0.0 {
            ends.push(root(c, start, end));
        } else if at_end == 0.0 && end < horizon {
            ends.push(end);
        }
        (start, at_start) = (end, at_end);
    }
}

/// The root in a bracket where the ends differ in sign: Newton's method, kept inside by bisection.
fn root<const N: usize>(c: &[f64; N], mut low: f64, mut high: f64) -> f64 {
    let rising = value(c, low) < 0.0;
    let mut x = 0.5 * (low + high);
    for _ in 0..80 {
        let (mut y, mut dy) = (0.0, 0.0);
        for k in c.iter().rev() {
            dy = dy * x + y;
            y = y * x + k;
        }
        if (y < 0.0) == rising {
            low = x;
        } else {
            high = x;
        }
        if y == 0.0 {
            return x;
        }
        let newton = x - y / dy;
        let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * f64::EPSILON * x.abs() {
            return next;
        }
        x = next;
    }
    x
}

fn slope(c: &[f64; 5], x: f64) -> f64 {
    c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * 4.0 * c[4]))
}

/// Horner's scheme; coefficients in ascending order of power.
fn value(c: &[f64], x: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, k| sum * x + k)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    fn vector(random: &mut Pcg64, size: f64) -> DVec3 {
        let mut one = || random.random_range(-size..size);
        DVec3::new(one(), one(), one())
    }

    /// Impacts that are built backwards from the contact, and their time.
    fn built(random: &mut Pcg64, closing: f64, distance: f64) -> (Relative, f64) {
        let normal = vector(random, 1.0).normalize();
        let tangent = vector(random, 1.0).cross(normal).normalize();
        let end = tangent * random.random_range(0.1..8.0) - normal * closing;
        let acceleration = vector(random, 4.0);
        let time: f64 = random.random_range(0.001..0.4);
        let velocity = end - acceleration * time;
        let offset = normal * distance - velocity * time - acceleration * (0.5 * time * time);
        (Relative { offset, velocity, acceleration }, time)
    }

    #[test]
    fn every_impact_built_backwards_is_found_or_preceded_by_another() {
        let mut random = Pcg64::seed_from_u64(1);
        let distance = 0.05715;
        for closing in [1.0, 1e-2, 1e-3, 1e-4] {
            for case in 0..5_000 {
                let (motion, time) = built(&mut random, closing, distance);
                if motion.offset.length() < distance {
                    continue;
                }
                let found = spheres(&motion, distance, 1.0);
                let found = found.unwrap_or_else(|| panic!("{closing} {case} {time}"));
                assert!(found <= time + 1e-6, "{closing} {case}: {found} {time}");
                let at = motion.offset
                    + motion.velocity * found
                    + motion.acceleration * (0.5 * found * found);
                assert!((at.length() - distance).abs() < 1e-11, "{closing} {case}");
            }
        }
    }

    #[test]
    fn touching_starts_that_close_count_at_once_and_others_never() {
        let mut random = Pcg64::seed_from_u64(2);
        let distance = 0.05715;
        for _ in 0..20_000 {
            let normal = vector(&mut random, 1.0).normalize();
            let tangent = vector(&mut random, 1.0).cross(normal) * 3.0;
            let acceleration = vector(&mut random, 2.0);
            let start = |speed: f64| Relative {
                offset: normal * distance,
                velocity: tangent + normal * speed,
                acceleration,
            };
            for closing in [-1.0, -1e-4] {
                let found = spheres(&start(closing), distance, 0.1);
                // Curvature may part them before rounding lets the gap be seen as closed.
                assert!(found.is_some_and(|t| t < 1e-9) || closing == -1e-4, "{found:?}");
            }
            assert!(spheres(&start(1.0), distance, 1e-3).is_none());
        }
    }

    #[test]
    fn a_graze_is_as_exact_as_the_places_allow() {
        // Passing at D (1 - s), cos² θ = s (2 - s); the places are known to 1e-16 of D.
        let distance = 0.05715;
        for share in [1e-5_f64, 1e-6, 1e-7, 1e-8, 1e-9] {
            for from in [0.1, 0.5, 2.0] {
                let aside = distance * (1.0 - share);
                let gone = aside / distance;
                let cosine = ((1.0 - gone) * (1.0 + gone)).sqrt();
                for acceleration in [DVec3::ZERO, DVec3::X] {
                    let motion = Relative {
                        offset: DVec3::new(-from, aside, 0.0),
                        velocity: DVec3::X,
                        acceleration,
                    };
                    let time = spheres(&motion, distance, 9.0).expect("they touch");
                    let left = from - (1.0 + 0.5 * acceleration.x * time) * time;
                    let off = left / (distance * cosine) - 1.0;
                    assert!(off.abs() < 4e-16 / share + 1e-11, "{share} {from}: {off}");
                }
            }
        }
    }

    #[test]
    fn heights_fall_once_they_are_pulled_down() {
        assert_eq!(height(1.0, 0.0, 0.0, 9.0), None);
        let time = height(1.0, 0.0, -2.0, 9.0);
        assert!(time.is_some_and(|t| (t - 1.0).abs() < 1e-15));
        let hop = height(0.0, 1.0, -10.0, 9.0);
        assert!(hop.is_some_and(|t| (t - 0.2).abs() < 1e-15), "{hop:?}");
        assert_eq!(height(0.0, -1.0, 0.0, 9.0), Some(0.0));
        // Lying and pressed: it counts when it has pressed in.
        let pressed = height(0.0, 0.0, -2.0, 9.0);
        assert!(pressed.is_some_and(|t| (t - tolerance::PRESS_M.sqrt()).abs() < 1e-12));
    }
}
