//! Somebody outside who says something now and then that changes nothing, but is recorded and
//! heard: so that a loss would show.

use hapticbillard::event_manager::Publication;
use hapticbillard::events::{Event, MenuAction};
use hapticbillard::hash::seed_of;
use hapticbillard::tick::{Frame, FrameSource, Inflow};
use hapticbillard::units::Tick;

/// Ticks between two words.
const BETWEEN: u64 = 400;

/// Says the same in the same tick, however often it is asked.
#[derive(Debug, Clone, Copy)]
pub struct Chatter {
    /// Fixes what is said.
    pub seed: u64,
}

impl FrameSource for Chatter {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let mut frame = Frame::new();
        if tick.0.is_multiple_of(BETWEEN) && 0 < tick.0 {
            let action = match seed_of(self.seed, tick.0) % 3 {
                0 => MenuAction::Pause,
                1 => MenuAction::Resume,
                _ => MenuAction::Quit,
            };
            frame.push(Publication::from(Event::Menu(action)));
        }
        let next = Some(Tick((tick.0 / BETWEEN + 1) * BETWEEN));
        Inflow { frame, next, ..Inflow::default() }
    }
}
