//! The reduced map along the flights of a period, over cells of states and values of its parameter (Lemma V30).

use super::cell::{Cell, FRAME_BITS, Point};
use super::image::{Critical, Image};
use crate::check::affine::Affine;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use crate::check::legs::Legs;
use crate::check::tangency::flights::{Letter, fly, guess};
use crate::check::tangency::jet::Jet;
use crate::check::tangency::saddle::{Family, Law};
use crate::check::tangency::series::State;
use impact_pair_exact::{Dyadic, Real};

/// log2 of the greatest width in phase of sets that are tried.
const MAX_WIDTH_EXPONENT: i64 = -4;

/// The reduced map along the flights of a period.
pub(super) struct Map<'b> {
    letters: Vec<Letter>,
    family: Family,
    budget: Budget<'b>,
    /// Greatest width in phase of sets that are tried.
    widest: Real,
    /// Approximate durations of the flights.
    times: Vec<Real>,
    /// Forcing periods of the reduced map in one period.
    turns: i64,
}

impl<'b> Map<'b> {
    /// The map along these flights from near a point.
    pub fn new(letters: Vec<Letter>, family: Family, budget: Budget<'b>, near: &Point) -> Result<Self, Doubt> {
        let widest = Real::point(Dyadic::power_of_two(MAX_WIDTH_EXPONENT), FRAME_BITS);
        let mut map = Self { letters, family, budget, widest, times: Vec::new(), turns: 0 };
        let (degenerate, _) = map.degenerate(near);
        let ([phase, _], _) = map.flown(&degenerate)?;
        let passed = phase - &near[0];
        map.turns = (passed.to_f64() / std::f64::consts::TAU).round() as i64; // V30: any whole number
        Ok(map)
    }

    /// Bits of the arithmetic.
    pub fn bits(&self) -> u32 {
        self.family.bits()
    }

    /// Forcing periods of the reduced map in one period.
    pub fn turns(&self) -> i64 {
        self.turns
    }

    /// A cell of almost no size around a point, and the unit of its coordinates.
    pub fn degenerate(&self, at: &Point) -> (Cell, Real) {
        let tiny = Real::point(Dyadic::power_of_two(-2 * i64::from(self.bits())), FRAME_BITS);
        let unit = |i: usize, j: usize| if i == j { tiny.clone() } else { Real::zero(FRAME_BITS) };
        (Cell::new(at.clone(), [0, 1, 2].map(|j| [0, 1, 2].map(|i| unit(i, j)))), tiny.clone())
    }

    /// Encloses the state at the centre after a period, and the derivatives; all flights are proved to be first contacts.
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

    /// Encloses the image of a cell under the flights.
    pub fn image(&mut self, cell: &Cell) -> Result<Image, Doubt> {
        let bits = self.bits();
        let (at, legs) = self.flown(cell)?;
        let periods = Real::pi(bits) * 2 * self.turns;
        let off = [at[0].clone() - &cell.centre[0] - &periods, at[1].clone() - &cell.centre[1]];
        let starts = [0, 1].map(|i| [0, 1, 2].map(|j| cell.frame[j][i].clone()));
        let slopes = legs.slopes(self.letters.len());
        let slopes = [0, 1].map(|i| [0, 1, 2].map(|j| slopes[i][j].clone() - &starts[i][j]));
        // A.7: on a closed orbit the determinant is the product of e^2 over the impacts
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::legs::Rows;
    use crate::check::round::Matrix;
    use impact_pair_model::watch::Unwatched;

    const BITS: u32 = 192;
    /// log2 of the size of a set that is as good as a point.
    const POINT_EXPONENT: i64 = -80;
    /// Positions of members in a set.
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

    /// A map along the first flights of the stable orbit of 22 impacts near figure 14, and a set around one of its states, also in a size
    /// so small that the set is as good as a point.
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
            let small = Real::point(Dyadic::power_of_two(POINT_EXPONENT), BITS);
            let frame = frame.map(|direction| direction.map(|x| x * &small));
            self.map.flown(&Cell { centre: at, frame }).unwrap()
        }
    }

    /// Bounds of derivatives over a set contain those of members (Lemma V30, derivatives), each computed in a set as good as a point.
    #[test]
    fn derivatives_over_a_set_hold_those_of_its_members() {
        let large = Real::point(Dyadic::power_of_two(-POINT_EXPONENT), BITS);
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

    /// The bounds are derivatives: a member differs from the middle by at most these bounds, in its image, in the trace, and in the derivative
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
