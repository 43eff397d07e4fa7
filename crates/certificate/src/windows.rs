//! The JSON of windows, read back: the claims about each stable orbit and about the ends of its window.

use super::attraction::ClaimedOrbit;
use super::bifurcation::{ClaimedPoint, parameter};
use super::marks::{self, Mark};
use crate::periodic::OrbitOf;
use crate::periodic::PeriodicCertificate;
use crate::read::is_single;
use impact_pair_document::{Place, WINDOWS_SCHEMA, WindowDocument, WindowsDocument};
use impact_pair_exact::{Exact, compare_rational};
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::{Bifurcation as Kind, Stability};
use impact_pair_model::{Error, ImpactPair, Start, Wall};
use serde_json::Value;

/// The claims of a JSON of windows.
#[derive(Clone, Debug)]
pub(crate) struct WindowsCertificate {
    pub(super) pair: ImpactPair,
    pub(super) start: Start,
    pub(super) over: Key,
    pub(super) windows: Vec<ClaimedWindow>,
    pub(super) contradiction: Option<String>,
}

/// A claimed window.
#[derive(Clone, Debug)]
pub(super) struct ClaimedWindow {
    /// The orbit at the window's value of the parameter, as a periodic JSON claims it.
    pub orbit: PeriodicCertificate,
    /// The ends of the window, as points of a bifurcation JSON without claimed orbits: the window's orbit is near them.
    pub ends: Vec<ClaimedPoint>,
    /// The value of the parameter.
    pub at: Exact,
    /// True for each flight of the reduced map to the far wall.
    pub flights: Vec<bool>,
    /// True if all orbits between the ends are claimed to be stable.
    pub stable_between: bool,
}

impl WindowsCertificate {
    /// Reads a JSON of windows.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, WINDOWS_SCHEMA)?;
        let document: WindowsDocument = whole.read()?;
        let over = parameter(&whole.get("over")?.get("key")?)?;
        let (pair, _) = document.scene.clone().model()?;
        for (key, end) in [("low", &document.over.low), ("high", &document.over.high)] {
            is_single(&whole.get("over")?, key, end)?;
        }
        let places = whole.get("windows")?.list()?;
        let read = |(window, place): (&WindowDocument, &Place<'_>)| ClaimedWindow::of(window, place, (&pair, over));
        let windows: Vec<ClaimedWindow> = document.windows.iter().zip(&places).map(read).collect::<Result<_, _>>()?;
        let marks = marks::windows(&document, over);
        let contradiction = contradiction(&document, over);
        // Phases are counted from the time 0; no orbit depends on the scene's start.
        let start = Start::on_wall(Exact::from(0), Wall::Left, Exact::from(0))?;
        Ok((Self { pair, start, over, windows, contradiction }, marks))
    }

    /// Number of claimed windows.
    pub fn count(&self) -> usize {
        self.windows.len()
    }
}

impl ClaimedWindow {
    fn of(window: &WindowDocument, place: &Place<'_>, (pair, over): (&ImpactPair, Key)) -> Result<Self, Error> {
        let at = place.get("orbit")?;
        let orbit = ClaimedOrbit::of(&window.orbit, &at)?;
        is_single(place, "at", &window.at)?;
        let (word, cycles) = (window.word.parse()?, u64::from(window.cycles));
        let there = pair.with(over, window.at.0.clone())?;
        let claim = OrbitOf { word, cycles, orbit: orbit.clone() };
        let bounds = [&window.from, &window.to];
        let mut ends = Vec::new();
        for (kind, bounds) in window.ends.iter().zip(bounds) {
            let (Some(kind), Some(bounds)) = (kind, bounds) else { continue };
            if *kind == Kind::Graze {
                return Err(place.get("ends")?.refused("accepted are fold, pitchfork, period-doubling and null"));
            }
            let parameter = bounds.values();
            let from = Some(window.at.0.enclose(BITS).inf().to_rational());
            let (word, orbit) = (claim.word.clone(), orbit.clone());
            ends.push(ClaimedPoint { kind: *kind, parameter, word, cycles, orbit, from });
        }
        let flights = window.flights.chars().map(|flight| flight == 'F').collect();
        let (at, stable_between) = (window.at.0.clone(), window.stable_between);
        Ok(Self { orbit: PeriodicCertificate::of_orbit(there, claim)?, ends, at, flights, stable_between })
    }
}

/// A statement of the document that its own fields contradict.
fn contradiction(document: &WindowsDocument, over: Key) -> Option<String> {
    let WindowsDocument { certified, windows, interrupted, over: range, .. } = document;
    let is_whole = |window: &WindowDocument| {
        window.stable_between
            && window.from.is_some()
            && window.to.is_some()
            && window.orbit.physical.is_some()
            && window.orbit.symmetric.is_some()
            && window.orbit.times.is_some()
    };
    if *certified && (windows.is_empty() || *interrupted || !windows.iter().all(is_whole)) {
        return Some("certified: not every window is proved".to_owned());
    }
    if range.low.0.enclose(BITS).inf() >= range.high.0.enclose(BITS).sup() {
        return Some("over: the lower end is not below the upper one".to_owned());
    }
    for (i, window) in windows.iter().enumerate() {
        let wrong = |message: &str| Some(format!("windows[{i}]{message}"));
        if window.key != over.place() || window.key != range.key {
            return wrong(".key: it is not that of the range");
        }
        if window.orbit.stability != Stability::Stable {
            return wrong(".orbit.stability: only stable orbits have a window");
        }
        if window.orbit.physical == Some(false) {
            return wrong(".orbit.physical: only admissible orbits have a window");
        }
        for (bounds, kind) in [&window.from, &window.to].into_iter().zip(&window.ends) {
            if bounds.is_some() != kind.is_some() {
                return wrong(".ends: an end has both its bounds and its kind, or neither");
            }
        }
        if window.stable_between && (window.from.is_none() || window.to.is_none()) {
            return wrong(".stable_between: between two ends, but one of them is not proved");
        }
        let folds = window.ends.iter().flatten().filter(|kind| **kind == Kind::Fold).count();
        if folds > 1 || (window.from.is_some() && window.to.is_some() && folds != 1) {
            return wrong(".ends: exactly one of two ends is a fold");
        }
        let value = window.at.0.enclose(BITS);
        let is_below = |bounds: &[impact_pair_document::Decimal; 2]| bounds[1].value() < value.inf().to_rational();
        let is_above = |bounds: &[impact_pair_document::Decimal; 2]| bounds[0].value() > value.sup().to_rational();
        if window.from.as_ref().is_some_and(|from| !is_below(from))
            || window.to.as_ref().is_some_and(|to| !is_above(to))
        {
            return wrong(".at: it is not between the ends");
        }
        let [low, high] = [&range.low, &range.high].map(|end| end.0.enclose(BITS));
        if value.sup() < low.inf() || high.sup() < value.inf() {
            return wrong(".at: it is outside the range");
        }
        if let Some(message) = wrong_flights(window) {
            return wrong(&message);
        }
    }
    None
}

/// Bits in which the value of a window is compared with its ends.
const BITS: u32 = 4096;

/// A contradiction between a window's flights and its word or its impacts.
fn wrong_flights(window: &WindowDocument) -> Option<String> {
    let flights = window.flights.as_bytes();
    if flights.len() != window.reduced_impacts as usize || flights.iter().any(|flight| !b"FN".contains(flight)) {
        return Some(".flights: not a letter F or N for each of the reduced impacts".to_owned());
    }
    let is_odd = flights.iter().filter(|flight| **flight == b'F').count() % 2 == 1;
    let rounds = if is_odd { 2 } else { 1 };
    let impacts = &window.orbit.impacts;
    let is_one = impacts.len() == rounds * flights.len()
        && (0..impacts.len()).all(|i| {
            let crosses = impacts[i].wall != impacts[(i + 1) % impacts.len()].wall;
            crosses == (flights[i % flights.len()] == b'F')
        });
    if !is_one {
        return Some(".flights: contradicts the impacts of the orbit".to_owned());
    }
    // An orbit that is its own mirror image after half of its impacts has a mirrored period, and no other orbit has.
    let is_symmetric = window.orbit.symmetric == Some(true);
    (window.orbit.symmetric.is_some() && is_odd != is_symmetric)
        .then(|| ".orbit.symmetric: contradicts the number of flights to the far wall".to_owned())
}

impl ClaimedWindow {
    /// Whether the window's orbit is claimed to be stable.
    pub(super) fn is_stable(&self) -> bool {
        self.orbit.orbits.iter().all(|claim| claim.orbit.stability == Stability::Stable)
    }

    /// Whether the flights are a cyclic rotation of the flights of another window.
    pub(super) fn has_flights_of(&self, other: &Self) -> bool {
        let (own, others) = (&self.flights, &other.flights);
        let from = |shift: usize| (0..own.len()).all(|i| own[(i + shift) % own.len()] == others[i]);
        own.len() == others.len() && (0..own.len()).any(from)
    }

    /// Whether a value lies outside the window, if the window claims all orbits between its ends.
    pub(super) fn is_without(&self, value: &Exact) -> bool {
        let (value, [from, to]) = (value.enclose(BITS), &self.ends[..]) else { return false };
        let is_outside = compare_rational(value.sup(), &from.parameter[0]).is_lt()
            || compare_rational(value.inf(), &to.parameter[1]).is_gt();
        self.stable_between && is_outside
    }
}
