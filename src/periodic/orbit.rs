//! A proved periodic orbit: its enclosures and proved properties.

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::chain::Chain;
use super::identity::{is_symmetric, repeats};
use super::krawczyk::{Proved, widest};
use super::legs::{Leg, Legs};
use super::shaking::Shaking;
use super::stability::{Eigenvalue, Stability, determinant, eigenvalues, trace};
use crate::exact::{Enclosure, Exact};
use crate::number::{Ball, Enclosing};
use crate::pair::Wall;

/// An impact of a periodic orbit in forcing periods and gaps; in the units of the scene it is a [`MeasuredImpact`](crate::json::MeasuredImpact).
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicImpact {
    /// The wall.
    pub wall: Wall,
    /// Phase in forcing periods, counted from the beginning of the first impact's forcing period. With several harmonics: counted from the
    /// beginning of the first impact's common period.
    pub phase: Enclosure,
    /// The relative velocity `y'` just before the impact, in gap widths per forcing period.
    pub velocity: Enclosure,
}

impl PeriodicImpact {
    /// Forcing period of the phase `W t + tau`, counted from that of the first impact.
    pub fn cycle(&self) -> i64 {
        let turn = self.phase.inf().to_rational().floor().to_integer(); // exact: a whole number
        turn.to_i64().expect("forcing periods of a chain")
    }
}

/// A periodic orbit of a word, proved; in the units of the scene it is a [`MeasuredOrbit`](super::MeasuredOrbit).
///
/// **Enclosure**: for all parameters of the pair there is exactly one orbit of the word with its impacts in these
/// bounds (Lemma T3), and all enclosures are of it.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicOrbit {
    /// Forcing periods after which the excitation repeats: 1 with one harmonic.
    pub period: u32,
    /// The impacts, in time order, starting on the wall that the word starts on.
    pub impacts: Vec<PeriodicImpact>,
    /// `Some(true)`: no flight touches a wall before it ends; `Some(false)`: one does (Lemma T5).
    pub physical: Option<bool>,
    /// `Some(true)`: it is its own mirror image, half a period of the excitation later; `Some(false)`: it is not (Lemma T6).
    pub symmetric: Option<bool>,
    /// Number of times that the word runs through a shorter orbit: 1 when it does not (Lemma T6).
    pub repeats: Option<usize>,
    /// Trace of the product of the Jacobians (A.7) over the period.
    pub trace: Enclosure,
    /// Determinant of that product, `e^(2k)` (Lemma T4).
    pub determinant: Enclosure,
    /// The eigenvalues, the one of larger modulus first. **Equation** (38)
    pub eigenvalues: [Eigenvalue; 2],
    /// Proved stability (Lemma T4).
    pub stability: Stability,
    /// Bits of the proof: 53 in double precision.
    pub bits: u32,
    /// `true` if the enclosures are as narrow as requested.
    pub is_narrow: bool,
    /// The phases and the box in which there is no other orbit.
    pub(super) proved: Proved<Ball>,
}

impl PeriodicOrbit {
    /// Phases in forcing periods, impact by impact, in doubles.
    pub fn phases(&self) -> &[Ball] {
        &self.proved.at
    }

    /// Box of phases in which there is no other orbit of the word, in doubles.
    pub fn domain(&self) -> &[Ball] {
        &self.proved.domain
    }

    /// Holds the velocity `y'` just before an impact, in gap widths per forcing period, in doubles.
    pub(super) fn velocity(&self, impact: usize) -> Ball {
        let (mid, rad) = self.impacts[impact].velocity.mid_rad();
        Ball::new(mid, rad)
    }

    /// Whether all properties of the orbit are decided.
    pub fn is_decided(&self) -> bool {
        self.stability != Stability::Undecided
            && self.physical.is_some()
            && self.symmetric.is_some()
            && self.repeats.is_some()
    }
}

/// Results that one arithmetic proves of an orbit.
#[derive(Clone, Debug)]
pub struct Finding<N> {
    /// The enclosures of the phases, and the box in which there is no other orbit.
    pub proved: Proved<N>,
    /// Flights of the orbit: flight `i` goes from impact `i` to the next one.
    pub legs: Vec<Leg<N>>,
    /// The product of the Jacobians (A.7) over the period.
    pub monodromy: [[N; 2]; 2],
    /// Trace of the product.
    pub trace: N,
    /// See [`determinant`].
    pub determinant: N,
    /// The stability (Lemma T4).
    pub stability: Stability,
    /// `Some(true)`: no flight touches a wall before it ends; `Some(false)`: one does (Lemma T5).
    pub physical: Option<bool>,
}

impl<N: Enclosing> Finding<N> {
    /// Properties of the orbit in a proved box; `None` where an impact may be a graze.
    pub(super) fn new<S: Shaking<N>>(
        chain: &Chain,
        shaking: &S,
        proved: Proved<N>,
        is_physical: impl FnOnce(&[N], &Legs<N, S::Moment>) -> Option<bool>,
    ) -> Option<Self> {
        let legs = chain.legs(shaking, &proved.at)?;
        let monodromy = chain.monodromy(shaking, &legs)?;
        let trace = trace(&monodromy);
        let determinant = determinant(shaking.restitution(), chain.impacts());
        let stability = super::stability::stability(&trace, &determinant, shaking.restitution());
        let physical = is_physical(&proved.at, &legs);
        Some(Self { proved, legs: legs.legs, monodromy, trace, determinant, stability, physical })
    }

    /// `log2` of the widths of the widest phase, and of the widest velocity.
    pub(super) fn widths(&self) -> [f64; 2] {
        let velocities = self.legs.iter().map(|leg| leg.before.log2_radius());
        // shown: widths, not bounds
        [1.0 + widest(&self.proved.at), 1.0 + velocities.fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The orbit in intervals; `None` when an enclosure is not finite.
    pub(super) fn finish(
        &self,
        chain: &Chain,
        restitution: &Exact,
        bits: u32,
        is_narrow: bool,
    ) -> Option<PeriodicOrbit> {
        // More than the ends of these balls have.
        let room = bits + 160;
        let turns = whole_periods(chain, &self.proved.at[0].as_enclosure()?, room);
        let impact = |i: usize| {
            Some(PeriodicImpact {
                wall: chain.walls()[i],
                phase: self.proved.at[i].as_enclosure()?.sub(&turns, room),
                velocity: chain.before(&self.legs, i).as_enclosure()?,
            })
        };
        let trace = self.trace.as_enclosure()?;
        // Lemma T4, from the exact parameter.
        let power = i32::try_from(2 * chain.impacts()).ok()?;
        let determinant = restitution.enclose(room).powi(power, bits + 16)?;
        Some(PeriodicOrbit {
            period: chain.period(),
            impacts: (0..chain.impacts()).map(impact).collect::<Option<_>>()?,
            physical: self.physical,
            symmetric: is_symmetric(chain, &self.proved),
            repeats: repeats(chain, &self.proved),
            eigenvalues: eigenvalues(&trace, &determinant, room),
            trace,
            determinant,
            stability: self.stability,
            bits,
            is_narrow,
            proved: Proved {
                at: self.proved.at.iter().map(Enclosing::as_ball).collect(),
                domain: self.proved.domain.iter().map(inside_in_doubles).collect(),
            },
        })
    }
}

/// Whole forcing periods up to the beginning of the common period of the first impact.
pub(super) fn whole_periods(chain: &Chain, first: &Enclosure, bits: u32) -> Enclosure {
    let period = BigRational::from_integer(chain.period().into());
    let turns = (first.inf().to_rational() / &period).floor() * period; // exact: a whole number
    Enclosure::from_rational(&turns, bits)
}

/// A ball of doubles inside the ball, so that what holds no second orbit still holds none (Lemma T6); where there is no room for
/// one, a point.
fn inside_in_doubles<N: Enclosing>(x: &N) -> Ball {
    let inner = || {
        let (lo, hi) = x.as_enclosure()?.to_f64_bounds();
        let (lo, hi) = (lo.next_up(), hi.next_down());
        let mid = lo.midpoint(hi);
        let rad = (mid - lo).min(hi - mid).next_down(); // T6: inward
        (rad > 0.0).then(|| Ball::new(mid, rad)) // T6: nothing lies inside a point
    };
    inner().unwrap_or_else(|| Ball::exact(x.as_ball().mid()))
}
