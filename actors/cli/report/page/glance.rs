//! Which method for which error at what cost, at a glance.

use super::{cheapest, cost, error, exact, figure, named, say, stepped};
use crate::cli::report::measure::{Measured, Timed};
use hapticbillard::report::{self, Status};
use std::fmt::Write;

/// Errors that one may want [m], and what they are called.
const WANTED: [(f64, &str); 5] =
    [(1e-2, "1 cm"), (1e-3, "1 mm"), (1e-4, "0.1 mm"), (1e-5, "10 um"), (1e-6, "1 um")];

/// The tables up front.
pub fn glance(text: &mut String, measured: &[Measured]) {
    say!(text, "## Which method for which error at what cost\n");
    say!(
        text,
        "The cheapest run that is at least so good: method, and processor time in microseconds per \
         simulated second. Every method and step of this report takes part.\n"
    );
    let columns: Vec<&str> = WANTED.iter().map(|(_, name)| *name).collect();
    say!(text, "| scene | {} | the best there is |", columns.join(" | "));
    say!(text, "|---|{}", "---|".repeat(WANTED.len() + 1));
    for scene in measured {
        let mut line = format!("| {} |", scene.prepared.scene.id);
        for (error_m, _) in WANTED {
            let cell = match choice(scene, error_m) {
                Some((timed, us)) => format!("{}: {}", named(timed.row.method), cost(us)),
                None => String::from("none"),
            };
            let _ = write!(line, " {cell} |");
        }
        let ok = || scene.rows.iter().filter(|timed| timed.row.status == Status::Ok);
        let least = ok().filter_map(|timed| timed.row.error_m).fold(f64::INFINITY, f64::min);
        let best = cheapest(ok(), least).map(|(timed, us)| {
            format!("{:.0e} m, {}: {}", least, named(timed.row.method), cost(us))
        });
        say!(text, "{line} {} |", best.unwrap_or_else(|| String::from("none")));
    }
    against_steps(text, measured);
    fronts(text, measured);
}

/// The cheapest run that is at least so good. What is dearer by less than a fifth is as cheap, as
/// far as processor times can tell; the exact solver as it comes is then named before others.
fn choice(scene: &Measured, error_m: f64) -> Option<(&Timed, f64)> {
    let (timed, us) = cheapest(scene.rows.iter(), error_m)?;
    let own = cheapest(exact(scene).into_iter(), error_m);
    own.filter(|(_, own)| *own <= 1.2 * us).or(Some((timed, us)))
}

fn against_steps(text: &mut String, measured: &[Measured]) {
    say!(
        text,
        "\nThe event-driven method beside the cheapest fixed steps that are good to a millimetre, \
         and to ten micrometres:\n"
    );
    say!(
        text,
        "| scene | event-driven: error [m] | us per s | steps to 1 mm: us per s | times as dear | \
         steps to 10 um: us per s | times as dear |"
    );
    say!(text, "|---|---|---|---|---|---|---|");
    for scene in measured {
        let Some(timed) = exact(scene) else { continue };
        let own = timed.cpu_us.map(|cpu| cpu.median);
        let steps = |error_m: f64| match (cheapest(stepped(scene), error_m), own) {
            (Some((timed, us)), Some(own)) => {
                format!("{} ({}) | {}", cost(us), named(timed.row.method), ratio(us / own))
            }
            _ => String::from("none was so good | -"),
        };
        say!(
            text,
            "| {} | {} | {} | {} | {} |",
            scene.prepared.scene.id,
            error(timed.row.error_m),
            own.map_or_else(|| String::from("-"), cost),
            steps(1e-3),
            steps(1e-5),
        );
    }
}

fn ratio(value: f64) -> String {
    if value < 1.0 { format!("{value:.2}") } else { format!("{value:.1}") }
}

/// Rows that are at least as good as the exact one for at most its cost.
fn dominators<'a>(scene: &'a Measured, own: &Timed) -> Vec<&'a Timed> {
    let point = |timed: &Timed| Some((timed.row.error_m?, timed.cpu_us?.median));
    let Some((error, us)) = point(own) else { return Vec::new() };
    let better = |timed: &&Timed| {
        timed.row.status == Status::Ok
            && timed.row.method.step_ms().is_some()
            && point(timed).is_some_and(|(e, c)| e <= error && c <= us && (e < error || c < us))
    };
    scene.rows.iter().filter(better).collect()
}

fn fronts(text: &mut String, measured: &[Measured]) {
    let by_work = |scene: &&Measured| {
        let rows = scene.plain();
        rows.first().is_some_and(|row| report::on_the_front(row, &rows))
    };
    let by_time = |scene: &&Measured| {
        exact(scene).is_some_and(|own| own.cpu_us.is_some() && dominators(scene, own).is_empty())
    };
    let (count, work, time) = (
        measured.len(),
        measured.iter().filter(by_work).count(),
        measured.iter().filter(by_time).count(),
    );
    say!(
        text,
        "\n**The Pareto front.** A run is on the front if no other is better for the same cost or \
         cheaper for the same error. Event-driven is on the front of error against computations \
         (counted, the same on every machine) in {work} of {count} scenes, and on that of error \
         against run time in {time} of {count}. Being on the front is little if fixed steps are \
         cheaper for the errors that anybody wants; so each scene where some steps are good to a \
         centimetre or better for less has its own paragraph:\n"
    );
    let mut none = true;
    for scene in measured {
        let Some(own) = exact(scene) else { continue };
        let Some(us) = own.cpu_us.map(|cpu| cpu.median) else { continue };
        let cheaper: Vec<String> = WANTED
            .iter()
            .filter_map(|(error_m, name)| {
                let (timed, steps) = cheapest(stepped(scene), *error_m)?;
                (steps < us)
                    .then(|| format!("to {name} {} takes {}", named(timed.row.method), cost(steps)))
            })
            .collect();
        let off_time = dominators(scene, own);
        let off_work = !by_work(&scene);
        if cheaper.is_empty() && off_time.is_empty() && !off_work {
            continue;
        }
        none = false;
        let mut said = format!("- **{}**: ", scene.prepared.scene.id);
        if !cheaper.is_empty() {
            let _ = write!(said, "{} us per s, event-driven {}. ", cheaper.join(", "), cost(us));
        }
        if let Some(first) = off_time.first() {
            let _ = write!(
                said,
                "It is not on the front of run time: {} is as good for {} us per s. ",
                named(first.row.method),
                first.cpu_us.map_or_else(|| String::from("-"), |cpu| cost(cpu.median)),
            );
        }
        if off_work {
            said.push_str("It is not on the front of computations. ");
        }
        say!(text, "{said}{}", reason(scene, own));
    }
    if none {
        say!(text, "- There is none.");
    }
    say!(text, "\nThe same in pictures: [sliding]({}).\n", figure::file("sliding"));
}

/// Why event-driven is dear in a scene.
fn reason(scene: &Measured, own: &Timed) -> String {
    let simulated_s = scene.prepared.until_s * own.starts.max(1) as f64;
    let work = own.row.work;
    let a_second = work.events as f64 / simulated_s;
    let tests = work.tests() as f64 / work.events.max(1) as f64;
    let why = match scene.prepared.scene.id {
        "thousand" => {
            "A thousand balls meet so often that a step need not look for the moments: it handles \
             the contacts of a millisecond at once, while each event is found, queued and solved \
             on its own. Steps pay with errors that they cannot make smaller than a millimetre \
             within the time that they were given"
        }
        "pocket" => {
            "A ball on the rim has no closed form and goes in pieces; it pays those and the search \
             for edges around a pocket"
        }
        _ => "No special cause is known; the scene is so short that single calls decide",
    };
    format!("It computes {a_second:.0} events a second with {tests:.1} tests each. {why}.")
}
