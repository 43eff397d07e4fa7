//! A tangency near a fold, proved: Lemmas J5-J13 of `docs/proofs/tangency.md#J5`.

mod precise;

use super::begin::{InDoubles, in_doubles};
use super::beside::sides;
use super::chain::Chain;
use super::flight::Parameter;
use super::only::is_only;
use super::proof::{Proof, conclude};
use super::search::Fold;
use crate::exact::{Enclosure, Exact};
use crate::number::{Ball, Enclosing};
use crate::periodic::Precision;

/// The parameter that is looked for, and the other one: a number, or all numbers of an interval.
#[derive(Clone, Debug)]
pub(super) struct Request {
    pub over: Parameter,
    pub other: Exact,
    pub precision: Precision,
}

/// Factor from the radii of the enclosures to the bounds within which there is no other tangency: more than printing adds (Lemma P1), and
/// the change of units.
const UNIQUENESS_FACTOR: f64 = 8.0;
impl InDoubles {
    /// Proves that the zero is the only one within its bounds (Lemma J6), and the properties that follow.
    fn conclude<N: Enclosing>(&self, chain: &Chain<N>, at: &[N]) -> Option<Proof> {
        let own: Vec<Ball> = at.iter().map(Enclosing::as_ball).collect();
        let is_theirs = own.iter().zip(&self.zero.domain).all(|(x, domain)| x.is_interior_to(domain));
        let within = [0, 1, 2].map(|i| UNIQUENESS_FACTOR * at[i].spread().as_ball().mag());
        if !is_theirs || !is_only(&self.chain, &self.zero.domain, &own, within)? {
            return None;
        }
        conclude(chain, &self.inverse, at, self.least)
    }
}

/// Proves the tangency near a fold, as narrow as requested if the precision suffices; `None` where nothing is proved. Of an interval of the
/// other parameter the bounds hold the tangencies of all its members.
pub(super) fn tangency(fold: &Fold, request: &Request) -> Option<Proof> {
    let Request { over, other, precision } = request;
    if !other.is_point() {
        return super::family::tangency(fold, *over, Ball::of(other));
    }
    let found = in_doubles(fold, *over, Ball::of(other))?;
    let is_narrow = |proof: &Proof| {
        let width = |x: &Enclosure| x.wid().top().map_or(f64::NEG_INFINITY, |top| top as f64); // exact: an exponent
        let requested = -std::f64::consts::LOG2_10 * f64::from(precision.digits);
        [&proof.parameter, &proof.sigma[0], &proof.sigma[1]].into_iter().all(|x| width(x) <= requested)
    };
    let in_doubles = || found.conclude(&found.chain, &found.zero.at).filter(is_narrow);
    let proof = precise::proof(&found, request, is_narrow).or_else(in_doubles)?;
    Some(Proof { beside: sides(&found), ..proof })
}
