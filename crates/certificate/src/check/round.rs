//! Whole periods of a word of mappings, for all states of a set (Lemma V2).

use super::affine::{Affine, COLUMN_BITS};
use super::contact::{Claimed, Doubt};
use super::step::{Landing, Launch, Parameters};
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::Wall;

/// A 2 x 2 matrix, by rows: of phases and velocities.
pub(super) type Matrix = [[Real; 2]; 2];

/// Steps of Newton's iteration.
const STEPS: u32 = 40;
/// Newton's iteration ends below `2^(LAST_STEP_BITS - bits)`, `bits` the precision of the arithmetic.
const LAST_STEP_BITS: i64 = 32;

/// A period of a word: from a state just before its first impact to the next such state.
pub(super) struct Round<'p> {
    pub parameters: &'p Parameters<'p>,
    /// Walls of the impacts, in time order.
    pub walls: &'p [Wall],
    /// Common period, after which the forcing repeats \[rad\].
    pub common: Real,
    /// The cycles of the word \[rad\].
    pub lasting: Real,
    /// True if all contacts have to be first contacts.
    pub is_physical: bool,
    /// Approximate durations of the flights.
    pub times: Vec<Real>,
}

impl Round<'_> {
    fn bits(&self) -> u32 {
        self.parameters.bits()
    }

    /// Index of the first of the two deviations of states.
    pub fn first(&self) -> usize {
        self.parameters.columns()
    }

    /// The states `centre + columns q`, `q` the two deviations of states.
    pub fn set(&self, centre: &[Real; 2], columns: &Matrix) -> Landing {
        let [phase, velocity] = [0, 1].map(|i| Affine::spanned(centre[i].clone(), self.first(), columns[i].clone()));
        Landing::new(self.walls[0], phase, velocity)
    }

    /// The set, its impacts and the next first impact, shifted back by the duration of the round; all contacts are proved.
    pub fn run(&self, set: Landing) -> Result<Vec<Landing>, Doubt> {
        self.run_under(self.parameters, set)
    }

    fn run_under(&self, parameters: &Parameters, set: Landing) -> Result<Vec<Landing>, Doubt> {
        let mut landings = vec![set];
        let next = self.walls.iter().cycle().skip(1);
        for (i, (&wall, time)) in next.zip(&self.times).enumerate() {
            let departure = Launch::rebound(parameters, &landings[i]);
            let claimed =
                Claimed { from: Real::zero(self.bits()), guess: time.clone(), to: None, is_first: self.is_physical };
            landings.push(departure.land(parameters, wall, &claimed)?);
        }
        let Landing { wall, phase, velocity, .. } = landings.pop().expect("the set");
        landings.push(Landing::new(wall, phase.shifted(&-self.lasting.clone()), velocity));
        Ok(landings)
    }

    /// Encloses the derivatives of a state by the two deviations, multiplied by `times`.
    pub fn derivatives(&self, state: &Landing, times: &Real) -> Matrix {
        let column = |x: &Affine, j: usize| x.column(self.first() + j) * times;
        [&state.phase, &state.velocity].map(|x| [column(x, 0), column(x, 1)])
    }

    /// The state at which Newton's iteration for a periodic state, with data at their middles, ends, and the derivative of the round near
    /// that state. Non-rigorous.
    pub fn polish(&mut self, guess: [Real; 2]) -> Result<([Real; 2], Matrix), Doubt> {
        let bits = self.bits();
        let point = |x: &Real| Real::point(x.mid(), bits);
        let (mut state, mut before) = (guess.map(|x| point(&x)), None::<Dyadic>);
        let [tiny, large] = [-i64::from(bits), bits.into()].map(|n| Real::point(Dyadic::power_of_two(n), COLUMN_BITS));
        let (zero, middle) = (|| Real::zero(COLUMN_BITS), self.parameters.middle());
        for _ in 0..STEPS {
            let landings =
                self.run_under(&middle, self.set(&state, &[[tiny.clone(), zero()], [zero(), tiny.clone()]]))?;
            let starts = landings.iter().map(|landing| point(&landing.phase.centre));
            let mut lasting: Vec<_> = starts.clone().zip(starts.skip(1)).map(|(from, to)| to - &from).collect();
            lasting.iter_mut().last().into_iter().for_each(|last| *last = point(&(last.clone() + &self.lasting)));
            self.times = lasting;
            let end = landings.last().expect("the set");
            let derivative = self.derivatives(end, &large).map(|row| row.map(|x| point(&x)));
            let miss = [&end.phase, &end.velocity].map(|x| point(&x.centre));
            let miss = [0, 1].map(|i| miss[i].clone() - &state[i]);
            let [[a, b], [c, d]] = derivative.clone();
            let one = Real::int(1, bits);
            let inverse = inverse(&[[one.clone() - &a, -b], [-c, one - &d]]);
            let step = inverse.map(|inverse| inverse.map(|row| point(&along(&row, &miss))));
            let Some(step) = step else {
                return Err(Doubt::open("an orbit is not distinguished from its neighbours"));
            };
            let size = step.iter().map(|x| x.enclosure().mag()).max().unwrap_or_else(Dyadic::zero); // proposes: when to stop
            // The step grows again: rounding leaves no more digits.
            if before.is_some_and(|before| size.scaled(1) > before) {
                return Ok((state, derivative));
            }
            state = [0, 1].map(|i| point(&(state[i].clone() + &step[i])));
            if size.top().is_none_or(|top| top < LAST_STEP_BITS - i64::from(bits)) {
                return Ok((state, derivative));
            }
            before = Some(size);
        }
        Err(Doubt::open("no periodic orbit is found near the motion"))
    }

    /// Phases shifted by whole common periods to be nearest to `other`; `None` beyond integers of 64 bits.
    pub fn near(&self, phases: &Affine, other: &Real) -> Option<Affine> {
        let ahead = (phases.centre.clone() - other).over(&self.common)?;
        let periods = (ahead.middle() + &Real::int(1, self.bits()).half()).floor()?; // V6: any whole number of periods
        Some(phases.clone().shifted(&-(self.common.clone() * periods)))
    }
}

/// The product of a row and a column.
pub(super) fn along(row: &[Real; 2], column: &[Real; 2]) -> Real {
    row[0].clone() * &column[0] + &(row[1].clone() * &column[1])
}

/// The product of two matrices.
pub(super) fn times(left: &Matrix, right: &Matrix) -> Matrix {
    let columns = [0, 1].map(|j| [right[0][j].clone(), right[1][j].clone()]);
    left.each_ref().map(|row| columns.each_ref().map(|column| along(row, column)))
}

/// Encloses the inverse; `None` if the matrix may be singular.
pub(super) fn inverse(matrix: &Matrix) -> Option<Matrix> {
    let [[a, b], [c, d]] = matrix;
    let determinant = determinant(matrix);
    let over = |x: Real| x.over(&determinant);
    Some([[over(d.clone())?, over(-b.clone())?], [over(-c.clone())?, over(a.clone())?]])
}

pub(super) fn determinant([[a, b], [c, d]]: &Matrix) -> Real {
    a.clone() * d - &(b.clone() * c)
}
