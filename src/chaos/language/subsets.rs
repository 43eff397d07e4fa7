//! The subset construction: the sets of boxes that words lead to. Lemma D30

use std::collections::{HashMap, VecDeque};
use std::mem;
use std::rc::Rc;

use num_bigint::BigUint;
use num_traits::{One, Zero};

use crate::chaos::boxes::Links;
use crate::watch::{Stage, Watch};

/// Memory \[bytes\] that all sets together may take, and boxes that may be looked at.
const MOST_BYTES: usize = 1 << 29;
const MAX_BOX_VISITS: u64 = 1 << 34;

/// The reason why words are not counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unclosed {
    /// There are too many sets of boxes before the words are that long.
    Sets,
    /// The construction was stopped.
    Interrupted,
}

impl Unclosed {
    /// The reason in words, for messages.
    pub fn words(self) -> &'static str {
        match self {
            Self::Sets => "there are too many sets of boxes before the words are that long",
            Self::Interrupted => "interrupted",
        }
    }
}

/// A set of boxes, a bit for each.
type Set = Rc<[u64]>;

/// Sets of boxes that words lead to, each once, the set of all boxes first; for each letter the next set, `None` where the letter leads to none.
#[derive(Debug)]
pub(super) struct Subsets {
    steps: Vec<[Option<u32>; 2]>,
    is_closed: bool,
}

impl Subsets {
    /// Builds all sets, or, if they are too many, those of words of at least `letters` letters.
    pub fn of(links: &[Links; 2], boxes: usize, letters: usize, watch: &dyn Watch) -> Result<Self, Unclosed> {
        let size = boxes.div_ceil(64);
        let all = set(size, 0..boxes as u32); // exact: fewer than 2^32
        let mut numbers: HashMap<Set, u32> = HashMap::from([(Rc::clone(&all), 0)]);
        let mut open = VecDeque::from([(all, 0)]);
        let (mut steps, mut looks) = (Vec::new(), 0u64);
        while let Some((from, length)) = open.pop_front() {
            let stopped = if watch.proceed(Stage::Sets(numbers.len())).is_break() {
                Some(Unclosed::Interrupted)
            } else {
                (numbers.len() * size * mem::size_of::<u64>() > MOST_BYTES || looks > MAX_BOX_VISITS)
                    .then_some(Unclosed::Sets)
            };
            if let Some(why) = stopped {
                return if length < letters { Err(why) } else { Ok(Self { steps, is_closed: false }) };
            }
            steps.push(links.each_ref().map(|links| {
                let to = members(&from).flat_map(|cell| links.of(cell)).copied();
                let to = set(size, to.inspect(|_| looks += 1));
                if to.iter().all(|bits| *bits == 0) {
                    return None;
                }
                let next = numbers.len() as u32; // exact: fewer than 2^32
                let number = *numbers.entry(Rc::clone(&to)).or_insert(next);
                if number == next {
                    open.push_back((to, length + 1));
                }
                Some(number)
            }));
        }
        Ok(Self { steps, is_closed: true })
    }

    /// The next set by each letter, for those sets where it is known.
    pub fn steps(&self) -> &[[Option<u32>; 2]] {
        &self.steps
    }

    /// Whether no word leads to any other set.
    pub fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// Number of sets.
    pub fn len(&self) -> usize {
        let last = self.steps.iter().flatten().flatten().max();
        last.map_or(1, |last| *last as usize + 1) // exact: an index; the set of all boxes
    }

    /// Numbers of words of 1, 2, ... letters, exactly. Lemma D30
    pub fn counts(&self, letters: usize) -> Vec<BigUint> {
        let mut words = vec![BigUint::zero(); self.len()];
        words[0] = BigUint::one();
        let longer = |_| {
            let mut next = vec![BigUint::zero(); words.len()];
            for (from, count) in mem::take(&mut words).into_iter().enumerate().filter(|(_, count)| !count.is_zero()) {
                self.steps[from].iter().flatten().for_each(|&to| next[to as usize] += &count); // exact: an index
            }
            words = next;
            words.iter().sum()
        };
        (0..letters).map(longer).collect()
    }
}

fn set(size: usize, members: impl Iterator<Item = u32>) -> Set {
    let mut bits = vec![0; size];
    members.for_each(|cell| bits[cell as usize / 64] |= 1_u64 << (cell % 64)); // exact: an index
    bits.into()
}

fn members(set: &[u64]) -> impl Iterator<Item = u32> {
    set.iter().enumerate().flat_map(|(i, &bits)| {
        let rest = std::iter::successors((bits != 0).then_some(bits), |bits| {
            Some(bits & (bits - 1)).filter(|&rest| rest != 0)
        });
        rest.map(move |bits| 64 * i as u32 + bits.trailing_zeros()) // exact: fewer than 2^32
    })
}
