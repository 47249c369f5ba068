//! What the runtime has to tell the player about itself, on its way to the conductor.

use hapticbillard::events::Health;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The way to the conductor, which takes all news in every tick. Nobody waits for it: when it is
/// full, news are dropped and counted, and the log has them.
#[derive(Debug, Clone)]
pub struct News {
    way: flume::Sender<Health>,
    dropped: Arc<AtomicU64>,
}

impl From<flume::Sender<Health>> for News {
    fn from(way: flume::Sender<Health>) -> Self {
        News { way, dropped: Arc::default() }
    }
}

impl News {
    /// Tells it. Where nobody listens any more the game is over.
    pub fn tell(&self, health: Health) {
        if let Err(flume::TrySendError::Full(health)) = self.way.try_send(health) {
            self.dropped.fetch_add(1, Ordering::Relaxed);
            tracing::warn!("the player is not told: {health:?}");
        }
    }

    /// What was dropped; all clones share it.
    pub fn dropped(&self) -> &Arc<AtomicU64> {
        &self.dropped
    }

    /// The way itself, without keeping it open.
    pub fn way(&self) -> flume::WeakSender<Health> {
        self.way.downgrade()
    }
}
