//! The line to a device that comes and goes.

use hapticbillard::sound::MixSettings;
use hapticbillard_actors::sound::{
    Backend, Callback, Counters, Line, Loss, News, NoSound, Output, Playing, Wiring,
};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A device whose streams are lost when the test says so; clones are the same one.
#[derive(Clone, Default)]
struct Loose(Arc<State>);

#[derive(Default)]
struct State {
    /// Streams are lost as soon as they are open.
    flaps: AtomicBool,
    opened: AtomicUsize,
    newest: Mutex<Option<Arc<Counters>>>,
}

impl Loose {
    fn flap(&self, flaps: bool) {
        self.0.flaps.store(flaps, Ordering::SeqCst);
    }

    fn lose(&self) {
        self.0.newest.lock().unwrap().as_ref().unwrap().lose(Loss::Gone);
    }

    /// Waits until it was opened so often.
    fn wait_until_opened(&self, times: usize) {
        let begun = Instant::now();
        while self.0.opened.load(Ordering::SeqCst) < times {
            assert!(begun.elapsed() < Duration::from_secs(20), "nobody opens it again");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    fn line(&self, retry: Duration) -> (Line, flume::Receiver<News>) {
        Line::start(Wiring {
            backend: Box::new(self.clone()),
            device: None,
            settings: MixSettings::default(),
            recordings: None,
            retry,
            allocator: None,
        })
        .unwrap()
    }
}

impl Backend for Loose {
    fn outputs(&mut self) -> Result<Vec<Output>, NoSound> {
        Ok(Vec::new())
    }

    fn open(
        &mut self,
        _: Option<&str>,
        make: &mut dyn FnMut(u32) -> Callback,
    ) -> Result<Playing, NoSound> {
        let callback = make(48_000);
        *self.0.newest.lock().unwrap() = Some(callback.counters().clone());
        if self.0.flaps.load(Ordering::SeqCst) {
            self.lose();
        }
        self.0.opened.fetch_add(1, Ordering::SeqCst);
        Ok(Playing { stream: Box::new(callback), device: "loose".into() })
    }
}

fn next(news: &flume::Receiver<News>) -> News {
    news.recv_timeout(Duration::from_secs(20)).unwrap()
}

#[tokio::test]
async fn a_device_that_comes_and_goes_is_told_of_once() {
    let device = Loose::default();
    let (line, news) = device.line(Duration::from_millis(20));
    assert!(matches!(next(&news), News::Open(_)));
    device.flap(true);
    device.lose();
    assert!(matches!(next(&news), News::Lost(_)));
    device.wait_until_opened(12);
    assert!(news.is_empty(), "{} news of a device that flaps", news.len());
    // One that lives again is heard again.
    device.flap(false);
    assert!(matches!(next(&news), News::Open(_)));
    line.end().await;
}

#[tokio::test]
async fn a_line_whose_news_nobody_takes_ends_at_once() {
    let device = Loose::default();
    let (line, news) = device.line(Duration::from_millis(1));
    for times in 1..=2 {
        device.wait_until_opened(times);
        while news.len() < 2 * times - 1 {
            std::thread::sleep(Duration::from_millis(1));
        }
        // A stream that was looked at once has lived long enough for this line.
        std::thread::sleep(Duration::from_millis(10));
        device.lose();
    }
    device.wait_until_opened(3);
    assert_eq!(news.len(), news.capacity().unwrap());
    let begun = Instant::now();
    line.end().await;
    assert!(begun.elapsed() < Duration::from_secs(1), "{:?}", begun.elapsed());
}
