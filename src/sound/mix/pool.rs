//! Room for so many sounds, and who has to go when there is none left.

use super::line::{Line, Sums};
use super::path::BLOCK;
use super::ramp::Ramp;
use super::slot::Sound;
use super::surroundings::Surroundings;
use crate::sound::Bank;

/// Sounds at once, at most, beside the balls that roll.
pub const VOICES_MAX: usize = 64;
/// Hits this close in time can be one sound [s].
const MERGE_S: f32 = 0.001;
/// How long a sound fades whose slot another one gets [s].
const STEAL_S: f32 = 0.003;

/// What became of a sound that was to begin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Begun {
    /// There was room.
    Free,
    /// One that began at nearly the same time stands for both.
    Merged,
    /// The quietest one had to go.
    Stole,
    /// It would have been the quietest itself.
    Dropped,
}

/// A sound, or room for one, and what it said lately.
#[derive(Debug, Clone)]
struct Slot {
    sound: Option<Sound>,
    line: Line,
}

impl Slot {
    fn begin(&mut self, sound: Sound) {
        self.line.clear();
        self.sound = Some(sound);
    }

    fn loudness(&self, bank: &Bank) -> f32 {
        self.sound.as_ref().map_or(0.0, |sound| sound.loudness(bank))
    }
}

/// The sounds that have begun. They are added up in the order of their slots.
#[derive(Debug)]
pub struct Pool {
    slots: Box<[Slot]>,
    /// What fades of those that had to go, written ahead: all channels of [`Sums`].
    fading: [Line; 5],
}

impl Pool {
    /// Room for [`VOICES_MAX`].
    pub fn new(around: &Surroundings) -> Pool {
        let slot = Slot { sound: None, line: around.line() };
        let fading = Line::new(around.frames(STEAL_S) as usize + BLOCK);
        Pool {
            slots: vec![slot; VOICES_MAX].into_boxed_slice(),
            fading: std::array::from_fn(|_| fading.clone()),
        }
    }

    /// How many sound, or wait for their frame.
    pub fn len(&self) -> usize {
        self.slots.iter().filter(|slot| slot.sound.is_some()).count()
    }

    /// Finds a place for a sound.
    pub fn start(&mut self, sound: Sound, now: u64, around: &Surroundings) -> Begun {
        if let Some(free) = self.slots.iter_mut().find(|slot| slot.sound.is_none()) {
            free.begin(sound);
            return Begun::Free;
        }
        if let Some(like) = self.most_like(&sound, around)
            && like.merge(&sound, now, around)
        {
            return Begun::Merged;
        }
        let mut quietest = (f32::INFINITY, 0);
        for (i, slot) in self.slots.iter().enumerate() {
            let loudness = slot.loudness(&around.bank);
            if loudness < quietest.0 {
                quietest = (loudness, i);
            }
        }
        if quietest.0 >= sound.loudness(&around.bank) {
            return Begun::Dropped;
        }
        self.let_go(quietest.1, now, around);
        self.slots[quietest.1].begin(sound);
        Begun::Stole
    }

    /// The nearest sound of the same class that begins within a millisecond.
    fn most_like(&mut self, sound: &Sound, around: &Surroundings) -> Option<&mut Sound> {
        let frames = u64::from(around.frames(MERGE_S));
        let sounds = self.slots.iter_mut().filter_map(|slot| slot.sound.as_mut());
        let like = sounds.filter_map(|other| {
            let distance_m = other.likeness_m(sound, frames)?;
            Some((other, distance_m))
        });
        like.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(other, _)| other)
    }

    /// Lets one fade, all of it written ahead: its slot is free at once.
    fn let_go(&mut self, index: usize, now: u64, around: &Surroundings) {
        let Slot { sound, line } = &mut self.slots[index];
        let Some(sound) = sound else { return };
        let frames = around.frames(STEAL_S);
        let mut fade = Ramp::at(1.0);
        fade.to(0.0, frames);
        let end = now + u64::from(frames);
        let mut from = now;
        while from < end {
            let frames = (end - from).min(BLOCK as u64) as usize;
            let mut sums = Sums::SILENCE;
            sound.sound(line, from, frames, around, &mut sums);
            let faded = fade;
            for (channel, ahead) in sums.channels().into_iter().zip(&mut self.fading) {
                fade = faded;
                fade.apply(&mut channel[..frames]);
                ahead.add(from, &mut channel[..frames]);
            }
            from += frames as u64;
        }
    }

    /// Once a block: decides what changes slowly, and frees what has been heard.
    pub fn decide(&mut self, now: u64, around: &Surroundings) {
        for Slot { sound, line } in &mut self.slots {
            if sound.as_mut().is_some_and(|sound| !sound.decide(now, line, around)) {
                *sound = None;
            }
        }
    }

    /// The next frames: at most a block.
    pub fn sound(&mut self, from: u64, frames: usize, around: &Surroundings, sums: &mut Sums) {
        for (channel, ahead) in sums.channels().into_iter().zip(&mut self.fading) {
            ahead.take(from, &mut channel[..frames]);
        }
        for Slot { sound, line } in &mut self.slots {
            if let Some(sound) = sound {
                sound.sound(line, from, frames, around, sums);
            }
        }
    }
}
