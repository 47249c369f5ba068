//! Figures of a tournament: who wins how often, and how that changes with the noise.

use super::outcome::{Outcome, Standing};
use crate::cli::plot::{COLOURS, failed};
use hapticbillard::tally::wilson;
use hapticbillard_actors::error::Error;
use plotters::prelude::*;

/// Width of a figure [pixels].
const WIDTH: u32 = 900;
/// Height of a row of the figure on wins [pixels].
const ROW: u32 = 34;
/// Width of the names before the rows [pixels].
const NAMES: u32 = 290;
/// Height of a line of a legend [pixels].
const KEY: i32 = 18;

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// A row per pairing and noise: how often its first player wins, with the interval and the goal.
pub fn wins(outcomes: &[Outcome]) -> Result<String, Error> {
    let rows = outcomes.len() as u32;
    let mut text = String::new();
    {
        let size = (WIDTH, 96 + rows * ROW);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let mut chart = ChartBuilder::on(&area)
            .caption("Racks won by the first player", ("sans-serif", 19))
            .margin(10)
            .margin_right(24)
            .x_label_area_size(36)
            .y_label_area_size(NAMES)
            .build_cartesian_2d(0.0..100.0, -0.5..f64::from(rows) - 0.5)
            .map_err(failed)?;
        chart
            .configure_mesh()
            .x_desc("share of the decided racks [%], with Wilson's 95 % interval")
            .x_label_formatter(&|x| format!("{x:.0}"))
            .y_labels(0)
            .disable_y_mesh()
            .light_line_style(WHITE)
            .label_style(("sans-serif", 13))
            .axis_desc_style(("sans-serif", 14))
            .draw()
            .map_err(failed)?;
        let half = vec![(50.0, -0.5), (50.0, f64::from(rows) - 0.5)];
        chart.draw_series(LineSeries::new(half, BLACK.mix(0.5).stroke_width(1))).map_err(failed)?;
        for (row, outcome) in outcomes.iter().enumerate() {
            // The first one on top.
            let y = f64::from(rows) - 1.0 - row as f64;
            let [low, high] = outcome.interval().map(|share| 100.0 * share);
            let colour = COLOURS[0];
            let bar = PathElement::new([(low, y), (high, y)], colour.stroke_width(3));
            chart.draw_series([bar]).map_err(failed)?;
            if let Some(share) = outcome.share() {
                let mark = Circle::new((100.0 * share, y), 5, colour.filled());
                chart.draw_series([mark]).map_err(failed)?;
            }
            if let Some(test) = outcome.game.until {
                let x = 100.0 * test.goal();
                let goal = [(x, y - 0.32), (x, y + 0.32)];
                let tick = PathElement::new(goal, COLOURS[1].stroke_width(3));
                chart.draw_series([tick]).map_err(failed)?;
            }
            let (_, pixel) = chart.backend_coord(&(0.0, y));
            let [won, lost] = outcome.wins();
            let noise = outcome.game.noise;
            let name = format!("{} ({won} : {lost}, noise {noise})", outcome.game.title());
            let style = ("sans-serif", 14).into_font().color(&BLACK);
            area.draw(&Text::new(name, (14, pixel - 7), style)).map_err(failed)?;
        }
        if outcomes.iter().any(|outcome| outcome.game.until.is_some()) {
            let style = ("sans-serif", 13).into_font().color(&COLOURS[1]);
            let at = (WIDTH as i32 - 90, 14);
            area.draw(&Text::new("| the goal", at, style)).map_err(failed)?;
        }
        area.present().map_err(failed)?;
    }
    Ok(text)
}

/// A curve: its name, and the noise, hits and trials of each point.
struct Curve {
    name: String,
    points: Vec<(f64, u32, u32)>,
}

impl Curve {
    /// Adds a point to the curve of this name.
    fn add(curves: &mut Vec<Curve>, name: String, point: (f64, u32, u32)) {
        match curves.iter_mut().find(|curve| curve.name == name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve { name, points: vec![point] }),
        }
    }
}

/// Against the noise: how often the first player of each pairing wins, and how often each player's
/// aimed shots succeed.
pub fn robustness(outcomes: &[Outcome], standings: &[Standing]) -> Result<String, Error> {
    let (mut wins, mut shots) = (Vec::new(), Vec::new());
    for outcome in outcomes {
        let [won, lost] = outcome.wins();
        Curve::add(&mut wins, outcome.game.title(), (outcome.game.noise, won, won + lost));
    }
    for standing in standings {
        let account = &standing.account;
        let point = (standing.noise, account.made, account.aimed);
        Curve::add(&mut shots, standing.player.to_string(), point);
    }
    let keys = wins.len().max(shots.len()) as i32;
    let mut text = String::new();
    {
        let size = (WIDTH, 380 + (keys * KEY) as u32);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let (left, right) = area.split_horizontally(WIDTH / 2);
        panel(&left, "Racks won by the first player [%]", &wins)?;
        panel(&right, "Shots that pocket what they are meant to [%]", &shots)?;
        area.present().map_err(failed)?;
    }
    Ok(text)
}

fn panel(area: &Area<'_>, title: &str, curves: &[Curve]) -> Result<(), Error> {
    let noises = || curves.iter().flat_map(|curve| curve.points.iter().map(|point| point.0));
    let most = noises().fold(1.0, f64::max);
    let (charts, keys) = area.split_vertically(370);
    let mut chart = ChartBuilder::on(&charts)
        .caption(title, ("sans-serif", 16))
        .margin(10)
        .x_label_area_size(36)
        .y_label_area_size(44)
        .build_cartesian_2d(-0.03 * most..1.03 * most, 0.0..100.0)
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_desc("noise of the strokes, 1 is the Computer Pool Olympiad's")
        .x_label_formatter(&|x| format!("{x:.1}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .light_line_style(WHITE)
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .draw()
        .map_err(failed)?;
    for (number, curve) in curves.iter().enumerate() {
        let colour = COLOURS[number % COLOURS.len()];
        // Curves that lie upon each other stand a little apart.
        let aside = 0.006 * most * (number as f64 - 0.5 * (curves.len() - 1) as f64);
        let points = curve.points.iter().filter(|(_, _, trials)| *trials > 0);
        let shares: Vec<(f64, f64, [f64; 2])> = points
            .map(|(noise, hits, trials)| {
                let share = f64::from(*hits) / f64::from(*trials);
                let interval = wilson(*hits, *trials).map(|bound| 100.0 * bound);
                (noise + aside, 100.0 * share, interval)
            })
            .collect();
        let line = shares.iter().map(|(x, y, _)| (*x, *y));
        let line = LineSeries::new(line, colour.filled().stroke_width(2)).point_size(3);
        chart.draw_series(line).map_err(failed)?;
        let bars = shares.iter().map(|(x, _, [low, high])| {
            PathElement::new([(*x, *low), (*x, *high)], colour.stroke_width(1))
        });
        chart.draw_series(bars).map_err(failed)?;
        let y = KEY * number as i32 + KEY / 2;
        let sample = PathElement::new([(56, y), (80, y)], colour.stroke_width(2));
        keys.draw(&sample).map_err(failed)?;
        let style = ("sans-serif", 14).into_font().color(&BLACK);
        keys.draw(&Text::new(curve.name.clone(), (88, y - 7), style)).map_err(failed)?;
    }
    Ok(())
}
