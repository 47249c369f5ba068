//! A ball in the stepper: its state, its path within the step, and what carries it.

use super::spatial_hash::Bounds;
use crate::ball::{Ball, BallPlace, BallState, Motion};
use crate::mesh::Surface;
use crate::physics::laws::Mover;
use crate::physics::{spring, tolerance};
use crate::units::Seconds;
use glam::{DQuat, DVec3};
use smallvec::SmallVec;

/// A surface that carries a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Unit vector from the surface to the centre.
    pub normal: DVec3,
    /// What it is.
    pub surface: Surface,
    /// The flat patch that it belongs to: faces by their patch, planes by [`Support::plane`].
    pub patch: u64,
    /// Distance of the ball's skin [m].
    pub gap_m: f64,
}

impl Support {
    /// The patch number of a plane.
    pub fn plane(index: usize) -> u64 {
        (1 << 32) | index as u64
    }
}

/// A ball's motion at a grid time, or where a contact broke its path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// When [s].
    pub time_s: Seconds,
    /// Centre [m].
    pub position: DVec3,
    /// Velocity from then on [m/s].
    pub velocity: DVec3,
    /// Angular velocity from then on [rad/s].
    pub angular_velocity: DVec3,
    /// Orientation.
    pub orientation: DQuat,
    /// How it moves.
    pub motion: Motion,
}

/// The straight path of a ball within a step: x + v (τ − t).
#[derive(Debug, Clone, Copy, Default)]
pub struct Path {
    /// When it begins, from the start of the step [s].
    pub start: Seconds,
    /// Where [m].
    pub position: DVec3,
    /// How fast [m/s]; differs from the ball's velocity for the finer integrators.
    pub velocity: DVec3,
    /// Counts its changes within the step: predictions made before one are void.
    pub revision: u32,
    /// Contacts resolved within the step.
    pub contacts: u32,
}

impl Path {
    /// Position at `tau` from the start of the step [m].
    pub fn at(&self, tau: Seconds) -> DVec3 {
        self.position + self.velocity * (tau - self.start)
    }
}

/// A ball of the simulation.
#[derive(Debug, Clone)]
pub struct Body {
    /// What it is made of.
    pub ball: Ball,
    /// Centre [m].
    pub position: DVec3,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
    /// Orientation.
    pub orientation: DQuat,
    /// How it moves.
    pub motion: Motion,
    /// Where it is in the game's sense.
    pub place: BallPlace,
    /// Where it was before, and since when it is where it is now.
    pub placed: (BallPlace, Seconds),
    /// What carries it at the grid time.
    pub supports: SmallVec<[Support; 2]>,
    /// Its next step would change no bit.
    pub asleep: bool,
    /// Path within the step.
    pub path: Path,
    /// Box around its path and what it may touch.
    pub bounds: Bounds,
    /// What the step's forces, and what carries it, did to its velocity [m/s].
    pub kick: DVec3,
    /// Rails that it has been away from since it last touched them, a bit each.
    pub clear_rails: u8,
    /// Rails that it is at, a bit each.
    pub near_rails: u8,
    /// Rails that it has touched and not parted from, a bit each.
    pub held_rails: u8,
    /// How far it moved in the last step, for the integrator that knows no velocity [m]; none if
    /// that would be wrong, and is to be written anew from its velocity.
    pub way: Option<DVec3>,
    /// What put it back where it may be, under the paper's laws: no way that it went, but taken for
    /// one [m].
    pub pushed: DVec3,
    /// The last step: its start and the contacts within.
    pub knots: SmallVec<[Knot; 3]>,
    /// Knots of the earlier parts of the step in hand.
    pub earlier: Vec<Knot>,
}

impl Body {
    /// A ball in the given state.
    pub fn new(ball: Ball, state: &BallState) -> Self {
        Body {
            ball,
            position: state.position,
            velocity: state.velocity,
            angular_velocity: state.angular_velocity,
            orientation: state.orientation.normalize(),
            motion: state.motion,
            place: state.place,
            placed: (state.place, 0.0),
            supports: SmallVec::new(),
            asleep: false,
            path: Path::default(),
            bounds: Bounds { min: state.position, max: state.position },
            kick: DVec3::ZERO,
            clear_rails: 0,
            near_rails: 0,
            held_rails: 0,
            way: None,
            pushed: DVec3::ZERO,
            knots: SmallVec::new(),
            earlier: Vec::new(),
        }
    }

    /// Whether it takes part in the simulation.
    pub fn in_play(&self) -> bool {
        self.place == BallPlace::OnTable
    }

    /// Whether it is stepped.
    pub fn active(&self) -> bool {
        self.in_play() && self.ball.flags.integrate && !self.asleep
    }

    /// Whether it touches other things.
    pub fn solid(&self) -> bool {
        self.in_play() && self.ball.flags.collide
    }

    /// As the contact laws see it.
    pub fn mover(&self) -> Mover {
        Mover::new(&self.ball, self.velocity, self.angular_velocity)
    }

    /// Takes what a contact law made of it.
    pub fn take(&mut self, mover: &Mover) {
        self.velocity = mover.velocity;
        self.angular_velocity = mover.angular_velocity;
    }

    /// Speed, or speed of its skin if it spins faster [m/s].
    pub fn liveliness(&self) -> f64 {
        self.velocity.length().max(self.angular_velocity.length() * self.ball.radius_m)
    }

    /// A knot of its state at `time_s` and `position`.
    pub fn knot(&self, time_s: Seconds, position: DVec3) -> Knot {
        Knot {
            time_s,
            position,
            velocity: self.velocity,
            angular_velocity: self.angular_velocity,
            orientation: self.orientation,
            motion: self.motion,
        }
    }

    /// The supports that hold it at `position` while it moves as it does: it touches them and does
    /// not part from them.
    pub fn holding(&self, position: DVec3) -> SmallVec<[Support; 2]> {
        let start = self.knots.first().map_or(self.position, |knot| knot.position);
        self.supports
            .iter()
            .filter(|support| {
                let gap = support.gap_m + support.normal.dot(position - start);
                gap <= tolerance::SUPPORT_M
                    && self.velocity.dot(support.normal) <= tolerance::CLOSING_M_S
            })
            .copied()
            .collect()
    }

    /// Names how it moves.
    pub fn name_motion(&mut self) {
        let carried = self
            .supports
            .iter()
            .filter(|s| self.velocity.dot(s.normal) <= tolerance::LANDING_M_S)
            .max_by(|a, b| a.normal.z.total_cmp(&b.normal.z));
        self.motion = match carried {
            _ if self.velocity == DVec3::ZERO && self.angular_velocity == DVec3::ZERO => {
                Motion::Rest
            }
            None => Motion::Airborne,
            Some(support) => {
                let slip = crate::physics::laws::cloth::slip_velocity(
                    self.velocity,
                    self.angular_velocity,
                    self.ball.radius_m,
                    support.normal,
                );
                if slip.length() > tolerance::ROLLING_SLIP_M_S {
                    Motion::Sliding
                } else if self.velocity.length() > tolerance::ROLLING_SLIP_M_S {
                    Motion::Rolling
                } else {
                    Motion::Spinning
                }
            }
        };
    }

    /// The state at a time within the last step, which ended at `end_s`.
    pub fn sample(&self, at: Seconds, end_s: Seconds) -> BallState {
        let end = self.knot(end_s, self.position);
        let after = self.knots.iter().position(|knot| knot.time_s > at);
        let (from, to) = match after {
            _ if at >= end_s => (end, end),
            Some(0) => (self.knots[0], self.knots[0]),
            Some(index) => (self.knots[index - 1], self.knots[index]),
            None => (self.knots.last().copied().unwrap_or(end), end),
        };
        let mut state = between(self.ball.id, &from, &to, at);
        state.place = if at < self.placed.1 { self.placed.0 } else { self.place };
        state
    }
}

/// The state between two knots: straight from one to the other.
pub fn between(id: crate::ids::BallId, from: &Knot, to: &Knot, at: Seconds) -> BallState {
    let span = to.time_s - from.time_s;
    let s = if span > 0.0 { ((at - from.time_s) / span).clamp(0.0, 1.0) } else { 1.0 };
    let elapsed = if span > 0.0 { s * span } else { 0.0 };
    // A contact ends a path: up to it the velocity is that of the path's start.
    let velocity = if span > 0.0 && s < 1.0 { from.velocity } else { to.velocity };
    BallState {
        id,
        position: if s >= 1.0 { to.position } else { from.position.lerp(to.position, s) },
        velocity,
        angular_velocity: if s < 1.0 { from.angular_velocity } else { to.angular_velocity },
        orientation: if s >= 1.0 {
            to.orientation
        } else {
            spring::turned(from.orientation, from.angular_velocity, elapsed)
        },
        motion: if s >= 1.0 { to.motion } else { from.motion },
        place: BallPlace::OnTable,
    }
}
