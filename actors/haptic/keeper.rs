//! Keeps a control at the servo: looks at it some times a second, and starts another one when it
//! is gone. Meanwhile nothing is felt.

use super::HAPTIC;
use super::control::{Haptic, Look};
use super::rights::Refusal;
use super::seat::Seat;
use crate::news::News;
use hapticbillard::events::Health;
use kameo::mailbox;
use kameo::prelude::*;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::watch;
use tokio::task::JoinHandle;

/// How long between two looks.
const LOOK: Duration = Duration::from_millis(50);
/// How long the first pause before a restart is, and the longest.
const PAUSE: Duration = Duration::from_millis(250);
const PAUSE_MAX: Duration = Duration::from_secs(60);
/// A control that has lived so long has failed for a reason of its own.
const SETTLED: u32 = 200;
const MAILBOX: usize = 4;

/// A kept servo.
pub struct Keeper {
    seat: Arc<Seat>,
    control: watch::Receiver<Option<ActorRef<Haptic>>>,
    end: watch::Sender<bool>,
    task: JoinHandle<()>,
}

/// Who is told of each control that takes its place.
pub type Joins = Box<dyn Fn(&ActorRef<Haptic>) + Send + Sync>;

/// Keeps a control at this servo, and tells `news` what the player should know.
pub fn keep(seat: Arc<Seat>, news: impl Into<News>) -> Keeper {
    keep_and_tell(seat, news, Box::new(|_| ()))
}

/// The same, and `joins` is told of each control.
pub fn keep_and_tell(seat: Arc<Seat>, news: impl Into<News>, joins: Joins) -> Keeper {
    let news = news.into();
    for refusal in seat.refusals() {
        tracing::warn!("{HAPTIC}: {refusal}");
        let Refusal { asked, reason, remedy } = refusal.clone();
        news.tell(Health::Refused { actor: HAPTIC.into(), asked, reason, remedy });
    }
    let (shown, control) = watch::channel(None);
    let (end, ended) = watch::channel(false);
    let task = tokio::spawn(run(seat.clone(), news, joins, shown, ended));
    Keeper { seat, control, end, task }
}

impl Keeper {
    /// The servo.
    pub fn seat(&self) -> &Arc<Seat> {
        &self.seat
    }

    /// The control, once there is one; none while there is none.
    pub fn control(&self) -> Option<ActorRef<Haptic>> {
        self.control.borrow().clone()
    }

    /// Ends the control, then the thread; returns when both are gone.
    pub async fn end(self) {
        // A task that has ended is what is wanted.
        let _ = self.end.send(true);
        let _ = self.task.await;
    }
}

async fn run(
    seat: Arc<Seat>,
    news: News,
    joins: Joins,
    shown: watch::Sender<Option<ActorRef<Haptic>>>,
    mut ended: watch::Receiver<bool>,
) {
    let mut pause = PAUSE;
    let mut was_gone = false;
    loop {
        // The one before has let go when it is dropped, which may be a moment after its end.
        if let Some(control) = Haptic::new(&seat) {
            let control = Haptic::spawn_with_mailbox(control, mailbox::bounded(MAILBOX));
            shown.send_replace(Some(control.clone()));
            joins(&control);
            if was_gone {
                news.tell(Health::ActorRestarted { actor: HAPTIC.into() });
            }
            let looks = look_on(&control, &news, &mut ended).await;
            shown.send_replace(None);
            if *ended.borrow() {
                // One that has stopped already is what is wanted.
                let _ = control.stop_gracefully().await;
                control.wait_for_shutdown().await;
                return;
            }
            let reason = "its control stopped: no force until another one starts".to_string();
            tracing::warn!("{HAPTIC}: {reason}");
            news.tell(Health::ActorFailed { actor: HAPTIC.into(), reason });
            was_gone = true;
            pause = if looks < SETTLED { (2 * pause).min(PAUSE_MAX) } else { PAUSE };
        }
        tokio::select! {
            () = tokio::time::sleep(pause) => {}
            _ = ended.changed() => return,
        }
    }
}

/// Looks at the servo until its control is gone or the end comes; returns how often.
async fn look_on(
    control: &ActorRef<Haptic>,
    news: &News,
    ended: &mut watch::Receiver<bool>,
) -> u32 {
    let mut looks = 0_u32;
    loop {
        tokio::select! {
            () = tokio::time::sleep(LOOK) => {}
            _ = ended.changed() => return looks,
        }
        let Ok(looked) = control.ask(Look).await else { return looks };
        looks = looks.saturating_add(1);
        looked.news.into_iter().for_each(|health| news.tell(health));
    }
}
