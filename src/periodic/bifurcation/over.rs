//! The parameter that a branch is followed over, and its range.

use super::family::Unknown;
use crate::Error;
use crate::exact::{Enclosure, Exact, ExactError};
use crate::excitation::Harmonic;
use crate::pair::{ImpactPair, ball, within};
use crate::scene::{Key, Over, Range};

/// Reads a range that branches are followed over: `KEY=LO..HI` of an amplitude, the gap, the restitution, or a frequency, over which nothing
/// bifurcates (Lemma R1).
///
/// # Errors
/// If the text is no range, has another key, or has a number of values.
///
/// ```
/// use impact_pair::periodic::bifurcation::over;
/// assert_eq!(over("amplitude=0.3..0.5")?.to_string(), "amplitude=0.3..0.5");
/// assert!(over("gap=2..3:4").is_err() && over("start.velocity=1..2").is_err());
/// # Ok::<(), impact_pair::Error>(())
/// ```
pub fn over(text: &str) -> Result<Over, Error> {
    Over::parse(text, &accepted(), is_followed)
}

/// Accepted ranges, in words.
fn accepted() -> String {
    format!("KEY=LO..HI with LO < HI, {PARAMETERS}")
}

fn is_followed(range: &Range) -> bool {
    is_parameter(range) && range.count().is_none()
}

/// The keys that periodic orbits depend on, in words.
pub const PARAMETERS: &str = "KEY one of amplitude, gap, restitution, frequency, A/d; with several terms amplitude.K";

/// Whether periodic orbits depend on the key of a range.
pub fn is_parameter(range: &Range) -> bool {
    matches!(range.key(), Key::Amplitude(_) | Key::Frequency(_) | Key::Gap | Key::Restitution)
}

/// A parameter of a pair, in the units of the scene and without units.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub pair: ImpactPair,
    pub over: Range,
    /// The quantity without units that varies; `None` where none does.
    pub unknown: Option<Unknown>,
    /// The total amplitude of the other terms of the harmonic, if there are any.
    others: Option<Exact>,
}

impl Parameter {
    /// The parameter of a pair that a range varies.
    ///
    /// # Errors
    /// If branches are not followed over the range, an end of the range is no value of the parameter, the pair has no such parameter, or
    /// no branch goes on over it.
    pub fn new(pair: &ImpactPair, over: &Range) -> Result<Self, Error> {
        if !is_followed(over) {
            return Err(Error::out_of_range(None, format!("the range is \"{over}\", but accepted is {}", accepted())));
        }
        pair.with(over.key(), over.low().clone())?;
        let high = pair.with(over.key(), over.high().clone())?;
        let mut others = None;
        let unknown = match over.key() {
            Key::Amplitude(_) => {
                let harmonic = high.harmonic_of(over.key())?;
                others = harmonic.1;
                Some(Unknown::Ratio(harmonic.0))
            }
            Key::Gap => Some(Unknown::Ratios),
            Key::Restitution => Some(Unknown::Restitution),
            _ if high.excitation().only().is_some() => None,
            key => return Err(not_periodic(key)),
        };
        Ok(Self { pair: pair.clone(), over: over.clone(), unknown, others })
    }

    /// Key of the scene file that has the parameter, or the list of its terms.
    fn place(&self) -> &'static str {
        match self.over.key() {
            Key::Gap => "pair.gap",
            Key::Restitution => "pair.restitution",
            _ => "excitation.amplitude",
        }
    }

    /// The pair at a value of the parameter.
    ///
    /// # Errors
    /// If the value is not in the parameter's range.
    pub fn pair_at(&self, value: Exact) -> Result<ImpactPair, Error> {
        self.pair.with(self.over.key(), value)
    }

    /// Pair with all parameters that do not vary, as [`Varied::at`](super::family::Varied::at) takes them.
    ///
    /// # Errors
    /// If the amplitude of the largest of several harmonics may be 0.
    pub fn base(&self) -> Result<ImpactPair, Error> {
        let is_one = self.pair.excitation().only().is_some();
        let value = if self.over.key() == Key::Gap && !is_one { self.largest() } else { self.over.high() };
        self.pair_at(value.clone())
    }

    /// The largest amplitude, by approximate values.
    fn largest(&self) -> &Exact {
        let size = |x: &Exact| x.enclose(64).mid_rad().0;
        let amplitudes = self.pair.excitation().harmonics().iter().map(Harmonic::amplitude);
        amplitudes.max_by(|a, b| size(a).total_cmp(&size(b))).expect("an excitation has a term")
    }

    /// Value of the quantity without units that varies, at a value of the parameter.
    ///
    /// # Errors
    /// If the value exceeds the range of exact expressions.
    pub fn without_units(&self, value: &Exact) -> Result<Exact, Error> {
        let ratio = || match (self.over.key(), &self.others) {
            (Key::Amplitude(_), None) => value.checked_div(self.pair.gap()),
            (Key::Amplitude(_), Some(others)) => value.checked_add(others)?.checked_div(self.pair.gap()),
            (Key::Gap, _) => self.largest().checked_div(value),
            _ => Ok(value.clone()),
        };
        within(self.place(), value, ratio())
    }

    /// Encloses the parameter, given bounds of the quantity without units, and gives the pair with it.
    ///
    /// # Errors
    /// If the value exceeds the range of exact expressions, or is not in the parameter's range.
    pub fn in_units(&self, ratio: &Enclosure, bits: u32) -> Result<(Enclosure, ImpactPair), Error> {
        let value = |ratio: &Exact| -> Result<Exact, ExactError> {
            match (self.over.key(), &self.others) {
                (Key::Amplitude(_), None) => ratio.checked_mul(self.pair.gap()),
                (Key::Amplitude(_), Some(others)) => ratio.checked_mul(self.pair.gap())?.checked_sub(others),
                (Key::Gap, _) => self.largest().checked_div(ratio),
                _ => Ok(ratio.clone()),
            }
        };
        let place = self.place();
        let ends = [ratio.inf(), ratio.sup()].map(|end| Exact::from_rational(end.to_rational()));
        let [a, b] = ends.map(|end| within(place, &end, value(&end)));
        let room = bits + 64;
        let hull = a?.enclose(room).hull(&b?.enclose(room));
        let [low, high] = [hull.inf(), hull.sup()].map(|end| Exact::from_rational(end.to_rational()));
        let all = within(place, &low, Exact::interval(&low, &high));
        Ok((hull, self.pair_at(all?)?))
    }

    /// Value of the quantity without units that varies, in doubles.
    ///
    /// # Errors
    /// If the value is beyond doubles.
    pub fn in_doubles(&self, value: &Exact) -> Result<f64, Error> {
        Ok(ball(self.place(), &self.without_units(value)?)?.mid())
    }

    /// Ends of the range without units, in doubles, the smaller one first.
    ///
    /// # Errors
    /// If an end is beyond doubles.
    pub fn ends(&self) -> Result<[f64; 2], Error> {
        let (a, b) = (self.in_doubles(self.over.low())?, self.in_doubles(self.over.high())?);
        Ok([a.min(b), a.max(b)]) // proposes
    }

    /// See [`Diagram::range_f64`](super::Diagram::range_f64).
    pub fn range_f64(&self, ends: [f64; 2]) -> [f64; 2] {
        let of = |value: &Exact| value.enclose(80).mid_rad().0;
        let [a, b] = ends.map(|x| match self.over.key() {
            Key::Amplitude(_) => x * of(self.pair.gap()) - self.others.as_ref().map_or(0.0, of),
            Key::Gap => of(self.largest()) / x,
            _ => x,
        });
        [a.min(b), a.max(b)] // shown
    }
}

/// Next to each frequency lie others that have no common period with the rest (Lemma H11).
fn not_periodic(key: Key) -> Error {
    let why = "between any two frequencies are some without a common period, for which no orbit is periodic";
    Error::out_of_range(
        key.place().as_str(),
        format!("the key is \"{key}\", but with several harmonics accepted are amplitude.K, gap, restitution: {why}"),
    )
}
