//! Proofs of bifurcations: in doubles first, then in as many bits as the digits take. Lemmas Y3-Y5

mod precise;

use super::super::Precision;
use super::super::chain::Chain;
use super::super::chained::Moment;
use super::super::equations::flights;
use super::super::identity::is_symmetric;
use super::super::krawczyk::{self, Limits, MAX_RADIUS, Proved, widest};
use super::super::legs::Legs;
use super::super::orbit::{Finding, PeriodicImpact, PeriodicOrbit, whole_periods};
use super::super::precondition::Preconditioner;
use super::family::{Family, Unknown, Varied};
use super::follow::Change;
use super::over::Parameter;
use super::point::{Kind, Point};
use super::ring::Ring;
use super::solve::newton;
use super::system::{Critical, Graze, Posed, Releasing, System, Vanishing};
use super::trace::null_vector;
use crate::number::{Ball, Enclosing};
use crate::several::PhaseNumber;

/// The parameter that varies, and those that do not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting<'s, S> {
    pub unknown: Unknown,
    /// See [`Varied::at`].
    pub base: &'s S,
    pub parameter: &'s Parameter,
}

impl<S: Varied> Setting<'_, S> {
    /// The family in floating point.
    pub fn floats(&self) -> Family<S, f64> {
        Family { unknown: self.unknown, base: self.base.floats().clone() }
    }

    /// The family in doubles.
    pub fn doubles(&self) -> Family<S, Ball> {
        Family { unknown: self.unknown, base: self.base.balls().clone() }
    }
}

/// Proves the bifurcation that a change of sign near `x` suggests. Lemmas Y3-Y5
pub(super) fn prove<S: Varied>(
    setting: &Setting<'_, S>,
    ring: &Ring,
    (change, x): (Change, &[f64]),
    precision: Precision,
) -> Option<Point> {
    let (&p, phases) = x.split_last()?;
    let floats = setting.floats();
    let with = |between: &[f64]| [phases, between, &[p]].concat();
    let critical = |kind: Kind, mu: f64| {
        let direction = null_vector(ring, &floats, x, mu)?;
        prove_critical(setting, ring, (kind, mu, direction), x, precision)
    };
    match change {
        Change::Turn => critical(Kind::Fold, 1.0),
        Change::Flip if ring.is_mirrored() => critical(Kind::Pitchfork, -1.0),
        Change::Flip | Change::Join => critical(Kind::PeriodDoubling, -1.0),
        Change::Graze(nearest) => {
            let system = System::Graze(Graze { ring, leg: nearest.leg, wall: nearest.wall });
            Claim { setting, ring, kind: Kind::Graze, system, precision }.prove(with(&[nearest.phase]))
        }
        Change::Vanish(impact) => {
            let system = System::Vanishing(Vanishing { ring, impact });
            Claim { setting, ring, kind: Kind::Graze, system, precision }.prove(with(&[]))
        }
        Change::Release(impact) => {
            let system = System::Releasing(Releasing { ring, impact });
            Claim { setting, ring, kind: Kind::Graze, system, precision }.prove(with(&[]))
        }
    }
}

/// Proves the bifurcation with the eigenvalue `mu` near `x`, with a direction for `c`. Lemma Y3
pub(super) fn prove_critical<S: Varied>(
    setting: &Setting<'_, S>,
    ring: &Ring,
    (kind, mu, direction): (Kind, f64, Vec<f64>),
    x: &[f64],
    precision: Precision,
) -> Option<Point> {
    let (p, phases) = x.split_last()?;
    let guess = [phases, &direction, &[*p]].concat();
    let system = System::Critical(Critical { ring, mu, direction });
    Claim { setting, ring, kind, system, precision }.prove(guess)
}

/// The largest radius that is tried where doubles prove none, `2^-20`.
const MAX_RADIUS_BEYOND_DOUBLES: f64 = 1.0 / (1 << 20) as f64; // exact: a power of two

/// Domains that are tried, and images that narrow a zero at most: the first slow one is the last.
const MOST_DOMAINS: u32 = 14;
const MOST_IMAGES: u32 = 40;

/// A zero to prove, and the kind of bifurcation that it is.
struct Claim<'s, S> {
    setting: &'s Setting<'s, S>,
    ring: &'s Ring,
    kind: Kind,
    system: System<'s>,
    precision: Precision,
}

impl<S: Varied> Claim<'_, S> {
    /// Proves the bifurcation in doubles first, then in as many bits as the digits take.
    fn prove(&self, guess: Vec<f64>) -> Option<Point> {
        let floats = self.setting.floats();
        let guess = newton(&self.system, &floats, guess)?;
        let inverse = Preconditioner::new(&self.system.jacobian(&floats, &guess, false)?)?;
        let doubles: Vec<Ball> = guess.iter().map(|&x| Ball::exact(x)).collect();
        let family = self.setting.doubles();
        let bits = f64::MANTISSA_DIGITS;
        let zero = self.certify(&family, &inverse, doubles, (bits, MAX_RADIUS));
        // Doubles prove the largest domain; where they prove none, it is smaller than they can distinguish.
        let largest = zero.as_ref().map_or(MAX_RADIUS_BEYOND_DOUBLES, |zero| zero.domain[0].rad());
        let best = zero.and_then(|zero| self.point(&family, &zero, bits, S::is_physical));
        match best {
            Some(point) if point.is_narrow && point.is_decided() => Some(point),
            best => {
                let is_point = self.setting.base.is_point(self.setting.unknown);
                self.prove_precisely(&inverse, (&guess, largest), is_point, best)
            }
        }
    }

    /// Proves the zero near a guess in an arithmetic of `bits` bits; the largest domain that is tried has the radius `largest`.
    fn certify<N: Enclosing + PhaseNumber>(
        &self,
        family: &Family<S, N>,
        inverse: &Preconditioner,
        guess: Vec<N>,
        (bits, largest): (u32, f64),
    ) -> Option<Proved<N>> {
        let is_sparse = bits > f64::MANTISSA_DIGITS;
        let equations = Posed { system: &self.system, family, is_sparse };
        let guess = krawczyk::polish(&equations, inverse, guess, bits / krawczyk::PRECONDITIONED_GAIN_BITS);
        let limits = Limits { largest, domains: MOST_DOMAINS, images: MOST_IMAGES, slow: 0 };
        krawczyk::prove(&equations, inverse, &guess, limits)
    }

    /// Bifurcation at a proved zero; `None` where its orbit is not proved.
    fn point<N: Enclosing + PhaseNumber>(
        &self,
        family: &Family<S, N>,
        zero: &Proved<N>,
        bits: u32,
        is_physical: impl Fn(&S, &Chain, &[N], &Legs<N, Moment<S, N>>) -> Option<bool>,
    ) -> Option<Point> {
        let (ring, chain) = (self.ring, self.ring.chain());
        let p = zero.at.last()?;
        let phases = ring.lift(&zero.at[..ring.unknowns()]);
        let shaking = family.pair(p.clone());
        let legs = flights(chain, &shaking, &phases)?;
        if !self.system.holds(family, &zero.at) {
            return None;
        }
        // Radii may be far smaller than this arithmetic's unit where nothing is rounded.
        let parameter = p.as_enclosure()?.rounded(bits + 64);
        let (_, pair) = self.setting.parameter.in_units(&parameter, bits).ok()?;
        let shaken = S::of(&pair)?;
        let velocities: Vec<N> = legs.legs.iter().map(|leg| leg.before.clone()).collect();
        let is_narrow = self.is_narrow(&zero.at, shaken.speed(), &velocities);
        // The phases prove that views are apart; the domain of an extended system proves no two of them to be one.
        let proved = Proved { at: phases.clone(), domain: phases.clone() };
        let symmetric = if ring.is_mirrored() { Some(true) } else { is_symmetric(chain, &proved) };
        let orbit = Finding::new(chain, &shaking, proved, |phases, legs| match self.kind {
            Kind::Graze => None,
            _ => is_physical(&shaken, chain, phases, legs),
        })
        .and_then(|finding| finding.finish(chain, pair.restitution(), bits, is_narrow));
        // Lemma Y2 wants velocities that are not 0, and so does the Jacobian; Lemma Y4 an orbit that runs through no shorter one.
        if self.kind != Kind::Graze && orbit.as_ref().is_none_or(|orbit| orbit.repeats != Some(1)) {
            return None;
        }
        let orbit = orbit.map(|orbit| PeriodicOrbit { symmetric, ..orbit });
        let room = bits + 160;
        let turns = whole_periods(chain, &phases[0].as_enclosure()?, room);
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
            period: chain.period(),
            impacts: (0..chain.impacts()).map(impact).collect::<Option<_>>()?,
            symmetric,
            orbit,
            doublings: 0,
            bits,
            is_narrow,
            zero: zero.at.iter().map(Enclosing::as_enclosure).collect::<Option<_>>()?,
        })
    }

    /// Whether the widths are at most the requested ones, the parameter's relative to itself.
    fn is_narrow<N: Enclosing>(&self, at: &[N], speed: f64, velocities: &[N]) -> bool {
        // A radius is half of a width.
        let requested = self.precision.log2_width() - 1.0;
        let size = |x: &N| x.as_ball().mid().abs().log2();
        let (phases, p) = (&at[..self.ring.unknowns()], &at[at.len() - 1]);
        widest(phases) <= requested
            && p.log2_radius() <= requested + size(p)
            && widest(velocities) <= requested + speed.log2()
    }
}
