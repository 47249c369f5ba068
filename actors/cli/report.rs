//! `hapticbillard report`: how far each method is from the truth, at what cost, where it breaks.

mod builds;

mod cases;

mod closed_loop;

mod csv;

mod figure;

mod left_out;

mod measure;

mod page;

mod peers;

mod players;

mod stability;

use super::{Status, json_line, progress};
use builds::Builds;
use clap::Args;
use hapticbillard::report::{CATALOGUE, all_methods};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{read_text, write_whole};
use measure::Measured;
use serde_json::json;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Largest report of which a chapter is made anew [bytes].
const REPORT_MAX: u64 = 16 << 20;

const EXAMPLE: &str = "\
Writes errors.csv, a figure (SVG) for each scene and REPORT.md into the folder. Times are processor
times of this machine; everything else is the same on every machine.

Examples:
  hapticbillard report --quick
  hapticbillard report --out report --json
  hapticbillard report --left-out --builds tests/report/builds.json --out tests/report
  hapticbillard report --cases target/peers/cases.jsonl";

/// Measures error against run time of every method, and where each of them breaks.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct ReportArgs {
    /// The folder to write to.
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,

    /// Leaves out the smallest steps of dear scenes, and most starts: about a minute.
    #[arg(long)]
    pub quick: bool,

    /// Measures only these scenes.
    #[arg(long, value_name = "ID", num_args = 1..)]
    pub only: Vec<String>,

    /// Writes the scenes in numbers to this file, a JSON line each, and measures nothing: starts,
    /// laws, ground, and where the balls should be.
    #[arg(long, value_name = "FILE", conflicts_with = "peers")]
    pub cases: Option<PathBuf>,

    /// Adds what other programs made of the same cases, from the file that tests/peers writes.
    #[arg(long, value_name = "FILE")]
    pub peers: Option<PathBuf>,

    /// Adds what each feature of the program adds, from the file that tests/builds writes.
    #[arg(long, value_name = "FILE", conflicts_with = "cases")]
    pub builds: Option<PathBuf>,

    /// Measures only what scenes leave out, and puts that chapter in the place of the one in the
    /// folder's REPORT.md.
    #[arg(long, conflicts_with_all = ["cases", "peers", "only", "quick", "json"])]
    pub left_out: bool,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// Measures and writes.
pub fn run(args: &ReportArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let scenes = choose(&args.only)?;
    if let Some(file) = &args.cases {
        return cases::write(file, &scenes, args.quick, out);
    }
    // A file that cannot be read is refused before anything is measured.
    let builds = args.builds.as_deref().map(builds::read).transpose()?;
    let builds = builds.as_ref();
    if args.left_out {
        return renew(&args.out.join("REPORT.md"), builds, out);
    }
    let bar = progress(scenes.len() as u64 * all_methods().len() as u64, "rows");
    let measured: Vec<Measured> = scenes
        .iter()
        .map(|scene| measure::scene(*scene, args.quick, &bar))
        .collect::<Result<_, Error>>()?;
    bar.finish_and_clear();

    // A file that does not fit is refused before the rest is measured.
    let peers = args.peers.as_deref().map(|file| peers::read(file, &measured)).transpose()?;
    let peers = peers.as_ref();

    let bar = progress(stability::length(), "cells");
    let table = stability::measure(args.quick, &bar)?;
    bar.finish_and_clear();
    let loops = closed_loop::measure();
    let idle = left_out::measure()?;
    let players = players::measure(if args.quick { 4 } else { 40 })?;

    let write = |name: &str, text: &str| write_whole(&args.out.join(name), text.as_bytes());
    write("errors.csv", &csv::errors(&measured, peers))?;
    write("stability.csv", &csv::stability(&table))?;
    for scene in &measured {
        write(&figure::name(scene), &figure::scene(scene, peers)?)?;
    }
    write(figure::CHAOS, &figure::growth(&table.growth)?)?;
    write("closed_loop.csv", &closed_loop::csv(&loops))?;
    write(closed_loop::FIGURE, &closed_loop::draw(&loops)?)?;
    let idle = page::LeftOut { scenes: &idle, builds };
    write("REPORT.md", &page::page(&measured, peers, &table, &loops, &idle, &players, args.quick))?;
    print(args, &measured, out)
}

/// Puts the chapter of what is left out in the place of the one in a report.
fn renew(file: &Path, builds: Option<&Builds>, out: &mut dyn Write) -> Result<Status, Error> {
    let text = read_text(file, REPORT_MAX)?;
    let (before, after) = page::around_left_out(&text).ok_or_else(|| {
        let problem = "has no chapter of what is left out";
        Error::input(file.display().to_string(), problem, "make it without --left-out")
    })?;
    let scenes = left_out::measure()?;
    let chapter = page::left_out_alone(&page::LeftOut { scenes: &scenes, builds });
    write_whole(file, [before, &chapter, after].concat().as_bytes())?;
    writeln!(out, "{} scenes; read {}", scenes.len(), file.display())?;
    Ok(Status::Success)
}

fn choose(only: &[String]) -> Result<Vec<hapticbillard::report::Scene>, Error> {
    for id in only {
        if !CATALOGUE.iter().any(|scene| scene.id == id) {
            let known: Vec<&str> = CATALOGUE.iter().map(|scene| scene.id).collect();
            let problem = format!("there is no scene '{}'", id.escape_default());
            return Err(Error::input("--only", problem, format!("write {}", known.join(", "))));
        }
    }
    let wanted = |id: &str| only.is_empty() || only.iter().any(|other| other == id);
    Ok(CATALOGUE.into_iter().filter(|scene| wanted(scene.id)).collect())
}

fn print(args: &ReportArgs, measured: &[Measured], out: &mut dyn Write) -> Result<Status, Error> {
    let rows = || measured.iter().flat_map(|scene| scene.rows.iter());
    let failed = rows().filter(|timed| csv::status(&timed.row.status).0 == "failed").count();
    let left_out = rows().filter(|timed| csv::status(&timed.row.status).0 == "left out").count();
    let summary = json!({
        "rows": rows().count(), "failed": failed, "left_out": left_out, "folder": args.out,
    });
    if args.json {
        for timed in rows() {
            json_line(out, &csv::json(timed))?;
        }
        json_line(out, &json!({ "summary": summary }))?;
        return Ok(Status::Success);
    }
    let (count, folder) = (rows().count(), args.out.display());
    writeln!(
        out,
        "{count} rows, {failed} of them of runs that failed, {left_out} left out; \
         read {folder}/REPORT.md"
    )?;
    Ok(Status::Success)
}
