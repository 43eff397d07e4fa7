//! The orbit from one manifold to the other as a zero of the equations of all its flights, over boxes of states (Lemma V31).

use super::flights::{Letter, fly, guess};
use super::jet::{self, Jet};
use super::local::{Domain, Side};
use super::saddle::{Family, Law};
use super::series::{Series, State};
use super::shot::{self, Range, known};
use crate::check::affine::Affine;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::legs::{Legs, Rows, not_nothing, product, size};
use impact_pair_exact::Real;

/// Bits of the arithmetic.
pub(super) const BITS: u32 = 112;
/// The places of the values of an orbit: both parameters of manifolds, the parameter of the tangency and the other datum, then phases and speeds.
pub(super) const UNSTABLE: usize = 0;
pub(super) const STABLE: usize = 1;
pub(super) const PARAMETER: usize = 2;
pub(super) const OTHER: usize = 3;
pub(super) const STATES: usize = 4;
/// The parameters as coordinates of a flight: after phase and speed.
const BY_PARAMETER: usize = 2;
const BY_OTHER: usize = 3;

type Vector = [Real; 2];

/// All values that are at most these radii from a centre.
#[derive(Clone, Debug)]
pub(super) struct Area {
    pub centre: Vec<Real>,
    pub radii: Vec<Real>,
}

impl Area {
    /// Returns the smallest one that holds such bounds.
    pub fn of(bounds: &[Real]) -> Self {
        let centre: Vec<Real> = bounds.iter().map(Real::middle).collect();
        let radii = bounds.iter().zip(&centre).map(|(x, middle)| size(&(x.clone() - middle))).collect();
        Self { centre, radii }
    }

    /// Returns a point.
    pub fn point(centre: Vec<Real>) -> Self {
        let radii = vec![Real::zero(BITS); centre.len()];
        Self { centre, radii }
    }

    /// Returns the bounds of a value.
    pub fn hull(&self, i: usize) -> Real {
        self.centre[i].clone() + &Real::within(self.radii[i].enclosure().sup(), BITS)
    }

    /// Returns all of them.
    pub fn hulls(&self) -> Vec<Real> {
        (0..self.centre.len()).map(|i| self.hull(i)).collect()
    }

    /// Returns a value as one that varies, the coordinate `j` of a flight.
    fn varied(&self, i: usize, j: usize) -> Affine {
        Affine::varied(self.centre[i].clone(), not_nothing(self.radii[i].clone()).enclosure().sup().clone(), j)
    }
}

/// An end of the orbit on its manifold.
struct End {
    /// The state at the centre, and the derivative by `sigma` there.
    at: Vector,
    tangent: Vector,
    /// All states.
    states: Vector,
    /// The derivatives by `sigma`, parameter and other datum.
    slopes: Rows<3>,
    /// The derivatives of the first one by these.
    bends: Rows<3>,
    /// The speeds and the durations of all flights between it and the saddle.
    near: Vector,
}

/// What the equations are over an area.
pub(super) struct Over {
    /// Their values at the centre: two of each flight, and the determinant of both tangents.
    pub residual: Vec<Real>,
    /// The derivatives of each by the values that it depends on.
    pub rows: Vec<Vec<(usize, Real)>>,
    /// `q` and `m`.
    pub unfolding: [Real; 2],
    /// Speeds before the impacts, and the durations of flights, those of the manifolds among them.
    pub speeds: Vec<Real>,
    pub times: Vec<Real>,
}

/// The flights of a word between the manifolds.
pub(super) struct Chain<'b> {
    letters: Vec<Letter>,
    /// The parameter is `e`, the other datum `D`.
    is_restitution: bool,
    budget: Budget<'b>,
    /// A phase near that of the saddle.
    near: Real,
    /// Where the manifolds are proved to be analytic: by the parameter, and by the other datum.
    whole: [Real; 2],
    domains: [[Domain; 2]; 2],
    /// About how long the flights last, and whole forcing periods by which states are earlier than the flights say.
    times: Vec<Real>,
    turns: Vec<i64>,
}

fn open(message: &str) -> Doubt {
    Doubt::Open(message.into())
}

fn determinant(a: &Vector, b: &Vector) -> Real {
    a[0].clone() * &b[1] - &(a[1].clone() * &b[0])
}

fn image(matrix: &Rows<2>, vector: &Vector) -> Vector {
    matrix.each_ref().map(|row| row[0].clone() * &vector[0] + &(row[1].clone() * &vector[1]))
}

fn sum(a: &Vector, b: &Vector) -> Vector {
    [0, 1].map(|i| a[i].clone() + &b[i])
}

fn scaled(a: &Vector, by: &Real) -> Vector {
    a.each_ref().map(|x| x.clone() * by)
}

fn column<const N: usize>(rows: &Rows<N>, j: usize) -> Vector {
    rows.each_ref().map(|row| row[j].clone())
}

impl<'b> Chain<'b> {
    /// Returns the flights of a word for these values of the parameter and of the other datum, near a saddle.
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

    /// The jets of an end over such values of both data.
    fn jets(&self, side: Side, sigma: &Real, data: [&Real; 2], is_by_other: bool) -> Result<(State, Vector), Doubt> {
        let lost = || open("the parameter of an invariant manifold is too far from the saddle");
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
            return Err(open("the invariant manifolds are not proved to be analytic that far from the tangency"));
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

    /// The law of flights, parameter and other datum their coordinates.
    fn law(&self, area: &Area) -> Result<Law, Doubt> {
        let [parameter, other] = [area.varied(PARAMETER, BY_PARAMETER), area.varied(OTHER, BY_OTHER)];
        known(Law::of_both(self.is_restitution, parameter, other))
    }

    /// Returns the equations over an area, all flights from its states proved to be first contacts.
    pub fn over(&mut self, area: &Area) -> Result<Over, Doubt> {
        let law = self.law(area)?;
        let [first, last] = [self.end(Side::Unstable, area)?, self.end(Side::Stable, area)?];
        let (bits, count) = (BITS, self.letters.len());
        let radius = |i: usize| not_nothing(area.radii[i].clone());
        let columns: Rows<2> = first.slopes.each_ref().map(|row| [0, 1].map(|j| row[j].middle()));
        let errors = [0, 1].map(|i| [0, 1].map(|j| size(&(first.slopes[i][j].clone() - &columns[i][j]))));
        let [zero, one] = [0, 1].map(|n| Real::int(n, bits));
        let mut legs =
            Legs::<2, 2>::new((columns, errors), [[zero.clone(), one.clone()], [zero.clone(), zero.clone()]]);
        let (mut residual, mut speeds, mut times) = (Vec::new(), vec![first.states[1].clone()], Vec::new());
        let mut tangent = first.tangent.clone();
        for k in 0..count {
            if self.budget.is_spent() {
                return Err(open("the work that is allowed is spent"));
            }
            let place = STATES + 2 * k;
            let at = |i: usize| if k == 0 { first.at[i].clone() } else { area.centre[place - 2 + i].clone() };
            let radii = [0, 1].map(|i| {
                let own = || not_nothing(size(&(first.states[i].clone() - &first.at[i])));
                if k == 0 { own() } else { radius(place - 2 + i) }
            });
            let varied = |i: usize| Some(Affine::varied(at(i), radii[i].enclosure().sup().clone(), i));
            let unit = || Some(Affine::fixed(one.clone()));
            let state = State {
                phase: Jet::new([varied(0), unit(), None, None, None]),
                speed: Jet::new([varied(1), None, unit(), None, None]),
            };
            if self.times.len() == k {
                let data = [&law.gap, &law.e].map(|x| x.value(bits).centre.to_f64());
                self.times.push(guess(data, [0, 1].map(|i| at(i).to_f64())));
            }
            let numbered = |message: String| format!("flight {}: {message}", k + 1);
            let flown =
                fly(&law, &state, (self.letters[k], &self.times[k]), &self.budget).map_err(|doubt| match doubt {
                    Doubt::False(message) | Doubt::Open(message) => Doubt::Open(numbered(message)),
                })?;
            self.budget.spend(bits, 1);
            let jets = [&flown.state.phase, &flown.state.speed];
            let [a, b] = jets.map(|jet| [jet.at(jet::X, bits).centre, jet.at(jet::D, bits).centre]);
            tangent = image(&[a, b], &tangent);
            let [phase, speed] = jets.map(|jet| jet.value(bits).centre);
            let next = if k + 1 == count { last.at.clone() } else { [0, 1].map(|i| area.centre[place + i].clone()) };
            let ahead = phase - &next[0];
            if self.turns.len() == k {
                self.turns.push((ahead.to_f64() / std::f64::consts::TAU).round() as i64); // V31: any whole number
            }
            let turns = Real::pi(bits) * 2 * self.turns[k];
            let nexts = if k + 1 == count { last.states[0].clone() } else { area.hull(place) };
            let apart = jets[0].value(bits).hull() - &nexts - &turns;
            // V31: of no other whole number of forcing periods are there zeros
            if !size(&apart).is_below(&Real::int(6, bits)) {
                return Err(open("the bounds of a state are too wide"));
            }
            residual.extend([ahead - &turns, speed - &next[1]]);
            let all = radii.into_iter().chain([radius(PARAMETER), radius(OTHER)]).collect::<Vec<_>>();
            legs.push(&flown, &all, bits).ok_or_else(|| open("a flight is not proved to be differentiable"))?;
            speeds.push(jets[1].value(bits).hull());
            times.push(flown.time);
        }
        for [speed, time] in [&first.near, &last.near] {
            speeds.push(speed.clone());
            times.push(time.clone());
        }
        residual.push(determinant(&tangent, &last.tangent));
        let mut rows = of_flights(&legs, (&first, &last), count);
        let (row, unfolding) = of_tangents(&legs, (&first, &last), count)?;
        rows.push(row);
        Ok(Over { residual, rows, unfolding, speeds, times })
    }
}

/// The derivatives of one equation, each by the place of its value.
type Row = Vec<(usize, Real)>;

/// The derivatives of the equations of the flights.
fn of_flights(legs: &Legs<2, 2>, (first, last): (&End, &End), count: usize) -> Vec<Row> {
    let mut rows = Vec::new();
    for k in 0..count {
        let (by_state, by_data) = legs.of_flight(k);
        let from_first = product(&by_state, &first.slopes);
        for i in 0..2 {
            let mut data = [0, 1].map(|j| by_data[i][j].clone());
            let mut row = Vec::new();
            let place = STATES + 2 * k;
            if k == 0 {
                row.push((UNSTABLE, from_first[i][0].clone()));
                data = [0, 1].map(|j| data[j].clone() + &from_first[i][1 + j]);
            } else {
                row.extend([0, 1].map(|j| (place - 2 + j, by_state[i][j].clone())));
            }
            if k + 1 == count {
                row.push((STABLE, -&last.slopes[i][0]));
                data = [0, 1].map(|j| data[j].clone() - &last.slopes[i][1 + j]);
            } else {
                row.push((place + i, Real::int(-1, BITS)));
            }
            let [parameter, other] = data;
            row.extend([(PARAMETER, parameter), (OTHER, other)]);
            rows.push(row);
        }
    }
    rows
}

/// The derivatives of the determinant of both tangents, and `q` and `m`.
fn of_tangents(legs: &Legs<2, 2>, (first, last): (&End, &End), count: usize) -> Result<(Row, [Real; 2]), Doubt> {
    let to_the_end = legs.to_the_end();
    let tangents: Vec<Vector> = (0..=count).map(|k| column(&legs.slopes(k), 0)).collect();
    // What a change of a coordinate of flight `k` makes of the last tangent.
    let bent = |k: usize, a: usize| image(&to_the_end[k + 1], &image(&legs.bends(k)[a], &tangents[k]));
    let (end, tangent) = (column(&last.slopes, 0), &tangents[count]);
    let of_first = |j: usize| {
        let moved = column(&first.slopes, j);
        let bend = image(&to_the_end[0], &column(&first.bends, j));
        (0..2).fold(bend, |all, a| sum(&all, &scaled(&bent(0, a), &moved[a])))
    };
    let of_data = |j: usize| (0..count).fold(of_first(j), |all, k| sum(&all, &bent(k, 1 + j)));
    let by_data = |j: usize| determinant(&of_data(j), &end) + &determinant(tangent, &column(&last.bends, j));
    let mut row = vec![
        (UNSTABLE, determinant(&of_first(0), &end)),
        (STABLE, determinant(tangent, &column(&last.bends, 0))),
        (PARAMETER, by_data(1)),
        (OTHER, by_data(2)),
    ];
    let states = (1..count).flat_map(|k| [0, 1].map(|a| (k, a)));
    row.extend(states.map(|(k, a)| (STATES + 2 * (k - 1) + a, determinant(&bent(k, a), &end))));
    let curved = (0..count).flat_map(|k| [0, 1].map(|a| scaled(&bent(k, a), &tangents[k][a])));
    let curved = curved.fold(image(&to_the_end[0], &column(&first.bends, 0)), |all, x| sum(&all, &x));
    let moved = column(&legs.slopes(count), 1);
    let unfolding =
        shot::unfolding([tangent, &end], [&curved, &column(&last.bends, 0)], [&moved, &column(&last.slopes, 1)]);
    Ok((row, unfolding.ok_or_else(|| open("the tangent of the stable manifold may be 0"))?))
}
