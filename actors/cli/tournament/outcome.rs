//! What pairings and players came to.

use super::plan::{Match, Plan};
use crate::cli::racks::Rack;
use hapticbillard::hash::Digest;
use hapticbillard::ids::PlayerId;
use hapticbillard::quantile::nearest_rank;
use hapticbillard::replay::TickHash;
use hapticbillard::scene::Entrant;
use hapticbillard::tally::{Account, Decision, Tally, wilson};
use hapticbillard_actors::stopwatch::Took;
use serde::Serialize;

/// What a pairing came to.
pub struct Outcome {
    /// Who played at which noise.
    pub game: Match,
    /// Racks that were played.
    pub racks: u32,
    /// Racks that nobody won.
    pub draws: u32,
    /// Racks without an end.
    pub stalled: u32,
    /// What each player did.
    pub accounts: [Account; 2],
    /// How long their decisions took, if they were timed.
    pub decisions: [Vec<Took>; 2],
}

impl Outcome {
    /// Before the first rack.
    pub fn new(game: &Match) -> Self {
        let (accounts, decisions) = <([Account; 2], [Vec<Took>; 2])>::default();
        Outcome { game: *game, racks: 0, draws: 0, stalled: 0, accounts, decisions }
    }

    /// Adds a rack.
    pub fn add(&mut self, rack: &Rack) {
        self.racks += 1;
        match (rack.tally.winner, rack.tally.over) {
            (Some(_), _) => {}
            (None, true) => self.draws += 1,
            (None, false) => self.stalled += 1,
        }
        for (seat, player) in [PlayerId::ONE, PlayerId::TWO].into_iter().enumerate() {
            self.accounts[seat] += Account::of(&rack.tally, player);
            self.decisions[seat].extend(&rack.decisions[seat]);
        }
    }

    /// Racks that each player won.
    pub fn wins(&self) -> [u32; 2] {
        self.accounts.map(|account| account.wins)
    }

    /// Share of the decided racks that the first player won; none before the first.
    pub fn share(&self) -> Option<f64> {
        let [won, lost] = self.wins();
        (won + lost > 0).then(|| f64::from(won) / f64::from(won + lost))
    }

    /// Wilson's interval of [`Self::share`].
    pub fn interval(&self) -> [f64; 2] {
        let [won, lost] = self.wins();
        wilson(won, won + lost)
    }

    /// What the sequential test says, if there is one.
    pub fn verdict(&self) -> Option<Decision> {
        let [won, lost] = self.wins();
        self.game.until.map(|test| test.decide(won, lost))
    }

    /// Whether the question of the pairing is answered.
    pub fn is_decided(&self) -> bool {
        self.verdict().is_some_and(|decision| decision != Decision::Open)
    }

    /// Its line of JSON.
    pub fn line(&self, is_timed: bool) -> PairingLine {
        PairingLine {
            players: self.game.players.map(|player| player.to_string()),
            noise: self.game.noise,
            racks: self.racks,
            wins: self.wins(),
            share: self.share(),
            interval95: self.interval(),
            draws: self.draws,
            stalled: self.stalled,
            goal: self.game.until.map(|test| test.goal()),
            verdict: self.verdict(),
            accounts: self.accounts,
            decision_ms: is_timed.then(|| {
                let [one, two] = &self.decisions;
                [Times::of(one), Times::of(two)]
            }),
        }
    }
}

/// A pairing as JSON.
#[derive(Serialize)]
pub struct PairingLine {
    players: [String; 2],
    noise: f64,
    racks: u32,
    wins: [u32; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    share: Option<f64>,
    interval95: [f64; 2],
    draws: u32,
    stalled: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    goal: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    verdict: Option<Decision>,
    accounts: [Account; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    decision_ms: Option<[Times; 2]>,
}

/// A rack as JSON.
#[derive(Serialize)]
pub struct RackLine<'a> {
    players: [String; 2],
    noise: f64,
    rack: u32,
    #[serde(flatten)]
    tally: &'a Tally,
    ticks: u64,
    state_hash: Option<Digest>,
}

impl<'a> RackLine<'a> {
    /// The line of the rack with this number, counted from 0.
    pub fn new(game: &Match, number: u32, rack: &'a Rack) -> Self {
        RackLine {
            players: game.players.map(|player| player.to_string()),
            noise: game.noise,
            rack: number + 1,
            tally: &rack.tally,
            ticks: rack.finished.tick.0,
            state_hash: rack.finished.hash.as_ref().map(TickHash::all),
        }
    }
}

/// What a player came to at one noise, against everybody.
pub struct Standing {
    /// Who.
    pub player: Entrant,
    /// Noise of those who have none of their own.
    pub noise: f64,
    /// What it did.
    pub account: Account,
    /// How long its decisions took, if they were timed.
    pub decisions: Vec<Took>,
}

impl Standing {
    /// Every player at every noise, in the order of the command line.
    pub fn of_all(plan: &Plan, outcomes: &[Outcome]) -> Vec<Standing> {
        let mut standings: Vec<Standing> = Vec::new();
        for outcome in outcomes {
            for (seat, player) in outcome.game.players.into_iter().enumerate() {
                let noise = outcome.game.noise;
                let known = standings.iter_mut().find(|s| (s.player, s.noise) == (player, noise));
                let (account, decisions) = (outcome.accounts[seat], &outcome.decisions[seat]);
                match known {
                    Some(standing) => {
                        standing.account += account;
                        standing.decisions.extend(decisions);
                    }
                    None => {
                        let decisions = decisions.clone();
                        standings.push(Standing { player, noise, account, decisions });
                    }
                }
            }
        }
        let place = |standing: &Standing| {
            let noise = plan.matches.iter().position(|game| game.noise == standing.noise);
            (noise, plan.players.iter().position(|player| *player == standing.player))
        };
        standings.sort_by_key(place);
        standings
    }

    /// Its line of JSON.
    pub fn line(&self, is_timed: bool) -> PlayerLine {
        let decided = self.account.wins + self.account.losses;
        PlayerLine {
            player: self.player.to_string(),
            noise: self.noise,
            account: self.account,
            win_interval95: wilson(self.account.wins, decided),
            success: self.account.success(),
            success_interval95: wilson(self.account.made, self.account.aimed),
            break_and_run: self.account.break_and_run(),
            run_out_from_hand: self.account.run_out_from_hand(),
            decision_ms: is_timed.then(|| Times::of(&self.decisions)),
        }
    }
}

/// A player as JSON.
#[derive(Serialize)]
pub struct PlayerLine {
    player: String,
    noise: f64,
    #[serde(flatten)]
    account: Account,
    win_interval95: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    success: Option<f64>,
    success_interval95: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    break_and_run: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    run_out_from_hand: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    decision_ms: Option<Times>,
}

/// The last line of JSON.
#[derive(Serialize)]
pub struct Summary {
    pairings: usize,
    racks: u32,
    draws: u32,
    stalled: u32,
    decided: usize,
}

impl Summary {
    /// Of all pairings.
    pub fn of(outcomes: &[Outcome]) -> Self {
        Summary {
            pairings: outcomes.len(),
            racks: outcomes.iter().map(|outcome| outcome.racks).sum(),
            draws: outcomes.iter().map(|outcome| outcome.draws).sum(),
            stalled: outcomes.iter().map(|outcome| outcome.stalled).sum(),
            decided: outcomes.iter().filter(|outcome| outcome.is_decided()).count(),
        }
    }
}

/// How long decisions took [ms]: half of them no longer than the median, 95 of 100 no longer than
/// p95.
#[derive(Debug, Default, Clone, Copy, PartialEq, Serialize)]
pub struct Times {
    /// How many.
    pub decisions: usize,
    /// Processor time: median and p95.
    pub cpu: [f64; 2],
    /// Time by the clock on the wall: median and p95.
    pub wall: [f64; 2],
}

impl Times {
    /// Of these decisions.
    pub fn of(took: &[Took]) -> Self {
        let ms = |of: fn(&Took) -> f64| {
            let mut all: Vec<f64> = took.iter().map(of).collect();
            all.sort_by(f64::total_cmp);
            [0.5, 0.95].map(|share| nearest_rank(&all, share).unwrap_or(0.0))
        };
        Times {
            decisions: took.len(),
            cpu: ms(|took| took.cpu.as_secs_f64() * 1e3),
            wall: ms(|took| took.wall.as_secs_f64() * 1e3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decisions_that_nobody_took_took_no_time() {
        assert_eq!(Times::of(&[]), Times::default());
    }
}
