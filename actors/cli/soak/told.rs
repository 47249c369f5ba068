//! What `soak` says: a line a game in JSON, and the summary.

use crate::cli::{Status, json_line};
use hapticbillard::hash::Digest;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::soak::{
    Ended, FaultKind, Growth, Played, Reference, Struck, Victim, end_of,
};
use serde::Serialize;
use std::collections::BTreeMap;
use std::io::Write;
use std::time::Duration;

/// A game that was played.
pub struct Game<'a> {
    /// Its number.
    pub number: u64,
    /// Threads of the runtime.
    pub workers: u16,
    /// The game as it must be.
    pub reference: &'a Reference,
    /// What became of it.
    pub played: &'a Played,
}

/// A line of JSON about a game.
#[derive(Serialize)]
struct Line {
    game: u64,
    workers: u16,
    end: String,
    events: usize,
    faults: Vec<FaultLine>,
    stopped: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    wrong: Option<String>,
}

#[derive(Serialize)]
struct FaultLine {
    tick: u64,
    victim: Victim,
    kind: FaultKind,
    struck: usize,
}

/// A cell of the table of faults.
#[derive(Serialize)]
struct Cell {
    victim: Victim,
    kind: FaultKind,
    struck: u64,
}

/// The summary.
#[derive(Serialize)]
struct Summary {
    games: u64,
    ticks: u64,
    events: u64,
    stopped_in_order: u64,
    wrong: u64,
    faults: Vec<Cell>,
    hash: Digest,
    growth: Option<Growth>,
    seconds: f64,
}

/// Counts, and says it.
pub struct Told {
    is_json: bool,
    games: u64,
    ticks: u64,
    events: u64,
    stopped: u64,
    wrong: Vec<String>,
    struck: BTreeMap<(Victim, FaultKind), u64>,
}

impl Told {
    /// Nothing yet.
    pub fn new(is_json: bool) -> Self {
        let (games, ticks, events, stopped) = (0, 0, 0, 0);
        let (wrong, struck) = (Vec::new(), BTreeMap::new());
        Told { is_json, games, ticks, events, stopped, wrong, struck }
    }

    /// Takes a game.
    pub fn game(&mut self, game: &Game<'_>, out: &mut dyn Write) -> Result<(), Error> {
        self.games += 1;
        self.ticks += game.reference.finished.tick.0;
        self.events += game.reference.seen.events.len() as u64;
        let Played { struck, ended } = game.played;
        let stopped = matches!(ended, Ok(Ended::Stopped));
        let wrong = ended.as_ref().err().map(ToString::to_string);
        self.stopped += u64::from(stopped);
        for one in struck.iter().filter(|one| 0 < one.victims) {
            let kind = FaultKind::of(one.planned.fault);
            *self.struck.entry((one.planned.victim, kind)).or_default() += 1;
        }
        if let Some(wrong) = &wrong {
            let line = format!("game {} with {} workers: {wrong}", game.number, game.workers);
            if !self.is_json {
                writeln!(out, "{line}")?;
                out.flush()?;
            }
            self.wrong.push(line);
        }
        if self.is_json {
            let fault = |one: &Struck| FaultLine {
                tick: one.tick.0,
                victim: one.planned.victim,
                kind: FaultKind::of(one.planned.fault),
                struck: one.victims,
            };
            let line = Line {
                game: game.number,
                workers: game.workers,
                end: end_of(&game.reference.finished),
                events: game.reference.seen.events.len(),
                faults: struck.iter().map(fault).collect(),
                stopped,
                wrong,
            };
            json_line(out, &line)?;
        }
        Ok(())
    }

    /// Says the summary.
    pub fn end(
        self,
        hash: Digest,
        growth: Option<Growth>,
        took: Duration,
        out: &mut dyn Write,
    ) -> Result<Status, Error> {
        let grown = growth.map(|growth| growth.faults()).unwrap_or_default();
        let status = match self.wrong.is_empty() && grown.is_empty() {
            true => Status::Success,
            false => Status::CheckFailed,
        };
        if self.is_json {
            let cell = |(&(victim, kind), &struck): (&_, &_)| Cell { victim, kind, struck };
            let summary = Summary {
                games: self.games,
                ticks: self.ticks,
                events: self.events,
                stopped_in_order: self.stopped,
                wrong: self.wrong.len() as u64,
                faults: self.struck.iter().map(cell).collect(),
                hash,
                growth,
                seconds: took.as_secs_f64(),
            };
            json_line(out, &BTreeMap::from([("summary", summary)]))?;
            return Ok(status);
        }
        let (same, games) = (self.games - self.stopped - self.wrong.len() as u64, self.games);
        writeln!(out, "{games} games, {} events, in {:.0} s", self.events, took.as_secs_f64())?;
        writeln!(out, "  {same} the same as in lockstep, to the bit")?;
        writeln!(out, "  {} stopped in order, recorded up to there", self.stopped)?;
        writeln!(out, "  {} wrong", self.wrong.len())?;
        writeln!(out, "  hash {hash}")?;
        if !self.struck.is_empty() {
            self.table(out)?;
        }
        match growth {
            None => writeln!(out, "too few games to say what grows")?,
            Some(Growth { memory_kib: [early, late], threads, handles }) => writeln!(
                out,
                "between games, early and late: {early:.0} and {late:.0} KiB, {} and {} threads, \
                 {} and {} handles",
                threads[0], threads[1], handles[0], handles[1]
            )?,
        }
        grown.iter().try_for_each(|fault| writeln!(out, "{fault}"))?;
        Ok(status)
    }

    /// Who was struck by what, how often.
    fn table(&self, out: &mut dyn Write) -> Result<(), Error> {
        write!(out, "\n{:<15}", "struck")?;
        for kind in FaultKind::ALL {
            write!(out, "{:>8}", format!("{kind:?}").to_lowercase())?;
        }
        writeln!(out)?;
        for victim in Victim::ALWAYS {
            write!(out, "{:<15}", victim.name())?;
            for kind in FaultKind::ALL {
                let count = self.struck.get(&(victim, kind)).copied().unwrap_or_default();
                write!(out, "{count:>8}")?;
            }
            writeln!(out)?;
        }
        writeln!(out)?;
        Ok(())
    }
}
