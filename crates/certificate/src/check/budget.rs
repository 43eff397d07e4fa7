//! The work of a check, counted and not timed, so that the answer is the same on every machine.

use std::cell::Cell;
use std::rc::Rc;

use impact_pair_model::watch::Watch;

/// The work left to a check, shared by all of its parts.
#[derive(Clone)]
pub(crate) struct Budget<'w> {
    left: Rc<Cell<u64>>,
    /// Parts that a flight may be cut into.
    pub parts: u32,
    watch: &'w dyn Watch,
}

/// Bits beyond which the cost of a sine grows about as the square of the bits.
const LINEAR_COST_BITS: u32 = 512;
/// Flight evaluations that one claim may need.
const DEFAULT_PLACES: u64 = 256;

impl<'w> Budget<'w> {
    /// A budget of `work`; none is left once the watch stops it.
    pub fn new(work: u64, parts: u32, watch: &'w dyn Watch) -> Self {
        Self { left: Rc::new(Cell::new(work)), parts, watch }
    }

    /// A budget of its own, under the same watch.
    pub fn apart(&self, work: u64) -> Self {
        Self::new(work, self.parts, self.watch)
    }

    /// Adds to the work allowed.
    pub fn add(&self, work: u64) {
        self.left.set(self.left.get().saturating_add(work)); // proposes: when to give up
    }

    /// Takes off the cost of one flight evaluation, with `bits` bits and `harmonics` harmonics.
    pub fn spend(&self, bits: u32, harmonics: usize) {
        self.left.set(self.left.get().saturating_sub(cost(bits, harmonics))); // proposes: when to give up
    }

    /// Adds the cost of one more claim with `bits` bits, after a claim has been confirmed.
    pub fn allow(&self, bits: u32, harmonics: usize) {
        self.add(DEFAULT_PLACES * cost(bits, harmonics));
    }

    /// Whether the work is used up or the caller has asked to stop.
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0 || self.is_stopped()
    }

    /// Whether the caller has asked to stop.
    pub fn is_stopped(&self) -> bool {
        !self.watch.goes_on()
    }
}

/// Cost of a flight evaluation, relative to one harmonic in at most `LINEAR_COST_BITS` bits.
fn cost(bits: u32, harmonics: usize) -> u64 {
    let size = u64::from(bits / LINEAR_COST_BITS) + 1;
    size * size * harmonics as u64 // exact: a length
}
