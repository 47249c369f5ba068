//! Where each surface lies in the light map: rectangles on shelves.

/// Texels left free round each chart, so that a filtered texture never mixes two of them.
pub(super) const GUTTER: u32 = 2;

/// A rectangle of the light map [texels].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chart {
    /// Its left column.
    pub x: u32,
    /// Its first row.
    pub y: u32,
    /// How wide it is.
    pub columns: u32,
    /// How high it is.
    pub rows: u32,
}

impl Chart {
    /// One that has no place yet.
    pub(super) fn of(columns: u32, rows: u32) -> Self {
        Chart { x: 0, y: 0, columns, rows }
    }
}

/// Gives every chart a place in a picture of this width, on shelves from the highest to the lowest;
/// returns how many rows are used.
pub(super) fn pack(charts: &mut [Chart], width: u32) -> u32 {
    let mut order: Vec<usize> = (0..charts.len()).collect();
    order.sort_by_key(|&i| {
        let chart = &charts[i];
        (core::cmp::Reverse((chart.rows, chart.columns)), i)
    });
    let (mut x, mut y, mut shelf) = (GUTTER, GUTTER, 0);
    for i in order {
        let chart = &mut charts[i];
        if width < x + chart.columns + GUTTER {
            (x, y, shelf) = (GUTTER, y + shelf + GUTTER, 0);
        }
        (chart.x, chart.y) = (x, y);
        shelf = shelf.max(chart.rows);
        x += chart.columns + GUTTER;
    }
    y + shelf + GUTTER
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn charts_keep_their_gutter_and_stay_inside() {
        let sizes = (1..120u32).map(|k| (2 + k * 7 % 40, 2 + k * 13 % 31));
        let mut charts: Vec<Chart> = sizes.map(|(w, h)| Chart::of(w, h)).collect();
        let rows = pack(&mut charts, 128);
        for (i, a) in charts.iter().enumerate() {
            assert!(GUTTER <= a.x && a.x + a.columns + GUTTER <= 128, "{a:?}");
            assert!(GUTTER <= a.y && a.y + a.rows + GUTTER <= rows, "{a:?}");
            for b in &charts[..i] {
                let apart =
                    |p: u32, n: u32, q: u32, m: u32| p + n + GUTTER <= q || q + m + GUTTER <= p;
                let is_apart =
                    apart(a.x, a.columns, b.x, b.columns) || apart(a.y, a.rows, b.y, b.rows);
                assert!(is_apart, "{a:?} {b:?}");
            }
        }
        let used: u32 = charts.iter().map(|c| c.columns * c.rows).sum();
        assert!(used * 2 > rows * 128, "{used} texels on {rows} rows");
    }
}
