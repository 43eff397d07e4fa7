//! The orbit from one manifold to the other as a zero of the equations of all its flights, over boxes of states (Lemma V31).

use super::area::{
    Area, BITS, OTHER, OTHER_COORDINATE, PARAMETER, PARAMETER_COORDINATE, STABLE, STATES, UNSTABLE, Vector,
};
use super::flights::{Flown, Letter, fly, guess};
use super::jet::{self, Jet};
use super::local::{Domain, Side};
use super::rows::{End, Row, determinant, image, of_flights, of_tangents, scaled};
use super::saddle::{Family, Law};
use super::series::{Series, State};
use super::shot::{Range, known};
use crate::check::affine::Affine;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::legs::{Legs, Rows, not_nothing, size};
use impact_pair_exact::Real;

/// The equations over an area.
pub(super) struct AreaEquations {
    /// The equations' values at the centre: two of each flight, and the determinant of both tangents.
    pub residual: Vec<Real>,
    /// The derivatives of each equation by the values that it depends on.
    pub rows: Vec<Row>,
    /// `q` and `m`.
    pub unfolding: [Real; 2],
    /// Speeds before the impacts, and the durations of flights, those of the manifolds included.
    pub speeds: Vec<Real>,
    pub times: Vec<Real>,
}

/// The flights of a word between the manifolds.
pub(super) struct Chain<'b> {
    letters: Vec<Letter>,
    /// True if the parameter is `e` and the other datum is `D`; else exchanged.
    is_restitution: bool,
    budget: Budget<'b>,
    /// A phase near the phase of the saddle.
    near: Real,
    /// Intervals of the parameter, and of the other datum, over which the manifolds are proved to be analytic.
    whole: [Real; 2],
    domains: [[Domain; 2]; 2],
    /// Approximate durations of flights, and whole forcing periods that are taken off the ends of flights.
    times: Vec<Real>,
    turns: Vec<i64>,
}

impl<'b> Chain<'b> {
    /// The flights of a word for these values of the parameter and of the other datum, near a saddle.
    pub fn new(
        letters: Vec<Letter>,
        (is_restitution, whole): (bool, [Real; 2]),
        near: &Real,
        budget: Budget<'b>,
    ) -> Result<Self, Doubt> {
        let near = near.at(BITS);
        let [parameter, other] = &whole;
        let of = |is_restitution: bool, parameter: &Real, other: &Real| -> Result<[Domain; 2], Doubt> {
            let family = Family { is_restitution, other: other.clone() };
            Range::new(Vec::new(), near.clone(), budget.clone()).domains_over(&family, parameter)
        };
        let domains = [of(is_restitution, parameter, other)?, of(!is_restitution, other, parameter)?];
        Ok(Self { letters, is_restitution, budget, near, whole, domains, times: Vec::new(), turns: Vec::new() })
    }

    fn family(&self, is_by_other: bool, fixed: Real) -> Family {
        Family { is_restitution: self.is_restitution != is_by_other, other: fixed }
    }

    /// The jets of an end over values of both data.
    fn jets(&self, side: Side, sigma: &Real, data: [&Real; 2], is_by_other: bool) -> Result<(State, Vector), Doubt> {
        let lost = || Doubt::open("the parameter of an invariant manifold is too far from the saddle");
        let [varied, fixed] = if is_by_other { [data[1], data[0]] } else { data };
        let family = self.family(is_by_other, fixed.clone());
        let law = known(family.law_over(varied))?;
        let range = Range::new(Vec::new(), self.near.clone(), self.budget.clone());
        let saddle = range.saddle(&law)?;
        let domain = &self.domains[usize::from(is_by_other)][usize::from(side == Side::Stable)];
        let most = Real::point(sigma.enclosure().mag(), BITS);
        let series = Series::new(&law, &saddle, (side, domain.clone()), &most).ok_or_else(lost)?;
        let middle = sigma.middle();
        let off = (sigma.clone() - &middle).enclosure().mag();
        let sigma = if off.is_zero() { Affine::fixed(middle) } else { Affine::varied(middle, off, 1) };
        let state = series.at(&law, &sigma).ok_or_else(lost)?;
        Ok((state, range.flies_near(&law, &saddle, &series, &most)?))
    }

    fn end(&self, side: Side, area: &Area) -> Result<End, Doubt> {
        let place = if side == Side::Unstable { UNSTABLE } else { STABLE };
        let hulls = [PARAMETER, OTHER].map(|i| area.hull(i));
        let is_inside = |i: usize| self.whole[i].enclosure().contains_enclosure(hulls[i].enclosure());
        if !(is_inside(0) && is_inside(1)) {
            return Err(Doubt::open(
                "the invariant manifolds are not proved to be analytic that far from the tangency",
            ));
        }
        let of = |state: &State, power: usize| [&state.phase, &state.speed].map(|x| x.at(power, BITS).hull());
        let at = |i: usize| &area.centre[i];
        let is_fixed = |i: usize| area.radii[i].is_zero();
        let (over, near) = self.jets(side, &area.hull(place), hulls.each_ref(), false)?;
        let thin = if [place, PARAMETER, OTHER].into_iter().all(is_fixed) {
            over.clone()
        } else {
            self.jets(side, at(place), [at(PARAMETER), at(OTHER)], false)?.0
        };
        let by_other =
            if is_fixed(OTHER) { None } else { Some(self.jets(side, &area.hull(place), hulls.each_ref(), true)?.0) };
        let of_other =
            |power: usize| by_other.as_ref().map_or_else(|| [0, 1].map(|_| Real::zero(BITS)), |state| of(state, power));
        let rows = |columns: [Vector; 3]| [0, 1].map(|i| columns.each_ref().map(|column| column[i].clone()));
        Ok(End {
            at: of(&thin, jet::ONE),
            tangent: of(&thin, jet::X),
            states: of(&over, jet::ONE),
            slopes: rows([of(&over, jet::X), of(&over, jet::D), of_other(jet::D)]),
            bends: rows([scaled(&of(&over, jet::XX), &Real::int(2, BITS)), of(&over, jet::XD), of_other(jet::XD)]),
            near,
        })
    }

    /// The law of flights, with the parameter and the other datum as coordinates.
    fn law(&self, area: &Area) -> Result<Law, Doubt> {
        let [parameter, other] = [area.varied(PARAMETER, PARAMETER_COORDINATE), area.varied(OTHER, OTHER_COORDINATE)];
        known(Law::of_both(self.is_restitution, parameter, other))
    }

    /// The equations over an area; all flights from its states are proved to be first contacts.
    pub fn over(&mut self, area: &Area) -> Result<AreaEquations, Doubt> {
        let law = self.law(area)?;
        let ends = [self.end(Side::Unstable, area)?, self.end(Side::Stable, area)?];
        let [first, last] = &ends;
        let count = self.letters.len();
        let columns: Rows<2> = first.slopes.each_ref().map(|row| [0, 1].map(|j| row[j].middle()));
        let errors = [0, 1].map(|i| [0, 1].map(|j| size(&(first.slopes[i][j].clone() - &columns[i][j]))));
        let [zero, one] = [0, 1].map(|n| Real::int(n, BITS));
        let mut legs =
            Legs::<2, 2>::new((columns, errors), [[zero.clone(), one.clone()], [zero.clone(), zero.clone()]]);
        let (mut residual, mut speeds, mut times) = (Vec::new(), vec![first.states[1].clone()], Vec::new());
        let mut tangent = first.tangent.clone();
        for k in 0..count {
            let state = StateBox::of(area, first, k);
            let flown = self.flown(&law, &state, k)?;
            let jets = [&flown.state.phase, &flown.state.speed];
            let [a, b] = jets.map(|jet| [jet.at(jet::X, BITS).centre, jet.at(jet::D, BITS).centre]);
            tangent = image(&[a, b], &tangent);
            residual.extend(self.missed(area, last, jets, k)?);
            let data = [PARAMETER, OTHER].map(|i| not_nothing(area.radii[i].clone()));
            let all = state.radii.into_iter().chain(data).collect::<Vec<_>>();
            legs.push(&flown, &all, BITS).ok_or_else(|| Doubt::open("a flight is not proved to be differentiable"))?;
            speeds.push(jets[1].value(BITS).hull());
            times.push(flown.time);
        }
        for [speed, time] in [&first.near, &last.near] {
            speeds.push(speed.clone());
            times.push(time.clone());
        }
        residual.push(determinant(&tangent, &last.tangent));
        let mut rows = of_flights(&legs, (first, last), count);
        let (row, unfolding) = of_tangents(&legs, (first, last), count)?;
        rows.push(row);
        Ok(AreaEquations { residual, rows, unfolding, speeds, times })
    }

    /// Flight `k` from all states of a box, proved to end at its first contact.
    fn flown(&mut self, law: &Law, near: &StateBox, k: usize) -> Result<Flown, Doubt> {
        if self.budget.is_spent() {
            return Err(Doubt::open("the work that is allowed is spent"));
        }
        if self.times.len() == k {
            let data = [&law.gap, &law.e].map(|x| x.value(BITS).centre.to_f64());
            self.times.push(guess(data, near.at.each_ref().map(Real::to_f64)));
        }
        let numbered = |message: String| format!("flight {}: {message}", k + 1);
        let flown =
            fly(law, &near.state(), (self.letters[k], &self.times[k]), &self.budget).map_err(|doubt| match doubt {
                Doubt::False(message) | Doubt::Open(message) => Doubt::Open(numbered(message)),
            })?;
        self.budget.spend(BITS, 1);
        Ok(flown)
    }

    /// Difference of phase and speed between the end of flight `k` and the next state, or the stable manifold after the last flight.
    fn missed(&mut self, area: &Area, last: &End, jets: [&Jet; 2], k: usize) -> Result<[Real; 2], Doubt> {
        let (place, is_last) = (STATES + 2 * k, k + 1 == self.letters.len());
        let [phase, speed] = jets.map(|jet| jet.value(BITS).centre);
        let next = if is_last { last.at.clone() } else { [0, 1].map(|i| area.centre[place + i].clone()) };
        let ahead = phase - &next[0];
        if self.turns.len() == k {
            self.turns.push((ahead.to_f64() / std::f64::consts::TAU).round() as i64); // V31: any whole number
        }
        let turns = Real::pi(BITS) * 2 * self.turns[k];
        let nexts = if is_last { last.states[0].clone() } else { area.hull(place) };
        let apart = jets[0].value(BITS).hull() - &nexts - &turns;
        // V31: for no other whole number of forcing periods are there zeros
        if !size(&apart).is_below(&Real::int(6, BITS)) {
            return Err(Doubt::open("the bounds of a state are too wide"));
        }
        Ok([ahead - &turns, speed - &next[1]])
    }
}

/// The states at the beginning of a flight: centre and radii of phase and speed.
struct StateBox {
    at: Vector,
    radii: [Real; 2],
}

impl StateBox {
    /// The states of flight `k`: the first flight begins on the unstable manifold.
    fn of(area: &Area, first: &End, k: usize) -> Self {
        match k {
            0 => Self {
                at: first.at.clone(),
                radii: [0, 1].map(|i| not_nothing(size(&(first.states[i].clone() - &first.at[i])))),
            },
            _ => {
                let place = STATES + 2 * (k - 1);
                Self {
                    at: [0, 1].map(|i| area.centre[place + i].clone()),
                    radii: [0, 1].map(|i| not_nothing(area.radii[place + i].clone())),
                }
            }
        }
    }

    /// The states as coordinates.
    fn state(&self) -> State {
        let varied = |i: usize| Some(Affine::varied(self.at[i].clone(), self.radii[i].enclosure().sup().clone(), i));
        let unit = || Some(Affine::fixed(Real::int(1, BITS)));
        State {
            phase: Jet::new([varied(0), unit(), None, None, None]),
            speed: Jet::new([varied(1), None, unit(), None, None]),
        }
    }
}
