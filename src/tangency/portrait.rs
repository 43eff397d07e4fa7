//! Both manifolds in the section, for pictures: floating point.
//!
//! Labels: proposes throughout.

use std::f64::consts::{PI, TAU};

use super::Tangency;
use super::saddle::{Guessed, Side as Manifold};
use super::search::Floats;
use crate::chaos::{Side, State};

/// Points of both manifolds of a saddle in floating point, phases in radians and speeds over `A W`. Nothing of it is proved.
#[derive(Clone, Debug)]
pub struct Portrait {
    /// The saddle.
    pub saddle: State,
    /// The point of the orbit of tangency about which the manifolds are magnified.
    pub point: State,
    /// After how many flights of the orbit it is.
    pub after: usize,
    /// Points of the unstable manifold in the section, phases in `[0, 2 pi)`.
    pub unstable: Vec<State>,
    /// Points of the stable one.
    pub stable: Vec<State>,
}

/// The curvature at which a fold is seen best where it is magnified.
const CURVATURE: f64 = 1000.0;
/// How far from the orbit curvatures are measured.
const APART: f64 = 1e-6;
/// Points of a fundamental domain, and how often it is mapped.
const POINTS: u32 = 6_000;
const MAPPED: u32 = 9;
const MAPPED_BACK: u32 = 5;
/// The parameter of the unstable manifold from which on it is drawn, and of the stable one.
const FROM: f64 = 0.003;
const FROM_STABLE: f64 = 0.008;
/// A step back in time, in radians, in which a contact is looked for.
const STEP: f64 = 0.02;
/// The greatest speed at which the stable manifold is followed.
const FASTEST: f64 = 4.0;
/// The longest flight, in radians.
const LONGEST: f64 = 40.0;

/// One saddle at one `D`, near a tangency.
struct Near<'t> {
    tangency: &'t Tangency,
    floats: Floats,
    gap: f64,
    e: f64,
}

impl Near<'_> {
    fn new(tangency: &Tangency, gap: f64) -> Option<Near<'_>> {
        let middle = |x: &crate::exact::Enclosure| x.mid_rad().0;
        let e = middle(&tangency.eigenvalues[0]) * middle(&tangency.eigenvalues[1]);
        let e = e.sqrt();
        let apart = |guess: &Guessed| ((guess.theta - middle(&tangency.phase) + PI).rem_euclid(TAU) - PI).abs();
        let guess = Guessed::all(gap, e).into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        Some(Near { tangency, floats: Floats::new(gap, e, guess)?, gap, e })
    }

    /// The image of a parameter of the unstable manifold after some flights.
    fn image(&self, sigma: f64, after: usize) -> Option<State> {
        let start = self.floats.point(Manifold::Unstable, sigma)[0];
        self.floats.image(start, &self.tangency.flights.0[..after])
    }

    /// The state of a parameter of the stable manifold, after some flights from the unstable one.
    fn preimage_after(&self, sigma: f64, after: usize) -> Option<State> {
        let end = self.floats.point(Manifold::Stable, sigma)[0];
        self.tangency.flights.0[after..].iter().rev().try_fold(end, |state, side| self.preimage(state, *side))
    }

    /// After how many flights of the orbit the curvatures of the manifolds differ by about that which is seen best.
    fn best(&self) -> usize {
        let [unstable, stable] = [&self.tangency.unstable, &self.tangency.stable].map(|x| x.mid_rad().0);
        let difference = |after: usize| -> Option<f64> {
            let a = curvature(unstable, |sigma| self.image(sigma, after))?;
            let b = curvature(stable, |sigma| self.preimage_after(sigma, after))?;
            // Signs depend on how each is followed: the smaller one hardly matters where the other is large.
            Some((a.max(b) / CURVATURE).ln().abs() + if a > b { 0.0 } else { 2.0 })
        };
        let count = self.tangency.flights.0.len();
        let rated = (1..count).filter_map(|after| Some((after, difference(after)?)));
        rated.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(count / 2, |(after, _)| after)
    }

    /// The state from which a flight ends at this one.
    fn preimage(&self, [phi, omega]: State, side: Side) -> Option<State> {
        let (sign, far) = (side.sign(), if side == Side::Far { 1.0 } else { 0.0 });
        let c = sign * (omega - phi.cos());
        let arrival = phi - far * PI;
        // Height above the wall that the flight left.
        let height = |theta: f64| far * self.gap - c * (arrival - theta) - sign * phi.sin() - theta.sin();
        let mut late = arrival - 1e-6;
        while late > arrival - LONGEST {
            let early = late - STEP;
            if height(early) > self.gap {
                return None;
            }
            if height(early) < 0.0 {
                let (mut low, mut high) = (early, late);
                for _ in 0..50 {
                    let middle = 0.5 * (low + high);
                    *if height(middle) < 0.0 { &mut low } else { &mut high } = middle;
                }
                let w = (c - low.cos()) / self.e;
                return (w > 0.0).then_some([low, w]);
            }
            late = early;
        }
        None
    }

    /// Points of the section on both sides of the saddle.
    fn spread(&self, side: Manifold, from: f64, ratio: f64) -> Vec<State> {
        let sigma = |i: u32| from * ratio.powf(f64::from(i) / f64::from(POINTS));
        (0..POINTS).flat_map(|i| [sigma(i), -sigma(i)]).map(|sigma| self.floats.point(side, sigma)[0]).collect()
    }
}

/// The curvature of a curve at a parameter.
fn curvature(at: f64, curve: impl Fn(f64) -> Option<State>) -> Option<f64> {
    let apart = |a: State, b: State| (a[0] - b[0]).hypot(a[1] - b[1]);
    let middle = curve(at)?;
    let step = 1e-9 * at.abs();
    let rate = apart(curve(at + step)?, middle) / step;
    let step = (APART / rate).max(1e-11 * at.abs());
    let (a, b) = (curve(at - step)?, curve(at + step)?);
    let bend = [0, 1].map(|i| a[i] - 2.0 * middle[i] + b[i]);
    let along = [0, 1].map(|i| 0.5 * (b[i] - a[i]));
    let length = along[0].hypot(along[1]);
    Some((along[0] * bend[1] - along[1] * bend[0]).abs() / length.powi(3))
}

fn in_period([theta, w]: State) -> State {
    [theta.rem_euclid(TAU), w]
}

impl Portrait {
    /// Returns the manifolds at a value of `D`.
    pub fn of(tangency: &Tangency, gap: f64) -> Option<Self> {
        let near = Near::new(tangency, gap)?;
        let [unstable, stable] = near.floats.guess.lambda;
        let mut images = near.spread(Manifold::Unstable, FROM, unstable * unstable);
        let mut all = images.clone();
        for _ in 0..MAPPED {
            images = images.into_iter().filter_map(|state| near.floats.next(state)).collect();
            all.extend(&images);
        }
        let mut back = near.spread(Manifold::Stable, FROM_STABLE, stable.powi(-2));
        let mut others = back.clone();
        for _ in 0..MAPPED_BACK {
            back = back
                .into_iter()
                .flat_map(|state| [Side::Far, Side::Near].map(|side| near.preimage(state, side)))
                .flatten()
                .filter(|[_, w]| *w < FASTEST)
                .collect();
            others.extend(&back);
            back.truncate(8 * POINTS as usize);
        }
        let after = near.best();
        let point = near.image(tangency.unstable.mid_rad().0, after)?;
        Some(Self {
            saddle: in_period([near.floats.guess.theta, near.floats.guess.speed]),
            point: in_period(point),
            after,
            unstable: all.into_iter().map(in_period).collect(),
            stable: others.into_iter().map(in_period).collect(),
        })
    }

    /// Returns both manifolds at a value of `D`, the unstable one first, where they are within so much of the point, as curves.
    pub fn magnified(&self, tangency: &Tangency, gap: f64, within: State) -> Option<[Vec<State>; 2]> {
        let Self { point: [theta, w], after, .. } = *self;
        let near = Near::new(tangency, gap)?;
        let place = |[a, b]: State| [theta + (a - theta + PI).rem_euclid(TAU) - PI, b];
        let is_near = |[a, b]: State| (a - theta).abs() < within[0] && (b - w).abs() < within[1];
        let curve = |own: f64, at: &dyn Fn(f64) -> Option<State>| -> Option<Vec<State>> {
            let points = |size: f64| -> Vec<State> {
                (-400..=400).filter_map(|i| at(own + size * f64::from(i) / 400.0).map(place)).collect()
            };
            // As much of it as is near.
            let ends = |points: &[State]| {
                points.first().is_some_and(|x| is_near(*x)) || points.last().is_some_and(|x| is_near(*x))
            };
            let size = (0..60).map(|k| own.abs() * 0.1 * 0.5f64.powi(k)).find(|size| ends(&points(*size)))?;
            Some(points(2.0 * size))
        };
        let unstable = curve(tangency.unstable.mid_rad().0, &|sigma| near.image(sigma, after))?;
        let stable = curve(tangency.stable.mid_rad().0, &|sigma| near.preimage_after(sigma, after))?;
        Some([unstable, stable])
    }
}
