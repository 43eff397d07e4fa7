//! Proofs of bifurcations: in doubles first, then in as many bits as the digits take. Lemmas Y3-Y5

use std::cmp::Ordering;

use super::super::Precision;
use super::super::equations::flights;
use super::super::krawczyk::{self, Effort, LARGEST, Proved, widest};
use super::super::orbit::{Finding, PeriodicImpact, PeriodicOrbit};
use super::super::physical;
use super::super::precondition::Preconditioner;
use super::follow::Change;
use super::point::{Kind, Point};
use super::ring::Ring;
use super::solve::newton;
use super::system::{Critical, Family, Graze, Posed, System, Unknown, Vanishing};
use super::trace::null_vector;
use crate::contact::Court;
#[cfg(feature = "multiprecision")]
use crate::exact::working_bits;
use crate::exact::{Enclosure, Exact};
#[cfg(feature = "multiprecision")]
use crate::number::MpBall;
use crate::number::{Ball, Enclosing};
use crate::pair::{Inward, Reduced};

/// The parameters of a family, exactly.
#[derive(Clone, Debug)]
pub(super) struct Setting {
    pub unknown: Unknown,
    /// The one of `alpha` and `e` that does not vary.
    pub fixed: Exact,
}

impl Setting {
    /// In floats.
    pub fn floats(&self) -> Family<f64> {
        Family { unknown: self.unknown, fixed: self.doubles().fixed.mid() }
    }

    /// In doubles.
    pub fn doubles(&self) -> Family<Ball> {
        Family { unknown: self.unknown, fixed: Ball::of(&self.fixed) }
    }

    /// In so many bits.
    #[cfg(feature = "multiprecision")]
    pub fn balls(&self, bits: u32) -> Family<MpBall> {
        Family { unknown: self.unknown, fixed: MpBall::enclosing(&self.fixed.enclose(bits + 8), bits) }
    }
}

/// Proves the bifurcation that a change of sign near `x` suggests. Lemmas Y3-Y5
pub(super) fn prove(
    setting: &Setting,
    ring: &Ring,
    (change, x): (Change, &[f64]),
    precision: Precision,
) -> Option<Point> {
    let (&p, phases) = x.split_last()?;
    let floats = setting.floats();
    let with = |between: &[f64]| [phases, between, &[p]].concat();
    let critical = |kind: Kind, mu: f64| {
        let direction = null_vector(ring, &floats, x, mu)?;
        let guess = with(&direction);
        Claim { setting, ring, kind, system: Critical { ring, mu, direction }, precision }.prove(guess)
    };
    match change {
        Change::Turn => critical(Kind::Fold, 1.0),
        Change::Flip if ring.is_mirrored() => critical(Kind::Pitchfork, -1.0),
        Change::Flip | Change::Join => critical(Kind::PeriodDoubling, -1.0),
        Change::Graze(nearest) => {
            let system = Graze { ring, leg: nearest.leg, wall: nearest.wall };
            Claim { setting, ring, kind: Kind::Graze, system, precision }.prove(with(&[nearest.phase]))
        }
        Change::Vanish(impact) => {
            let system = Vanishing { ring, impact };
            Claim { setting, ring, kind: Kind::Graze, system, precision }.prove(with(&[]))
        }
    }
}

/// What else a system's zero has to satisfy.
pub(super) trait Condition: System {
    /// Whether what the equations leave open is as it has to be, proved.
    fn holds<N: Enclosing>(&self, pair: &Reduced<N>, x: &[N], phases: &[N]) -> bool;
}

impl Condition for Critical<'_> {
    /// `e > 0`, for Lemma Y2; velocities that are not 0 are asked for with the orbit.
    fn holds<N: Enclosing>(&self, pair: &Reduced<N>, _: &[N], _: &[N]) -> bool {
        pair.restitution.certain_sign() == Some(Ordering::Greater)
    }
}

impl Condition for Vanishing<'_> {
    fn holds<N: Enclosing>(&self, _: &Reduced<N>, _: &[N], _: &[N]) -> bool {
        true
    }
}

impl Condition for Graze<'_> {
    /// The touch lies inside its flight, and the ball comes from inside the gap: it is bent away from the wall. Lemma Y5
    fn holds<N: Enclosing>(&self, _: &Reduced<N>, x: &[N], phases: &[N]) -> bool {
        let at = &x[x.len() - 2];
        let chain = self.ring.chain();
        let next = match self.leg + 1 {
            end if end == chain.impacts() => phases[0].clone() + N::from_f64(f64::from(chain.cycles())),
            i => phases[i].clone(),
        };
        let is_later = |a: &N, b: &N| (a.clone() - b.clone()).certain_sign() == Some(Ordering::Greater);
        let bend = self.wall.inward(at.wave().0);
        is_later(at, &phases[self.leg]) && is_later(&next, at) && bend.certain_sign() == Some(Ordering::Greater)
    }
}

/// The largest radius that is tried where doubles prove none, `2^-20`.
const SMALL: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two

/// Domains that are tried, and images that narrow a zero at most: the first slow one is the last.
const MOST_DOMAINS: u32 = 14;
const MOST_IMAGES: u32 = 40;
/// Bits that an extended system loses besides: it is solved for a kernel as well.
#[cfg(feature = "multiprecision")]
const EXTENDED_BITS: u32 = 16;
/// Precisions that are tried beyond doubles, each twice the one before: twice is enough where the precision is what lacks.
#[cfg(feature = "multiprecision")]
const MOST_PRECISIONS: u32 = 3;

/// A zero to prove, and what it then is.
struct Claim<'s, S> {
    setting: &'s Setting,
    ring: &'s Ring,
    kind: Kind,
    system: S,
    precision: Precision,
}

impl<S: Condition> Claim<'_, S> {
    /// In doubles first, then in as many bits as the digits take.
    fn prove(&self, guess: Vec<f64>) -> Option<Point> {
        let floats = self.setting.floats();
        let guess = newton(&self.system, &floats, guess)?;
        let inverse = Preconditioner::new(&self.system.jacobian(&floats, &guess)?)?;
        let doubles: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        let family = self.setting.doubles();
        let bits = f64::MANTISSA_DIGITS;
        let zero = self.certify(&family, &inverse, doubles, (bits, LARGEST));
        // What doubles prove is the largest domain; where they prove none, it is smaller than they can tell.
        let largest = zero.as_ref().map_or(SMALL, |zero| zero.domain[0].rad());
        let best = zero.and_then(|zero| self.point(&family, &zero, bits, court_in_doubles));
        match best {
            Some(point) if point.is_narrow && point.is_decided() => Some(point),
            best => self.prove_precisely(&inverse, (&guess, largest), best),
        }
    }

    /// Proves the zero near a guess in an arithmetic of so many bits; the largest domain that is tried has the radius `largest`.
    fn certify<N: Enclosing>(
        &self,
        family: &Family<N>,
        inverse: &Preconditioner,
        guess: Vec<N>,
        (bits, largest): (u32, f64),
    ) -> Option<Proved<N>> {
        let equations = Posed { system: &self.system, family };
        let guess = krawczyk::polish(&equations, inverse, guess, bits / krawczyk::GAINED);
        let effort = Effort { largest, domains: MOST_DOMAINS, images: MOST_IMAGES, slow: 0 };
        krawczyk::prove(&equations, inverse, &guess, effort)
    }

    #[cfg(feature = "multiprecision")]
    fn prove_precisely(
        &self,
        inverse: &Preconditioner,
        (guess, largest): (&[f64], f64),
        best: Option<Point>,
    ) -> Option<Point> {
        let mut best = best;
        let mut bits = working_bits(self.precision.digits) + EXTENDED_BITS;
        for _ in 0..MOST_PRECISIONS {
            if bits > self.precision.max_bits {
                break;
            }
            let balls: Vec<MpBall> = guess.iter().map(|&x| MpBall::from_f64_bits(x, bits)).collect();
            let family = self.setting.balls(bits);
            let found = self
                .certify(&family, inverse, balls, (bits, largest))
                .and_then(|zero| self.point(&family, &zero, bits, court_in_balls));
            best = found.or(best);
            if best.as_ref().is_some_and(|point| point.is_narrow) || !self.setting.fixed.is_point() {
                break;
            }
            bits *= 2;
        }
        best
    }

    /// Doubles are all there is.
    #[cfg(not(feature = "multiprecision"))]
    fn prove_precisely(&self, _: &Preconditioner, _: (&[f64], f64), best: Option<Point>) -> Option<Point> {
        best
    }

    /// What a proved zero is.
    fn point<N: Enclosing>(
        &self,
        family: &Family<N>,
        zero: &Proved<N>,
        bits: u32,
        is_physical: impl Fn(&Ring, &Reduced<N>, &[N]) -> Option<bool>,
    ) -> Option<Point> {
        let (ring, chain) = (self.ring, self.ring.chain());
        let p = zero.at.last()?;
        let phases = ring.lift(&zero.at[..ring.unknowns()]);
        let pair = family.pair(p.clone());
        let legs = flights(chain, &pair, &phases)?;
        if !self.system.holds(&pair, &zero.at, &phases) {
            return None;
        }
        // Radii may be far smaller than this arithmetic's unit where nothing is rounded.
        let parameter = p.as_enclosure()?.rounded(bits + 64);
        let ends = [parameter.inf(), parameter.sup()].map(|end| Exact::from_rational(end.to_rational()));
        let restitution = match self.setting.unknown {
            Unknown::Ratio => self.setting.fixed.clone(),
            Unknown::Restitution => Exact::interval(&ends[0], &ends[1]).ok()?,
        };
        let velocities: Vec<N> = legs.legs.iter().map(|leg| leg.before.clone()).collect();
        let is_narrow = self.is_narrow(&zero.at, &pair, &velocities);
        // The phases prove that views are apart; the domain of an extended system proves no two of them to be one.
        let proved = Proved { at: phases.clone(), domain: phases.clone() };
        let physical = |phases: &[N]| if self.kind == Kind::Graze { None } else { is_physical(ring, &pair, phases) };
        let orbit = Finding::new(chain, &pair, proved, |phases, _| physical(phases))
            .and_then(|finding| finding.finish(chain, &restitution, bits, is_narrow));
        // Lemma Y2 wants velocities that are not 0, and so does the Jacobian.
        if self.kind != Kind::Graze && orbit.is_none() {
            return None;
        }
        let symmetric = if ring.is_mirrored() { Some(true) } else { orbit.as_ref().and_then(|orbit| orbit.symmetric) };
        let orbit = orbit.map(|orbit| PeriodicOrbit { symmetric, ..orbit });
        let room = bits + 160;
        // exact: a whole number
        let turns = Enclosure::from_rational(&phases[0].as_enclosure()?.inf().to_rational().floor(), room);
        let impact = |i: usize| {
            Some(PeriodicImpact {
                wall: chain.walls()[i],
                phase: phases[i].as_enclosure()?.sub(&turns, room).rounded(room),
                velocity: chain.before(&legs.legs, i).as_enclosure()?.rounded(room),
            })
        };
        Some(Point {
            kind: self.kind,
            parameter,
            word: ring.word(),
            cycles: chain.cycles(),
            impacts: (0..chain.impacts()).map(impact).collect::<Option<_>>()?,
            symmetric,
            orbit,
            doublings: 0,
            bits,
            is_narrow,
        })
    }

    /// Whether the widths are those asked for: the parameter's relative to itself.
    fn is_narrow<N: Enclosing>(&self, at: &[N], pair: &Reduced<N>, velocities: &[N]) -> bool {
        // A radius is half of a width.
        let asked = self.precision.log2_width() - 1.0;
        let size = |x: &N| x.as_ball().mid().abs().log2();
        let (phases, p) = (&at[..self.ring.unknowns()], &at[at.len() - 1]);
        widest(phases) <= asked && p.log2_radius() <= asked + size(p) && widest(velocities) <= asked + size(&pair.beta)
    }
}

fn court_in_doubles(ring: &Ring, pair: &Reduced<Ball>, phases: &[Ball]) -> Option<bool> {
    let legs = ring.chain().legs(pair, phases)?;
    physical::is_physical(&Court::new(*pair), ring.chain(), phases, &legs)
}

#[cfg(feature = "multiprecision")]
fn court_in_balls(ring: &Ring, pair: &Reduced<MpBall>, phases: &[MpBall]) -> Option<bool> {
    let legs = ring.chain().legs(pair, phases)?;
    let court = Court::new(pair.map(Enclosing::as_ball));
    physical::is_physical_precisely(&court, pair, ring.chain(), phases, &legs)
}
