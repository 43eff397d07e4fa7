//! Proofs of tangencies in more bits than doubles have.

use super::super::begin::{InDoubles, chain_in};
use super::super::proof::Proof;
use super::Request;
use crate::exact::Exact;
use crate::number::MpBall;
use crate::periodic::krawczyk::{Limits, polish, prove};

/// Proof that is as narrow as requested, in as few bits as suffice.
pub(super) fn proof(found: &InDoubles, request: &Request, is_narrow: impl Fn(&Proof) -> bool) -> Option<Proof> {
    let Request { other, precision, .. } = request;
    let mut bits = 128 + (f64::from(precision.digits) * 3.33) as u32; // proposes
    while bits <= precision.max_bits {
        if let Some(proof) = found.precisely(other, bits).filter(&is_narrow) {
            return Some(proof);
        }
        bits *= 2;
    }
    None
}

impl InDoubles {
    /// Properties that follow from the zero in more bits.
    fn precisely(&self, other: &Exact, bits: u32) -> Option<Proof> {
        let other = MpBall::enclosing(&other.enclose(bits), bits);
        let error = (24.0 - f64::from(bits)).exp2(); // proposes
        let chain = chain_in(&self.chain, other, (&self.locals, &self.x), error);
        let guess: Vec<MpBall> = self.x.iter().map(|x| MpBall::from_f64_bits(*x, bits)).collect();
        let polished = polish(&chain, &self.inverse, guess, bits / 16);
        let limits = Limits { largest: (48.0 - f64::from(bits)).exp2(), domains: 1, images: 8, slow: 1 };
        let zero = prove(&chain, &self.inverse, &polished, limits)?;
        self.conclude(&chain, &zero.at)
    }
}
