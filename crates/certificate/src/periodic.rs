//! The periodic JSON, read back: the claims about its orbits, as exact fractions.

use super::attraction::ClaimedOrbit;
use impact_pair_document::{
    CYCLES_SCHEMA, CyclesDocument, PERIODIC_SCHEMA, PeriodicDocument, PeriodicOrbitDocument, Place, TwoImpactDocument,
    value,
};
use impact_pair_exact::Exact;
use impact_pair_model::vocabulary::SolvedFor;
use impact_pair_model::{Error, ImpactPair, Mapping, Start, Wall, Word};

/// The claims of a periodic JSON, or of a JSON of two-impact motions.
#[derive(Clone, Debug)]
pub struct PeriodicCertificate {
    pair: ImpactPair,
    start: Start,
    orbits: Vec<OrbitOf>,
    says_all_is_proved: bool,
    has_no_rest: bool,
    mirrors_are_one: bool,
    unjudged: Vec<String>,
}

/// A periodic JSON, also from a JSON of two-impact motions.
struct Read {
    document: PeriodicDocument,
    /// True if a part of the search is undecided.
    has_rest: bool,
    is_two_impact: bool,
}

impl Read {
    fn of(whole: &Place<'_>) -> Result<Self, Error> {
        let Ok(solved_for) = whole.get("solved_for") else {
            let document: PeriodicDocument = whole.read()?;
            let has_rest = document.undecided.as_ref().is_some_and(|rest| !rest.is_empty());
            return Ok(Self { document, has_rest, is_two_impact: false });
        };
        let document: TwoImpactDocument = whole.read()?;
        if document.solved_for != SolvedFor::Velocity {
            return Err(solved_for.refused("only what is solved for the velocity is checked"));
        }
        let has_rest = !document.undecided.is_empty();
        let TwoImpactDocument { schema, scene, word, cycles, exhaustive, excludes, certified, orbits, .. } = document;
        let undecided = None;
        let document =
            PeriodicDocument { schema, scene, word, cycles, exhaustive, excludes, certified, orbits, undecided };
        Ok(Self { document, has_rest, is_two_impact: true })
    }
}

/// Keys of the JSON of all cycles that no lemma of `check` covers.
const UNJUDGED_OF_CYCLES: [&str; 10] = [
    "boxes",
    "certified",
    "exhaustive",
    "fixed_points",
    "impacts",
    "no_attractor",
    "program",
    "reason",
    "scene.start",
    "undecided",
];

/// An orbit, its word and the cycles of the word.
#[derive(Clone, Debug)]
pub(super) struct OrbitOf {
    pub word: Word,
    pub cycles: u64,
    pub orbit: ClaimedOrbit,
}

impl PeriodicCertificate {
    /// Reads a periodic JSON.
    ///
    /// # Errors
    /// Name the key, its value and what is accepted.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let value = value(text)?;
        let whole = Place::of_schema(&value, PERIODIC_SCHEMA)?;
        let Read { document, has_rest, is_two_impact } = Read::of(&whole)?;
        let places = whole.get("orbits")?.list()?;
        let orbits = document.orbits.iter().zip(&places).map(|(orbit, place)| ClaimedOrbit::of(orbit, place));
        let orbits: Vec<ClaimedOrbit> = orbits.collect::<Result<_, _>>()?;
        let mut unjudged = Vec::new();
        unjudged.extend(document.excludes.as_ref().map(|_| "excludes".to_owned()));
        unjudged.extend(is_two_impact.then(|| "program".to_owned()));
        // A search that is not exhaustive has no undecided part to leave out.
        unjudged.extend(document.exhaustive.then(|| "exhaustive".to_owned()));
        // For an exhaustive search the claim that all is proved includes that there are no other orbits.
        unjudged.extend((document.certified && document.exhaustive).then(|| "certified".to_owned()));
        unjudged.extend(has_rest.then(|| "undecided".to_owned()));
        unjudged.push("scene.start".to_owned());
        let (pair, _) = document.scene.model()?;
        let word: Word = document.word.parse()?;
        if is_two_impact && !matches!(word.mappings(), [Mapping::P1, Mapping::P2] | [Mapping::P2, Mapping::P1]) {
            return Err(whole.get("word")?.refused("accepted of two-impact motions are \"P1 P2\" and \"P2 P1\""));
        }
        if document.excludes.as_ref().is_some_and(|_| !document.exhaustive) {
            return Err(whole.get("excludes")?.refused("only an exhaustive list says what it leaves out"));
        }
        let cycles = document.cycles.into();
        let orbits = orbits.into_iter().map(|orbit| OrbitOf { word: word.clone(), cycles, orbit }).collect();
        let says_all_is_proved = document.certified;
        let document = Self::new(pair, orbits, unjudged)?;
        Ok(Self { says_all_is_proved, has_no_rest: !has_rest, ..document })
    }

    /// Reads the orbits of the JSON of all cycles.
    pub(super) fn parse_cycles(text: &str) -> Result<Self, Error> {
        let value = value(text)?;
        let whole = Place::of_schema(&value, CYCLES_SCHEMA)?;
        let document: CyclesDocument = whole.read()?;
        // Completeness and its consequences are not checked; the number of the listed orbits is.
        let mut unjudged = UNJUDGED_OF_CYCLES.map(str::to_owned).to_vec();
        let is_open = |orbit: &PeriodicOrbitDocument| orbit.physical != Some(true) || orbit.symmetric.is_none();
        let open = document.orbits.iter().enumerate().filter(|(_, cycle)| is_open(&cycle.orbit()));
        unjudged.extend(open.map(|(i, _)| format!("orbits[{i}].reduced_impacts")));
        let (pair, _) = document.scene.model()?;
        let places = whole.get("orbits")?.list()?;
        let orbits = document.orbits.iter().zip(&places).map(|(cycle, place)| {
            let orbit = ClaimedOrbit::of(&cycle.orbit(), place)?;
            Ok(OrbitOf { word: cycle.word.parse()?, cycles: cycle.cycles.into(), orbit })
        });
        let orbits = orbits.collect::<Result<_, Error>>()?;
        let says_all_is_proved = document.certified;
        let has_no_rest = document.undecided.is_empty();
        let document = Self::new(pair, orbits, unjudged)?;
        Ok(Self { says_all_is_proved, has_no_rest, mirrors_are_one: true, ..document })
    }

    /// One orbit, of a window.
    pub(super) fn of_orbit(pair: ImpactPair, orbit: OrbitOf) -> Result<Self, Error> {
        Self::of_orbits(pair, vec![orbit])
    }

    /// Orbits of the reduced map, which identifies mirror images.
    pub(super) fn of_orbits(pair: ImpactPair, orbits: Vec<OrbitOf>) -> Result<Self, Error> {
        Ok(Self { mirrors_are_one: true, ..Self::new(pair, orbits, Vec::new())? })
    }

    fn new(pair: ImpactPair, orbits: Vec<OrbitOf>, mut unjudged: Vec<String>) -> Result<Self, Error> {
        // For a virtual orbit uniqueness is not checked: its mirror image need not be a solution.
        for (i, _) in orbits.iter().enumerate().filter(|(_, orbit)| orbit.orbit.physical != Some(true)) {
            unjudged.extend(["symmetric", "unique"].map(|key| format!("orbits[{i}].{key}")));
        }
        // Nor that the orbit repeats when the state of its first impact recurs.
        let is_repeated =
            |claim: &OrbitOf| claim.orbit.physical != Some(true) && claim.orbit.times.is_some_and(|times| times > 1);
        let repeated = orbits.iter().enumerate().filter(|(_, claim)| is_repeated(claim));
        unjudged.extend(repeated.map(|(i, _)| format!("orbits[{i}].times")));
        unjudged.sort();
        unjudged.dedup();
        // Phases are counted from the time 0; no orbit depends on the scene's start.
        let start = Start::on_wall(Exact::from(0), Wall::Left, Exact::from(0))?;
        let (says_all_is_proved, has_no_rest, mirrors_are_one) = (false, true, false);
        Ok(Self { pair, start, orbits, says_all_is_proved, has_no_rest, mirrors_are_one, unjudged })
    }

    /// The impact pair.
    pub fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    pub(super) fn start(&self) -> &Start {
        &self.start
    }

    pub(super) fn orbits(&self) -> &[OrbitOf] {
        &self.orbits
    }

    /// Number of claimed orbits.
    pub fn count(&self) -> usize {
        self.orbits.len()
    }

    /// Whether the document claims that all requested results are proved.
    pub(super) fn says_all_is_proved(&self) -> bool {
        self.says_all_is_proved
    }

    /// Whether no part of the state space is left undecided.
    pub(super) fn has_no_rest(&self) -> bool {
        self.has_no_rest
    }

    /// Whether an orbit and its mirror image are listed as one orbit.
    pub(super) fn mirrors_are_one(&self) -> bool {
        self.mirrors_are_one
    }

    /// Keys of the document whose values [`check_within`](Self::check_within) does not check.
    pub fn unjudged(&self) -> &[String] {
        &self.unjudged
    }
}
