//! Thinking in the background: a search goes on while the game does.
//!
//! Each question has a thread that leads its search; the simulations are done by one pool of
//! workers, as many as there are cores, which all questions share. Nothing of that decides what is
//! answered. Whoever asked waits for the answer at its due tick; who does not want it any more
//! drops the question, and its search ends with the simulations that are under way.
//!
//! No queue: a player has one question at a time.

use hapticbillard::ai::{
    Deliberation, Inline, Mind, Outcome, Task, ThinkInline, Thinker, Thinking, Workers,
};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};
use tokio::runtime::{Handle, RuntimeFlavor};

/// Thinks on threads of its own. Where the system gives none, thinks when the answer is wanted.
#[derive(Debug, Clone, Copy, Default)]
pub struct ThinkAhead;

impl Thinker for ThinkAhead {
    fn begin(&self, mind: &Arc<Mind>, task: Task) -> Box<dyn Thinking> {
        let Some(pool) = pool() else { return ThinkInline.begin(mind, task) };
        let cancelled = Arc::new(AtomicBool::new(false));
        let workers = Pool { pool, cancelled: cancelled.clone() };
        let (own_mind, own_task) = (mind.clone(), task.clone());
        let lead = move || own_mind.deliberate(&own_task, &workers);
        match thread::Builder::new().name("thinking".into()).spawn(lead) {
            Ok(search) => {
                Box::new(Ahead { search: Some(search), cancelled, mind: mind.clone(), task })
            }
            Err(error) => {
                log::warn!("no thread to think on ({error}); the game waits for each decision");
                ThinkInline.begin(mind, task)
            }
        }
    }
}

/// A search that goes on.
struct Ahead {
    /// None once it was joined.
    search: Option<JoinHandle<Deliberation>>,
    cancelled: Arc<AtomicBool>,
    mind: Arc<Mind>,
    task: Task,
}

impl Thinking for Ahead {
    fn finish(mut self: Box<Self>) -> Deliberation {
        let search = self.search.take();
        let answer = search.map(|search| let_others_go_on(|| search.join()));
        match answer {
            Some(Ok(deliberation)) => deliberation,
            _ => {
                log::warn!("a search failed; it is done again");
                let_others_go_on(|| self.mind.deliberate(&self.task, &Inline))
            }
        }
    }
}

impl Drop for Ahead {
    fn drop(&mut self) {
        // The thread sees it within a simulation, which takes less than a tick, and ends.
        self.cancelled.store(true, Ordering::Relaxed);
    }
}

/// Waits or works for long; other tasks of the runtime go on meanwhile on another thread.
fn let_others_go_on<R>(work: impl FnOnce() -> R) -> R {
    match Handle::try_current().map(|handle| handle.runtime_flavor()) {
        Ok(RuntimeFlavor::MultiThread) => tokio::task::block_in_place(work),
        _ => work(),
    }
}

/// The workers of all searches; none if the system gives no threads.
fn pool() -> Option<&'static ThreadPool> {
    static POOL: OnceLock<Option<ThreadPool>> = OnceLock::new();
    let build = || {
        let named = |i| format!("search {i}");
        match ThreadPoolBuilder::new().thread_name(named).build() {
            Ok(pool) => Some(pool),
            Err(error) => {
                log::warn!("no threads to think on ({error}); the game waits for each decision");
                None
            }
        }
    };
    POOL.get_or_init(build).as_ref()
}

/// Simulates on the shared workers, until nobody wants to know any more.
struct Pool {
    pool: &'static ThreadPool,
    cancelled: Arc<AtomicBool>,
}

impl Workers for Pool {
    fn run(&self, jobs: usize, job: &(dyn Fn(usize) -> Outcome + Sync)) -> Vec<Outcome> {
        let one = |i| if self.is_cancelled() { Outcome::default() } else { job(i) };
        self.pool.install(|| (0..jobs).into_par_iter().map(one).collect())
    }

    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}
