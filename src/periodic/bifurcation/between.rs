//! All orbits of a branch between the two ends of a window, proved to be stable: one curve through a known orbit. Lemmas Y8, Y9
//!
//! From each end, where an eigenvalue is 1 or -1, the branch is followed as a curve over that eigenvalue; between, where the eigenvalues may be
//! complex, as a curve of orbits that have neither 1 nor -1 for an eigenvalue.

use std::cmp::Ordering;

use super::super::chained::{Chained, OneHarmonic};
use super::super::determinant;
use super::super::entries::Entries;
use super::super::equations::flights;
use super::super::krawczyk::{Equations, image_by_doubles, is_inside};
use super::super::orbit::PeriodicOrbit;
use super::super::precondition::Preconditioner;
use super::claim::Setting;
use super::family::{Family, Varied};
use super::point::Point;
use super::ring::Ring;
use super::system::{Curve, Multiplied, System};
use super::trace::{null_vector, twisted_matrix};
use super::tube::{Proof, SlabChain, take_time};
use crate::exact::{Enclosure, Exact};
use crate::number::{Ball, Enclosing};
use crate::several::PhaseNumber;
use crate::watch::Watch;

/// A window relatively narrower is proved in more bits than doubles have, where there are such.
const DOUBLES_WIDTH: f64 = 1e-10;
/// Steps to the centre of a slab, and the length that is added to radii, in doubles.
const STEPS: u32 = 12;
const PAD: f64 = 1e-14;
/// Bits of values in which doubles are exceeded.
pub(super) const BITS: u32 = 128;

/// An end of the branch: the bifurcation there, and the orbits from it to the middle.
pub(super) struct Reached<'b> {
    /// The orbits from the bifurcation on, each with its eigenvalue.
    pub stations: &'b [(f64, Vec<f64>)],
    pub point: &'b Point,
    /// `c` of the equations of both.
    pub direction: &'b [f64],
    /// The eigenvalue at the bifurcation.
    pub mu: f64,
}

/// An orbit proved at a value of the parameter, which is without units.
pub(super) struct Known<'b> {
    pub parameter: Exact,
    pub orbit: &'b PeriodicOrbit,
}

/// The statement to prove: all orbits of the branch between two ends are stable, and the known orbit is one of them.
pub(super) struct Between<'b> {
    pub setting: &'b Setting<'b, OneHarmonic>,
    pub ring: &'b Ring,
    pub ends: [Reached<'b>; 2],
    /// The branch in floating point between the innermost stations of both.
    pub middle: &'b [Vec<f64>],
    pub known: Known<'b>,
    pub watch: &'b dyn Watch,
}

impl Between<'_> {
    /// Proves the statement, in doubles unless the window is relatively narrow, or gives the step that fails. Lemmas Y8, Y9
    pub fn prove(&self, width: f64) -> Result<(), &'static str> {
        let doubles = self.setting.doubles();
        let of_ball = |x: &Enclosure| {
            let (mid, rad) = x.mid_rad();
            Ball::new(mid, rad)
        };
        if width > DOUBLES_WIDTH && self.prove_in(&doubles, (STEPS, PAD), &of_ball).is_ok() {
            return Ok(());
        }
        self.prove_precisely()
    }

    /// Proves the statement in one arithmetic.
    pub fn prove_in<N: Enclosing + PhaseNumber>(
        &self,
        family: &Family<OneHarmonic, N>,
        (steps, pad): (u32, f64),
        of: &dyn Fn(&Enclosure) -> N,
    ) -> Result<(), &'static str> {
        let outer = |i: usize| self.outer(family, (steps, pad), &self.ends[i], of);
        let one = outer(0).ok_or("the orbits next to the fold are not proved")?;
        let other = outer(1).ok_or("the orbits next to the loss of stability are not proved")?;
        let floats = self.setting.floats();
        let holds =
            |x: &[N]| self.is_admissible(family, x) && [1.0, -1.0].iter().all(|mu| self.excludes(family, x, *mu));
        let tube = SlabChain {
            curve: &System::Curve(Curve(self.ring)),
            over: None,
            floats: &floats,
            family,
            steps,
            pad,
            holds: &holds,
            watch: self.watch,
        };
        let middle = "the orbits in the middle are not proved";
        let known = self.known(of).ok_or(middle)?;
        let slabs = tube.follow(&self.stations(&known)).ok_or(middle)?;
        let reaches = |point: &[N]| slabs.iter().any(|slab| slab.holds(point));
        if !(reaches(&one) && reaches(&other)) {
            return Err(middle);
        }
        if !reaches(&known) {
            return Err("the orbit is not proved to be one of those between the ends");
        }
        Ok(())
    }

    /// The phases of the known orbit up to whole forcing periods, and the parameter.
    fn known<N: Enclosing>(&self, of: &dyn Fn(&Enclosure) -> N) -> Option<Vec<N>> {
        let (impacts, near) = (&self.known.orbit.impacts, self.middle.first()?[0]);
        let first = impacts[0].phase.mid_rad().0;
        let turns = N::from_f64((near - first).round()); // T6: any whole number of periods, exact
        let phases = impacts[..self.ring.unknowns()].iter().map(|impact| of(&impact.phase) + turns.clone());
        Some(phases.chain([of(&self.known.parameter.enclose(BITS))]).collect())
    }

    /// The stations of the middle with the known orbit, in order along the branch. It proposes
    fn stations<N: Enclosing>(&self, known: &[N]) -> Vec<Vec<f64>> {
        let known: Vec<f64> = known.iter().map(|x| x.as_ball().mid()).collect();
        let (first, last) = (&self.middle[0], &self.middle[self.middle.len() - 1]);
        let along =
            |x: &[f64]| -> f64 { x.iter().zip(first.iter().zip(last)).map(|(x, (a, b))| (x - a) * (b - a)).sum() };
        let mut all: Vec<Vec<f64>> = self.middle.iter().cloned().chain([known]).collect();
        all.sort_by(|a, b| along(a).total_cmp(&along(b)));
        all.dedup();
        all
    }

    /// Proves the orbits over an eigenvalue, from the bifurcation at the end of a window to the middle; the phases and the parameter at
    /// the inner end, where `|mu| < 1` is proved. Lemma Y8
    fn outer<N: Enclosing + PhaseNumber>(
        &self,
        family: &Family<OneHarmonic, N>,
        (steps, pad): (u32, f64),
        end: &Reached<'_>,
        of: &dyn Fn(&Enclosure) -> N,
    ) -> Option<Vec<N>> {
        let (ring, floats) = (self.ring, self.setting.floats());
        let direction = end.direction;
        let lift = |(mu, x): &(f64, Vec<f64>)| -> Option<Vec<f64>> {
            let w = null_vector(ring, &floats, x, *mu)?;
            let along: f64 = w.iter().zip(direction).map(|(a, b)| a * b).sum();
            let (p, phases) = x.split_last()?;
            let w = w.iter().map(|w| w / along);
            Some(phases.iter().copied().chain(w).chain([*p, *mu]).collect())
        };
        let lifted: Vec<Vec<f64>> = end.stations.iter().map(lift).collect::<Option<_>>()?;
        let curve = System::Multiplied(Multiplied { ring, direction: direction.to_vec() });
        let project = |x: &[N]| -> Vec<N> { [&x[..ring.unknowns()], &x[x.len() - 2..x.len() - 1]].concat() };
        let holds = |x: &[N]| self.is_admissible(family, &project(x)) && self.is_dominant(family, x);
        // Over mu, the last unknown.
        let over = Some(2 * ring.unknowns() + 1);
        let tube =
            SlabChain { curve: &curve, over, floats: &floats, family, steps, pad, holds: &holds, watch: self.watch };
        let slabs: Vec<Proof<N>> = tube.follow(&lifted)?;
        let mut zero: Vec<N> = end.point.zero.iter().map(of).collect();
        zero.push(N::from_f64(end.mu));
        let inner = &slabs[slabs.len() - 1].end;
        let mu = inner.last()?;
        let is_stable = [1.0, -1.0].iter().all(|&sign| is_positive(N::from_f64(1.0) - mu.clone().signed(sign)));
        (is_stable && slabs.first()?.holds(&zero)).then(|| project(inner))
    }

    /// Whether the other eigenvalue is proved to lie inside the unit circle for each member of a box: `e^(2m) < |mu|`. Lemma Y8
    fn is_dominant<N: Enclosing + PhaseNumber>(&self, family: &Family<OneHarmonic, N>, x: &[N]) -> bool {
        let (mu, p) = (&x[x.len() - 1], &x[x.len() - 2]);
        let q = determinant(&family.pair(p.clone()).restitution, self.ring.unknowns());
        let sign = if mu.as_ball().mid() < 0.0 { -1.0 } else { 1.0 }; // Y8: of the wrong sign it is not larger
        is_positive(mu.clone().signed(sign) - q)
    }

    /// Whether the assumptions of the lemma are proved for each member of a box of phases and a parameter: flights that take time, to their
    /// first contacts, and `0 < e < 1`. Lemma Y8
    fn is_admissible<N: Enclosing + PhaseNumber>(&self, family: &Family<OneHarmonic, N>, x: &[N]) -> bool {
        let e = x.last().map(|p| family.pair(p.clone()).restitution);
        e.is_some_and(|e| is_positive(e.clone()) && is_positive(N::from_f64(1.0) - e))
            && take_time(self.ring, family, x)
            && self.is_physical(x)
    }

    /// Whether no orbit of a box is proved to have the eigenvalue `mu`, 1 or -1: `F'_mu` is regular. Lemma Y8
    fn excludes<N: Enclosing + PhaseNumber>(&self, family: &Family<OneHarmonic, N>, x: &[N], mu: f64) -> bool {
        let ring = self.ring;
        let centre: Vec<f64> = x.iter().map(|x| x.as_ball().mid()).collect();
        let regular = || {
            let inverse = Preconditioner::new(&twisted_matrix(ring, &self.setting.floats(), &centre, &mu)?)?;
            let matrix = twisted_matrix(ring, family, x, &N::from_f64(mu))?;
            // Any lengths of the coordinates: those of the box.
            let unit = |x: &N| N::from_f64(0.0).with_radius(x.as_ball().rad());
            let all: Vec<N> = x[..ring.unknowns()].iter().map(unit).collect();
            Some(is_inside(&image_by_doubles(&Linear(matrix), &inverse, &all)?, &all))
        };
        regular().unwrap_or(false) // exact: not proved
    }

    /// Whether each flight of the orbits of a box of phases and a parameter is proved to end at its first contact. Lemma T5
    fn is_physical<N: Enclosing>(&self, x: &[N]) -> bool {
        let balls: Vec<Ball> = x.iter().map(Enclosing::as_ball).collect();
        let proved = || {
            let (p, phases) = balls.split_last()?;
            let (_, pair) = self.setting.parameter.in_units(&p.as_enclosure()?, f64::MANTISSA_DIGITS).ok()?;
            let there = <OneHarmonic as Varied>::of(&pair)?;
            let (chain, phases) = (self.ring.chain(), self.ring.lift(phases));
            let legs = flights(chain, &self.setting.doubles().pair(*p), &phases)?;
            there.is_physical(chain, &phases, &legs)
        };
        proved() == Some(true)
    }
}

/// Whether a value is proved to be positive.
fn is_positive<N: Enclosing>(x: N) -> bool {
    x.certain_sign() == Some(Ordering::Greater)
}

/// The equations `L w = 0`.
struct Linear<N>(Entries<N>);

impl<N: Enclosing> Equations<N> for Linear<N> {
    /// At 0.
    fn values(&self, x: &[N]) -> Option<Vec<N>> {
        Some(x.iter().map(|_| N::from_f64(0.0)).collect())
    }

    fn jacobian(&self, _: &[N]) -> Option<Entries<N>> {
        Some(self.0.clone())
    }
}
