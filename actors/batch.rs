//! Many independent shots from one start, on all cores.
//!
//! A shot is the same to the last bit whoever computes it beside which others: each runs on a
//! clone of its own, and only the table is shared.

pub use hapticbillard::physics::Setup;
use hapticbillard::physics::{PhysicsError, Shot, Simulation};
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Shots of each thread that are done before their results are handed over; it bounds the memory
/// that waiting results take.
const AHEAD: usize = 16;

/// Runs all shots, by default on all cores, and hands their results over in the order of the
/// shots; `done` is called once for each shot when it is computed, in any order and by any thread.
/// Ends early if `take` fails.
///
/// # Errors
/// What `take` says.
pub fn run<E>(
    start: &Simulation,
    shots: &[Setup],
    threads: Option<NonZeroUsize>,
    done: impl Fn() + Sync,
    mut take: impl FnMut(usize, Result<Shot, PhysicsError>) -> Result<(), E>,
) -> Result<(), E> {
    let shoot = |shot: &Setup| {
        let result = shot.run(start);
        done();
        result
    };
    // 0 lets the pool take as many threads as there are cores.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, NonZeroUsize::get));
    let Ok(pool) = pool.build() else {
        // Where no thread can be had, this one does it.
        return shots.iter().enumerate().try_for_each(|(n, shot)| take(n, shoot(shot)));
    };
    let together = AHEAD * pool.current_num_threads();
    for (round, shots) in shots.chunks(together).enumerate() {
        let results: Vec<_> = pool.install(|| shots.par_iter().map(shoot).collect());
        for (n, result) in results.into_iter().enumerate() {
            take(round * together + n, result)?;
        }
    }
    Ok(())
}
