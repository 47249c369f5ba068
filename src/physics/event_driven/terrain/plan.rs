//! The bed seen from above: what a ball that it carries can touch, and how far around that is so.
//!
//! A carried ball's centre stays in one plane. A plan cuts that plane into small cells, lists for
//! each what is in reach at that height alone, and joins cells with the same list to rectangles.
//! The open bed is one of them, and so is the strip along a straight rail: most paths pass two.
//! A second plan serves balls that hop a little.

use super::coarse::Reach;
use super::grid::{CUTS, Parts, Space};
use super::{Group, InReach, Listed, Terrain};
use glam::{DVec2, DVec3, IVec2};
use smallvec::SmallVec;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// So many cells of the plan lie along a coarse cell of the grid.
const FINER: i32 = 4;

/// How high balls may hop for the second plan [m].
const HOP_M: f64 = 5e-3;

/// The bed is level if its normal's z differs from 1 by no more than this.
pub(super) const LEVEL: f64 = 1e-12;

/// A rectangle of cells in which the same things are in reach.
#[derive(Debug, Clone, Copy)]
pub struct Zone {
    /// Its corners [m].
    pub min: DVec2,
    /// See `min`.
    pub max: DVec2,
    /// Its first and last cell along each axis.
    low: IVec2,
    high: IVec2,
    /// What is in reach.
    pub listed: Listed,
    /// Nothing is in reach, or nothing but the main patch with the foot inside of it.
    pub bare: bool,
}

/// Two plans of a level bed.
#[derive(Debug)]
pub struct Plans {
    /// Height of the centre of a ball on the bed [m].
    pub height_m: f64,
    /// Unit normal of the bed, upwards.
    pub normal: DVec3,
    /// For balls that the bed carries, which is left out of it.
    pub carried: Plan,
    /// For balls whose centre is no higher than `top_m`, the bed included; drawn when the first
    /// ball hops.
    low: OnceLock<Plan>,
    /// See `low` [m].
    pub top_m: f64,
}

/// A plan, for centres between two heights.
#[derive(Debug, Default)]
pub struct Plan {
    origin: DVec2,
    inverse_cell: DVec2,
    count: IVec2,
    zones: Vec<Zone>,
    zone_of: Vec<u32>,
    lists: Lists,
}

impl Plan {
    /// What is in reach in a zone.
    #[inline]
    pub fn in_zone(&self, zone: &Zone) -> InReach<'_> {
        self.lists.of(&zone.listed)
    }

    /// The zone of a point; none if the plan does not reach so far.
    #[inline]
    pub fn zone_at(&self, point: DVec2) -> Option<&Zone> {
        let place = (point - self.origin) * self.inverse_cell;
        if !(place.cmpge(DVec2::ZERO).all() && place.cmplt(self.count.as_dvec2()).all()) {
            return None;
        }
        self.zone_of_cell(place.as_ivec2())
    }

    /// The zone that a path enters at `point`, where it leaves `zone` along an axis.
    pub fn beyond(&self, zone: &Zone, point: DVec2, axis: usize, up: bool) -> Option<&Zone> {
        let place = ((point - self.origin) * self.inverse_cell).floor();
        let inside = place.clamp(DVec2::splat(-2.0), self.count.as_dvec2() + 2.0).as_ivec2();
        let mut cell = inside.clamp(zone.low, zone.high);
        // The other coordinate follows from where the path is; this one is known.
        cell[axis] = if up { zone.high[axis] + 1 } else { zone.low[axis] - 1 };
        self.zone_of_cell(cell)
    }

    fn zone_of_cell(&self, cell: IVec2) -> Option<&Zone> {
        if cell.cmplt(IVec2::ZERO).any() || cell.cmpge(self.count).any() {
            return None;
        }
        Some(&self.zones[self.zone_of[(cell.y * self.count.x + cell.x) as usize] as usize])
    }
}

impl Terrain {
    /// Draws the plans of the main patch; there are none if it is not level.
    pub(super) fn draw_plans(&self) -> Option<Plans> {
        let main = self.patches.get(self.main as usize)?;
        if main.normal.z.abs() < 1.0 - LEVEL {
            return None;
        }
        let height_m = main.offset / main.normal.z + self.radius_m;
        let top_m = height_m + HOP_M;
        let carried = self.draw_plan((height_m, height_m), |parts| self.forget(self.main, parts));
        let normal = main.normal * main.normal.z.signum();
        Some(Plans { height_m, normal, carried, low: OnceLock::new(), top_m })
    }

    /// The plan for balls that hop.
    pub fn low_plan<'a>(&self, plans: &'a Plans) -> &'a Plan {
        plans.low.get_or_init(|| self.draw_plan((plans.height_m, plans.top_m), |_| ()))
    }

    /// The plan for centres between two heights.
    fn draw_plan(&self, (bottom_m, top_m): (f64, f64), change: impl Fn(&mut Parts)) -> Plan {
        let mut lists = Lists::default();
        let cells = self.count >> CUTS;
        let layer_at = |z: f64| self.place_of(DVec3::new(0.0, 0.0, z)).z >> CUTS;
        let layers = layer_at(bottom_m).max(0)..=layer_at(top_m).min(cells.z - 1);
        let count = cells.truncate() * FINER;
        let cell_m = self.cell_m.truncate() * f64::from(1 << CUTS) / f64::from(FINER);
        let half = (0.5 * cell_m).extend(0.5 * (top_m - bottom_m));
        let whole = (0.5 * f64::from(FINER) * cell_m).extend(half.z);
        let centre_m = 0.5 * (top_m + bottom_m);
        let origin = self.origin.truncate();

        // What each cell lists, equal lists by one number.
        let mut numbers: BTreeMap<Parts, u32> = BTreeMap::from([(Parts::default(), 0)]);
        let mut list_of = vec![0; count.element_product() as usize];
        let mut parts = Parts::default();
        let mut last = (Parts::default(), 0);
        for place in (0..cells.x * cells.y).map(|i| IVec2::new(i % cells.x, i / cells.x)) {
            let index = |z| (z * cells.y + place.y) * cells.x + place.x;
            let around: SmallVec<[Reach; 2]> =
                layers.clone().map(|z| self.coarse.of(index(z) as usize)).collect();
            if around.iter().all(|parts| parts.len() == 0) {
                continue;
            }
            // What none of its parts has in reach is left aside at once.
            let middle = origin + (place.as_dvec2() + 0.5) * (whole.truncate() * 2.0);
            let space = Space::of_parts(middle.extend(centre_m), whole, half, self.reach_m());
            let near = self.keep_of(&around, &space);
            // On the open bed nothing else than a patch is in reach.
            let alone = self.only_patch(near.view());
            for part in (0..FINER * FINER).map(|i| IVec2::new(i % FINER, i / FINER)) {
                let cell = place * FINER + part;
                let middle = (origin + (cell.as_dvec2() + 0.5) * cell_m).extend(centre_m);
                let space = Space::new(middle, half, self.reach_m());
                parts.clear();
                match alone {
                    Some(patch) if self.is_whole(patch, near.view().triangles, &space) => {
                        parts.set_whole(patch);
                    }
                    _ => {
                        self.keep(near.view(), &space, &mut parts);
                        self.find_whole(&mut parts, &space);
                    }
                }
                change(&mut parts);
                if !parts.is(&last.0) {
                    let next = numbers.len() as u32;
                    let number = numbers.get(&parts).copied();
                    last = (parts.clone(), number.unwrap_or(next));
                    if number.is_none() {
                        numbers.insert(parts.clone(), next);
                    }
                }
                list_of[(cell.y * count.x + cell.x) as usize] = last.1;
            }
        }
        let mut listed = vec![Listed::default(); numbers.len()];
        for (parts, number) in &numbers {
            listed[*number as usize] = self.list(parts, &mut lists);
        }

        let (zones, zone_of) = rectangles(&list_of, count);
        let zones = zones
            .into_iter()
            .map(|(low, high)| {
                let listed = listed[list_of[(low.y * count.x + low.x) as usize] as usize];
                let found = lists.of(&listed);
                let main = |group: &Group| group.patch == self.main && group.is_whole();
                Zone {
                    min: origin + low.as_dvec2() * cell_m,
                    max: origin + (high + 1).as_dvec2() * cell_m,
                    low,
                    high,
                    listed,
                    bare: found.groups.iter().all(main)
                        && found.edges.is_empty()
                        && found.corners.is_empty(),
                }
            })
            .collect();
        let inverse_cell = cell_m.recip();
        Plan { origin, inverse_cell, count, zones, zone_of, lists }
    }
}

/// Cuts a field of numbers into rectangles of one number each: the first cell and the last of each,
/// and for each cell the number of its rectangle.
fn rectangles(field: &[u32], count: IVec2) -> (Vec<(IVec2, IVec2)>, Vec<u32>) {
    const NONE: u32 = u32::MAX;
    let mut found: Vec<(IVec2, IVec2)> = Vec::new();
    let mut owner = vec![NONE; field.len()];
    let index = |x: i32, y: i32| (y * count.x + x) as usize;
    // The middle comes first: there the open bed is.
    let middle = count / 2;
    let all = (0..count.y).flat_map(|y| (0..count.x).map(move |x| IVec2::new(x, y)));
    for cell in core::iter::once(middle).chain(all) {
        if owner[index(cell.x, cell.y)] != NONE {
            continue;
        }
        let number = field[index(cell.x, cell.y)];
        let free = |x: i32, y: i32| field[index(x, y)] == number && owner[index(x, y)] == NONE;
        let (mut low, mut high) = (cell, cell);
        loop {
            let before = (low, high);
            if high.x + 1 < count.x && (low.y..=high.y).all(|y| free(high.x + 1, y)) {
                high.x += 1;
            }
            if low.x > 0 && (low.y..=high.y).all(|y| free(low.x - 1, y)) {
                low.x -= 1;
            }
            if high.y + 1 < count.y && (low.x..=high.x).all(|x| free(x, high.y + 1)) {
                high.y += 1;
            }
            if low.y > 0 && (low.x..=high.x).all(|x| free(x, low.y - 1)) {
                low.y -= 1;
            }
            if before == (low, high) {
                break;
            }
        }
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                owner[index(x, y)] = found.len() as u32;
            }
        }
        found.push((low, high));
    }
    (found, owner)
}

impl Lists {
    /// Gives back what is not needed.
    pub fn shrink(&mut self) {
        self.groups.shrink_to_fit();
        self.triangles.shrink_to_fit();
        self.edges.shrink_to_fit();
        self.corners.shrink_to_fit();
    }
}

/// Parts in a row, as cells and zones name them.
#[derive(Debug, Default)]
pub struct Lists {
    pub groups: Vec<Group>,
    pub triangles: Vec<u32>,
    pub edges: Vec<u32>,
    pub corners: Vec<u32>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_cover_a_field_once_and_mix_nothing() {
        let count = IVec2::new(7, 5);
        let field: Vec<u32> =
            (0..35).map(|i| u32::from(i % 7 == 0 || i / 7 == 0) + u32::from(i == 17)).collect();
        let (found, owner) = rectangles(&field, count);
        for (number, (low, high)) in found.iter().enumerate() {
            let first = field[(low.y * 7 + low.x) as usize];
            for y in low.y..=high.y {
                for x in low.x..=high.x {
                    assert_eq!(owner[(y * 7 + x) as usize], number as u32);
                    assert_eq!(field[(y * 7 + x) as usize], first);
                }
            }
        }
        let area: i32 = found.iter().map(|(low, high)| (*high - *low + 1).element_product()).sum();
        assert_eq!(area, 35);
    }
}
