//! The line to the device: a thread that opens it, waits until it is lost, and opens it again.
//!
//! Opening may take long, and a driver may hang in it; so it happens here and nowhere else.
//!
//! A device that goes as soon as it comes is not worth a message each time: after a stream that
//! lived shortly, the next one plays silence until it has lived longer, and only then is it told
//! of.

use super::backend::{Backend, NoSound, Playing};
use super::callback::{Callback, Counters, Due, Loss};
use hapticbillard::sound::{Bank, MixSettings, Mixer};
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How often a stream is looked at.
const LOOK: Duration = Duration::from_millis(50);
/// How long a driver may take to close a stream when the game ends; then it is left to itself.
const CLOSING: Duration = Duration::from_secs(2);
/// News that wait at most; the thread waits for whoever takes them.
const NEWS: usize = 4;
/// A stream has proved itself when it has lived so many waits before a retry.
const PROVED: u32 = 5;

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

/// Opens the device again and again, until the end comes or nobody takes news.
fn keep_open(mut wiring: Wiring, news: &flume::Sender<News>, ended: &flume::Receiver<()>) {
    let ways = Ways { news, ended };
    let mut banks = Banks { folder: wiring.recordings.take(), read: Vec::new() };
    // Whether it is known that nothing is heard, and whether the last stream lived long.
    let (mut is_told, mut has_proved) = (false, true);
    loop {
        let reason = match open(&mut wiring, &mut banks) {
            Ok((stream, open)) => {
                let counters = open.counters.clone();
                let proof = PROVED * wiring.retry;
                let watched = ways.watch(open, if has_proved { Duration::ZERO } else { proof });
                drop(stream);
                sum_up(&counters);
                let Some(Lived { was_told, lived }) = watched else { return };
                (is_told, has_proved) = (is_told && !was_told, proof <= lived);
                counters.loss().reason().to_string()
            }
            Err(error) => error.to_string(),
        };
        // It is said once that nothing is heard, however often it is tried.
        if is_told {
            tracing::debug!("sound: {reason}");
        } else if !ways.tell(News::Lost(reason)) {
            return;
        }
        is_told = true;
        if ways.is_over(wiring.retry) {
            return;
        }
    }
}

/// To whoever started the line, and from there.
struct Ways<'a> {
    news: &'a flume::Sender<News>,
    /// Nobody ever sends: the sender's end is what is waited for.
    ended: &'a flume::Receiver<()>,
}

/// What became of a stream that was lost.
struct Lived {
    was_told: bool,
    lived: Duration,
}

impl Ways<'_> {
    /// Waits; whether the end has come.
    fn is_over(&self, wait: Duration) -> bool {
        matches!(self.ended.recv_timeout(wait), Err(flume::RecvTimeoutError::Disconnected))
    }

    /// Waits until there is room for the news or the end comes; whether they will be taken.
    fn tell(&self, mut told: News) -> bool {
        loop {
            told = match self.news.send_timeout(told, LOOK) {
                Ok(()) => return true,
                Err(flume::SendTimeoutError::Disconnected(_)) => return false,
                Err(flume::SendTimeoutError::Timeout(told)) => told,
            };
            if self.is_over(Duration::ZERO) {
                return false;
            }
        }
    }

    /// Watches a stream until it is lost, and tells of it when it is so old; none if it is wanted
    /// no longer.
    fn watch(&self, open: Open, told_at: Duration) -> Option<Lived> {
        let (begun, counters) = (Instant::now(), open.counters.clone());
        let mut untold = Some(open);
        while counters.loss() == Loss::None {
            let open = if told_at <= begun.elapsed() { untold.take() } else { None };
            let is_wanted = open.is_none_or(|open| self.tell(News::Open(open)));
            if !is_wanted || self.is_over(LOOK) {
                return None;
            }
        }
        Some(Lived { was_told: untold.is_none(), lived: begun.elapsed() })
    }
}

/// The recordings as they were read for each rate; the disk is asked once.
struct Banks {
    folder: Option<PathBuf>,
    read: Vec<(u32, Arc<Bank>)>,
}

impl Banks {
    /// Those of a stream of this rate [Hz]. If there is no such folder everything is synthesised.
    fn at(&mut self, rate_hz: u32) -> Arc<Bank> {
        if let Some((_, bank)) = self.read.iter().find(|(rate, _)| *rate == rate_hz) {
            return bank.clone();
        }
        let bank = super::bank(self.folder.as_deref(), rate_hz).unwrap_or_else(|error| {
            tracing::warn!("{}: {error}; everything is synthesised", super::SOUND);
            Bank::default()
        });
        let bank = Arc::new(bank);
        self.read.push((rate_hz, bank.clone()));
        bank
    }
}

/// What a stream has counted, for the log.
fn sum_up(counters: &Counters) {
    tracing::info!(
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

fn open(wiring: &mut Wiring, banks: &mut Banks) -> Result<(Playing, Open), NoSound> {
    let mut ends = None;
    let (settings, allocator) = (wiring.settings, wiring.allocator);
    let mut make = |rate_hz: u32| {
        let settings = MixSettings { rate_hz: rate_hz as f32, ..settings };
        let mixer = Mixer::new(settings, banks.at(rate_hz));
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
