//! The event manager: order of delayed delivery, topics, interest (paper, section 5.1).

use crate::events::Event;
use serde::{Deserialize, Serialize};

/// An event on its way to the event manager.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Publication {
    /// What.
    pub event: Event,
    /// How many ticks later than the next one it is due.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub delay_ticks: u64,
    /// A label by which its publisher can take it back.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<u32>,
}

fn is_zero(ticks: &u64) -> bool {
    *ticks == 0
}

impl From<Event> for Publication {
    fn from(event: Event) -> Self {
        Publication { event, delay_ticks: 0, label: None }
    }
}
