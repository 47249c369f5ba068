//! The files, and the table of what is in them.

use super::BankArgs;
use super::sounds::{Sound, all};
use crate::cli::{Status, json_line, progress};
use hapticbillard::sound::level::{FULL_SCALE_PA, decibels};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use hapticbillard_actors::sound::bank_files::encode;
use indicatif::ProgressBar;
use realfft::RealFftPlanner;
use serde_json::json;
use std::io::Write;

/// So many files take long enough to show how far they are.
const MANY: usize = 300;

/// What was written, and what is in it.
#[derive(Debug, serde::Serialize)]
struct Row {
    file: String,
    class: &'static str,
    speed_m_s: Option<f32>,
    peak_db_spl: f32,
    centroid_hz: f32,
    length_s: f32,
}

/// Writes the files and prints the table.
pub fn run(args: &BankArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let sounds = all(args.variants);
    let bar = match sounds.len() > MANY {
        true => progress(sounds.len() as u64, "sounds"),
        false => ProgressBar::hidden(),
    };
    let mut rows = Vec::with_capacity(sounds.len());
    for sound in &sounds {
        rows.push(write(sound, args)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    print(&rows, args, out)?;
    Ok(Status::Success)
}

/// Writes one file.
fn write(sound: &Sound, args: &BankArgs) -> Result<Row, Error> {
    let samples = sound.render(args.rate);
    let file = sound.file();
    let path = args.out.join(&file);
    let scaled: Vec<f32> = samples.iter().map(|sample| sample / FULL_SCALE_PA).collect();
    let bytes = encode(&scaled, 1, args.rate).map_err(|reason| Error::Write {
        path: path.clone(),
        reason: std::io::Error::other(reason),
    })?;
    write_whole(&path, &bytes)?;
    let peak_pa = samples.iter().fold(0.0_f32, |peak, sample| peak.max(sample.abs()));
    Ok(Row {
        file,
        class: sound.class(),
        speed_m_s: sound.speed_m_s(),
        peak_db_spl: decibels(peak_pa),
        centroid_hz: centroid_hz(&samples, args.rate),
        length_s: samples.len() as f32 / args.rate as f32,
    })
}

/// The mean frequency, weighted by energy [Hz].
fn centroid_hz(samples: &[f32], rate_hz: u32) -> f32 {
    // Zeros behind the end, so that a short sound has a fine spectrum too.
    let length = samples.len().next_power_of_two().max(8192);
    let mut input = samples.to_vec();
    input.resize(length, 0.0);
    let transform = RealFftPlanner::<f32>::new().plan_fft_forward(length);
    let mut output = transform.make_output_vec();
    if transform.process(&mut input, &mut output).is_err() {
        return f32::NAN;
    }
    let bins = || output.iter().enumerate();
    let moment: f64 = bins().map(|(i, bin)| i as f64 * f64::from(bin.norm_sqr())).sum();
    let energy: f64 = bins().map(|(_, bin)| f64::from(bin.norm_sqr())).sum();
    (moment / energy * f64::from(rate_hz) / length as f64) as f32
}

fn print(rows: &[Row], args: &BankArgs, out: &mut dyn Write) -> Result<(), Error> {
    if args.json {
        rows.iter().try_for_each(|row| json_line(out, row))?;
        let summary = json!({ "out": args.out, "files": rows.len(), "rate_hz": args.rate });
        return json_line(out, &json!({ "summary": summary }));
    }
    let head = ["file", "class", "m/s", "dB SPL", "centroid", "length"];
    writeln!(
        out,
        "{:<34} {:<10} {:>5} {:>7} {:>8} {:>7}",
        head[0], head[1], head[2], head[3], head[4], head[5]
    )?;
    for row in rows {
        let speed = row.speed_m_s.map_or_else(String::new, |speed| speed.to_string());
        writeln!(
            out,
            "{:<34} {:<10} {speed:>5} {:>7.1} {:>5.0} Hz {:>5.2} s",
            row.file, row.class, row.peak_db_spl, row.centroid_hz, row.length_s
        )?;
    }
    let folder = args.out.display();
    Ok(writeln!(out, "{folder}: {} files, {} samples a second", rows.len(), args.rate)?)
}
