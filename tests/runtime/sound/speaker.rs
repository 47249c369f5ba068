//! A sound card of our own: it plays when it is told to, and can be unplugged.

use hapticbillard_actors::sound::{Backend, Callback, Loss, NoSound, Output, Playing};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

pub const RATE_HZ: u32 = 48_000;

/// The speaker; clones are the same one.
#[derive(Clone)]
pub struct Speaker(Arc<Mutex<State>>);

struct State {
    is_plugged: bool,
    callback: Option<Callback>,
    heard: Vec<[f32; 2]>,
    opened: u32,
}

impl Speaker {
    pub fn new() -> Self {
        let (callback, heard) = (None, Vec::new());
        Speaker(Arc::new(Mutex::new(State { is_plugged: true, callback, heard, opened: 0 })))
    }

    pub fn backend(&self) -> Box<dyn Backend> {
        Box::new(Driver(self.clone()))
    }

    /// Plays so many frames, if somebody has opened it.
    pub fn play(&self, frames: usize) {
        let state = &mut *self.0.lock().unwrap();
        let mut block = vec![0.0_f32; 2 * frames];
        if let Some(callback) = &mut state.callback {
            callback.fill(&mut block, 2, |sample| sample);
            state.heard.extend(block.chunks(2).map(|frame| [frame[0], frame[1]]));
        }
    }

    /// Plays in real time until this is dropped.
    pub fn run(&self) -> Running {
        let (speaker, is_over) = (self.clone(), Arc::new(AtomicBool::new(false)));
        let over = is_over.clone();
        let thread = std::thread::spawn(move || {
            let mut due = Instant::now();
            while !over.load(Ordering::SeqCst) {
                speaker.play(RATE_HZ as usize / 100);
                due += Duration::from_millis(10);
                std::thread::sleep(due.saturating_duration_since(Instant::now()));
            }
        });
        Running { is_over, thread: Some(thread) }
    }

    pub fn unplug(&self) {
        let state = &mut *self.0.lock().unwrap();
        state.is_plugged = false;
        if let Some(callback) = state.callback.take() {
            callback.counters().lose(Loss::Gone);
        }
    }

    /// The callback came too late.
    pub fn run_dry(&self) {
        let state = self.0.lock().unwrap();
        state.callback.as_ref().unwrap().counters().note_xrun();
    }

    pub fn plug(&self) {
        self.0.lock().unwrap().is_plugged = true;
    }

    /// How often it was opened.
    pub fn opened(&self) -> u32 {
        self.0.lock().unwrap().opened
    }

    /// All that it played, over all openings.
    pub fn heard(&self) -> Vec<[f32; 2]> {
        self.0.lock().unwrap().heard.clone()
    }

    /// Waits until it is open.
    pub fn wait_until_open(&self) {
        let begun = Instant::now();
        while self.0.lock().unwrap().callback.is_none() {
            assert!(begun.elapsed() < Duration::from_secs(20), "nobody opens the speaker");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

/// Plays until it is dropped.
pub struct Running {
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Drop for Running {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::SeqCst);
        self.thread.take().unwrap().join().unwrap();
    }
}

struct Driver(Speaker);

/// The stream; when it is dropped nothing plays any more.
struct Stream(Speaker);

impl Drop for Stream {
    fn drop(&mut self) {
        self.0.0.lock().unwrap().callback = None;
    }
}

impl Backend for Driver {
    fn outputs(&mut self) -> Result<Vec<Output>, NoSound> {
        let (name, description) = ("speaker".to_string(), "a speaker of our own".to_string());
        Ok(vec![Output { name, description }])
    }

    fn open(
        &mut self,
        _: Option<&str>,
        make: &mut dyn FnMut(u32) -> Callback,
    ) -> Result<Playing, NoSound> {
        let state = &mut *self.0.0.lock().unwrap();
        if !state.is_plugged {
            return Err(NoSound::NoDevice("it is unplugged".into()));
        }
        state.callback = Some(make(RATE_HZ));
        state.opened += 1;
        Ok(Playing { stream: Box::new(Stream(self.0.clone())), device: "speaker".into() })
    }
}
