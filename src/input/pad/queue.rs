//! What a gamepad has said since somebody looked last.

use super::{PadAxis, PadInput};
use std::collections::VecDeque;

/// Edges that wait at most: nobody's thumbs make so many before a window looks again.
const WAITING: usize = 4096;

/// All edges in order, and of every axis only the newest value.
///
/// A gamepad may report a thousand times a second and a window may look twenty times: what it gets
/// is every press and release, and each axis at most once. When more than [`WAITING`] edges wait,
/// nobody looks: they are dropped and counted, and the gamepad counts as lost.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PadQueue {
    edges: VecDeque<PadInput>,
    axes: [Option<f64>; PadAxis::ALL.len()],
    lost: u64,
}

impl PadQueue {
    /// Takes a report.
    pub fn say(&mut self, report: PadInput) {
        match report {
            PadInput::Axis { axis, value } => self.axes[axis as usize] = Some(value),
            PadInput::Lost => {
                // What its sticks said is no longer so.
                self.axes = Default::default();
                self.edges.push_back(report);
            }
            PadInput::Button { .. } | PadInput::Connected => self.edges.push_back(report),
        }
        if WAITING < self.edges.len() {
            self.lost += self.edges.len() as u64;
            self.edges = VecDeque::from([PadInput::Lost]);
        }
    }

    /// What waits: the edges in order, then the axes.
    pub fn take(&mut self) -> Vec<PadInput> {
        let axes = PadAxis::ALL.into_iter().zip(std::mem::take(&mut self.axes));
        let moved = axes.filter_map(|(axis, value)| Some(PadInput::Axis { axis, value: value? }));
        self.edges.drain(..).chain(moved).collect()
    }

    /// How many edges were dropped because nobody looked.
    pub fn lost(&self) -> u64 {
        self.lost
    }
}
