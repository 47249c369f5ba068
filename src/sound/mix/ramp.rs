//! A number that changes without a step.

/// A factor on its straight way to another one.
#[derive(Debug, Clone, Copy)]
pub struct Ramp {
    now: f32,
    target: f32,
    step: f32,
    left: u32,
}

impl Ramp {
    /// At rest.
    pub fn at(value: f32) -> Ramp {
        Ramp { now: value, target: value, step: 0.0, left: 0 }
    }

    /// On the way to `target`, there in `frames`.
    pub fn to(&mut self, target: f32, frames: u32) {
        self.left = frames.max(1);
        self.target = target;
        self.step = (target - self.now) / self.left as f32;
    }

    /// Where it goes to.
    pub fn target(&self) -> f32 {
        self.target
    }

    /// Whether it is there.
    pub fn is_at_rest(&self) -> bool {
        self.left == 0
    }

    /// One frame on.
    pub fn next(&mut self) -> f32 {
        if self.left > 0 {
            self.left -= 1;
            self.now = if self.left == 0 { self.target } else { self.now + self.step };
        }
        self.now
    }

    /// From what leaves to what arrives in its place, frame by frame: at 1 nothing is left of the
    /// old.
    pub fn cross(&mut self, leaving: &[f32], arriving: &mut [f32]) {
        for (new, old) in arriving.iter_mut().zip(leaving) {
            let share = self.next();
            *new = *old * (1.0 - share) + *new * share;
        }
    }

    /// Multiplies a run of frames.
    pub fn apply(&mut self, samples: &mut [f32]) {
        if self.left == 0 {
            if self.now != 1.0 {
                samples.iter_mut().for_each(|x| *x *= self.now);
            }
        } else {
            samples.iter_mut().for_each(|x| *x *= self.next());
        }
    }
}
