//! The figure of a lesson, as figure 5.5 of the paper: errors, f and hit rate against shots.

use super::super::plot::{COLOURS, failed};
use super::Taught;
use hapticbillard::ai::lesson::{Trial, mean_hit_rate};
use hapticbillard_actors::error::Error;
use plotters::coord::Shift;
use plotters::prelude::*;

/// Width and height [pixels].
const SIZE: (u32, u32) = (900, 860);
/// Height of the legend above a panel [pixels].
const KEY_PIXELS: u32 = 26;
/// Errors beyond this are drawn at the edge [°].
const ERROR_DEG: f64 = 25.0;
const BLUE: RGBColor = COLOURS[0];
const RED: RGBColor = COLOURS[1];
const GREEN: RGBColor = COLOURS[2];
const GREY: RGBColor = RGBColor(130, 130, 130);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Points = Vec<(f64, f64)>;

/// A row of the legend: what is drawn, in which colour, and whether as a mark.
type Key<'a> = (&'a str, RGBColor, bool);

/// Draws the lesson with the seed `seed`, and the means over all seeds.
pub fn draw(taught: &Taught, seed: u64) -> Result<String, Error> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let title = format!("Learning to aim: {}, seed {seed}", taught.condition.title);
        let area = area.titled(&title, ("sans-serif", 20)).map_err(failed)?;
        let height = f64::from(area.dim_in_pixel().1);
        let (errors, rest) = area.split_vertically((0.42 * height) as u32);
        let (factors, hits) = rest.split_vertically((0.29 * height) as u32);
        draw_errors(&errors, &taught.first)?;
        draw_factors(&factors, taught)?;
        draw_hits(&hits, taught)?;
        area.present().map_err(failed)?;
    }
    Ok(text)
}

fn numbered(values: impl Iterator<Item = f64>) -> Points {
    (1..).map(f64::from).zip(values).collect()
}

/// Raw errors, those that were accepted full, between both thresholds; the filtered error.
fn draw_errors(area: &Area<'_>, course: &[Trial]) -> Result<(), Error> {
    let key = [
        ("raw error, accepted", BLUE, true),
        ("raw error, sorted out", RED, true),
        ("± threshold", GREY, false),
        ("filtered error", BLACK, false),
    ];
    let area = legend(area, &key)?;
    let mut chart = axes(&area, course.len(), -ERROR_DEG..ERROR_DEG, "error [°]", None)?;
    for sign in [1.0, -1.0] {
        let limit = course.iter().map(|trial| sign * trial.threshold_deg.min(ERROR_DEG));
        let line = LineSeries::new(numbered(limit), GREY.stroke_width(1));
        chart.draw_series(line).map_err(failed)?;
    }
    let mean = numbered(course.iter().map(|trial| trial.mean_error_deg));
    chart.draw_series(LineSeries::new(mean, BLACK.stroke_width(2))).map_err(failed)?;
    for (shot, trial) in (1..).map(f64::from).zip(course) {
        let Some(error) = trial.error_deg else { continue };
        let at = (shot, error.clamp(-ERROR_DEG, ERROR_DEG));
        if trial.believed {
            let mark = Circle::new(at, 3, BLUE.filled());
            chart.draw_series(std::iter::once(mark)).map_err(failed)?;
        } else {
            let mark = Cross::new(at, 4, RED.stroke_width(2));
            chart.draw_series(std::iter::once(mark)).map_err(failed)?;
        }
    }
    Ok(())
}

/// f of this lesson, its mean over all seeds, and the paper's.
fn draw_factors(area: &Area<'_>, taught: &Taught) -> Result<(), Error> {
    let f = numbered(taught.first.iter().map(|trial| trial.factor));
    let mean = numbered(taught.mean_factors.iter().copied());
    let all = || f.iter().chain(&mean).map(|point| point.1);
    let low = (all().fold(-0.1, f64::min) * 10.0 - 0.5).floor() / 10.0;
    let high = (all().fold(0.2, f64::max) * 10.0 + 0.5).ceil() / 10.0;
    let is_papers = taught.condition.id == "2009";
    let mut key: Vec<Key<'_>> = vec![("f", GREEN, false), ("mean over all seeds", GREY, false)];
    if is_papers {
        key.push(("paper: 0.45 ± 0.1", RGBColor(200, 225, 200), true));
    }
    let area = legend(area, &key)?;
    let mut chart = axes(&area, taught.first.len(), low..high.max(low + 0.1), "f", None)?;
    if is_papers {
        let shots = taught.first.len() as f64 + 1.0;
        let band = Rectangle::new([(20.0, 0.35), (shots, 0.55)], GREEN.mix(0.2).filled());
        chart.draw_series(std::iter::once(band)).map_err(failed)?;
    }
    chart.draw_series(LineSeries::new(mean, GREY.stroke_width(1))).map_err(failed)?;
    chart.draw_series(LineSeries::new(f, GREEN.stroke_width(2))).map_err(failed)?;
    Ok(())
}

/// Mean hit rate of 10 of this lesson, and its mean over all seeds.
fn draw_hits(area: &Area<'_>, taught: &Taught) -> Result<(), Error> {
    let key = [("hit rate, mean of 10", RED, false), ("mean over all seeds", GREY, false)];
    let area = legend(area, &key)?;
    let shots = taught.first.len();
    let mut chart = axes(&area, shots, 0.0..100.0, "hits [%]", Some("shot"))?;
    let percent = |rates: &[Option<f64>]| -> Points {
        let rates = (1..).map(f64::from).zip(rates);
        rates.filter_map(|(shot, rate)| Some((shot, 1e2 * (*rate)?))).collect()
    };
    let mean = percent(&taught.mean_hits);
    chart.draw_series(LineSeries::new(mean, GREY.stroke_width(1))).map_err(failed)?;
    let own = percent(&mean_hit_rate(&taught.first));
    chart.draw_series(LineSeries::new(own, RED.stroke_width(2))).map_err(failed)?;
    Ok(())
}

type Chart<'a, 'b> = ChartContext<
    'a,
    SVGBackend<'b>,
    Cartesian2d<plotters::coord::types::RangedCoordf64, plotters::coord::types::RangedCoordf64>,
>;

fn axes<'a, 'b>(
    area: &'a Area<'b>,
    shots: usize,
    ys: std::ops::Range<f64>,
    y_title: &str,
    x_title: Option<&str>,
) -> Result<Chart<'a, 'b>, Error> {
    let mut chart = ChartBuilder::on(area)
        .margin_left(10)
        .margin_right(20)
        .x_label_area_size(if x_title.is_some() { 42 } else { 22 })
        .y_label_area_size(60)
        .build_cartesian_2d(0.0..shots as f64 + 1.0, ys)
        .map_err(failed)?;
    chart
        .configure_mesh()
        .x_desc(x_title.unwrap_or_default())
        .y_desc(y_title)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_labels(6)
        .axis_desc_style(("sans-serif", 15))
        .label_style(("sans-serif", 12))
        .light_line_style(WHITE)
        .draw()
        .map_err(failed)?;
    Ok(chart)
}

/// Writes what is what above a panel, and returns what is left of the area.
fn legend<'b>(area: &Area<'b>, rows: &[Key<'_>]) -> Result<Area<'b>, Error> {
    let (key, rest) = area.split_vertically(KEY_PIXELS);
    let (mut x, y) = (76, KEY_PIXELS as i32 / 2);
    for (name, colour, mark) in rows {
        if *mark {
            key.draw(&Circle::new((x + 8, y), 5, colour.filled())).map_err(failed)?;
        } else {
            let line = PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(2));
            key.draw(&line).map_err(failed)?;
        }
        let style = ("sans-serif", 13).into_font().color(&BLACK);
        key.draw(&Text::new((*name).to_string(), (x + 24, y - 6), style)).map_err(failed)?;
        x += 44 + 7 * name.chars().count() as i32;
    }
    Ok(rest)
}
