//! Where a ball may come into a pocket.

use super::Position;
use super::way::{Window, gaps};
use crate::ai::geometry::{signed_angle, turned};
use crate::ids::BallId;
use crate::table::Pocket;
use glam::DVec2;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// How near a ball's middle may come to a nose tip, over its radius: by the entry angle [°], to the
/// near tip, which it passes first, and to the far one. A tip that is touched a little still lets
/// the ball in; along a rail it may be led in by the rubber.
///
/// Measured with rolling balls that arrive at 0.6 and 1.5 m/s from 0.3 and 0.8 m, pool-9ft and
/// snooker-12ft alike. A ball at 3 m/s needs a narrower way, and may leap back out of the pocket.
const CORNER_TIPS: &[(f64, f64, f64)] = &[
    (0.0, 0.84, 0.84),
    (10.0, 0.87, 0.79),
    (20.0, 0.90, 0.765),
    (30.0, 0.75, 0.70),
    (36.0, 0.20, 0.68),
    (40.0, -0.25, 0.80),
    (44.0, -0.60, 0.90),
];
/// The same for side pockets with mouths as wide as pool's.
const WIDE_SIDE_TIPS: &[(f64, f64, f64)] = &[
    (0.0, 0.79, 0.79),
    (10.0, 0.825, 0.73),
    (20.0, 0.87, 0.68),
    (30.0, 0.91, 0.62),
    (40.0, 0.93, 0.66),
    (48.0, 0.956, 0.81),
    (56.0, 0.97, 0.89),
];
/// The same for side pockets as narrow as snooker's.
const NARROW_SIDE_TIPS: &[(f64, f64, f64)] = &[
    (0.0, 0.785, 0.785),
    (10.0, 0.82, 0.765),
    (20.0, 0.86, 0.74),
    (30.0, 0.89, 0.84),
    (35.0, 0.895, 0.95),
    (48.0, 0.915, 1.03),
    (56.0, 0.935, 1.095),
];
/// Mouth over ball's diameter between narrow and wide side pockets: pool's is 2.25, snooker's 2.06.
const WIDE_SIDE: f64 = 2.15;
/// Largest angle between a ball's way and a corner pocket's heading [rad].
const ENTRY_CORNER_RAD: f64 = 54.0 * DEGREE;
/// The same for a side pocket.
const ENTRY_SIDE_RAD: f64 = 62.0 * DEGREE;

/// Directions in which a ball comes into a pocket.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Where the middle of the directions leads to [m].
    pub(super) target: DVec2,
    /// To there; unit vector.
    pub(super) way: DVec2,
    /// How far the way may turn.
    pub(super) window: Window,
}

impl Entry {
    /// The same gap with an aim that is turned by `angle_rad` off its middle.
    pub(super) fn aimed(&self, from: DVec2, angle_rad: f64) -> Entry {
        let way = turned(self.way, angle_rad);
        let target = from + way * from.distance(self.target);
        Entry { target, way, window: self.window.seen_from(angle_rad) }
    }
}

/// All gaps through which a ball at `from` can come into a pocket; `ignored` balls do not count.
pub(super) fn entries(
    position: &Position<'_>,
    from: DVec2,
    pocket: &Pocket,
    ignored: &[BallId],
) -> Vec<Entry> {
    let radius = position.radius();
    let in_jaws = (pocket.target() - from).dot(pocket.heading) < radius;
    let middle = if in_jaws { pocket.centre } else { pocket.target() };
    let Some(unit) = (middle - from).try_normalize() else { return Vec::new() };
    let length_m = from.distance(middle);
    let whole = if in_jaws {
        let half = libm::atan2(0.8 * pocket.radius_m, length_m.max(radius));
        Window { right: -half, left: half }
    } else {
        let limit = if pocket.id.is_side() { ENTRY_SIDE_RAD } else { ENTRY_CORNER_RAD };
        let entry_rad = signed_angle(pocket.heading, unit);
        if entry_rad.abs() > limit {
            return Vec::new();
        }
        between_tips(from, unit, pocket, entry_rad, radius)
    };
    gaps(position, from, unit, length_m + radius, whole, ignored)
        .into_iter()
        .map(|gap| {
            let way = turned(unit, gap.middle());
            Entry { target: from + way * length_m, way, window: gap.seen_from(gap.middle()) }
        })
        .collect()
}

/// Directions, seen from `unit`, in which a ball of this radius passes between the nose tips.
fn between_tips(from: DVec2, unit: DVec2, pocket: &Pocket, entry_rad: f64, radius: f64) -> Window {
    let (near, far) = tips(pocket, entry_rad.abs() / DEGREE, radius);
    // A way that is turned to the left of the heading comes from the right.
    let (right, left) = if entry_rad > 0.0 { (near, far) } else { (far, near) };
    let mut window = Window::OPEN;
    for tip in pocket.mouth {
        let to_tip = tip - from;
        let angle = signed_angle(unit, to_tip);
        let half = |share: f64| libm::asin((share * radius / to_tip.length()).clamp(-1.0, 1.0));
        if angle > 0.0 {
            window.left = window.left.min(angle - half(left));
        } else {
            window.right = window.right.max(angle + half(right));
        }
    }
    window
}

/// How near the tips may be, over the ball's radius: the near and the far one.
fn tips(pocket: &Pocket, entry_deg: f64, radius: f64) -> (f64, f64) {
    let mouth = pocket.mouth[0].distance(pocket.mouth[1]) / (2.0 * radius);
    let table = match pocket.id.is_side() {
        false => CORNER_TIPS,
        true if mouth < WIDE_SIDE => NARROW_SIDE_TIPS,
        true => WIDE_SIDE_TIPS,
    };
    let after = table.partition_point(|row| row.0 <= entry_deg).clamp(1, table.len() - 1);
    let ((x0, near0, far0), (x1, near1, far1)) = (table[after - 1], table[after]);
    let share = ((entry_deg - x0) / (x1 - x0)).min(1.0);
    (near0 + share * (near1 - near0), far0 + share * (far1 - far0))
}
