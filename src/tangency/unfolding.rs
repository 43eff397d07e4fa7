//! How a tangency bends and unfolds: Lemma J7 of `docs/proofs/tangency.md#J7`.

use super::chain::{Chain, power};
use super::flight::{Pair, State, follow};
use super::saddle::zero;
use super::terms::Terms;
use crate::number::{Enclosing, Number};
use crate::periodic::bifurcation::Jet;

type Twice<N> = Jet<Jet<N>>;

/// `q` and `m` of Lemma J5.
pub(super) struct Unfolding<N> {
    pub quadratic: N,
    pub unfolding: N,
}

fn constant<N: Enclosing>(x: &N) -> Twice<N> {
    Jet::constant(Jet::constant(x.clone()))
}

/// The state after all flights from a state that moves. Lemma J7
fn fly<N: Enclosing>(
    chain: &Chain<N>,
    states: &[State<N>],
    pair: &Pair<Twice<N>>,
    start: State<Twice<N>>,
) -> Option<State<Twice<N>>> {
    const ORDER: u32 = 2;
    let mut from = start;
    for (k, side) in chain.flights.iter().enumerate() {
        let end = states[k + 1].each_ref().map(constant);
        let unit = [Jet { value: Jet::constant(states[k + 1][0].clone()), slope: Jet::from_f64(1.0) }, end[1].clone()];
        let still = from.each_ref().map(|x| constant(&x.value.value));
        let fixed = Pair { gap: constant(&pair.gap.value.value), restitution: pair.restitution.clone() };
        let slopes = fixed.miss(&still, &unit, *side)?.map(|x| constant(&x.slope.value));
        let mut to = end;
        for _ in 0..ORDER {
            let mut misses = pair.miss(&from, &to, *side)?;
            // It is a flight: what is missed is 0.
            misses.iter_mut().for_each(|miss| miss.value.value = N::from_f64(0.0));
            let [phase, speed] = follow(misses, &slopes)?;
            let [x, y] = to;
            to = [x + phase, y + speed];
        }
        from = to;
    }
    Some(from)
}

impl<N: Enclosing> Unfolding<N> {
    /// Encloses both over an enclosure of the zero of a chain.
    pub fn new(chain: &Chain<N>, at: &[N]) -> Option<Self> {
        let pair = chain.pair(at);
        let states: Vec<State<N>> = chain.states(at)?.into_iter().map(|state| state.map(|x| x.value)).collect();
        let own = chain.manifolds[0].at(&pair, &at[0])?;
        let end = chain.manifolds[1].at(&pair, &at[1])?;
        let jet = |value: &N, slope: &N| Jet { value: value.clone(), slope: slope.clone() };
        let start = [0, 1].map(|i| Jet {
            value: jet(&own.at[i].value, &own.along[i].value),
            slope: jet(&own.along[i].value, &own.bend[i]),
        });
        let still = Pair { gap: constant(&pair.gap), restitution: constant(&pair.restitution) };
        let twice = fly(chain, &states, &still, start)?.map(|x| x.slope.slope);
        let start = [0, 1].map(|i| Jet {
            value: Jet::constant(own.at[i].value.clone()),
            slope: Jet::constant(own.at[i].slope.clone()),
        });
        let gap = Jet { value: Jet::constant(pair.gap.clone()), slope: Jet::from_f64(1.0) };
        let moving = Pair { gap, restitution: constant(&pair.restitution) };
        let by_gap = fly(chain, &states, &moving, start)?.map(|x| x.slope.value);
        // v_n is scaled, and so is t.
        let stretch = at[3].clone() * power(-chain.scales[chain.flights.len()]);
        let square = stretch.times_ref(&stretch);
        let along = end.along.each_ref().map(|x| x.value.clone());
        let length = along[0].times_ref(&along[0]) + along[1].times_ref(&along[1]);
        let guess = length.as_ball().mid().sqrt();
        let two = N::from_f64(2.0);
        let from = length.centre() - length.centre() + N::from_f64(guess);
        let length = zero(from, |x| Some(x.times_ref(x) - length.clone()), |x| Some(two.times_ref(x)))?;
        let across = |[a, b]: State<N>| (along[0].times_ref(&b) - along[1].times_ref(&a)).checked_div(length.clone());
        let quadratic = across([0, 1].map(|i| twice[i].minus_ref(&square.times_ref(&end.bend[i]))))?;
        let unfolding = across([0, 1].map(|i| by_gap[i].minus_ref(&end.at[i].slope)))?;
        Some(Self { quadratic, unfolding })
    }
}
