//! A shot is seen again: which moment, how fast, and from where.

use super::reel::Film;
use crate::input::{Action, HandInput, Human, HumanView};
use crate::physics::Snapshot;
use crate::table::Table;
use crate::units::{Seconds, TICK_S, Tick};
use std::sync::Arc;

/// Seconds of the film per second.
const RATES: [f64; 6] = [0.05, 0.1, 0.25, 0.5, 1.0, 2.0];
/// The rate it begins with: slowly enough to see what happened.
const FIRST_RATE: usize = 3;
/// How long its end is looked at before it is over [s].
const END_S: Seconds = 1.2;
/// An eye that nobody could look through for longer than this stays where it is [s].
const LONGEST_S: Seconds = 0.1;

/// A film that is shown.
#[derive(Debug, Clone)]
pub struct Screening {
    film: Arc<Film>,
    after_s: Seconds,
    rate: usize,
    is_held: bool,
    ended_s: Seconds,
    /// Whose eyes: they look round and play for nobody.
    eye: Human,
    heard: Vec<HandInput>,
    tick: Tick,
    /// What is left of the last tick of the eye [s].
    left_s: Seconds,
}

impl Screening {
    /// Before its first picture. The eye begins behind the cue ball and goes with it.
    pub fn new(film: Arc<Film>, table: Arc<Table>) -> Self {
        let azimuth_rad = film.cue().map_or(0.0, |cue| {
            let way = cue.direction.truncate();
            libm::atan2(way.y, way.x)
        });
        let eye = Human::onlooker(table, &film.at(0.0), film.cue_ball(), azimuth_rad);
        Screening {
            film,
            after_s: 0.0,
            rate: FIRST_RATE,
            is_held: false,
            ended_s: 0.0,
            eye,
            heard: Vec::new(),
            tick: Tick(1),
            left_s: 0.0,
        }
    }

    /// A device says something to the eye.
    pub fn hear(&mut self, input: HandInput) {
        self.heard.push(input);
    }

    /// The film is held, goes on, goes slower or faster; from its end it begins again.
    pub fn turn(&mut self, action: Action) {
        match action {
            Action::FilmSlower => self.rate = self.rate.saturating_sub(1),
            Action::FilmFaster => self.rate = (self.rate + 1).min(RATES.len() - 1),
            Action::FilmHold if self.is_at_end() => {
                (self.after_s, self.ended_s, self.is_held) = (0.0, 0.0, false);
            }
            Action::FilmHold => self.is_held = !self.is_held,
            _ => {}
        }
    }

    /// Time passes for whoever looks [s].
    pub fn pass(&mut self, dt: Seconds) {
        let dt = dt.clamp(0.0, LONGEST_S);
        if self.is_at_end() {
            self.ended_s += dt;
        } else if !self.is_held {
            self.after_s = (self.after_s + dt * self.rate()).min(self.film.length_s());
        }
        self.left_s += dt;
        let mut heard = std::mem::take(&mut self.heard);
        while TICK_S <= self.left_s || !heard.is_empty() {
            self.eye.inflow(self.tick, &heard);
            heard.clear();
            self.tick = self.tick.after(1);
            self.left_s = (self.left_s - TICK_S).max(0.0);
        }
    }

    /// What is seen now, and from where.
    pub fn seen(&self) -> (Snapshot, HumanView) {
        (self.film.at(self.after_s), HumanView { looks_on: true, ..self.eye.view() })
    }

    /// What is shown.
    pub fn film(&self) -> &Film {
        &self.film
    }

    /// Its end was looked at.
    pub fn is_over(&self) -> bool {
        END_S <= self.ended_s
    }

    /// Where it is, and how long it takes [s].
    pub fn place_s(&self) -> (Seconds, Seconds) {
        (self.after_s, self.film.length_s())
    }

    /// Seconds of the film per second.
    pub fn rate(&self) -> f64 {
        RATES[self.rate]
    }

    fn is_at_end(&self) -> bool {
        self.film.length_s() <= self.after_s
    }
}
