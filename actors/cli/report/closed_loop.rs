//! How stiff a haptic wall may be: measured, drawn and written down.

use super::figure;
use crate::cli::plot::failed;
use hapticbillard::report::{self, LOOP_HANDS, LoopRow};
use hapticbillard_actors::cpu_time::thread_cpu_time;
use hapticbillard_actors::error::Error;
use plotters::prelude::*;
use std::fmt::Write;

/// The file of the figure.
pub const FIGURE: &str = "closed_loop.svg";
/// Width and height [pixels].
const SIZE: (u32, u32) = (1100, 470);
/// Colours of the hands.
const COLOURS: [RGBColor; LOOP_HANDS.len()] =
    [RGBColor(110, 110, 110), RGBColor(213, 94, 0), RGBColor(0, 114, 178)];

/// A loop and what it took [ms].
pub struct Timed {
    /// What is known of it.
    pub row: LoopRow,
    /// Processor time of measurement and theory [ms].
    pub cpu_ms: f64,
}

/// Measures all loops.
pub fn measure() -> Vec<Timed> {
    let points = report::loop_points().into_iter().map(|point| {
        let begin = thread_cpu_time();
        let row = report::closed_loop(point);
        Timed { row, cpu_ms: (thread_cpu_time() - begin).as_secs_f64() * 1e3 }
    });
    points.collect()
}

/// All rows as comma-separated values.
pub fn csv(rows: &[Timed]) -> String {
    let mut text = String::from(
        "hand,period_s,delay_samples,measured_n_m,eigenvalues_n_m,late_n_m,passive_n_m,\
         passive_omni_n_m,cpu_ms\n",
    );
    let number = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.2}"));
    for Timed { row, cpu_ms } in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{},{},{},{},{},{:.2},{},{},{cpu_ms:.2}",
            row.point.hand,
            row.point.period_s,
            row.point.delay,
            number(row.measured_n_m),
            number(row.theory_n_m),
            row.late_n_m,
            number(row.passive_n_m),
            number(row.passive_omni_n_m),
        );
    }
    text
}

/// The chapter, without its heading.
pub fn chapter(text: &mut String, rows: &[Timed]) {
    let all_s = rows.iter().map(|timed| timed.cpu_ms).sum::<f64>() / 1e3;
    let _ = writeln!(
        text,
        "![largest stable stiffness against period and delay]({FIGURE})\n\n\
         What a hand feels as a wall is a spring whose force is computed once a period and held \
         in between, and may act some samples late. The stiffest wall at which a push dies away \
         is found by bisection through the servo's own tick and the simulated device, with a wall \
         that pushes and pulls, and without the safety stages. The device is a PHANTOM Omni of 45 \
         g and 0.1 N s/m without dry friction and with exact readings; nobody holds it, light \
         fingers (L) do, or a soft grip (G). Eigenvalues are those of one period of the same \
         loop; b/(T/2 + t_d) is the rule of Gil et al. (2004) with the damping of device and \
         hand; 2 b/T is passive in any hand (Colgate and Schenkel 1997), with an Omni's friction \
         and encoder at most 2 f_c/Δ (Abbott and Okamura 2005). Run time is this machine's, \
         {all_s:.1} s for all.\n"
    );
    text.push_str(
        "| hand | period [ms] | delay [samples] | measured [N/m] | eigenvalues | b/(T/2 + t_d) | \
         2 b/T | with an Omni's friction | run time [ms] |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    let number =
        |value: Option<f64>| value.map_or_else(|| String::from("-"), |value| format!("{value:.1}"));
    for Timed { row, cpu_ms } in rows {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.1} | {} | {} | {cpu_ms:.0} |",
            row.point.hand,
            row.point.period_s * 1e3,
            row.point.delay,
            number(row.measured_n_m),
            number(row.theory_n_m),
            row.late_n_m,
            number(row.passive_n_m),
            number(row.passive_omni_n_m),
        );
    }
    let worst = rows.iter().filter_map(|timed| {
        let (measured, theory) = (timed.row.measured_n_m?, timed.row.theory_n_m?);
        Some((measured / theory - 1.0).abs())
    });
    let worst = worst.fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "\nMeasured limits are within {:.2} % of the eigenvalues. Each sample of delay costs as \
         much as two more half periods: from 1 kHz to the 250 Hz of 2009 a wall loses a factor of \
         four, and one sample of delay a factor of three.\n",
        1e2 * worst
    );
}

/// Against the period without delay, and against the delay at 1 kHz.
pub fn draw(rows: &[Timed]) -> Result<String, Error> {
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE).map_err(failed)?;
        let title = "The stiffest haptic wall that does not swing up";
        let area = area.titled(title, ("sans-serif", 20)).map_err(failed)?;
        let (charts, key) = area.split_vertically(area.dim_in_pixel().1 - 30);
        let panels = charts.split_evenly((1, 2));
        let ys = figure::decades(rows.iter().flat_map(|timed| {
            [timed.row.measured_n_m.unwrap_or(timed.row.late_n_m), timed.row.late_n_m]
        }));
        if let [by_period, by_delay] = &panels[..] {
            let along = |row: &LoopRow| (row.point.delay == 0).then_some(row.point.period_s * 1e3);
            let chart = ChartBuilder::on(by_period)
                .margin(10)
                .x_label_area_size(40)
                .y_label_area_size(64)
                .build_cartesian_2d((0.2..10.0).log_scale(), ys.clone().log_scale())
                .map_err(failed)?;
            panel(chart, rows, "period [ms], no delay", along)?;
            let is_fast = |row: &LoopRow| row.point.period_s == 0.001;
            let along = |row: &LoopRow| is_fast(row).then_some(row.point.delay as f64);
            let chart = ChartBuilder::on(by_delay)
                .margin(10)
                .x_label_area_size(40)
                .y_label_area_size(64)
                .build_cartesian_2d(-0.2..4.2, ys.log_scale())
                .map_err(failed)?;
            panel(chart, rows, "delay [samples], period 1 ms", along)?;
        }
        legend(&key)?;
        area.present().map_err(failed)?;
    }
    Ok(text)
}

fn panel<'a, 'b, X>(
    mut chart: ChartContext<'a, SVGBackend<'b>, Cartesian2d<X, LogCoord<f64>>>,
    rows: &[Timed],
    what: &str,
    along: impl Fn(&LoopRow) -> Option<f64>,
) -> Result<(), Error>
where
    X: Ranged<ValueType = f64> + plotters::coord::ranged1d::ValueFormatter<f64>,
    'b: 'a,
{
    chart
        .configure_mesh()
        .x_desc(what)
        .y_desc("stiffness [N/m]")
        .x_label_formatter(&|x| format!("{x}"))
        .y_label_formatter(&|y| format!("{y}"))
        .axis_desc_style(("sans-serif", 15))
        .label_style(("sans-serif", 12))
        .light_line_style(WHITE)
        .draw()
        .map_err(failed)?;
    for ((hand, _), colour) in LOOP_HANDS.into_iter().zip(COLOURS) {
        let own = || rows.iter().map(|timed| &timed.row).filter(move |row| row.point.hand == hand);
        let line = |value: fn(&LoopRow) -> Option<f64>| -> Vec<(f64, f64)> {
            own().filter_map(|row| Some((along(row)?, value(row)?))).collect()
        };
        let theory = line(|row| row.theory_n_m);
        chart.draw_series(LineSeries::new(theory, colour.stroke_width(2))).map_err(failed)?;
        let late = line(|row| Some(row.late_n_m));
        chart
            .draw_series(DashedLineSeries::new(late, 5, 4, colour.stroke_width(1)))
            .map_err(failed)?;
        let measured = line(|row| row.measured_n_m);
        let marks = measured.into_iter().map(|point| Circle::new(point, 5, colour.filled()));
        chart.draw_series(marks).map_err(failed)?;
    }
    Ok(())
}

fn legend(area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>) -> Result<(), Error> {
    let write = |text: &str, x: i32| {
        let style = ("sans-serif", 13).into_font().color(&BLACK);
        area.draw(&Text::new(text.to_string(), (x, 9), style)).map_err(failed)
    };
    let names = ["nobody holds it", "L: light fingers", "G: soft grip"];
    let mut x = 16;
    for (name, colour) in names.into_iter().zip(COLOURS) {
        area.draw(&Circle::new((x, 15), 5, colour.filled())).map_err(failed)?;
        write(name, x + 12)?;
        x += 40 + 7 * name.len() as i32;
    }
    let lines = [("line: eigenvalues of one period", 0), ("dashed: b/(T/2 + t_d)", 4)];
    for (name, gap) in lines {
        for from in (x..x + 24).step_by(8) {
            let dash = PathElement::new([(from, 15), (from + 8 - gap, 15)], BLACK.stroke_width(2));
            area.draw(&dash).map_err(failed)?;
        }
        write(name, x + 30)?;
        x += 58 + 6 * name.len() as i32;
    }
    Ok(())
}
