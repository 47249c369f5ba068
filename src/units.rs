//! Units and the logical clock.
//!
//! Everything is SI: metre, kilogram, second, radian. Plain `f64` with the unit in the name, except
//! for the two kinds of time, which are easily mixed up: [`Seconds`] of the simulation and
//! [`Tick`]s of the logical clock.

use serde::{Deserialize, Serialize};

/// A point or span of simulated time [s].
pub type Seconds = f64;

/// Length of one tick of the logical clock [s].
pub const TICK_S: Seconds = 0.001;

/// One millisecond of the logical clock. Tick `n` carries physics from `(n-1)` ms to `n` ms.
#[derive(
    Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(transparent)]
pub struct Tick(pub u64);

impl Tick {
    /// The time at the end of this tick [s]. Division, not multiplication by 0.001: the result is
    /// the double nearest to the decimal number, so that it prints as one.
    pub fn end_s(self) -> Seconds {
        self.0 as f64 / 1000.0
    }

    /// The time at the start of this tick [s]: when the commands of its frame act.
    pub fn start_s(self) -> Seconds {
        self.0.saturating_sub(1) as f64 / 1000.0
    }

    /// The tick that carries what happens at `time_s`: the first whose end is not before it.
    pub fn containing(time_s: Seconds) -> Self {
        let guess = libm::ceil(time_s * 1000.0).max(0.0) as u64;
        // The product may be off by an ulp on either side of a whole number.
        [guess.saturating_sub(1), guess, guess + 1]
            .into_iter()
            .map(Tick)
            .find(|tick| tick.end_s() >= time_s)
            .unwrap_or(Tick(guess + 1))
    }

    /// The tick `ticks` later.
    pub fn after(self, ticks: u64) -> Self {
        Tick(self.0.saturating_add(ticks))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_tick_contains_its_own_end_and_not_its_start() {
        for n in [1, 2, 3, 7, 999, 1_000, 123_456_789] {
            assert_eq!(Tick::containing(Tick(n).end_s()), Tick(n));
            assert_eq!(Tick::containing(Tick(n).end_s() + 1e-9), Tick(n + 1));
            assert_eq!(Tick(n + 1).start_s(), Tick(n).end_s());
        }
        assert_eq!(Tick::containing(0.0), Tick(0));
    }
}
