//! Periodic orbits of the reduced map in parallelepipeds of states and values of the parameter (Lemma V30).

use crate::check::affine::Affine;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::legs::{Legs, Rows};
use crate::check::round::{Matrix, along, inverse};
use crate::check::tangency::flights::{Letter, fly, guess};
use crate::check::tangency::jet::Jet;
use crate::check::tangency::saddle::{Family, Law};
use crate::check::tangency::series::State;
use impact_pair_exact::{Dyadic, Real};

/// Phase \[rad\], speed over `A W`, and the parameter `D` or `e`.
pub(super) type Point = [Real; 3];

/// Bits of the directions of a set, which are exact.
const FRAME_BITS: u32 = 96;
/// The widest phases that are tried, as a power of 2.
const WIDEST: i64 = -4;

/// `centre + frame[0] q_0 + frame[1] q_1 + frame[2] q_2` with `|q_i| <= 1`; the directions are points.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub centre: Point,
    pub frame: [Point; 3],
}

impl Cell {
    /// Returns the set with these directions, rounded.
    pub fn new(centre: Point, frame: [Point; 3]) -> Self {
        let rounded = |x: Real| x.rounded(FRAME_BITS).middle();
        Self { centre: centre.map(|x| x.middle()), frame: frame.map(|direction| direction.map(rounded)) }
    }

    /// Returns the same set with such sides along the two coordinates other than `main`.
    pub fn with_sides(self, main: usize, sides: [Real; 2]) -> Self {
        let [first, ..] = self.frame;
        let [a, b] = sides;
        let side = |i: usize, x: &Real| {
            let own = (main + 1 + i) % 3;
            [0, 1, 2].map(|j| if j == own { x.clone() } else { Real::zero(FRAME_BITS) })
        };
        Self::new(self.centre, [first, side(0, &a), side(1, &b)])
    }

    /// Returns the same set, its sides across multiplied by these factors.
    pub fn widened(self, [a, b]: [Real; 2]) -> Self {
        let [first, second, third] = self.frame;
        Self::new(self.centre, [first, second.map(|x| x * &a), third.map(|x| x * &b)])
    }

    /// Returns the coordinate `i` of its members.
    pub fn spanned(&self, i: usize) -> Affine {
        let unit = |j: usize| Affine::varied(Real::zero(FRAME_BITS), Dyadic::power_of_two(0), j);
        let [a, b, c] = [0, 1, 2].map(unit);
        let [u, v, w] = self.frame.each_ref().map(|direction| &direction[i]);
        Affine::of(self.centre[i].clone(), &[(u, &a), (v, &b), (w, &c)])
    }

    /// Returns bounds of its members.
    pub fn hull(&self) -> Point {
        [0, 1, 2].map(|i| self.spanned(i).hull())
    }

    /// Returns whether all of these are members, and not at a face.
    pub fn holds(&self, all: &Point) -> bool {
        let off = [0, 1, 2].map(|i| all[i].clone() - &self.centre[i]);
        let columns = |i: usize| [0, 1, 2].map(|j| self.frame[j][i].at(off[i].bits()));
        let rows = [0, 1, 2].map(columns);
        let minor = |a: usize, b: usize, i: usize, j: usize| {
            rows[a][i].clone() * &rows[b][j] - &(rows[a][j].clone() * &rows[b][i])
        };
        // Adjoint matrix over the determinant.
        let adjoint = |i: usize, k: usize| minor((k + 1) % 3, (k + 2) % 3, (i + 1) % 3, (i + 2) % 3);
        let added = |i: usize, of: &dyn Fn(usize) -> Real| {
            of(0) * &adjoint(i, 0) + &(of(1) * &adjoint(i, 1)) + &(of(2) * &adjoint(i, 2))
        };
        let whole = added(0, &|k| rows[k][0].clone());
        let one = Real::int(1, off[0].bits());
        let is_within = |q: Real| q.is_below(&one) && (-q).is_below(&one);
        (0..3).all(|i| added(i, &|k| off[k].clone()).over(&whole).is_some_and(is_within))
    }
}

/// The image of a cell under the flights of a period.
pub(super) struct Image {
    /// Displacement of the state at the centre, less whole forcing periods.
    off: [Real; 2],
    /// Encloses the derivatives of that by the coordinates `q` over the cell.
    slopes: Rows<3>,
    legs: Legs<3, 1>,
    /// The derivatives of the state itself by the coordinates.
    starts: Rows<3>,
    /// The functions that are 0 where 1, or -1, is an eigenvalue.
    pub criticals: [Critical; 2],
}

/// `1 + det - trace` or `1 + det + trace` of the derivative by the state, zero where 1, or -1, is an eigenvalue.
pub(super) struct Critical {
    /// The function over the cell.
    pub value: Real,
    /// Its derivatives by the coordinates `q` over the cell.
    pub slopes: [Real; 3],
}

/// Along the curve of periodic orbits of a cell.
pub(super) struct Along {
    /// Bounds how fast `q_1` and `q_2` change with `q_0`.
    steepness: Option<Real>,
}

/// The reduced map along the flights of a period.
pub(super) struct Map<'b> {
    letters: Vec<Letter>,
    family: Family,
    budget: Budget<'b>,
    /// Sets are not tried that reach farther in phase.
    widest: Real,
    /// Approximate durations of the flights.
    times: Vec<Real>,
    /// Forcing periods of the reduced map that a period takes.
    turns: i64,
}

impl<'b> Map<'b> {
    /// Returns the map along these flights from near a point.
    pub fn new(letters: Vec<Letter>, family: Family, budget: Budget<'b>, near: &Point) -> Result<Self, Doubt> {
        let widest = Real::point(Dyadic::power_of_two(WIDEST), FRAME_BITS);
        let mut map = Self { letters, family, budget, widest, times: Vec::new(), turns: 0 };
        let (thin, _) = map.thin(near);
        let ([phase, _], _) = map.flown(&thin)?;
        let passed = phase - &near[0];
        map.turns = (passed.to_f64() / std::f64::consts::TAU).round() as i64; // V30: any whole number
        Ok(map)
    }

    /// Returns the bits of its arithmetic.
    pub fn bits(&self) -> u32 {
        self.family.bits()
    }

    /// Returns the whole forcing periods that a period takes in the reduced map.
    pub fn turns(&self) -> i64 {
        self.turns
    }

    /// Returns next to nothing around a point, and the unit of its coordinates.
    pub fn thin(&self, at: &Point) -> (Cell, Real) {
        let tiny = Real::point(Dyadic::power_of_two(-2 * i64::from(self.bits())), FRAME_BITS);
        let unit = |i: usize, j: usize| if i == j { tiny.clone() } else { Real::zero(FRAME_BITS) };
        (Cell::new(at.clone(), [0, 1, 2].map(|j| [0, 1, 2].map(|i| unit(i, j)))), tiny.clone())
    }

    /// Flies a period, all flights proved to be first contacts: the state at the centre afterwards, and the derivatives.
    fn flown(&mut self, cell: &Cell) -> Result<([Real; 2], Legs<3, 1>), Doubt> {
        let bits = self.bits();
        let [u, v, w] = &cell.frame;
        let row = |i: usize| [u[i].clone(), v[i].clone(), w[i].clone()];
        let zero = || [0, 1, 2].map(|_| Real::zero(FRAME_BITS));
        let mut legs = Legs::new(([row(0), row(1)], [zero(), zero()]), [row(2)]);
        let mut at = [cell.centre[0].clone(), cell.centre[1].clone()];
        for (k, letter) in self.letters.iter().enumerate() {
            if self.budget.is_spent() {
                return Err(Doubt::open("the work that is allowed is spent"));
            }
            let reach = legs.reach();
            if !reach[0].is_below(&self.widest) {
                return Err(Doubt::open("a set of orbits is too large"));
            }
            let varied = |x: &Real, j: usize| Affine::varied(x.clone(), reach[j].enclosure().sup().clone(), j);
            let law = self.law(&varied(&cell.centre[2], 2))?;
            let one = || Some(Affine::fixed(Real::int(1, bits)));
            let state = State {
                phase: Jet::new([Some(varied(&at[0], 0)), one(), None, None, None]),
                speed: Jet::new([Some(varied(&at[1], 1)), None, one(), None, None]),
            };
            if self.times.len() == k {
                let middle = at.each_ref().map(Real::to_f64);
                self.times.push(guess([&law.gap, &law.e].map(|x| x.value(bits).centre.to_f64()), middle));
            }
            let flown = fly(&law, &state, (*letter, &self.times[k]), &self.budget)?;
            self.budget.spend(bits, 1);
            at = [&flown.state.phase, &flown.state.speed].map(|x| x.value(bits).centre);
            legs.push(&flown, &reach, bits)
                .ok_or_else(|| Doubt::open("a flight is not proved to be differentiable"))?;
        }
        Ok((at, legs))
    }

    fn law(&self, parameter: &Affine) -> Result<Law, Doubt> {
        let law = self.family.law_without_slope(parameter);
        law.ok_or_else(|| Doubt::open("a coefficient of restitution between 0 and 1 and a positive gap are needed"))
    }

    /// Returns what the flights make of a cell.
    pub fn image(&mut self, cell: &Cell) -> Result<Image, Doubt> {
        let bits = self.bits();
        let (at, legs) = self.flown(cell)?;
        let periods = Real::pi(bits) * 2 * self.turns;
        let off = [at[0].clone() - &cell.centre[0] - &periods, at[1].clone() - &cell.centre[1]];
        let starts = [0, 1].map(|i| [0, 1, 2].map(|j| cell.frame[j][i].clone()));
        let slopes = legs.slopes(self.letters.len());
        let slopes = [0, 1].map(|i| [0, 1, 2].map(|j| slopes[i][j].clone() - &starts[i][j]));
        // A.7: on an orbit that is closed, e^2 of each impact
        let e = self.law(&cell.spanned(2))?.e_hull();
        let power = |n: usize| (0..n).fold(Real::int(1, bits), |product, _| product * &e);
        let impacts = self.letters.len();
        let determinant = power(2 * impacts) + 1;
        let by_parameter = power(2 * impacts - 1) * (2 * impacts as i64); // exact: a count
        let (trace, trace_slopes) = (legs.trace(), legs.trace_slopes());
        let critical = |sign: i64| Critical {
            value: determinant.clone() + &(trace.clone() * sign),
            slopes: [0, 1, 2].map(|j| {
                let own = if self.family.is_restitution {
                    by_parameter.clone() * &cell.frame[j][2]
                } else {
                    Real::zero(bits)
                };
                own + &(trace_slopes[j].clone() * sign)
            }),
        };
        Ok(Image { off, slopes, legs, starts, criticals: [critical(-1), critical(1)] })
    }
}

impl Image {
    /// The derivatives by two coordinates.
    fn square(&self, coordinates: [usize; 2]) -> Matrix {
        self.slopes.each_ref().map(|row| coordinates.map(|j| row[j].clone()))
    }

    /// Approximate inverse of these: any matrix is as sound.
    fn newton(&self, coordinates: [usize; 2]) -> Option<Matrix> {
        let middles = self.square(coordinates).map(|row| row.map(|x| x.middle()));
        Some(inverse(&middles)?.map(|row| row.map(|x| x.middle())))
    }

    /// Returns the step of Newton's iteration for a periodic orbit in two coordinates of a thin cell, in its units. Non-rigorous.
    pub fn step(&self, coordinates: [usize; 2]) -> Option<[Real; 2]> {
        Some(self.newton(coordinates)?.map(|row| -along(&row, &self.off)))
    }

    /// Returns the direction of the curve of periodic orbits, of any length. Non-rigorous.
    pub fn direction(&self) -> Point {
        let [a, b] = &self.slopes;
        let minor = |i: usize, j: usize| a[i].clone() * &b[j] - &(a[j].clone() * &b[i]);
        [minor(1, 2), minor(2, 0), minor(0, 1)].map(|x| x.middle())
    }

    /// Returns what has to be below 1 for either coordinate across, and of that the part that is not the curve's own change. Lemma V30
    fn sums(&self) -> Option<([Real; 2], Along)> {
        let newton = self.newton([1, 2])?;
        let change = self.legs.moved(&newton, &self.starts);
        let magnitude = |x: &Real| Real::point(x.enclosure().mag(), FRAME_BITS);
        let own = [0, 1].map(|k| magnitude(&(change[k][1 + k].clone() - 1)) + &magnitude(&change[k][2 - k]));
        let drift = change.each_ref().map(|row| magnitude(&row[0]));
        let moved = newton.each_ref().map(|row| magnitude(&along(row, &self.off)));
        let sums = [0, 1].map(|k| own[k].clone() + &drift[k] + &moved[k]);
        let one = Real::int(1, FRAME_BITS);
        let steepness = greater(&drift).over(&(one - &greater(&own)));
        Some((sums, Along { steepness }))
    }

    /// Returns by how much the sides across are too short, about.
    pub fn stretch(&self) -> Option<[Real; 2]> {
        Some(self.sums()?.0)
    }

    /// Proves that the periodic orbits of the cell are one curve: exactly one for each `q_0`. Lemma V30
    pub fn curve(&self) -> Result<Along, Doubt> {
        let one = Real::int(1, FRAME_BITS);
        let proved = self.sums().filter(|(sums, _)| sums.iter().all(|sum| sum.is_below(&one)));
        proved.map(|(_, along)| along).ok_or_else(|| Doubt::open("the orbits are not proved to be one curve"))
    }
}

/// The greater one of two bounds.
fn greater([a, b]: &[Real; 2]) -> Real {
    let [a, b] = [a, b].map(|x| x.enclosure().sup());
    Real::point(if a < b { b.clone() } else { a.clone() }, FRAME_BITS)
}

impl Critical {
    /// Bounds how much it changes with `q_1` and `q_2`.
    pub fn across(&self) -> Real {
        let [_, a, b] = self.slopes.each_ref().map(|x| Real::point(x.enclosure().mag(), FRAME_BITS));
        a + &b
    }
}

impl Along {
    /// Returns bounds of the derivative by `q_0` along the curve.
    pub fn slope(&self, x: &Critical) -> Option<Real> {
        let most = x.across() * self.steepness.as_ref()?;
        Some(x.slopes[0].clone() + &Real::within(most.enclosure().sup(), FRAME_BITS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_pair_model::watch::Unwatched;

    const BITS: u32 = 192;
    /// Factor by which a set is smaller that is as good as a point, as a power of 2.
    const POINT: i64 = -80;
    /// Places of members in a set.
    const MEMBERS: [[f64; 3]; 4] = [[0.9, -0.8, 0.7], [-0.9, -0.9, 0.1], [0.3, 0.9, -0.9], [-0.5, 0.8, 0.9]];

    fn real(x: f64) -> Real {
        Real::point(Dyadic::from_f64(x).unwrap(), BITS)
    }

    fn contains(all: &Real, one: &Real) -> bool {
        all.enclosure().contains_enclosure(one.enclosure())
    }

    /// `sum_j slopes[j] q_j`
    fn linear(slopes: &[Real], q: [f64; 3]) -> Real {
        slopes.iter().zip(q).fold(Real::zero(BITS), |sum, (slope, q)| sum + &(slope.clone() * &real(q)))
    }

    /// A map along the first flights of the stable orbit of 22 impacts beside figure 14, a set around one of its states, and the same set so small
    /// that it is as good as one of its members.
    struct Flights {
        map: Map<'static>,
        cell: Cell,
    }

    impl Flights {
        fn new(is_restitution: bool) -> Self {
            let letters =
                "NFFNFF".chars().map(|letter| if letter == 'F' { Letter::Far } else { Letter::Near }).collect();
            let [gap, restitution] = [9.424996066377793 / 8.0, 0.5];
            let [parameter, other] = if is_restitution { [restitution, gap] } else { [gap, restitution] };
            let centre = [4.49644493882961, 1.05686022947986, parameter].map(real);
            let frame = [[3.0, 1.0, 0.5], [-1.0, 2.0, 0.0], [0.5, -0.5, 1.0]];
            let cell = Cell::new(centre, frame.map(|direction| direction.map(|x| real(x * 2f64.powi(-26)))));
            let family = Family { is_restitution, other: real(other) };
            let budget = Budget::new(u64::MAX, 64, &Unwatched);
            let map = Map::new(letters, family, budget, &cell.centre).unwrap();
            Self { map, cell }
        }

        fn all(&mut self) -> ([Real; 2], Legs<3, 1>) {
            self.map.flown(&self.cell.clone()).unwrap()
        }

        fn member(&mut self, q: [f64; 3]) -> ([Real; 2], Legs<3, 1>) {
            let Cell { centre, frame } = self.cell.clone();
            let at = [0, 1, 2].map(|i| centre[i].clone() + &linear(&[0, 1, 2].map(|j| frame[j][i].clone()), q));
            let small = Real::point(Dyadic::power_of_two(POINT), BITS);
            let frame = frame.map(|direction| direction.map(|x| x * &small));
            self.map.flown(&Cell { centre: at, frame }).unwrap()
        }
    }

    /// Bounds of derivatives over a set hold those of its members (Lemma V30, derivatives), computed alike in a set that is as good as a point.
    #[test]
    fn derivatives_over_a_set_hold_those_of_its_members() {
        let large = Real::point(Dyadic::power_of_two(-POINT), BITS);
        let scaled = |x: &Real| x.clone() * &large;
        let newton = [[real(3.0), real(-1.0)], [real(2.0), real(5.0)]];
        for is_restitution in [false, true] {
            let mut flights = Flights::new(is_restitution);
            let (_, all) = flights.all();
            let zero = || [0, 1].map(|_| [0, 1, 2].map(|_| Real::zero(BITS)));
            for q in MEMBERS {
                let (_, one) = flights.member(q);
                let pairs = |a: &Rows<3>, b: &Rows<3>| {
                    a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| contains(a, &scaled(b)))
                };
                assert!((0..=6).all(|k| pairs(&all.slopes(k), &one.slopes(k))), "{q:?}");
                assert!(pairs(&all.moved(&newton, &zero()), &one.moved(&newton, &zero())), "{q:?}");
                assert!(contains(&all.trace(), &one.trace()), "{q:?}");
                assert!(
                    all.trace_slopes().iter().zip(&one.trace_slopes()).all(|(a, b)| contains(a, &scaled(b))),
                    "{q:?}"
                );
                let squares =
                    |a: &Matrix, b: &Matrix| a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| contains(a, b));
                assert!(all.to_the_end().iter().zip(&one.to_the_end()).all(|(a, b)| squares(a, b)), "{q:?}");
                for k in 0..6 {
                    let [(by_state, [[p], [r]]), (own, [[a], [b]])] = [&all, &one].map(|legs| legs.of_flight(k));
                    assert!(squares(&by_state, &own) && contains(&p, &a) && contains(&r, &b), "{q:?} {k}");
                }
            }
        }
    }

    /// And they are derivatives: a member differs from the middle by no more than they say, in where it comes to, in the trace, and in the derivative
    /// of each flight.
    #[test]
    fn values_of_members_differ_as_the_derivatives_say() {
        for is_restitution in [false, true] {
            let mut flights = Flights::new(is_restitution);
            let (_, all) = flights.all();
            let (centre, middle) = flights.member([0.0; 3]);
            for q in MEMBERS {
                let (at, one) = flights.member(q);
                let slopes = all.slopes(6);
                assert!((0..2).all(|i| contains(&linear(&slopes[i], q), &(at[i].clone() - &centre[i]))), "{q:?}");
                let apart = one.trace() - &middle.trace();
                assert!(contains(&linear(&all.trace_slopes(), q), &apart), "{q:?}");
                for k in 0..6 {
                    let moved = all.slopes(k);
                    let parameter = linear(&[0, 1, 2].map(|j| flights.cell.frame[j][2].clone()), q);
                    let moved = [linear(&moved[0], q), linear(&moved[1], q), parameter];
                    let [(own, _), (other, _)] = [&one, &middle].map(|legs| legs.of_flight(k));
                    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        let terms = all.bends(k).iter().zip(&moved).map(|(bend, by)| bend[i][j].clone() * by);
                        let bent = terms.fold(Real::zero(BITS), |sum, x| sum + &x);
                        assert!(contains(&bent, &(own[i][j].clone() - &other[i][j])), "{q:?} {k} {i} {j}");
                    }
                }
            }
        }
    }
}
