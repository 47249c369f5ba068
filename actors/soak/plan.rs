//! Which fault strikes whom and when, from a seed; and what must come of it.

use crate::crew::Fault;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;
use std::time::Duration;

/// Somebody who can be struck, by the name under which the crew knows them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Victim {
    /// A computer player.
    Ai,
    /// Whoever acts from outside.
    Input,
    /// Whoever writes the recording.
    Recorder,
    /// The control of a sound card.
    Sound,
    /// The control of a haptic servo.
    Haptic,
    /// The simulation.
    Physics,
    /// The referee.
    Rules,
    /// The event manager.
    EventManager,
    /// The owner of the clock.
    Conductor,
    /// Somebody who only watches, inside the tick.
    Observer,
}

impl Victim {
    /// Those of every game.
    pub const ALWAYS: [Victim; 8] = [
        Victim::Ai,
        Victim::Input,
        Victim::Recorder,
        Victim::Physics,
        Victim::Rules,
        Victim::EventManager,
        Victim::Conductor,
        Victim::Observer,
    ];

    /// The name in the crew.
    pub fn name(self) -> &'static str {
        match self {
            Victim::Ai => "ai",
            Victim::Input => "input",
            Victim::Recorder => "recorder",
            Victim::Sound => crate::sound::SOUND,
            Victim::Haptic => crate::haptic::HAPTIC,
            Victim::Physics => "physics",
            Victim::Rules => "rules",
            Victim::EventManager => "event manager",
            Victim::Conductor => "conductor",
            Victim::Observer => "observer",
        }
    }
}

/// A kind of fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// [`Fault::Kill`]
    Kill,
    /// [`Fault::Panic`]
    Panic,
    /// [`Fault::Stall`]
    Stall,
    /// [`Fault::Delay`]
    Delay,
    /// [`Fault::Flood`]
    Flood,
}

impl FaultKind {
    /// All.
    pub const ALL: [FaultKind; 5] =
        [FaultKind::Kill, FaultKind::Panic, FaultKind::Stall, FaultKind::Delay, FaultKind::Flood];

    /// The kind of a fault.
    pub fn of(fault: Fault) -> Self {
        match fault {
            Fault::Kill => FaultKind::Kill,
            Fault::Panic => FaultKind::Panic,
            Fault::Stall(_) => FaultKind::Stall,
            Fault::Delay(_) => FaultKind::Delay,
            Fault::Flood(_) => FaultKind::Flood,
        }
    }
}

/// What must come of a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Survival {
    /// The game waits, and is the same.
    Waits,
    /// Another one takes the place, and the game is the same.
    Replaced,
    /// The game stops in order; everything up to there is recorded.
    Stops,
}

/// Who survives what.
pub fn survival(victim: Victim, kind: FaultKind) -> Survival {
    match (kind, victim) {
        (FaultKind::Stall | FaultKind::Delay | FaultKind::Flood, _) => Survival::Waits,
        (
            FaultKind::Kill | FaultKind::Panic,
            Victim::Ai | Victim::Input | Victim::Recorder | Victim::Sound | Victim::Haptic,
        ) => Survival::Replaced,
        // Nothing may be lost that these hold, and who is replaced can lose a queue.
        (
            FaultKind::Kill | FaultKind::Panic,
            Victim::Physics
            | Victim::Rules
            | Victim::EventManager
            | Victim::Conductor
            | Victim::Observer,
        ) => Survival::Stops,
    }
}

/// A fault to come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Planned {
    /// With which batch of events of the game, counted from 0.
    pub batch: u64,
    /// Whom.
    pub victim: Victim,
    /// What.
    pub fault: Fault,
}

/// Most faults of a game.
const FAULTS_MAX: usize = 5;
/// How long somebody is held up at most [µs].
const STALL_MAX_US: u64 = 15_000;
const DELAY_MAX_US: u64 = 40_000;
/// Messages of a flood at most.
const FLOOD_MAX: u32 = 3000;

/// From one to five faults that strike `victims` in a game of so many batches, in order. At most
/// one of them ends the game.
pub fn faults(seed: u64, batches: u64, victims: &[Victim]) -> Vec<Planned> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let count = random.random_range(1..=FAULTS_MAX);
    let mut planned: Vec<Planned> = Vec::new();
    let mut has_end = false;
    while planned.len() < count && !victims.is_empty() {
        let batch = random.random_range(0..batches.max(1));
        let victim = victims[random.random_range(0..victims.len())];
        let fault = fault(&mut random);
        let ends = survival(victim, FaultKind::of(fault)) == Survival::Stops;
        if !(ends && has_end) {
            has_end |= ends;
            planned.push(Planned { batch, victim, fault });
        }
    }
    planned.sort_by_key(|planned| planned.batch);
    planned
}

fn fault(random: &mut impl Rng) -> Fault {
    let kind = FaultKind::ALL[random.random_range(0..FaultKind::ALL.len())];
    match kind {
        FaultKind::Kill => Fault::Kill,
        FaultKind::Panic => Fault::Panic,
        FaultKind::Stall => Fault::Stall(micros(random, STALL_MAX_US)),
        FaultKind::Delay => Fault::Delay(micros(random, DELAY_MAX_US)),
        FaultKind::Flood => Fault::Flood(random.random_range(1..=FLOOD_MAX)),
    }
}

fn micros(random: &mut impl Rng, max: u64) -> Duration {
    Duration::from_micros(random.random_range(0..=max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_one_plan_and_no_plan_ends_a_game_twice() {
        let mut seen = std::collections::BTreeSet::new();
        for seed in 0..2000 {
            let plan = faults(seed, 50, &Victim::ALWAYS);
            assert_eq!(plan, faults(seed, 50, &Victim::ALWAYS));
            assert!((1..=FAULTS_MAX).contains(&plan.len()));
            assert!(plan.is_sorted_by_key(|planned| planned.batch));
            assert!(plan.iter().all(|planned| planned.batch < 50));
            let kinds = plan.iter().map(|p| (p.victim, FaultKind::of(p.fault)));
            let ends = |&(victim, kind): &_| survival(victim, kind) == Survival::Stops;
            assert!(kinds.clone().filter(ends).count() <= 1);
            seen.extend(kinds);
        }
        // Everybody is struck by everything.
        assert_eq!(seen.len(), Victim::ALWAYS.len() * FaultKind::ALL.len());
    }

    #[test]
    fn a_game_without_batches_or_victims_has_a_plan_too() {
        assert!(faults(1, 0, &Victim::ALWAYS).iter().all(|planned| planned.batch == 0));
        assert!(faults(1, 10, &[]).is_empty());
    }
}
