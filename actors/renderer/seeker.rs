//! Who takes up a stylus for menus, beside them: a device that is not there lets a while pass.

use super::stylus::DeskStylus;
use super::window::TakeUp;
use crate::error::Error;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

type Found = Result<Option<DeskStylus>, Error>;

/// Somebody who looks for a stylus.
#[derive(Default)]
pub struct Seeker {
    /// Whoever looks now. A vendor's library is not asked twice at once, so the next one waits.
    looks: Option<JoinHandle<Found>>,
    /// What is to be done after that.
    next: Option<TakeUp>,
    /// What is found is wanted by nobody any more.
    is_given_up: bool,
    /// Since when the stylus that was found is lost.
    lost: Option<Instant>,
    /// One that was lost is looked for.
    is_again: bool,
}

impl Seeker {
    /// Looks, as soon as nobody looks any more, and waits for nobody; `is_again`: for one that was
    /// lost.
    pub fn seek(&mut self, take_up: TakeUp, is_again: bool) {
        (self.lost, self.is_again) = (None, is_again);
        self.next = Some(take_up);
        self.is_given_up = self.looks.is_some();
        self.begin();
    }

    /// What was found, once. One that was lost and is not back yet is no error: it is lost still.
    pub fn found(&mut self) -> Option<Found> {
        if !self.looks.as_ref().is_some_and(JoinHandle::is_finished) {
            return None;
        }
        let found = self.join();
        self.begin();
        if self.is_again && matches!(found, Some(Err(_))) {
            self.note(false);
            return None;
        }
        found
    }

    /// Nobody wants what may be found; the device is free when this returns.
    pub fn give_up(&mut self) {
        (self.next, self.lost, self.is_given_up) = (None, None, true);
        self.join();
    }

    /// The stylus is there, or lost.
    pub fn note(&mut self, is_there: bool) {
        match is_there {
            true => self.lost = None,
            false => _ = self.lost.get_or_insert_with(Instant::now),
        }
    }

    /// Whether it has been lost for so long.
    pub fn is_lost_for(&self, long: Duration) -> bool {
        self.lost.is_some_and(|since| long <= since.elapsed())
    }

    /// Waits for whoever looks. None if nobody does, or nobody wants to know.
    fn join(&mut self) -> Option<Found> {
        let found = self.looks.take()?.join();
        if std::mem::take(&mut self.is_given_up) {
            return None;
        }
        // Whoever panics has found nothing; the panic is logged where panics are.
        Some(found.unwrap_or(Ok(None)))
    }

    fn begin(&mut self) {
        if self.looks.is_some() {
            return;
        }
        let Some(take_up) = self.next.take() else { return };
        self.is_given_up = false;
        match thread::Builder::new().name("seek".into()).spawn(take_up) {
            Ok(looks) => self.looks = Some(looks),
            Err(error) => tracing::warn!("nobody looks for a stylus: {error}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(seeker: &mut Seeker) -> Found {
        loop {
            if let Some(found) = seeker.found() {
                return found;
            }
            thread::yield_now();
        }
    }

    fn refused(what: &'static str) -> TakeUp {
        Box::new(move || Err(Error::input("stylus", what, "plug it in")))
    }

    #[test]
    fn one_looks_after_the_other_and_only_the_last_is_heard() {
        let mut seeker = Seeker::default();
        let (go, gone) = flume::bounded::<()>(0);
        seeker.seek(
            Box::new(move || {
                let _ = gone.recv();
                Err(Error::input("stylus", "first", "none"))
            }),
            false,
        );
        assert!(seeker.found().is_none(), "nobody waits");
        seeker.seek(refused("second"), false);
        seeker.seek(refused("third"), false);
        drop(go);
        let error = found(&mut seeker).err().expect("it is refused").to_string();
        assert!(error.contains("third"), "{error}");
        assert!(seeker.found().is_none() && seeker.looks.is_none());
    }

    #[test]
    fn whoever_gives_up_hears_nothing_and_the_device_is_free() {
        let mut seeker = Seeker::default();
        seeker.seek(refused("unwanted"), false);
        seeker.give_up();
        assert!(seeker.looks.is_none() && seeker.found().is_none());
        seeker.seek(Box::new(|| Ok(None)), false);
        assert!(found(&mut seeker).is_ok_and(|stylus| stylus.is_none()));
    }

    #[test]
    fn a_loss_is_noted_from_its_beginning_until_the_stylus_is_back() {
        let mut seeker = Seeker::default();
        assert!(!seeker.is_lost_for(Duration::ZERO));
        seeker.note(false);
        seeker.note(false);
        assert!(seeker.is_lost_for(Duration::ZERO) && !seeker.is_lost_for(Duration::from_secs(99)));
        seeker.note(true);
        assert!(!seeker.is_lost_for(Duration::ZERO));
        // Not back yet: it is lost still, and nobody is told twice.
        seeker.seek(refused("not there"), true);
        while seeker.looks.is_some() {
            assert!(seeker.found().is_none());
            thread::yield_now();
        }
        assert!(seeker.is_lost_for(Duration::ZERO));
    }
}
