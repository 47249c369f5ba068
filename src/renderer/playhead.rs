//! Which moment a picture shows.

use crate::ball::BallState;
use crate::physics::Snapshot;
use crate::units::Seconds;
use std::sync::Arc;

/// The world between two snapshots: places along the straight line, orientations on the shortest
/// turn. A ball that changes its place in the game does so at the later one.
pub fn between(a: &Snapshot, b: &Snapshot, time_s: Seconds) -> Snapshot {
    let span_s = b.time_s - a.time_s;
    if span_s <= 0.0 || b.time_s <= time_s {
        return b.clone();
    }
    let s = ((time_s - a.time_s) / span_s).clamp(0.0, 1.0);
    let balls = b.balls.iter().map(|to| match a.ball(to.id) {
        Some(from) if from.place == to.place => BallState {
            position: from.position.lerp(to.position, s),
            orientation: from.orientation.slerp(to.orientation, s),
            ..*to
        },
        Some(from) => *from,
        None => *to,
    });
    let cue = match (a.cue, b.cue) {
        (Some(from), Some(to)) => {
            let mut cue = to;
            cue.tip = from.tip.lerp(to.tip, s);
            cue.direction = from.direction.lerp(to.direction, s).normalize_or(to.direction);
            Some(cue)
        }
        (from, _) => from,
    };
    Snapshot { time_s: a.time_s + s * span_s, balls: balls.collect(), cue }
}

/// Follows the newest state of the world with a picture's own time.
///
/// At the usual pace the newest state is at most a tick old and is shown as it is. In slow motion
/// pictures come faster than ticks; then the last two are blended, one tick behind.
#[derive(Debug, Clone)]
pub struct Playhead {
    before: Arc<Snapshot>,
    newest: Arc<Snapshot>,
    /// When it came, on the picture's clock [s].
    arrived_s: Seconds,
    /// Seconds of the game per second.
    speed: f64,
}

/// Below this pace ticks are blended: they are then more than 4 ms apart.
const SLOW: f64 = 0.25;

impl Playhead {
    /// A playhead at the start of a game that runs at `speed` seconds per second.
    pub fn new(first: Arc<Snapshot>, speed: f64) -> Self {
        Playhead { before: first.clone(), newest: first, arrived_s: 0.0, speed }
    }

    /// A state came at `now_s` on the picture's clock [s].
    pub fn take(&mut self, state: &Arc<Snapshot>, now_s: Seconds) {
        if state.time_s == self.newest.time_s && Arc::ptr_eq(state, &self.newest) {
            return;
        }
        self.before = std::mem::replace(&mut self.newest, state.clone());
        self.arrived_s = now_s;
    }

    /// What is shown at `now_s`.
    pub fn shown(&self, now_s: Seconds) -> Arc<Snapshot> {
        if SLOW <= self.speed {
            return self.newest.clone();
        }
        let time_s = self.before.time_s + (now_s - self.arrived_s) * self.speed;
        if self.newest.time_s <= time_s {
            return self.newest.clone();
        }
        Arc::new(between(&self.before, &self.newest, time_s))
    }
}
