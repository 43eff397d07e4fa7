//! Both manifolds in the section, for pictures: floating point.
//!
//! Labels: proposes throughout.

use std::f64::consts::{PI, TAU};

use super::Tangency;
use super::flight::Pair;
use super::saddle::{Guessed, Side as Manifold};
use super::search::Floats;
use crate::chaos::{Side, State};

/// Points of both manifolds of a saddle in floating point, phases in radians and speeds over `A W`, without proof.
#[derive(Clone, Debug)]
pub struct Portrait {
    /// The saddle.
    pub saddle: State,
    /// The point of the orbit of tangency about which the manifolds are magnified.
    pub point: State,
    /// Points of the unstable manifold in the section, phases in `[0, 2 pi)`.
    pub unstable: Vec<State>,
    /// Points of the stable manifold.
    pub stable: Vec<State>,
}

/// The flights before the end at which the tangency is magnified, if the word ends with that number to the far wall.
const MAGNIFIED_FLIGHTS: usize = 3;
/// Points of a fundamental domain, and how often it is mapped.
const POINTS: u32 = 6_000;
const ITERATES: u32 = 9;
const INVERSE_ITERATES: u32 = 5;
/// The parameter of the unstable manifold from which on it is drawn, and of the stable one.
const UNSTABLE_FROM: f64 = 0.003;
const STABLE_FROM: f64 = 0.008;
/// A step back in time, in radians, in which a contact is looked for.
const STEP: f64 = 0.02;
/// The longest flight, in radians.
const MAX_FLIGHT: f64 = 40.0;

/// One saddle at one `D`, near a tangency.
struct LocalSaddle<'t> {
    tangency: &'t Tangency,
    floats: Floats,
    gap: f64,
    e: f64,
}

impl LocalSaddle<'_> {
    fn new(tangency: &Tangency, [gap, e]: [f64; 2]) -> Option<LocalSaddle<'_>> {
        let phase = tangency.phase.mid_rad().0;
        let apart = |guess: &Guessed| ((guess.theta - phase + PI).rem_euclid(TAU) - PI).abs();
        let guess =
            Guessed::all(Pair { gap, restitution: e }).into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
        Some(LocalSaddle { tangency, floats: Floats::new(Pair { gap, restitution: e }, guess)?, gap, e })
    }

    /// Number of flights before the end at which the tangency is magnified.
    fn before(&self) -> usize {
        self.tangency.flights.0.iter().rev().take_while(|side| **side == Side::Far).count().min(MAGNIFIED_FLIGHTS)
    }

    /// The image of a parameter of the unstable manifold at the point of tangency.
    fn image(&self, sigma: f64) -> Option<State> {
        let flights = &self.tangency.flights.0;
        let start = self.floats.point(Manifold::Unstable, sigma)[0];
        self.floats.image(start, &flights[..flights.len() - self.before()])
    }

    /// All states from which a flight ends at this one.
    fn preimages(&self, [phi, omega]: State) -> Vec<State> {
        let of = |side: Side| -> Option<State> {
            let (sign, far) = (side.sign(), if side == Side::Far { 1.0 } else { 0.0 });
            let c = sign * (omega - phi.cos());
            let arrival = phi - far * PI;
            // Height above the wall that the flight left.
            let height = |theta: f64| far * self.gap - c * (arrival - theta) - sign * phi.sin() - theta.sin();
            let mut late = arrival - 1e-6;
            loop {
                let early = late - STEP;
                if early < arrival - MAX_FLIGHT || height(early) > self.gap {
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
        };
        [Side::Far, Side::Near].into_iter().filter_map(of).collect()
    }

    /// Points of the section on both sides of the saddle.
    fn spread(&self, side: Manifold, from: f64, ratio: f64) -> Vec<State> {
        let sigma = |i: u32| from * ratio.powf(f64::from(i) / f64::from(POINTS));
        (0..POINTS).flat_map(|i| [sigma(i), -sigma(i)]).map(|sigma| self.floats.point(side, sigma)[0]).collect()
    }
}

fn in_period([theta, w]: State) -> State {
    [theta.rem_euclid(TAU), w]
}

impl Portrait {
    /// The manifolds at values of `D` and `e`.
    pub fn of(tangency: &Tangency, pair: [f64; 2]) -> Option<Self> {
        let near = LocalSaddle::new(tangency, pair)?;
        let [unstable, stable] = near.floats.guess.lambda;
        let mut images = near.spread(Manifold::Unstable, UNSTABLE_FROM, unstable * unstable);
        let mut all = images.clone();
        for _ in 0..ITERATES {
            images = images.into_iter().filter_map(|state| near.floats.next(state)).collect();
            all.extend(&images);
        }
        let mut back = near.spread(Manifold::Stable, STABLE_FROM, stable.powi(-2));
        let mut others = back.clone();
        for _ in 0..INVERSE_ITERATES {
            back = back.into_iter().flat_map(|state| near.preimages(state)).filter(|[_, w]| *w < 4.0).collect();
            others.extend(&back);
            back.truncate(8 * POINTS as usize);
        }
        let point = near.image(tangency.unstable.mid_rad().0)?;
        Some(Self {
            saddle: in_period([near.floats.guess.theta, near.floats.guess.speed]),
            point: in_period(point),
            unstable: all.into_iter().map(in_period).collect(),
            stable: others.into_iter().map(in_period).collect(),
        })
    }

    /// Both manifolds, the unstable one first, near the point of tangency, as curves.
    pub fn magnified(&self, tangency: &Tangency, pair: [f64; 2], within: State) -> Option<[Vec<State>; 2]> {
        let [theta, w] = self.point;
        let near = LocalSaddle::new(tangency, pair)?;
        let place = |[a, b]: State| [theta + (a - theta + PI).rem_euclid(TAU) - PI, b];
        let is_near = |[a, b]: State| (a - theta).abs() < within[0] && (b - w).abs() < within[1];
        let own = tangency.unstable.mid_rad().0;
        let unstable = |size: f64| -> Vec<State> {
            let at = |i: i32| near.image(own + size * f64::from(i) / 400.0).map(place);
            (-400..=400).filter_map(at).collect()
        };
        // Half the length of the curve whose ends are near.
        let size = (0..40).map(|k| own.abs() * 0.1 * 0.5f64.powi(k)).find(|size| {
            let points = unstable(*size);
            points.first().is_some_and(|first| is_near(*first)) || points.last().is_some_and(|last| is_near(*last))
        })?;
        let middle = tangency.stable.mid_rad().0 * near.floats.guess.lambda[1].powi(-(near.before() as i32));
        let at = |i: i32| {
            let sigma = middle + 2.0 * within[0] * f64::from(i) / 200.0;
            place(near.floats.point(Manifold::Stable, sigma)[0])
        };
        Some([unstable(2.0 * size), (-200..=200).map(at).collect()])
    }
}
