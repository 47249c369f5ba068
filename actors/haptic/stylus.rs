//! The stylus as a player's hand: its samples become the path of the cue.
//!
//! The truth of a stroke is physics': it gets the tip of every millisecond. Servo and game have
//! clocks of their own, so a few samples wait on purpose. When the game lags, or the samples stop,
//! the cue goes on without touching balls until the stabiliser has let go: a stroke with a hole in
//! it would not be the player's. A device is gone when it says so, when its servo has ended, or
//! when nothing was heard of it for half a second.

use super::ports::StylusPorts;
use glam::DVec2;
use hapticbillard::cue::CuePath;
use hapticbillard::event_manager::Publication;
use hapticbillard::events::{Command, Event};
use hapticbillard::haptic::{Anchor, DeviceStatus, Leads, StylusSample};
use hapticbillard::input::{CameraHand, StylusWord};
use hapticbillard::tick::{Frame, FrameSource, Inflow};
use hapticbillard::units::{Seconds, TICK_S, Tick};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Samples that wait before the first is used: longer than the pacer sleeps at a time.
const WAITING: usize = 8;
/// More than these are a lag: the oldest are left out.
const WAITING_MAX: usize = WAITING + 20;
/// How long a piece of the path holds [s]; the next tick's replaces it.
const PIECE_S: Seconds = 5.0 * TICK_S;
/// A servo that says nothing for so long says nothing any more.
const SILENCE: Duration = Duration::from_millis(500);
/// Of the time between two questions so much counts: when everything stands still the servo is
/// not to blame.
const SILENCE_STEP: Duration = Duration::from_millis(20);

/// The samples of a stylus on their way to physics.
pub struct Stylus {
    ports: StylusPorts,
    last: Option<StylusSample>,
    is_flowing: bool,
    is_disarmed: bool,
    left_out: u64,
    /// When it was asked last, and how long it has said nothing.
    asked: Instant,
    silent: Duration,
}

impl Stylus {
    /// A stylus that has not moved.
    pub fn new(ports: StylusPorts) -> Self {
        Stylus {
            ports,
            last: None,
            is_flowing: false,
            is_disarmed: false,
            left_out: 0,
            asked: Instant::now(),
            silent: Duration::ZERO,
        }
    }

    /// How many samples were left out because the game lagged.
    pub fn left_out(&self) -> u64 {
        self.left_out
    }

    /// The mouse turns the workspace to the left and raises it [rad].
    pub fn turn(&self, by: DVec2) {
        if by != DVec2::ZERO {
            self.ports.signs.turn(by);
        }
    }

    /// What it is for from now on.
    pub fn lead(&self, leads: Leads) {
        self.ports.signs.lead(leads);
    }

    /// What enters in `tick` where nobody but the stylus plays.
    pub fn frame(&mut self, tick: Tick) -> Frame {
        frame_of(self.word(tick).as_ref())
    }

    /// What the stylus says in `tick`, if it says something.
    pub fn word(&mut self, tick: Tick) -> Option<StylusWord> {
        let sample = self.next();
        let is_gone = self.is_gone(sample.is_some());
        let Some(sample) = sample else { return is_gone.then_some(StylusWord::Lost) };
        self.ports.signs.see(sample.tick);
        if sample.device.status == DeviceStatus::Lost {
            (self.last, self.is_disarmed) = (None, true);
            return Some(StylusWord::Lost);
        }
        // Where nothing is reached the tip is nowhere: there is no way to or from there.
        if !sample.direction.is_normalized() {
            self.last = None;
            return None;
        }
        self.is_disarmed &= sample.stabilised;
        if let Some(Anchor::Camera(from)) = sample.anchor {
            self.last = None;
            let (direction, camera) = (sample.direction, CameraHand::of(&sample.device, from));
            let camera = Some(camera);
            return Some(StylusWord::Held { direction, armed: false, path: None, camera });
        }
        let path = self.last.replace(sample).map(|before| {
            let solid = sample.stabilised && before.stabilised && !self.is_disarmed;
            let piece = sample.piece(&before, tick.start_s(), PIECE_S);
            Arc::new(CuePath { solid, pieces: std::iter::once(piece).collect() })
        });
        let armed = sample.stabilised && !self.is_disarmed;
        Some(StylusWord::Held { direction: sample.direction, armed, path, camera: None })
    }

    /// What it says while time stands still: whatever the hand does then is no stroke.
    pub fn rest(&mut self) -> Option<StylusWord> {
        (self.last, self.is_flowing, self.is_disarmed) = (None, false, true);
        let mut newest = None;
        while let Ok(sample) = self.ports.samples.pop() {
            newest = Some(sample);
        }
        let is_gone = self.is_gone(newest.is_some());
        let Some(sample) = newest else { return is_gone.then_some(StylusWord::Lost) };
        Some(match sample.device.status {
            DeviceStatus::Lost => StylusWord::Lost,
            DeviceStatus::Ready | DeviceStatus::Warm => {
                let direction = sample.direction;
                StylusWord::Held { direction, armed: false, path: None, camera: None }
            }
        })
    }

    /// Whether nobody will say anything any more, asked once per tick.
    fn is_gone(&mut self, has_spoken: bool) -> bool {
        let since = std::mem::replace(&mut self.asked, Instant::now()).elapsed();
        let silent = self.silent + since.min(SILENCE_STEP);
        self.silent = if has_spoken { Duration::ZERO } else { silent };
        let has_ended = self.ports.samples.is_abandoned() && self.ports.samples.is_empty();
        has_ended || self.silent > SILENCE
    }

    /// The sample of this tick, if the samples flow.
    fn next(&mut self) -> Option<StylusSample> {
        let waiting = self.ports.samples.slots();
        if !self.is_flowing && waiting < WAITING {
            return None;
        }
        self.is_flowing = true;
        if waiting > WAITING_MAX {
            for _ in WAITING..waiting {
                self.left_out += u64::from(self.ports.samples.pop().is_ok());
            }
            self.is_disarmed = true;
        }
        let sample = self.ports.samples.pop().ok();
        if sample.is_none() {
            self.is_flowing = false;
            self.is_disarmed = true;
        }
        sample
    }
}

/// The cue as a stylus leads it.
pub fn frame_of(word: Option<&StylusWord>) -> Frame {
    let mut frame = Frame::new();
    if let Some(StylusWord::Held { path: Some(path), .. }) = word {
        let event = Event::Command(Command::MoveCue(path.clone()));
        frame.push(Publication { event, delay_ticks: 0, label: None });
    }
    frame
}

impl FrameSource for Stylus {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        Inflow { frame: self.frame(tick), ..Inflow::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::ports::{AllPorts, Orders};
    use super::*;
    use glam::DVec3;
    use hapticbillard::haptic::EffectSet;

    /// A stylus, and its hand: it moves on by a millimetre per sample.
    fn stylus() -> (Stylus, impl FnMut(u32, bool)) {
        let orders =
            Orders { effects: EffectSet::default(), reach: None, stiffness_max_n_m: 100.0 };
        let AllPorts { mut servo, stylus, .. } = AllPorts::new(orders, Vec::new());
        let mut tick = 0;
        let push = move |n: u32, stabilised| {
            for _ in 0..n {
                tick += 1;
                let tip = DVec3::X * 0.001 * tick as f64;
                let (velocity, direction) = (DVec3::X, DVec3::X);
                let sample = StylusSample {
                    tick,
                    dt: 0.001,
                    tip,
                    velocity,
                    direction,
                    stabilised,
                    ..StylusSample::default()
                };
                servo.samples.push(sample).unwrap();
            }
        };
        (Stylus::new(stylus), push)
    }

    /// Where the path of a tick begins [m], and whether it touches balls.
    fn begin(stylus: &mut Stylus, tick: u64) -> Option<(f64, bool)> {
        match &stylus.frame(Tick(tick)).first()?.event {
            Event::Command(Command::MoveCue(path)) => Some((path.pieces[0].position.x, path.solid)),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn samples_wait_a_little_and_are_joined_without_a_gap() {
        let (mut stylus, mut push) = stylus();
        push(7, true);
        assert_eq!(begin(&mut stylus, 1), None);
        push(2, true);
        // The first is where the path begins.
        assert_eq!(begin(&mut stylus, 2), None);
        for tick in 3..500 {
            push(1, true);
            let (at, solid) = begin(&mut stylus, tick).unwrap();
            assert!((at - 0.001 * (tick - 2) as f64).abs() < 1e-9 && solid, "{tick}: {at}");
        }
        assert_eq!(stylus.left_out(), 0);
        assert_eq!(stylus.ports.signs.seen(), 498);
    }

    #[test]
    fn a_game_that_lags_and_samples_that_stop_take_the_stroke_away() {
        let (mut stylus, mut push) = stylus();
        push(20, true);
        begin(&mut stylus, 1);
        assert_eq!(begin(&mut stylus, 2).map(|(_, solid)| solid), Some(true));
        push(30, true);
        assert_eq!(begin(&mut stylus, 3).map(|(_, solid)| solid), Some(false));
        assert_eq!(stylus.left_out(), 40);
        // The next stroke counts again.
        push(1, false);
        push(9, true);
        let solid: Vec<bool> =
            (4..20).filter_map(|tick| begin(&mut stylus, tick)).map(|(_, solid)| solid).collect();
        assert_eq!(solid.len(), 16);
        assert!(!solid[6] && solid[10], "{solid:?}");
        while begin(&mut stylus, 21).is_some() {}
        push(10, true);
        assert_eq!(begin(&mut stylus, 22).map(|(_, solid)| solid), Some(false));
    }

    #[test]
    fn a_device_that_is_lost_and_a_servo_that_has_ended_are_told_in_play_and_in_rest() {
        let orders =
            Orders { effects: EffectSet::default(), reach: None, stiffness_max_n_m: 100.0 };
        let AllPorts { mut servo, stylus, .. } = AllPorts::new(orders, Vec::new());
        let mut stylus = Stylus::new(stylus);
        let mut push = |status| {
            let mut sample = StylusSample { direction: DVec3::X, ..StylusSample::default() };
            (sample.dt, sample.stabilised, sample.device.status) = (0.001, true, status);
            for _ in 0..WAITING {
                servo.samples.push(sample).unwrap();
            }
        };
        let armed = |word: Option<StylusWord>| match word {
            Some(StylusWord::Held { armed, .. }) => Some(armed),
            Some(StylusWord::Lost) | None => None,
        };
        push(DeviceStatus::Ready);
        for tick in 1..=WAITING as u64 {
            assert_eq!(armed(stylus.word(Tick(tick))), Some(true));
        }
        push(DeviceStatus::Lost);
        assert_eq!(stylus.word(Tick(9)), Some(StylusWord::Lost));
        assert_eq!(stylus.rest(), Some(StylusWord::Lost));
        // Back: what began before the pause or the loss is no stroke any more.
        push(DeviceStatus::Warm);
        assert_eq!(armed(stylus.word(Tick(10))), Some(false));
        assert_eq!(armed(stylus.rest()), Some(false));
        drop(servo);
        assert_eq!(stylus.word(Tick(11)), Some(StylusWord::Lost));
        assert_eq!(stylus.rest(), Some(StylusWord::Lost));
    }
}
