//! The line to the device: a thread that opens it, waits until it is lost, and opens it again.
//!
//! Opening may take long, and a driver may hang in it; so it happens here and nowhere else.

use super::backend::{Backend, NoSound, Playing};
use super::callback::{Callback, Counters, Due, Loss};
use hapticbillard::sound::{MixSettings, Mixer};
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Duration;

/// How often a stream is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// How long a driver may take to close a stream when the game ends; then it is left to itself.
const CLOSING: Duration = Duration::from_secs(2);
/// News that wait at most; the thread waits for whoever takes them.
const NEWS: usize = 4;

/// A stream that plays, and how it is told something.
pub struct Open {
    /// What it is told goes here, in the order of its frames.
    pub tell: rtrb::Producer<Due>,
    /// What it counts.
    pub counters: Arc<Counters>,
    /// Its rate [Hz].
    pub rate_hz: u32,
    /// Its device.
    pub device: String,
}

/// What became of the device.
pub enum News {
    /// It plays.
    Open(Open),
    /// It does not, or no longer.
    Lost(String),
}

/// What a line is made of.
pub struct Wiring {
    /// Where devices come from.
    pub backend: Box<dyn Backend>,
    /// Which; none: the system's own choice.
    pub device: Option<String>,
    /// How it is mixed; the rate is the device's.
    pub settings: MixSettings,
    /// A folder of recordings that stand in for the synthesis.
    pub recordings: Option<PathBuf>,
    /// How long it waits before it tries again.
    pub retry: Duration,
    /// How often a thread has used its allocator, where a test counts that.
    pub allocator: Option<fn() -> u64>,
}

/// The thread.
pub struct Line {
    thread: JoinHandle<()>,
    end: flume::Sender<()>,
}

impl Line {
    /// Starts it.
    ///
    /// # Errors
    /// [`NoSound`] if there is no thread.
    pub fn start(wiring: Wiring) -> Result<(Self, flume::Receiver<News>), NoSound> {
        let (tell, news) = flume::bounded(NEWS);
        let (end, ended) = flume::bounded(0);
        let thread = std::thread::Builder::new()
            .name("sound".into())
            .spawn(move || keep_open(wiring, &tell, &ended))
            .map_err(|error| NoSound::NoThread(error.to_string()))?;
        Ok((Line { thread, end }, news))
    }

    /// Ends it; the device is closed when this returns, unless its driver hangs.
    pub async fn end(self) {
        drop(self.end);
        let begun = tokio::time::Instant::now();
        while !self.thread.is_finished() && begun.elapsed() < CLOSING {
            tokio::time::sleep(Duration::from_millis(2)).await;
        }
    }
}

fn keep_open(mut wiring: Wiring, news: &flume::Sender<News>, ended: &flume::Receiver<()>) {
    // Nobody ever sends: the sender's end is what is waited for.
    let is_over =
        |wait| matches!(ended.recv_timeout(wait), Err(flume::RecvTimeoutError::Disconnected));
    let mut is_told = false;
    loop {
        let reason = match open(&mut wiring) {
            Ok((stream, open)) => {
                let counters = open.counters.clone();
                is_told = false;
                if news.send(News::Open(open)).is_err() {
                    return;
                }
                let mut is_wanted = true;
                while is_wanted && counters.loss() == Loss::None {
                    is_wanted = !is_over(LOOK);
                }
                drop(stream);
                sum_up(&counters);
                if !is_wanted {
                    return;
                }
                counters.loss().reason().to_string()
            }
            Err(error) => error.to_string(),
        };
        // It is said once that nothing is heard, however often it is tried.
        if is_told {
            log::debug!("sound: {reason}");
        } else if news.send(News::Lost(reason)).is_err() {
            return;
        }
        is_told = true;
        if is_over(wiring.retry) {
            return;
        }
    }
}

/// What a stream has counted, for the log.
fn sum_up(counters: &Counters) {
    log::info!(
        "sound: played {} frames; {} times the device ran dry, {} sounds were late, {} dropped; a \
         callback took {} us in the median, {} us in 99 of 100, {} us at most",
        counters.frames(),
        counters.xruns(),
        counters.late(),
        counters.dropped(),
        counters.work.quantile(0.5) / 1000,
        counters.work.quantile(0.99) / 1000,
        counters.work.most() / 1000,
    );
}

fn open(wiring: &mut Wiring) -> Result<(Playing, Open), NoSound> {
    let mut ends = None;
    let (settings, allocator) = (wiring.settings, wiring.allocator);
    let recordings = wiring.recordings.clone();
    let mut make = |rate_hz: u32| {
        let settings = MixSettings { rate_hz: rate_hz as f32, ..settings };
        let bank = super::bank(recordings.as_deref(), rate_hz);
        let mixer = Mixer::new(settings, Arc::new(bank));
        let (callback, tell, counters) = Callback::new(mixer, rate_hz, allocator);
        ends = Some((tell, counters, rate_hz));
        callback
    };
    let playing = wiring.backend.open(wiring.device.as_deref(), &mut make)?;
    let (tell, counters, rate_hz) =
        ends.ok_or_else(|| NoSound::NoDevice("it asks for nothing to play".into()))?;
    let device = playing.device.clone();
    Ok((playing, Open { tell, counters, rate_hz, device }))
}
