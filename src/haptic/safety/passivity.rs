//! Stage 4: energy that comes out of nowhere is damped away.
//!
//! The observer knows the work exactly, because a force is held between ticks:
//! `E[k] = E[k−1] − F[k−1] · (x[k] − x[k−1])`; E ≥ 0 while the renderer gives no more than it took.
//! The controller damps with `α = −E/(dt v²)`, at most what the device renders without chatter
//! (Hannaford and Ryu 2002). It keeps an account of its own: every contact begins with nothing in
//! store, and must keep a share of what went in, or a device that nobody holds bounces for ever.
//!
//! Where that damping is not enough, as with late forces on a stiff wall, the loop swings on. Then
//! the stiffness of everything is lowered until it does not, and what is felt is damped a little;
//! it comes back while nothing is felt.

use crate::units::Seconds;
use glam::DVec3;

/// Share of the most that went into a contact that must not have come out at its end.
const KEPT: f64 = 0.2;
/// The loop is looked at this often [s].
const LOOK_S: Seconds = 0.05;
/// Share of that time in which the damping may be at its greatest before the stiffness falls.
const BUSY: f64 = 0.1;
/// What the stiffness is multiplied by then.
const CUT: f64 = 0.8;
/// The lowest stiffness.
const FACTOR_MIN: f64 = 0.02;
/// Damping of what is felt, once all stiffness is gone [N s/m].
const SOFT_NS_M: f64 = 2.0;
/// How fast the stiffness comes back while nothing is felt [1/s].
const GROWTH_1_S: f64 = 1.0;

/// What the stage says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passive {
    /// The force with damping [N].
    pub force: DVec3,
    /// The controller works.
    pub acts: bool,
}

/// Observer and controller.
#[derive(Debug, Clone)]
pub(super) struct Passivity {
    last: Option<DVec3>,
    energy_j: f64,
    account_j: f64,
    /// Of the present contact: the most that the account held.
    most_j: f64,
    is_felt: bool,
    /// Of the present look: its length so far, the part in which the damping was at its greatest,
    /// the box that the device stayed in.
    look_s: Seconds,
    busy_s: Seconds,
    low: DVec3,
    high: DVec3,
    factor: f64,
}

impl Passivity {
    pub fn new() -> Self {
        Passivity {
            last: None,
            energy_j: 0.0,
            account_j: 0.0,
            most_j: 0.0,
            is_felt: false,
            look_s: 0.0,
            busy_s: 0.0,
            low: DVec3::INFINITY,
            high: DVec3::NEG_INFINITY,
            factor: 1.0,
        }
    }

    /// Energy that went into the renderer so far [J].
    pub fn energy_j(&self) -> f64 {
        self.energy_j
    }

    /// What all stiffness is multiplied by from the next tick on.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// Forgets all energy: another thing is rendered.
    pub fn reset(&mut self) {
        (self.energy_j, self.account_j, self.most_j) = (0.0, 0.0, 0.0);
    }

    /// `acting` was on the device since the last tick and has moved it to `position`; `wanted` is
    /// what comes next. `damping_max` 0 only observes; a loop that swings more than `swing_m`
    /// under that damping is softened.
    pub fn pass(
        &mut self,
        wanted: DVec3,
        acting: DVec3,
        position: DVec3,
        dt: Seconds,
        damping_max: f64,
        swing_m: f64,
    ) -> Passive {
        let moved = position - self.last.unwrap_or(position);
        self.last = Some(position);
        let work = acting.dot(moved);
        self.energy_j -= work;
        self.account_j -= work;
        self.most_j = self.most_j.max(self.account_j);
        self.notice(wanted != DVec3::ZERO, dt);

        let soft = if self.is_felt { SOFT_NS_M * (1.0 - self.factor) } else { 0.0 };
        let wanted = wanted - soft.min(0.5 * damping_max) * moved / dt;
        let square = moved.length_squared();
        if !(self.account_j < 0.0 && square > 0.0 && damping_max > 0.0) {
            self.look(position, dt, false, swing_m);
            return Passive { force: wanted, acts: false };
        }
        // v = moved/dt, so α = −E dt/|moved|².
        let needed = -self.account_j * dt / square;
        self.look(position, dt, needed > damping_max, swing_m);
        Passive { force: wanted - needed.min(damping_max) * moved / dt, acts: true }
    }

    /// A contact begins, goes on, or ends.
    fn notice(&mut self, is_felt: bool, dt: Seconds) {
        let was_felt = std::mem::replace(&mut self.is_felt, is_felt);
        if is_felt && !was_felt {
            (self.account_j, self.most_j) = (self.account_j.min(0.0), 0.0);
        } else if was_felt && !is_felt {
            self.account_j = self.account_j.min(0.0).min(self.account_j - KEPT * self.most_j);
        } else if !is_felt {
            self.factor = (self.factor + GROWTH_1_S * dt).min(1.0);
        }
    }

    /// Lowers the stiffness of a loop that swings although the controller does what it may.
    fn look(&mut self, position: DVec3, dt: Seconds, is_at_most: bool, swing_m: f64) {
        self.look_s += dt;
        self.busy_s += if is_at_most { dt } else { 0.0 };
        self.low = self.low.min(position);
        self.high = self.high.max(position);
        if self.look_s < LOOK_S {
            return;
        }
        let swings = (self.high - self.low).length() > swing_m;
        if swings && self.busy_s > BUSY * self.look_s {
            self.factor = (self.factor * CUT).max(FACTOR_MIN);
        }
        (self.look_s, self.busy_s) = (0.0, 0.0);
        (self.low, self.high) = (position, position);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_observer_counts_the_work_of_held_forces() {
        let mut passivity = Passivity::new();
        let mut at = |x: f64, acting: f64| {
            passivity.pass(DVec3::ZERO, DVec3::X * acting, DVec3::X * x, 0.001, 0.0, 1.0);
            passivity.energy_j()
        };
        at(0.0, 0.0);
        // Pushed 2 mm against 3 N: 6 mJ go in; 1 mm back under 4 N: 4 mJ come out.
        assert!((at(0.002, -3.0) - 6e-3).abs() < 1e-15);
        assert!((at(0.001, -4.0) - 2e-3).abs() < 1e-15);
    }

    #[test]
    fn the_controller_damps_only_what_came_out_and_no_more_than_it_may() {
        let mut passivity = Passivity::new();
        passivity.pass(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, 0.001, 5.0, 1.0);
        // 1 mJ comes out at 1 m/s: α = 1 N s/m.
        let out = passivity.pass(DVec3::ZERO, DVec3::X, DVec3::X * 0.001, 0.001, 5.0, 1.0);
        assert!(out.acts && (out.force.x + 1.0).abs() < 1e-12);
        // 0.1 m/s and another 10 mJ: 5 N s/m are the most.
        let out = passivity.pass(DVec3::ZERO, DVec3::X * 100.0, DVec3::X * 0.0011, 0.001, 5.0, 1.0);
        assert!((out.force.x + 0.5).abs() < 1e-12);
        passivity.reset();
        assert!(!passivity.pass(DVec3::X, DVec3::ZERO, DVec3::ZERO, 0.001, 5.0, 1.0).acts);
    }

    #[test]
    fn a_loop_that_swings_under_full_damping_is_softened_and_one_that_rests_is_not() {
        let mut passivity = Passivity::new();
        let mut ticks = |n: u32, swing: f64| {
            for k in 0..n {
                let x = if k % 2 == 0 { swing } else { 0.0 };
                // The force always goes along with the motion.
                let force = if k % 2 == 0 { 5.0 } else { -5.0 };
                passivity.pass(DVec3::X, DVec3::X * force, DVec3::X * x, 0.001, 5.0, 1e-4);
            }
            passivity.factor()
        };
        assert_eq!(ticks(1_000, 0.00005), 1.0);
        assert!(ticks(1_000, 0.001) < 0.1);
    }
}
