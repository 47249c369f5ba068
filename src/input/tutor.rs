//! Somebody who shows a beginner how to play: one thing after the other, each of which is done when
//! it was done at the table.

use super::{HumanMode, HumanView, View};
use crate::events::{Command, Event, FactKind, Topic, Topics};

/// How far the beginner looks round [rad], turns the cue [rad] and moves the tip [ball radii]
/// before that was done.
const LOOKED_RAD: f64 = 0.25;
const TURNED_RAD: f64 = 0.06;
const OFF_MIDDLE: f64 = 0.2;
/// A zoom that was meant.
const ZOOMED: f64 = 0.15;

/// What is learnt, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lesson {
    /// To look round.
    Look,
    /// To aim.
    Aim,
    /// To strike.
    Strike,
    /// To wait until the balls lie.
    Wait,
    /// To meet the cue ball elsewhere than in its middle.
    Tip,
    /// To strike with that.
    Spin,
    /// To see the table from elsewhere.
    View,
    /// To see the last shot again.
    Replay,
    /// To take a shot back.
    Undo,
    /// That is all.
    End,
}

impl Lesson {
    /// All.
    pub const ALL: [Lesson; 10] = [
        Lesson::Look,
        Lesson::Aim,
        Lesson::Strike,
        Lesson::Wait,
        Lesson::Tip,
        Lesson::Spin,
        Lesson::View,
        Lesson::Replay,
        Lesson::Undo,
        Lesson::End,
    ];

    /// The key of its text; that for a gamepad has another ending.
    pub fn name(self) -> &'static str {
        match self {
            Lesson::Look => "tutor_look",
            Lesson::Aim => "tutor_aim",
            Lesson::Strike => "tutor_strike",
            Lesson::Wait => "tutor_wait",
            Lesson::Tip => "tutor_tip",
            Lesson::Spin => "tutor_spin",
            Lesson::View => "tutor_view",
            Lesson::Replay => "tutor_replay",
            Lesson::Undo => "tutor_undo",
            Lesson::End => "tutor_end",
        }
    }
}

/// Which lesson it is, and what was seen of it.
#[derive(Debug, Clone, Default)]
pub struct Tutor {
    at: usize,
    /// How the player looked and aimed when the lesson began; none before the first look.
    began: Option<HumanView>,
    /// What the lesson is about has happened.
    is_done: bool,
}

impl Tutor {
    /// What a tutor must hear.
    pub fn topics() -> Topics {
        Topics::of(&[Topic::CueBallStruck, Topic::Settled, Topic::Command])
    }

    /// The lesson of now.
    pub fn lesson(&self) -> Lesson {
        Lesson::ALL[self.at]
    }

    /// Which it is of how many.
    pub fn count(&self) -> (usize, usize) {
        (self.at + 1, Lesson::ALL.len())
    }

    /// Something happened in the game.
    pub fn hear(&mut self, event: &Event) {
        let fact = match event {
            Event::Fact(fact) => Some(fact.kind),
            _ => None,
        };
        self.is_done |= match (self.lesson(), fact) {
            (Lesson::Strike | Lesson::Spin, Some(FactKind::CueBallStruck { .. }))
            | (Lesson::Wait, Some(FactKind::Settled { .. })) => true,
            (Lesson::Undo, _) => matches!(event, Event::Command(Command::Undo)),
            _ => false,
        };
        // Whoever strikes before the lesson has done what it is about.
        if matches!(fact, Some(FactKind::CueBallStruck { .. })) && self.lesson() == Lesson::Aim {
            // To strike is the next one.
            self.skip();
            self.skip();
        }
    }

    /// The last shot was seen again.
    pub fn saw_replay(&mut self) {
        self.is_done |= self.lesson() == Lesson::Replay;
    }

    /// The player is seen.
    pub fn see(&mut self, view: &HumanView) {
        let lesson = self.lesson();
        let began = self.began.get_or_insert_with(|| view.clone());
        let aims = view.mode == HumanMode::Aiming;
        self.is_done |= match lesson {
            Lesson::Look => {
                let turned = (view.look.turn_rad - began.look.turn_rad).abs();
                let risen = (view.look.rise_rad - began.look.rise_rad).abs();
                let zoomed = (view.look.zoom / began.look.zoom - 1.0).abs();
                LOOKED_RAD < turned.max(risen) || ZOOMED < zoomed
            }
            Lesson::Aim => {
                let turned = (view.aim.azimuth_rad - began.aim.azimuth_rad).abs();
                aims && TURNED_RAD < turned && view.object_heading.length() > 0.5
            }
            Lesson::Tip => {
                aims && OFF_MIDDLE < libm::hypot(view.aim.side_offset, view.aim.height_offset)
            }
            Lesson::View => view.look.view != View::Usual,
            Lesson::Strike | Lesson::Wait | Lesson::Spin => false,
            Lesson::Replay | Lesson::Undo | Lesson::End => false,
        };
        // The balls lie before the next thing is asked for.
        if self.is_done && (aims || lesson != Lesson::Wait) {
            self.skip();
        }
    }

    /// To the next lesson.
    pub fn skip(&mut self) {
        let at = (self.at + 1).min(Lesson::ALL.len() - 1);
        *self = Tutor { at, ..Tutor::default() };
    }
}
