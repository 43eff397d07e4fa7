//! The periodic JSON, read back: the claims about its orbits, as exact fractions.

use super::attraction::ClaimedOrbit;
use super::marks::{self, Mark};
use impact_pair_document::{CyclesDocument, PERIODIC_SCHEMA, PeriodicDocument, Place, TwoImpactDocument};
use impact_pair_exact::Exact;
use impact_pair_model::{Error, ImpactPair, Mapping, Start, Wall, Word};
use serde_json::Value;

/// The claims of a periodic JSON, or of a JSON of two-impact motions.
#[derive(Clone, Debug)]
pub(crate) struct PeriodicCertificate {
    pub(super) pair: ImpactPair,
    pub(super) start: Start,
    pub(super) orbits: Vec<OrbitOf>,
    pub(super) says_all_is_proved: bool,
    pub(super) has_no_rest: bool,
    pub(super) mirrors_are_one: bool,
    /// The tree of a search, with which it is proved that the word has no other orbits.
    pub(super) search: Option<Search>,
}

/// A word of which all orbits are listed, and the tree of the search for them.
#[derive(Clone, Debug)]
pub(super) struct Search {
    pub word: Word,
    pub cycles: u64,
    pub tree: String,
}

/// An orbit, its word and the cycles of the word.
#[derive(Clone, Debug)]
pub(super) struct OrbitOf {
    pub word: Word,
    pub cycles: u64,
    pub orbit: ClaimedOrbit,
}

impl PeriodicCertificate {
    /// Reads a periodic JSON.
    pub(super) fn read(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, PERIODIC_SCHEMA)?;
        let document: PeriodicDocument = whole.read()?;
        let has_rest = document.undecided.as_ref().is_some_and(|rest| !rest.is_empty());
        let marks = marks::periodic(&document);
        Ok((Self::of(&whole, document, has_rest)?, marks))
    }

    /// Reads a JSON of two-impact motions, solved for the velocity.
    pub(super) fn read_two_impact(values: &[Value]) -> Result<(Self, Mark), Error> {
        let whole = Place::alone_of_schema(values, PERIODIC_SCHEMA)?;
        let document: TwoImpactDocument = whole.read()?;
        let (has_rest, marks) = (!document.undecided.is_empty(), marks::two_impact(&document));
        let TwoImpactDocument { schema, scene, word, cycles, exhaustive, excludes, certified, orbits, .. } = document;
        let own: Word = word.parse()?;
        if !matches!(own.mappings(), [Mapping::P1, Mapping::P2] | [Mapping::P2, Mapping::P1]) {
            return Err(whole.get("word")?.refused("accepted of two-impact motions are \"P1 P2\" and \"P2 P1\""));
        }
        let (undecided, witness) = (None, None);
        let document = PeriodicDocument {
            schema,
            scene,
            word,
            cycles,
            exhaustive,
            excludes,
            certified,
            orbits,
            undecided,
            witness,
        };
        Ok((Self::of(&whole, document, has_rest)?, marks))
    }

    fn of(whole: &Place<'_>, document: PeriodicDocument, has_rest: bool) -> Result<Self, Error> {
        if document.excludes.is_some() && !document.exhaustive {
            return Err(whole.get("excludes")?.refused("only an exhaustive list says what it leaves out"));
        }
        let places = whole.get("orbits")?.list()?;
        let (word, cycles): (Word, _) = (document.word.parse()?, document.cycles.into());
        let orbits =
            document.orbits.iter().zip(&places).map(|(orbit, place)| {
                Ok(OrbitOf { word: word.clone(), cycles, orbit: ClaimedOrbit::of(orbit, place)? })
            });
        let orbits = orbits.collect::<Result<_, Error>>()?;
        let says_all_is_proved = document.certified;
        let tree = document.witness.and_then(|witness| witness.tree).filter(|_| document.exhaustive);
        let search = tree.map(|tree| Search { word, cycles, tree });
        let (pair, _) = document.scene.model()?;
        Ok(Self { says_all_is_proved, has_no_rest: !has_rest, search, ..Self::new(pair, orbits)? })
    }

    /// The orbits of the JSON of all cycles.
    pub(super) fn of_cycles(whole: &Place<'_>, document: &CyclesDocument) -> Result<Self, Error> {
        let (pair, _) = document.scene.clone().model()?;
        let places = whole.get("orbits")?.list()?;
        let orbits = document.orbits.iter().zip(&places).map(|(cycle, place)| {
            let orbit = ClaimedOrbit::of(&cycle.orbit(), place)?;
            Ok(OrbitOf { word: cycle.word.parse()?, cycles: cycle.cycles.into(), orbit })
        });
        let orbits = orbits.collect::<Result<_, Error>>()?;
        let (says_all_is_proved, has_no_rest) = (document.certified, document.undecided.is_empty());
        Ok(Self { says_all_is_proved, has_no_rest, mirrors_are_one: true, ..Self::new(pair, orbits)? })
    }

    /// One orbit, of a window.
    pub(super) fn of_orbit(pair: ImpactPair, orbit: OrbitOf) -> Result<Self, Error> {
        Self::of_orbits(pair, vec![orbit])
    }

    /// Orbits of the reduced map, which identifies mirror images.
    pub(super) fn of_orbits(pair: ImpactPair, orbits: Vec<OrbitOf>) -> Result<Self, Error> {
        Ok(Self { mirrors_are_one: true, ..Self::new(pair, orbits)? })
    }

    fn new(pair: ImpactPair, orbits: Vec<OrbitOf>) -> Result<Self, Error> {
        // Phases are counted from the time 0; no orbit depends on the scene's start.
        let start = Start::on_wall(Exact::from(0), Wall::Left, Exact::from(0))?;
        let (says_all_is_proved, has_no_rest, mirrors_are_one) = (false, true, false);
        Ok(Self { pair, start, orbits, says_all_is_proved, has_no_rest, mirrors_are_one, search: None })
    }

    /// Number of claimed orbits.
    pub fn count(&self) -> usize {
        self.orbits.len()
    }
}
