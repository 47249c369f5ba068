//! When a ball on a spring meets something.
//!
//! Beyond the reach of its swing it meets nothing, and nobody looks. Within it the swing is
//! followed in stretches, each a parabola, and what they find is put right on the swing itself. So
//! many stretches are followed at a time; then somebody looks again. Work within the reach of
//! something goes with the frequency, but events do so a hundred times less.

use super::EventDriven;
use super::body::Own;
use super::closing::{self, Relative};
use super::segment::Segment;
use super::sweep::{self, Meeting};
use super::terrain::{Feature, Terrain};
use crate::physics::{PhysicsError, Work, tolerance};
use crate::units::Seconds;
use glam::DVec3;

/// Stretches that are followed before somebody looks again.
pub(super) const STRETCHES: usize = 128;

/// What is this close to the reach of a swing is taken to be in it [m].
const MARGIN_M: f64 = 1e-6;

/// What a ball on a spring meets of the terrain, or when to look again.
pub(super) fn own_event(
    terrain: &Terrain,
    segment: &Segment,
    radius_m: f64,
    at: Seconds,
    work: &mut Work,
) -> Own {
    if !is_told(terrain, segment) && !is_near(terrain, segment, radius_m) {
        return Own::Ends(segment.end_s);
    }
    let mut from = at;
    for _ in 0..STRETCHES {
        let piece = segment.stretch(from, segment.end_s);
        let until = piece.end_s;
        let met = sweep::first_meeting(terrain, &piece, radius_m, from, until, &[], work);
        if let Some(meeting) = met {
            return Own::Meets(on_the_swing(terrain, segment, radius_m, meeting));
        }
        from = until;
        if segment.end_s <= from {
            break;
        }
    }
    Own::Ends(from)
}

/// Whether a swing may cross the head string, which is told.
pub(super) fn is_told(terrain: &Terrain, segment: &Segment) -> bool {
    terrain.head_string_x().zip(segment.swing).is_some_and(|(head, swing)| {
        (swing.rest.x - head).abs() <= swing.reach_along_m(segment, DVec3::X) + MARGIN_M
    })
}

/// Whether anything of the terrain is within the reach of a swing.
fn is_near(terrain: &Terrain, segment: &Segment, radius_m: f64) -> bool {
    let Some(swing) = &segment.swing else { return true };
    let near = |(point, normal): (DVec3, DVec3)| {
        let reach = swing.reach_along_m(segment, normal) + radius_m + MARGIN_M;
        (swing.rest - point).dot(normal) <= reach
    };
    if terrain.planes.iter().any(|plane| near((plane.point, plane.normal))) {
        return true;
    }
    let reach = DVec3::from_array(DVec3::AXES.map(|axis| swing.reach_along_m(segment, axis)));
    terrain.has_mesh() && terrain.lists_between(swing.rest - reach, swing.rest + reach)
}

/// A meeting with a flat thing as it is on the swing itself.
fn on_the_swing(terrain: &Terrain, segment: &Segment, radius_m: f64, meeting: Meeting) -> Meeting {
    let Meeting { normal, at, .. } = meeting;
    let offset = match meeting.feature {
        Feature::Plane(plane) => terrain.planes[plane as usize].point.dot(normal),
        Feature::Patch(patch) => {
            let patch = &terrain.patches[patch as usize];
            patch.offset * patch.normal.dot(normal).signum()
        }
        Feature::Edge(_) | Feature::Corner(_) => return meeting,
    };
    let gap = |at: Seconds| {
        let rate = segment.velocity_at(at).dot(normal);
        (segment.position_at(at).dot(normal) - offset - radius_m, rate)
    };
    Meeting { at: refined(at, segment.start_s, gap), ..meeting }
}

/// The time near `at` at which a gap, given with its rate, closes; `at` itself for what is pressed
/// and not struck.
fn refined(at: Seconds, earliest: Seconds, gap: impl Fn(Seconds) -> (f64, f64)) -> Seconds {
    let (first, rate) = gap(at);
    if rate > -tolerance::STRUCK_M_S || first < -0.5 * tolerance::PRESS_M {
        return at;
    }
    let (mut time, mut best) = (at, first.abs());
    for _ in 0..4 {
        let (off, rate) = gap(time);
        if rate > -tolerance::STRUCK_M_S {
            break;
        }
        let next = (time - off / rate).max(earliest);
        let left = gap(next).0.abs();
        if !(left < best) {
            break;
        }
        (time, best) = (next, left);
    }
    time
}

impl EventDriven {
    /// When two balls meet of which at least one is on a spring, or when to look again; nothing
    /// happens to either before `until`.
    pub(super) fn swinging_pair(
        &self,
        at: Seconds,
        one: usize,
        two: usize,
        until: Seconds,
    ) -> Option<Seconds> {
        let (a, b) = (&self.bodies[one].segment, &self.bodies[two].segment);
        let distance = self.paths[one].radius_m + self.paths[two].radius_m;
        let mut time = entry(at, a, b, distance, until)?;
        let hastes = [a, b].map(|s| s.swing.map_or(0.0, |swing| swing.haste_m_s(s)));
        for _ in 0..STRETCHES {
            if until <= time {
                return None;
            }
            let (p, q) = (a.stretch(time, until), b.stretch(time, until));
            let end = p.end_s.min(q.end_s);
            let offset = a.position_at(time) - b.position_at(time);
            // Far apart, no parabola is asked: neither is faster than it can ever be.
            let haste = haste(a, time, hastes[0], until) + haste(b, time, hastes[1], until);
            let leap = 0.99 * (offset.length() - distance) / haste;
            if leap > end - time {
                time = (time + leap).min(until);
                continue;
            }
            let motion = Relative {
                offset,
                velocity: a.velocity_at(time) - b.velocity_at(time),
                acceleration: p.acceleration - q.acceleration,
            };
            if let Some(after) = closing::spheres(&motion, distance, end - time) {
                let gap = |at: Seconds| {
                    let line = a.position_at(at) - b.position_at(at);
                    let closes = a.velocity_at(at) - b.velocity_at(at);
                    (line.length() - distance, closes.dot(line.normalize_or(DVec3::X)))
                };
                return Some(refined(time + after, at, gap));
            }
            time = end;
        }
        (time < until).then_some(time)
    }

    /// Whether what was foreseen for two balls is only that somebody should look again, because
    /// one of them is on a spring: they do not touch, or part.
    pub(super) fn is_other_look(&self, at: Seconds, a: usize, b: usize) -> bool {
        let (p, q) = (&self.bodies[a].segment, &self.bodies[b].segment);
        if !p.swings() && !q.swings() {
            return false;
        }
        let line = p.position_at(at) - q.position_at(at);
        let distance = self.paths[a].radius_m + self.paths[b].radius_m;
        let closes = (p.velocity_at(at) - q.velocity_at(at)).dot(line) < 0.0;
        line.length() - distance > tolerance::PUSH_OUT_M || !closes
    }

    /// Looks again at what the balls on springs among these will meet.
    pub(super) fn look_again(
        &mut self,
        at: Seconds,
        balls: [usize; 2],
    ) -> Result<(), PhysicsError> {
        for index in balls {
            if self.bodies[index].segment.swings() {
                self.follow(at, index)?;
            }
        }
        Ok(())
    }
}

/// No smaller than the speed of a ball up to `until` [m/s]; `swings` is that on its spring.
fn haste(segment: &Segment, from: Seconds, swings: f64, until: Seconds) -> f64 {
    if segment.swings() {
        return swings;
    }
    let pull = segment.acceleration.length();
    let pulled = if pull == 0.0 { 0.0 } else { pull * (until - from) };
    segment.velocity_at(from).length() + pulled
}

/// When a ball comes within the reach of another's swing: `at` if it is in it, none if it does not
/// before `until`.
fn entry(at: Seconds, a: &Segment, b: &Segment, distance: f64, until: Seconds) -> Option<Seconds> {
    let centre = |s: &Segment| match &s.swing {
        Some(swing) if s.swings() => (swing.rest, DVec3::ZERO, DVec3::ZERO),
        _ => (s.position_at(at), s.velocity_at(at), s.acceleration),
    };
    let (p, q) = (centre(a), centre(b));
    let motion = Relative { offset: p.0 - q.0, velocity: p.1 - q.1, acceleration: p.2 - q.2 };
    let along = motion.offset.normalize_or(DVec3::X);
    let stands = motion.velocity == DVec3::ZERO && motion.acceleration == DVec3::ZERO;
    let reach: f64 = [a, b]
        .into_iter()
        .filter(|s| s.swings())
        .filter_map(|s| Some((s, s.swing?)))
        .map(|(s, swing)| {
            // Who stands is met along the line to it, or not at all.
            if stands { swing.reach_along_m(s, along) } else { swing.reach_all_m(s) }
        })
        .sum();
    let near = distance + reach + MARGIN_M;
    if motion.offset.length() <= near || !near.is_finite() {
        return Some(at);
    }
    closing::spheres(&motion, near, until - at).map(|time| at + time)
}
