//! A followed curve proved to be one curve: Krawczyk's operator on slabs across it, each glued to the next. Lemmas Y6, Y8

use super::super::equations::flights;
use super::super::krawczyk::{image_by_doubles, is_inside, polish, widest};
use super::super::precondition::Preconditioner;
use super::family::{Family, Varied};
use super::ring::Ring;
use super::system::{Curve, Posed, Shape, System};
use super::trace::{Station, correct_onto};
use crate::number::{Ball, Enclosing};
use crate::several::PhaseNumber;
use crate::watch::Watch;

/// Curve whose slabs are proved, and the settings of the proofs.
pub(super) struct SlabChain<'t, S: Varied, N: PhaseNumber> {
    /// One equation fewer than unknowns.
    pub curve: &'t System<'t>,
    /// The coordinate over which it is followed; across the way from station to station where there is none.
    pub over: Option<usize>,
    pub floats: &'t Family<S, f64>,
    pub family: &'t Family<S, N>,
    /// Steps of simplified Newton's iteration to the centre of a slab, beyond floating point.
    pub steps: u32,
    /// Length that is added to the radii of the first box that is tried; a tenth of it is added to later boxes.
    pub pad: f64,
    /// The condition that also has to hold on the domain of a slab.
    pub holds: &'t dyn Fn(&[N]) -> bool,
    pub watch: &'t dyn Watch,
}

/// The part of a curve between two planes: `F = 0`, `a (x - x0) = t`, for all `|t| <= tau`.
pub(super) struct Slab<'c> {
    curve: &'c System<'c>,
    base: Vec<f64>,
    along: Vec<f64>,
    tau: f64,
    /// The `t` of the station it goes to, less than `tau`.
    end: f64,
}

/// Boxes tried for a slab.
const MOST_BOXES: u32 = 8;
/// Images at most that narrow the end of a slab, so that a much shorter one may follow, and bits that each but the last takes off its widest
/// radius.
const END_IMAGES: u32 = 40;
const END_GAIN: f64 = 0.25;
/// Halvings of the way between two stations.
const MOST_HALVINGS: u32 = 12;
/// Overlap of a slab beyond each of its two stations, in parts of the way between them.
const OVERLAP: f64 = 0.02;

impl Shape for Slab<'_> {
    fn unknowns(&self) -> usize {
        self.base.len()
    }

    fn contains(&self, i: usize, j: usize) -> bool {
        i + 1 < self.base.len() && self.curve.shape().contains(i, j)
    }

    fn linear(&self, i: usize) -> Option<Vec<f64>> {
        if i + 1 == self.base.len() { Some(self.along.clone()) } else { self.curve.shape().linear(i) }
    }
}

impl Slab<'_> {
    /// See [`System::values`], with `t = 0`.
    pub fn values<S: Varied, N: PhaseNumber>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let mut values = self.curve.values(family, x)?;
        values.push(self.distance(x));
        Some(values)
    }

    /// `a (x - x0)`
    fn distance<N: PhaseNumber>(&self, x: &[N]) -> N {
        let add = |sum: N, ((a, c), x): ((&f64, &f64), &N)| N::from_f64(*a).mul_add(x.clone() - N::from_f64(*c), sum);
        self.along.iter().zip(&self.base).zip(x).fold(N::from_f64(0.0), add)
    }
}

/// A slab proved: for each `t` exactly one point of the curve lies in `domain`; the point at the station at the slab's end lies in `end`.
pub(super) struct Proof<N> {
    base: Vec<f64>,
    along: Vec<f64>,
    tau: f64,
    domain: Vec<N>,
    pub end: Vec<N>,
}

impl<N: Enclosing + PhaseNumber> Proof<N> {
    /// Whether points of the curve are proved to lie in the proved part of the slab: then they are on its curve.
    pub fn holds(&self, points: &[N]) -> bool {
        let add = |sum: N, ((a, c), x): ((&f64, &f64), &N)| N::from_f64(*a).mul_add(x.clone() - N::from_f64(*c), sum);
        let t = self.along.iter().zip(&self.base).zip(points).fold(N::from_f64(0.0), add);
        is_inside(points, &self.domain) && t.is_interior_to(&N::from_f64(0.0).with_radius(self.tau))
    }
}

impl<S: Varied, N: Enclosing + PhaseNumber> SlabChain<'_, S, N> {
    /// Proves the curve from the first station to the last one: its slabs in order; `None` where it is not proved, or the watch stops it.
    pub fn follow(&self, stations: &[Vec<f64>]) -> Option<Vec<Proof<N>>> {
        let mut slabs = Vec::new();
        for ends in stations.windows(2) {
            self.watch.goes_on().then_some(())?;
            self.bridge([&ends[0], &ends[1]], &mut slabs, 0)?;
        }
        // Of a single station nothing is proved.
        (!slabs.is_empty()).then_some(slabs)
    }

    /// Proves the way between two points of the curve and glues it to the last slab; halves it where that fails.
    fn bridge(&self, [a, b]: [&[f64]; 2], slabs: &mut Vec<Proof<N>>, halvings: u32) -> Option<()> {
        let part = |i: usize| if self.over.is_none_or(|over| over == i) { b[i] - a[i] } else { 0.0 };
        let chord: Vec<f64> = (0..a.len()).map(part).collect();
        let length = chord.iter().map(|c| c * c).sum::<f64>().sqrt();
        let along: Vec<f64> = chord.iter().map(|c| c / length).collect();
        let middle: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
        let corrected = correct_onto(self.curve, self.floats, &middle, &along);
        let base = if self.steps == 0 { corrected? } else { corrected.unwrap_or(middle) }; // proposes: where a slab is tried
        let (tau, end) = ((0.5 + OVERLAP) * length, 0.5 * length);
        let proof = self.prove(&Slab { curve: self.curve, base: base.clone(), along, tau, end });
        if let Some(proof) = proof.filter(|proof| slabs.last().is_none_or(|last| proof.holds(&last.end))) {
            slabs.push(proof);
            return Some(());
        }
        if halvings >= MOST_HALVINGS || !self.watch.goes_on() {
            return None;
        }
        self.bridge([a, &base], slabs, halvings + 1)?;
        self.bridge([&base, b], slabs, halvings + 1)
    }

    /// Proves a slab in a box that is widened until its image lies inside.
    fn prove(&self, slab: &Slab<'_>) -> Option<Proof<N>> {
        let mut at: Vec<f64> = slab.base.clone();
        let system = System::Slab(slab);
        let inverse_at = |at: &[f64]| Preconditioner::new(&system.jacobian(self.floats, at, false)?);
        let mut inverse = inverse_at(&at)?;
        let mut centre: Vec<N> = at.iter().map(|&x| N::from_f64(x)).collect();
        if self.steps > 0 {
            let posed = Posed { system: &system, family: self.family, is_sparse: true };
            centre = polish(&posed, &inverse, centre, self.steps);
            at = centre.iter().map(|x| x.as_ball().mid()).collect();
            inverse = inverse_at(&at)?;
        }
        let last = centre.len() - 1;
        let all = slab.tau;
        let size = |i: usize| inverse.row(i)[last].abs() * slab.tau;
        let first = |(i, x): (usize, &N)| x.with_radius(1.1f64.mul_add(size(i), self.pad));
        let mut domain: Vec<N> = centre.iter().enumerate().map(first).collect();
        for _ in 0..MOST_BOXES {
            let found = self.image(slab, &inverse, &domain, N::from_f64(0.0).with_radius(all))?;
            if is_inside(&found, &domain) {
                (self.holds)(&domain).then_some(())?;
                let end = self.end(slab, &inverse, found)?;
                let Slab { base, along, tau, .. } = slab;
                let (base, along, tau) = (base.clone(), along.clone(), *tau);
                return is_inside(&end, &domain).then_some(Proof { base, along, tau, domain, end });
            }
            let wider = |(k, x): (&N, &N)| {
                let off = (k.clone() - x.clone()).as_ball();
                x.with_radius(1.2f64.mul_add(off.mid().abs() + off.rad(), 0.1 * self.pad))
            };
            domain = found.iter().zip(&centre).map(wider).collect();
        }
        None
    }

    /// Narrows the point of the curve at the end of a slab, from a box that holds it, as far as this arithmetic does.
    fn end(&self, slab: &Slab<'_>, inverse: &Preconditioner, mut end: Vec<N>) -> Option<Vec<N>> {
        for _ in 0..END_IMAGES {
            let narrower = self.image(slab, inverse, &end, N::from_f64(slab.end))?;
            let gain = widest(&end) - widest(&narrower);
            end = narrower;
            // proposes: when to stop
            if gain.is_nan() || gain <= END_GAIN {
                break;
            }
        }
        Some(end)
    }

    /// Krawczyk's image for all `t` of a ball.
    fn image(&self, slab: &Slab<'_>, inverse: &Preconditioner, x: &[N], t: N) -> Option<Vec<N>> {
        let last = x.len() - 1;
        let system = System::Slab(slab);
        let posed = Posed { system: &system, family: self.family, is_sparse: self.steps > 0 };
        let still = image_by_doubles(&posed, inverse, x)?;
        let moved = |(i, k): (usize, N)| N::from_f64(inverse.row(i)[last]).mul_add(t.clone(), k);
        Some(still.into_iter().enumerate().map(moved).collect())
    }
}

/// Radii added to boxes of the slabs of a branch in doubles.
const PAD: f64 = 1e-12;

/// Whether the stations' branch is proved to be one curve of orbits, each the only one near it, unless the watch stops the proof. Lemma Y6
pub(super) fn is_one_curve<S: Varied>(
    ring: &Ring,
    (floats, family): (&Family<S, f64>, &Family<S, Ball>),
    stations: &[Station],
    watch: &dyn Watch,
) -> bool {
    let holds = |domain: &[Ball]| take_time(ring, family, domain);
    let tube = SlabChain {
        curve: &System::Curve(Curve(ring)),
        over: None,
        floats,
        family,
        steps: 0,
        pad: PAD,
        holds: &holds,
        watch,
    };
    let stations: Vec<Vec<f64>> = stations.iter().map(|station| station.x.clone()).collect();
    tube.follow(&stations).is_some()
}

/// Whether all flights over a box of phases and a parameter are proved to take time.
pub(super) fn take_time<S: Varied, N: Enclosing + PhaseNumber>(ring: &Ring, family: &Family<S, N>, x: &[N]) -> bool {
    let flown = || {
        let (p, phases) = x.split_last()?;
        flights(ring.chain(), &family.pair(p.clone()), &ring.lift(phases))
    };
    flown().is_some()
}
