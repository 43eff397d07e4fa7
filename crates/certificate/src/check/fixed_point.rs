//! The periodic orbit in an ellipse that the period contracts, to the requested width, and its claimed properties (Lemma V6).

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;

use super::affine::Affine;
use super::basin::{Contraction, Ellipse};
use super::contact::Doubt;
use super::excursion::leaves_the_gap;
use super::round::{Matrix, Round};
use super::step::{Landing, Launch};
use impact_pair_exact::Real;

/// An eigenvalue: real and imaginary part.
pub(super) type Eigenvalue = [Real; 2];

/// Number of ellipses that are tried.
const MAX_ELLIPSES: u32 = 12;
/// Bits by which the first ellipse exceeds the rounding of its centre.
const SPARE_BITS: i64 = 40;

/// The orbit of a basin, or the orbits of a box.
pub(super) struct FixedPoint<'r> {
    round: &'r Round<'r>,
    /// The ellipse in which there is no other orbit.
    basin: Option<&'r Ellipse>,
    /// The impacts in one period; the last is the next first impact.
    landings: Vec<Landing>,
    /// Derivative of the period, up to coordinates: the trace is the same.
    derivative: Matrix,
    /// True if the orbit is known to be its own mirror image.
    is_mirrored: bool,
}

impl<'r> FixedPoint<'r> {
    /// Encloses the orbit with the bits of `centre`, where Newton's iteration ended.
    pub fn enclosed(round: &'r Round<'r>, basin: &'r Ellipse, centre: &[Real; 2]) -> Result<Self, Doubt> {
        let open = || Doubt::open("the orbit is not enclosed");
        let mut size = SPARE_BITS - i64::from(centre[0].bits());
        for _ in 0..MAX_ELLIPSES {
            let ellipse = basin.around(centre.clone(), size).ok_or_else(open)?;
            let contraction = ellipse.contracted(round)?;
            if contraction.is_proved() {
                // An orbit in both sets is the only one of either.
                let is_it = basin.holds(&contraction.landings[0]);
                let Contraction { landings, derivative, .. } = contraction;
                let orbit = Self { round, basin: Some(basin), landings, derivative, is_mirrored: false };
                return if is_it { Ok(orbit) } else { Err(open()) };
            }
            size += contraction.larger_by();
        }
        Err(open())
    }

    /// The orbits whose impacts are in given sets; `is_mirrored` if they are known to be their own mirror images.
    pub fn of_box(round: &'r Round<'r>, landings: Vec<Landing>, derivative: Matrix, is_mirrored: bool) -> Self {
        Self { round, basin: None, landings, derivative, is_mirrored }
    }

    /// The impacts of one period.
    pub fn impacts(&self) -> &[Landing] {
        &self.landings[..self.round.walls.len()]
    }

    /// Proves that the flights are admissible or virtual as claimed. Flights with proved first contacts are admissible; of a virtual orbit
    /// a flight is proved to lie beyond a wall before its contact. Lemma V8
    pub fn is_physical_as(&self, claimed: Option<bool>) -> Result<(), Doubt> {
        if claimed != Some(false) {
            return Ok(());
        }
        let (round, landings) = (self.round, &self.landings);
        let is_beyond = |i: usize| {
            let departure = Launch::rebound(round.parameters, &landings[i]);
            let end = landings[i + 1].phase.hull() - &landings[i].phase.hull();
            let end = if i + 2 == landings.len() { end + &round.lasting } else { end };
            let [end, _] = end.ends();
            leaves_the_gap(&departure.flights(round.parameters), &end)
        };
        if (0..landings.len() - 1).any(is_beyond) {
            return Ok(());
        }
        Err(Doubt::open("no earlier contact is proved"))
    }

    /// Phases shifted by whole common periods to be nearest to `other`.
    pub fn near(&self, phases: &Affine, other: &Real) -> Option<Affine> {
        self.round.near(phases, other)
    }

    /// Encloses the trace of the derivative of the period. **Equation** (38)
    pub fn trace(&self) -> Real {
        let [[a, _], [_, d]] = &self.derivative;
        a.clone() + d
    }

    /// Proves the claim that the orbit is, or is not, its own mirror image. A claimed symmetry of a basin whose flights are not proved to
    /// be motions is not checked, since mirror images need not be flights of the basin: `unjudged` names that claim.
    pub fn is_symmetric_as(&self, claimed: bool, has_mirror: Option<bool>) -> Result<(), Doubt> {
        let is_judged = self.round.is_physical || self.basin.is_none();
        match self.is_symmetric(has_mirror).filter(|&found| is_judged || !found) {
            Some(found) if found != claimed => {
                Err(Doubt::False("whether the orbit is symmetric is claimed wrongly".into()))
            }
            None if is_judged => Err(Doubt::open("it is not decided whether the orbit is symmetric")),
            _ => Ok(()),
        }
    }

    /// Whether the orbit is a motion that is proved to be its own mirror image. Lemma V8
    pub fn is_a_symmetric_motion(&self, has_mirror: Option<bool>) -> bool {
        self.round.is_physical && self.is_symmetric(has_mirror) == Some(true)
    }

    /// Whether the orbit is its own mirror image half a common period later; `has_mirror`: the forcing changes sign then, if decided.
    fn is_symmetric(&self, has_mirror: Option<bool>) -> Option<bool> {
        if self.is_mirrored {
            return Some(true);
        }
        let has_mirror = has_mirror?;
        let half = self.round.common.half();
        let minus = Real::int(-1, half.bits());
        let mirrored = |Landing { wall, phase, velocity, .. }: &Landing| {
            let velocity = Affine::of(-velocity.centre.clone(), &[(&minus, velocity)]);
            Landing::new(wall.other(), phase.clone().shifted(&half), velocity)
        };
        let seen = if has_mirror { self.impacts() } else { &[] };
        let seen: Vec<_> = seen.iter().map(mirrored).collect();
        let verdicts: Vec<_> =
            (0..seen.len()).filter(|&i| fits(&seen, i, self.impacts())).map(|i| self.is_first(&seen[i])).collect();
        if verdicts.contains(&Some(true)) { Some(true) } else { verdicts.iter().all(Option::is_some).then_some(false) }
    }

    /// Proves that the orbit runs `claimed` times through a shorter orbit in `periods` common periods; 1 if there is no shorter orbit. For a
    /// basin whose flights are not proved to be motions, equal states need not have equal futures: `unjudged` names that claim. Lemma V8
    pub fn runs_as(&self, claimed: u32, periods: &BigInt) -> Result<(), Doubt> {
        match self.times(periods) {
            Some(times) if times == u64::from(claimed) => Ok(()),
            Some(1) => Err(Doubt::False("the orbit is no shorter one several times".into())),
            Some(times) => Err(Doubt::False(format!("the orbit is a shorter one {times} times"))),
            None if claimed > 1 && !self.round.is_physical && self.basin.is_some() => Ok(()),
            None => Err(Doubt::open("it is not proved how often the orbit runs through a shorter one")),
        }
    }

    /// How often the orbit runs through a shorter orbit in `periods` common periods; `None` if undecided. Lemma V8
    fn times(&self, periods: &BigInt) -> Option<u64> {
        let impacts = self.impacts();
        let divides = |times: &usize| impacts.len().is_multiple_of(*times) && periods.is_multiple_of(&(*times).into());
        for times in (2..=impacts.len()).rev().filter(divides) {
            let shift = impacts.len() / times; // exact: it divides
            if fits(impacts, shift, impacts) {
                match self.is_first(&impacts[shift]) {
                    Some(true) if self.round.is_physical => return Some(times as u64), // exact: a length
                    Some(false) => {}
                    _ => return None,
                }
            }
        }
        Some(1)
    }

    /// Whether a state of a periodic orbit of the same word, shifted by whole common periods, is the first impact's state.
    fn is_first(&self, state: &Landing) -> Option<bool> {
        let first = &self.impacts()[0];
        let state = Landing { phase: self.round.near(&state.phase, &first.phase.centre)?, ..state.clone() };
        if self.basin.is_some_and(|basin| basin.holds(&state)) {
            return Some(true);
        }
        let off = [(&state.phase, &first.phase), (&state.velocity, &first.velocity)].map(|(x, y)| x.hull() - &y.hull());
        let common = &self.round.common;
        let is_within = off[0].is_below(common) && (-off[0].clone()).is_below(common);
        let is_off = |x: &Real| x.is_positive() || x.is_negative();
        (is_within && is_off(&off[0]) || is_off(&off[1])).then_some(false)
    }
}

/// Whether the walls of `seen`, from impact `shift` on, are the walls of `impacts`.
fn fits(seen: &[Landing], shift: usize, impacts: &[Landing]) -> bool {
    let later = seen.iter().cycle().skip(shift);
    impacts.iter().zip(later).all(|(impact, later)| impact.wall == later.wall)
}

/// Encloses both eigenvalues; where they may be real or complex, in either case. **Equation** (38)
pub(super) fn eigenvalues(trace: &Real, determinant: &Real) -> [Eigenvalue; 2] {
    let zero = Real::zero(trace.bits());
    let middle = trace.half();
    let under = middle.square() - determinant;
    let root = |x: &Real| x.sqrt().unwrap_or_else(|| zero.clone());
    let (re, im) = match under.sign() {
        Some(Ordering::Greater | Ordering::Equal) => (root(&under), zero.clone()),
        Some(Ordering::Less) => (zero.clone(), root(&-under)),
        None => (root(&under).hull(&zero), root(&-under).hull(&zero)),
    };
    let [one, other] = [middle.clone() + &re, middle - &re];
    // The eigenvalue of larger modulus first; the other by the determinant, without cancellation.
    let (large, small) = if trace.is_negative() { (other, one) } else { (one, other) };
    let small = if im.is_zero() {
        determinant.over(&large).map_or(small.clone(), |quotient| small.cut(&quotient))
    } else {
        small
    };
    [[large, im.clone()], [small, -im]]
}
