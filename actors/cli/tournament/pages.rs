//! What a tournament shows: two tables on the screen, a page of Markdown with figures.

use super::TournamentArgs;
use super::figure;
use super::outcome::{Outcome, Standing, Times};
use super::table::Table;
use hapticbillard::tally::Decision;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::write_whole;
use hapticbillard_actors::game::Stage;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Both tables.
pub fn on_screen(outcomes: &[Outcome], standings: &[Standing], is_timed: bool) -> String {
    format!("{}\n{}", pairings(outcomes).on_screen(), players(standings, is_timed).on_screen())
}

/// Writes the page and its figures; says which files.
pub fn write(
    folder: &Path,
    args: &TournamentArgs,
    stage: &Stage,
    outcomes: &[Outcome],
    standings: &[Standing],
) -> Result<Vec<PathBuf>, Error> {
    let mut figures = vec![("wins.svg", figure::wins(outcomes)?)];
    if args.noise.len() > 1 {
        figures.push(("robustness.svg", figure::robustness(outcomes, standings)?));
    }
    let mut page = String::from("# Tournament\n\n");
    let game = stage.scene.rules.map(|rules| rules.game.to_string()).unwrap_or_default();
    let seed = args.seed.unwrap_or(stage.scene.about.seed);
    let _ = writeln!(
        page,
        "{game}, scene `{}`, seed {seed}, at most {} racks a pairing, breaks alternate. Intervals \
         are Wilson's at 95 %, of decided racks.\n",
        args.scene, args.racks
    );
    let _ = writeln!(page, "{}", pairings(outcomes).markdown());
    let _ = writeln!(page, "{}", players(standings, args.timing).markdown());
    for (name, _) in &figures {
        let _ = writeln!(page, "![{}]({name})\n", name.trim_end_matches(".svg"));
    }
    let files = std::iter::once(("tournament.md", page)).chain(figures);
    let written = files.map(|(name, text)| {
        let path = folder.join(name);
        write_whole(&path, text.as_bytes()).map(|()| path)
    });
    written.collect()
}

fn pairings(outcomes: &[Outcome]) -> Table {
    let mut table = Table::new(&[
        "pairing", "noise", "racks", "won", "lost", "drawn", "no end", "wins %", "95 %", "goal",
    ]);
    for outcome in outcomes {
        let [won, lost] = outcome.wins();
        let goal = match (outcome.game.until, outcome.verdict()) {
            (Some(test), Some(decision)) => {
                let answer = match decision {
                    Decision::Reached => "reached",
                    Decision::Missed => "missed",
                    Decision::Open => "open",
                };
                format!("{} %: {answer}", percent(test.goal()))
            }
            _ => String::from("-"),
        };
        table.row(vec![
            outcome.game.title(),
            outcome.game.noise.to_string(),
            outcome.racks.to_string(),
            won.to_string(),
            lost.to_string(),
            outcome.draws.to_string(),
            outcome.stalled.to_string(),
            outcome.share().map_or_else(|| String::from("-"), percent),
            interval(outcome.interval()),
            goal,
        ]);
    }
    table
}

fn players(standings: &[Standing], is_timed: bool) -> Table {
    let mut head = vec![
        "player",
        "noise",
        "racks",
        "won",
        "shots/rack",
        "success %",
        "95 %",
        "run-outs",
        "break and run %",
        "from hand %",
        "fouls/rack",
        "avoidable",
        "safeties/rack",
    ];
    if is_timed {
        head.extend(["CPU ms median", "p95", "wall ms median", "p95"]);
    }
    let mut table = Table::new(&head);
    for standing in standings {
        let account = &standing.account;
        let racks = f64::from(account.racks.max(1));
        let per_rack = |count: u32| format!("{:.2}", f64::from(count) / racks);
        let of = |share: Option<f64>, whole: u32| match share {
            Some(share) => format!("{} of {whole}", percent(share)),
            None => String::from("-"),
        };
        let mut cells = vec![
            standing.player.to_string(),
            standing.noise.to_string(),
            account.racks.to_string(),
            account.wins.to_string(),
            per_rack(account.shots),
            of(account.success(), account.aimed),
            interval(hapticbillard::tally::wilson(account.made, account.aimed)),
            account.run_outs.to_string(),
            of(account.break_and_run(), account.breaks),
            of(account.run_out_from_hand(), account.in_hand),
            per_rack(account.fouls),
            account.avoidable.to_string(),
            per_rack(account.safeties),
        ];
        if is_timed {
            let times = Times::of(&standing.decisions);
            cells.extend([times.cpu, times.wall].concat().iter().map(|ms| format!("{ms:.2}")));
        }
        table.row(cells);
    }
    table
}

fn percent(share: f64) -> String {
    format!("{:.1}", share * 100.0)
}

fn interval([low, high]: [f64; 2]) -> String {
    format!("{}-{}", percent(low), percent(high))
}
