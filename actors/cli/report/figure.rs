//! Figures: errors against steps and against run time, on logarithmic scales.

use super::measure::{Measured, Timed};
use super::peers::{self, Curve};
use crate::cli::plot::failed;
use hapticbillard::report::{self, Growth, PeerRow, Peers, Status};
use hapticbillard_actors::error::Error;
use plotters::prelude::*;

/// The file of the figure on chaos.
pub const CHAOS: &str = "chaos.svg";
/// Errors below this are drawn there [m].
const LEAST_M: f64 = 1e-17;
/// Width and height [pixels].
const SIZE: (u32, u32) = (1380, 470);
/// Height of a row of the legend [pixels]; methods stand above other programs.
const KEY_PIXELS: u32 = 30;
/// The methods in steps and their colours: Okabe and Ito's, which colour-blind readers can tell.
const LINES: [(&str, RGBColor); 6] = [
    ("euler-cromer", RGBColor(213, 94, 0)),
    ("velocity-verlet", RGBColor(0, 114, 178)),
    ("position-verlet", RGBColor(86, 180, 233)),
    ("rk4", RGBColor(0, 158, 115)),
    ("euler-cromer sub-steps", RGBColor(230, 159, 0)),
    ("velocity-verlet sub-steps", RGBColor(204, 121, 167)),
];
/// The exact solver with other tolerances: name, colour and size of the mark.
const EXACT: [(&str, RGBColor, u32); 2] = [
    ("event-driven coarse", RGBColor(150, 150, 150), 5),
    ("event-driven fine", RGBColor(80, 80, 80), 3),
];
/// Other programs' colours.
const OTHERS: [RGBColor; 4] =
    [RGBColor(140, 20, 20), RGBColor(110, 60, 160), RGBColor(60, 110, 20), RGBColor(130, 110, 60)];

/// The file of a scene's figure.
pub fn name(measured: &Measured) -> String {
    file(measured.prepared.scene.id)
}

/// The file of the figure of the scene `id`.
pub fn file(id: &str) -> String {
    format!("{id}.svg")
}

/// The next power of ten below and above all values.
pub(super) fn decades(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (low, high) = values
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    if !(low <= high) {
        return 1e-3..1.0;
    }
    let power = |value: f64| 10.0_f64.powi(value as i32);
    power(low.log10().floor())..power((high * 1.001).log10().ceil())
}

/// Error against step, against processor time and against computations.
pub fn scene(measured: &Measured, peers: Option<&Peers>) -> Result<String, Error> {
    let id = measured.prepared.scene.id;
    let curves = |along: fn(&PeerRow) -> Option<f64>| {
        peers.map_or_else(Vec::new, |peers| peers::curves(peers, id, along))
    };
    let others_by_step = curves(|row| row.step_ms);
    let others_by_time = curves(|row| row.point().map(|point| point.1));
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let area =
            area.titled(measured.prepared.scene.title, ("sans-serif", 20)).map_err(failed)?;
        let rows = if others_by_time.is_empty() { 1 } else { 2 };
        let (charts, key) = area.split_vertically(area.dim_in_pixel().1 - rows * KEY_PIXELS);
        let panels = charts.split_evenly((1, 3));
        if let [by_step, by_time, by_work] = &panels[..] {
            let step = |timed: &Timed| timed.row.method.step_ms();
            panel(by_step, measured, &others_by_step, "step [ms]", step)?;
            let time = "processor time per simulated second [µs]";
            panel(by_time, measured, &others_by_time, time, |timed| {
                timed.cpu_us.map(|cpu| cpu.median)
            })?;
            panel(by_work, measured, &[], "computations per simulated second", |timed| {
                let simulated_s = measured.prepared.until_s * timed.starts.max(1) as f64;
                Some(report::computations(timed.row.work) as f64 / simulated_s)
            })?;
        }
        legend(&key, &others_by_time)?;
        area.present().map_err(failed)?;
    }
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

/// Which colour is which method, below the panels and over no data.
fn legend(area: &Area<'_>, others: &[Curve<'_>]) -> Result<(), Error> {
    let marks = LINES.iter().map(|(name, colour)| (*name, *colour, 3_u32));
    let all = std::iter::once(("event-driven", BLACK, 6)).chain(EXACT).chain(marks);
    let mut x = 16;
    for (name, colour, size) in all {
        let y = KEY_PIXELS as i32 / 2;
        let line = PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(2));
        area.draw(&line).map_err(failed)?;
        area.draw(&Circle::new((x + 11, y), size, colour.filled())).map_err(failed)?;
        let style = ("sans-serif", 13).into_font().color(&BLACK);
        area.draw(&Text::new(name, (x + 28, y - 6), style)).map_err(failed)?;
        x += 36 + 6 * name.len() as i32;
    }
    let (mut x, y) = (16, KEY_PIXELS as i32 * 3 / 2);
    let mut seen = Vec::new();
    for curve in others {
        // The settings of a program share a colour and a name.
        if seen.contains(&curve.number) {
            continue;
        }
        seen.push(curve.number);
        let colour = OTHERS[curve.number % OTHERS.len()];
        area.draw(&Cross::new((x + 11, y), 4, colour.stroke_width(1))).map_err(failed)?;
        let style = ("sans-serif", 13).into_font().color(&BLACK);
        area.draw(&Text::new(curve.name, (x + 20, y - 6), style)).map_err(failed)?;
        x += 30 + 6 * curve.name.len() as i32;
    }
    Ok(())
}

fn panel(
    area: &Area<'_>,
    measured: &Measured,
    curves: &[Curve<'_>],
    what: &str,
    along: impl Fn(&Timed) -> Option<f64>,
) -> Result<(), Error> {
    let error_of = |timed: &Timed| {
        let ok = timed.row.status == Status::Ok;
        ok.then(|| timed.row.error_m.map(|error| error.max(LEAST_M))).flatten()
    };
    let drawn = |timed: &Timed| Some((along(timed)?, error_of(timed)?));
    let points: Vec<(f64, f64)> = measured.rows.iter().filter_map(drawn).collect();
    let others = || curves.iter().flat_map(|curve| &curve.points);
    let errors = measured.rows.iter().filter_map(error_of);
    let xs = decades(points.iter().chain(others()).map(|point| point.0));
    let ys = decades(errors.chain(others().map(|point| point.1.max(LEAST_M))));
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(40)
        .y_label_area_size(64)
        .build_cartesian_2d(xs.clone().log_scale(), ys.log_scale())
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_desc(what)
        .y_desc("error [m]")
        .x_label_formatter(&|x| format!("{x:.0e}"))
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .axis_desc_style(("sans-serif", 15))
        .label_style(("sans-serif", 12))
        .light_line_style(WHITE)
        .draw()
        .map_err(failed)?;
    let of = |name: &'static str| measured.rows.iter().filter(move |t| t.row.method.name() == name);
    for (method, colour) in LINES {
        let points: Vec<(f64, f64)> = of(method).filter_map(drawn).collect();
        let line = LineSeries::new(points, colour.filled().stroke_width(2)).point_size(3);
        chart.draw_series(line).map_err(failed)?;
    }
    for curve in curves {
        let colour = OTHERS[curve.number % OTHERS.len()];
        let points = || curve.points.iter().map(|(x, error)| (*x, error.max(LEAST_M)));
        chart.draw_series(LineSeries::new(points(), colour.stroke_width(1))).map_err(failed)?;
        let marks = points().map(|point| Cross::new(point, 3, colour.stroke_width(1)));
        chart.draw_series(marks).map_err(failed)?;
    }
    for (method, colour, size) in std::iter::once(("event-driven", BLACK, 6)).chain(EXACT) {
        for timed in of(method) {
            let Some(error) = error_of(timed) else { continue };
            // It has no step: a line across.
            let points = match along(timed) {
                None => vec![(xs.start, error), (xs.end, error)],
                Some(x) => vec![(x, error)],
            };
            let size = if points.len() > 1 { 0 } else { size };
            let line = LineSeries::new(points, colour.filled().stroke_width(2)).point_size(size);
            chart.draw_series(line).map_err(failed)?;
        }
    }
    Ok(())
}

/// How disturbances of 1e-12 grow in breaks.
pub fn growth(curves: &[Growth]) -> Result<String, Error> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (700, SIZE.1)).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let points = || curves.iter().flat_map(|growth| growth.curve.iter());
        let end = points().map(|point| point.0).fold(0.1, f64::max);
        let ys = decades(points().map(|point| point.1.max(LEAST_M)));
        let mut chart = ChartBuilder::on(&area)
            .caption("A disturbance of 1e-12 after three breaks", ("sans-serif", 20))
            .margin(10)
            .x_label_area_size(40)
            .y_label_area_size(60)
            .build_cartesian_2d(0.0..end, ys.log_scale())
            .map_err(failed)?;
        chart
            .configure_mesh()
            .x_desc("time [s]")
            .y_desc("ball that is off most [m]")
            .y_label_formatter(&|y| format!("{y:.0e}"))
            .light_line_style(WHITE)
            .draw()
            .map_err(failed)?;
        for (growth, (_, colour)) in curves.iter().zip(LINES) {
            let points = growth.curve.iter().map(|(t, off)| (*t, off.max(LEAST_M)));
            chart.draw_series(LineSeries::new(points, colour.stroke_width(2))).map_err(failed)?;
        }
        area.present().map_err(failed)?;
    }
    Ok(text)
}
