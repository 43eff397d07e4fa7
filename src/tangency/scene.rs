//! A search in the units of the scene: its parameter, its range, its folds in floating point and the proved tangencies.

use impact_pair_model::require_digits;

use super::begin;
use super::beside::Sides;
use super::flight::{Pair, Parameter};
use super::proof::Proof;
use super::prove::Request;
use super::saddle::Guessed;
use super::search::{Floats, Fold};
use super::{Beside, FlightWord, TANGENCY_PARAMETERS, Tangency, TangencySettings, is_tangency_range};
use crate::Error;
use crate::chaos::Law;
use crate::exact::{Enclosure, Exact};
use crate::pair::{ImpactPair, within};
use crate::scene::{Key, Range};
use crate::units::ratio;
use crate::watch::{Latched, Watch};

/// A search over a parameter of a pair.
pub(super) struct Search<'s> {
    over: &'s Range,
    pub request: Request,
    /// The amplitude where the gap varies, the gap where the amplitude does, or 1.
    unit: Exact,
    /// The scene's own value of `D` or `e` if the range has it, else the value in the middle of the range; and the value of the other parameter.
    own: Pair<f64>,
    range: [f64; 2],
}

/// The result of a search in floating point.
pub(super) struct Folds {
    pub folds: Vec<Fold>,
    /// `true` if the search ended at the limit of its work: there may be more folds.
    pub limited: bool,
}

const SUBJECT: &str = "a homoclinic tangency";

/// The work of following a fold to its tangency, in flights: those nearest to the stable manifold are followed first.
const WORK_PER_FOLD: usize = 10_000;

impl<'s> Search<'s> {
    pub fn new(pair: &ImpactPair, settings: &'s TangencySettings) -> Result<Self, Error> {
        let over = &settings.over;
        if !is_tangency_range(over) {
            let message = format!("the range is \"{over}\", but accepted is KEY=LO..HI, {TANGENCY_PARAMETERS}");
            return Err(Error::out_of_range(None, message));
        }
        require_digits(settings.precision.digits)?;
        let amplitude = pair.harmonic(SUBJECT)?.amplitude();
        if !matches!(over.key(), Key::Amplitude(_)) {
            Error::require_positive("excitation.amplitude", amplitude)?;
        }
        let (parameter, place, unit) = match over.key() {
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
        let at = |value: &Exact| of(&pair.with(over.key(), value.clone())?);
        let [low, high] = [at(over.low())?, at(over.high())?];
        let ends = [&low, &high].map(|end| *end.value(parameter));
        let range = [ends[0].min(ends[1]), ends[0].max(ends[1])]; // proposes
        let middle = Pair::of(parameter, 0.5 * (range[0] + range[1]), *low.value(parameter.other()));
        let own = of(pair).ok().filter(|own| (range[0]..=range[1]).contains(own.value(parameter))); // proposes
        let request = Request { over: parameter, other, precision: settings.precision };
        Ok(Self { over, request, unit, own: own.unwrap_or(middle), range }) // proposes: where a search begins
    }

    /// The value of the parameter.
    pub fn own_of(&self, pair: &Pair<f64>) -> f64 {
        *pair.value(self.request.over)
    }

    /// The folds that lead to tangencies in the range, in floating point, the nearest to the scene's own value first.
    pub fn folds(&self, settings: &TangencySettings, watch: &Latched<'_>) -> Folds {
        let mut found: Vec<Fold> = Vec::new();
        let (mut limited, work) = (false, settings.work());
        for guess in Guessed::all(self.own) {
            let Some(floats) = Floats::new(self.own, guess) else { continue };
            let (mut folds, is_whole) = match &settings.word {
                Some(word) => (floats.folds(&word.0), true),
                None => floats.all_folds(settings.longest, work, watch),
            };
            let most = work / WORK_PER_FOLD;
            limited |= (!is_whole && !watch.is_stopped()) || folds.len() > most;
            if folds.len() > most {
                folds.sort_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
                folds.truncate(most);
            }
            for fold in &folds {
                if !watch.goes_on() {
                    break;
                }
                let Some(fold) = begin::settled(fold, self.request.over) else { continue };
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
        match self.over.key() {
            Key::Gap => within("pair.gap", value, value.checked_mul(&self.unit)),
            Key::Restitution => Ok(value.clone()),
            _ => within("excitation.amplitude", value, self.unit.checked_div(value)),
        }
    }

    pub fn in_units_f64(&self, value: f64) -> f64 {
        let value = Exact::from_f64(value).and_then(|value| self.in_units(&value).ok());
        value.map_or(f64::NAN, |value| value.enclose(64).mid_rad().0) // shown
    }

    /// Whether bounds of the parameter are within the range.
    pub fn is_inside(&self, parameter: &Enclosure) -> Result<bool, Error> {
        let bits = 256;
        let (low, high) = (self.over.low().enclose(bits), self.over.high().enclose(bits));
        Ok(low.sup() <= parameter.inf() && parameter.sup() <= high.inf())
    }

    /// The tangency of a proof, in the units of the scene.
    pub fn tangency(&self, proof: Proof) -> Result<Tangency, Error> {
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
        let bits = narrow.max(256 + 4 * self.request.precision.digits); // J6: more bits are as good
        let ends = [values.inf(), values.sup()].map(|end| Exact::from_rational(end.to_rational()));
        let [a, b] = [self.in_units(&ends[0])?, self.in_units(&ends[1])?];
        Ok(a.enclose(bits).hull(&b.enclose(bits)))
    }
}
