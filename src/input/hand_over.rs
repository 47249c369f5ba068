//! Who strikes where a stylus is beside the mouse, and what becomes of a stroke whose device is
//! lost.
//!
//! | the device | then |
//! |---|---|
//! | is lost while a stroke is armed | time stands still; when it runs again the mouse strikes |
//! | is lost otherwise | the mouse strikes at once |
//! | is back | the stylus strikes when the cue is put to a ball next, never in between |

use super::CameraHand;
use crate::cue::CuePath;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// What a stylus says in one tick.
#[derive(Debug, Clone, PartialEq)]
pub enum StylusWord {
    /// Its device is gone.
    Lost,
    /// It is in a hand.
    Held {
        /// Unit vector along its shaft, from butt to tip.
        direction: DVec3,
        /// The stabiliser holds: what the tip meets is struck.
        armed: bool,
        /// The way of the tip in this tick, if it has one.
        path: Option<Arc<CuePath>>,
        /// What it does while it leads the camera, and not the cue.
        camera: Option<CameraHand>,
    },
}

impl StylusWord {
    /// What leads the camera, if it does.
    pub fn camera(&self) -> Option<&CameraHand> {
        match self {
            StylusWord::Held { camera, .. } => camera.as_ref(),
            StylusWord::Lost => None,
        }
    }
}

/// What changes by a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    /// The stylus led the cue and is gone; it may have been armed.
    Drops {
        /// A stroke was armed.
        armed: bool,
    },
    /// It is gone, but did not lead the cue.
    Goes,
}

/// A stylus as the hand at mouse and keyboard knows it.
#[derive(Debug, Clone)]
pub(super) struct HandOver {
    is_there: bool,
    leads: bool,
    armed: bool,
    /// The player was told that it is gone.
    pub is_missed: bool,
    /// How far the mouse turns and raises the stylus' workspace, until somebody takes it [rad].
    pub turn_rad: DVec2,
}

impl HandOver {
    /// A stylus that is there and has said nothing.
    pub fn new() -> Self {
        HandOver {
            is_there: true,
            leads: false,
            armed: false,
            is_missed: false,
            turn_rad: DVec2::ZERO,
        }
    }

    /// Whether the stylus leads the cue.
    pub fn leads(&self) -> bool {
        self.leads
    }

    /// Whether what the stylus meets is struck.
    pub fn is_armed(&self) -> bool {
        self.leads && self.armed
    }

    /// A cue is put to a ball: with the stylus, if it is there.
    pub fn address(&mut self) {
        self.leads = self.is_there;
        self.turn_rad = DVec2::ZERO;
    }

    /// Takes a word.
    pub fn hear(&mut self, word: &StylusWord) -> Option<Change> {
        match word {
            StylusWord::Held { armed, .. } => {
                (self.is_there, self.armed) = (true, *armed);
                None
            }
            StylusWord::Lost => {
                let was_there = std::mem::replace(&mut self.is_there, false);
                let armed = std::mem::replace(&mut self.armed, false);
                let led = std::mem::replace(&mut self.leads, false);
                match (led, was_there) {
                    (true, _) => Some(Change::Drops { armed }),
                    (false, true) => Some(Change::Goes),
                    (false, false) => None,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn held(armed: bool) -> StylusWord {
        StylusWord::Held { direction: DVec3::X, armed, path: None, camera: None }
    }

    #[test]
    fn it_leads_from_one_address_to_its_loss_and_again_from_the_next_address() {
        for armed in [false, true] {
            let mut over = HandOver::new();
            assert_eq!(
                (over.hear(&held(armed)), over.leads(), over.is_armed()),
                (None, false, false)
            );
            over.address();
            assert!(over.leads() && over.is_armed() == armed);
            assert_eq!(over.hear(&StylusWord::Lost), Some(Change::Drops { armed }));
            assert_eq!((over.hear(&StylusWord::Lost), over.leads()), (None, false));
            // Back, but the mouse has the cue.
            assert_eq!(
                (over.hear(&held(true)), over.leads(), over.is_armed()),
                (None, false, false)
            );
            over.address();
            assert!(over.leads());
        }
    }

    #[test]
    fn one_that_goes_before_its_turn_drops_nothing() {
        let mut over = HandOver::new();
        assert_eq!(over.hear(&StylusWord::Lost), Some(Change::Goes));
        over.address();
        assert!(!over.leads());
        assert_eq!(over.hear(&StylusWord::Lost), None);
    }
}
