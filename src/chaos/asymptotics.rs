//! The scene's own orbit: whether it visits the horseshoe.

use std::ops::ControlFlow;

use super::region::Trap;
use super::words::HSet;
use crate::Error;
use crate::orbit::{Arithmetic, Orbit, Outcome, Settings, Start};
use crate::pair::ImpactPair;
use crate::periodic::Attractor;
use crate::watch::Watch;

/// The result for the orbit of the scene's own start; `None` means undecided.
///
/// **Enclosure**: for every parameter of the pair the orbit converges to the one periodic orbit, or is in the region from the
/// given impact on. Lemmas Q3, D5, D13
#[derive(Debug, Default)]
pub struct Asymptotics {
    /// The stable periodic orbit that it converges to.
    pub attractor: Option<Box<Attractor>>,
    /// A trapping region that it enters.
    pub region: Option<Entered>,
}

/// A trapping region that the orbit of the scene's own start enters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entered {
    /// Number of boxes.
    pub boxes: usize,
    /// The impact from which on all impacts are in it, 0 for the start.
    pub at_impact: u64,
    /// `true` if all h-sets, and so the horseshoe with all its images, are proved to lie in the region.
    pub holds_bases: bool,
}

/// Arithmetics, each with the number of impacts after which convergence of the orbit is tested: in doubles, then in as many bits as it takes.
const ATTEMPTS: [(Arithmetic, u64); 2] = [(Arithmetic::Interval, 20_000), (Arithmetic::Auto, 800)];

impl Asymptotics {
    /// Returns the result for an orbit; the region is looked for where there are h-sets.
    pub(super) fn of(pair: &ImpactPair, start: &Start, bases: &[HSet], watch: &dyn Watch) -> Result<Self, Error> {
        let mut attractor = None;
        for requested in ATTEMPTS {
            if attractor.is_none() {
                attractor = limit(pair, start, requested, watch)?;
            }
        }
        let region = match bases {
            [] => None,
            _ => Trap::of_pair(pair, start, 0, watch)?.ok(),
        };
        let entered = |region: Trap| {
            let holds_bases = bases.iter().all(|base| region.holds(base));
            Some(Entered { boxes: region.boxes(), at_impact: region.entered()?, holds_bases })
        };
        Ok(Self { attractor, region: region.and_then(entered) })
    }
}

/// The periodic orbit that N impacts of an orbit prove it to converge to. Lemma Q3
fn limit(
    pair: &ImpactPair,
    start: &Start,
    (arithmetic, impacts): (Arithmetic, u64),
    watch: &dyn Watch,
) -> Result<Option<Box<Attractor>>, Error> {
    let settings = Settings { impacts: Some(impacts), arithmetic, attractor: true, ..Settings::default() };
    let mut orbit = Orbit::new(pair, start, settings)?;
    let _ = orbit.follow(watch, |_, _| ControlFlow::<()>::Continue(()));
    Ok(match orbit.outcome() {
        Some(Outcome::Attracted(attractor)) => Some(attractor.clone()),
        _ => None,
    })
}
