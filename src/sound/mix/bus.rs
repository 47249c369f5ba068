//! Sound on its way: a ring of frames to come, to which is added ahead of time.

/// One channel of frames to come.
#[derive(Debug, Clone)]
pub struct Lane {
    ring: Box<[f32]>,
}

impl Lane {
    /// A silent lane that can be written up to `ahead` frames before its reader.
    pub fn new(ahead: usize) -> Lane {
        Lane { ring: vec![0.0; ahead.next_power_of_two()].into_boxed_slice() }
    }

    /// The two runs of the ring that `n` frames from `at` lie in.
    fn runs(&mut self, at: u64, n: usize) -> (&mut [f32], &mut [f32]) {
        let start = at as usize & (self.ring.len() - 1);
        let (low, high) = self.ring.split_at_mut(start);
        let first = n.min(high.len());
        let second = (n - first).min(low.len());
        (&mut high[..first], &mut low[..second])
    }

    /// Adds `gain` times the samples from frame `at` on.
    pub fn add(&mut self, at: u64, samples: &[f32], gain: f32) {
        let (first, second) = self.runs(at, samples.len());
        let (head, tail) = samples.split_at(first.len());
        first.iter_mut().zip(head).for_each(|(sum, x)| *sum += gain * x);
        second.iter_mut().zip(tail).for_each(|(sum, x)| *sum += gain * x);
    }

    /// Moves the frames from `at` on out of the lane; silence stays behind.
    pub fn take(&mut self, at: u64, out: &mut [f32]) {
        let (first, second) = self.runs(at, out.len());
        let (head, tail) = out.split_at_mut(first.len());
        head.copy_from_slice(first);
        tail[..second.len()].copy_from_slice(second);
        first.fill(0.0);
        second.fill(0.0);
    }
}

/// All that is on its way to the listener.
#[derive(Debug, Clone)]
pub struct Buses {
    /// Straight to the left and the right ear [Pa].
    pub direct: [Lane; 2],
    /// By way of one wall [Pa].
    pub reflected: [Lane; 2],
    /// Into the room, as at 1 m from the source [Pa].
    pub send: Lane,
}

impl Buses {
    /// Lanes for delays up to `delay_max`, and as much again of sound that is written in one go.
    pub fn new(delay_max: usize, with_room: bool) -> Buses {
        let lane = Lane::new(2 * delay_max);
        let room = Lane::new(if with_room { 2 * delay_max } else { 1 });
        Buses { direct: [lane.clone(), lane], reflected: [room.clone(), room.clone()], send: room }
    }
}
