//! Looks at one ball of a running simulation, and finds when something first holds.

use super::error::Trouble;
use crate::ball::BallState;
use crate::events::{Fact, FactSet};
use crate::ids::BallId;
use crate::physics::Simulation;
use crate::units::Seconds;

/// Between these times it is asked whether something holds [s]; then halved to the last digit.
pub(super) const LOOK_S: Seconds = 0.01;
/// Nobody waits longer for something to happen [s].
pub(super) const LONGEST_S: Seconds = 1000.0;

/// A simulation and one of its balls.
#[derive(Clone)]
pub(super) struct Probe {
    pub simulation: Simulation,
    pub ball: BallId,
    /// How often it is asked whether something holds [s].
    pub look_s: Seconds,
}

impl Probe {
    pub fn new(simulation: Simulation) -> Self {
        Probe { simulation, ball: BallId(0), look_s: LOOK_S }
    }

    /// Goes on to a time.
    pub fn advance(&mut self, to: Seconds) -> Result<(), Trouble> {
        if to > self.simulation.now_s() {
            self.simulation.advance(to, FactSet::NONE, &mut Vec::new())?;
        }
        Ok(())
    }

    /// Goes on to a time and keeps what happened.
    pub fn advance_with(&mut self, to: Seconds, facts: &mut Vec<Fact>) -> Result<(), Trouble> {
        self.simulation.advance(to, FactSet::NONE, facts)?;
        Ok(())
    }

    /// The state now.
    pub fn state(&self) -> Result<BallState, Trouble> {
        self.state_at(self.simulation.now_s())
    }

    fn state_at(&self, at: Seconds) -> Result<BallState, Trouble> {
        let state = self.simulation.sample(self.ball, at);
        state.ok_or_else(|| Trouble::Failed("the ball is gone".into()))
    }

    /// The state at a later time, without going there.
    pub fn ahead(&self, to: Seconds) -> Result<BallState, Trouble> {
        let mut probe = self.clone();
        probe.advance(to)?;
        probe.state_at(to)
    }

    /// Goes on to the first time at which `holds`, to the last digit; none if it does not until
    /// `limit`, or if everything came to rest before.
    pub fn until(
        &mut self,
        limit: Seconds,
        holds: impl Fn(Seconds, &BallState) -> bool,
    ) -> Result<Option<(Seconds, BallState)>, Trouble> {
        let now = self.simulation.now_s();
        let state = self.state()?;
        if holds(now, &state) {
            return Ok(Some((now, state)));
        }
        let mut at = now;
        while at < limit {
            let next = (at + self.look_s).min(limit);
            let mut ahead = self.clone();
            ahead.advance(next)?;
            if holds(next, &ahead.state_at(next)?) {
                return self.halve(at, next, ahead, holds).map(Some);
            }
            if ahead.simulation.is_still() {
                return Ok(None);
            }
            (*self, at) = (ahead, next);
        }
        Ok(None)
    }

    fn halve(
        &mut self,
        mut low: Seconds,
        mut high: Seconds,
        mut found: Probe,
        holds: impl Fn(Seconds, &BallState) -> bool,
    ) -> Result<(Seconds, BallState), Trouble> {
        loop {
            let middle = 0.5 * (low + high);
            if !(low < middle && middle < high) {
                *self = found;
                let state = self.state_at(high)?;
                return Ok((high, state));
            }
            let mut probe = self.clone();
            probe.advance(middle)?;
            if holds(middle, &probe.state_at(middle)?) {
                (high, found) = (middle, probe);
            } else {
                (*self, low) = (probe, middle);
            }
        }
    }
}
