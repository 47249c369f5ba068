//! `hapticbillard rules`: the paper's rule console (section 5.2).

use super::{Status, json_line, progress};
use clap::Args;
use hapticbillard::rules::{
    Console, ConsoleAnswer, GameKind, Language, ScenarioStatus, Texts, diagram, read_scenarios,
    run_scenario,
};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{open_lines, read_text};
use serde_json::json;
use std::io::{self, BufRead, BufReader, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};

/// Largest file of scenarios [bytes].
const SCENARIOS_BYTES_MAX: u64 = 64 << 20;
/// Longest line that is handed to the console, which refuses it in its own words [bytes].
const LINE_BYTES_MAX: u64 = (1 << 20) + 2;

const EXAMPLE: &str = "\
Reads facts, one JSON object a line, as `simulate --json` prints them or typed by hand; other lines
of `simulate` are passed over. Besides facts a line may be

  {\"call\":{\"ball\":\"3\",\"pocket\":\"FL\"}}   what is announced before a shot; also \"safety\",
                                         \"push_out\", or \"nothing\" to take it back
  {\"choose\":\"accept\"}                  one of the options that a verdict leaves to a player
  {\"undo\":true}                        training: the last shot was none
  {\"state\":{\"player\":2,..}}            goes on from another state

Examples:
  (echo '{\"state\":{\"on_table\":[\"3\",\"8\"]}}'
   echo '{\"call\":{\"ball\":\"3\",\"pocket\":\"FL\"}}'
   echo '{\"t\":0,\"e\":\"tip\",\"ball\":\"0\"}'
   echo '{\"t\":1,\"e\":\"hit\",\"a\":\"0\",\"b\":\"3\"}'
   echo '{\"t\":2,\"e\":\"pocket\",\"ball\":\"3\",\"pocket\":\"FL\"}'
   echo '{\"t\":3,\"e\":\"settle\"}') | hapticbillard rules --game wpa8 --why
  hapticbillard rules --game paper8 --why facts.jsonl
  echo '{\"t\":0,\"e\":\"tip\",\"ball\":\"0\"}' | hapticbillard rules
  hapticbillard simulate --scene break_shot --json | hapticbillard rules --game free_play
  hapticbillard rules --diagram --game paper-eight-ball
  hapticbillard rules --scenarios scenarios.json --game paper8 --json";

/// The rule console: facts in, state and verdict out.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct RulesArgs {
    /// Files of facts, one a line; none: reads stdin.
    #[arg(value_name = "FILE")]
    pub files: Vec<PathBuf>,

    #[arg(long, value_name = "GAME", help = game_help())]
    pub game: Option<GameKind>,

    /// Says why a verdict is as it is.
    #[arg(long)]
    pub why: bool,

    /// Prints the phases of the game as a Mermaid diagram instead.
    #[arg(long, conflicts_with_all = ["files", "why", "json"])]
    pub diagram: bool,

    /// Judges a file of scenarios instead; exits with 1 if one fails.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["files", "diagram"])]
    pub scenarios: Option<PathBuf>,

    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// What is said of `--game`: all games there are.
fn game_help() -> String {
    let games = GameKind::ALL.map(|game| format!("{} ({})", game.id(), game.short_id()));
    format!(
        "The game: {} [default: paper-eight-ball]. With --scenarios: only that game's",
        games.join(", ")
    )
}

/// Judges.
pub fn run(args: &RulesArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let game = args.game.unwrap_or(GameKind::PaperEightBall);
    if args.diagram {
        out.write_all(diagram(game).as_bytes())?;
        return Ok(Status::Success);
    }
    if let Some(file) = &args.scenarios {
        return scenarios(args, file, out);
    }
    let mut session = Session {
        console: Console::new(game),
        texts: Texts::new(Language::English).for_game(game),
        args,
        verdicts: 0,
        fouls: 0,
    };
    if args.files.is_empty() {
        let stdin = io::stdin();
        let typed = stdin.is_terminal();
        session.read(&mut stdin.lock(), "stdin", typed, out)?;
    }
    for file in &args.files {
        let mut lines = BufReader::new(open_lines(file)?);
        session.read(&mut lines, &file.display().to_string(), false, out)?;
    }
    let state = session.console.answer().state;
    if args.json {
        let (verdicts, fouls) = (session.verdicts, session.fouls);
        let summary = json!({ "game": game.short_id(), "verdicts": verdicts, "fouls": fouls,
            "state": state });
        json_line(out, &json!({ "summary": summary }))?;
    } else {
        writeln!(out, "{} verdicts, {} of them fouls", session.verdicts, session.fouls)?;
    }
    Ok(Status::Success)
}

struct Session<'a> {
    console: Console,
    texts: Texts,
    args: &'a RulesArgs,
    verdicts: u64,
    fouls: u64,
}

impl Session<'_> {
    /// Feeds every line to the console. Who types may go on after a mistake.
    fn read(
        &mut self,
        lines: &mut dyn BufRead,
        name: &str,
        typed: bool,
        out: &mut dyn Write,
    ) -> Result<(), Error> {
        loop {
            let mut bytes = Vec::new();
            let failed = |reason| Error::Read { path: name.into(), reason };
            if lines.take(LINE_BYTES_MAX).read_until(b'\n', &mut bytes).map_err(failed)? == 0 {
                return Ok(());
            }
            match self.console.feed_line(&String::from_utf8_lossy(&bytes)) {
                Ok(answer) => self.print(&answer, out)?,
                Err(error) if typed => eprintln!("{error}"),
                Err(error) => {
                    let fix = "correct the line, or leave it out";
                    return Err(Error::input(name, error.to_string(), fix));
                }
            }
            if typed {
                out.flush()?;
            }
        }
    }

    fn print(&mut self, answer: &ConsoleAnswer, out: &mut dyn Write) -> Result<(), Error> {
        if let Some(verdict) = &answer.verdict {
            self.verdicts += 1;
            self.fouls += u64::from(!verdict.legal);
        }
        if !answer.heard {
            return Ok(());
        }
        if self.args.json {
            return match (&answer.verdict, self.args.why) {
                (Some(verdict), true) => {
                    let mut line = serde_json::to_value(answer).map_err(io::Error::from)?;
                    line["why"] = json!(self.texts.why(verdict));
                    json_line(out, &line)
                }
                _ => json_line(out, answer),
            };
        }
        let Some(verdict) = &answer.verdict else {
            let phase = answer.phase;
            let call = answer.call.as_ref().map(|call| self.texts.call(call));
            let turn = answer.turn.as_ref().map(|turn| self.texts.turn(turn));
            let said: Vec<String> = call.into_iter().chain(turn).collect();
            if said.is_empty() {
                writeln!(out, "{phase:?}")?;
            } else {
                writeln!(out, "{phase:?}: {}", said.join(" "))?;
            }
            return Ok(());
        };
        writeln!(out, "{:?}: {}", answer.phase, self.texts.verdict(verdict))?;
        if self.args.why {
            for reason in self.texts.why(verdict) {
                writeln!(out, "  {reason}")?;
            }
        }
        if let Some(turn) = &answer.turn {
            writeln!(out, "{}", self.texts.turn(turn))?;
        }
        Ok(())
    }
}

fn scenarios(args: &RulesArgs, file: &Path, out: &mut dyn Write) -> Result<Status, Error> {
    let text = read_text(file, SCENARIOS_BYTES_MAX)?;
    let mut scenarios = read_scenarios(&text).map_err(|error| {
        let fix = "see `hapticbillard rules --help`";
        Error::input(file.display().to_string(), error.to_string(), fix)
    })?;
    if let Some(game) = args.game {
        scenarios.retain(|scenario| scenario.ruleset == game.short_id());
    }
    let texts = Texts::new(Language::English);
    let bar = progress(scenarios.len() as u64, "scenarios");
    let (mut pass, mut fail, mut unsupported) = (0, 0, 0);
    for scenario in &scenarios {
        let result = run_scenario(scenario);
        let (count, word) = match result.status {
            ScenarioStatus::Pass => (&mut pass, "pass"),
            ScenarioStatus::Fail => (&mut fail, "FAIL"),
            ScenarioStatus::Unsupported => (&mut unsupported, "unsupported"),
        };
        *count += 1;
        if args.json {
            json_line(out, &result)?;
        } else {
            writeln!(out, "{word}  {}", result.id)?;
            for difference in &result.differences {
                writeln!(out, "      {}: {}", difference.key, difference.problem)?;
            }
            let why = result.verdict.as_ref().filter(|_| args.why);
            for reason in why.map(|verdict| texts.why(verdict)).unwrap_or_default() {
                writeln!(out, "      {reason}")?;
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    if args.json {
        json_line(
            out,
            &json!({ "summary": { "pass": pass, "fail": fail,
            "unsupported": unsupported } }),
        )?;
    } else {
        writeln!(out, "{pass} pass, {fail} fail, {unsupported} unsupported")?;
    }
    Ok(if fail == 0 { Status::Success } else { Status::CheckFailed })
}
