//! The parameter that a branch is followed over, and its range.

use std::str::FromStr;

use super::claim::Setting;
use super::system::Unknown;
use crate::Error;
use crate::exact::Exact;
use crate::excitation::Harmonic;
use crate::pair::{ImpactPair, Reduced, within};

/// A parameter of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// `A`
    Amplitude,
    /// `d`
    Gap,
    /// `e`
    Restitution,
    /// `W`: nothing bifurcates over it, since only `A/d` and `e` matter (Lemma R1).
    Frequency,
}

impl Key {
    /// The name in the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Amplitude => "excitation.amplitude",
            Self::Gap => "pair.gap",
            Self::Restitution => "pair.restitution",
            Self::Frequency => "excitation.frequency",
        }
    }
}

/// A parameter and the values it takes: `KEY=LO..HI`.
///
/// ```
/// use impact_pair::periodic::bifurcation::{Key, Over};
/// let over: Over = "amplitude=0.3..0.5".parse()?;
/// assert_eq!((over.key, over.low.text().as_str()), (Key::Amplitude, "0.3"));
/// assert_eq!("pair.gap=2..3".parse::<Over>()?.key, Key::Gap);
/// assert!("gap=3..2".parse::<Over>().is_err());
/// # Ok::<(), impact_pair::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Over {
    /// The parameter.
    pub key: Key,
    /// Its least value.
    pub low: Exact,
    /// Its greatest value.
    pub high: Exact,
}

/// What is not known of several harmonics, and what is.
const ONE_HARMONIC: &str =
    "a branch of orbits over a parameter (sweep --over amplitude.K=... shows attractors over it)";

pub(super) fn not_a_range(text: &str) -> Error {
    let accepted = "KEY=LO..HI with LO < HI, KEY one of amplitude, gap, restitution, frequency";
    Error::out_of_range(None, format!("the range is \"{text}\", but accepted are {accepted}"))
}

impl FromStr for Over {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let parse = || {
            let (name, range) = text.split_once('=')?;
            let keys = [Key::Amplitude, Key::Gap, Key::Restitution, Key::Frequency];
            let is_named = |key: &Key| key.name() == name || key.name().split_once('.').is_some_and(|(_, k)| k == name);
            let key = keys.into_iter().find(is_named)?;
            let (low, high) = range.split_once("..")?;
            let end = |text: &str| Exact::parse(text).ok().filter(Exact::is_point);
            let (low, high) = (end(low)?, end(high)?);
            low.compare(&high)?.is_lt().then_some(Self { key, low, high })
        };
        parse().ok_or_else(|| not_a_range(text))
    }
}

impl Over {
    /// The pair with the parameter at this value.
    ///
    /// # Errors
    /// When the value is not in its range.
    pub fn pair_at(&self, pair: &ImpactPair, value: Exact) -> Result<ImpactPair, Error> {
        let old = pair.harmonic(ONE_HARMONIC)?;
        let (mut amplitude, mut frequency) = (old.amplitude().clone(), old.frequency().clone());
        let (mut gap, mut restitution) = (pair.gap().clone(), pair.restitution().clone());
        match self.key {
            Key::Amplitude => amplitude = value,
            Key::Gap => gap = value,
            Key::Restitution => restitution = value,
            Key::Frequency => frequency = value,
        }
        ImpactPair::new(Harmonic::new(amplitude, frequency, old.phase().clone())?, gap, restitution)
    }

    /// What varies without units, and what does not; `None` where nothing does.
    ///
    /// # Errors
    /// When `A/d` is beyond what exact expressions hold.
    pub(super) fn setting(&self, pair: &ImpactPair) -> Result<Option<Setting>, Error> {
        let reduced = Reduced::exact(pair)?;
        Ok(match self.key {
            Key::Amplitude | Key::Gap => Some(Setting { unknown: Unknown::Ratio, fixed: reduced.restitution }),
            Key::Restitution => Some(Setting { unknown: Unknown::Restitution, fixed: reduced.alpha }),
            Key::Frequency => None,
        })
    }

    /// The parameter in the units of the scene, from `A/d` or `e`.
    ///
    /// # Errors
    /// When it is beyond what exact expressions hold.
    pub(super) fn in_units(&self, pair: &ImpactPair, value: &Exact) -> Result<Exact, Error> {
        match self.key {
            Key::Amplitude => within("pair.gap", pair.gap(), value.checked_mul(pair.gap())),
            Key::Gap => {
                let amplitude = pair.excitation().reference().amplitude();
                within("excitation.amplitude", amplitude, amplitude.checked_div(value))
            }
            Key::Restitution | Key::Frequency => Ok(value.clone()),
        }
    }

    /// The ends of the range without units, in doubles, the smaller one first.
    ///
    /// # Errors
    /// When one is beyond doubles.
    pub(super) fn ends(&self, pair: &ImpactPair) -> Result<[f64; 2], Error> {
        let end = |value: &Exact| {
            let reduced = Reduced::exact(&self.pair_at(pair, value.clone())?)?.enclosed()?;
            Ok(if self.key == Key::Restitution { reduced.restitution.mid() } else { reduced.alpha.mid() })
        };
        let (a, b) = (end(&self.low)?, end(&self.high)?);
        Ok([a.min(b), a.max(b)]) // proposes
    }

    /// See [`Diagram::range_f64`](super::Diagram::range_f64).
    pub(super) fn range_f64(&self, pair: &ImpactPair, ends: [f64; 2]) -> [f64; 2] {
        let of = |value: &Exact| value.enclose(80).mid_rad().0;
        let [a, b] = ends.map(|x| match self.key {
            Key::Amplitude => x * of(pair.gap()),
            Key::Gap => of(pair.excitation().reference().amplitude()) / x,
            Key::Restitution | Key::Frequency => x,
        });
        [a.min(b), a.max(b)] // shown
    }
}
