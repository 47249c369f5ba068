//! Where a ball may come into a pocket.

use super::Position;
use super::way::{Window, gaps};
use crate::ai::geometry::{signed_angle, turned};
use crate::table::Pocket;
use glam::DVec2;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// How near a ball's middle may come to the nose tips, over its radius: a tip that is touched a
/// little still lets the ball in.
const CORNER_TIP: f64 = 0.85;
/// The same for side pockets.
const SIDE_TIP: f64 = 0.85;
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
    ignored: &[crate::ids::BallId],
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
        let (entry_limit, tip) = if pocket.id.is_side() {
            (ENTRY_SIDE_RAD, SIDE_TIP)
        } else {
            (ENTRY_CORNER_RAD, CORNER_TIP)
        };
        if signed_angle(pocket.heading, unit).abs() > entry_limit {
            return Vec::new();
        }
        between_tips(from, unit, pocket, tip * radius)
    };
    gaps(position, from, unit, length_m + radius, whole, ignored)
        .into_iter()
        .map(|gap| {
            let way = turned(unit, gap.middle());
            Entry { target: from + way * length_m, way, window: gap.seen_from(gap.middle()) }
        })
        .collect()
}

/// Directions, seen from `unit`, in which a ball passes both nose tips no nearer than `near_m`.
fn between_tips(from: DVec2, unit: DVec2, pocket: &Pocket, near_m: f64) -> Window {
    let mut window = Window::OPEN;
    for tip in pocket.mouth {
        let to_tip = tip - from;
        let angle = signed_angle(unit, to_tip);
        let half = libm::asin((near_m / to_tip.length().max(near_m)).clamp(-1.0, 1.0));
        if angle > 0.0 {
            window.left = window.left.min(angle - half);
        } else {
            window.right = window.right.max(angle + half);
        }
    }
    window
}
