//! Independent pieces of work on several threads, in order of their start.
//!
//! Plain threads and not a work-stealing pool: a simulation inside such a pool waits for the
//! engine's own threads, and the pool uses the wait to begin further pieces on the same stack,
//! until it overflows.

use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use std::{
    io,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    thread,
};

/// Stack of a thread, bytes. Larger than usual: no work here is deep, and a stack that is not
/// touched costs nothing.
const STACK: usize = 16 << 20;

/// Most threads a processor. More: a number with some zeros too many drowns the machine in stacks
/// and switches. Fewer: work that waits for disks leaves processors idle.
const A_PROCESSOR: usize = 4;

/// As many threads as are processors.
pub fn processors() -> usize {
    thread::available_parallelism().map_or(1, |n| n.get())
}

/// So many of the threads that are asked for may be started: four a processor.
pub fn most(asked: usize) -> usize {
    asked.min(A_PROCESSOR * processors())
}

/// Keeps the pool that dense products use within [`most`], whatever `RAYON_NUM_THREADS` asks for;
/// the number that was asked for, where it is more. To be called before there is any work.
pub fn heed_environment() -> Option<usize> {
    let asked = std::env::var("RAYON_NUM_THREADS").ok()?.trim().parse().ok()?;
    let most = most(asked);
    if most == asked {
        return None;
    }
    // Refused where the pool is there already: then it has started what it was asked for.
    rayon::ThreadPoolBuilder::new().num_threads(most).build_global().ok()?;
    Some(asked)
}

/// How many of so many threads (0 for as many as there are processors) are left for the inside of
/// each of so many pieces of work: at least one.
pub fn inside(threads: usize, pieces: usize) -> usize {
    (wanted(threads) / pieces.max(1)).max(1)
}

fn wanted(threads: usize) -> usize {
    match threads {
        0 => processors(),
        n => most(n),
    }
}

/// The results of two independent pieces of work: side by side where that is wanted and there are
/// threads for it, one after the other otherwise.
pub fn both<A, B: Send>(
    wanted: bool,
    first: impl FnOnce() -> A,
    second: impl Fn() -> B + Sync,
) -> (A, B) {
    if !wanted || rayon::current_num_threads() < 2 {
        return (first(), second());
    }
    thread::scope(|scope| {
        let started = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, &second);
        let first = first();
        let second = match started.map(|beside| beside.join()) {
            Ok(Ok(second)) => second,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(_) => second(),
        };
        (first, second)
    })
}

/// Does the work on a thread of the pool that dense products use, too: from there small pieces of it
/// are handed out in microseconds, from elsewhere in tens of them.
pub fn in_pool(work: impl FnOnce() + Send) {
    rayon::scope(|_| work());
}

/// Does small pieces of work, each with numbers of its own, on the threads of that pool.
pub fn small<T: Send>(items: Vec<T>, work: impl Fn(T) + Sync + Send) {
    items.into_par_iter().for_each(work);
}

/// Does `work` for every item on so many threads (0 for as many as there are processors); the first
/// error ends it.
///
/// # Errors
/// The outer error says that threads cannot be started; the inner one is that of the work.
pub fn for_each<T: Sync, E: Send>(
    threads: usize,
    items: &[T],
    work: impl Fn(&T) -> Result<(), E> + Sync,
) -> io::Result<Result<(), E>> {
    let threads = wanted(threads);
    let (next, stop, failed) = (AtomicUsize::new(0), AtomicBool::new(false), Mutex::new(None));
    thread::scope(|scope| {
        for _ in 0..threads.min(items.len()) {
            let serve = || {
                while !stop.load(Ordering::Relaxed) {
                    let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
                    if let Err(e) = work(item) {
                        stop.store(true, Ordering::Relaxed);
                        failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(e);
                    }
                }
            };
            // WebAssembly has no threads.
            if cfg!(target_arch = "wasm32") {
                serve();
                break;
            }
            let started = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, serve);
            if let Err(e) = started {
                stop.store(true, Ordering::Relaxed);
                return Err(e);
            }
        }
        Ok(())
    })?;
    Ok(failed.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err))
}

/// The results of `work` for every item, in the order of the items.
///
/// # Errors
/// Threads cannot be started.
pub fn map<T: Sync, R: Send>(
    threads: usize,
    items: &[T],
    work: impl Fn(&T) -> R + Sync,
) -> io::Result<Vec<R>> {
    let sure = |item: &T| Ok::<R, std::convert::Infallible>(work(item));
    try_map(threads, items, sure).map(|done| done.unwrap_or_else(|e| match e {}))
}

/// As [`map`], for work that may fail; the first error ends it.
///
/// # Errors
/// The outer error says that threads cannot be started; the inner one is that of the work.
pub fn try_map<T: Sync, R: Send, E: Send>(
    threads: usize,
    items: &[T],
    work: impl Fn(&T) -> Result<R, E> + Sync,
) -> io::Result<Result<Vec<R>, E>> {
    let slots: Vec<(&T, Mutex<Option<R>>)> =
        items.iter().map(|item| (item, Mutex::new(None))).collect();
    let done = for_each(threads, &slots, |(item, slot)| {
        *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(work(item)?);
        Ok(())
    })?;
    let results = || {
        slots
            .into_iter()
            .filter_map(|(_, slot)| slot.into_inner().unwrap_or_else(PoisonError::into_inner))
            .collect()
    };
    Ok(done.map(|()| results()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_pieces_of_work_are_both_done() {
        for wanted in [false, true] {
            let mut first = 1;
            assert_eq!(both(wanted, || std::mem::replace(&mut first, 2), || 3), (1, 3));
            assert_eq!(first, 2);
        }
    }

    #[test]
    fn small_pieces_are_done_once_each() {
        let mut numbers = vec![0; 1000];
        let work = || {
            let parts = numbers.chunks_mut(7).enumerate().collect();
            small(parts, |(k, part)| part.iter_mut().for_each(|n| *n += k));
        };
        in_pool(work);
        assert!(numbers.iter().enumerate().all(|(i, n)| *n == i / 7));
    }

    #[test]
    fn every_item_is_done_once_in_order_and_errors_end_the_work() {
        let items: Vec<usize> = (0..1000).collect();
        for threads in [0, 1, 3, 2000] {
            assert_eq!(
                map(threads, &items, |x| x * x).unwrap(),
                items.iter().map(|x| x * x).collect::<Vec<_>>()
            );
        }
        assert_eq!(map(4, &[0; 0], |x| *x).unwrap(), [0; 0]);
        let done = AtomicUsize::new(0);
        let result = for_each(2, &items, |&x| {
            done.fetch_add(1, Ordering::Relaxed);
            if x == 10 { Err(x) } else { Ok(()) }
        });
        assert_eq!(result.unwrap(), Err(10));
        assert!(done.load(Ordering::Relaxed) < 1000);
        done.store(0, Ordering::Relaxed);
        let result = try_map(2, &items, |&x| {
            done.fetch_add(1, Ordering::Relaxed);
            if x == 10 { Err(x) } else { Ok(x) }
        });
        assert_eq!(result.unwrap(), Err(10));
        assert!(done.load(Ordering::Relaxed) < 1000);
    }
}
