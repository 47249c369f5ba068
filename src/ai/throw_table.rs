//! How much steeper to aim, by cut and speed: what one factor f cannot know.

use crate::one_line::one_line;
use crate::shipped;
use serde::{Deserialize, Serialize};

const DEGREE: f64 = core::f64::consts::PI / 180.0;
/// Most rows and columns of a table.
const CELLS_MAX: usize = 64;
/// What a factor can be.
const FACTOR_RANGE: core::ops::RangeInclusive<f64> = -0.9..=1.5;

/// Throw compensation f over the cut and the cue ball's speed when it meets the ball: a cut β is
/// aimed as (1 + f) β.
///
/// Throw falls with the speed of the surfaces against each other, stops growing with the cut where
/// they slip all through, and a ball that has begun to roll throws less than one that slides
/// (Alciatore 2004). Between cells f is bilinear; outside them it is that of the nearest edge.
/// Limits: each cell was learned over strokes through the middle of the ball and over many
/// distances, so it knows the spin that such strokes have on the average, and none that a player
/// gives on purpose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThrowTable {
    /// Seed of the shots that it was learned from.
    pub seed: u64,
    /// Shots in each cell.
    pub shots: u32,
    /// Rows: cuts [°], ascending.
    pub cuts_deg: Vec<f64>,
    /// Columns: speeds of the cue ball when it meets the ball [m/s], ascending.
    pub speeds_m_s: Vec<f64>,
    /// f of each cell, a row for each cut.
    pub factors: Vec<Vec<f64>>,
}

/// A text is no table.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ThrowTableError {
    /// It is not written as a table is.
    #[error(
        "a throw table cannot be read: {problem}; `hapticbillard learn --throw-table` makes one"
    )]
    Toml {
        /// What is wrong.
        problem: String,
    },
    /// Rows or columns are not numbers that ascend from 0.
    #[error("{key} of a throw table must be 2 to 64 numbers of 0 or more that ascend")]
    Axis {
        /// Which.
        key: &'static str,
    },
    /// There is not one factor for each cell.
    #[error("factors of a throw table must be {rows} rows of {columns} numbers from -0.9 to 1.5")]
    Factors {
        /// As many as cuts.
        rows: usize,
        /// As many as speeds.
        columns: usize,
    },
}

impl ThrowTable {
    /// The table for pool balls under `profile = "standard"`, compiled in.
    pub fn shipped() -> ThrowTable {
        // A test reads it, so it can be read.
        Self::parse(shipped::THROW_TABLE).unwrap_or_else(|_| Self::constant(0.07))
    }

    /// A table that says the same for all cuts and speeds.
    pub fn constant(factor: f64) -> ThrowTable {
        ThrowTable {
            seed: 0,
            shots: 0,
            cuts_deg: vec![0.0, 90.0],
            speeds_m_s: vec![0.0, 10.0],
            factors: vec![vec![factor; 2]; 2],
        }
    }

    /// Reads a table from TOML.
    ///
    /// # Errors
    /// [`ThrowTableError`] with what is wrong.
    pub fn parse(text: &str) -> Result<ThrowTable, ThrowTableError> {
        let table: ThrowTable = toml::from_str(text).map_err(|error| {
            let problem = one_line(error.message(), 400);
            ThrowTableError::Toml { problem }
        })?;
        table.check()?;
        Ok(table)
    }

    /// The table as a file, which [`ThrowTable::parse`] reads.
    pub fn to_toml(&self) -> String {
        // Lines stay short enough to read.
        let list = |numbers: &[f64], digits: usize, next_line: &str| {
            let texts: Vec<String> = numbers.iter().map(|n| format!("{n:.digits$}")).collect();
            let lines: Vec<String> = texts.chunks(10).map(|line| line.join(", ")).collect();
            format!("[{}]", lines.join(next_line))
        };
        let rows: Vec<String> =
            self.factors.iter().map(|row| format!("  {},\n", list(row, 4, ",\n   "))).collect();
        format!(
            "# Throw compensation f over cut and speed; see `hapticbillard learn --help`.\n\
             # A cut b is aimed as (1 + f) b. Rows: cuts; columns: the cue ball's speeds.\n\
             # Learned by shots of the simulation under profile = \"standard\"; made by\n\
             # hapticbillard learn --throw-table FILE --seed {} --shots {}\n\
             seed = {}\nshots = {}\ncuts_deg = {}\nspeeds_m_s = {}\nfactors = [\n{}]\n",
            self.seed,
            self.shots,
            self.seed,
            self.shots,
            list(&self.cuts_deg, 1, ",\n  "),
            list(&self.speeds_m_s, 2, ",\n  "),
            rows.concat(),
        )
    }

    fn check(&self) -> Result<(), ThrowTableError> {
        for (key, axis) in [("cuts_deg", &self.cuts_deg), ("speeds_m_s", &self.speeds_m_s)] {
            let sound = (2..=CELLS_MAX).contains(&axis.len())
                && axis.iter().all(|number| number.is_finite() && 0.0 <= *number)
                && axis.windows(2).all(|pair| pair[0] < pair[1]);
            if !sound {
                return Err(ThrowTableError::Axis { key });
            }
        }
        let (rows, columns) = (self.cuts_deg.len(), self.speeds_m_s.len());
        let sound = self.factors.len() == rows
            && self.factors.iter().all(|row| row.len() == columns)
            && self.factors.iter().flatten().all(|factor| FACTOR_RANGE.contains(factor));
        if sound { Ok(()) } else { Err(ThrowTableError::Factors { rows, columns }) }
    }

    /// f for a cut of either side [rad] with the cue ball at `ball_speed_m_s` when it meets the
    /// ball; that of the nearest cell's edge for what is no number.
    pub fn factor(&self, cut_rad: f64, ball_speed_m_s: f64) -> f64 {
        let (row, down) = place(&self.cuts_deg, cut_rad.abs() / DEGREE);
        let (column, right) = place(&self.speeds_m_s, ball_speed_m_s);
        let along = |row: &[f64]| row[column] + right * (row[column + 1] - row[column]);
        let (above, below) = (along(&self.factors[row]), along(&self.factors[row + 1]));
        above + down * (below - above)
    }
}

/// The interval of an ascending axis in which `value` lies, and how far in it, 0 to 1.
fn place(axis: &[f64], value: f64) -> (usize, f64) {
    let above = axis.iter().take_while(|number| **number <= value).count();
    let index = above.clamp(1, axis.len() - 1) - 1;
    let share = (value - axis[index]) / (axis[index + 1] - axis[index]);
    // NaN lies at the beginning.
    (index, if share > 0.0 { share.min(1.0) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> ThrowTable {
        ThrowTable {
            seed: 3,
            shots: 5,
            cuts_deg: vec![10.0, 30.0, 70.0],
            speeds_m_s: vec![1.0, 4.0],
            factors: vec![vec![0.1, 0.0], vec![0.2, 0.1], vec![0.4, -0.2]],
        }
    }

    #[test]
    fn factors_are_bilinear_inside_and_those_of_the_edge_outside() {
        let table = table();
        for (cut_deg, speed, factor) in [
            (10.0, 1.0, 0.1),
            (20.0, 1.0, 0.15),
            (-20.0, 2.5, 0.1),
            (50.0, 4.0, -0.05),
            (0.0, 0.0, 0.1),
            (89.0, 99.0, -0.2),
            (f64::NAN, f64::NAN, 0.1),
        ] {
            let found = table.factor(cut_deg * DEGREE, speed);
            assert!((found - factor).abs() < 1e-12, "{cut_deg} deg, {speed} m/s: {found}");
        }
    }

    #[test]
    fn a_table_is_read_as_it_was_written() {
        assert_eq!(ThrowTable::parse(&table().to_toml()), Ok(table()));
    }

    #[test]
    fn the_shipped_table_can_be_read() {
        let table = ThrowTable::parse(shipped::THROW_TABLE).unwrap();
        assert_eq!(ThrowTable::shipped(), table);
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let wrong = |change: fn(&mut ThrowTable)| {
            let mut table = table();
            change(&mut table);
            ThrowTable::parse(&table.to_toml()).unwrap_err()
        };
        let axis = |key| ThrowTableError::Axis { key };
        assert_eq!(wrong(|table| table.cuts_deg[1] = 5.0), axis("cuts_deg"));
        assert_eq!(wrong(|table| table.speeds_m_s[0] = -1.0), axis("speeds_m_s"));
        let factors = ThrowTableError::Factors { rows: 3, columns: 2 };
        assert_eq!(wrong(|table| table.factors[0][1] = 2.0), factors);
        assert_eq!(wrong(|table| drop(table.factors.pop())), factors);
        assert!(matches!(ThrowTable::parse("seed = 1"), Err(ThrowTableError::Toml { .. })));
    }
}
