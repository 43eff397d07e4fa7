//! The work of a check, counted and not timed, so that its answer is the same on every machine.

use std::cell::Cell;
use std::rc::Rc;

use impact_pair_model::watch::Watch;

/// The work that is left to a check, shared by all that work for it.
#[derive(Clone)]
pub(crate) struct Budget<'w> {
    left: Rc<Cell<u64>>,
    /// Parts that a flight may be cut into.
    pub parts: u32,
    watch: &'w dyn Watch,
}

/// Beyond these a sine takes about as long as the square of its bits.
const LINEAR_COST_BITS: u32 = 512;
/// Places that a claim may need.
const DEFAULT_PLACES: u64 = 256;

impl<'w> Budget<'w> {
    /// Returns a budget of `work`; none is left once the watch stops it.
    pub fn new(work: u64, parts: u32, watch: &'w dyn Watch) -> Self {
        Self { left: Rc::new(Cell::new(work)), parts, watch }
    }

    /// Adds to the work allowed.
    pub fn add(&self, work: u64) {
        self.left.set(self.left.get().saturating_add(work)); // proposes: when to give up
    }

    /// Takes what one place of a flight costs, at N bits and under N harmonics.
    pub fn spend(&self, bits: u32, harmonics: usize) {
        self.left.set(self.left.get().saturating_sub(cost(bits, harmonics))); // proposes: when to give up
    }

    /// Allows what a claim may cost at N bits, as one has been confirmed.
    pub fn allow(&self, bits: u32, harmonics: usize) {
        self.add(DEFAULT_PLACES * cost(bits, harmonics));
    }

    /// Returns whether no more is to be done.
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0 || self.is_stopped()
    }

    /// Returns whether its user has had enough.
    pub fn is_stopped(&self) -> bool {
        !self.watch.goes_on()
    }
}

/// The cost of a place, in places of one harmonic in few bits.
fn cost(bits: u32, harmonics: usize) -> u64 {
    let size = u64::from(bits / LINEAR_COST_BITS) + 1;
    size * size * harmonics as u64 // exact: a length
}
