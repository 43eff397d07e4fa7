//! Independent computations on several threads.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Numbers that a thread takes at a time. Their work is counted together, so that the answers are the same on every
/// machine.
pub(super) const BLOCK_SIZE: usize = 64;

/// `answer` for all numbers of a range, in order, in parallel blocks of `size`, or the first error in that order; `progress`
/// receives the end of the answered part.
pub(super) fn in_blocks<T: Send, E: Send>(
    all: Range<usize>,
    size: usize,
    answer: impl Fn(Range<usize>) -> Result<Vec<T>, E> + Sync,
    mut progress: impl FnMut(usize),
) -> Result<Vec<T>, E> {
    let blocks: Vec<_> = all.clone().step_by(size).map(|from| from..all.end.min(from + size)).collect(); // exact: indices
    let threads = thread::available_parallelism().map_or(1, |threads| threads.get()).min(blocks.len()); // proposes: how many
    let (next, (sender, receiver)) = (AtomicUsize::new(0), mpsc::channel());
    let mut answers: Vec<_> = blocks.iter().map(|_| None).collect();
    let work = |sender: mpsc::Sender<(usize, Result<Vec<T>, E>)>| {
        while let Some((number, block)) =
            Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|number| Some((number, blocks.get(number)?)))
        {
            let answer = answer(block.clone());
            if answer.is_err() {
                // All blocks before this one have been started.
                next.store(blocks.len(), Ordering::Relaxed);
            }
            if sender.send((number, answer)).is_err() {
                break;
            }
        }
    };
    thread::scope(|scope| {
        let work = &work;
        let started = |sender: &mpsc::Sender<_>| {
            let sender = sender.clone();
            thread::Builder::new().spawn_scoped(scope, move || work(sender)).is_ok()
        };
        // Some targets have no other thread than this one.
        if (0..threads).filter(|_| started(&sender)).count() == 0 {
            work(sender.clone());
        }
        drop(sender);
        let mut known = 0;
        for (number, answer) in receiver {
            answers[number] = Some(answer);
            while let Some(Some(Ok(_))) = answers.get(known) {
                progress(blocks[known].end);
                known += 1;
            }
        }
    });
    let answers: Result<Vec<Vec<T>>, E> = answers.into_iter().map_while(|answer| answer).collect();
    Ok(answers?.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn results_are_ordered_up_to_the_first_failure(from in 0..300usize, count in 0..1000usize, fails in 0..2000usize) {
            let all = from..from + count;
            let answer = |block: Range<usize>| block.map(|n| if n >= fails { Err(n) } else { Ok(2 * n) }).collect();
            let (mut received, mut last) = (Vec::new(), from);
            let found = in_blocks(all.clone(), BLOCK_SIZE, answer, |known| received.push(known));
            prop_assert_eq!(&found, &all.clone().map(|n| if n >= fails { Err(n) } else { Ok(2 * n) }).collect());
            for known in received {
                prop_assert!(known > last && known <= all.end && (found.is_ok() || known <= fails));
                last = known;
            }
            prop_assert!(found.is_err() || last == all.end.max(from));
        }
    }
}
