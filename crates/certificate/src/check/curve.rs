//! Orbits of a word over a parameter as a curve of states and values of the parameter (Lemma V9).

use super::affine::Affine;
use super::contact::Doubt;
use super::frame::Frame;
use super::round::{Matrix, along, determinant, inverse, times};
use super::step::{Landing, Parameters};
use super::target::Target;
use impact_pair_exact::{Dyadic, Exact, Real};
use impact_pair_model::scene::Key;

/// Phase \[rad\], velocity \[length/rad\] and the parameter.
pub(super) type Point = [Real; 3];

/// The coordinate that is the parameter.
pub(super) const PARAMETER: usize = 2;
/// Steps of Newton's iteration.
const STEPS: u32 = 16;
/// Steps along the curve; each goes half of the way that is left.
const CURVE_STEPS: u32 = 8;
/// Newton's iteration ends below `2^(LAST_STEP_BITS - bits)`, `bits` the precision of the arithmetic.
const LAST_STEP_BITS: i64 = 40;
/// log2 of the ratio of the box that holds all of the curve to the box that holds the curve at an end.
const END_BOX_BITS: i64 = 24;
/// Margin on both sides of the curve: log2 of the ratio to the curve's own deviation.
const ROOM_EXPONENT: i64 = 2;
/// log2 of the greatest ratio of the side of a box along the curve to another side.
const MAX_THINNESS_BITS: i64 = 8;

/// The map of a period over states and a parameter, or of half a period followed by the mirror image.
pub(super) struct Curve<'t> {
    pub target: &'t Target<'t>,
    pub frame: Frame<'t>,
    pub over: Key,
    /// Index of the harmonic whose amplitude is the parameter, and the sum that other harmonics in step with it add.
    pub harmonic: (usize, Option<Exact>),
    pub is_half: bool,
    /// The eigenvalue sought: 1 or -1.
    pub mu: i64,
    /// Units of the coordinates, as powers of 2.
    pub units: [i64; 3],
    /// Approximate durations of the flights of a whole period.
    pub times: Vec<Real>,
}

/// A box: `centre + 2^(sizes + units) q`, `|q_i| <= 1`.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub centre: Point,
    pub sizes: [i64; 3],
}

/// The image of a box under a period, in units.
pub(super) struct Image {
    pub landings: Vec<Landing>,
    /// Displacement of the centre.
    moved: [Real; 2],
    /// Encloses the derivatives by the coordinates over the box.
    slopes: [[Real; 3]; 2],
}

impl Image {
    /// Encloses the derivative by the state.
    pub fn derivative(&self) -> Matrix {
        self.slopes.each_ref().map(|[a, b, _]| [a.clone(), b.clone()])
    }

    /// `det(DP - mu)`, zero where `mu` is an eigenvalue.
    fn critical(&self, mu: i64) -> Real {
        let [[a, b], [c, d]] = self.derivative();
        determinant(&[[a - mu, b], [c, d - mu]])
    }

    /// Encloses the derivatives of `P(x) - x` by the coordinate `j`.
    fn off(&self, j: usize) -> [Real; 2] {
        [0, 1].map(|i| self.slopes[i][j].clone() - i64::from(i == j))
    }
}

impl<'t> Curve<'t> {
    fn bits(&self) -> u32 {
        self.frame.turn.bits()
    }

    fn power(&self, n: i64) -> Real {
        Real::point(Dyadic::power_of_two(n), self.bits())
    }

    /// The data with the given values of the parameter.
    pub fn parameters(&self, value: Affine) -> Parameters<'t> {
        let mut parameters = self.frame.parameters.clone();
        match self.over {
            Key::Amplitude(_) => {
                let others = self.harmonic.1.as_ref().map(|others| Real::of(others, self.bits()));
                let value = others.iter().fold(value, |value, others| value.shifted(others));
                parameters.terms[self.harmonic.0].amplitude = value;
            }
            Key::Restitution => parameters.restitution = value,
            _ => {
                let half = self.power(-1);
                parameters.half_gap = Affine::of(value.centre.half(), &[(&half, &value)]);
            }
        }
        parameters
    }

    /// The coordinate `i` over a box.
    pub fn spanned(&self, cell: &Cell, i: usize) -> Affine {
        let zero = Real::zero(self.bits());
        Affine::spanned(cell.centre[i].clone(), i, [self.power(cell.sizes[i] + self.units[i]), zero])
    }

    /// Encloses the image of a box under a round, if all contacts are proved; `is_half`: half a period followed by the mirror image.
    pub fn image(&self, cell: &Cell, is_half: bool) -> Result<Image, Doubt> {
        let clock = self.frame.clock.clone();
        let parameters = self.parameters(self.spanned(cell, PARAMETER));
        let frame = Frame { parameters, clock, turn: self.frame.turn.clone() };
        let flights = if is_half { self.times.len() / 2 } else { self.times.len() };
        let mut round = self.target.round(&frame, self.times[..flights].to_vec(), self.target.is_physical());
        if is_half {
            round.lasting = round.lasting.half();
        }
        let start = Landing::new(self.target.walls[0], self.spanned(cell, 0), self.spanned(cell, 1));
        let mut landings = round.run(start)?;
        let end = landings.last_mut().expect("the set");
        if is_half {
            let minus = Real::int(-1, self.bits());
            end.wall = end.wall.other();
            end.velocity = Affine::of(-end.velocity.centre.clone(), &[(&minus, &end.velocity)]);
        }
        let ends = [&end.phase, &end.velocity];
        let moved = [0, 1].map(|i| (ends[i].without(0).hull() - &cell.centre[i]) * &self.power(-self.units[i]));
        let slope =
            |i: usize, j: usize| ends[i].column(j).at(self.bits()) * &self.power(-cell.sizes[j] - self.units[i]);
        let slopes = [0, 1].map(|i| [0, 1, 2].map(|j| slope(i, j)));
        Ok(Image { landings, moved, slopes })
    }

    /// Image of a point under the map; the durations of the flights are kept.
    fn near(&self, at: &Point) -> Result<Image, Doubt> {
        self.image(&Cell { centre: at.clone(), sizes: [-i64::from(self.bits()); 3] }, self.is_half)
    }

    /// Computes the durations of the flights from a point.
    fn retime(&mut self, at: &Point) -> Result<(), Doubt> {
        let sizes = [-i64::from(self.bits()); 3];
        let Image { landings, .. } = self.image(&Cell { centre: at.clone(), sizes }, false)?;
        let phases: Vec<_> = landings.iter().map(|landing| self.point(&landing.phase.centre)).collect();
        let lasting = self.frame.turn.clone() * i64::try_from(self.target.cycles).unwrap_or(i64::MAX); // proposes
        self.times = phases.windows(2).map(|flight| self.point(&(flight[1].clone() - &flight[0]))).collect();
        let last = self.times.pop().expect("a flight") + &lasting;
        self.times.push(self.point(&last));
        Ok(())
    }

    fn point(&self, x: &Real) -> Real {
        Real::point(x.mid(), self.bits())
    }

    /// The point at which Newton's iteration for an orbit with the eigenvalue `mu` ends. Non-rigorous.
    pub fn polish(&mut self, guess: Point) -> Result<Point, Doubt> {
        let open = || Doubt::open("no bifurcation is found near");
        let (mut at, mut before) = (guess.map(|x| self.point(&x)), None::<Dyadic>);
        let far = i64::from(self.bits() / 4);
        for _ in 0..STEPS {
            self.retime(&at)?;
            let here = self.near(&at)?;
            let critical = here.critical(self.mu);
            let mut gradient = [0, 1, 2].map(|_| Real::zero(self.bits()));
            for (j, slope) in gradient.iter_mut().enumerate() {
                let mut there = at.clone();
                there[j] = there[j].clone() + &self.power(self.units[j] - far);
                *slope = self.point(&((self.near(&there)?.critical(self.mu) - &critical) * &self.power(far)));
            }
            let [one, other] = [0, 1].map(|i| [0, 1, 2].map(|j| self.point(&here.off(j)[i])));
            let step =
                solved(&[one, other, gradient], &[&here.moved[0], &here.moved[1], &critical]).ok_or_else(open)?;
            let size = step.iter().map(|x| x.enclosure().mag()).max().unwrap_or_else(Dyadic::zero); // proposes: when to stop
            // The step grows again: rounding leaves no more digits.
            if before.is_some_and(|before| size.scaled(1) > before) {
                return Ok(at);
            }
            at = [0, 1, 2].map(|i| self.point(&(at[i].clone() - &(step[i].clone() * &self.power(self.units[i])))));
            // proposes: when to stop
            if size.top().is_none_or(|top| top < LAST_STEP_BITS - i64::from(self.bits())) {
                return Ok(at);
            }
            before = Some(size);
        }
        Err(open())
    }

    /// A point of the curve near the value `to` of the parameter. Each step from `from` halves the rest of the way, so steps are shortest
    /// near a fold. Non-rigorous.
    pub fn walked(&mut self, from: Point, to: &Real) -> Result<Point, Doubt> {
        let mut at = from.map(|x| self.point(&x));
        for _ in 0..CURVE_STEPS {
            self.retime(&at)?;
            at[PARAMETER] = self.point(&(at[PARAMETER].clone() + to).half());
            at = self.on_curve(at, PARAMETER)?;
        }
        self.retime(&at)?;
        at[PARAMETER] = self.point(to);
        Ok(at)
    }

    /// The point of the curve with the same coordinate `along` as a guess. Non-rigorous.
    fn on_curve(&self, mut at: Point, along: usize) -> Result<Point, Doubt> {
        let others = others(along);
        for _ in 0..STEPS / 4 {
            let here = self.near(&at)?;
            let newton = newton(&here, others).ok_or_else(lost)?;
            let step = newton.each_ref().map(|row| super::round::along(row, &here.moved));
            for (k, &i) in others.iter().enumerate() {
                at[i] = self.point(&(at[i].clone() - &(step[k].clone() * &self.power(self.units[i]))));
            }
        }
        Ok(at)
    }

    /// A box around a point of the curve, `2^size` units to both sides in the coordinate `j`, in which a bifurcation is proved: the
    /// curve is a graph over that coordinate, and `det(DP - mu)` has opposite signs at two points of the curve.
    pub fn crossing(&self, at: &Point, j: usize, size: i64) -> Result<Cell, Doubt> {
        let here = self.near(at)?;
        let slopes = newton(&here, others(j)).ok_or_else(lost)?.map(|row| -along(&row, &here.off(j)));
        let mut sizes = [size; 3];
        for (&i, slope) in others(j).iter().zip(&slopes) {
            let top = slope.enclosure().mag().top().unwrap_or(-MAX_THINNESS_BITS); // proposes: a size to try
            sizes[i] = size + ROOM_EXPONENT + top.max(-MAX_THINNESS_BITS); // proposes: a size to try
        }
        let cell = Cell { centre: at.clone(), sizes };
        is_curve(&self.image(&cell, self.is_half)?, &cell, j)?;
        let [before, after] = [-1, 1].map(|sign| self.sign_at(&cell, j, &slopes, sign));
        if before?.is_lt() == after?.is_lt() {
            return Err(Doubt::open("no eigenvalue is proved to pass 1 or -1 there"));
        }
        Ok(cell)
    }

    /// The proved sign of `det(DP - mu)` at the point of the curve halfway to the box's end on the side `sign`.
    fn sign_at(&self, cell: &Cell, j: usize, slopes: &[Real; 2], sign: i64) -> Result<std::cmp::Ordering, Doubt> {
        let by = self.power(cell.sizes[j] - 1) * sign;
        let mut guess = cell.centre.clone();
        guess[j] = guess[j].clone() + &(by.clone() * &self.power(self.units[j]));
        for (&i, slope) in others(j).iter().zip(slopes) {
            guess[i] = self.point(&(guess[i].clone() + &(slope.clone() * &by * &self.power(self.units[i]))));
        }
        let end = Cell { centre: self.on_curve(guess, j)?, sizes: cell.sizes.map(|size| size - END_BOX_BITS) };
        let image = self.image(&end, self.is_half)?;
        is_curve(&image, &end, j)?;
        let is_inside = (0..3).all(|i| {
            let [large, small] = [cell, &end].map(|cell| self.power(cell.sizes[i] + self.units[i]));
            let off = Real::point((end.centre[i].clone() - &cell.centre[i]).enclosure().mag(), self.bits());
            (off + &small).is_below(&large)
        });
        let critical = image.critical(self.mu);
        match critical.sign().filter(|sign| is_inside && sign.is_ne()) {
            Some(sign) => Ok(sign),
            None => Err(Doubt::open("it is not decided on which side of 1 or -1 an eigenvalue lies")),
        }
    }
}

/// Proves that the orbits in a box are one curve over the coordinate `j`: exactly one orbit for each value (Lemma V9).
fn is_curve(image: &Image, cell: &Cell, j: usize) -> Result<(), Doubt> {
    let bits = image.moved[0].bits();
    let others = others(j);
    let size = |i: usize| Real::point(Dyadic::power_of_two(cell.sizes[i]), bits);
    let newton = newton(image, others).ok_or_else(lost)?;
    // In the coordinates q.
    let newton = [0, 1].map(|k| {
        let shrunk = Real::point(Dyadic::power_of_two(-cell.sizes[others[k]]), bits);
        newton[k].clone().map(|x| x * &shrunk)
    });
    let [one, other] = others.map(|i| image.off(i).map(|x| x * &size(i)));
    let columns = [[one[0].clone(), other[0].clone()], [one[1].clone(), other[1].clone()]];
    let change = times(&newton, &columns);
    let drift = image.off(j).map(|x| x * &size(j));
    let unit = Real::int(1, bits);
    let magnitude = |x: &Real| Real::point(x.enclosure().mag(), bits);
    for (k, row) in newton.iter().enumerate() {
        let factor = magnitude(&(change[k][k].clone() - 1)) + &magnitude(&change[k][1 - k]);
        let moved = magnitude(&along(row, &image.moved)) + &magnitude(&along(row, &drift));
        if !(factor.is_below(&unit) && (factor + &moved).is_below(&unit)) {
            return Err(Doubt::open("the orbits are not proved to be one curve"));
        }
    }
    Ok(())
}

/// Approximate inverse of the derivatives of `P(x) - x` by two coordinates; any matrix is sound.
fn newton(image: &Image, coordinates: [usize; 2]) -> Option<Matrix> {
    let [one, other] = coordinates.map(|j| image.off(j).map(|x| x.middle()));
    let [[a, c], [b, d]] = [one, other];
    Some(inverse(&[[a, b], [c, d]])?.map(|row| row.map(|x| x.middle())))
}

fn others(j: usize) -> [usize; 2] {
    [(j + 1) % 3, (j + 2) % 3]
}

fn lost() -> Doubt {
    Doubt::open("the curve of the orbits is lost")
}

/// Approximate solution of three linear equations.
fn solved(rows: &[Point; 3], right: &[&Real; 3]) -> Option<Point> {
    let minor =
        |a: usize, b: usize, i: usize, j: usize| rows[a][i].clone() * &rows[b][j] - &(rows[a][j].clone() * &rows[b][i]);
    // Adjoint matrix over the determinant.
    let adjoint = |i: usize, k: usize| minor((k + 1) % 3, (k + 2) % 3, (i + 1) % 3, (i + 2) % 3);
    let whole = (0..3).map(|i| rows[0][i].clone() * &adjoint(i, 0)).reduce(|sum, x| sum + &x)?;
    let solution = |i: usize| (0..3).map(|k| adjoint(i, k) * right[k]).reduce(|sum, x| sum + &x)?.over(&whole.middle());
    Some([solution(0)?, solution(1)?, solution(2)?])
}
