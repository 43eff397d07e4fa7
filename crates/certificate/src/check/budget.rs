//! How much work a check may take, counted and not timed, so that its answer is the same on every machine.

use std::cell::Cell;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The work that is left to a check, shared by all that work for it.
#[derive(Clone, Debug)]
pub(crate) struct Budget {
    left: Rc<Cell<u64>>,
    /// Parts that a flight may be cut into.
    pub parts: u32,
    stop: Option<&'static AtomicBool>,
}

/// Bits that are added about as fast as two numbers are taken hold of.
const PLAIN_BITS: u32 = 512;

impl Budget {
    /// So much work; none is left once `stop` is set.
    pub fn new(work: u64, parts: u32, stop: Option<&'static AtomicBool>) -> Self {
        Self { left: Rc::new(Cell::new(work)), parts, stop }
    }

    /// Allows so much more.
    pub fn add(&self, work: u64) {
        self.left.set(self.left.get().saturating_add(work)); // proposes: when to give up
    }

    /// Takes what one place of a flight costs, at so many bits and under so many harmonics.
    pub fn spend(&self, bits: u32, harmonics: usize) {
        let size = u64::from(bits / PLAIN_BITS) + 1;
        self.left.set(self.left.get().saturating_sub(size * size * harmonics as u64)); // proposes: when to give up
    }

    /// Whether no more is to be done.
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0 || self.is_stopped()
    }

    /// Whether its user has had enough.
    pub fn is_stopped(&self) -> bool {
        self.stop.is_some_and(|stop| stop.load(Ordering::Relaxed))
    }
}
