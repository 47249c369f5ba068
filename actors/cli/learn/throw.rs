//! The throw table: made, tried, written.

use super::super::{Status, json_line, progress};
use super::LearnArgs;
use hapticbillard::ai::lesson::{
    THROW_CELLS, pot_error_deg, practice_table, throw_cell, throw_table,
};
use hapticbillard::physics::{PhysicsError, PhysicsSettings};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use rayon::prelude::*;
use serde_json::json;
use std::io::Write;
use std::path::Path;

/// Shots of a cell.
const SHOTS: u32 = 200;
/// Pots on which the table is tried.
const POTS: u32 = 2000;
/// They are not those that it was learned from.
const OTHER_SEED: u64 = 0x5eed;
/// Single factors that it is held against: 0 to 0.2 by this.
const FACTOR_STEP: f64 = 0.005;

pub fn write(args: &LearnArgs, file: &Path, out: &mut dyn Write) -> Result<Status, Error> {
    let shots = args.shots.unwrap_or(SHOTS);
    let cloth = practice_table(&PhysicsSettings::default())?;
    let bar = progress(THROW_CELLS as u64, "cells");
    let cell = |cell: usize| {
        let factor = throw_cell(cell, &cloth, args.seed, shots);
        bar.inc(1);
        factor
    };
    let factors: Vec<f64> =
        (0..THROW_CELLS).into_par_iter().map(cell).collect::<Result<_, PhysicsError>>()?;
    bar.finish_and_clear();
    let table = throw_table(&factors, args.seed, shots);
    write_whole(file, table.to_toml().as_bytes())?;

    let seed = args.seed ^ OTHER_SEED;
    let by_table = pot_error_deg(|cut, speed| table.factor(cut, speed), &cloth, seed, POTS)?;
    let single = |n: u32| {
        let factor = FACTOR_STEP * f64::from(n);
        Ok((factor, pot_error_deg(|_, _| factor, &cloth, seed, POTS)?))
    };
    let singles: Vec<(f64, f64)> =
        (0..=40).into_par_iter().map(single).collect::<Result<_, PhysicsError>>()?;
    let best = singles.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let (factor, by_single) = best.unwrap_or((0.0, by_table));
    if args.json {
        let summary = json!({ "file": file, "cells": THROW_CELLS, "shots": shots,
            "seed": args.seed, "error_deg": by_table, "best_single_f": factor,
            "best_single_error_deg": by_single });
        json_line(out, &json!({ "summary": summary }))?;
    } else {
        writeln!(
            out,
            "{THROW_CELLS} cells of {shots} shots; mean error of {POTS} random pots: \
             {by_table:.3}°, with the best single f = {factor:.3}: {by_single:.3}°\nwritten to {}",
            file.display()
        )?;
    }
    Ok(Status::Success)
}
