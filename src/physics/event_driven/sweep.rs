//! The first thing a ball meets on its way over the terrain.
//!
//! The path is walked through the grid: cells in which nothing is in reach are passed in leaps; in
//! the others the stretch of path inside the cell is held against what the cell lists, each with a
//! box first and the exact polynomial then. The walk ends at the first meeting.

mod slice;

use super::closing::{self, Relative};
use super::segment::{Course, Segment};
use super::terrain::{Block, Edge, Feature, Group, InReach, Plan, Terrain};
use crate::physics::{Work, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use slice::Slice;

/// What happens to a ball on the terrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// When [s].
    pub at: Seconds,
    /// What it meets, or leaves.
    pub feature: Feature,
    /// Unit normal from the feature to the centre.
    pub normal: DVec3,
    /// The ball meets nothing: what carries it ends here.
    pub leaves: bool,
}

/// The first meeting of a ball on `segment` from `from` to `until`, both in seconds of the world.
/// `held` are the features that it lies on: they, and what belongs to them, are not met.
pub fn first_meeting(
    terrain: &Terrain,
    segment: &Segment,
    radius_m: f64,
    from: Seconds,
    until: Seconds,
    held: &[Feature],
    work: &mut Work,
) -> Option<Meeting> {
    if segment.velocity == DVec3::ZERO && segment.acceleration == DVec3::ZERO {
        return None;
    }
    let mut first: Option<Meeting> = None;
    let (position, velocity) = (segment.position_at(from), segment.velocity_at(from));
    let acceleration = segment.acceleration;

    for (number, plane) in terrain.planes.iter().enumerate() {
        let feature = Feature::Plane(number as u32);
        if held.contains(&feature) {
            continue;
        }
        let horizon = first.map_or(until, |meeting| meeting.at) - from;
        let gap = (position - plane.point).dot(plane.normal) - radius_m;
        let (v, a) = (velocity.dot(plane.normal), acceleration.dot(plane.normal));
        if v >= 0.0 && a >= 0.0 {
            continue;
        }
        work.face_tests += 1;
        if let Some(time) = closing::height(gap, v, a, horizon) {
            first = Some(Meeting { at: from + time, feature, normal: plane.normal, leaves: false });
        }
    }
    if terrain.has_mesh() {
        let until = first.map_or(until, |meeting| meeting.at);
        let walk = Walk { terrain, segment, radius_m, held, carrier: carrier(segment, held) };
        if let Some(meeting) = walk.first(from, until, work) {
            first = Some(meeting);
        }
    }
    first
}

/// The patch that a ball slides or rolls on; on a slope as well.
fn carrier(segment: &Segment, held: &[Feature]) -> Option<u32> {
    match (segment.course, held) {
        (Course::Sliding | Course::Rolling | Course::Lasting, [Feature::Patch(patch)]) => {
            Some(*patch)
        }
        _ => None,
    }
}

struct Walk<'a> {
    terrain: &'a Terrain,
    segment: &'a Segment,
    radius_m: f64,
    held: &'a [Feature],
    carrier: Option<u32>,
}

/// What a level path says about a level edge.
enum Level {
    Never,
    At(Seconds),
    /// The path or the edge is not level, or the ball is only pressed against it.
    Unknown,
}

/// Where a walk over the plan ended.
enum Reached {
    Meeting(Meeting),
    End,
    /// The border of the plan, and when.
    Border(Seconds),
}

impl Walk<'_> {
    fn first(&self, from: Seconds, until: Seconds, work: &mut Work) -> Option<Meeting> {
        let mut from = from;
        if let Some((plan, landing)) = self.plan(from, work) {
            let lands = landing.map_or(f64::INFINITY, |landing| landing.at);
            match self.over_plan(plan, from, until.min(lands), landing, work) {
                Reached::Meeting(meeting) => return Some(meeting),
                Reached::End if until < lands => return None,
                Reached::End => from = lands,
                Reached::Border(at) => from = at,
            }
        }
        self.run(from, until, work)
    }

    /// The plan of the bed that the ball may look into; if it hops, with its landing there.
    fn plan(&self, from: Seconds, work: &mut Work) -> Option<(&Plan, Option<Meeting>)> {
        let plans = self.terrain.plans(self.radius_m)?;
        let (z, v) = (self.segment.position_at(from).z, self.segment.velocity_at(from).z);
        let (a, above) = (self.segment.acceleration.z, z - plans.height_m);
        if self.carrier.map(Feature::Patch) == Some(self.terrain.main_patch()) {
            let level = v == 0.0 && a == 0.0 && above.abs() <= tolerance::SUPPORT_M;
            return level.then_some((&plans.carried, None));
        }
        let low = -tolerance::SUPPORT_M <= above
            && a < 0.0
            && z + 0.5 * v.max(0.0) * v.max(0.0) / -a <= plans.top_m;
        if !low || self.segment.course != Course::Flying || !self.held.is_empty() {
            return None;
        }
        work.face_tests += 1;
        let (feature, normal) = (self.terrain.main_patch(), plans.normal);
        let at = from + closing::height(above, v, a, f64::INFINITY)?;
        let landing = Meeting { at, feature, normal, leaves: false };
        Some((self.terrain.low_plan(plans), Some(landing)))
    }

    /// Along a plan; of what hops the landing is known already, if the bed is there.
    fn over_plan(
        &self,
        plan: &Plan,
        from: Seconds,
        until: Seconds,
        landing: Option<Meeting>,
        work: &mut Work,
    ) -> Reached {
        let mut slice = self.slice(from, until);
        let mut zone = plan.zone_at(slice.position.truncate());
        while let Some(here) = zone {
            let next = slice.cut_at_sides(here.min, here.max);
            if !here.bare
                && let Some(meeting) =
                    self.search(&plan.in_zone(here), slice, landing.is_some(), work)
            {
                return Reached::Meeting(meeting);
            }
            let Some((axis, up)) = next else {
                let lands = |landing: &Meeting| {
                    let foot = slice.at(slice.length);
                    landing.at <= until && self.terrain.main_holds(&plan.in_zone(here), foot)
                };
                return landing.filter(lands).map_or(Reached::End, Reached::Meeting);
            };
            slice = self.slice(slice.end(), until);
            zone = plan.beyond(here, slice.position.truncate(), axis, up);
        }
        Reached::Border(slice.start)
    }

    fn run(&self, from: Seconds, until: Seconds, work: &mut Work) -> Option<Meeting> {
        let on_main = self.held.len() == 1 && self.held[0] == self.terrain.main_patch();
        let mut slice = self.slice(from, until);
        let mut cell = self.terrain.place_of(slice.position);
        loop {
            let block = self.terrain.block_at(cell, on_main);
            let (min, max) = self.terrain.corners_of(&block);
            let next = slice.cut_at(min, max);
            if let Some(lists) = self.terrain.in_block(&block)
                && let Some(meeting) = self.search(&lists, slice, false, work)
            {
                return Some(meeting);
            }
            let Block { low, high, .. } = block;
            let (axis, up) = next?;
            slice = self.slice(slice.end(), until);
            // The other coordinates follow from where the path is; this one is known.
            let inside = self.terrain.place_of(slice.position).clamp(low, high);
            cell = inside;
            cell[axis] = if up { high[axis] + 1 } else { low[axis] - 1 };
            let beyond =
                if up { self.terrain.cells_along(axis) <= cell[axis] } else { cell[axis] < 0 };
            if beyond && !slice.returns(axis, up) {
                return None;
            }
        }
    }

    /// The path from `start` to `until`.
    fn slice(&self, start: Seconds, until: Seconds) -> Slice {
        Slice {
            start,
            length: until - start,
            position: self.segment.position_at(start),
            velocity: self.segment.velocity_at(start),
            acceleration: self.segment.acceleration,
        }
    }

    /// The first meeting with what is in reach on a stretch of the path, but for the main patch if
    /// that is known already.
    fn search(
        &self,
        lists: &InReach,
        mut slice: Slice,
        but_main: bool,
        work: &mut Work,
    ) -> Option<Meeting> {
        let span = slice.span(self.radius_m);
        let mut best: Option<Meeting> = None;
        let mut note = |slice: &mut Slice, time: Seconds, feature, normal, leaves| {
            slice.length = time;
            best = Some(Meeting { at: slice.start + time, feature, normal, leaves });
        };
        for group in lists.groups {
            let feature = Feature::Patch(group.patch);
            let patch = &self.terrain.patches[group.patch as usize];
            let height = patch.normal.dot(span.middle) - patch.offset;
            if height.abs() <= span.reach_m
                && !(but_main && feature == self.terrain.main_patch())
                && patch.may_reach(span.middle, span.reach_m)
                && !self.is_held(feature)
                && let Some((time, normal)) = self.patch(lists, group, &slice, work)
            {
                note(&mut slice, time, feature, normal, false);
            }
        }
        for number in lists.edges {
            let edge = &self.terrain.edges[*number as usize];
            if !span.may_meet_edge(edge) {
                continue;
            }
            let feature = Feature::Edge(*number);
            if let Some(patch) = self.carrier
                && let Some(time) = self.crossing(*number, patch, &slice)
            {
                note(&mut slice, time, feature, self.segment.normal, true);
            }
            if !edge.flat
                && !self.is_held(feature)
                && let Some((time, normal)) = self.edge(*number, &slice, work)
            {
                note(&mut slice, time, feature, normal, false);
            }
        }
        for number in lists.corners {
            let corner = &self.terrain.corners[*number as usize];
            let feature = Feature::Corner(*number);
            if !span.may_meet_corner(corner) || self.is_held(feature) {
                continue;
            }
            work.face_tests += 1;
            let motion = slice.relative_to(corner.point);
            if let Some(time) = closing::spheres(&motion, self.radius_m, slice.length) {
                let normal = (slice.at(time) - corner.point).normalize_or(DVec3::Z);
                note(&mut slice, time, feature, normal, false);
            }
        }
        best
    }

    fn is_held(&self, feature: Feature) -> bool {
        self.held.iter().any(|held| self.terrain.belongs(feature, *held))
    }

    fn patch(
        &self,
        lists: &InReach,
        group: &Group,
        slice: &Slice,
        work: &mut Work,
    ) -> Option<(Seconds, DVec3)> {
        let patch = &self.terrain.patches[group.patch as usize];
        let mut h = patch.normal.dot(slice.position) - patch.offset;
        let mut v = patch.normal.dot(slice.velocity);
        let mut a = patch.normal.dot(slice.acceleration);
        let mut normal = patch.normal;
        // Both sides are solid: the ball is on the side of its centre.
        if h < 0.0 {
            (h, v, a, normal) = (-h, -v, -a, -normal);
        }
        if v >= 0.0 && a >= 0.0 {
            return None;
        }
        let end = h + (v + 0.5 * a * slice.length) * slice.length;
        if h > self.radius_m && end > self.radius_m && (a <= 0.0 || v + a * slice.length <= 0.0) {
            return None;
        }
        work.face_tests += 1;
        let time = closing::height(h - self.radius_m, v, a, slice.length)?;
        self.terrain.holds(lists, group, slice.at(time)).then_some((time, normal))
    }

    fn edge(&self, number: u32, slice: &Slice, work: &mut Work) -> Option<(Seconds, DVec3)> {
        let edge = &self.terrain.edges[number as usize];
        work.face_tests += 1;
        let time = match self.level_edge(edge, slice) {
            Level::Never => return None,
            Level::At(time) => time,
            Level::Unknown => {
                let across = |v: DVec3| v - edge.along * v.dot(edge.along);
                let motion = Relative {
                    offset: across(slice.position - edge.from),
                    velocity: across(slice.velocity),
                    acceleration: across(slice.acceleration),
                };
                closing::spheres(&motion, self.radius_m, slice.length)?
            }
        };
        let centre = slice.at(time);
        let along = (centre - edge.from).dot(edge.along);
        if !(0.0 <= along && along <= edge.length_m) {
            return None;
        }
        Some((time, (centre - edge.from - edge.along * along).normalize_or(DVec3::Z)))
    }

    /// When a ball whose centre stays at one height meets a level edge, such as a cushion's nose:
    /// seen along the edge the centre goes straight to the place where the ball touches, and a
    /// quadratic says when. What is as slow as a press is left to the general way.
    fn level_edge(&self, edge: &Edge, slice: &Slice) -> Level {
        if slice.velocity.z != 0.0 || slice.acceleration.z != 0.0 || edge.along.z != 0.0 {
            return Level::Unknown;
        }
        let offset = slice.position - edge.from;
        let square = self.radius_m * self.radius_m - offset.z * offset.z;
        if square <= 0.0 {
            return Level::Never;
        }
        let away = edge.along.truncate().perp();
        let distance = away.dot(offset.truncate());
        let away = if distance < 0.0 { -away } else { away };
        let touch = square.sqrt();
        let (v, a) = (away.dot(slice.velocity.truncate()), away.dot(slice.acceleration.truncate()));
        let gap = distance.abs() - touch;
        match closing::falling_quadratic(gap, v, a, slice.length) {
            None => Level::Never,
            Some(time) if -(v + a * time) * touch >= tolerance::STRUCK_M_S * self.radius_m => {
                Level::At(time)
            }
            Some(_) => Level::Unknown,
        }
    }

    /// When the foot of a carried ball crosses an edge of the patch that carries it, outwards.
    fn crossing(&self, number: u32, patch: u32, slice: &Slice) -> Option<Seconds> {
        let edge = &self.terrain.edges[number as usize];
        let (_, inwards) = edge.sides.iter().find(|(side, _)| *side == patch)?;
        let offset = slice.position - edge.from;
        let (h, v, a) =
            (offset.dot(*inwards), slice.velocity.dot(*inwards), slice.acceleration.dot(*inwards));
        // A foot that is beyond the line already crosses it nowhere.
        let time = if h < -1e-9 { None } else { closing::falling_quadratic(h, v, a, slice.length) };
        let along = (slice.at(time?) - edge.from).dot(edge.along);
        (0.0 <= along && along <= edge.length_m).then_some(time?)
    }
}
