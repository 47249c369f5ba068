//! Events: what happened once and must not be lost.
//!
//! A fact is something physics saw, a command something a player wants, a verdict what the rules
//! say; each carries one [`Stamp`]. Streams (poses, forces) are not events and never come here.
//! The JSON form of facts is that of rule files: a tag `e` and the fields of the variant.

mod fact;
mod game;
mod insight;
mod verdict;

pub use fact::{Fact, FactKind, TouchedBy};
pub use game::{
    BallInHand, BallOn, ByPlayer, Call, CallKind, Calls, Command, Group, Groups, Health,
    MenuAction, PlayerReport, PlayerState, Racked, Racking, ShotKind, Spotting, Zone,
};
pub use insight::{IdeaKind, Insight, Prospect, Way, WayEnd};
pub use verdict::{Choice, Foul, Turn, TurnAfter, Verdict};

use crate::ids::PlayerId;
use crate::units::Tick;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Anything that is published through the event manager.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// Physics saw it.
    Fact(Fact),
    /// A player (or the rules) wants it done; physics does it at its tick.
    Command(Command),
    /// The rules judged a shot.
    Verdict(Arc<Verdict>),
    /// The rules call a player to the table.
    Turn(Arc<Turn>),
    /// A player's own state changed, for everybody to see.
    Player(PlayerReport),
    /// A menu was used.
    Menu(MenuAction),
    /// What a computer player had in mind when it decided. No core hears it and no hash contains
    /// it.
    Insight(Arc<Insight>),
    /// The runtime reports on itself. No core hears it and no hash contains it.
    Health(Arc<Health>),
}

impl Event {
    /// The topic under which it can be subscribed.
    pub fn topic(&self) -> Topic {
        match self {
            Event::Fact(fact) => fact.kind.topic(),
            Event::Command(_) => Topic::Command,
            Event::Verdict(_) => Topic::Verdict,
            Event::Turn(_) => Topic::Turn,
            Event::Player(_) => Topic::Player,
            Event::Menu(_) => Topic::Menu,
            Event::Insight(_) => Topic::Insight,
            Event::Health(_) => Topic::Health,
        }
    }
}

/// Who published an event. The order of the variants is the order of delivery within a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Source {
    /// The input manager: hands, menus, recorded frames.
    Input,
    /// The simulation.
    Physics,
    /// The referee.
    Rules,
    /// A computer player.
    Ai(PlayerId),
    /// The runtime.
    Runtime,
}

/// When an event is due and who published it, the how-maniest of theirs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Stamp {
    /// The tick in which it is delivered.
    pub tick: Tick,
    /// Who published it.
    pub source: Source,
    /// Counts the events of this source from 0.
    pub sequence: u64,
}

/// An event with its stamp. Batches are sorted by the stamp.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stamped {
    /// When and from whom.
    #[serde(flatten)]
    pub stamp: Stamp,
    /// What.
    pub event: Event,
}

/// Kinds of events as subscribers name them; one bit each in [`Topics`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Topic {
    /// [`FactKind::BallPlaced`]
    BallPlaced,
    /// [`FactKind::CueBallStruck`]
    CueBallStruck,
    /// [`FactKind::BallsCollided`]
    BallsCollided,
    /// [`FactKind::CushionHit`]
    CushionHit,
    /// [`FactKind::HeadStringCrossed`]
    HeadStringCrossed,
    /// [`FactKind::BallPocketed`]
    BallPocketed,
    /// [`FactKind::BallOffTable`]
    BallOffTable,
    /// [`FactKind::BallTouched`]
    BallTouched,
    /// [`FactKind::BallsFrozen`]
    BallsFrozen,
    /// [`FactKind::Settled`]
    Settled,
    /// [`Event::Command`]
    Command,
    /// [`Event::Verdict`]
    Verdict,
    /// [`Event::Turn`]
    Turn,
    /// [`Event::Player`]
    Player,
    /// [`Event::Menu`]
    Menu,
    /// [`Event::Insight`]
    Insight,
    /// [`Event::Health`]
    Health,
}

/// A set of topics.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Topics(u32);

impl Topics {
    /// No topic.
    pub const NONE: Topics = Topics(0);
    /// Every fact of physics.
    pub const FACTS: Topics = Topics((1 << Topic::Command as u32) - 1);
    /// Every topic.
    pub const ALL: Topics = Topics((1 << (Topic::Health as u32 + 1)) - 1);

    /// The set of these topics.
    pub const fn of(topics: &[Topic]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < topics.len() {
            bits |= 1 << topics[i] as u32;
            i += 1;
        }
        Topics(bits)
    }

    /// Whether `topic` is in the set.
    pub const fn contains(self, topic: Topic) -> bool {
        self.0 & (1 << topic as u32) != 0
    }

    /// What is in both.
    pub const fn and(self, other: Topics) -> Topics {
        Topics(self.0 & other.0)
    }

    /// What is in either.
    pub const fn or(self, other: Topics) -> Topics {
        Topics(self.0 | other.0)
    }

    /// Whether the set is empty.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }
}

/// The facts at which [`crate::physics`] may be asked to stop.
pub type FactSet = Topics;
