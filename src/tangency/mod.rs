//! Homoclinic tangencies: values of a parameter at which the stable and the unstable manifold of a saddle of the reduced impact map are
//! tangent, proved. Lemmas J1-J13 of `docs/proofs/tangency.md#J1`.
//!
//! The saddle is a fixed point of the map that mirrors every impact to the left wall: the equispaced motion (66), (67). Floating point looks for
//! folds of the unstable manifold near the stable one (`search`); the manifolds are Taylor series with proved errors (`series`, `local`,
//! `manifold`), the tangency is a regular zero of the equations of all flights between them (`chain`), proved by Krawczyk's operator (`prove`).

mod begin;
mod beside;
mod boxes;
mod chain;
mod disc;
mod family;
mod flight;
mod flights;
mod local;
mod manifold;
mod only;
mod portrait;
mod proof;
mod prove;
mod saddle;
mod search;
mod series;
mod terms;
#[cfg(test)]
mod tests;
mod unfolding;

use crate::chaos::{Law, Side};
use crate::exact::{Enclosure, Exact};
use crate::pair::{ImpactPair, within};
use crate::periodic::Precision;
use crate::scene::{Key, Range};
use crate::units::ratio;
use crate::watch::{Latched, Stage, Watch};
use crate::{Error, Scene};
use beside::Sides;
pub use boxes::StateBounds;
use flight::{Pair, Parameter};
pub use portrait::Portrait;
use proof::Proof;
use prove::Question;
use saddle::Guessed;
use search::{Floats, Fold};

/// The keys over which tangencies are searched, in words.
pub const TANGENCY_PARAMETERS: &str = "KEY one of gap, amplitude, restitution";

/// The most flights between the two manifolds.
pub const MOST_FLIGHTS: usize = 200;

/// Returns whether tangencies are searched over such a range.
pub fn is_tangency_range(range: &Range) -> bool {
    matches!(range.key, Key::Gap | Key::Amplitude(_) | Key::Restitution) && range.count.is_none()
}

/// Flights between the walls in time order: `F` to the far wall, `N` back to the near one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlightWord(Vec<Side>);

impl std::str::FromStr for FlightWord {
    type Err = Error;

    /// Reads the letters of flights.
    fn from_str(text: &str) -> Result<Self, Error> {
        let side = |letter: char| match letter {
            'F' => Some(Side::Far),
            'N' => Some(Side::Near),
            _ => None,
        };
        let sides: Option<Vec<Side>> = text.trim().chars().map(side).collect();
        sides.filter(|sides| (1..=MOST_FLIGHTS).contains(&sides.len())).map(Self).ok_or_else(|| {
            Error::out_of_range(
                None,
                format!("the word is \"{text}\", but accepted are 1 to {MOST_FLIGHTS} letters F (a flight to the far wall) and N (back to the near one)"),
            )
        })
    }
}

impl FlightWord {
    /// The number of flights.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Always false: a word has a letter.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl std::fmt::Display for FlightWord {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.iter().try_for_each(|side| f.write_str(if *side == Side::Far { "F" } else { "N" }))
    }
}

/// The settings of a search for tangencies.
#[derive(Clone, Debug)]
pub struct TangencySettings {
    /// The parameter and its range: gap, amplitude or restitution.
    pub over: Range,
    /// The flights of the orbit; `None` for a search over all of them.
    pub word: Option<FlightWord>,
    /// The most flights that are searched without a word.
    pub longest: usize,
    /// Number of tangencies that are proved at most, those nearest to the scene's own value.
    pub most: usize,
    /// The work of the search without a word, about, for each saddle: the flights that it computes in floating point. To follow a fold to
    /// its tangency is as much as 10,000 flights, and as much again is allowed for all folds.
    pub work: usize,
    /// Requested widths of the enclosures: of `D` and of the parameters of the manifolds, absolute.
    pub precision: Precision,
}

/// A homoclinic tangency: for exactly one value of the parameter within its bounds the two manifolds of the saddle have a common point along
/// these flights, with `unstable` and `stable` within theirs, at which they are tangent. It is quadratic, and unfolds with a speed other than 0.
#[derive(Clone, Debug)]
pub struct Tangency {
    /// The value of the parameter, in the units of the scene.
    pub parameter: Enclosure,
    /// The flights from the point of the unstable manifold to that of the stable one.
    pub flights: FlightWord,
    /// The phase of the saddle in radians, in `[0, 2 pi)`.
    pub phase: Enclosure,
    /// Its speed, over `A W`.
    pub speed: Enclosure,
    /// Its eigenvalues: the unstable one and the stable one.
    pub eigenvalues: [Enclosure; 2],
    /// The parameter of the unstable manifold, along which the phase has the derivative 1 at the saddle.
    pub unstable: Enclosure,
    /// The same of the stable manifold.
    pub stable: Enclosure,
    /// `q` of Lemma J5, not 0: by how much the manifolds bend away from each other.
    pub quadratic: Enclosure,
    /// `m` of Lemma J5, not 0: how fast they pass through each other, for a unit of `D = d/A`.
    pub unfolding: Enclosure,
    /// A lower bound of all speeds of the orbit, over `A W`.
    pub least_speed: f64,
    /// A lower bound of all its flights, in radians.
    pub least_flight: f64,
    /// No product of powers of the eigenvalues of an order from 2 to this one is one of them.
    pub resonances_excluded_to: u32,
    /// Bounds of the states between both points, where a datum of the scene is an interval. For each value of that datum there is exactly
    /// one value of the parameter with a tangency whose `unstable`, `stable`, parameter and states are in their bounds; all other bounds
    /// hold for each.
    pub states: Option<Vec<StateBounds>>,
    /// The common points on either side; `None` where they are not proved.
    pub beside: Option<Beside>,
}

/// The numbers of common points of the two manifolds on either side of a tangency, along its flights, with their `sigma_u`, `sigma_s` and
/// the states between both in these boxes.
#[derive(Clone, Debug)]
pub struct Beside {
    /// Values of the parameter, in the units of the scene: for each there are exactly two common points.
    pub two: Enclosure,
    /// The same: for each there is none.
    pub none: Enclosure,
    /// The range of `sigma_u`.
    pub unstable: Enclosure,
    /// The range of `sigma_s`.
    pub stable: Enclosure,
    /// The boxes of the states.
    pub states: Vec<StateBounds>,
}

/// A tangency of floating point that is not proved.
#[derive(Clone, Debug)]
pub struct UnprovedTangency {
    /// The value of the parameter near which the fold is, in the units of the scene.
    pub near: f64,
    /// Its flights.
    pub flights: FlightWord,
}

/// The tangencies found over a parameter. That there are no others is not proved.
#[derive(Clone, Debug)]
pub struct Tangencies {
    /// The parameter and its range.
    pub over: Range,
    /// The tangencies proved, the nearest to the scene's own value first.
    pub tangencies: Vec<Tangency>,
    /// Folds of floating point of which nothing is proved.
    pub unproved: Vec<UnprovedTangency>,
    /// `true` if it was interrupted before the search or the proofs were done.
    pub interrupted: bool,
    /// `true` if the search ended at the limit of its work before all words and all folds were tried.
    pub limited: bool,
}

impl Tangencies {
    /// Searches tangencies of the manifolds of the equispaced motion and proves them, until the watch stops it.
    ///
    /// # Errors
    /// With several harmonics, if the range is not one of the parameter's, or if over the gap the amplitude is an interval, or over the
    /// amplitude the gap.
    ///
    /// ```
    /// use impact_pair::Scene;
    /// use impact_pair::periodic::Precision;
    /// use impact_pair::tangency::{Tangencies, TangencySettings};
    /// use impact_pair::watch::Unwatched;
    /// let scene = Scene::parse(r#"
    ///     excitation = { amplitude = 8, frequency = "pi", phase = 0 }
    ///     pair = { gap = 9.42497, restitution = 0.5 }
    ///     start = { time = 0, wall = "left", velocity = -1 }
    /// "#)?;
    /// let settings = TangencySettings {
    ///     over: "gap=9.4249..9.4252".parse()?,
    ///     word: Some("FFFFFFFNFFFFFNFFNFFNFFFF".parse()?),
    ///     longest: 24,
    ///     most: 1,
    ///     work: TangencySettings::WORK,
    ///     precision: Precision::default(),
    /// };
    /// let found = Tangencies::of(&scene, &settings, &Unwatched)?;
    /// assert_eq!(format!("{:.10}", found.tangencies[0].parameter.mid_rad().0), "9.4251263769");
    /// # Ok::<(), impact_pair::Error>(())
    /// ```
    pub fn of(scene: &Scene, settings: &TangencySettings, watch: &dyn Watch) -> Result<Self, Error> {
        let watch = Latched::new(watch);
        let search = Search::new(scene.pair(), settings)?;
        let Folds { folds, limited } = search.folds(settings, &watch);
        let (over, tangencies, unproved) = (settings.over.clone(), Vec::new(), Vec::new());
        let mut all = Self { over, tangencies, unproved, interrupted: false, limited };
        for (i, fold) in folds.iter().enumerate() {
            let at = Stage::Tangencies { proved: i, of: folds.len() };
            if all.tangencies.len() >= settings.most || watch.proceed(at).is_break() {
                break;
            }
            let flights = FlightWord(fold.flights.clone());
            match prove::tangency(fold, &search.question) {
                Some(proof) => {
                    let found = search.tangency(proof)?;
                    if search.is_inside(&found.parameter)? && all.tangencies.iter().all(|known| !known.meets(&found)) {
                        all.tangencies.push(found);
                    }
                }
                None => all
                    .unproved
                    .push(UnprovedTangency { near: search.in_units_f64(search.own_of(&fold.pair)), flights }),
            }
        }
        all.interrupted = watch.is_stopped();
        Ok(all)
    }

    /// Returns whether there are tangencies, the search was not cut short, and all folds that were tried are proved to lead to one.
    pub fn is_certified(&self) -> bool {
        !self.interrupted && !self.limited && self.unproved.is_empty() && !self.tangencies.is_empty()
    }
}

impl UnprovedTangency {
    /// The reason why it is undecided.
    pub const REASON: &str = "the tangency near this fold of floating point, or one of its flights, is not proved";
}

impl Tangency {
    /// Returns whether another one may be at the same value.
    fn meets(&self, other: &Self) -> bool {
        self.parameter.intersection(&other.parameter).is_some()
    }
}

/// A search over a parameter of a pair.
struct Search<'s> {
    over: &'s Range,
    question: Question,
    /// The amplitude where the gap varies, the gap where the amplitude does, or 1.
    unit: Exact,
    /// The scene's own value of `D` or `e` if the range has it, else that in its middle; and that of the other one.
    own: Pair<f64>,
    range: [f64; 2],
}

/// The result of a search in floating point.
struct Folds {
    folds: Vec<Fold>,
    /// `true` if there may be more: it ended at the limit of its work.
    limited: bool,
}

const WHAT: &str = "a homoclinic tangency";

/// The work of following a fold to its tangency, in flights: those nearest to the stable manifold are followed first.
const FOLD: usize = 10_000;

impl TangencySettings {
    /// The work by default: some 20 seconds for each saddle.
    pub const WORK: usize = 30_000_000;
}

impl<'s> Search<'s> {
    fn new(pair: &ImpactPair, settings: &'s TangencySettings) -> Result<Self, Error> {
        let over = &settings.over;
        if !is_tangency_range(over) {
            let message = format!("the range is \"{over}\", but accepted is KEY=LO..HI, {TANGENCY_PARAMETERS}");
            return Err(Error::out_of_range(None, message));
        }
        let amplitude = pair.harmonic(WHAT)?.amplitude();
        if !matches!(over.key, Key::Amplitude(_)) {
            Error::require_positive("excitation.amplitude", amplitude)?;
        }
        let (parameter, place, unit) = match over.key {
            Key::Gap => (Parameter::Gap, "excitation.amplitude", amplitude.clone()),
            Key::Restitution => (Parameter::Restitution, "", Exact::from(1)),
            _ => (Parameter::Gap, "pair.gap", pair.gap().clone()),
        };
        if !unit.is_point() {
            let message =
                format!("is the interval {unit}, but accepted is a single number: tangencies are those of one pair");
            return Err(Error::out_of_range(place, message));
        }
        let other = match parameter {
            Parameter::Gap => pair.restitution().clone(),
            Parameter::Restitution => ratio(pair)?,
        };
        let of = |pair: &ImpactPair| -> Result<Pair<f64>, Error> {
            let law = Law::of(pair)?;
            Ok(Pair { gap: law.gap.mid(), restitution: law.restitution.mid() })
        };
        let at = |value: &Exact| of(&pair.with(over.key, value.clone())?);
        let [low, high] = [at(&over.low)?, at(&over.high)?];
        let ends = [&low, &high].map(|end| *end.value(parameter));
        let range = [ends[0].min(ends[1]), ends[0].max(ends[1])]; // proposes
        let middle = Pair::of(parameter, 0.5 * (range[0] + range[1]), *low.value(parameter.other()));
        let own = of(pair).ok().filter(|own| (range[0]..=range[1]).contains(own.value(parameter))); // proposes
        let question = Question { over: parameter, other, precision: settings.precision };
        Ok(Self { over, question, unit, own: own.unwrap_or(middle), range }) // proposes: where a search begins
    }

    /// The value of the parameter.
    fn own_of(&self, pair: &Pair<f64>) -> f64 {
        *pair.value(self.question.over)
    }

    /// The folds that lead to tangencies in the range, in floating point, the nearest to the scene's own value first.
    fn folds(&self, settings: &TangencySettings, watch: &Latched<'_>) -> Folds {
        let mut found: Vec<Fold> = Vec::new();
        let mut limited = false;
        for guess in Guessed::all(self.own) {
            let Some(floats) = Floats::new(self.own, guess) else { continue };
            let (mut folds, is_whole) = match &settings.word {
                Some(word) => (floats.folds(&word.0), true),
                None => floats.all_folds(settings.longest, settings.work, watch),
            };
            let most = settings.work / FOLD;
            limited |= (!is_whole && !watch.is_stopped()) || folds.len() > most;
            if folds.len() > most {
                folds.sort_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
                folds.truncate(most);
            }
            for fold in &folds {
                if !watch.goes_on() {
                    break;
                }
                let Some(fold) = begin::settled(fold, self.question.over) else { continue };
                let value = self.own_of(&fold.pair);
                let is_new = found.iter().all(|known| (self.own_of(&known.pair) - value).abs() > 1e-12 * value);
                if is_new && (self.range[0]..=self.range[1]).contains(&value) {
                    found.push(fold);
                }
            }
        }
        let away = |fold: &Fold| (self.own_of(&fold.pair) - self.own_of(&self.own)).abs();
        found.sort_by(|a, b| away(a).total_cmp(&away(b)));
        Folds { folds: found, limited }
    }

    /// A value of `D` or `e` in the units of the scene.
    fn in_units(&self, value: &Exact) -> Result<Exact, Error> {
        match self.over.key {
            Key::Gap => within("pair.gap", value, value.checked_mul(&self.unit)),
            Key::Restitution => Ok(value.clone()),
            _ => within("excitation.amplitude", value, self.unit.checked_div(value)),
        }
    }

    fn in_units_f64(&self, value: f64) -> f64 {
        let value = Exact::from_f64(value).and_then(|value| self.in_units(&value).ok());
        value.map_or(f64::NAN, |value| value.enclose(64).mid_rad().0) // shown
    }

    /// Returns whether bounds of the parameter are within the range.
    fn is_inside(&self, parameter: &Enclosure) -> Result<bool, Error> {
        let bits = 256;
        let (low, high) = (self.over.low.enclose(bits), self.over.high.enclose(bits));
        Ok(low.sup() <= parameter.inf() && parameter.sup() <= high.inf())
    }

    /// Returns the tangency of a proof, in the units of the scene.
    fn tangency(&self, proof: Proof) -> Result<Tangency, Error> {
        let [unstable, stable] = proof.sigma;
        Ok(Tangency {
            parameter: self.bounds_in_units(&proof.parameter)?,
            flights: FlightWord(proof.flights),
            phase: proof.phase,
            speed: proof.speed,
            eigenvalues: proof.eigenvalues,
            unstable,
            stable,
            quadratic: proof.quadratic,
            unfolding: proof.unfolding,
            least_speed: proof.least.speed,
            least_flight: proof.least.time,
            resonances_excluded_to: proof.resonances,
            states: proof.states,
            beside: proof.beside.map(|sides| self.beside(sides)).transpose()?,
        })
    }

    fn beside(&self, Sides { two, none, sigma: [unstable, stable], states }: Sides) -> Result<Beside, Error> {
        Ok(Beside { two: self.bounds_in_units(&two)?, none: self.bounds_in_units(&none)?, unstable, stable, states })
    }

    /// Values of `D` or `e` in the units of the scene.
    fn bounds_in_units(&self, values: &Enclosure) -> Result<Enclosure, Error> {
        // J6: what the change of units adds is far less than the width, within a few of which there is no other one
        let narrow = values.wid().top().map_or(0, |top| u32::try_from(128 - top).unwrap_or(0)); // J6: a wide one needs no bits
        let bits = narrow.max(256 + 4 * self.question.precision.digits); // J6: more bits are as good
        let ends = [values.inf(), values.sup()].map(|end| Exact::from_rational(end.to_rational()));
        let [a, b] = [self.in_units(&ends[0])?, self.in_units(&ends[1])?];
        Ok(a.enclose(bits).hull(&b.enclose(bits)))
    }
}
