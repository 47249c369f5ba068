//! Who simulates for a search.

use super::outcome::Outcome;

/// Does independent jobs, on as many cores as it has.
pub trait Workers: Send + Sync {
    /// Does jobs 0 to `jobs`; the results are in the order of the jobs.
    fn run(&self, jobs: usize, job: &(dyn Fn(usize) -> Outcome + Sync)) -> Vec<Outcome>;

    /// Nobody waits for the result any more: the search ends as soon as it can, with any answer.
    fn is_cancelled(&self) -> bool {
        false
    }
}

/// One job after the other, in the thread that asks.
#[derive(Debug, Clone, Copy, Default)]
pub struct Inline;

impl Workers for Inline {
    fn run(&self, jobs: usize, job: &(dyn Fn(usize) -> Outcome + Sync)) -> Vec<Outcome> {
        (0..jobs).map(job).collect()
    }
}
