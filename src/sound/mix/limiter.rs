//! Nothing leaves the mixer above full scale.

/// Up to here nothing is changed: -3 dB of full scale.
pub const KNEE: f32 = 0.707_945_8;
/// What the loudest sound of all comes to: -0.1 dB.
const CEILING: f32 = 0.988_553_1;
/// Time constant of the way back [s].
const RELEASE_S: f32 = 0.06;

/// A limiter without delay, one for both ears so that nothing moves: the envelope jumps up with
/// the sound and sinks slowly; above the knee its gain follows a curve that never reaches the
/// ceiling.
#[derive(Debug, Clone, Copy)]
pub struct Limiter {
    envelope: f32,
    release: f32,
}

impl Limiter {
    /// At rest.
    pub fn new(rate_hz: f32) -> Limiter {
        Limiter { envelope: 0.0, release: libm::expf(-1.0 / (RELEASE_S * rate_hz)) }
    }

    /// In place; what is no number becomes silence.
    pub fn apply(&mut self, frame: &mut [f32; 2]) {
        for sample in frame.iter_mut() {
            *sample = if sample.is_nan() { 0.0 } else { sample.clamp(-1e9, 1e9) };
        }
        let peak = frame[0].abs().max(frame[1].abs());
        self.envelope = peak.max(self.envelope * self.release);
        if self.envelope > KNEE {
            let over = (self.envelope - KNEE) / (CEILING - KNEE);
            let gain = (KNEE + (CEILING - KNEE) * over / (1.0 + over)) / self.envelope;
            frame.iter_mut().for_each(|sample| *sample = (*sample * gain).clamp(-1.0, 1.0));
        } else if self.envelope < KNEE / 2.0 {
            self.envelope = 0.0;
        }
    }
}
