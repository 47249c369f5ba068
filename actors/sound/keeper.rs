//! Keeps sound controlled: calls its actor often, and starts another one when it is gone.

use super::SOUND;
use super::control::{Sound, Work};
use super::seat::Seat;
use crate::news::News;
use hapticbillard::events::Health;
use kameo::mailbox;
use kameo::prelude::*;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;
use tokio::task::JoinHandle;

/// How long between two calls: what happens is heard so much later at most.
const CALL: Duration = Duration::from_millis(2);
/// How long the first pause before a restart is, and the longest; each is twice the one before.
const PAUSE: Duration = Duration::from_millis(250);
const PAUSE_MAX: Duration = Duration::from_secs(60);
/// A control that was called so often has failed for a reason of its own.
const SETTLED: u32 = 5000;
const MAILBOX: usize = 4;

/// Kept sound.
pub struct Keeper {
    seat: Arc<Seat>,
    end: watch::Sender<bool>,
    task: JoinHandle<()>,
}

/// Who is told of each control that takes its place.
pub type Joins = Box<dyn Fn(&ActorRef<Sound>) + Send + Sync>;

/// Keeps a control at this line, tells `news` what the player should know, and `joins` of each
/// control.
pub fn keep(seat: Arc<Seat>, news: impl Into<News>, joins: Joins) -> Keeper {
    let (end, ended) = watch::channel(false);
    let task = tokio::spawn(run(seat.clone(), news.into(), joins, ended));
    Keeper { seat, end, task }
}

impl Keeper {
    /// Ends the control, then the line; returns when both are gone.
    pub async fn end(self) {
        // A task that has ended is what is wanted.
        let _ = self.end.send(true);
        let _ = self.task.await;
        self.seat.end().await;
    }
}

async fn run(seat: Arc<Seat>, news: News, joins: Joins, mut ended: watch::Receiver<bool>) {
    // None before the first that failed.
    let mut pause: Option<Duration> = None;
    let mut was_gone = false;
    loop {
        // The one before has let go when it is dropped, which may be a moment after its end.
        if let Some(control) = Sound::new(&seat) {
            let control = Sound::spawn_with_mailbox(control, mailbox::bounded(MAILBOX));
            joins(&control);
            if was_gone {
                news.tell(Health::ActorRestarted { actor: SOUND.into() });
            }
            let calls = call(&control, &news, &mut ended).await;
            if *ended.borrow() {
                // One that has stopped already is what is wanted.
                let _ = control.stop_gracefully().await;
                control.wait_for_shutdown().await;
                return;
            }
            let reason = "its control stopped; another one starts".to_string();
            tracing::warn!("{SOUND}: {reason}");
            news.tell(Health::ActorFailed { actor: SOUND.into(), reason });
            was_gone = true;
            pause = Some(match pause {
                Some(before) if calls < SETTLED => (2 * before).min(PAUSE_MAX),
                _ => PAUSE,
            });
        }
        tokio::select! {
            () = tokio::time::sleep(pause.unwrap_or(PAUSE)) => {}
            _ = ended.changed() => return,
        }
    }
}

/// Calls the control until it is gone or the end comes; returns how often.
async fn call(control: &ActorRef<Sound>, news: &News, ended: &mut watch::Receiver<bool>) -> u32 {
    let mut calls = 0_u32;
    loop {
        tokio::select! {
            () = tokio::time::sleep(CALL) => {}
            _ = ended.changed() => return calls,
        }
        let Ok(worked) = control.ask(Work).await else { return calls };
        calls = calls.saturating_add(1);
        worked.0.into_iter().for_each(|health| news.tell(health));
    }
}
