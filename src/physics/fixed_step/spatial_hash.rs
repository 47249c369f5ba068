//! Spatial partitioning: which objects are near (paper, section 2.1).
//!
//! Space is cut into cubic cells, and each cell hashed to a slot of a table about as large as the
//! number of objects. Several cells may share a slot; that only makes more candidates, which the
//! bounding boxes sort out. Nothing is ever removed: a slot whose mark is not of the current
//! generation counts as empty, and its places are used again, so inserting costs amortised constant
//! time per cell and allocates nothing after the first steps. Objects of any shape and cells of any
//! size work: an object that touches more cells than there are slots goes into every slot.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its lowest corner [m].
    pub min: DVec3,
    /// Its highest corner [m].
    pub max: DVec3,
}

impl Bounds {
    /// All of space.
    pub const EVERYTHING: Bounds = Bounds { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };

    /// Around a ball of radius `reach_m` that moves straight from `from` to `to`.
    pub fn swept(from: DVec3, to: DVec3, reach_m: f64) -> Self {
        let reach = DVec3::splat(reach_m);
        Bounds { min: from.min(to) - reach, max: from.max(to) + reach }
    }

    /// Whether both have a point in common.
    pub fn overlap(&self, other: &Bounds) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Around both.
    pub fn join(&self, other: &Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// The table of cells.
#[derive(Debug, Clone)]
pub struct SpatialHash {
    inverse_cell: f64,
    generation: u32,
    slots: Vec<Slot>,
}

#[derive(Debug, Clone, Default)]
struct Slot {
    generation: u32,
    used: usize,
    objects: Vec<u32>,
}

/// Which objects a query has met already: a mark per object instead of a set.
#[derive(Debug, Clone, Default)]
pub struct Seen {
    query: u32,
    marks: Vec<u32>,
}

impl Seen {
    /// Begins a query over objects numbered below `objects`.
    pub fn begin(&mut self, objects: usize) {
        if self.marks.len() < objects || self.query == u32::MAX {
            self.marks.clear();
            self.marks.resize(objects, 0);
            self.query = 0;
        }
        self.query += 1;
    }

    /// Whether `object` is met for the first time in this query.
    pub fn first(&mut self, object: u32) -> bool {
        let mark = &mut self.marks[object as usize];
        let first = *mark != self.query;
        *mark = self.query;
        first
    }
}

/// A range of cells.
#[derive(Clone, Copy)]
struct Cells {
    low: [i64; 3],
    high: [i64; 3],
}

impl SpatialHash {
    /// An empty table with cells of `cell_m` for about `objects` objects.
    pub fn new(cell_m: f64, objects: usize) -> Self {
        SpatialHash {
            inverse_cell: 1.0 / cell_m,
            generation: 1,
            slots: vec![Slot::default(); objects.max(1).next_power_of_two()],
        }
    }

    /// Forgets all objects, keeping their places.
    pub fn clear(&mut self) {
        self.generation += 1;
    }

    /// The cells that `bounds` touches; none if there are more than slots. Cell borders lie half a
    /// cell off the origin, so that the bed at z = 0 is no border.
    fn cells(&self, bounds: &Bounds) -> Option<Cells> {
        let index = |x: f64| (x * self.inverse_cell + 0.5).floor();
        let low = bounds.min.to_array().map(index);
        let high = bounds.max.to_array().map(index);
        let count: f64 = (0..3).map(|axis| high[axis] - low[axis] + 1.0).product();
        (count <= self.slots.len() as f64)
            .then(|| Cells { low: low.map(|x| x as i64), high: high.map(|x| x as i64) })
    }

    /// Teschner, Heidelberger, Müller, Pomerantes, Gross 2003: three large primes.
    fn slot(&self, cell: [i64; 3]) -> usize {
        let mixed = cell[0].wrapping_mul(73_856_093)
            ^ cell[1].wrapping_mul(19_349_663)
            ^ cell[2].wrapping_mul(83_492_791);
        mixed as usize & (self.slots.len() - 1)
    }

    /// Inserts `object` into the cells of `bounds` for which `touches(cell)` holds.
    pub fn insert(&mut self, object: u32, bounds: &Bounds, touches: impl Fn(&Bounds) -> bool) {
        let Some(cells) = self.cells(bounds) else {
            (0..self.slots.len()).for_each(|slot| self.mark(slot, object));
            return;
        };
        let size = 1.0 / self.inverse_cell;
        for x in cells.low[0]..=cells.high[0] {
            for y in cells.low[1]..=cells.high[1] {
                for z in cells.low[2]..=cells.high[2] {
                    let corner = DVec3::new(x as f64, y as f64, z as f64) - 0.5;
                    let cell = Bounds { min: corner * size, max: (corner + 1.0) * size };
                    if touches(&cell) {
                        self.mark(self.slot([x, y, z]), object);
                    }
                }
            }
        }
    }

    fn mark(&mut self, slot: usize, object: u32) {
        let generation = self.generation;
        let slot = &mut self.slots[slot];
        if slot.generation != generation {
            slot.generation = generation;
            slot.used = 0;
        }
        match slot.objects.get_mut(slot.used) {
            Some(place) => *place = object,
            None => slot.objects.push(object),
        }
        slot.used += 1;
    }

    /// Calls `found` for every object in the cells of `bounds`; an object may come several times.
    pub fn visit(&self, bounds: &Bounds, mut found: impl FnMut(u32)) {
        let mut slot = |slot: &Slot| {
            if slot.generation == self.generation {
                slot.objects[..slot.used].iter().for_each(|object| found(*object));
            }
        };
        let Some(cells) = self.cells(bounds) else {
            self.slots.iter().for_each(slot);
            return;
        };
        for x in cells.low[0]..=cells.high[0] {
            for y in cells.low[1]..=cells.high[1] {
                for z in cells.low[2]..=cells.high[2] {
                    slot(&self.slots[self.slot([x, y, z])]);
                }
            }
        }
    }
}
