//! Voices become two channels, as a head at the listener's place would hear them.
//!
//! The mixer counts frames and knows no other time. What it is told acts from the next frame on;
//! where the stream is cut into calls of [`Mixer::mix`] changes no bit. Nothing but
//! [`Mixer::new`] allocates, nothing waits, and nothing that it is told, numbers that are none
//! included, makes it panic or say anything but numbers from -1 to 1.
//!
//! Parts in the order of the way of a sound: `slot` one sound and its ways to the ears, `pool` who
//! has to go when there is no room, `moving` balls that roll, `head` and `path` what the ways are,
//! `line` sound under way, `room` and `reverb` what the walls send back, `limiter` the end.

mod clean;
mod head;
mod limiter;
mod line;
mod listener;
mod moving;
mod offline;
mod path;
mod pool;
mod ramp;
mod reverb;
mod room;
mod settings;
mod slot;
mod surroundings;

pub use listener::Listener;
pub use offline::{Told, render_offline};
pub use pool::VOICES_MAX;
pub use room::Room;
pub use settings::{MixSettings, Mode};

use super::filter::TINY;
use super::level::FULL_SCALE_PA;
use super::{Bank, Onset, Rolling, RoomTone, voice};
use limiter::Limiter;
use line::Sums;
use listener::Follower;
use moving::{Mover, is_heard};
use path::BLOCK;
use pool::{Begun, Pool};
use ramp::Ramp;
use reverb::Reverb;
use slot::Sound;
use std::sync::Arc;
use surroundings::{Surroundings, point};

/// Balls that are heard to roll, at most: all of a game of snooker, and two more.
pub const ROLLING_MAX: usize = 24;
/// A sound told further ahead than this is refused: it would keep its slot for too long [s].
pub const AHEAD_MAX_S: f32 = 10.0;
/// A change of the volume takes this long [s].
const VOLUME_S: f32 = 0.020;
/// The walls swallow what is above [Hz].
const WALL_HZ: f32 = 4_000.0;

/// What a mixer has done.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct MixWork {
    /// Sounds that sound or wait for their frame.
    pub voices: usize,
    /// Balls that are heard to roll.
    pub rolling: usize,
    /// Sounds begun.
    pub begun: u64,
    /// Sounds that began late, since their frame was over.
    pub late: u64,
    /// Sounds that another one stands for, for want of a slot.
    pub merged: u64,
    /// Sounds that had to go, or did not begin, for want of a slot.
    pub stolen: u64,
    /// Sounds that could not be: no number in them, or too far ahead; balls without a slot.
    pub refused: u64,
}

/// Sounds that begin, balls that roll and a listener in; two channels out.
#[derive(Debug)]
pub struct Mixer {
    around: Surroundings,
    listener: Follower,
    frame: u64,
    pool: Pool,
    movers: Box<[Mover]>,
    reverb: Option<Reverb>,
    /// One an ear, for a sound from all round.
    room_tone: Option<[RoomTone; 2]>,
    /// State and share of the low-pass of the walls.
    wall: [f32; 2],
    wall_share: f32,
    volume: Ramp,
    limiter: Limiter,
    work: MixWork,
}

impl Mixer {
    /// A mixer in silence; everything it will ever need is allocated here. `bank` has recordings of
    /// the rate of the stream.
    pub fn new(settings: MixSettings, bank: Arc<Bank>) -> Mixer {
        let around = Surroundings::new(&settings, bank);
        let rate_hz = around.rate_hz;
        Mixer {
            listener: Follower::default(),
            frame: 0,
            pool: Pool::new(&around),
            movers: vec![Mover::free(&around); ROLLING_MAX].into_boxed_slice(),
            reverb: around.room.map(|room| Reverb::new(&room, rate_hz)),
            room_tone: settings.room_tone.then(|| [1, 2].map(|ear| RoomTone::new(ear, rate_hz))),
            wall: [0.0; 2],
            wall_share: 1.0 - libm::expf(-std::f32::consts::TAU * WALL_HZ / rate_hz),
            volume: Ramp::at(sane_volume(settings.volume).unwrap_or(1.0)),
            limiter: Limiter::new(rate_hz),
            work: MixWork::default(),
            around,
        }
    }

    /// Begins a sound that leaves its place at `at_frame`, or now if that is over; the way to the
    /// ears comes on top. One too soft to be heard takes no slot.
    ///
    /// When all slots are taken, it is merged with one of its class that begins within a
    /// millisecond of it, or the quietest of all has to go.
    pub fn start(&mut self, at_frame: u64, onset: &Onset) {
        let ahead_max = u64::from(self.around.frames(AHEAD_MAX_S));
        let position_m = point(onset.position_m).filter(|_| onset.speed_m_s.is_finite());
        let Some(position_m) = position_m.filter(|_| at_frame <= self.frame + ahead_max) else {
            self.work.refused += 1;
            return;
        };
        if !voice::is_heard(onset) {
            return;
        }
        let at = at_frame.max(self.frame);
        let sound = Sound::new(onset, position_m, at, &self.around);
        self.work.begun += 1;
        self.work.late += u64::from(at_frame < self.frame);
        match self.pool.start(sound, self.frame, &self.around) {
            Begun::Free => {}
            Begun::Merged => self.work.merged += 1,
            Begun::Stole | Begun::Dropped => self.work.stolen += 1,
        }
    }

    /// The newest state of one ball; a ball that is not told of for 100 ms fades.
    pub fn roll(&mut self, rolling: &Rolling) {
        let (now, around) = (self.frame, &self.around);
        if let Some(own) = self.movers.iter_mut().find(|m| m.ball() == Some(rolling.ball)) {
            own.tell(rolling, now, around);
        } else if is_heard(rolling) {
            match self.movers.iter_mut().find(|mover| mover.ball().is_none()) {
                Some(free) => free.begin(rolling, now, around),
                None => self.work.refused += 1,
            }
        }
    }

    /// Where it is heard from: small steps are followed within some hundredths of a second, a cut
    /// to another place is heard at once; what is no place is ignored.
    pub fn set_listener(&mut self, listener: Listener) {
        self.listener.tell(listener);
        self.around.listener = self.listener.now();
    }

    /// Headphones or loudspeakers; what sounds fades over.
    pub fn set_mode(&mut self, mode: Mode) {
        self.around.mode = mode;
    }

    /// Factor of the whole, 0 to 4; what is no number is ignored.
    pub fn set_volume(&mut self, volume: f32) {
        if let Some(volume) = sane_volume(volume) {
            self.volume.to(volume, self.around.frames(VOLUME_S));
        }
    }

    /// The next frame that is mixed.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Frames a second [Hz].
    pub fn rate_hz(&self) -> f32 {
        self.around.rate_hz
    }

    /// What was done so far.
    pub fn work(&self) -> MixWork {
        let rolling = self.movers.iter().filter(|mover| mover.ball().is_some()).count();
        MixWork { voices: self.pool.len(), rolling, ..self.work }
    }

    /// The next frames: left and right, 1 is full scale.
    pub fn mix(&mut self, out: &mut [[f32; 2]]) {
        let mut rest = out;
        while !rest.is_empty() {
            let in_block = self.frame as usize % BLOCK;
            if in_block == 0 {
                self.decide();
            }
            let (now, later) = rest.split_at_mut(rest.len().min(BLOCK - in_block));
            self.mix_within_block(now);
            self.frame += now.len() as u64;
            rest = later;
        }
    }

    /// What changes slowly, once a block.
    fn decide(&mut self) {
        self.listener.follow(BLOCK as f32 / self.around.rate_hz);
        self.around.listener = self.listener.now();
        self.pool.decide(self.frame, &self.around);
        for mover in &mut self.movers {
            mover.decide(self.frame, &self.around);
        }
    }

    fn mix_within_block(&mut self, out: &mut [[f32; 2]]) {
        let (frame, n) = (self.frame, out.len());
        let mut sums = Sums::SILENCE;
        self.pool.sound(frame, n, &self.around, &mut sums);
        for mover in &mut self.movers {
            mover.sound(frame, n, &mut sums);
        }
        let mut ears = self.with_room(&sums, n);
        if let Some(tones) = &mut self.room_tone {
            for (ear, tone) in ears.iter_mut().zip(tones) {
                ear[..n].iter_mut().for_each(|sum| *sum += tone.next());
            }
        }
        for (i, frame) in out.iter_mut().enumerate() {
            let gain = self.volume.next() / FULL_SCALE_PA;
            *frame = [ears[0][i] * gain, ears[1][i] * gain];
            self.limiter.apply(frame);
        }
    }

    /// What comes straight, and what the walls send back.
    fn with_room(&mut self, sums: &Sums, frames: usize) -> [[f32; BLOCK]; 2] {
        let mut ears = sums.direct;
        let Some(reverb) = &mut self.reverb else { return ears };
        let [left, right] = &mut ears;
        for (i, send) in sums.send[..frames].iter().enumerate() {
            let late = reverb.next(*send);
            for (ear, heard) in [&mut left[i], &mut right[i]].into_iter().enumerate() {
                let early = &mut self.wall[ear];
                *early += (sums.reflected[ear][i] - *early) * self.wall_share + TINY;
                *heard += *early + late[ear];
            }
        }
        ears
    }
}

fn sane_volume(volume: f32) -> Option<f32> {
    (!volume.is_nan()).then(|| volume.clamp(0.0, 4.0))
}
