//! One sound that has begun, and its ways to the ears.

use super::clean::clean;
use super::head::arrivals;
use super::line::{Line, Sums};
use super::path::{BLOCK, EarPath};
use super::ramp::Ramp;
use super::room::Reflections;
use super::surroundings::Surroundings;
use super::{Listener, Mode};
use crate::sound::{Bank, Onset, Voice};
use glam::Vec3;

/// How long the old way of a sound and its new one are heard together [s].
const CROSS_FADE_S: f32 = 0.010;
/// How fast a sound grows that another one was merged into [s].
const MERGE_S: f32 = 0.001;
/// No sound stands for more than this many of its kind, as a factor.
const MERGED_MAX: f32 = 4.0;

/// A sound that has begun.
///
/// Its ways to the ears are those of its beginning. A listener who moves on while it sounds hears
/// it cross-fade to new ways, so that no way ever changes under a sound.
#[derive(Debug, Clone)]
pub struct Sound {
    voice: Voice,
    position_m: Vec3,
    /// First frame.
    at: u64,
    /// Frame at which nothing more is said.
    over_at: Option<u64>,
    gain: Ramp,
    /// Factor of the louder ear.
    nearness: f32,
    flying: Flying,
    ways: [EarPath; 2],
    leaving: Option<[EarPath; 2]>,
    /// Share of `ways` beside `leaving`.
    arriving: Ramp,
    heard_by: (Listener, Mode),
    reflections: Option<Reflections>,
}

/// The loudest that was said and not heard yet, roughly: held as long as it is under way.
#[derive(Debug, Default, Clone, Copy)]
struct Flying {
    peak_pa: f32,
    until: u64,
}

impl Flying {
    fn follow(&mut self, now: u64, said: &[f32], delay: u64) {
        let peak_pa = said.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
        let sunk_pa = if now > self.until { self.peak_pa / 2.0 } else { self.peak_pa };
        if peak_pa >= sunk_pa || now > self.until {
            *self = Flying { peak_pa: peak_pa.max(sunk_pa), until: now + delay };
        }
    }
}

impl Sound {
    /// Begins at frame `at`, at a place that can be reckoned with.
    pub fn new(onset: &Onset, position_m: Vec3, at: u64, around: &Surroundings) -> Sound {
        let voice = Voice::begin(onset, &around.bank, around.rate_hz);
        let (ways, nearness) = ways(&voice, position_m, around);
        let reflections = reflections(&voice, position_m, around);
        Sound {
            voice,
            position_m,
            at,
            over_at: None,
            gain: Ramp::at(1.0),
            nearness,
            flying: Flying::default(),
            ways,
            leaving: None,
            arriving: Ramp::at(1.0),
            heard_by: (around.listener, around.mode),
            reflections,
        }
    }

    /// What is still to be heard of it, at the louder ear [Pa].
    pub fn loudness(&self, bank: &Bank) -> f32 {
        let coming_pa = self.voice.loudness(bank) * self.gain.target();
        let loudness = coming_pa.max(self.flying.peak_pa) * self.nearness;
        if loudness.is_nan() { 0.0 } else { loudness }
    }

    /// Distance to another sound of the same class that begins within `frames` of this one [m].
    pub fn likeness_m(&self, other: &Sound, frames: u64) -> Option<f32> {
        let of_one_class = self.voice.class() == other.voice.class();
        let alike = of_one_class && self.at.abs_diff(other.at) <= frames;
        alike.then(|| self.position_m.distance(other.position_m))
    }

    /// Grows by the power of another one; or cannot, since that is far louder.
    pub fn merge(&mut self, other: &Sound, now: u64, around: &Surroundings) -> bool {
        let ratio = other.loudness(&around.bank) / self.loudness(&around.bank);
        let factor = self.gain.target() * (1.0 + ratio * ratio).sqrt();
        // A ratio of nothing to nothing fails as well.
        let fits = factor <= MERGED_MAX;
        if fits && now <= self.at {
            self.gain = Ramp::at(factor);
        } else if fits {
            self.gain.to(factor, around.frames(MERGE_S));
        }
        fits
    }

    /// Once a block: decides what changes slowly; false when all of it has been heard.
    pub fn decide(&mut self, now: u64, line: &mut Line, around: &Surroundings) -> bool {
        let mut said = [0.0; BLOCK];
        line.copy(now.wrapping_sub(BLOCK as u64), &mut said);
        self.flying.follow(now, &said, self.ways[0].delay().max(self.ways[1].delay()));
        if self.over_at.is_none() && self.voice.is_over() {
            self.over_at = Some(now);
        }
        let heard_as_now =
            self.heard_by.1 == around.mode && self.heard_by.0.hears_as(&around.listener);
        if self.leaving.is_none() && !heard_as_now && now > self.at {
            self.turn(around);
        } else if !heard_as_now && now <= self.at {
            // Nothing was said yet.
            (self.ways, self.nearness) = ways(&self.voice, self.position_m, around);
            self.reflections = reflections(&self.voice, self.position_m, around);
            self.heard_by = (around.listener, around.mode);
        }
        self.over_at.is_none_or(|over_at| now < over_at + self.delay_max() + around.tail_frames())
    }

    /// The longest of its ways [frames].
    fn delay_max(&self) -> u64 {
        let walls = self.reflections.as_ref().map_or(0, Reflections::delay_max);
        let ways = self.ways.iter().chain(self.leaving.iter().flatten());
        ways.map(EarPath::delay).fold(walls, u64::max)
    }

    /// Begins to be heard by way of where the listener is now. What the walls send back stays as it
    /// began: it is over within some hundredths of a second, and softer than what comes straight.
    fn turn(&mut self, around: &Surroundings) {
        let (ways, nearness) = ways(&self.voice, self.position_m, around);
        self.leaving = Some(std::mem::replace(&mut self.ways, ways));
        self.nearness = nearness;
        self.heard_by = (around.listener, around.mode);
        self.arriving = Ramp::at(0.0);
        self.arriving.to(1.0, around.frames(CROSS_FADE_S));
    }

    /// The next frames, `from` on, at most a block, with its own line.
    pub fn sound(
        &mut self,
        line: &mut Line,
        from: u64,
        frames: usize,
        around: &Surroundings,
        sums: &mut Sums,
    ) {
        let wait = self.at.saturating_sub(from).min(frames as u64) as usize;
        if wait == frames {
            return;
        }
        let mut said = [0.0; BLOCK];
        let said = &mut said[wait..frames];
        self.voice.fill(&around.bank, said);
        clean(said);
        self.gain.apply(said);
        line.write(from + wait as u64, said);
        self.hear(line, from, frames, sums);
        if let Some(reflections) = &self.reflections {
            reflections.add(line, from, frames, sums);
        }
    }

    fn hear(&mut self, line: &mut Line, from: u64, frames: usize, sums: &mut Sums) {
        let mut arriving = self.arriving;
        for (ear, sum) in sums.direct.iter_mut().enumerate() {
            let mut heard = [0.0; BLOCK];
            let heard = &mut heard[..frames];
            self.ways[ear].hear(line, self.at, from, heard);
            arriving = self.arriving;
            if let Some(leaving) = &mut self.leaving {
                let mut old = [0.0; BLOCK];
                let old = &mut old[..frames];
                leaving[ear].hear(line, self.at, from, old);
                arriving.cross(old, heard);
            }
            sum.iter_mut().zip(heard).for_each(|(sum, x)| *sum += *x);
        }
        self.arriving = arriving;
        if arriving.is_at_rest() {
            self.leaving = None;
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

/// What the walls send back, if there are any.
fn reflections(voice: &Voice, position_m: Vec3, around: &Surroundings) -> Option<Reflections> {
    let room = around.room?;
    Some(Reflections::new(&room, around, position_m, |way| voice.directivity(way)))
}
