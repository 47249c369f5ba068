//! What each coarse cell of the grid has in reach: found once for all cells, and kept row by row.

use super::grid::{CUTS, Space};
use super::{Terrain, bounds_of};
use glam::{DVec3, IVec3};

/// What is in reach of a ball somewhere in a box: numbers in ascending order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach<'a> {
    pub triangles: &'a [u32],
    pub edges: &'a [u32],
    pub corners: &'a [u32],
}

impl Reach<'_> {
    pub fn len(&self) -> usize {
        self.triangles.len() + self.edges.len() + self.corners.len()
    }
}

/// Rows of numbers of different lengths.
#[derive(Debug, Default)]
struct Rows {
    /// Where each row begins, and where the last one ends.
    begins: Vec<u32>,
    numbers: Vec<u32>,
}

impl Rows {
    /// So many rows from pairs of row and number; the numbers of a row keep their order.
    fn of(count: usize, pairs: &[(u32, u32)]) -> Self {
        let mut begins = vec![0; count + 1];
        for (row, _) in pairs {
            begins[*row as usize + 1] += 1;
        }
        for row in 0..count {
            begins[row + 1] += begins[row];
        }
        let mut next = begins.clone();
        let mut numbers = vec![0; pairs.len()];
        for (row, number) in pairs {
            let place = &mut next[*row as usize];
            numbers[*place as usize] = *number;
            *place += 1;
        }
        Rows { begins, numbers }
    }

    fn row(&self, index: usize) -> &[u32] {
        &self.numbers[self.begins[index] as usize..self.begins[index + 1] as usize]
    }
}

/// The lists of the coarse cells.
#[derive(Debug, Default)]
pub(super) struct Coarse {
    triangles: Rows,
    edges: Rows,
    corners: Rows,
}

impl Coarse {
    /// What is in reach of a ball in a cell.
    pub fn of(&self, cell: usize) -> Reach<'_> {
        Reach {
            triangles: self.triangles.row(cell),
            edges: self.edges.row(cell),
            corners: self.corners.row(cell),
        }
    }
}

impl Terrain {
    /// Finds what each coarse cell has in reach.
    pub(super) fn list_coarse(&self) -> Coarse {
        let count = (self.count >> CUTS).element_product() as usize;
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (number, triangle) in (0..).zip(&self.triangles) {
            self.visit(triangle, |cell, space| {
                if self.is_over(number, space) {
                    pairs.push((cell, number));
                }
            });
        }
        let triangles = Rows::of(count, &pairs);
        pairs.clear();
        for (number, edge) in (0..).zip(&self.edges) {
            let end = edge.from + edge.along * edge.length_m;
            self.visit(&[edge.from, end], |cell, space| {
                if self.is_at_edge(number, space) {
                    pairs.push((cell, number));
                }
            });
        }
        let edges = Rows::of(count, &pairs);
        pairs.clear();
        for (number, corner) in (0..).zip(&self.corners) {
            self.visit(&[corner.point], |cell, space| {
                if self.is_at_corner(number, space) {
                    pairs.push((cell, number));
                }
            });
        }
        Coarse { triangles, edges, corners: Rows::of(count, &pairs) }
    }

    /// Calls `found` for each coarse cell from which a ball may reach the box around some points.
    fn visit(&self, points: &[DVec3], mut found: impl FnMut(u32, &Space)) {
        let (first, last) = bounds_of(points.iter().copied());
        let reach = self.reach_m();
        let count = self.count >> CUTS;
        let low = (self.place_of(first - reach) >> CUTS).clamp(IVec3::ZERO, count - 1);
        let high = (self.place_of(last + reach) >> CUTS).clamp(IVec3::ZERO, count - 1);
        for z in low.z..=high.z {
            for y in low.y..=high.y {
                for x in low.x..=high.x {
                    let space = self.space(IVec3::new(x, y, z) << CUTS, 1 << CUTS);
                    if space.reaches(first, last) {
                        found(((z * count.y + y) * count.x + x) as u32, &space);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::POOL_RADIUS_M;
    use crate::table::Table;

    /// What is listed at a point: patches, edges, corners.
    fn listed(terrain: &Terrain, point: DVec3) -> Option<(Vec<u32>, Vec<u32>, Vec<u32>)> {
        let lists = terrain.in_block(&terrain.block_at(terrain.place_of(point), false))?;
        let patches = lists.groups.iter().map(|group| group.patch).collect();
        Some((patches, lists.edges.to_vec(), lists.corners.to_vec()))
    }

    #[test]
    fn cells_are_cut_where_a_ball_comes_and_list_the_same_whoever_comes_first() {
        let table = Table::preset("pool-9ft").unwrap();
        let terrain = Terrain::new(&table, POOL_RADIUS_M);
        let cut = |terrain: &Terrain| terrain.cuts.iter().filter(|cut| cut.get().is_some()).count();
        assert_eq!(cut(&terrain), 0);
        // Along a corner pocket's mouth, where most is in reach.
        let mouth = table.pockets[0].mouth.map(|tip| tip.extend(POOL_RADIUS_M));
        let points: Vec<DVec3> =
            (0..=40).map(|i| mouth[0].lerp(mouth[1], f64::from(i) / 40.0)).collect();
        let there: Vec<_> = points.iter().map(|point| listed(&terrain, *point)).collect();
        assert!(there.iter().flatten().any(|(patches, ..)| patches.len() > 3), "{there:?}");
        assert!((1..20).contains(&cut(&terrain)), "{} cells are cut", cut(&terrain));
        let other = Terrain::new(&table, POOL_RADIUS_M);
        let back: Vec<_> = points.iter().rev().map(|point| listed(&other, *point)).collect();
        assert!(there.iter().eq(back.iter().rev()), "{there:?} {back:?}");
    }

    #[test]
    fn rows_hold_their_numbers_in_the_order_of_the_pairs() {
        let rows = Rows::of(4, &[(2, 7), (0, 8), (2, 9), (2, 11), (3, 1)]);
        let expected: [&[u32]; 4] = [&[8], &[], &[7, 9, 11], &[1]];
        assert!((0..4).all(|row| rows.row(row) == expected[row]), "{rows:?}");
    }
}
