//! Limit of the orbit from the scene's start: a stable periodic orbit, or a trapping region that may hold the horseshoe.

use std::ops::ControlFlow;

use super::region::Trap;
use super::words::HSet;
use crate::orbit::{Arithmetic, Orbit, Outcome, Settings, Start};
use crate::pair::ImpactPair;
use crate::periodic::Attractor;
use crate::watch::Watch;
use crate::{Effort, Error};

/// Proved limit of the orbit from the scene's start; fields are `None` where nothing is proved.
///
/// **Enclosure**: for every parameter of the pair the orbit converges to `attractor`, or stays in `region` from its
/// `at_impact` on. Lemmas Q3, D5, D13
#[derive(Debug, Default)]
pub struct Asymptotics {
    /// Stable periodic orbit that the scene's orbit converges to.
    pub attractor: Option<Box<Attractor>>,
    /// Trapping region that the scene's orbit enters.
    pub region: Option<Entered>,
}

/// Trapping region that the orbit from the scene's start enters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entered {
    /// Number of boxes of the region.
    pub boxes: usize,
    /// Impact from which on all impacts are in the region, 0 for the start.
    pub at_impact: u64,
    /// `true` if all h-sets, and so the horseshoe with its images, are proved to lie in the region.
    pub holds_bases: bool,
}

/// Arithmetics, each with the impacts after which convergence is tested: doubles, then as many bits as the orbit takes.
const ATTEMPTS: [(Arithmetic, u64); 2] = [(Arithmetic::Interval, 20_000), (Arithmetic::Auto, 800)];

impl Asymptotics {
    /// Proves the limit of an orbit; a region is looked for only where there are h-sets.
    pub(super) fn of(pair: &ImpactPair, start: &Start, bases: &[HSet], watch: &dyn Watch) -> Result<Self, Error> {
        let mut attractor = None;
        for requested in ATTEMPTS {
            if attractor.is_none() {
                attractor = limit(pair, start, requested, watch)?;
            }
        }
        let region = match bases {
            [] => None,
            _ => Trap::of_pair(pair, start, Effort::default(), watch)?.ok(),
        };
        let entered = |region: Trap| {
            let holds_bases = bases.iter().all(|base| region.holds(base));
            Some(Entered { boxes: region.boxes(), at_impact: region.entered()?, holds_bases })
        };
        Ok(Self { attractor, region: region.and_then(entered) })
    }
}

/// Periodic orbit to which the first `impacts` impacts prove convergence. Lemma Q3
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
