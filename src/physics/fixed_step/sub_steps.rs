//! Sub-steps: a step in which something happens is computed again in parts (paper, section 2.5).
//!
//! The paper asks for a simulation within the simulation that "computes critical moments such as
//! collisions with a smaller step". A moment is critical if a ball will meet something, if one that
//! slid begins to roll, or if one comes to rest: those are what a step loses accuracy by. All balls
//! take the parts together; the step that was tried is thrown away, but what it cost is counted.

use super::FixedStep;
use super::body::{Body, Knot};
use crate::physics::{PhysicsError, PhysicsSettings, Profile};
use crate::units::Seconds;

/// Settings that contradict each other.
///
/// # Errors
/// [`PhysicsError::Setting`] if they do.
pub(super) fn check(settings: &PhysicsSettings) -> Result<(), PhysicsError> {
    let none = settings.profile == Profile::Paper2009;
    let parts = settings.sub_steps;
    let error =
        |allowed| Err(PhysicsError::Setting { key: "sub_steps", value: f64::from(parts), allowed });
    match parts {
        1 => Ok(()),
        0 => error("must be 1 or more"),
        _ if none => error("must be 1 under profile 2009: a lying ball collides in every step"),
        _ => Ok(()),
    }
}

impl FixedStep {
    /// Computes the step, in parts if something happens in it.
    ///
    /// # Errors
    /// [`PhysicsError`] if it does not get on.
    pub(super) fn try_step(&mut self, start: Seconds, end: Seconds) -> Result<(), PhysicsError> {
        let before = (self.bodies.clone(), self.ledger);
        self.begin(start);
        self.smooth();
        self.predict_all();
        if !self.changes && self.scratch.queue.is_empty() {
            self.work.steps += 1;
            return self.finish(start, end);
        }
        (self.bodies, self.ledger) = before;

        let (whole, parts) = (self.h, self.settings.sub_steps);
        self.forget_ways();
        self.h = whole / f64::from(parts);
        let at = |part: u32| start + (end - start) * (f64::from(part) / f64::from(parts));
        let mut done = Ok(());
        for part in 0..parts {
            let till = if part + 1 == parts { end } else { at(part + 1) };
            done = self.part(at(part), till);
            if done.is_err() {
                break;
            }
            self.bodies.iter_mut().for_each(Body::put_by);
        }
        self.h = whole;
        self.forget_ways();
        self.bodies.iter_mut().for_each(Body::take_up);
        done
    }

    /// The last step was of another length than the next.
    fn forget_ways(&mut self) {
        self.bodies.iter_mut().for_each(|body| body.way = None);
    }
}

impl Body {
    /// Puts the knots of a part by.
    fn put_by(&mut self) {
        self.earlier.extend(self.knots.drain(..));
    }

    /// The knots of all parts are those of the step.
    fn take_up(&mut self) {
        let knots: &[Knot] = &self.earlier;
        self.knots = knots.into();
        self.earlier.clear();
    }
}
