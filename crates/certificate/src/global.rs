//! The JSON of a global analysis, read back.

use super::Finding;
use super::attraction::{Bounds, ClaimedOrbit};
use super::cycles::is_reduced_period;
use super::marks::{self, Components, Mark};
use super::periodic::{OrbitOf, PeriodicCertificate};
use impact_pair_document::{
    BasinDocument, ComponentDocument, GLOBAL_SCHEMA, GlobalDocument, Place, ProvedHorseshoeDocument,
};
use impact_pair_exact::{Exact, Real};
use impact_pair_model::vocabulary::{Class, ComponentKind, Stability};
use impact_pair_model::{Error, ImpactPair, Wall};
use num_rational::BigRational;
use num_traits::ToPrimitive;
use serde_json::Value;
use std::cmp::Ordering;

/// The claims of a JSON of a global analysis.
#[derive(Clone, Debug)]
pub(crate) struct GlobalCertificate {
    pub(super) pair: ImpactPair,
    /// The periodic motions without rests, if there are any.
    pub(super) orbits: Option<PeriodicCertificate>,
    pub(super) claimed: Vec<Claimed>,
    pub(super) rest_cycle: Option<(u32, bool)>,
    /// Approximate number of boxes for the basins; for each attractor its position and a lower bound of its basin's share of the state space.
    basins: Option<(u32, Vec<(usize, BigRational)>)>,
    pub(super) greatest_speed: f64,
    /// Approximate number of boxes of the first partition of the analysis.
    pub(super) boxes: u32,
    pub(super) says_there_are_no_others: bool,
    /// True if a motion of the pair is proved to graze one wall for ever.
    has_grazing_motion: bool,
    pub(super) contradiction: Option<String>,
}

/// A component with a claim.
#[derive(Clone, Debug)]
pub(super) struct Claimed {
    pub kind: ComponentKind,
    pub attracts: bool,
    pub closed: bool,
    /// True if the component is a set of saddle type, not one periodic motion.
    pub is_saddle_set: bool,
    /// The horseshoe that the component is claimed to hold. Lemma V37
    pub horseshoe: Option<ProvedHorseshoeDocument>,
    /// Position of the component in the list.
    place: usize,
    /// Impacts of a period of the reduced map.
    reduced: usize,
    orbit: Option<ClaimedOrbit>,
}

/// Kinds of components with a periodic motion, and the stability of the motion.
const PERIODIC_KINDS: [(ComponentKind, Stability); 2] =
    [(ComponentKind::Attracting, Stability::Stable), (ComponentKind::Saddle, Stability::Unstable)];

impl GlobalCertificate {
    /// Reads a JSON of a global analysis.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, GLOBAL_SCHEMA)?;
        let document: GlobalDocument = whole.read()?;
        let own = Self::of(&document, &whole)?;
        let marks = marks::global(&document, own.components());
        Ok((own, marks))
    }

    /// The claims of a global analysis; `place` is the place of its components in the file.
    pub(super) fn of(document: &GlobalDocument, place: &Place<'_>) -> Result<Self, Error> {
        let (pair, _) = document.scene.clone().model()?;
        let places = place.get("components")?.list()?;
        let (mut claimed, mut orbits) = (Vec::new(), Vec::new());
        for (i, (component, place)) in document.components.iter().zip(&places).enumerate() {
            let claim = Claimed::of(i, component, place)?;
            if let (Some(orbit), Some(word)) = (&claim.orbit, &component.word) {
                let cycles = component.cycles.map_or(0, u64::from);
                orbits.push(OrbitOf { word: word.parse()?, cycles, orbit: orbit.clone() });
            }
            claimed.push(claim);
        }
        let is_open = document.components.iter().any(|component| component.kind == ComponentKind::Undecided);
        let says_there_are_no_others = !is_open && !document.interrupted;
        let basins = document.basins.as_ref().filter(|_| says_there_are_no_others);
        let has_grazing_motion = has_grazing_motion(&pair);
        let rests = document.components.iter().find(|component| component.kind == ComponentKind::RestCycle);
        let rest_cycle = rests.and_then(|rest| Some((rest.cycles?, rest.alternates?)));
        let of_basin = |basin: &BasinDocument| (basin.component as usize, basin.area.value());
        let basins = basins.map(|basins| (basins.boxes, basins.areas.iter().map(of_basin).collect()));
        let greatest_speed = document.greatest_speed.value().to_f64().unwrap_or(f64::NAN); // V27: none that is not is accepted
        let orbits = (!orbits.is_empty()).then(|| PeriodicCertificate::of_orbits(pair.clone(), orbits)).transpose()?;
        let contradiction = contradiction(document);
        Ok(Self {
            pair,
            orbits,
            claimed,
            rest_cycle,
            basins,
            greatest_speed,
            boxes: document.boxes,
            says_there_are_no_others,
            has_grazing_motion,
            contradiction,
        })
    }

    /// The checked claims about basins: the number of boxes, and for each attractor its position and a lower bound.
    pub(super) fn basins(&self) -> Option<(u32, &[(usize, BigRational)])> {
        self.basins.as_ref().map(|(boxes, areas)| (*boxes, &areas[..]))
    }

    /// What is said of the components depends on this.
    pub(super) fn components(&self) -> Components {
        Components { are_all: self.says_there_are_no_others, has_grazing_motion: self.has_grazing_motion }
    }

    /// Whether there is a claim that a check proves.
    pub(super) fn claims_something(&self) -> bool {
        let has_motions = self.orbits.is_some() || self.rest_cycle.is_some();
        has_motions
            || self.has_horseshoes()
            || self.has_grazing_claim()
            || self.says_there_are_no_others
            || self.contradiction.is_some()
    }

    /// Whether a component is claimed to hold a horseshoe; the component's identity is not checked.
    pub(super) fn has_horseshoes(&self) -> bool {
        self.claimed.iter().any(|claim| claim.horseshoe.is_some())
    }

    /// Whether a component is claimed to graze, for a pair that has a grazing motion.
    fn has_grazing_claim(&self) -> bool {
        self.has_grazing_motion && self.claimed.iter().any(|claim| claim.kind == ComponentKind::Grazing)
    }

    /// A finding about an orbit, as a finding about its component.
    pub(super) fn placed(&self, finding: Finding) -> Finding {
        let orbits = self.claimed.iter().filter(|claim| claim.orbit.is_some());
        let event = orbits.map(|claim| claim.place).nth(finding.event).unwrap_or(self.count());
        Finding { event, ..finding }
    }

    /// Number of listed components.
    pub fn count(&self) -> usize {
        self.claimed.len()
    }
}

impl Claimed {
    fn of(place: usize, component: &ComponentDocument, at: &Place<'_>) -> Result<Self, Error> {
        let attracts = component.kind == PERIODIC_KINDS[0].0;
        let orbit = match &component.orbit {
            Some(orbit) => Some(ClaimedOrbit::of(orbit, &at.get("orbit")?)?),
            None => None,
        };
        let reduced = component.reduced_impacts.map_or(0, |impacts| impacts as usize);
        let (kind, closed) = (component.kind, component.closed);
        let (is_saddle_set, horseshoe) = (component.is_saddle_set(), component.horseshoe.clone());
        Ok(Self { kind, attracts, closed, is_saddle_set, horseshoe, place, reduced, orbit })
    }

    /// The impacts of a period of the reduced map: whether each is on the right wall, its phase \[rad\] and its velocity.
    pub(super) fn states(&self, bits: u32) -> impl Iterator<Item = (bool, Real, Real)> {
        let hull = move |[low, high]: &Bounds| Real::rational(low, bits).hull(&Real::rational(high, bits));
        let impacts = self.orbit.iter().flat_map(|orbit| &orbit.impacts).take(self.reduced);
        impacts.map(move |impact| (impact.wall == Wall::Right, hull(&impact.phase), hull(&impact.velocity)))
    }
}

/// Whether a motion of the pair is proved to graze one wall for ever, without meeting the far wall before. Lemma A9
fn has_grazing_motion(pair: &ImpactPair) -> bool {
    let harmonic = pair.harmonic("a global analysis").ok();
    let twice = harmonic.and_then(|harmonic| harmonic.amplitude().checked_mul(&Exact::from(2)).ok());
    twice.and_then(|twice| pair.gap().compare(&twice)).is_some_and(Ordering::is_ge)
}

/// A statement of the document that its own fields contradict.
fn contradiction(document: &GlobalDocument) -> Option<String> {
    let class = class(document);
    if document.class != class {
        return Some(format!("the class of these components is {class}"));
    }
    if document.interrupted && document.components.iter().all(|own| own.kind != ComponentKind::Undecided) {
        return Some("it was interrupted, but no component is left as it is".to_owned());
    }
    let is_whole = matches!(class, Class::OneRestCycle | Class::OneAttractor) && !document.interrupted;
    if document.certified != is_whole {
        return Some(format!("certified is {} of a class that is {class}", document.certified));
    }
    if document.clone().with_statement().statement != document.statement {
        return Some("the statement is not that of these components".to_owned());
    }
    if document.components.iter().filter(|own| own.kind == ComponentKind::RestCycle).count() > 1 {
        return Some("all cycles with rests begin with the same release: there is one".to_owned());
    }
    if let Some(contradiction) = of_basins(document) {
        return Some(contradiction.to_owned());
    }
    document.components.iter().enumerate().find_map(|(i, own)| Some(format!("components[{i}]: {}", of_component(own)?)))
}

/// A contradiction in the basins: each attractor has one basin, and no motion is in two. Lemma V27
fn of_basins(document: &GlobalDocument) -> Option<&'static str> {
    let is_attractor =
        |own: &ComponentDocument| own.kind == ComponentKind::Attracting || own.kind == ComponentKind::RestCycle;
    let places = (0..document.components.len()).filter(|&i| is_attractor(&document.components[i]));
    let Some(basins) = &document.basins else { return None };
    if !places.eq(basins.areas.iter().map(|basin| basin.component as usize)) {
        return Some("the basins are not those of the attractors");
    }
    let one = BigRational::from_integer(1.into());
    let sum: BigRational = basins.areas.iter().map(|basin| basin.area.value()).sum();
    let is_negative = |area: &BigRational| *area < BigRational::from_integer(0.into());
    if sum > one || basins.areas.iter().any(|basin| is_negative(&basin.area.value())) {
        return Some("the basins are more than the state space, or less than nothing");
    }
    (sum + basins.undecided.value() < one).then_some("the basins and what is undecided are less than the state space")
}

fn of_component(own: &ComponentDocument) -> Option<&'static str> {
    if own.closed && matches!(own.kind, ComponentKind::Saddle | ComponentKind::Grazing) {
        return Some("motions near a saddle or a graze leave it");
    }
    if own.reason.is_some() && own.kind != ComponentKind::Undecided {
        return Some("what is proved has no reason to be left undecided");
    }
    if own.horseshoe.is_some() && own.kind != ComponentKind::Undecided {
        return Some("horseshoes are looked for where nothing else is proved");
    }
    let periodic = PERIODIC_KINDS.iter().find(|(kind, _)| *kind == own.kind).filter(|_| !own.is_saddle_set());
    let Some((_, stability)) = periodic else {
        let has_orbit =
            own.orbit.is_some() || own.word.is_some() || own.reduced_impacts.is_some() || own.spectral_radius.is_some();
        let is_rest = own.kind == ComponentKind::RestCycle;
        let lacks = own.cycles.is_some() != own.alternates.is_some() || !is_rest && own.cycles.is_some();
        return (has_orbit || lacks).then_some("these are not the keys of its kind");
    };
    let (Some(orbit), Some(reduced), Some(radius)) = (&own.orbit, own.reduced_impacts, &own.spectral_radius) else {
        return Some("it has no periodic motion");
    };
    if own.word.is_none() || own.cycles.is_none() || own.alternates.is_some() {
        return Some("these are not the keys of its kind");
    }
    if orbit.stability != *stability || orbit.physical != Some(true) {
        return Some("the stability of its orbit is that of another kind");
    }
    let (reduced, impacts) = (reduced as usize, orbit.impacts.len());
    let rounds = impacts.checked_div(reduced).filter(|rounds| rounds * reduced == impacts && (1..=2).contains(rounds));
    let crossings =
        (0..reduced.min(impacts)).filter(|&i| orbit.impacts[i].wall != orbit.impacts[(i + 1) % impacts].wall).count(); // exact: indices
    // After an odd number of crossings the reduced period ends on the other wall: the period is twice as long.
    let is_closed = rounds == Some(if crossings % 2 == 1 { 2 } else { 1 });
    let is_least = own.reduced_impacts.is_some_and(|own| is_reduced_period(own, impacts, orbit.symmetric));
    if !(is_closed && is_least) {
        return Some("reduced_impacts is not the period of the reduced map");
    }
    let Some(eigenvalues) = &orbit.eigenvalues else { return Some("it has no eigenvalues") };
    let squares = eigenvalues.each_ref().map(|own| {
        let [re, im] = [&own.re, &own.im].map(|part| square(&part.values()));
        [&re[0] + &im[0], &re[1] + &im[1]]
    });
    let most = [0, 1].map(|i| squares[0][i].clone().max(squares[1][i].clone())); // V20: the greater of both is between the greater ends
    let [low, high] = radius.values();
    let power = |x: &BigRational| if rounds == Some(2) { x * x * x * x } else { x * x };
    let zero = BigRational::from_integer(0.into());
    let is_wide = low >= zero && power(&low) <= most[0] && most[1] <= power(&high);
    (!is_wide).then_some("spectral_radius does not hold what the eigenvalues say")
}

/// Bounds of a square.
fn square([low, high]: &Bounds) -> Bounds {
    let zero = BigRational::from_integer(0.into());
    let ends = [low * low, high * high];
    let most = ends[0].clone().max(ends[1].clone()); // V20: the farther end
    let least = if *low <= zero && *high >= zero { zero } else { ends[0].clone().min(ends[1].clone()) }; // V20: the nearer end
    [least, most]
}

/// The class of some components.
fn class(document: &GlobalDocument) -> Class {
    let components = &document.components;
    let count = |kind: ComponentKind| components.iter().filter(|component| component.kind == kind).count();
    let (rests, open) = (count(ComponentKind::RestCycle), count(ComponentKind::Undecided));
    let attractors = rests + count(ComponentKind::Attracting);
    // That all states are in the whole state space is no claim.
    let is_whole = |component: &ComponentDocument| component.area.value() >= BigRational::from_integer(1.into());
    let is_closed = |component: &ComponentDocument| component.closed && !is_whole(component);
    let are_closed =
        components.iter().all(|component| component.kind != ComponentKind::Undecided || is_closed(component));
    match (attractors, open) {
        (1, 0) if rests == 1 && components.len() == 1 => Class::OneRestCycle,
        (1, 0) => Class::OneAttractor,
        (0, 1..) if are_closed => Class::Closed,
        (1.., _) => Class::Attractors,
        _ => Class::Undecided,
    }
}
