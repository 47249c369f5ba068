//! `hapticbillard learn`: how the paper's player learned to allow for throw, and how others do.

mod figure;

mod page;

mod throw;

use super::{Status, json_line, not_negative, progress};
use clap::{Args, ValueEnum};
use hapticbillard::ai::lesson::{
    self, Condition, Lesson, Strength, Summary, Trial, conditions, exams, practise,
};
use hapticbillard::physics::{PhysicsError, Profile};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use indicatif::ProgressBar;
use rayon::prelude::*;
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

/// Most shots of a lesson, and most lessons.
const SHOTS_MAX: i64 = 10_000;
const SEEDS_MAX: i64 = 100_000;

const EXAMPLE: &str = "\
Lessons are practice shots in the simulation: random cuts, ways and strokes. Every condition is a
set of contact laws: profile 2009 and standard, with and without ball friction and back-dated
contact. Without an option that names some, all conditions are run.
For each condition the folder gets a figure and a CSV of the lesson with the first seed (raw error,
threshold, filtered error, f, mean hit rate of 10 against shots, as figure 5.5 of the paper), and
for all of them LEARN.md and summary.json with the means over the seeds beside the paper's figures.

Examples:
  hapticbillard learn --out learn
  hapticbillard learn --out learn --profile 2009 --no-ball-friction --seeds 10
  hapticbillard learn --out learn --profile 2009 --outliers 0.3 --no-threshold
  hapticbillard learn --check
  hapticbillard learn --throw-table config/ai/throw.toml";

/// Lets the paper's player learn its aim by practice shots, and draws how.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct LearnArgs {
    /// The folder to write to.
    #[arg(long, value_name = "DIR", required_unless_present_any = ["check", "throw_table"])]
    pub out: Option<PathBuf>,

    /// Only this profile.
    #[arg(long, value_name = "PROFILE", value_parser = profile)]
    pub profile: Option<Profile>,

    /// Only without friction between balls.
    #[arg(long)]
    pub no_ball_friction: bool,

    /// Only where contacts are not computed back in time.
    #[arg(long)]
    pub no_back_dating: bool,

    /// Shots of a lesson [default: 60], or of a cell of a throw table [default: 200].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(20..=SHOTS_MAX))]
    pub shots: Option<u32>,

    /// Lessons of each condition.
    #[arg(long, value_name = "N", default_value_t = 100,
          value_parser = clap::value_parser!(u32).range(1..=SEEDS_MAX))]
    pub seeds: u32,

    /// Seed of the first lesson, or of a throw table.
    #[arg(long, value_name = "K", default_value_t = 1)]
    pub seed: u64,

    /// Share of shots in which the ball is hit on its way, unnoticed.
    #[arg(long, value_name = "X", default_value = "0.12", value_parser = share)]
    pub outliers: f64,

    /// Standard deviation of what the player sees of a ball's direction [°].
    #[arg(long, value_name = "DEG", default_value = "0.76", value_parser = not_negative)]
    pub observation_error: f64,

    /// Has every error believed, however large.
    #[arg(long)]
    pub no_threshold: bool,

    /// f before the first shot, from -0.9 to 1.5.
    #[arg(long, value_name = "F", default_value = "0", allow_negative_numbers = true,
          value_parser = factor)]
    pub start: f64,

    /// How hard the strokes are.
    #[arg(long, value_enum, default_value_t)]
    pub strokes: Strokes,

    /// Holds the paper's findings against lessons of their own conditions; exits with 1 if one is
    /// not met.
    #[arg(long, conflicts_with_all = ["profile", "no_ball_friction", "no_back_dating", "outliers",
          "observation_error", "no_threshold", "start", "strokes", "shots", "throw_table", "out"])]
    pub check: bool,

    /// Writes a throw table, f over cut and speed under profile standard, to this file, and tells
    /// how much better it aims than any single f.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["profile", "no_ball_friction",
          "no_back_dating", "outliers", "observation_error", "no_threshold", "start", "strokes",
          "seeds", "out"])]
    pub throw_table: Option<PathBuf>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// How hard the cue ball is struck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Strokes {
    /// It leaves with 1 to 5 m/s, whatever the way.
    #[default]
    Wide,
    /// As in play: in a band above what the ways need.
    Played,
}

fn profile(name: &str) -> Result<Profile, String> {
    serde_json::from_value(json!(name)).map_err(|_| String::from("expected 2009 or standard"))
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err(String::from("expected a number from 0 to 1")),
    }
}

fn factor(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if (-0.9..=1.5).contains(&number) => Ok(number),
        _ => Err(String::from("expected a number from -0.9 to 1.5")),
    }
}

/// Lessons under one condition.
pub struct Taught {
    /// The contact laws.
    pub condition: Condition,
    /// The lesson with the first seed.
    pub first: Vec<Trial>,
    /// f after each shot, mean over the seeds.
    pub mean_factors: Vec<f64>,
    /// Mean hit rate of 10 after each shot, mean over the seeds; none where no shot counts.
    pub mean_hits: Vec<Option<f64>>,
    /// What all have in common.
    pub summary: Summary,
}

/// Learns and writes.
pub fn run(args: &LearnArgs, out: &mut dyn Write) -> Result<Status, Error> {
    if let Some(file) = &args.throw_table {
        return throw::write(args, file, out);
    }
    if args.check {
        return check(args, out);
    }
    let Some(folder) = &args.out else {
        return Err(Error::input("--out", "there is no folder to write to", "name one"));
    };
    let chosen: Vec<Condition> = conditions().into_iter().filter(|c| args.wants(c)).collect();
    let lesson = args.lesson();
    let bar = progress(chosen.len() as u64 * u64::from(args.seeds), "lessons");
    let taught: Vec<Taught> = chosen
        .into_iter()
        .map(|condition| Ok(teach(condition, args, &lesson, &bar)?))
        .collect::<Result<_, Error>>()?;
    bar.finish_and_clear();

    let write = |name: &str, text: &str| write_whole(&folder.join(name), text.as_bytes());
    for one in &taught {
        let id = one.condition.id;
        write(&format!("{id}.svg"), &figure::draw(one, args.seed)?)?;
        write(&format!("{id}.csv"), &page::csv(&one.first))?;
    }
    write("LEARN.md", &page::page(&taught, args))?;
    let rows: Vec<_> = taught.iter().map(page::json).collect();
    let summary = json!({ "seeds": args.seeds, "seed": args.seed, "shots": lesson.shots,
        "outliers": lesson.outliers, "observation_error_deg": lesson.observation_error_deg,
        "threshold": lesson.threshold, "conditions": rows });
    write("summary.json", &format!("{summary:#}\n"))?;
    if args.json {
        for row in &rows {
            json_line(out, row)?;
        }
        let summary = json!({ "conditions": rows.len(), "folder": folder });
        json_line(out, &json!({ "summary": summary }))?;
    } else {
        writeln!(out, "{}\nread {}/LEARN.md", page::table(&taught), folder.display())?;
    }
    Ok(Status::Success)
}

impl LearnArgs {
    fn lesson(&self) -> Lesson {
        let usual = Lesson::default();
        Lesson {
            shots: self.shots.unwrap_or(usual.shots),
            start_factor: self.start,
            observation_error_deg: self.observation_error,
            outliers: self.outliers,
            threshold: !self.no_threshold,
            strength: match self.strokes {
                Strokes::Wide => usual.strength,
                Strokes::Played => Strength::AsPlayed,
            },
            ..usual
        }
    }

    fn wants(&self, condition: &Condition) -> bool {
        let physics = &condition.physics;
        self.profile.is_none_or(|profile| profile == physics.profile)
            && !(self.no_ball_friction && physics.ball_friction)
            && !(self.no_back_dating && physics.contact_back_dating)
    }

    /// All lessons of one condition, on all cores, in the order of the seeds.
    fn courses(
        &self,
        condition: &Condition,
        lesson: &Lesson,
        bar: &ProgressBar,
    ) -> Result<Vec<Vec<Trial>>, PhysicsError> {
        let table = lesson::practice_table(&condition.physics)?;
        let course = |number: u32| {
            let course = practise(lesson, &table, self.seed.wrapping_add(u64::from(number)));
            bar.inc(1);
            course
        };
        (0..self.seeds).into_par_iter().map(course).collect()
    }
}

fn teach(
    condition: Condition,
    args: &LearnArgs,
    lesson: &Lesson,
    bar: &ProgressBar,
) -> Result<Taught, PhysicsError> {
    let courses = args.courses(&condition, lesson, bar)?;
    let rates: Vec<_> = courses.iter().map(|course| lesson::mean_hit_rate(course)).collect();
    let shots = 0..lesson.shots as usize;
    let mean = |numbers: Vec<f64>| {
        (!numbers.is_empty()).then(|| numbers.iter().sum::<f64>() / numbers.len() as f64)
    };
    let factors = |shot: usize| courses.iter().filter_map(|c| Some(c.get(shot)?.factor)).collect();
    let hits = |shot: usize| rates.iter().filter_map(|r| r.get(shot).copied().flatten()).collect();
    Ok(Taught {
        mean_factors: shots.clone().filter_map(|shot| mean(factors(shot))).collect(),
        mean_hits: shots.map(|shot| mean(hits(shot))).collect(),
        summary: Summary::of(&courses),
        first: courses.into_iter().next().unwrap_or_default(),
        condition,
    })
}

/// Holds the findings against fresh lessons.
fn check(args: &LearnArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let exams = exams();
    let bar = progress(exams.len() as u64 * u64::from(args.seeds), "lessons");
    let (mut met, mut missed) = (0, 0);
    for exam in &exams {
        let courses = args.courses(&exam.condition, &exam.lesson, &bar)?;
        let summary = Summary::of(&courses);
        for demand in &exam.demands {
            let (value, ok) = demand.judge(&summary);
            if ok {
                met += 1
            } else {
                missed += 1
            }
            bar.suspend(|| page::print_check(args.json, exam, demand, value, ok, out))?;
        }
    }
    bar.finish_and_clear();
    if args.json {
        json_line(out, &json!({ "summary": { "met": met, "missed": missed } }))?;
    } else {
        writeln!(out, "{met} met, {missed} missed, over {} seeds", args.seeds)?;
    }
    Ok(if missed == 0 { Status::Success } else { Status::CheckFailed })
}
