//! A bifurcation proved: its parameter and its orbit.

use super::super::orbit::{PeriodicImpact, PeriodicOrbit};
use crate::exact::Enclosure;
use crate::mapping::Word;
pub use impact_pair_model::vocabulary::Bifurcation as Kind;

/// A bifurcation, proved.
#[derive(Clone, Debug)]
pub struct Point {
    /// The kind of the bifurcation.
    pub kind: Kind,
    /// `A/d` of the harmonic that varies, of the largest where `d` does, or `e`: exactly one such point of the branch lies in here
    /// with this orbit.
    pub parameter: Enclosure,
    /// The word of its orbit, which is longer than the requested one on the branches of a cascade.
    pub word: Word,
    /// The cycles of its orbit.
    pub cycles: u32,
    /// Forcing periods after which the excitation repeats: 1 with one harmonic.
    pub period: u32,
    /// The impacts of the orbit.
    pub impacts: Vec<PeriodicImpact>,
    /// `Some(true)`: the orbit is its own mirror image; `Some(false)`: it is not; `None`: undecided.
    pub symmetric: Option<bool>,
    /// All other properties of the orbit; `None` where an impact is the graze, whose Jacobian (A.7) has no bound.
    pub orbit: Option<PeriodicOrbit>,
    /// Doublings of the requested word's branch up to this point's.
    pub doublings: u32,
    /// The bits it was proved with.
    pub bits: u32,
    /// `true` if the bounds are as narrow as requested.
    pub is_narrow: bool,
    /// Bounds of the unknowns of its equations.
    pub(super) zero: Vec<Enclosure>,
}

impl Point {
    /// Whether all claims about the point are proved; at a graze only its existence.
    pub fn is_decided(&self) -> bool {
        self.kind == Kind::Graze || self.orbit.as_ref().is_some_and(|orbit| orbit.physical.is_some())
    }
}
