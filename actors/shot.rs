//! Which shot it is, for the log: a span that lasts from one turn to the next.
//!
//! The event manager begins it when it delivers a turn. It goes with the mail to those who take
//! part in the tick, and back to the conductor. Below the level `info` there is none, and it costs
//! the look at one flag.

use hapticbillard::events::{Event, Stamped};
use hapticbillard::units::Tick;
use tracing::Span;
use tracing::level_filters::LevelFilter;

/// Whether anybody may want to know. (`tracing::enabled!` knows more, but where several listen with
/// a filter each, the event behind it gets lost.)
pub fn is_told() -> bool {
    LevelFilter::INFO <= LevelFilter::current()
}

/// The span of the shot that begins with one of these events, if any does.
pub fn begun_by(events: &[Stamped], tick: Tick) -> Option<Span> {
    events.iter().find_map(|stamped| match &stamped.event {
        Event::Turn(turn) => Some(tracing::info_span!(
            parent: None,
            "shot",
            number = turn.shot_number,
            player = turn.player.0,
            tick = tick.0
        )),
        _ => None,
    })
}
