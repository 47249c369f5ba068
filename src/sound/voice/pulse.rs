//! What bodies do to each other while they touch: short pulses of acceleration.

use core::f32::consts::{FRAC_PI_2, PI};

/// The most contacts of one sound.
pub(super) const PULSES_MAX: usize = 10;

/// One contact: rises as a sine, falls as a cosine.
///
/// With equal rise and fall it is the half sine of a Hertz contact. A slow fall is rubber, which
/// gives back what it took more slowly.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Pulse {
    /// When it begins [samples].
    pub(super) start: f32,
    /// From nothing to the most [samples].
    pub(super) rise: f32,
    /// From the most to nothing [samples].
    pub(super) fall: f32,
    /// The change of velocity of a ball [m/s], which the air hears.
    pub(super) sphere_m_s: f32,
    /// How strongly modes are struck: 1 gives each its level of the table.
    pub(super) modes: f32,
}

impl Pulse {
    pub(super) fn end(&self) -> f32 {
        self.start + self.rise + self.fall
    }

    /// The part of the pulse that has passed at sample `t`, from 0 to 1: its integral.
    fn passed(&self, t: f32) -> f32 {
        let t = t - self.start;
        let length = self.rise + self.fall;
        if t <= 0.0 {
            0.0
        } else if t < self.rise {
            self.rise * (1.0 - libm::cosf(FRAC_PI_2 * t / self.rise)) / length
        } else if t < length {
            (self.rise + self.fall * libm::sinf(FRAC_PI_2 * (t - self.rise) / self.fall)) / length
        } else {
            1.0
        }
    }

    /// The greatest acceleration of the ball, for a ball that gets `sphere_m_s` [m/s per sample].
    pub(super) fn peak(&self) -> f32 {
        self.sphere_m_s * PI / (2.0 * (self.rise + self.fall))
    }
}

/// The contacts of one sound, in the order of their begin.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Pulses {
    pulses: [Pulse; PULSES_MAX],
    count: u8,
    /// The first that is not over.
    first: u8,
}

/// What the contacts do within one sample.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Drive {
    /// Change of velocity of balls [m/s].
    pub(super) sphere_m_s: f32,
    /// Part of the blows on modes.
    pub(super) modes: f32,
}

impl Pulses {
    /// Adds a contact that begins after those before; what is too much for one sound is left out.
    pub(super) fn push(&mut self, pulse: Pulse) {
        let count = usize::from(self.count);
        if count < PULSES_MAX {
            self.pulses[count] = pulse;
            self.count += 1;
        }
    }

    /// Those that are not over.
    pub(super) fn coming(&self) -> &[Pulse] {
        &self.pulses[usize::from(self.first)..usize::from(self.count)]
    }

    /// What happens from sample `at` to the next. The mean over the sample, so that the whole
    /// change of velocity is right at any rate and for any fraction of a sample.
    pub(super) fn next(&mut self, at: u32) -> Option<Drive> {
        let (now, then) = (at as f32, at as f32 + 1.0);
        while self.coming().first().is_some_and(|pulse| pulse.end() <= now) {
            self.first += 1;
        }
        let begun = self.coming().iter().take_while(|pulse| pulse.start < then);
        begun.fold(None, |sum: Option<Drive>, pulse| {
            let sum = sum.unwrap_or_default();
            let part = pulse.passed(then) - pulse.passed(now);
            Some(Drive {
                sphere_m_s: sum.sphere_m_s + pulse.sphere_m_s * part,
                modes: sum.modes + pulse.modes * part,
            })
        })
    }
}
