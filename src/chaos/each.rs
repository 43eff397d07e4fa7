//! A map over a slice, by all threads.

use std::sync::Mutex;
use std::thread;

/// Returns the values of a function at all elements, in their order, computed by all threads.
pub(super) fn each<T: Sync, U: Send>(all: &[T], function: &(dyn Fn(&T) -> U + Sync)) -> Vec<U> {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let (queue, done) = (Mutex::new(all.iter().enumerate()), Mutex::new(Vec::new()));
    let work = || {
        loop {
            let next = queue.lock().expect("no thread has panicked").next();
            let Some((number, one)) = next else { break };
            let made = function(one);
            done.lock().expect("no thread has panicked").push((number, made));
        }
    };
    thread::scope(|scope| (0..threads).for_each(|_| _ = scope.spawn(work)));
    let mut done = done.into_inner().expect("no thread has panicked");
    done.sort_by_key(|(number, _)| *number);
    done.into_iter().map(|(_, made)| made).collect()
}
