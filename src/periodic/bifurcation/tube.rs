//! A followed branch proved to be one curve: Krawczyk's operator on slabs across it, each glued to the next. Lemma Y6

use super::super::equations::flights;
use super::super::krawczyk::{image, is_inside};
use super::super::precondition::Preconditioner;
use super::family::{Family, Varied};
use super::ring::Ring;
use super::system::{Curve, Posed, System};
use super::trace::{Station, correct};
use crate::number::{Ball, Enclosing, Number};
use crate::several::Turning;
use crate::watch::Watch;

/// The part of a branch between two planes: `F = 0`, `a (x - x0) = t`, for all `|t| <= tau`.
struct Slab<'r> {
    ring: &'r Ring,
    centre: Vec<f64>,
    along: Vec<f64>,
    tau: f64,
    /// The `t` of the station it goes to, less than `tau`.
    end: f64,
}

/// Boxes tried for a slab.
const MOST_BOXES: u32 = 8;
/// Images that narrow the end of a slab, so that a much shorter one may follow.
const END_IMAGES: u32 = 4;
/// Halvings of the way between two stations.
const MOST_HALVINGS: u32 = 12;
/// How far a slab reaches beyond its two stations, in parts of the way between them.
const OVERLAP: f64 = 0.02;

impl System for Slab<'_> {
    fn unknowns(&self) -> usize {
        self.centre.len()
    }

    /// With `t = 0`.
    fn values<S: Varied, N: Turning>(&self, family: &Family<S, N>, x: &[N]) -> Option<Vec<N>> {
        let mut values = Curve(self.ring).values(family, x)?;
        let add = |sum: N, ((a, c), x): ((&f64, &f64), &N)| N::from_f64(*a).mul_add(x.clone() - N::from_f64(*c), sum);
        values.push(self.along.iter().zip(&self.centre).zip(x).fold(N::from_f64(0.0), add));
        Some(values)
    }
}

/// A slab proved: for each `t` exactly one orbit lies in `domain`; that of the station it goes to lies in `end`.
struct Proof {
    domain: Vec<Ball>,
    end: Vec<Ball>,
}

impl Slab<'_> {
    /// Krawczyk's image for all `t` of a ball.
    fn image<S: Varied>(
        &self,
        family: &Family<S, Ball>,
        inverse: &Preconditioner,
        x: &[Ball],
        t: Ball,
    ) -> Option<Vec<Ball>> {
        let last = x.len() - 1;
        let moved = |(i, k): (usize, Ball)| Ball::exact(inverse.row(i)[last]) * t + k;
        let still = image(&Posed { system: self, family }, inverse, x)?;
        Some(still.into_iter().enumerate().map(moved).collect())
    }

    /// Proves the slab in a box that is widened until its image lies inside.
    fn prove<S: Varied>(&self, floats: &Family<S, f64>, family: &Family<S, Ball>) -> Option<Proof> {
        let inverse = Preconditioner::new(&self.jacobian(floats, &self.centre)?)?;
        let last = self.centre.len() - 1;
        let all = Ball::new(0.0, self.tau);
        let first = |(i, &x): (usize, &f64)| Ball::new(x, 1.1 * (inverse.row(i)[last].abs() * self.tau) + 1e-12);
        let mut domain: Vec<Ball> = self.centre.iter().enumerate().map(first).collect();
        for _ in 0..MOST_BOXES {
            let found = self.image(family, &inverse, &domain, all)?;
            if is_inside(&found, &domain) {
                let (p, phases) = domain.split_last()?;
                flights(self.ring.chain(), &family.pair(*p), &self.ring.lift(phases))?;
                let end = (0..END_IMAGES)
                    .try_fold(found, |end, _| self.image(family, &inverse, &end, Ball::exact(self.end)))?;
                return is_inside(&end, &domain).then_some(Proof { domain, end });
            }
            let wider = |(k, &x): (&Ball, &f64)| Ball::new(x, 1.2 * ((k.mid() - x).abs() + k.rad()) + 1e-13);
            domain = found.iter().zip(&self.centre).map(wider).collect();
        }
        None
    }

    /// Whether points lie in the proved part of the slab: then they are on its curve.
    fn holds(&self, proof: &Proof, points: &[Ball]) -> bool {
        let add = |sum: Ball, ((a, c), x): ((&f64, &f64), &Ball)| Ball::exact(*a).mul_add(*x - Ball::exact(*c), sum);
        let t = self.along.iter().zip(&self.centre).zip(points).fold(Ball::exact(0.0), add);
        is_inside(points, &proof.domain) && t.is_interior_to(&Ball::new(0.0, self.tau))
    }
}

/// Whether the stations' branch is proved to be one curve of orbits, each the only one near it, unless the watch stops it. Lemma Y6
pub(super) fn is_one_curve<S: Varied>(
    ring: &Ring,
    families: (&Family<S, f64>, &Family<S, Ball>),
    stations: &[Station],
    watch: &dyn Watch,
) -> bool {
    let mut end: Option<Vec<Ball>> = None;
    // Of a single station nothing is proved.
    stations.len() > 1
        && stations
            .windows(2)
            .all(|ends| watch.goes_on() && bridge(ring, families, [&ends[0].x, &ends[1].x], &mut end, 0))
}

/// Proves the way between two points of the branch and glues it to what ends at `end`; halves it where that fails.
fn bridge<S: Varied>(
    ring: &Ring,
    families: (&Family<S, f64>, &Family<S, Ball>),
    [a, b]: [&[f64]; 2],
    end: &mut Option<Vec<Ball>>,
    halvings: u32,
) -> bool {
    let chord: Vec<f64> = a.iter().zip(b).map(|(a, b)| b - a).collect();
    let length = chord.iter().map(|c| c * c).sum::<f64>().sqrt();
    let along: Vec<f64> = chord.iter().map(|c| c / length).collect();
    let middle: Vec<f64> = a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect();
    let Some(centre) = correct(ring, families.0, &middle, &along) else { return false };
    let slab = Slab { ring, centre: centre.clone(), along, tau: (0.5 + OVERLAP) * length, end: 0.5 * length };
    if let Some(proof) = slab.prove(families.0, families.1)
        && end.as_ref().is_none_or(|end| slab.holds(&proof, end))
    {
        *end = Some(proof.end);
        return true;
    }
    halvings < MOST_HALVINGS
        && bridge(ring, families, [a, &centre], end, halvings + 1)
        && bridge(ring, families, [&centre, b], end, halvings + 1)
}
