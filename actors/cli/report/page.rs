//! `REPORT.md`: the tables, and what they say in plain words.

mod glance;
mod left_out;
mod scene;
mod stability;

use super::builds::{self, Builds};
use super::closed_loop;
use super::figure;
use super::left_out::Line;
use super::measure::{Measured, Timed};
use super::peers;
use super::players::Players;
use super::stability::Table;
use hapticbillard::haptic::DeviceSpec;
use hapticbillard::report::{self, Method, Peers, Status};
use hapticbillard_actors::files::{new_recording_name, processor_name};
use std::fmt::Write;

/// Adds a line. Writing to a string cannot fail.
macro_rules! say {
    ($text:expr, $($rest:tt)*) => {
        let _ = writeln!($text, $($rest)*);
    };
}
use say;

/// The whole page.
pub fn page(
    measured: &[Measured],
    peers: Option<&Peers>,
    table: &Table,
    loops: &[closed_loop::Timed],
    left_out: &LeftOut<'_>,
    players: &Players,
    quick: bool,
) -> String {
    let mut text = String::new();
    head(&mut text, quick, peers.is_some());
    glance::glance(&mut text, measured);
    if let Some(peers) = peers {
        peers::chapter(&mut text, measured, peers);
    }
    scene::how_to_read(&mut text);
    for scene in measured {
        scene::chapter(&mut text, scene, peers);
    }
    stability::chaos(&mut text, table);
    stability::chapter(&mut text, table);
    say!(text, "### How stiff a haptic wall may be\n");
    closed_loop::chapter(&mut text, loops);
    left_out::chapter(&mut text, left_out, None);
    beyond(&mut text, players);
    left_out::missing(&mut text, measured, quick);
    text
}

/// What is left out: of scenes, and of the program.
pub struct LeftOut<'a> {
    /// The scenes.
    pub scenes: &'a [Line],
    /// The program with each feature, if somebody built it.
    pub builds: Option<&'a Builds>,
}

/// The chapter of what is left out, which says when it was made.
pub fn left_out_alone(left_out: &LeftOut<'_>) -> String {
    let mut text = String::new();
    let name = new_recording_name();
    let date = name.split('_').next().unwrap_or_default();
    let made = format!(
        "This chapter was made on {date} in a run of its own, `hapticbillard report --left-out`, \
         on {}. ",
        processor_name()
    );
    left_out::chapter(&mut text, left_out, Some(&made));
    text
}

/// What stands before that chapter in a report, and what behind.
pub fn around_left_out(report: &str) -> Option<(&str, &str)> {
    let begin = report.find(left_out::HEADING)?;
    let inside = begin + left_out::HEADING.len();
    let end = report[inside..].find("\n## ").map_or(report.len(), |at| inside + at + 1);
    Some((&report[..begin], &report[end..]))
}

fn head(text: &mut String, quick: bool, peers: bool) {
    let name = new_recording_name();
    let date = name.split('_').next().unwrap_or_default();
    let build = if cfg!(debug_assertions) { "with debug assertions" } else { "optimised" };
    let flag = if quick { " --quick" } else { "" };
    let others = if peers { " --peers tests/report/peers.json" } else { "" };
    say!(text, "# Error against run time\n");
    say!(
        text,
        "Made on {date} by `hapticbillard report{flag}`, version {}, {build}, {}, on {}.\n",
        env!("CARGO_PKG_VERSION"),
        env!("COMPILER"),
        processor_name()
    );
    say!(
        text,
        "Made anew by one command, from the root of the repository:\n\n```text\ncargo run \
         --release -p hapticbillard-actors --no-default-features -- report{flag}{others} \
         --out tests/report\n```\n"
    );
    say!(
        text,
        "Errors, counters and classes are the same on every machine; processor times are this \
         one's, of one thread, and so is what was too slow. All rows are in \
         [errors.csv](errors.csv), [stability.csv](stability.csv) and \
         [closed_loop.csv](closed_loop.csv). An error is the distance of \
         a ball from where it should be, in metres, for the ball and the time where it is largest, \
         and the median over a few starts that differ a little. Runs that failed stay in the \
         tables.\n"
    );
}

/// The row of the exact solver.
fn exact(scene: &Measured) -> Option<&Timed> {
    scene.rows.iter().find(|timed| timed.row.method == Method::EventDriven)
}

/// Rows in steps.
fn stepped(scene: &Measured) -> impl Iterator<Item = &Timed> {
    scene.rows.iter().filter(|timed| timed.row.method.step_ms().is_some())
}

/// The cheapest of `rows` that is at least as good as `error_m`, and its cost.
fn cheapest<'a>(rows: impl Iterator<Item = &'a Timed>, error_m: f64) -> Option<(&'a Timed, f64)> {
    rows.filter(|timed| timed.row.status == Status::Ok)
        .filter(|timed| timed.row.error_m.is_some_and(|error| error <= error_m))
        .filter_map(|timed| Some((timed, timed.cpu_us?.median)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
}

/// A method with its step.
fn named(method: Method) -> String {
    match method.step_ms() {
        None => method.name().to_string(),
        Some(step) => format!("{} {step} ms", method.name()),
    }
}

/// An error as a number.
pub(super) fn error(value: Option<f64>) -> String {
    value.map_or_else(|| String::from("-"), |value| format!("{value:.1e}"))
}

/// A cost [us].
fn cost(value: f64) -> String {
    if value < 10.0 { format!("{value:.1}") } else { format!("{value:.0}") }
}

fn beyond(text: &mut String, players: &Players) {
    say!(text, "## Beyond physics\n");
    say!(
        text,
        "**Win rate against decision time.** There is one kind of computer player, so that there \
         is one point and no curve yet: the paper's player decides in {:.3} ms of processor time \
         (mean of {} games, `hapticbillard match --timing`). Against itself the first of two won \
         {} and the second {}; {} of its {} shots were fouls.\n",
        players.decision_ms,
        players.games,
        players.wins[0],
        players.wins[1],
        players.fouls,
        players.shots,
    );
    felt_walls(text);
}

/// The servo's own wall, felt at several rates.
fn felt_walls(text: &mut String) {
    say!(
        text,
        "**Force error of the haptic wall against servo rate.** A stylus of {:.0} g without \
         friction runs at {} m/s into a wall of {:.0} N/m, which the servo of the game computes \
         and the simulated device holds for a period. The error is the largest difference from the \
         spring's force where the stylus is, over the spring's peak. It falls with the first order \
         of the period, and so does what the stylus gains; no better integrator would help, \
         because the force is late. Which walls swing up stands under \"how stiff a haptic wall \
         may be\".\n",
        DeviceSpec::OMNI.mass_kg * 1e3,
        report::SPEED_M_S,
        report::STIFFNESS_N_M,
    );
    say!(text, "| rate [Hz] | force error | theory for short periods | speed after over before |");
    say!(text, "|---|---|---|---|");
    for rate in report::RATES_HZ {
        let wall = report::felt_wall(rate);
        let ratio = wall.speed_ratio.map_or_else(|| String::from("-"), |r| format!("{r:.4}"));
        say!(
            text,
            "| {:.0} | {:.2} % | {:.2} % | {ratio} |",
            wall.rate_hz,
            1e2 * wall.force_error,
            1e2 * wall.theory
        );
    }
    say!(text, "");
}
