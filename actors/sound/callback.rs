//! What runs in the audio callback: the mixer, told through a ring.
//!
//! It never allocates, locks, logs, waits or panics. What it has to say it counts, for anybody to
//! look at.

use crate::cpu_time::thread_cpu_time;
use crate::histogram::Histogram;
use hapticbillard::sound::{Mixer, Told, perform};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, AtomicU32, AtomicU64, Ordering};

/// Frames that are mixed in one go; a longer block is mixed in several.
const BLOCK: usize = 1024;
/// Things told that wait for their frame at most. When it is full whoever tells drops and counts.
pub const RING: usize = 4096;

/// Something that the mixer is told, and at which frame; one that is over means at once.
pub type Due = (u64, Told);

/// Why a stream has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Loss {
    /// It has not.
    None = 0,
    /// The device was unplugged, or its server has gone.
    Gone = 1,
    /// The system wants it opened anew.
    Invalid = 2,
    /// The mixer panicked.
    Panic = 3,
}

impl Loss {
    /// In words.
    pub fn reason(self) -> &'static str {
        match self {
            Loss::None => "it plays",
            Loss::Gone => "the sound device is gone",
            Loss::Invalid => "the sound device broke off",
            Loss::Panic => "the mixer ended by a defect",
        }
    }
}

/// What a stream counts.
#[derive(Debug, Default)]
pub struct Counters {
    frames: AtomicU64,
    taken: AtomicU64,
    period: AtomicU32,
    xruns: AtomicU64,
    dropped: AtomicU64,
    allocations: AtomicU64,
    voices: AtomicU32,
    late: AtomicU64,
    loss: AtomicU8,
    /// Processor time of a callback [ns].
    pub work: Histogram,
    /// The same as a share of what it mixed [1/1000].
    pub share: Histogram,
}

impl Counters {
    /// Frames mixed so far.
    pub fn frames(&self) -> u64 {
        self.frames.load(Ordering::Acquire)
    }

    /// The next frame that no callback has begun to mix.
    pub fn next(&self) -> u64 {
        self.taken.load(Ordering::Acquire)
    }

    /// Frames mixed in the last callback.
    pub fn period(&self) -> u32 {
        self.period.load(Ordering::Relaxed)
    }

    /// How often the device ran dry.
    pub fn xruns(&self) -> u64 {
        self.xruns.load(Ordering::Relaxed)
    }

    /// It ran dry.
    pub fn note_xrun(&self) {
        self.xruns.fetch_add(1, Ordering::Relaxed);
    }

    /// What found the ring full.
    pub fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    /// Something found the ring full.
    pub fn note_dropped(&self) {
        self.dropped.fetch_add(1, Ordering::Relaxed);
    }

    /// Sounds that sound, or wait for their frame.
    pub fn voices(&self) -> u32 {
        self.voices.load(Ordering::Relaxed)
    }

    /// Sounds that began late, since their frame was over.
    pub fn late(&self) -> u64 {
        self.late.load(Ordering::Relaxed)
    }

    /// Calls of the allocator in callbacks, where somebody counts them.
    pub fn allocations(&self) -> u64 {
        self.allocations.load(Ordering::Relaxed)
    }

    /// Why the stream has ended, if it has.
    pub fn loss(&self) -> Loss {
        match self.loss.load(Ordering::Acquire) {
            0 => Loss::None,
            1 => Loss::Gone,
            2 => Loss::Invalid,
            _ => Loss::Panic,
        }
    }

    /// The stream has ended.
    pub fn lose(&self, loss: Loss) {
        self.loss.store(loss as u8, Ordering::Release);
    }
}

/// The body of an audio callback.
pub struct Callback {
    mixer: Mixer,
    rate_hz: u64,
    told: rtrb::Consumer<Due>,
    counters: Arc<Counters>,
    block: Box<[[f32; 2]]>,
    /// How often this thread has used its allocator, where a test counts that.
    allocator: Option<fn() -> u64>,
    is_broken: bool,
}

impl Callback {
    /// A callback, and the ends of whoever tells it something.
    pub fn new(
        mixer: Mixer,
        rate_hz: u32,
        allocator: Option<fn() -> u64>,
    ) -> (Self, rtrb::Producer<Due>, Arc<Counters>) {
        let (tell, told) = rtrb::RingBuffer::new(RING);
        let counters = Arc::new(Counters::default());
        let callback = Callback {
            mixer,
            rate_hz: u64::from(rate_hz.max(1)),
            told,
            counters: counters.clone(),
            block: vec![[0.0; 2]; BLOCK].into(),
            allocator,
            is_broken: false,
        };
        (callback, tell, counters)
    }

    /// What is counted.
    pub fn counters(&self) -> &Arc<Counters> {
        &self.counters
    }

    /// The next frames of a stream of so many channels, in its own format. Two channels are left
    /// and right; one is both; of more the others are silent.
    pub fn fill<T: Copy>(&mut self, out: &mut [T], channels: usize, sample: impl Fn(f32) -> T) {
        let calls = self.allocator.map(|calls| calls());
        let before = thread_cpu_time();
        let frames = out.len() / channels.max(1);
        self.counters.taken.store(self.mixer.frame() + frames as u64, Ordering::Release);
        for piece in out.chunks_mut(channels.max(1) * BLOCK) {
            let length = piece.len() / channels.max(1);
            self.mix(length);
            for (frame, [left, right]) in piece.chunks_mut(channels.max(1)).zip(&self.block) {
                match frame {
                    [both] => *both = sample(0.5 * (left + right)),
                    [a, b, others @ ..] => {
                        (*a, *b) = (sample(*left), sample(*right));
                        others.fill(sample(0.0));
                    }
                    [] => {}
                }
            }
        }
        let counters = &*self.counters;
        if let (Some(calls), Some(before)) = (self.allocator, calls) {
            counters.allocations.fetch_add(calls() - before, Ordering::Relaxed);
        }
        counters.period.store(u32::try_from(frames).unwrap_or(u32::MAX), Ordering::Relaxed);
        let spent = thread_cpu_time().saturating_sub(before).as_nanos();
        let spent_ns = u64::try_from(spent).unwrap_or(u64::MAX);
        counters.work.note(spent_ns);
        if 0 < frames {
            // Nanoseconds x frames a second / frames is a share of 10^9.
            let share = spent_ns.saturating_mul(self.rate_hz) / frames as u64 / 1_000_000;
            counters.share.note(share);
        }
        if !self.is_broken {
            let work = self.mixer.work();
            counters.voices.store(work.voices as u32, Ordering::Relaxed);
            counters.late.store(work.late, Ordering::Relaxed);
            counters.frames.store(self.mixer.frame(), Ordering::Release);
        }
    }

    /// The next frames into the block; silence from a panic on.
    fn mix(&mut self, length: usize) {
        let out = &mut self.block[..length];
        if !self.is_broken {
            let (mixer, told) = (&mut self.mixer, &mut self.told);
            let next = |end| match told.peek() {
                Ok(first) if first.0 < end => told.pop().ok(),
                _ => None,
            };
            let mixed = catch_unwind(AssertUnwindSafe(|| perform(mixer, next, out)));
            if mixed.is_err() {
                self.is_broken = true;
                self.counters.lose(Loss::Panic);
            }
        }
        if self.is_broken {
            self.block[..length].fill([0.0; 2]);
        }
    }
}
