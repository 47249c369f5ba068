//! One sound that has begun, and its ways to the ears.

use super::bus::Buses;
use super::clean::clean;
use super::head::arrivals;
use super::path::{BACK, BLOCK, EarPath, Run};
use super::ramp::Ramp;
use super::room::Reflections;
use super::surroundings::Surroundings;
use super::{Listener, Mode};
use crate::sound::{Bank, Onset, Voice};
use glam::Vec3;

/// How long the old way of a sound and its new one are heard together [s].
const CROSS_FADE_S: f32 = 0.010;
/// How long a sound fades whose slot another one gets [s].
const STEAL_S: f32 = 0.003;
/// How fast a sound grows that another one was merged into [s].
const MERGE_S: f32 = 0.001;
/// No sound stands for more than this many of its kind, as a factor.
const MERGED_MAX: f32 = 4.0;

/// A sound that has begun.
///
/// Its ways to the ears are those of its beginning. A listener who moves on while it sounds hears
/// it cross-fade to new ways, so that no way ever changes under a sound.
#[derive(Debug, Clone)]
pub struct Slot {
    voice: Voice,
    position_m: Vec3,
    /// First frame.
    at: u64,
    /// Frame after the last one; unknown while the source goes on.
    ends_at: u64,
    past: [f32; BACK],
    gain: Ramp,
    /// Factor of the louder ear, for the choice of the quietest.
    nearness: f32,
    ways: [EarPath; 2],
    leaving: Option<[EarPath; 2]>,
    /// Share of `ways` beside `leaving`.
    arriving: Ramp,
    heard_by: (Listener, Mode),
    reflections: Option<Reflections>,
}

impl Slot {
    /// Begins at frame `at`, at a place that can be reckoned with.
    pub fn new(onset: &Onset, position_m: Vec3, at: u64, around: &Surroundings) -> Slot {
        let voice = Voice::begin(onset, &around.bank, around.rate_hz);
        let (ways, nearness) = ways(&voice, position_m, around);
        let reflections = around
            .room
            .map(|room| Reflections::new(&room, around, position_m, |way| voice.directivity(way)));
        Slot {
            voice,
            position_m,
            at,
            ends_at: u64::MAX,
            past: [0.0; BACK],
            gain: Ramp::at(1.0),
            nearness,
            ways,
            leaving: None,
            arriving: Ramp::at(1.0),
            heard_by: (around.listener, around.mode),
            reflections,
        }
    }

    /// What is still to be heard of it, at the louder ear [Pa].
    pub fn loudness(&self) -> f32 {
        let loudness = self.voice.loudness() * self.gain.target() * self.nearness;
        if loudness.is_nan() { 0.0 } else { loudness }
    }

    /// Distance to another sound of the same class that begins within `frames` of this one [m].
    pub fn likeness_m(&self, other: &Slot, frames: u64) -> Option<f32> {
        let alike =
            self.voice.class() == other.voice.class() && self.at.abs_diff(other.at) <= frames;
        alike.then(|| self.position_m.distance(other.position_m))
    }

    /// Grows by the power of another one; or cannot, since that is far louder.
    pub fn merge(&mut self, other: &Slot, around: &Surroundings) -> bool {
        let ratio = other.loudness() / self.loudness();
        let factor = self.gain.target() * (1.0 + ratio * ratio).sqrt();
        // A ratio of nothing to nothing fails as well.
        let fits = factor <= MERGED_MAX;
        if fits {
            self.gain.to(factor, around.frames(MERGE_S));
        }
        fits
    }

    /// Decides what changes slowly; false when all of it has been heard.
    pub fn decide(&mut self, now: u64, around: &Surroundings) -> bool {
        if self.ends_at == u64::MAX && self.voice.is_over() {
            self.ends_at = now + around.tail_frames();
        }
        let heard_as_now =
            self.heard_by.1 == around.mode && self.heard_by.0.hears_as(&around.listener);
        if self.leaving.is_none() && !heard_as_now {
            let (ways, nearness) = ways(&self.voice, self.position_m, around);
            self.leaving = Some(std::mem::replace(&mut self.ways, ways));
            self.nearness = nearness;
            self.heard_by = (around.listener, around.mode);
            self.arriving = Ramp::at(0.0);
            self.arriving.to(1.0, around.frames(CROSS_FADE_S));
        }
        now < self.ends_at
    }

    /// The next frames, `from` on: at most a block.
    pub fn sound(&mut self, from: u64, frames: usize, bank: &Bank, buses: &mut Buses) {
        let wait = self.at.saturating_sub(from).min(frames as u64);
        let (from, frames) = (from + wait, (frames - wait as usize).min(BLOCK));
        if frames == 0 {
            return;
        }
        let mut run: Run = [0.0; BACK + BLOCK];
        run[..BACK].copy_from_slice(&self.past);
        let new = &mut run[BACK..BACK + frames];
        self.voice.fill(bank, new);
        clean(new);
        self.gain.apply(new);
        if let Some(reflections) = &self.reflections {
            reflections.deliver(buses, from, new);
        }
        self.past.copy_from_slice(&run[frames..frames + BACK]);
        self.hear(&run, from, frames, buses);
    }

    fn hear(&mut self, run: &Run, from: u64, frames: usize, buses: &mut Buses) {
        let mut arriving = self.arriving;
        for (ear, lane) in buses.direct.iter_mut().enumerate() {
            let mut heard = [0.0; BLOCK];
            let heard = &mut heard[..frames];
            self.ways[ear].hear(run, heard);
            arriving = self.arriving;
            if let Some(leaving) = &mut self.leaving {
                let mut old = [0.0; BLOCK];
                let old = &mut old[..frames];
                leaving[ear].hear(run, old);
                for (new, old) in heard.iter_mut().zip(old.iter_mut()) {
                    let share = arriving.next();
                    *new *= share;
                    *old *= 1.0 - share;
                }
                leaving[ear].deliver(lane, from, old);
            }
            self.ways[ear].deliver(lane, from, heard);
        }
        self.arriving = arriving;
        if arriving.is_at_rest() {
            self.leaving = None;
        }
    }

    /// Fades within 3 ms, all of it written ahead: its slot is free at once.
    pub fn let_go(mut self, now: u64, around: &Surroundings, buses: &mut Buses) {
        if self.at >= now {
            return;
        }
        let fade = around.frames(STEAL_S);
        self.gain.to(0.0, fade);
        let end = now + u64::from(fade) + around.tail_frames();
        let mut from = now;
        while from < end {
            let frames = (end - from).min(BLOCK as u64);
            self.sound(from, frames as usize, &around.bank, buses);
            from += frames;
        }
    }
}

/// The ways from a sound to both ears, and the factor of the louder one.
fn ways(voice: &Voice, position_m: Vec3, around: &Surroundings) -> ([EarPath; 2], f32) {
    let to_head = (around.listener.position_m - position_m).normalize_or(Vec3::X);
    let sent = voice.directivity(to_head);
    let arrivals = arrivals(&around.listener, around.mode, position_m);
    let ways = arrivals.map(|arrival| EarPath::new(&arrival, sent, around));
    (ways, sent * arrivals[0].gain.max(arrivals[1].gain))
}
