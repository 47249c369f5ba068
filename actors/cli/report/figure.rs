//! Figures: errors against steps and against run time, on logarithmic scales.

use super::measure::{Measured, Timed};
use super::peers::{self, Curve};
use hapticbillard::report::{Growth, PeerRow, Peers, Status};
use hapticbillard_actors::error::Error;
use plotters::prelude::*;
use std::fmt::Display;

/// The file of the figure on chaos.
pub const CHAOS: &str = "chaos.svg";
/// Errors below this are drawn there [m].
const LEAST_M: f64 = 1e-17;
/// Width and height [pixels].
const SIZE: (u32, u32) = (1000, 460);
/// The methods in steps and their colours.
const LINES: [(&str, RGBColor); 3] = [
    ("euler-cromer", RGBColor(213, 94, 0)),
    ("velocity-verlet", RGBColor(0, 114, 178)),
    ("rk4", RGBColor(0, 158, 115)),
];
/// Other programs' colours.
const OTHERS: [RGBColor; 4] = [
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(120, 120, 120),
];

fn failed(error: impl Display) -> Error {
    Error::Output(std::io::Error::other(format!("a figure could not be drawn: {error}")))
}

/// The file of a scene's figure.
pub fn name(measured: &Measured) -> String {
    format!("{}.svg", measured.prepared.scene.id)
}

/// The next power of ten below and above all values.
fn decades(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (low, high) = values
        .fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    if !(low <= high) {
        return 1e-3..1.0;
    }
    let power = |value: f64| 10.0_f64.powi(value as i32);
    power(low.log10().floor())..power((high * 1.001).log10().ceil())
}

/// Error against step, and error against processor time.
pub fn scene(measured: &Measured, peers: Option<&Peers>) -> Result<String, Error> {
    let id = measured.prepared.scene.id;
    let curves = |along: fn(&PeerRow) -> Option<f64>| {
        peers.map_or_else(Vec::new, |peers| peers::curves(peers, id, along))
    };
    let by_step = curves(|row| row.step_ms);
    let by_time = curves(|row| row.point().map(|point| point.1));
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let area =
            area.titled(measured.prepared.scene.title, ("sans-serif", 20)).map_err(failed)?;
        let (left, right) = area.split_horizontally(SIZE.0 / 2);
        panel(&left, measured, &by_step, "step [ms]", |timed| timed.row.method.step_ms())?;
        let time = "processor time per simulated second [us]";
        panel(&right, measured, &by_time, time, |timed| timed.cpu_us.map(|cpu| cpu.median))?;
        area.present().map_err(failed)?;
    }
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

fn panel(
    area: &Area<'_>,
    measured: &Measured,
    curves: &[Curve<'_>],
    what: &str,
    along: impl Fn(&Timed) -> Option<f64>,
) -> Result<(), Error> {
    let drawn = |timed: &Timed| {
        let ok = timed.row.status == Status::Ok;
        ok.then(|| Some((along(timed)?, timed.row.error_m?.max(LEAST_M)))).flatten()
    };
    let points: Vec<(f64, f64)> = measured.rows.iter().filter_map(drawn).collect();
    let exact = measured.rows.iter().find(|timed| timed.row.method.step_ms().is_none());
    let exact_error = exact.and_then(|timed| timed.row.error_m).map(|error| error.max(LEAST_M));
    let others = || curves.iter().flat_map(|curve| &curve.points);
    let xs = decades(points.iter().chain(others()).map(|point| point.0));
    let errors = points.iter().chain(others()).map(|point| point.1.max(LEAST_M));
    let ys = decades(errors.chain(exact_error));
    let mut chart = ChartBuilder::on(area)
        .margin(10)
        .x_label_area_size(40)
        .y_label_area_size(60)
        .build_cartesian_2d(xs.clone().log_scale(), ys.log_scale())
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_desc(what)
        .y_desc("error [m]")
        .x_label_formatter(&|x| format!("{x:.0e}"))
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .light_line_style(WHITE)
        .draw()
        .map_err(failed)?;
    for (method, colour) in LINES {
        let points: Vec<(f64, f64)> = measured
            .rows
            .iter()
            .filter(|timed| timed.row.method.name() == method)
            .filter_map(drawn)
            .collect();
        chart
            .draw_series(LineSeries::new(points.clone(), colour.stroke_width(2)).point_size(3))
            .map_err(failed)?
            .label(method)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], colour.stroke_width(2)));
    }
    let mut named = None;
    for curve in curves {
        let colour = OTHERS[curve.number % OTHERS.len()];
        let points = || curve.points.iter().map(|(x, error)| (*x, error.max(LEAST_M)));
        chart.draw_series(LineSeries::new(points(), colour.stroke_width(1))).map_err(failed)?;
        let marks = points().map(|point| Cross::new(point, 3, colour.stroke_width(1)));
        let series = chart.draw_series(marks).map_err(failed)?;
        // The settings of a program share a colour and a name.
        if named != Some(curve.number) {
            named = Some(curve.number);
            series
                .label(curve.name)
                .legend(move |(x, y)| Cross::new((x + 10, y), 3, colour.stroke_width(1)));
        }
    }
    if let (Some(timed), Some(error)) = (exact, exact_error) {
        let style = BLACK.stroke_width(2);
        let series = match along(timed) {
            // It has no step: a line across.
            None => LineSeries::new([(xs.start, error), (xs.end, error)], style),
            Some(x) => LineSeries::new([(x, error)], style).point_size(6),
        };
        chart
            .draw_series(series)
            .map_err(failed)?
            .label("event-driven")
            .legend(|(x, y)| PathElement::new([(x, y), (x + 20, y)], BLACK.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .position(SeriesLabelPosition::LowerRight)
        .draw()
        .map_err(failed)
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
