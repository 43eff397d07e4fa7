//! The bifurcation JSON, read back: the claims about its points, as exact fractions.

use super::attraction::{Bounds, ClaimedOrbit};
use super::marks::{self, Mark};
use impact_pair_document::{BIFURCATION_SCHEMA, BifurcationDocument, BifurcationPointDocument, Place};
use impact_pair_exact::Exact;
use impact_pair_model::scene::Key;
use impact_pair_model::vocabulary::{Bifurcation as Kind, BranchEnd};
use impact_pair_model::{Error, ImpactPair, Mapping, Start, Wall, Word};
use num_rational::BigRational;
use serde_json::Value;

/// The claims of a bifurcation JSON.
#[derive(Clone, Debug)]
pub(crate) struct BifurcationCertificate {
    pub(super) pair: ImpactPair,
    pub(super) start: Start,
    pub(super) over: Key,
    pub(super) points: Vec<ClaimedPoint>,
    /// A contradiction between the document's own fields.
    pub(super) contradiction: Option<String>,
}

/// A claimed bifurcation.
#[derive(Clone, Debug)]
pub(super) struct ClaimedPoint {
    pub kind: Kind,
    pub parameter: Bounds,
    pub word: Word,
    pub cycles: u64,
    pub orbit: ClaimedOrbit,
    /// The value of the parameter at which the orbit is given, if it is not the value at the point.
    pub from: Option<BigRational>,
}

/// Reads the key of the parameter that varies.
pub(super) fn parameter(place: &Place<'_>) -> Result<Key, Error> {
    let text = place.read::<String>()?;
    let key = text.parse().ok().filter(|key: &Key| key.place() == text);
    key.filter(|key| matches!(key, Key::Amplitude(_) | Key::Frequency(_) | Key::Gap | Key::Restitution)).ok_or_else(
        || {
            place.refused(
                "accepted are excitation.amplitude, .frequency, of a term .amplitude.K, pair.gap and .restitution",
            )
        },
    )
}

impl ClaimedPoint {
    fn of(point: &BifurcationPointDocument, place: &Place<'_>) -> Result<Self, Error> {
        let orbit = place.get("orbit")?;
        Ok(Self {
            kind: point.kind,
            parameter: point.parameter.values(),
            word: point.word.parse()?,
            cycles: point.cycles.into(),
            orbit: ClaimedOrbit::of(&point.orbit, &orbit)?,
            from: None,
        })
    }
}

impl ClaimedPoint {
    /// Whether the point's word is `doubled` times the requested word, or times a word that the requested word repeats, with the same part
    /// of the cycles: a branch of orbits that run through shorter orbits is the branch of the shorter orbits.
    fn is_of(&self, (requested, cycles): (&Word, u64), doubled: usize) -> bool {
        let (requested, word) = (requested.mappings(), self.word.mappings());
        let each = word.len() / doubled; // exact: where that many words are compared below
        let is_repeated = |all: &[Mapping]| all.iter().enumerate().all(|(i, mapping)| *mapping == word[i % each]);
        if each == 0 || word.len() != each * doubled || !requested.len().is_multiple_of(each) {
            return false;
        }
        let [rounds, doubled] = [requested.len() / each, doubled].map(|count| count as u64); // exact: lengths
        let periods = (cycles / rounds).checked_mul(doubled);
        is_repeated(word) && is_repeated(requested) && cycles.is_multiple_of(rounds) && periods == Some(self.cycles)
    }
}

impl BifurcationCertificate {
    /// Reads a bifurcation JSON.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, BIFURCATION_SCHEMA)?;
        let document: BifurcationDocument = whole.read()?;
        let over = parameter(&whole.get("over")?.get("key")?)?;
        let places = whole.get("points")?.list()?;
        let points = document.points.iter().zip(&places).map(|(point, place)| ClaimedPoint::of(point, place));
        let points: Vec<ClaimedPoint> = points.collect::<Result<_, _>>()?;
        let marks = marks::bifurcations(&document, over);
        let contradiction = contradiction(&document, &points)?;
        let (pair, _) = document.scene.model()?;
        // Phases are counted from the time 0; no orbit depends on the scene's start.
        let start = Start::on_wall(Exact::from(0), Wall::Left, Exact::from(0))?;
        Ok((Self { pair, start, over, points, contradiction }, marks))
    }

    /// Number of claimed bifurcations.
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Number of bifurcations that are checked: all but grazes.
    pub fn checked(&self) -> usize {
        self.points.iter().filter(|point| point.kind != Kind::Graze).count()
    }
}

/// Bits of the enclosures of the range's ends.
const BITS: u32 = 256;

/// A statement of the document that its own fields contradict.
fn contradiction(document: &BifurcationDocument, points: &[ClaimedPoint]) -> Result<Option<String>, Error> {
    let BifurcationDocument { word, cycles, certified, branches, undecided, over, .. } = document;
    let requested: Word = word.parse()?;
    let is_lost = branches.iter().any(|branch| branch.ends.contains(&BranchEnd::Lost));
    let is_open = |point: &ClaimedPoint| {
        point.kind != Kind::Graze && (point.orbit.physical.is_none() || point.orbit.times.is_none())
    };
    if *certified && (!undecided.is_empty() || is_lost || points.iter().any(is_open)) {
        return Ok(Some("certified: not everything found is proved".to_owned()));
    }
    let [low, high] = [&over.low, &over.high].map(|end| end.0.enclose(BITS));
    if low.inf() > high.sup() {
        return Ok(Some("over: the lower end is above the upper one".to_owned()));
    }
    for (i, (point, claimed)) in points.iter().zip(&document.points).enumerate() {
        let [least, most] = &point.parameter;
        if *most < low.inf().to_rational() || *least > high.sup().to_rational() {
            return Ok(Some(format!("points[{i}]: its parameter is outside the range")));
        }
        // The orbit at which a doubling comes is the orbit before the doubling.
        let doublings = claimed.doublings.checked_sub((point.kind == Kind::PeriodDoubling).into());
        let doubled = doublings.and_then(|doublings| 1usize.checked_shl(doublings));
        if !doubled.is_some_and(|doubled| point.is_of((&requested, (*cycles).into()), doubled)) {
            return Ok(Some(format!(
                "points[{i}]: its word is not the requested one, or one that this repeats, doubled that number of times"
            )));
        }
    }
    Ok(None)
}
