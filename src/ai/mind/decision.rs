//! What a search answers, and what it thought.

use crate::ai::ideas::Idea;
use crate::cue::Aim;
use crate::events::{Call, Choice};
use glam::DVec2;

/// The answer to a [`super::Task`].
#[derive(Debug, Clone, PartialEq)]
pub enum Decision {
    /// Play this.
    Shoot(Box<PlannedShot>),
    /// Put the cue ball on the first of these that is accepted [m]; best first.
    Place(Vec<DVec2>),
    /// Take this option.
    Choose(Choice),
    /// Nothing can be decided: there is nothing to strike, or no option.
    Nothing,
}

/// A stroke, and what is expected of it.
#[derive(Debug, Clone, PartialEq)]
pub struct PlannedShot {
    /// What it is meant to do.
    pub idea: Idea,
    /// How the cue is held.
    pub aim: Aim,
    /// Speed of the tip at the contact [m/s].
    pub speed_m_s: f64,
    /// What is announced.
    pub call: Option<Call>,
    /// Chance that it does what it is meant to.
    pub success: f64,
    /// Chance to win the game, as far as the player can tell.
    pub value: f64,
}

/// An answer and how it came about.
#[derive(Debug, Clone, PartialEq)]
pub struct Deliberation {
    /// What is done.
    pub decision: Decision,
    /// What was considered.
    pub thoughts: Thoughts,
    /// Shots that were simulated.
    pub simulations: u32,
}

/// What a player considered in its turn; the renderer can show it (paper, figure 5.2).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Thoughts {
    /// Shots, best value first.
    pub candidates: Vec<Considered>,
}

/// A shot that was considered.
#[derive(Debug, Clone, PartialEq)]
pub struct Considered {
    /// What it is meant to do.
    pub idea: Idea,
    /// How the cue would be held.
    pub aim: Aim,
    /// Speed of the tip at the contact [m/s].
    pub speed_m_s: f64,
    /// Chance that it does what it is meant to.
    pub success: f64,
    /// Chance that it is no foul.
    pub legal: f64,
    /// Chance to win the game after it, as far as the player can tell.
    pub value: f64,
    /// Simulations that say so.
    pub samples: u32,
    /// It is played.
    pub chosen: bool,
}
