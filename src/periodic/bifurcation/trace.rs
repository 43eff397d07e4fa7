//! A branch followed by pseudo-arclength in floating point, and what changes sign along it. Non-rigorous.

// Labels: proposes throughout.

use nalgebra::DVector;

use super::super::chained::Moment;
use super::super::entries::Entries;
use super::super::shaking::Shaking;
use super::family::{Family, Varied};
use super::ring::Ring;
use super::system::{Curve, System};
use crate::pair::{Inward, Wall};
use crate::several::PhaseNumber;

/// A point of a branch: phases, then the parameter; and the unit tangent there.
#[derive(Clone, Debug)]
pub(super) struct Station {
    pub x: Vec<f64>,
    pub tangent: Vec<f64>,
    pub tests: Tests,
}

/// The quantities that change sign at a bifurcation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tests {
    /// `det F'_{-1}` (39).
    pub flip: f64,
    /// The parameter's part of the tangent (40).
    pub turn: f64,
    /// The least distance from a wall inside a flight, and where.
    pub room: Nearest,
    /// The least speed of an arrival, and which.
    pub arrival: (f64, usize),
    /// For `e = 0`, where every flight leaves its wall without velocity, the least acceleration away from it, and at which impact; infinite for
    /// all other `e`.
    pub bend: (f64, usize),
    /// Distance of the ring from its half, in forcing periods: 0 where it runs through it twice.
    pub apart: f64,
}

/// The extremum of a flight that is nearest to a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    pub distance: f64,
    pub leg: usize,
    pub wall: Wall,
    pub phase: f64,
}

/// Newton steps of a correction.
const MOST_STEPS: usize = 8;

/// Corrects `x` onto the branch, within the plane through it across `along`.
pub(super) fn correct<S: Varied>(ring: &Ring, family: &Family<S, f64>, x: &[f64], along: &[f64]) -> Option<Vec<f64>> {
    correct_onto(&System::Curve(Curve(ring)), family, x, along)
}

/// Corrects `x` onto a curve, likewise.
pub(super) fn correct_onto<S: Varied>(
    curve: &System<'_>,
    family: &Family<S, f64>,
    x: &[f64],
    along: &[f64],
) -> Option<Vec<f64>> {
    let (start, mut x) = (x.to_vec(), x.to_vec());
    for _ in 0..MOST_STEPS {
        let mut values = curve.values(family, &x)?;
        values.push(along.iter().zip(x.iter().zip(&start)).map(|(t, (x, s))| t * (x - s)).sum());
        let bordered = border(curve.jacobian(family, &x, false)?, along);
        let step = bordered.dense().lu().solve(&DVector::from_vec(values))?;
        let size = step.amax();
        if !size.is_finite() || size > 0.2 {
            return None;
        }
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
        if size < 1e-11 {
            return Some(x);
        }
    }
    None
}

/// The Jacobian matrix of a curve with its last row.
fn border(matrix: Entries<f64>, row: &[f64]) -> Entries<f64> {
    let last = matrix.size() - 1;
    matrix.with_row(last, row.iter().copied().enumerate())
}

/// The unit tangent at `x` that goes the way of `along`.
pub(super) fn tangent<S: Varied>(ring: &Ring, family: &Family<S, f64>, x: &[f64], along: &[f64]) -> Option<Vec<f64>> {
    let matrix = border(System::Curve(Curve(ring)).jacobian(family, x, false)?, along);
    let mut right = DVector::zeros(x.len());
    right[x.len() - 1] = 1.0;
    let tangent = matrix.dense().lu().solve(&right)?.normalize();
    tangent.iter().all(|t| t.is_finite()).then(|| tangent.as_slice().to_vec())
}

/// A vector that `F'_mu` all but annuls, of length 1.
pub(super) fn null_vector<S: Varied>(ring: &Ring, family: &Family<S, f64>, x: &[f64], mu: f64) -> Option<Vec<f64>> {
    let matrix = twisted_matrix(ring, family, x, &mu)?;
    let svd = matrix.dense().svd(false, true);
    let v = svd.v_t?;
    let least = svd.singular_values.imin();
    Some(v.row(least).iter().copied().collect())
}

/// `F'_mu`
pub(super) fn twisted_matrix<S: Varied, N: PhaseNumber>(
    ring: &Ring,
    family: &Family<S, N>,
    x: &[N],
    mu: &N,
) -> Option<Entries<N>> {
    let (p, phases) = x.split_last()?;
    let pair = family.pair(p.clone());
    let slopes = ring.chain().slopes(&pair, &ring.legs(&pair, phases)?)?;
    let m = ring.unknowns();
    let unit = |j: usize| (0..m).map(|i| N::from_f64(if i == j { 1.0 } else { 0.0 })).collect::<Vec<N>>();
    let column = |j: usize| -> Option<Vec<N>> {
        let w = unit(j);
        let ends = [w[m - 1].clone().checked_div(mu.clone())?, w[0].clone() * mu.clone()];
        Some(ring.continued(&slopes, &w, ends))
    };
    let columns: Vec<_> = (0..m).map(column).collect::<Option<_>>()?;
    let all = (0..m).flat_map(|i| columns.iter().enumerate().map(move |(j, column)| (i, j, column[i].clone())));
    Some(Entries::new(m, all.collect()))
}

impl Station {
    /// Station at `x`.
    pub fn new<S: Varied>(ring: &Ring, family: &Family<S, f64>, x: Vec<f64>, along: &[f64]) -> Option<Self> {
        let tangent = tangent(ring, family, &x, along)?;
        let tests = Tests::new(ring, family, &x, &tangent)?;
        Some(Self { x, tangent, tests })
    }

    /// The station with the opposite tangent.
    pub fn reversed(&self) -> Self {
        let tests = Tests { turn: -self.tests.turn, ..self.tests };
        Self { x: self.x.clone(), tangent: self.tangent.iter().map(|t| -t).collect(), tests }
    }

    /// Value of the parameter.
    pub fn parameter(&self) -> f64 {
        self.x[self.x.len() - 1]
    }
}

impl Tests {
    fn new<S: Varied>(ring: &Ring, family: &Family<S, f64>, x: &[f64], tangent: &[f64]) -> Option<Self> {
        let (&p, phases) = x.split_last()?;
        let (pair, chain) = (family.pair(p), ring.chain());
        let legs = ring.legs(&pair, phases)?;
        let lifted = ring.lift(phases);
        let arrival = (0..ring.unknowns())
            .map(|i| (-chain.walls()[i].inward(*chain.before(&legs.legs, i)), i))
            .min_by(|a, b| a.0.total_cmp(&b.0))?;
        let away = |i: usize| match *pair.restitution() == 0.0 {
            true => chain.walls()[i].inward(pair.acceleration(&legs.waves[i])),
            false => f64::INFINITY,
        };
        let bend = (0..ring.unknowns()).map(|i| (away(i), i)).min_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut room = Nearest { distance: f64::INFINITY, leg: 0, wall: Wall::Left, phase: 0.0 };
        for (i, leg) in legs.legs.iter().enumerate().take(ring.unknowns()) {
            let own = chain.walls()[i];
            // The ball leaves with no velocity towards the wall: where it is accelerated away from it, its distance has a maximum first, and a
            // minimum before is the start itself, which doubles do not tell apart where e is small.
            let is_bent_away = |at: &Moment<S, f64>| own.inward(pair.acceleration(at)) > 0.0;
            let leaves = is_bent_away(&legs.waves[i]);
            let is_start = |s: f64| leaves && is_bent_away(&pair.moment(0.0, &s));
            let summits = S::summits(&pair, leg, &legs.waves[i], lifted[i]);
            for (s, shift) in summits.into_iter().skip_while(|(s, _)| is_start(*s)) {
                let height = own.inward(leg.drift * (s - lifted[i]) - shift);
                let (distance, wall) = if height < 0.5 { (height, own) } else { (1.0 - height, own.other()) };
                if distance < room.distance {
                    room = Nearest { distance, leg: i, wall, phase: s };
                }
            }
        }
        let apart = ring.halves().map(|_| asymmetry(phases, ring.turns() / 2.0)).fold(f64::INFINITY, f64::min);
        let flip = twisted_matrix(ring, family, x, &-1.0)?.dense().lu().determinant();
        Some(Self { flip, turn: tangent[tangent.len() - 1], room, arrival, bend, apart })
    }
}

/// Greatest difference of a phase from its repetition after half the forcing periods, in forcing periods.
fn asymmetry(phases: &[f64], turns: f64) -> f64 {
    let half = phases.len() / 2;
    (0..half).map(|i| (phases[i + half] - phases[i] - turns).abs()).fold(0.0, f64::max)
}
