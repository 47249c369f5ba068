//! Independent jobs on all cores, their results in order.

use hapticbillard_actors::error::Error;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

/// Runs `run` for 0 to `jobs` on all cores and hands the results over in order, each as soon as
/// those before it are done, until there is none left or `take` has enough.
pub fn in_order<T: Send>(
    jobs: u32,
    run: impl Fn(u32) -> T + Sync,
    mut take: impl FnMut(u32, T) -> Result<ControlFlow<()>, Error>,
) -> Result<(), Error> {
    let workers = std::thread::available_parallelism().map_or(1, |n| n.get()).min(jobs as usize);
    let next = AtomicU32::new(0);
    // No worker runs far ahead of the one that is waited for.
    let (sender, receiver) = flume::bounded(2 * workers.max(1));
    std::thread::scope(|scope| {
        for _ in 0..workers {
            let (sender, next, run) = (sender.clone(), &next, &run);
            scope.spawn(move || {
                loop {
                    let job = next.fetch_add(1, Ordering::Relaxed);
                    // Whoever took the results has given up when nobody listens.
                    if jobs <= job || sender.send((job, run(job))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        // It ends with this closure, so that whoever still sends learns that nobody listens.
        let receiver = receiver;
        let mut waiting = BTreeMap::new();
        let mut expected = 0;
        while let Ok((job, result)) = receiver.recv() {
            waiting.insert(job, result);
            while let Some(result) = waiting.remove(&expected) {
                if take(expected, result)?.is_break() {
                    return Ok(());
                }
                expected += 1;
            }
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_whoever_is_first() {
        let mut seen = Vec::new();
        let slow = |job: u32| (0..(50 - job) * 2000).fold(job, |a, b| a.wrapping_mul(31) ^ b);
        in_order(
            50,
            |job| (slow(job), job).1,
            |job, result| {
                assert_eq!(job, result);
                seen.push(job);
                Ok(ControlFlow::Continue(()))
            },
        )
        .unwrap();
        assert_eq!(seen, (0..50).collect::<Vec<_>>());
    }

    #[test]
    fn nothing_is_handed_over_after_enough() {
        let mut seen = Vec::new();
        in_order(
            1000,
            |job| job,
            |job, _| {
                seen.push(job);
                Ok(if job == 7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
            },
        )
        .unwrap();
        assert_eq!(seen, (0..8).collect::<Vec<_>>());
    }
}
