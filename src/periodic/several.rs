//! Chains with several harmonics, equation (1): Lemmas H10-H12 of `docs/proofs/periodic.md#H10`.

mod precise;

use super::chain::{Chain, MOST_CYCLES};
use super::chained::{Chained, Moment, Rate};
use super::legs::Legs;
use super::physical::{Claim, all_first, split};
use super::shaking::Repetition;
use crate::Error;
use crate::flight::Launch;
use crate::number::{Ball, Enclosing};
use crate::pair::ImpactPair;
use crate::several::{Doubt, FlightNumber, Partial, PhaseNumber, Spectrum};
use crate::shaken::{SeveralHarmonics, Sum};

/// Common period of the harmonics of a pair, and whether all harmonics are odd.
///
/// # Errors
/// If their frequencies are not proved to be commensurate, or the common period is longer than [`MOST_CYCLES`].
pub(super) fn repetition(pair: &ImpactPair, spectrum: &Spectrum) -> Result<Repetition, Error> {
    let repetition = || {
        let turns = u32::try_from(spectrum.period?).ok().filter(|turns| *turns <= MOST_CYCLES)?;
        Some(Repetition { turns, is_odd: spectrum.is_odd() })
    };
    repetition().ok_or_else(|| {
        let terms = pair.excitation().terms().iter();
        let frequencies: Vec<String> = terms.map(|term| term.frequency().text().to_string()).collect();
        incommensurate(&frequencies)
    })
}

/// Whether the first contact of a flight is its end; `None` if undecided. Lemma H12
fn is_first<N: FlightNumber + Enclosing>(
    several: &SeveralHarmonics,
    sum: &Sum<N>,
    claim: &Claim<N>,
    after: N,
) -> Option<bool> {
    if !claim.arrives()? {
        return Some(false);
    }
    // H11: whole, polished phases are below 2^40
    let launch = Launch::from_wall(claim.from, claim.turns as i64, claim.start.clone(), after, false);
    match several.first(&sum.harmonics, launch) {
        Ok(found) => {
            let phase = claim.start.clone() + found.at.rest.with_radius(found.reach);
            claim.is_at(sum, found.wall, (found.at.turns as f64, phase)) // N1: below 2^52
        }
        // It stays on its wall.
        Err(Doubt::Rest) => Some(false),
        Err(_) => None,
    }
}

impl Chained for SeveralHarmonics {
    fn rates(&self) -> Vec<Rate> {
        let own = |term: &Partial<Ball>| [term.ratio, Ball::phase_at(&term.counter, 0)];
        let terms = self.balls.harmonics.terms.iter().enumerate();
        // H11: the first one is the fastest, whose forcing periods are counted from its own phase 0
        terms.map(|(k, term)| Rate { beta: term.beta, own: (k > 0).then(|| own(term)) }).collect()
    }

    fn is_physical(&self, chain: &Chain, phases: &[Ball], legs: &Legs<Ball, Moment<Self, Ball>>) -> Option<bool> {
        all_first(chain, split(phases), &legs.legs, |claim| {
            is_first(self, &self.balls, claim, self.pair.rebound_of(claim.before))
        })
    }
}

fn incommensurate(frequencies: &[String]) -> Error {
    let accepted = format!(
        "periodic orbits are known of frequencies whose ratios are proved to be fractions, with a common period of \
         at most {MOST_CYCLES} periods of the fastest one"
    );
    let message = format!("excitation.frequency is [{}], but {accepted}", frequencies.join(", "));
    Error::out_of_range("excitation.frequency", message)
}
