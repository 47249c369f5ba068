//! The tip along its shaft: a smooth motion that follows a mouse.
//!
//! A mouse reports at 60 to 1000 Hz, and a window hands its reports on in bursts, once a picture.
//! Two stages make a steady speed of that. A movement is spread evenly over the time since the one
//! before it; then a critically damped spring draws the tip after the hand, carried from tick to
//! tick by its closed form. A hand at constant speed moves the tip at exactly that speed, two time
//! constants behind.

use super::feel::{
    ADDRESS_GAP_M, PIECE_S, PULL_MAX_M, SPREAD_FIRST_TICKS, SPREAD_MAX_TICKS,
    STROKE_ACCELERATION_MAX_M_S2, STROKE_FILTER_RAD_S, STROKE_M_PER_HEIGHT, STROKE_SPEED_MAX_M_S,
};
use crate::cue::{Aim, CuePath, CuePiece};
use crate::physics::spring;
use crate::units::{Seconds, TICK_S};
use glam::DVec3;

/// The hand may be ahead of the tip by what a tip at full speed lags, and no farther [m]:
/// otherwise the tip would run on after the hand has stopped.
const LEAD_MAX_M: f64 = 2.0 * STROKE_SPEED_MAX_M_S / STROKE_FILTER_RAD_S;
/// A tip that is this near to the hand [m] and this slow [m/s] has arrived.
const ARRIVED_M: f64 = 1e-6;
const ARRIVED_M_S: f64 = 1e-4;

/// Motion along the shaft in one tick; 0 is where the tip meets the ball, negative is behind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stretch {
    /// At its start [m].
    pub at_m: f64,
    /// At its start [m/s].
    pub speed_m_s: f64,
    /// Throughout [m/s²].
    pub acceleration_m_s2: f64,
}

impl Stretch {
    fn stands(&self) -> bool {
        self.speed_m_s == 0.0 && self.acceleration_m_s2 == 0.0
    }
}

/// The tip during one stroke.
#[derive(Debug, Clone)]
pub(super) struct Tip {
    /// Where the hand wants it [m].
    hand_m: f64,
    /// Where it is [m].
    at_m: f64,
    speed_m_s: f64,
    /// Movements that are still to be handed out, one place a tick, round and round [m].
    spread: [f64; SPREAD_MAX_TICKS],
    next: usize,
    /// Ticks since the last movement, and between the last two.
    silent: usize,
    interval: usize,
    /// The last stretch that was handed out stands still.
    is_told: bool,
    /// No hand moves it any more: it only goes to where the hand let go.
    is_let_go: bool,
}

impl Tip {
    /// A tip that rests at the address.
    pub fn new() -> Self {
        Tip {
            hand_m: -ADDRESS_GAP_M,
            at_m: -ADDRESS_GAP_M,
            speed_m_s: 0.0,
            spread: [0.0; SPREAD_MAX_TICKS],
            next: 0,
            silent: SPREAD_MAX_TICKS,
            interval: 1,
            is_told: false,
            is_let_go: false,
        }
    }

    /// How far it is behind the ball [m].
    pub fn pulled_back_m(&self) -> f64 {
        (-self.at_m).max(0.0)
    }

    /// Its speed forwards [m/s].
    pub fn speed_m_s(&self) -> f64 {
        self.speed_m_s
    }

    /// Whether the hand, after a movement `up` [heights of the window], is where the tip meets the
    /// ball or beyond.
    pub fn is_hand_through(&self, up: f64) -> bool {
        let on_its_way_m: f64 = self.spread.iter().sum();
        0.0 <= self.hand_m + on_its_way_m + up * STROKE_M_PER_HEIGHT
    }

    /// The hand lets go, after a movement `up` [heights of the window].
    pub fn let_go(&mut self, up: f64) {
        self.take(up * STROKE_M_PER_HEIGHT);
        self.is_let_go = true;
    }

    /// Whether the tip rests where a hand let go.
    pub fn has_arrived_alone(&self) -> bool {
        let is_spread = self.spread.iter().all(|movement| *movement == 0.0);
        self.is_let_go
            && is_spread
            && self.speed_m_s == 0.0
            && (self.at_m - self.hand_m).abs() < ARRIVED_M
    }

    /// One tick, in which the mouse moved by `up` heights of the window. None if the tip stands
    /// and that was said already.
    pub fn step(&mut self, up: f64) -> Option<Stretch> {
        if !self.is_let_go {
            self.take(up * STROKE_M_PER_HEIGHT);
        }
        self.hand_m += std::mem::take(&mut self.spread[self.next]);
        self.next = (self.next + 1) % SPREAD_MAX_TICKS;
        self.hand_m = self.hand_m.clamp(-PULL_MAX_M, self.at_m.max(-PULL_MAX_M) + LEAD_MAX_M);

        let (at_m, before) = (self.at_m, self.speed_m_s);
        let off = at_m - self.hand_m;
        let [_, to_speed] = spring::propagator(STROKE_FILTER_RAD_S, 1.0, TICK_S);
        let mut wanted = to_speed[0] * off + to_speed[1] * before;
        if off.abs() < ARRIVED_M && wanted.abs() < ARRIVED_M_S {
            wanted = 0.0;
        }
        let change_max = STROKE_ACCELERATION_MAX_M_S2 * TICK_S;
        let after = (before + (wanted - before).clamp(-change_max, change_max))
            .clamp(-STROKE_SPEED_MAX_M_S, STROKE_SPEED_MAX_M_S);
        // The path is the truth: where its parabola ends, the next one begins.
        self.at_m += 0.5 * (before + after) * TICK_S;
        self.speed_m_s = after;

        let acceleration_m_s2 = (after - before) / TICK_S;
        let stretch = Stretch { at_m, speed_m_s: before, acceleration_m_s2 };
        let was_told = std::mem::replace(&mut self.is_told, stretch.stands());
        (!was_told || !stretch.stands()).then_some(stretch)
    }

    /// Spreads a movement over as many ticks as reports lie apart. Of the last two distances the
    /// longer one counts, because a burst may fall on two ticks.
    fn take(&mut self, moved_m: f64) {
        self.silent = (self.silent + 1).min(SPREAD_MAX_TICKS + 1);
        if moved_m == 0.0 {
            return;
        }
        let ticks = if self.silent > SPREAD_MAX_TICKS {
            self.interval = SPREAD_FIRST_TICKS;
            SPREAD_FIRST_TICKS
        } else {
            self.silent.max(std::mem::replace(&mut self.interval, self.silent))
        };
        self.silent = 0;
        for i in 0..ticks {
            self.spread[(self.next + i) % SPREAD_MAX_TICKS] += moved_m / ticks as f64;
        }
    }
}

/// A path of one solid piece that begins at `start_s`; `contact` is where the tip meets the ball.
pub(super) fn stroke_path(
    aim: &Aim,
    contact: DVec3,
    stretch: Stretch,
    start_s: Seconds,
) -> CuePath {
    let direction = aim.direction();
    let piece = CuePiece {
        start_s,
        duration_s: PIECE_S,
        position: contact + direction * stretch.at_m,
        velocity: direction * stretch.speed_m_s,
        acceleration: direction * stretch.acceleration_m_s2,
        direction,
        direction_end: direction,
    };
    CuePath { solid: true, pieces: std::iter::once(piece).collect() }
}

/// The cue shown at the address while somebody aims; not solid.
pub(super) fn address_path(aim: &Aim, contact: DVec3, start_s: Seconds) -> CuePath {
    let stretch = Stretch { at_m: -ADDRESS_GAP_M, speed_m_s: 0.0, acceleration_m_s2: 0.0 };
    CuePath { solid: false, ..stroke_path(aim, contact, stretch, start_s) }
}
