//! The search for two-impact motions, to the requested digits.

use std::ops::RangeInclusive;

use impact_pair_model::vocabulary::SolvedFor;
use impact_pair_model::{Place, Scene};
use num_bigint::BigInt;
use num_rational::BigRational;

use crate::Error;
use crate::exact::{Dyadic, Enclosure, Exact, whole_bits, working_bits};
use crate::pair::{ImpactPair, Wall, within};
use crate::units::Units;

use super::closed_forms::{drift, slope};
use super::data::{Data, Found};
use super::motion::{Motion, Parameters};
use super::orbit::Orbit;
use super::unequispaced::Spacing;
use crate::exact::Real;
use crate::periodic::{MeasuredOrbit, Stability};
use crate::watch::{Unwatched, Watch};

/// Accepted numbers of cycles: each has an equation of its own to solve.
pub const CYCLES: RangeInclusive<u32> = 1..=999;
/// Bits of the bounds that are handed on, beyond the whole bits of the requested digits.
pub(super) const SHOWN_BITS: u32 = 11;
/// The closed form, which is not known for several harmonics, with the command that serves these.
pub(super) const NEEDS_ONE_HARMONIC: &str =
    "the closed form of two impacts (for several, use periodic --word RL --cycles N --all)";
/// Number of precisions that are tried, each of twice the bits of the one before.
const PRECISIONS: u32 = 4;

/// The quantity of (66)-(68) to solve for.
#[derive(Clone, Debug)]
pub enum Unknown {
    /// The motion itself: all motions for the pair's `A` and `d`, equispaced or not.
    Velocity,
    /// `A_N` (68), for the pair's `d` and this `|v|`; the pair's amplitude is not used. Equispaced motions only.
    Amplitude(Exact),
    /// `d` (67), for the pair's `A` and this `|v|`; the pair's gap is not used. Equispaced motions only.
    Gap(Exact),
}

impl Unknown {
    /// `velocity`, `amplitude` or `gap`.
    pub fn kind(&self) -> SolvedFor {
        match self {
            Self::Velocity => SolvedFor::Velocity,
            Self::Amplitude(_) => SolvedFor::Amplitude,
            Self::Gap(_) => SolvedFor::Gap,
        }
    }
}

/// A problem about the motions with two impacts in N cycles.
#[derive(Clone, Debug)]
pub struct Problem {
    data: Data,
    unknown: Unknown,
}

/// The motions, and the undecided parts.
#[derive(Clone, Debug)]
pub struct Answer {
    problem: Problem,
    /// The equispaced ones first.
    pub orbits: Vec<Orbit>,
    /// Parts of `th1 - th0` \[rad\] in which there may be others.
    pub undecided: Vec<Enclosure>,
    /// True if there are proved to be no others with two impacts in N cycles that never rest (Lemma T12).
    pub is_exhaustive: bool,
    /// True if everything is decided: for each orbit uniqueness, first contacts, stability, and the requested digits.
    pub is_complete: bool,
}

/// Speed before the impact that a scene starts with \[length/time\].
///
/// # Errors
/// If the scene starts inside the gap.
pub fn speed(scene: &Scene) -> Result<Exact, Error> {
    let (start, key) = (scene.start(), "start.velocity");
    match start.place() {
        Place::Wall(Wall::Left) => within(key, start.velocity(), start.velocity().checked_neg()),
        Place::Wall(Wall::Right) => Ok(start.velocity().clone()),
        Place::Inside(_) => {
            let message = "start.wall is missing, but the velocity to solve for is that before an impact";
            Err(Error::out_of_range("start.wall", message.to_owned()))
        }
    }
}

impl Problem {
    /// Search for the motions of `pair`.
    ///
    /// # Errors
    /// If a given number is not greater than 0, if e is neither 1 nor proved to be below 1, if N is not among [`CYCLES`], if there are several
    /// harmonics, or if the amplitude is unknown for e = 1 and N even, where it is arbitrary.
    pub fn new(pair: &ImpactPair, cycles: u32, unknown: Unknown) -> Result<Self, Error> {
        if !CYCLES.contains(&cycles) {
            let accepted = format!("must be an integer from {} to {}", CYCLES.start(), CYCLES.end());
            return Err(Error::range("cycles", &Exact::from(i64::from(cycles)), &accepted));
        }
        let harmonic = pair.harmonic(NEEDS_ONE_HARMONIC)?;
        match &unknown {
            Unknown::Velocity => {}
            Unknown::Amplitude(speed) | Unknown::Gap(speed) => Error::require_positive("|start.velocity|", speed)?,
        }
        if !matches!(unknown, Unknown::Amplitude(_)) {
            Error::require_positive("excitation.amplitude", harmonic.amplitude())?;
        }
        let data = Data::new(pair, cycles)?;
        // W7 (b): |v| = d W/(N pi), whatever A is.
        if matches!(unknown, Unknown::Amplitude(_)) && data.is_elastic() && cycles.is_multiple_of(2) {
            let accepted = "must be odd: with e = 1 and N even the speed is d W/(N pi) for every amplitude, so the amplitude is not determined";
            return Err(Error::range("cycles", &Exact::from(i64::from(cycles)), accepted));
        }
        Ok(Self { data, unknown })
    }

    /// Finds the motions, with each enclosure of a phase at most `10^-digits` forcing periods wide and of a velocity `10^-digits` of `A W`, where
    /// the data are points and nothing is undecided for want of bits.
    ///
    /// **Undecided when** the parameters are so near to a fold, a pitchfork, a graze or an end of stability that eight times the
    /// bits of the digits do not tell, or when intervals of them hold one.
    pub fn answer(&self, digits: u32) -> Answer {
        self.answer_within(digits, &Unwatched)
    }

    /// Finds the motions as [`answer`](Self::answer) does, until the watch stops it: parts that are not searched or measured then are undecided.
    pub fn answer_within(&self, digits: u32, watch: &dyn Watch) -> Answer {
        let first = working_bits(digits);
        let mut answer = self.answer_in(first, digits, watch);
        for round in 1..PRECISIONS {
            if answer.is_complete || (round > 1 && !self.is_point()) || !watch.goes_on() {
                break;
            }
            let more = self.answer_in(first << round, digits, watch);
            // One that is stopped has less than the one before.
            if !watch.goes_on() {
                break;
            }
            answer = more;
        }
        answer
    }

    /// The pair.
    pub fn pair(&self) -> &ImpactPair {
        self.data.pair()
    }

    /// N
    pub fn cycles(&self) -> u32 {
        self.data.cycles()
    }

    /// The quantity to solve for.
    pub fn unknown(&self) -> &Unknown {
        &self.unknown
    }

    fn is_point(&self) -> bool {
        let speed_is_point = match &self.unknown {
            Unknown::Velocity => true,
            Unknown::Amplitude(speed) | Unknown::Gap(speed) => speed.is_point(),
        };
        self.data.pair().is_point() && speed_is_point
    }

    fn answer_in(&self, bits: u32, digits: u32, watch: &dyn Watch) -> Answer {
        let shown = whole_bits(digits) + SHOWN_BITS;
        let Found { motions, mut doubts } = match &self.unknown {
            Unknown::Velocity => self.data.motions(bits, watch),
            Unknown::Amplitude(speed) => self.data.with_amplitude(speed, bits),
            Unknown::Gap(speed) => self.data.with_gaps(speed, bits),
        };
        let is_searched = matches!(self.unknown, Unknown::Velocity);
        let frequency = Real::of(self.data.frequency(), bits);
        let mut orbits = Vec::new();
        for (motion, amplitude) in &motions {
            if !watch.goes_on() {
                doubts.push(motion.spacing.clone());
                continue;
            }
            let is_unique = is_unique(motion, motions.iter().map(|(motion, _)| motion), &doubts, (is_searched, shown));
            let units = Units { length: amplitude.clone(), velocity: amplitude * &frequency };
            match Orbit::of(motion, &units, shown, is_unique) {
                Some(orbit) => orbits.push(orbit),
                None => doubts.push(motion.spacing.clone()),
            }
        }
        let is_decided = |orbit: &Orbit| {
            let MeasuredOrbit { unique, physical, stability, .. } = orbit.measured;
            unique && physical.is_some() && stability != Stability::Undecided
        };
        let is_narrow = motions.iter().all(|(motion, _)| is_narrow(motion, digits));
        Answer {
            problem: self.clone(),
            is_exhaustive: doubts.is_empty() && is_searched,
            is_complete: doubts.is_empty() && orbits.iter().all(is_decided) && is_narrow,
            orbits,
            undecided: doubts.iter().map(|doubt| doubt.enclosure().clone()).collect(),
        }
    }
}

impl Answer {
    /// The problem that is answered.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }
}

/// Whether no other motion lies within the printed bounds of this one.
///
/// `is_searched` says that no motions exist besides the others and the doubts; bounds are rounded to `shown` bits.
fn is_unique<'m>(
    motion: &'m Motion,
    all: impl Iterator<Item = &'m Motion>,
    doubts: &[Real],
    (is_searched, shown): (bool, u32),
) -> bool {
    let bounds = Bounds::printed(motion, shown);
    if is_searched {
        let mut others = all.filter(|other| !std::ptr::eq(*other, motion));
        others.all(|other| !bounds.may_hold(other)) && doubts.iter().all(|doubt| !bounds.may_have(doubt))
    } else {
        bounds.is_alone(&motion.parameters) == Some(true)
    }
}

/// The bounds of a motion as they are printed, phases modulo `2 pi`.
struct Bounds {
    /// Sine and cosine of `th0` and `th1`.
    left: (Real, Real),
    right: (Real, Real),
    speed: Real,
    spacing: Real,
}

impl Bounds {
    fn printed(motion: &Motion, shown: u32) -> Self {
        // Decimals are at most a hundredth of the width, or the 39th digit, off; and before, bounds are rounded.
        let point = |size: Dyadic| Real::new(Enclosure::point(size), motion.parameters.bits());
        let widened = |x: &Real, size: Dyadic| {
            let rounding = point(size.scaled(4 - i64::from(shown))) + point(size.scaled(-120));
            let margin = point(x.wid()) + rounding;
            x + (-&margin).hull(&margin)
        };
        let eight = || Dyadic::power_of_two(3);
        let [theta0, theta1] = [&motion.theta0, &motion.theta1()].map(|theta| widened(theta, eight()));
        let [left, right] = [&theta0, &theta1].map(|theta| (theta.sin(), theta.cos()));
        let speed = widened(&motion.speed, motion.speed.enclosure().mag());
        Self { left, right, speed, spacing: theta1 - theta0 }
    }

    fn may_hold(&self, other: &Motion) -> bool {
        let may = |a: &(Real, Real), b: &(Real, Real)| !a.0.is_apart_from(&b.0) && !a.1.is_apart_from(&b.1);
        may(&self.left, &other.left) && may(&self.right, &other.right) && !self.speed.is_apart_from(&other.speed)
    }

    /// Whether this spacing may be within the bounds, modulo `2 pi`.
    fn may_have(&self, spacing: &Real) -> bool {
        !self.spacing.sin().is_apart_from(&spacing.sin()) && !self.spacing.cos().is_apart_from(&spacing.cos())
    }

    /// Whether a symmetric motion is the only one in its bounds for its `d/A`; `None` if undecided.
    fn is_alone(&self, parameters: &Parameters) -> Option<bool> {
        let Parameters { cycles, ratio, restitution, .. } = parameters;
        // No other number of forcing periods on the way: p = (g - sin th0 + sin th1)/c (57).
        let drift = drift(restitution, &self.speed, &self.left.1);
        let period = parameters.half_period();
        let turn = Real::pi(parameters.bits()) * 2;
        let off = (ratio - &self.left.0 + &self.right.0).over(&drift)? - &period;
        let is_direct = (&turn + &off).is_positive() && (turn - off).is_positive();
        // No other equispaced one: (67) is monotone in th0.
        let is_monotone =
            slope(*cycles, restitution).is_none_or(|slope| (&self.left.1 * 2 - slope * &self.left.0).sign().is_some());
        // No other spacing nearby.
        let eps = (&self.spacing - period).half();
        let reach = eps.hull(&-&eps).ends()[1].clone();
        Some(is_direct && is_monotone && Spacing::new(parameters, None).is_alone(&reach))
    }
}

/// Whether phases and speed have `digits` digits.
fn is_narrow(motion: &Motion, digits: u32) -> bool {
    let power = BigRational::new(1.into(), BigInt::from(10).pow(digits));
    let unit = Enclosure::from_rational(&power, 64).inf().clone();
    // 2 pi > 6.
    let phase = unit.times(&Dyadic::new(6.into(), 0));
    [&motion.theta0, &motion.theta1()].iter().all(|theta| theta.wid() <= phase) && motion.speed.wid() <= unit
}
