//! Room for so many sounds, and who has to go when there is none left.

use super::bus::Buses;
use super::slot::Slot;
use super::surroundings::Surroundings;
use crate::sound::Bank;

/// Sounds at once, at most, beside the balls that roll.
pub const VOICES_MAX: usize = 64;
/// Hits this close in time can be one sound [s].
const MERGE_S: f32 = 0.001;

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

/// The sounds that have begun. Sounds are added up in the order of the slots.
#[derive(Debug)]
pub struct Pool {
    slots: Box<[Option<Slot>]>,
}

impl Pool {
    /// Room for [`VOICES_MAX`].
    pub fn new() -> Pool {
        Pool { slots: vec![None; VOICES_MAX].into_boxed_slice() }
    }

    /// How many sound, or wait for their frame.
    pub fn len(&self) -> usize {
        self.slots.iter().flatten().count()
    }

    /// Finds a place for a sound.
    pub fn start(
        &mut self,
        slot: Slot,
        now: u64,
        around: &Surroundings,
        buses: &mut Buses,
    ) -> Begun {
        if let Some(free) = self.slots.iter_mut().find(|slot| slot.is_none()) {
            *free = Some(slot);
            return Begun::Free;
        }
        if let Some(like) = self.most_like(&slot, around)
            && like.merge(&slot, around)
        {
            return Begun::Merged;
        }
        let loudness = |place: &Option<Slot>| place.as_ref().map_or(0.0, Slot::loudness);
        let quietest = self.slots.iter_mut().min_by(|a, b| loudness(a).total_cmp(&loudness(b)));
        match quietest {
            Some(place) if loudness(place) < slot.loudness() => {
                if let Some(old) = place.replace(slot) {
                    old.let_go(now, around, buses);
                }
                Begun::Stole
            }
            _ => Begun::Dropped,
        }
    }

    /// The nearest sound of the same class that begins within a millisecond.
    fn most_like(&mut self, slot: &Slot, around: &Surroundings) -> Option<&mut Slot> {
        let frames = u64::from(around.frames(MERGE_S));
        let like = self.slots.iter_mut().flatten().filter_map(|other| {
            let distance_m = other.likeness_m(slot, frames)?;
            Some((other, distance_m))
        });
        like.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(other, _)| other)
    }

    /// Decides what changes slowly, and frees what has been heard.
    pub fn decide(&mut self, now: u64, around: &Surroundings) {
        for place in &mut self.slots {
            if place.as_mut().is_some_and(|slot| !slot.decide(now, around)) {
                *place = None;
            }
        }
    }

    /// The next frames: at most a block.
    pub fn sound(&mut self, from: u64, frames: usize, bank: &Bank, buses: &mut Buses) {
        for slot in self.slots.iter_mut().flatten() {
            slot.sound(from, frames, bank, buses);
        }
    }
}
