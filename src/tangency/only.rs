//! Proof that a tangency is the only one within its bounds: Lemma J6 of `docs/proofs/tangency.md#J6`.

use super::chain::{Chain, FIRST_STATE, Moving};
use super::flight::{Pair, follow};
use crate::number::{Ball, Enclosing, Number, up};
use crate::periodic::bifurcation::Jet;

fn still() -> Moving<Ball> {
    [0, 1].map(|_| Jet::constant(Ball::exact(0.0)))
}

fn moved(phase: Ball, speed: Ball) -> Moving<Ball> {
    [Jet::constant(phase), Jet::constant(speed)]
}

/// The derivatives of all states and tangents by one parameter, which changes the first state so, and the parameter of the chain by `own`. Lemma J6
fn derivatives(chain: &Chain<Ball>, domain: &[Ball], first: Moving<Ball>, own: f64) -> Option<Vec<Moving<Ball>>> {
    let states = chain.states(domain)?;
    let own = Pair::of(chain.over, Ball::exact(own), Ball::exact(0.0));
    let none = own.map(|_| Ball::exact(0.0));
    let one = moved(Ball::exact(1.0), Ball::exact(0.0));
    let mut all = vec![first];
    for k in 0..chain.flights.len() {
        let ends = [&states[k], &states[k + 1]];
        let slopes = chain.change(domain, k, ends, [&still(), &one], &none)?.map(|x| x.value);
        let change = |end: &Moving<Ball>| chain.change(domain, k, ends, [&all[k], end], &own);
        let [phase, speed] = follow(change(&still())?.map(|x| x.value), &slopes)?;
        let [turn, stretch] = follow(change(&moved(phase, speed))?.map(|x| x.slope), &slopes)?;
        all.push([Jet { value: phase, slope: turn }, Jet { value: speed, slope: stretch }]);
    }
    Some(all)
}

/// Whether a proved zero is the only one whose `sigma_u`, `sigma_s` and `D` are within these distances of its own. Lemma J6
pub(super) fn is_only(chain: &Chain<Ball>, domain: &[Ball], at: &[Ball], within: [f64; 3]) -> Option<bool> {
    let [unstable, stable, gap] = within;
    let pair = chain.pair(domain);
    let own = chain.manifolds[0].at(&pair, chain.over, &domain[0])?;
    let by_sigma = [0, 1].map(|i| Jet { value: own.along[i].value, slope: own.bend[i] });
    let by_gap = [0, 1].map(|i| Jet { value: own.at[i].slope, slope: own.along[i].slope });
    let by_sigma = derivatives(chain, domain, by_sigma, 0.0)?;
    let by_gap = derivatives(chain, domain, by_gap, 1.0)?;
    let moves = |a: Ball, b: Ball| up(up(a.mag() * unstable) + up(b.mag() * gap));
    let is_inside = |i: usize, by: f64| at[i].widened(by).is_interior_to(&domain[i]);
    let ends = [(0, unstable), (1, stable), (2, gap)].into_iter().all(|(i, by)| is_inside(i, by));
    let between = (1..chain.flights.len()).all(|k| {
        let first = FIRST_STATE + 4 * (k - 1);
        let (a, b) = (&by_sigma[k], &by_gap[k]);
        (0..2).all(|i| {
            is_inside(first + i, moves(a[i].value, b[i].value))
                && is_inside(first + 2 + i, moves(a[i].slope, b[i].slope))
        })
    });
    // The last tangent is t times that of the stable manifold.
    let (a, b) = (by_sigma.last()?, by_gap.last()?);
    let end = chain.manifolds[1].at(&pair, chain.over, &domain[1])?;
    let stretch = domain[3];
    let turned = up(up((stretch * end.bend[0]).mag() * stable) + up((stretch * end.along[0].slope).mag() * gap));
    let change = Ball::exact(up(moves(a[0].slope, b[0].slope) + turned)).checked_div(end.along[0].value)?;
    Some(ends && between && is_inside(3, change.mag()))
}
