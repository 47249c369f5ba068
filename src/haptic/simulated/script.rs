//! What a hand intends, as a script: legs from place to place, buttons held, stylus turned.

use crate::haptic::device::Buttons;
use crate::units::Seconds;
use glam::{DQuat, DVec3};

/// What the hand wants at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intent {
    /// Where [m].
    pub position: DVec3,
    /// How fast [m/s].
    pub velocity: DVec3,
    /// Acceleration [m/s²].
    pub acceleration: DVec3,
    /// How much of its own inertia and damping the hand makes up for: 0 none, 1 all of it.
    pub practice: f64,
    /// What is held.
    pub buttons: Buttons,
    /// How the stylus is turned.
    pub orientation: DQuat,
}

impl Intent {
    /// Staying at a place.
    pub fn at(position: DVec3) -> Self {
        Intent {
            position,
            velocity: DVec3::ZERO,
            acceleration: DVec3::ZERO,
            practice: 0.0,
            buttons: Buttons::default(),
            orientation: DQuat::IDENTITY,
        }
    }
}

/// One leg: from where the last one ended to a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// Where it ends [m].
    pub to: DVec3,
    /// How fast the hand is there [m/s].
    pub velocity: DVec3,
    /// How long it takes [s].
    pub duration_s: Seconds,
    /// What is held meanwhile.
    pub buttons: Buttons,
    /// How the stylus is turned meanwhile.
    pub orientation: DQuat,
    /// At constant speed, with jerks at both ends; otherwise smoothly.
    pub straight: bool,
}

impl Leg {
    /// A smooth way to a place, at rest there.
    pub fn to(to: DVec3, duration_s: Seconds) -> Self {
        Leg::through(to, DVec3::ZERO, duration_s)
    }

    /// A smooth way to a place that is passed at a velocity.
    pub fn through(to: DVec3, velocity: DVec3, duration_s: Seconds) -> Self {
        Leg {
            to,
            velocity,
            duration_s,
            buttons: Buttons::default(),
            orientation: DQuat::IDENTITY,
            straight: false,
        }
    }

    /// A way at constant speed.
    pub fn ramp(to: DVec3, duration_s: Seconds) -> Self {
        Leg { straight: true, ..Leg::to(to, duration_s) }
    }

    /// The same with buttons held.
    pub fn holding(self, buttons: Buttons) -> Self {
        Leg { buttons, ..self }
    }

    /// The same with the stylus turned.
    pub fn turned(self, orientation: DQuat) -> Self {
        Leg { orientation, ..self }
    }
}

/// Legs one after the other; then the hand stays.
#[derive(Debug, Clone, PartialEq)]
pub struct HandScript {
    start: DVec3,
    start_velocity: DVec3,
    practice: f64,
    legs: Vec<Leg>,
}

impl HandScript {
    /// A hand that knows how heavy it is and follows its legs closely.
    pub fn practised(start: DVec3, legs: Vec<Leg>) -> Self {
        HandScript { start, start_velocity: DVec3::ZERO, practice: 1.0, legs }
    }

    /// A hand whose spring is drawn along the legs, and which follows as it can.
    pub fn drawn(start: DVec3, legs: Vec<Leg>) -> Self {
        HandScript { start, start_velocity: DVec3::ZERO, practice: 0.0, legs }
    }

    /// The same, moving at the start.
    pub fn moving(self, start_velocity: DVec3) -> Self {
        HandScript { start_velocity, ..self }
    }

    /// The same with another leg at its end.
    pub fn then(mut self, leg: Leg) -> Self {
        self.legs.push(leg);
        self
    }

    /// How long all legs take [s].
    pub fn duration_s(&self) -> Seconds {
        self.legs.iter().map(|leg| leg.duration_s).sum()
    }

    /// What the hand wants at `time_s`.
    pub fn at(&self, time_s: Seconds) -> Intent {
        let (mut from, mut speed, mut begin) = (self.start, self.start_velocity, 0.0);
        for leg in &self.legs {
            if time_s < begin + leg.duration_s {
                let held = Intent {
                    practice: self.practice,
                    buttons: leg.buttons,
                    orientation: leg.orientation,
                    ..Intent::at(from)
                };
                return leg.at(from, speed, time_s - begin, held);
            }
            begin += leg.duration_s;
            (from, speed) = (leg.to, leg.velocity);
        }
        let last = self.legs.last();
        Intent {
            practice: self.practice,
            buttons: last.map_or(Buttons::default(), |leg| leg.buttons),
            orientation: last.map_or(DQuat::IDENTITY, |leg| leg.orientation),
            ..Intent::at(from)
        }
    }
}

impl Leg {
    /// Along the leg, `t` after its begin: the quintic between places and velocities without
    /// acceleration at either end (Flash and Hogan 1985 for a hand at rest at both ends).
    fn at(&self, from: DVec3, speed: DVec3, t: Seconds, held: Intent) -> Intent {
        let span = self.duration_s;
        let s = (t / span).clamp(0.0, 1.0);
        if self.straight {
            let velocity = (self.to - from) / span;
            return Intent { position: from.lerp(self.to, s), velocity, ..held };
        }
        let (v0, v1) = (speed * span, self.velocity * span);
        let way = self.to - from;
        let c3 = 10.0 * way - 6.0 * v0 - 4.0 * v1;
        let c4 = -15.0 * way + 8.0 * v0 + 7.0 * v1;
        let c5 = 6.0 * way - 3.0 * v0 - 3.0 * v1;
        let position = from + (v0 + (c3 + (c4 + c5 * s) * s) * s * s) * s;
        let velocity = v0 + (3.0 * c3 + (4.0 * c4 + 5.0 * c5 * s) * s) * s * s;
        let acceleration = (6.0 * c3 + (12.0 * c4 + 20.0 * c5 * s) * s) * s;
        Intent {
            position,
            velocity: velocity / span,
            acceleration: acceleration / (span * span),
            ..held
        }
    }
}
