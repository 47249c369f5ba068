//! What can go wrong in physics.

use crate::ids::BallId;
use crate::units::Seconds;

/// Physics cannot go on, or was asked for something impossible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PhysicsError {
    /// A state is no number, or grows without bound.
    #[error(
        "ball {ball} at {time_s} s: {term} is not finite; \
         use a smaller step or a softer spring, or check the values given"
    )]
    NonFinite {
        /// The ball.
        ball: BallId,
        /// When [s].
        time_s: Seconds,
        /// Which quantity.
        term: &'static str,
    },
    /// A setting is outside of what is possible.
    #[error("{key} = {value}: {allowed}")]
    Setting {
        /// Its name.
        key: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The exact solver was asked for the laws of the paper's step.
    #[error(
        "profile \"2009\" is the paper's fixed step with its faults, and event-driven has no \
         steps; use solver = \"fixed-step\", or profile = \"standard\""
    )]
    ProfileNeedsSteps,
    /// Balls were to stay on a bed that has holes and rims.
    #[error(
        "flight = false keeps balls on a plane, and this table has a mesh to fall from; use \
         planes only, or flight = true"
    )]
    FlightNeeded,
    /// The stepper cannot keep balls on the bed.
    #[error("flight = false is for solver = \"event-driven\"; fixed-step lets balls hop")]
    FlightNeedsEvents,
    /// Two balls have the same name.
    #[error("ball {0} exists twice; give each ball an id of its own")]
    DuplicateBall(BallId),
    /// Nobody knows this ball.
    #[error("there is no ball {0} in this simulation; name one that the scene lists")]
    UnknownBall(BallId),
    /// Two balls overlap at the start.
    #[error("balls {a} and {b} overlap by {depth_m} m at the start; move them apart")]
    Overlap {
        /// One ball.
        a: BallId,
        /// The other.
        b: BallId,
        /// How far [m].
        depth_m: f64,
    },
    /// A command contains something that is no number.
    #[error("a command at {time_s} s has a {term} that is not finite; it was not carried out")]
    Command {
        /// When it should act [s].
        time_s: Seconds,
        /// Which quantity.
        term: &'static str,
    },
    /// A stroke cannot meet the cue ball.
    #[error(
        "the stroke misses: an offset of {offset} of the ball's radius; \
         side and height together must stay below 1"
    )]
    Miss {
        /// √(side² + height²).
        offset: f64,
    },
    /// The solver does not get on.
    #[error(
        "{events} events within a second at {time_s} s, most of them of ball {ball}: something is \
         stuck there; move that ball, or use solver = \"fixed-step\""
    )]
    TooManyEvents {
        /// When [s].
        time_s: Seconds,
        /// How many.
        events: u64,
        /// The busiest ball.
        ball: BallId,
        /// Where everything was.
        state: Box<super::Snapshot>,
    },
    /// A rack cannot be placed.
    #[error(transparent)]
    Rack(#[from] crate::rack::RackError),
    /// Motion did not end in time.
    #[error("the balls did not come to rest within {limit_s} s; is rolling resistance zero?")]
    NeverRests {
        /// How long was computed [s].
        limit_s: Seconds,
    },
}
