//! A stroke by a trigger: how far it is pressed is how far the tip is pulled back, and letting it
//! go quickly strikes.
//!
//! A trigger is a spring, and nobody can say how fast a spring comes back; but anybody can hold it
//! against the spring, at a place that the picture shows. So the place decides how hard the stroke
//! is, and the quickness only whether there is one and a little of how hard. With the position t
//! of the trigger, what is held is
//!
//! `h(now) = max(t, h(before) − EASE_PER_S · 1 ms)`,
//!
//! which follows a finger that presses, or eases off slowly, and waits for one that is quicker.
//! When `t < LET_GO · h`, the tip strikes; whoever eases off more slowly than [`EASE_PER_S`] puts
//! the cue down again. With [`TRIGGER_BEGIN`] b the share of the way is `s = (h − b) / (1 − b)`;
//! the tip is pulled back by `s · PULL_MAX_M`, and strikes with `0.3 m/s + 7.7 m/s · s²`, as a
//! stroke by a key does ([`KeyStroke`]). A trigger of 256 steps sets 2 m/s to within 0.03 m/s; one
//! that takes 80 ms to come back makes a soft stroke a tenth softer than one that snaps.
//!
//! [`KeyStroke`]: super::super::human
//! [`TRIGGER_BEGIN`]: super::super::feel::TRIGGER_BEGIN

use crate::input::feel::TRIGGER_BEGIN as BEGIN;
use crate::units::TICK_S;

/// How fast a finger may ease off without a stroke [ways of the trigger/s].
const EASE_PER_S: f64 = 0.6;
/// A trigger strikes when it is pressed less than this share of what was held.
const LET_GO: f64 = 0.6;

/// What a trigger does in a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pulled {
    /// Nothing.
    Rests,
    /// It holds the tip pulled back by this share of the way.
    Holds(f64),
    /// It is let go: a stroke.
    LetGo,
}

/// A trigger from tick to tick.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct TriggerPull {
    /// What is held; 0 at rest.
    held: f64,
    /// It has struck, and has to come back before it is pulled again.
    is_spent: bool,
}

impl TriggerPull {
    /// One tick in which the trigger is pressed so far [0 to 1].
    pub fn step(&mut self, pressed: f64) -> Pulled {
        if pressed <= BEGIN {
            self.is_spent = false;
        }
        if self.is_spent {
            return Pulled::Rests;
        }
        let was_held = BEGIN < self.held;
        self.held = pressed.max(self.held - EASE_PER_S * TICK_S);
        if self.held <= BEGIN {
            self.held = 0.0;
            return if was_held { Pulled::Holds(0.0) } else { Pulled::Rests };
        }
        if pressed < LET_GO * self.held && was_held {
            (self.held, self.is_spent) = (0.0, BEGIN < pressed);
            return Pulled::LetGo;
        }
        Pulled::Holds((self.held - BEGIN) / (1.0 - BEGIN))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Presses to `place`, waits, and goes back to the rest within `ticks`; what was held when
    /// it struck.
    fn released(place: f64, ticks: u32) -> Option<f64> {
        let mut trigger = TriggerPull::default();
        let mut held = 0.0;
        let pressed = (0..200).map(|n| place * f64::from(n.min(100)) / 100.0);
        let back = (1..=ticks).map(|n| place * (1.0 - f64::from(n) / f64::from(ticks)));
        for pressed in pressed.chain(back) {
            match trigger.step(pressed) {
                Pulled::Holds(share) => held = share,
                Pulled::LetGo => return Some(held),
                Pulled::Rests => {}
            }
        }
        assert_eq!(trigger, TriggerPull::default(), "nothing is left over");
        None
    }

    #[test]
    fn where_it_was_held_is_how_hard_it_strikes() {
        for place in [0.2, 0.5, 0.8, 1.0] {
            let share = (place - BEGIN) / (1.0 - BEGIN);
            for ticks in [1, 8, 50, 100] {
                let struck = released(place, ticks).unwrap();
                assert!((struck - share).abs() < 0.05, "{place} in {ticks} ms: {struck}");
            }
        }
        assert_eq!(released(1.0, 2500), None, "eased off slowly");
        assert_eq!(released(0.5, 1200), None);
        assert_eq!(released(BEGIN, 1), None, "it was never pulled");
    }
}
