//! A player's account: the same counts for each rack, added up over many.

use super::Tally;
use crate::ids::PlayerId;
use serde::Serialize;
use std::ops::AddAssign;

/// What a player did in so many racks.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Account {
    /// Racks.
    pub racks: u32,
    /// Racks that were won.
    pub wins: u32,
    /// Racks that were lost.
    pub losses: u32,
    /// Shots that were judged.
    pub shots: u32,
    /// Shots that were fouls.
    pub fouls: u32,
    /// Fouls although the player had considered a shot that was none in any of its simulations.
    pub avoidable: u32,
    /// Object balls that fell.
    pub pots: u32,
    /// Shots that were meant to pocket a ball.
    pub aimed: u32,
    /// Those of them that did, without a foul.
    pub made: u32,
    /// Shots that were meant to pocket nothing, breaks left out.
    pub safeties: u32,
    /// Breaks.
    pub breaks: u32,
    /// Racks won in the visit that began with the break.
    pub break_and_runs: u32,
    /// Visits that began with the cue ball in hand anywhere.
    pub in_hand: u32,
    /// Those of them that won the rack.
    pub in_hand_won: u32,
    /// Racks won in one visit that cleared them.
    pub run_outs: u32,
}

impl Account {
    /// A player's account of one rack.
    pub fn of(tally: &Tally, player: PlayerId) -> Self {
        let seat = player.index();
        let won = tally.winner == Some(player);
        Account {
            racks: 1,
            wins: u32::from(won),
            losses: u32::from(tally.winner.is_some() && !won),
            shots: tally.shots[seat],
            fouls: tally.fouls[seat],
            avoidable: tally.avoidable[seat],
            pots: tally.pots[seat],
            aimed: tally.aimed[seat],
            made: tally.made[seat],
            safeties: tally.safeties[seat],
            breaks: tally.breaks[seat],
            break_and_runs: u32::from(won && tally.break_and_run),
            in_hand: tally.in_hand[seat],
            in_hand_won: tally.in_hand_won[seat],
            run_outs: u32::from(won && tally.run_out),
        }
    }

    /// Share of the aimed shots that succeeded; none without any.
    pub fn success(&self) -> Option<f64> {
        share(self.made, self.aimed)
    }

    /// Share of the visits with the ball in hand that won the rack; none without any.
    pub fn run_out_from_hand(&self) -> Option<f64> {
        share(self.in_hand_won, self.in_hand)
    }

    /// Share of the breaks after which the rack was won without the other player's shooting; none
    /// without any.
    pub fn break_and_run(&self) -> Option<f64> {
        share(self.break_and_runs, self.breaks)
    }
}

fn share(part: u32, whole: u32) -> Option<f64> {
    (whole > 0).then(|| f64::from(part) / f64::from(whole))
}

impl AddAssign for Account {
    fn add_assign(&mut self, other: Account) {
        self.racks += other.racks;
        self.wins += other.wins;
        self.losses += other.losses;
        self.shots += other.shots;
        self.fouls += other.fouls;
        self.avoidable += other.avoidable;
        self.pots += other.pots;
        self.aimed += other.aimed;
        self.made += other.made;
        self.safeties += other.safeties;
        self.breaks += other.breaks;
        self.break_and_runs += other.break_and_runs;
        self.in_hand += other.in_hand;
        self.in_hand_won += other.in_hand_won;
        self.run_outs += other.run_outs;
    }
}
