//! The talk with a service, on a thread of its own: a force, the state that answers it, a pause.

use super::line::Line;
use super::{NoHaply, SILENCE_S};
use crate::haptic::rights::{Asked, Core, obtain};
use crate::histogram::Histogram;
use hapticbillard::haptic::{DeviceSpec, DeviceState, DeviceStatus, Force, Inverse3};
use hapticbillard::units::Seconds;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// From one force to the next at least: four in a period of the servo.
const PAUSE: Duration = Duration::from_micros(250);
/// A silence that is told, and that takes the force away.
const SILENCE: Duration = Duration::from_micros((SILENCE_S * 1e6) as u64);
/// A silence that ends the talk.
const END: Duration = Duration::from_secs(2);
/// How long the service may take to answer the last word.
const FAREWELL: Duration = Duration::from_millis(50);
/// How often it is asked before the arm is taken: enough to know how long that takes.
const TRIES: u32 = 200;
/// So many answers must be known before the slow ones among them are.
const ANSWERS_MIN: u64 = 1000;
/// The share of answers that a stiffness must bear.
const SHARE: f64 = 0.99;

/// What others know of the talk.
pub struct Shared {
    address: String,
    begun: Instant,
    is_over: AtomicBool,
    /// Since the begin [µs].
    heard_us: AtomicU64,
    why: Mutex<Option<String>>,
    /// From a state to the force made of it, besides the servo's period [ns].
    delays: Histogram,
    /// What is usual of it [ns].
    usual_ns: AtomicU64,
}

impl Shared {
    pub fn new(address: &str) -> Self {
        Shared {
            address: address.into(),
            begun: Instant::now(),
            is_over: AtomicBool::new(false),
            heard_us: AtomicU64::new(0),
            why: Mutex::default(),
            delays: Histogram::default(),
            usual_ns: AtomicU64::new(0),
        }
    }

    /// Ends the talk after a last word.
    pub fn stop(&self) {
        self.is_over.store(true, Ordering::Release);
    }

    fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Acquire)
    }

    /// Why the arm is not ready, and what to do.
    pub fn why(&self) -> Option<String> {
        let why = self.why.lock().unwrap_or_else(PoisonError::into_inner).clone();
        why.or_else(|| {
            let heard = Duration::from_micros(self.heard_us.load(Ordering::Acquire));
            let silent = self.begun.elapsed().saturating_sub(heard);
            // Whoever asks has waited for as long as the servo has, or somewhat less.
            let address = &self.address;
            (silent > SILENCE * 9 / 10)
                .then(|| format!("the Haply service at {address} is silent; restart it"))
        })
    }

    /// How much later than usual forces act [s].
    pub fn late_s(&self) -> Seconds {
        if self.delays.count() < ANSWERS_MIN {
            return 0.0;
        }
        let usual_ns = self.usual_ns.load(Ordering::Acquire);
        self.delays.quantile(SHARE).saturating_sub(usual_ns) as f64 * 1e-9
    }

    fn set_why(&self, why: Option<String>) {
        *self.why.lock().unwrap_or_else(PoisonError::into_inner) = why;
    }

    fn note_heard(&self) {
        let now_us = u64::try_from(self.begun.elapsed().as_micros()).unwrap_or(u64::MAX);
        self.heard_us.store(now_us, Ordering::Release);
    }
}

/// A talk that goes on.
pub struct Talk {
    line: Line,
    arm: Inverse3,
    states: triple_buffer::Input<DeviceState>,
    forces: triple_buffer::Output<Force>,
    shared: Arc<Shared>,
    /// The last that was understood.
    state: Option<DeviceState>,
    text: String,
    said: Instant,
    heard: Instant,
    /// Answers that have not come yet.
    owed: u32,
    /// What others were told last.
    told: Option<String>,
}

impl Talk {
    /// Greets the service, and asks it as often as is needed to know how long its answers take.
    ///
    /// # Errors
    /// [`NoHaply`] if there is no arm that can be felt.
    pub fn begin(
        mut line: Line,
        states: triple_buffer::Input<DeviceState>,
        forces: triple_buffer::Output<Force>,
        shared: Arc<Shared>,
        patience: Duration,
    ) -> Result<Self, NoHaply> {
        let address = shared.address.clone();
        let silent = |reason| NoHaply::Silent { address: address.clone(), reason };
        let trouble = |trouble| NoHaply::Trouble { address: address.clone(), trouble };
        let greeting = line.hear_within(patience).map_err(silent)?;
        let waited = || format!("no word within {} ms", patience.as_millis());
        let greeting = greeting.ok_or_else(|| silent(waited()))?;
        let arm = Inverse3::greeted(&greeting).map_err(trouble)?;
        let now = Instant::now();
        let mut talk = Talk {
            line,
            arm,
            states,
            forces,
            shared,
            state: None,
            text: String::new(),
            said: now,
            heard: now,
            owed: 0,
            told: None,
        };
        talk.arm.greeting(&mut talk.text);
        talk.say().map_err(silent)?;
        talk.answer().map_err(silent)?;
        for _ in 0..TRIES {
            talk.exchange(Force::ZERO).map_err(silent)?;
            talk.pause();
        }
        if let Some(why) = talk.arm.trouble() {
            return Err(trouble(why.clone()));
        }
        if talk.state.is_none() {
            return Err(silent(talk.shared.why().unwrap_or_else(waited)));
        }
        talk.shared.usual_ns.store(talk.shared.delays.quantile(0.5), Ordering::Release);
        let (name, format) = (talk.arm.name(), talk.arm.format());
        tracing::info!("Haply at {address}: arm {name}, {format:?}, {:?}", talk.spec());
        Ok(talk)
    }

    /// What the arm is, with the usual latency of its service.
    pub fn spec(&self) -> DeviceSpec {
        let usual_ns = self.shared.usual_ns.load(Ordering::Acquire);
        DeviceSpec { latency_s: usual_ns as f64 * 1e-9, ..self.arm.spec() }
    }

    /// Talks until somebody stops it, or the line is broken.
    pub fn run(mut self) {
        // Just below the servo. A refusal shows as latency, which lowers the stiffness.
        let usual = Asked::default();
        let priority = usual.priority.map(|priority| priority.saturating_sub(1).max(1));
        obtain(&Asked { core: Core::Any, priority, lock_memory: false, ..usual });
        while !self.shared.is_over() {
            let force = *self.forces.read();
            if let Err(reason) = self.exchange(force) {
                self.lose(&reason);
                break;
            }
            self.pause();
        }
        self.farewell();
    }

    /// Says a force and hears the state that answers it.
    fn exchange(&mut self, force: Force) -> Result<(), String> {
        let before = self.said;
        self.arm.push(force, &mut self.text);
        self.say()?;
        let pause = self.said - before;
        self.answer()?;
        let delay = self.said.elapsed() + pause;
        self.shared.delays.note(u64::try_from(delay.as_nanos()).unwrap_or(u64::MAX));
        Ok(())
    }

    fn say(&mut self) -> Result<(), String> {
        self.said = Instant::now();
        self.line.say(&self.text)?;
        self.owed += 1;
        Ok(())
    }

    /// Hears until nothing is owed. When nothing comes it says once that no force is meant.
    fn answer(&mut self) -> Result<(), String> {
        let mut is_told = false;
        let begun = Instant::now();
        while self.owed > 0 && !(is_told && self.shared.is_over()) {
            if let Some(text) = self.line.hear()? {
                self.owed -= 1;
                self.take(&text);
            } else if begun.elapsed() > END {
                return Err(format!("it is silent for {} s", END.as_secs()));
            } else if begun.elapsed() > SILENCE && !is_told {
                is_told = true;
                self.say_nothing_is_meant()?;
            }
        }
        Ok(())
    }

    fn take(&mut self, text: &str) {
        let now = Instant::now();
        match self.arm.hear(text, (now - self.heard).as_secs_f64()) {
            Ok(state) => {
                self.heard = now;
                self.state = Some(state);
                self.tell(self.arm.trouble().map(ToString::to_string));
                self.shared.note_heard();
                self.states.write(state);
            }
            // The servo waits for a better one, for a while.
            Err(trouble) => self.tell(Some(trouble.to_string())),
        }
    }

    /// Others are told what is new, and not held up by what is not.
    fn tell(&mut self, why: Option<String>) {
        if self.told != why {
            self.shared.set_why(why.clone());
            self.told = why;
        }
    }

    fn say_nothing_is_meant(&mut self) -> Result<(), String> {
        let said = self.said;
        self.arm.push(Force::ZERO, &mut self.text);
        self.say()?;
        self.said = said;
        Ok(())
    }

    fn pause(&self) {
        std::thread::sleep(PAUSE.saturating_sub(self.said.elapsed()));
    }

    /// The line is broken.
    fn lose(&mut self, reason: &str) {
        let address = &self.shared.address;
        let why = format!(
            "the connection to the Haply service at {address} is lost ({reason}); start the \
             service, then the game again"
        );
        tracing::warn!("{why}");
        self.tell(Some(why));
        let state = self.state.unwrap_or_default();
        self.states.write(DeviceState { status: DeviceStatus::Lost, ..state });
    }

    /// Says that no force is meant, whatever was said last, and hangs up.
    fn farewell(&mut self) {
        // A line that is broken has no other end to hear it.
        if self.say_nothing_is_meant().is_ok() {
            let _ = self.line.hear_within(FAREWELL);
        }
        self.line.close();
    }
}
