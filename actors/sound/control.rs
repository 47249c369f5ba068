//! The actor itself.

use super::SOUND;
use super::callback::Due;
use super::knobs::Knobs;
use super::line::{News, Open};
use super::seat::{Held, Ports, Seat};
use hapticbillard::events::{Event, Health};
use hapticbillard::physics::Snapshot;
use hapticbillard::sound::{Foley, Listener, Mode, Onset, Rolling, Stream, Timeline, Told};
use hapticbillard::tick::Delivered;
use kameo::prelude::*;
use std::sync::Arc;

/// What a callback is taken to mix before it was called for the first time [frames].
const PERIOD_FIRST: u32 = 512;

/// Tells a stream what happens, while it lives.
#[derive(Actor)]
pub struct Sound {
    held: Held,
    foley: Foley,
    teller: Teller,
    /// Not shown to the foley yet: facts that lie before it may still be on their way.
    newest: Arc<Snapshot>,
    /// Nothing is heard, and the player was told so by the one before: who hears of this one shall
    /// hear it again.
    is_still_lost: bool,
    /// What found the ring full, and what found the mail full, when last looked at.
    dropped: [u64; 2],
    is_dropping: bool,
    ran_dry: u64,
}

/// What a stream was told last.
struct Teller {
    timeline: Option<Timeline>,
    pace: f64,
    listener: Option<Listener>,
    volume: Option<f32>,
    mode: Option<Mode>,
}

impl Sound {
    /// Takes hold of a line. None while somebody else does.
    pub fn new(seat: &Arc<Seat>) -> Option<Self> {
        let mut held = seat.hold()?;
        let teller = Teller::new(seat.pace());
        let (mut foley, mut newest) = (seat.foley(), Arc::default());
        let (mut is_still_lost, mut dropped) = (false, [0, seat.dropped()]);
        if let Some(ports) = held.ports() {
            is_still_lost = ports.lost.is_some();
            dropped[0] = ports.open.as_ref().map_or(0, |open| open.counters.dropped());
            // What happened while nobody listened is not heard all at once.
            ports.mail.try_iter().for_each(drop);
            newest = ports.world.read().clone();
            foley.see(&newest);
        }
        Some(Sound {
            held,
            foley,
            teller,
            newest,
            is_still_lost,
            dropped,
            is_dropping: false,
            ran_dry: 0,
        })
    }
}

/// Pass on what has happened since the last time.
pub struct Work;

/// What the player should be told.
#[derive(Debug, Clone, PartialEq, Reply)]
pub struct Worked(pub Vec<Health>);

impl Message<Work> for Sound {
    type Reply = Worked;

    async fn handle(&mut self, _: Work, _: &mut Context<Self, Worked>) -> Worked {
        Worked(self.work())
    }
}

impl Sound {
    fn work(&mut self) -> Vec<Health> {
        let seat = self.held.seat().clone();
        let mut news = Vec::new();
        let Some(ports) = self.held.ports() else { return news };
        if std::mem::take(&mut self.is_still_lost) {
            let reason = ports.lost.clone();
            news.extend(reason.map(|reason| Health::ActorFailed { actor: SOUND.into(), reason }));
        }
        while let Ok(told) = ports.news.try_recv() {
            news.extend(hear_line(ports, &mut self.teller, told));
            (self.dropped[0], self.ran_dry) = (0, 0);
        }

        // The world first: mail that comes behind it may be older, but none is missing that is.
        let world = ports.world.read().clone();
        let Ports { open, mail, listener, .. } = ports;
        let mut stream = open.as_mut().map(|open| (open, &mut self.teller));
        for delivered in mail.try_iter() {
            if self.newest.time_s < delivered.table.time_s {
                see(&mut self.foley, &self.newest, &mut stream);
            }
            hear(&mut self.foley, &delivered, &mut stream);
            see(&mut self.foley, &delivered.table, &mut stream);
        }
        if self.newest.time_s < world.time_s {
            see(&mut self.foley, &self.newest, &mut stream);
            self.newest = world;
        }
        if let Some((open, teller)) = &mut stream {
            teller.turn(open, *listener.read(), seat.knobs());
            let ran_dry = open.counters.xruns();
            let before = std::mem::replace(&mut self.ran_dry, ran_dry);
            seat.knobs().note_ran_dry(ran_dry.saturating_sub(before));
            if before == 0 && 0 < ran_dry {
                tracing::warn!("{SOUND}: the device ran dry; how often is said at its end");
            }
        }
        let in_ring = open.as_ref().map_or(self.dropped[0], |open| open.counters.dropped());
        let dropped = [in_ring, seat.dropped()];
        // Once as long as it goes on.
        let is_dropping = std::mem::replace(&mut self.dropped, dropped) != dropped;
        if !std::mem::replace(&mut self.is_dropping, is_dropping) && is_dropping {
            let dropped = dropped.iter().sum();
            news.push(Health::QueueFull { queue: SOUND.into(), dropped });
        }
        news
    }
}

type Way<'a> = Option<(&'a mut Open, &'a mut Teller)>;

fn hear(foley: &mut Foley, delivered: &Delivered, stream: &mut Way<'_>) {
    for stamped in delivered.events.iter() {
        let Event::Fact(fact) = &stamped.event else { continue };
        let onset = foley.hear(fact, Some(&delivered.table));
        if let (Some(onset), Some((open, teller))) = (onset, &mut *stream) {
            teller.begin(open, &onset);
        }
    }
}

fn see(foley: &mut Foley, snapshot: &Arc<Snapshot>, stream: &mut Way<'_>) {
    let (onsets, rollings) = foley.see(snapshot);
    let Some((open, teller)) = stream else { return };
    onsets.iter().for_each(|onset| teller.begin(open, onset));
    for rolling in rollings {
        teller.roll(open, snapshot.time_s, rolling);
    }
}

impl Teller {
    /// Of a stream that was told nothing.
    fn new(pace: f64) -> Self {
        Teller { timeline: None, pace, listener: None, volume: None, mode: None }
    }

    fn timeline(&mut self, open: &Open) -> &mut Timeline {
        let pace = self.pace;
        self.timeline.get_or_insert_with(|| Timeline::new(f64::from(open.rate_hz), pace))
    }

    fn begin(&mut self, open: &mut Open, onset: &Onset) {
        let at_frame = self.timeline(open).onset(onset.time_s, stream(open));
        // At once: the mixer waits for the frame itself, and what begins sooner may be told later.
        tell(open, (0, Told::Start { at_frame, onset: *onset }));
    }

    fn roll(&mut self, open: &mut Open, time_s: f64, rolling: Rolling) {
        let at_frame = self.timeline(open).state(time_s, stream(open));
        tell(open, (at_frame, Told::Roll(rolling)));
    }

    /// Where it is heard from, how loud, and what it is mixed for, if that has changed; it holds
    /// behind what was told before. What found the ring full is told again.
    fn turn(&mut self, open: &mut Open, listener: Listener, knobs: &Knobs) {
        let (volume, mode) = (knobs.volume(), knobs.mode());
        if self.listener != Some(listener) && tell(open, (0, Told::Listener(listener))) {
            self.listener = Some(listener);
        }
        if self.volume != Some(volume) && tell(open, (0, Told::Volume(volume))) {
            self.volume = Some(volume);
        }
        if self.mode != Some(mode) && tell(open, (0, Told::Mode(mode))) {
            self.mode = Some(mode);
        }
    }
}

fn stream(open: &Open) -> Stream {
    let period = match open.counters.period() {
        0 => PERIOD_FIRST,
        period => period,
    };
    Stream { now: open.counters.next(), period }
}

/// Says whether it got in. When the ring is full it is dropped: the stream stands still, or far
/// more happens than can be heard.
fn tell(open: &mut Open, due: Due) -> bool {
    let is_in = open.tell.push(due).is_ok();
    if !is_in {
        open.counters.note_dropped();
    }
    is_in
}

/// A stream is there, or no longer; what the player is told of it.
fn hear_line(ports: &mut Ports, teller: &mut Teller, told: News) -> Option<Health> {
    *teller = Teller::new(teller.pace);
    match told {
        News::Open(open) => {
            tracing::info!("{SOUND}: plays through {} at {} Hz", open.device, open.rate_hz);
            ports.open = Some(open);
            ports.lost.take().map(|_| Health::ActorRestarted { actor: SOUND.into() })
        }
        News::Lost(reason) => {
            tracing::warn!("{SOUND}: {reason}; the game goes on without it");
            ports.open = None;
            ports.lost = Some(reason.clone());
            Some(Health::ActorFailed { actor: SOUND.into(), reason })
        }
    }
}
