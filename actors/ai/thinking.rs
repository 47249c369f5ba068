//! Thinking in the background: a search goes on while the game does.
//!
//! Each question has a thread that leads its search; the simulations are done by one pool of
//! workers, as many as there are cores, which all questions share. Nothing of that decides what is
//! answered. Whoever asked waits for the answer at its due tick; who does not want it any more
//! drops the question, and its search ends with the jobs that are under way.
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
                tracing::warn!("no thread to think on ({error}); the game waits for each decision");
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
                tracing::warn!("a search failed; it is done again");
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
                tracing::warn!(
                    "no threads to think on ({error}); the game waits for each decision"
                );
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

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::ai::{Level, MindSetup, StrokeNoise, TaskKind, ThrowTable};
    use hapticbillard::ball::POOL_RADIUS_M;
    use hapticbillard::events::Event;
    use hapticbillard::ids::GameKind;
    use hapticbillard::physics::{PhysicsSettings, Simulation};
    use hapticbillard::rack::Rack;
    use hapticbillard::rules::Referee;
    use hapticbillard::table::Table;

    /// A question before a break, and a mind for it.
    fn question() -> (Arc<Mind>, Task) {
        let table = Table::preset("pool-9ft").unwrap();
        let balls = Rack::eight_ball(7).place(&table).unwrap();
        let settings = PhysicsSettings::default();
        let simulation = Simulation::from_parts(&table, balls.clone(), &settings).unwrap();
        let lies = simulation.snapshot(0.0).balls;
        let mut referee = Referee::new(GameKind::PaperEightBall);
        let sayings = referee.begin(lies.iter().skip(1).map(|ball| ball.id));
        let called = sayings.into_iter().find_map(|saying| match saying {
            Event::Turn(turn) => Some(turn),
            _ => None,
        });
        let mind = Mind::new(MindSetup {
            simulation,
            balls: balls.into_iter().map(|(ball, _)| ball).collect(),
            bed: table.bed.unwrap(),
            table: Arc::new(table),
            ball_radius_m: POOL_RADIUS_M,
            game: GameKind::PaperEightBall,
            level: Level::Club,
            noise: StrokeNoise::OLYMPIAD,
            throw: ThrowTable::shipped(),
            simulations: 20,
        });
        let turn = called.unwrap();
        let (kind, played_from, has_asked) = (TaskKind::Shoot, None, false);
        let task = Task { kind, lies, referee, turn, played_from, has_asked, seed: 5 };
        (Arc::new(mind), task)
    }

    #[test]
    fn threads_change_no_answer_and_a_search_that_died_is_done_again() {
        let (mind, task) = question();
        let alone = mind.deliberate(&task, &Inline);
        assert!(alone.simulations > 0);
        assert_eq!(ThinkAhead.begin(&mind, task.clone()).finish(), alone);

        let search = Some(thread::spawn(|| panic!("the search is made to fail here")));
        let died = Ahead { search, cancelled: Arc::default(), mind, task };
        assert_eq!(Box::new(died).finish(), alone);
    }

    #[test]
    fn a_search_that_nobody_waits_for_ends() {
        let (mind, task) = question();
        drop(ThinkAhead.begin(&mind, task));
        // Only the thread holds the mind besides; it gives it back when it ends.
        let patience = std::time::Instant::now() + std::time::Duration::from_secs(20);
        while Arc::strong_count(&mind) > 1 {
            assert!(std::time::Instant::now() < patience, "the search goes on");
            thread::sleep(std::time::Duration::from_millis(1));
        }
    }
}
