//! A ball that rolls: its sound is read from a delay line whose length follows the way to each
//! ear, so that delay, pitch and level are those of a source that moves.

use super::clean::clean;
use super::head::{Arrival, Shadow, arrivals};
use super::line::{Line, Sums};
use super::path::BLOCK;
use super::ramp::Ramp;
use super::surroundings::{Surroundings, point};
use crate::ids::BallId;
use crate::sound::{Rolling, RollingVoice};
use glam::Vec3;

/// A way that changes faster than this is a jump [m/s].
const JUMP_M_S: f32 = 20.0;
/// A ball found this far from where it was awaited was put there [m].
const PUT_M: f32 = 0.3;
/// Nothing that rolls is faster [m/s].
const SPEED_MAX_M_S: f32 = 50.0;
/// Where a ball was reckoned to be becomes where it is told to be within this [s].
const FOLLOW_S: f32 = 0.015;
/// Slower than this is rest [m/s].
const REST_M_S: f32 = 1e-3;
/// A ball is forgotten after this [s].
const SILENT_S: f32 = 0.1;
/// And all of it has been heard after this [s].
const FORGOTTEN_S: f32 = 0.25;
/// Time of its fading in and out [s].
const FADE_S: f32 = 0.02;
/// Time of the cross-fade of a jump [s].
const CROSS_FADE_S: f32 = 0.010;

/// A number on its straight way through a block.
#[derive(Debug, Clone, Copy)]
struct Glide {
    from: f32,
    to: f32,
}

impl Glide {
    fn at(value: f32) -> Glide {
        Glide { from: value, to: value }
    }

    fn on(&mut self, to: f32) {
        *self = Glide { from: self.to, to };
    }

    fn value(&self, share: f32) -> f32 {
        self.from + (self.to - self.from) * share
    }
}

/// One ear's place on the delay line.
#[derive(Debug, Clone, Copy)]
struct Tap {
    /// [frames].
    delay: Glide,
    gain: Glide,
    shadow: Shadow,
}

impl Tap {
    fn new(arrival: &Arrival, around: &Surroundings) -> Tap {
        let shadow = Shadow::new(arrival.alpha, around.rate_hz);
        Tap { delay: Glide::at(delay(arrival, around)), gain: Glide::at(arrival.gain), shadow }
    }

    fn on(&mut self, arrival: &Arrival, around: &Surroundings) {
        self.delay.on(delay(arrival, around));
        self.gain.on(arrival.gain);
        self.shadow.turn(arrival.alpha, around.rate_hz);
    }

    /// Stands still where it is.
    fn stay(&mut self) {
        self.delay = Glide::at(self.delay.to);
        self.gain = Glide::at(self.gain.to);
    }

    fn hear(&mut self, line: &Line, from: u64, out: &mut [f32]) {
        let first = from as usize % BLOCK;
        for (i, y) in out.iter_mut().enumerate() {
            let share = (first + i) as f32 / BLOCK as f32;
            *y = self.gain.value(share) * line.read(from + i as u64, self.delay.value(share));
        }
        self.shadow.apply(out);
    }
}

/// Of the way to an ear [frames], 2 at least: the cubic looks ahead.
fn delay(arrival: &Arrival, around: &Surroundings) -> f32 {
    around.delay(arrival.path_m).max(2.0)
}

/// A place and a velocity.
#[derive(Debug, Default, Clone, Copy)]
struct Motion {
    position_m: Vec3,
    velocity_m_s: Vec3,
}

impl Motion {
    /// As told, if that can be reckoned with.
    fn of(rolling: &Rolling) -> Option<Motion> {
        let velocity_m_s = point(rolling.velocity_m_s)?.clamp_length_max(SPEED_MAX_M_S);
        Some(Motion { position_m: point(rolling.position_m)?, velocity_m_s })
    }

    fn after(self, span_s: f32) -> Motion {
        Motion { position_m: self.position_m + self.velocity_m_s * span_s, ..self }
    }
}

/// Whether there is anything to hear of a ball: it moves, or slips where it is.
pub fn is_heard(rolling: &Rolling) -> bool {
    let speed_m_s = rolling.velocity_m_s.length().max(rolling.slip_m_s);
    speed_m_s.is_finite() && speed_m_s > REST_M_S
}

/// A ball that rolls, or room for one.
#[derive(Debug, Clone)]
pub struct Mover {
    line: Line,
    /// `None`: free.
    ball: Option<BallId>,
    voice: RollingVoice,
    level: Ramp,
    /// How it is reckoned to move, and up to which frame.
    motion: Motion,
    reckoned_at: u64,
    /// How it was told to move, carried on; and when it was told.
    told: Motion,
    told_at: u64,
    taps: [Tap; 2],
    leaving: Option<[Tap; 2]>,
    arriving: Ramp,
}

impl Mover {
    /// Room for a ball.
    pub fn free(around: &Surroundings) -> Mover {
        let far = Arrival { path_m: 1.0, gain: 0.0, alpha: 1.0 };
        let taps = [Tap::new(&far, around); 2];
        Mover {
            line: around.line(),
            ball: None,
            voice: RollingVoice::new(0.0, 0, around.rate_hz),
            level: Ramp::at(0.0),
            motion: Motion::default(),
            reckoned_at: 0,
            told: Motion::default(),
            told_at: 0,
            taps,
            leaving: None,
            arriving: Ramp::at(1.0),
        }
    }

    /// Whose it is.
    pub fn ball(&self) -> Option<BallId> {
        self.ball
    }

    /// A free one begins with a ball that moves.
    pub fn begin(&mut self, rolling: &Rolling, now: u64, around: &Surroundings) {
        let Some(motion) = Motion::of(rolling) else { return };
        self.ball = Some(rolling.ball);
        let seed = u32::from(rolling.ball.0);
        self.voice = RollingVoice::new(rolling.radius_m, seed, around.rate_hz);
        self.voice.tell(rolling);
        self.line.clear();
        self.level = Ramp::at(0.0);
        self.level.to(1.0, around.frames(FADE_S));
        (self.motion, self.told) = (motion, motion);
        (self.reckoned_at, self.told_at) = (now, now);
        self.leaving = None;
        self.arriving = Ramp::at(1.0);
        let arrivals = self.arrivals(0.0, around);
        self.taps = arrivals.map(|arrival| Tap::new(&arrival, around));
    }

    /// The newest of its ball; what is no number is ignored, and rest is no news.
    pub fn tell(&mut self, rolling: &Rolling, now: u64, around: &Surroundings) {
        let Some(told) = Motion::of(rolling) else { return };
        self.voice.tell(rolling);
        self.reckon(now, around);
        self.told = told;
        self.motion.velocity_m_s = told.velocity_m_s;
        if self.motion.position_m.distance(told.position_m) > PUT_M {
            self.motion = told;
        }
        if is_heard(rolling) {
            self.told_at = now;
            if self.level.target() == 0.0 {
                self.level.to(1.0, around.frames(FADE_S));
            }
        }
    }

    /// Goes on along its way, which nears the one that was told.
    fn reckon(&mut self, now: u64, around: &Surroundings) {
        let span_s = now.saturating_sub(self.reckoned_at) as f32 / around.rate_hz;
        self.reckoned_at = now;
        self.motion = self.motion.after(span_s);
        self.told = self.told.after(span_s);
        let share = 1.0 - libm::expf(-span_s / FOLLOW_S);
        self.motion.position_m = self.motion.position_m.lerp(self.told.position_m, share);
    }

    /// What both ears get `ahead_s` from now.
    ///
    /// The way is taken from where the ball is when it is heard, not from where it was when the
    /// sound left it: the pitch is 1 ± v/c, not 1 / (1 ∓ v/c), which differ by (v/c)²; and a ball
    /// that turns back at a cushion makes no jump.
    fn arrivals(&self, ahead_s: f32, around: &Surroundings) -> [Arrival; 2] {
        let motion = self.motion.after(ahead_s);
        arrivals(&around.listener, around.mode, motion.position_m)
    }

    /// Once a block, before its first frame: goes on along its way, and frees itself when nothing
    /// was told for long.
    pub fn decide(&mut self, now: u64, around: &Surroundings) {
        if self.ball.is_none() {
            return;
        }
        let silent_s = now.saturating_sub(self.told_at) as f32 / around.rate_hz;
        if silent_s > SILENT_S {
            // Where it went nobody knows.
            self.motion.velocity_m_s = Vec3::ZERO;
            self.told = self.motion;
            if self.level.target() > 0.0 {
                self.level.to(0.0, around.frames(FADE_S));
            } else if silent_s > FORGOTTEN_S {
                self.ball = None;
                return;
            }
        }
        self.reckon(now, around);
        self.turn_taps(BLOCK as f32 / around.rate_hz, around);
    }

    fn turn_taps(&mut self, block_s: f32, around: &Surroundings) {
        let arrivals = self.arrivals(block_s, around);
        let jump = around.delay(JUMP_M_S * block_s);
        let jumps =
            |(tap, arrival): (&Tap, &Arrival)| (delay(arrival, around) - tap.delay.to).abs() > jump;
        if !self.taps.iter().zip(&arrivals).any(jumps) {
            for (tap, arrival) in self.taps.iter_mut().zip(&arrivals) {
                tap.on(arrival, around);
            }
            return;
        }
        let mut old = self.taps;
        old.iter_mut().for_each(Tap::stay);
        if self.leaving.is_some() {
            // One jump after the other.
            self.taps = old;
            return;
        }
        self.leaving = Some(old);
        self.taps = arrivals.map(|arrival| Tap::new(&arrival, around));
        self.arriving = Ramp::at(0.0);
        self.arriving.to(1.0, around.frames(CROSS_FADE_S));
    }

    /// The next frames, `from` on: at most to the end of a block. Adds to both ears, and to the
    /// room.
    pub fn sound(&mut self, from: u64, frames: usize, sums: &mut Sums) {
        if self.ball.is_none() {
            return;
        }
        let mut said = [0.0; BLOCK];
        let said = &mut said[..frames];
        self.voice.fill(said);
        clean(said);
        self.level.apply(said);
        self.line.write(from, said);
        sums.send.iter_mut().zip(said.iter()).for_each(|(sum, x)| *sum += x);
        let mut arriving = self.arriving;
        for (ear, sum) in sums.direct.iter_mut().enumerate() {
            arriving = self.arriving;
            let mut heard = [0.0; BLOCK];
            let heard = &mut heard[..frames];
            self.taps[ear].hear(&self.line, from, heard);
            if let Some(leaving) = &mut self.leaving {
                let mut old = [0.0; BLOCK];
                leaving[ear].hear(&self.line, from, &mut old[..frames]);
                arriving.cross(&old, heard);
            }
            sum.iter_mut().zip(heard).for_each(|(sum, x)| *sum += *x);
        }
        self.arriving = arriving;
        if arriving.is_at_rest() {
            self.leaving = None;
        }
    }
}
