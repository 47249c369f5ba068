//! A ball that shall fall, and another one that is met first.

use super::Position;
use super::mouth::{Entry, entries};
use crate::ids::{BallId, PocketId};
use glam::DVec2;

/// Where a ball shall go, and into what.
#[derive(Debug, Clone, Copy)]
pub(super) struct Second {
    pub(super) ball: BallId,
    pub(super) at: DVec2,
    pub(super) pocket: PocketId,
    pub(super) entry: Entry,
}

/// Every own ball with every way into a pocket, and every other ball that may be met first, with
/// its place [m].
pub(super) fn by_another<'a>(
    position: &'a Position<'_>,
) -> impl Iterator<Item = (Second, BallId, DVec2)> + 'a {
    let ways = position.lying(&position.goal.own).flat_map(move |(ball, at)| {
        position.view.pockets.iter().flat_map(move |pocket| {
            let entries = entries(position, at, pocket, &[ball]).into_iter();
            entries.map(move |entry| Second { ball, at, pocket: pocket.id, entry })
        })
    });
    ways.flat_map(move |second| {
        let firsts = position.lying(&position.goal.legal);
        firsts.filter(move |(first, _)| *first != second.ball).map(move |(f, at)| (second, f, at))
    })
}
