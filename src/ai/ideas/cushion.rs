//! Ways by cushions: mirrors that stand where the middles of balls bounce.

use super::Position;
use glam::DVec2;
use smallvec::SmallVec;

/// A cushion's line for the middles of balls: of points whose coordinate `axis` is `at_m`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cushion {
    pub(super) axis: usize,
    pub(super) at_m: f64,
}

/// The four cushions, opposite ones one after the other.
pub(super) fn cushions(position: &Position<'_>) -> [Cushion; 4] {
    let bed = &position.view.bed;
    let half = bed.half() - DVec2::splat(position.radius());
    [(0, half.x), (0, -half.x), (1, half.y), (1, -half.y)]
        .map(|(axis, at_m)| Cushion { axis, at_m })
}

impl Cushion {
    /// Where a ball at `from` seems to come from after its bounce [m].
    pub(super) fn image(&self, from: DVec2) -> DVec2 {
        let mut image = from;
        image[self.axis] = 2.0 * self.at_m - from[self.axis];
        image
    }

    /// Where the way from `from` to `to`, on opposite sides, crosses the line [m].
    fn crossing(&self, from: DVec2, to: DVec2) -> Option<DVec2> {
        let reach = (to - from)[self.axis];
        let share = (self.at_m - from[self.axis]) / reach;
        (0.0 < share && share < 1.0).then(|| {
            let mut crossing = from + (to - from) * share;
            crossing[self.axis] = self.at_m;
            crossing
        })
    }
}

/// Whether a ball that bounces here meets the cushion, and not a pocket's jaws.
pub(super) fn is_on_cushion(position: &Position<'_>, bounce: DVec2) -> bool {
    let view = position.view;
    let clear_of = |pocket: &crate::table::Pocket| {
        let half_mouth = 0.5 * pocket.mouth[0].distance(pocket.mouth[1]);
        bounce.distance(pocket.target()) > half_mouth + 0.5 * view.ball_radius_m
    };
    view.bed.holds(bounce, view.ball_radius_m - 1e-6) && view.pockets.iter().all(clear_of)
}

/// A way by cushions from one point to another.
#[derive(Debug, Clone)]
pub(super) struct Bent {
    /// Where it begins, bounces and ends [m].
    pub(super) points: SmallVec<[DVec2; 4]>,
    /// Where it begins, seen in all its mirrors [m].
    pub(super) image: DVec2,
}

impl Bent {
    /// Lengths of its parts [m].
    pub(super) fn legs(&self) -> SmallVec<[f64; 3]> {
        self.points.windows(2).map(|pair| pair[0].distance(pair[1])).collect()
    }
}

/// The image of `from` after these cushions, one after the other [m].
pub(super) fn image(from: DVec2, by: &[Cushion]) -> DVec2 {
    by.iter().fold(from, |image, cushion| cushion.image(image))
}

/// The way by these cushions; none if it does not exist or a bounce is no bounce on rubber.
pub(super) fn bent(
    position: &Position<'_>,
    from: DVec2,
    by: &[Cushion],
    to: DVec2,
) -> Option<Bent> {
    let mut points: SmallVec<[DVec2; 4]> = SmallVec::new();
    points.push(to);
    let mut end = to;
    for (i, cushion) in by.iter().enumerate().rev() {
        end = cushion.crossing(image(from, &by[..=i]), end)?;
        if !is_on_cushion(position, end) {
            return None;
        }
        points.push(end);
    }
    points.push(from);
    points.reverse();
    let apart = points.windows(2).all(|pair| pair[0].distance(pair[1]) > 0.5 * position.radius());
    apart.then(|| Bent { points, image: image(from, by) })
}
