//! Independent questions, answered by several threads: the answers do not depend on the threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex};
use std::thread;

/// Number of threads that the machine runs at a time; the system is queried once, as that reads files.
pub(crate) fn available() -> usize {
    static THREADS: LazyLock<usize> = LazyLock::new(|| thread::available_parallelism().map_or(1, usize::from)); // exact: threads decide nothing
    *THREADS
}

/// A slice in as many parts as threads, each with the index of its first element.
pub(crate) fn shares<T>(all: &[T]) -> Vec<(usize, &[T])> {
    let length = all.len().div_ceil(available()).max(1); // exact: a length
    all.chunks(length).enumerate().map(|(part, some)| (part * length, some)).collect()
}

/// Answers to the questions `0..count`, in their order. A thread that gets `None` takes no further question.
pub(crate) fn answers<U: Send>(threads: usize, count: usize, answer: &(dyn Fn(usize) -> Option<U> + Sync)) -> Vec<U> {
    let found = Mutex::new(Vec::new());
    run(threads, count, &|number| {
        let Some(own) = answer(number) else { return false };
        let mut found = found.lock().expect("no thread has panicked");
        if found.len() <= number {
            found.resize_with(number + 1, || None); // exact: an index
        }
        found[number] = Some(own);
        true
    });
    found.into_inner().expect("no thread has panicked").into_iter().flatten().collect()
}

/// Values of `function` at each element, in their order.
pub(crate) fn each<T: Sync, U: Send>(all: &[T], function: &(dyn Fn(&T) -> U + Sync)) -> Vec<U> {
    answers(available(), all.len(), &|number| Some(function(&all[number])))
}

/// Calls `work` once with each of the numbers `0..count`, until it returns false to each thread. Not generic: it is compiled once.
///
/// One thread is this one: some targets have no other.
pub(crate) fn run(threads: usize, count: usize, work: &(dyn Fn(usize) -> bool + Sync)) {
    let next = AtomicUsize::new(0);
    let thread = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= count || !work(number) {
                break;
            }
        }
    };
    if threads.min(count) <= 1 {
        return thread(); // exact: one thread a question is enough
    }
    thread::scope(|scope| (0..threads.min(count)).for_each(|_| _ = scope.spawn(thread))); // exact: one thread a question is enough
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_in_the_order_of_the_questions() {
        for threads in [1, 2, 7] {
            let squares = answers(threads, 100, &|n| Some(n * n));
            assert!(squares.into_iter().eq((0..100).map(|n| n * n)), "{threads} threads");
        }
        assert_eq!(each(&["a", "bc", ""], &|word| word.len()), [1, 2, 0]);
    }

    #[test]
    fn one_thread_stops_at_the_first_failure() {
        assert_eq!(answers(1, usize::MAX, &|n| (n < 3).then_some(n)), [0, 1, 2]);
    }

    #[test]
    fn shares_are_all_in_order() {
        let all: Vec<usize> = (0..101).collect();
        assert!(shares(&all).iter().all(|(first, some)| some[0] == *first));
        assert_eq!(shares(&all).iter().map(|(_, some)| *some).collect::<Vec<_>>().concat(), all);
        assert!(shares::<u32>(&[]).is_empty());
    }

    #[test]
    fn an_empty_list_has_no_results() {
        assert!(answers(2, 0, &|n| Some(n)).is_empty());
    }
}
