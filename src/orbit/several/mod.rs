//! Orbits under several harmonics: the motions of [`super::motion`] and [`super::precise`] for a sum.

mod float;
mod interval;
#[cfg(feature = "multiprecision")]
mod precise;

use std::cmp::Ordering;
use std::sync::Arc;

use num_bigint::BigInt;

use super::Cursor;
use super::Start;
use super::origin::{Location, Origin};
#[cfg(feature = "multiprecision")]
use super::plan::Plan;
use super::still::quarter_turn;
use crate::Error;
use crate::exact::{Dyadic, Enclosure, Exact, ExactError};
use crate::number::Ball;
use crate::pair::{ImpactPair, Inward, Reduced, Wall, within};
use crate::several::{Band, Flight, Harmonics, Launch, Phased, Spectrum, Zero, accumulation, phases_at, release};
pub(super) use float::FloatMotion;
pub(super) use interval::IntervalMotion;
#[cfg(feature = "multiprecision")]
pub(super) use precise::PreciseMotion;

/// The harmonics of a pair, and where it starts in their phases.
#[derive(Clone, Debug)]
pub(in crate::orbit) struct Several {
    spectrum: Arc<Spectrum>,
    harmonics: Arc<Harmonics<Ball>>,
    band: Arc<Band>,
    /// Whole turns of the origin.
    turns: i64,
    /// The phases of all harmonics at the start.
    phases: Vec<Exact>,
    /// The release that is the origin.
    release: Option<Zero>,
    /// Releases so far, all different.
    known: Vec<Zero>,
}

impl Several {
    /// The harmonics of `pair` at a start `turns` turns after the clock's origin; `None` of a single one.
    pub fn new(pair: &ImpactPair, origin: &BigInt, start: &Start, turns: i64) -> Result<Option<Self>, Error> {
        let Some(spectrum) = Spectrum::new(pair, origin)? else { return Ok(None) };
        let harmonics = Harmonics::in_doubles(&spectrum, pair)?;
        let phases = within("start.time", start.time(), phases_at(pair, start.time()))?;
        let band = Band::new(&harmonics, spectrum.period);
        let (spectrum, harmonics, band) = (Arc::new(spectrum), Arc::new(harmonics), Arc::new(band));
        Ok(Some(Self { spectrum, harmonics, band, turns, phases, release: None, known: Vec::new() }))
    }

    /// How many there are.
    pub fn harmonics(&self) -> usize {
        self.phases.len()
    }

    /// Turns after which all phases are the same, where that is proved to happen.
    pub fn period(&self) -> Option<u32> {
        self.spectrum.period.and_then(|period| u32::try_from(period).ok())
    }

    /// The sums of `A_k/d` and of the greatest speeds.
    pub fn sums(&self) -> Result<Reduced<Exact>, ExactError> {
        self.spectrum.sums()
    }

    /// How long chatter can last that begins with a bounce at such a state, if that is proved.
    pub fn accumulation(&self, pair: &Reduced<Ball>, contact: &Cursor, wall: Wall, after: Ball) -> Option<f64> {
        let Cursor { turns, phase, index, .. } = *contact;
        let is_still = after == Ball::exact(0.0);
        if index == 0 && is_still && self.is_pressed_from_the_start(wall) {
            return Some(0.0);
        }
        accumulation(&self.harmonics, pair.restitution, wall, turns, phase, after)
    }

    /// When a ball that rests on a wall since a phase is released.
    pub fn release_after(&self, wall: Wall, turns: i64, phase: f64) -> Option<Zero> {
        release(&self.spectrum, &self.harmonics, wall, turns, phase)
    }

    /// `E/d` and `E'` in gaps a turn, at a phase after whole turns.
    pub fn shaking(&self, turns: i64, phase: Ball) -> (Ball, Ball) {
        let sums = self.harmonics.sums(turns, &phase);
        (sums.sine, sums.cosine)
    }

    /// `y''` in gaps a turn squared.
    pub fn swing(&self, turns: i64, phase: Ball) -> Ball {
        self.harmonics.sums(turns, &phase).swing
    }

    /// The number of a release, the same for all that are whole common periods apart, and its turns as those of the first of
    /// them are told (Lemma H9).
    pub fn number_of(&mut self, zero: &Zero) -> (usize, i64) {
        let period = self.spectrum.period.and_then(|period| i64::try_from(period).ok());
        let known = self.known.iter().enumerate();
        let same = known.filter_map(|(number, known)| Some((number, known.turns_of_same(period?, zero)?))).next();
        same.unwrap_or_else(|| {
            self.known.push(zero.clone());
            (self.known.len() - 1, zero.turns)
        })
    }

    /// Encloses the phase of a release, less the whole turns, in so many bits.
    pub fn enclosure(&self, zero: &Zero, bits: u32) -> Option<Enclosure> {
        zero.enclosure(&self.spectrum, bits)
    }

    /// Goes on from a release, whose phase is known to so many bits.
    pub fn leave(&mut self, zero: Zero, bits: u32) -> Origin<Exact> {
        let enclosure = self.enclosure(&zero, bits).expect("it was enclosed when the ball came to rest");
        let end = |x: &Dyadic| Exact::from_rational(x.to_rational());
        let phase = Exact::interval(&end(enclosure.lo()), &end(enclosure.hi())).expect("bounds are in order");
        let place = Location::Wall(zero.wall);
        (self.turns, self.release) = (zero.turns, Some(zero));
        Origin { place, phase, velocity: Exact::from(0) }
    }

    /// Whether the origin is a release.
    fn is_release(&self) -> bool {
        self.release.is_some()
    }

    /// Sines and cosines at the start, exact at quarter turns; `None` from a release on.
    fn waves<N: Phased>(&self, bits: u32) -> Option<Vec<(N, N)>> {
        let wave = |phase: &Exact| match quarter_turn(phase) {
            Some((sin, cos)) => (N::enclose(&sin, bits), N::enclose(&cos, bits)),
            None => N::enclose(phase, bits).wave(),
        };
        self.release.is_none().then(|| self.phases.iter().map(wave).collect())
    }

    /// Whether a ball that lies on a wall at the start, where the pressure is exactly 0, is proved to be pressed from then on.
    fn is_pressed_from_the_start(&self, wall: Wall) -> bool {
        let zero = Ball::exact(0.0);
        let launch = from_wall(wall, self.turns, zero, zero, false);
        let flight = Flight::new(&self.harmonics, launch, self.waves(f64::MANTISSA_DIGITS));
        let jerk = wall.inward(flight.jerk).bounds();
        self.release.is_none() && flight.acceleration == zero && jerk.1 < 0.0
    }

    /// Whether the motion from the origin is proved to touch no wall, ever: without drift, and with room for all harmonics.
    ///
    /// Like Lemma Z4, from phases at quarter turns, where the drift is exactly known.
    pub fn stays_inside(&self, origin: &Origin<Exact>) -> Result<bool, ExactError> {
        let Location::Inside(height) = &origin.place else { return Ok(false) };
        let waves: Option<Vec<_>> = self.phases.iter().map(quarter_turn).collect();
        let Some(waves) = waves.filter(|_| self.release.is_none()) else { return Ok(false) };
        let turn = Exact::pi() * Exact::from(2);
        let (mut drift, mut middle, mut swing) = (origin.velocity.clone(), height.clone(), Exact::from(0));
        for (term, (sin, cos)) in self.spectrum.terms.iter().zip(&waves) {
            let beta = term.alpha.checked_mul(&term.ratio)?.checked_mul(&turn)?;
            drift = drift.checked_add(&beta.checked_mul(cos)?)?;
            middle = middle.checked_add(&term.alpha.checked_mul(sin)?)?;
            swing = swing.checked_add(&term.alpha)?;
        }
        let is_above_0 = |x: &Exact| x.sign() == Some(Ordering::Greater);
        let (below, above) = (middle.checked_sub(&swing)?, Exact::from(1).checked_sub(&middle.checked_add(&swing)?)?);
        Ok(drift.sign() == Some(Ordering::Equal) && is_above_0(&below) && is_above_0(&above))
    }

    pub fn float(&self, pair: &Reduced<Ball>, origin: &Origin<Ball>) -> FloatMotion {
        FloatMotion::new(self, pair, origin)
    }

    pub fn interval(&self, pair: &Reduced<Ball>, origin: &Origin<Ball>) -> IntervalMotion {
        IntervalMotion::new(self, pair, origin)
    }

    #[cfg(feature = "multiprecision")]
    pub fn precise(&self, pair: &Reduced<Ball>, origin: &Origin<Exact>, plan: Plan) -> PreciseMotion {
        PreciseMotion::new(self, pair, origin, plan)
    }
}

/// The start of a flight from a wall.
fn from_wall<N: Phased>(wall: Wall, turns: i64, phase: N, velocity: N, is_release: bool) -> Launch<N> {
    Launch { wall: Some(wall), height: N::from_f64(0.0), turns, phase, velocity, is_release }
}
