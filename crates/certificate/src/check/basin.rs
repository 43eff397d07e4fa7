//! Ellipses of states that a period, or Newton's step for its fixed point, maps into themselves and contracts (Lemmas V6, V8).

use super::affine::Affine;
use super::axes::axes;
use super::contact::Doubt;
use super::round::{Matrix, Round, determinant, inverse, times};
use super::step::Landing;
use impact_pair_exact::{Dyadic, Real};

/// The states `centre + 2^size T s`, `|s| <= 1`.
#[derive(Clone, Debug)]
pub(super) struct Ellipse {
    centre: [Real; 2],
    /// `T`
    axes: Matrix,
    /// `T^-1`
    inverse: Matrix,
    /// `K` of Newton's step, in the coordinates `s`; `None` stands for `K = -1`, the period itself.
    newton: Option<Matrix>,
    size: i64,
}

/// The image of an ellipse under a period.
pub(super) struct Contraction {
    pub ellipse: Ellipse,
    /// The impacts in one period; the last is the next first impact.
    pub landings: Vec<Landing>,
    /// Encloses `T^-1 DP T` over the ellipse.
    pub derivative: Matrix,
    /// Greatest factor by which distances are multiplied, with the ellipse's radius as the unit.
    factor: Real,
    /// Displacement of the centre.
    moved: Real,
}

/// Velocity units in which axes are sought, relative to the velocity of the first impact.
const VELOCITY_UNITS: [f64; 3] = [1.0, 0.125, 8.0];
/// log2 of the ratio of successive trial ellipses.
const SHRINK_EXPONENT: usize = 2;
impl Ellipse {
    /// `None` where `T` may have no inverse.
    pub fn new(centre: [Real; 2], axes: Matrix, newton: Option<Matrix>, size: i64) -> Option<Self> {
        let inverse = inverse(&axes)?;
        Some(Self { centre, axes, inverse, newton, size })
    }

    /// An ellipse of the same axes around another centre.
    pub fn around(&self, centre: [Real; 2], size: i64) -> Option<Self> {
        let bits = centre[0].bits();
        let at = |matrix: &Matrix| matrix.each_ref().map(|row| row.each_ref().map(|x| x.at(bits)));
        Self::new(centre, at(&self.axes), self.newton.as_ref().map(at), size)
    }

    /// The same ellipse in another size.
    pub fn sized(&self, size: i64) -> Self {
        Self { size, ..self.clone() }
    }

    /// Encloses `|s|` of all states of a set.
    fn place(&self, set: [&Affine; 2]) -> Option<Real> {
        self.length(&self.inverse, set)
    }

    /// Encloses the length of `matrix (x - centre) / 2^size` for all states of a set.
    fn length(&self, matrix: &Matrix, set: [&Affine; 2]) -> Option<Real> {
        let [square, other] = matrix.each_ref().map(|row| {
            let off = [0, 1].map(|i| set[i].centre.clone() - &self.centre[i]);
            let centre = super::round::along(row, &off);
            Affine::of(centre, &[(&row[0], set[0]), (&row[1], set[1])]).hull().square()
        });
        Some((square + &other).sqrt()? * &self.radius(-1))
    }

    /// Whether all states of a set lie strictly inside.
    pub fn holds(&self, set: &Landing) -> bool {
        self.place([&set.phase, &set.velocity]).is_some_and(|place| place.is_below(&Real::int(1, place.bits())))
    }

    /// The least size for which the ellipse holds a set; `None` where no square root is enclosed.
    pub fn size_for(&self, set: &Landing) -> Option<i64> {
        let place = self.sized(0).place([&set.phase, &set.velocity])?;
        Some(place.enclosure().sup().top().map_or(i64::MIN, |top| top + 1)) // exact: a point has no size
    }

    /// `2^(sign size)`
    fn radius(&self, sign: i64) -> Real {
        Real::point(Dyadic::power_of_two(sign * self.size), self.centre[0].bits())
    }

    /// Encloses the image of the ellipse under a round; fails unless all first contacts are proved.
    pub fn contracted(self, round: &Round<'_>) -> Result<Contraction, Doubt> {
        let landings = self.run(round)?;
        let end = landings.last().expect("the set");
        let derivative = times(&self.inverse, &round.derivatives(end, &self.radius(-1)));
        let open = || Doubt::open("no neighbourhood of the orbit is enclosed");
        let (step, change) = match &self.newton {
            None => (self.inverse.clone(), derivative.clone()),
            // N(s) = s - K (p(s) - s); the sign does not matter for lengths.
            Some(newton) => (times(newton, &self.inverse), less_one(&times(newton, &less_one(&derivative)))),
        };
        let moved = |landings: &[Landing]| {
            let end = landings.last().expect("the set");
            let centre = [&end.phase, &end.velocity].map(|x| x.without(round.first()));
            self.length(&step, [&centre[0], &centre[1]]).ok_or_else(open)
        };
        let (mut moved_by, factor) = (moved(&landings)?, norm(&change).ok_or_else(open)?);
        // V8: first contacts do not depend on the set that is run, and a smaller one is rounded less
        if round.is_physical && !is_inside(&factor, &moved_by) && is_inside(&factor, &Real::zero(factor.bits())) {
            moved_by = moved(&self.sized(-i64::from(self.centre[0].bits())).run(round)?)?;
        }
        Ok(Contraction { ellipse: self, landings, derivative, factor, moved: moved_by })
    }

    /// The impacts of the ellipse's states in a round.
    fn run(&self, round: &Round<'_>) -> Result<Vec<Landing>, Doubt> {
        let radius = self.radius(1);
        let columns = self.axes.each_ref().map(|row| row.each_ref().map(|x| x.clone() * &radius));
        round.run(round.set(&self.centre, &columns))
    }
}

impl Contraction {
    /// Whether the ellipse is proved to be mapped into itself and contracted, by the period or by Newton's step.
    pub fn is_proved(&self) -> bool {
        is_inside(&self.factor, &self.moved)
    }

    /// Approximate factor, as a power of 2, by which an ellipse that holds the orbit is larger than this ellipse.
    pub fn larger_by(&self) -> i64 {
        let rest = Real::int(1, self.factor.bits()) - &self.factor;
        let needed = self.moved.over(&rest).and_then(|needed| needed.enclosure().sup().top());
        needed.map_or(1, |top| top + 2).max(1) // proposes: a size to try
    }
}

/// Shapes of ellipses around `centre` that the period may contract; `derivative` is the round's derivative near the centre.
pub(super) fn contracted(centre: &[Real; 2], derivative: &Matrix) -> Vec<Ellipse> {
    let bits = centre[0].bits();
    let shape = |unit: &f64| {
        let [[a, b], [c, d]] = axes(derivative, unit * centre[1].to_f64().abs())?
            .map(|row| row.map(|x| Dyadic::from_f64(x).map(|x| Real::point(x, bits))));
        Ellipse::new(centre.clone(), [[a?, b?], [c?, d?]], None, 0)
    };
    VELOCITY_UNITS.iter().filter_map(shape).collect()
}

/// Shapes of ellipses around `centre` that Newton's step may contract.
pub(super) fn stepped(centre: &[Real; 2], derivative: &Matrix) -> Vec<Ellipse> {
    let bits = centre[0].bits();
    let point = |x: &Real| Real::point(x.mid(), bits);
    let shape = |unit: &f64| {
        let unit = Real::point(Dyadic::from_f64(unit * centre[1].to_f64().abs()).filter(|unit| !unit.is_zero())?, bits);
        let [[a, b], [c, d]] = derivative.each_ref().map(|row| row.each_ref().map(point));
        let newton = inverse(&less_one(&[[a, b * &unit], [c.over(&unit)?, d]]))?;
        let newton = newton.map(|row| row.map(|x| point(&x)));
        Ellipse::new(
            centre.clone(),
            [[Real::int(1, bits), Real::zero(bits)], [Real::zero(bits), unit]],
            Some(newton),
            0,
        )
    };
    VELOCITY_UNITS.iter().filter_map(shape).collect()
}

/// The largest ellipse of the given shapes that is proved to be contracted; the first trial size holds all `targets`.
pub(super) fn basin(round: &Round<'_>, shapes: &[Ellipse], targets: &[&Landing]) -> Result<Ellipse, Doubt> {
    let bits = round.parameters.bits();
    let sizes = shapes.iter().flat_map(|shape| targets.iter().map(|set| shape.size_for(set)));
    let least = -i64::from(bits / 2);
    let most = sizes.flatten().max().unwrap_or(0).min(0).max(least); // proposes: sizes to try
    let mut doubt = Doubt::open("the orbit is not proved to be stable");
    for size in (least..=most).rev().step_by(SHRINK_EXPONENT) {
        for shape in shapes {
            match shape.sized(size).contracted(round) {
                Ok(contraction) if contraction.is_proved() => return Ok(contraction.ellipse),
                Ok(_) => doubt = Doubt::open("no neighbourhood of the orbit is proved to be contracted"),
                Err(found) => doubt = found,
            }
        }
    }
    Err(doubt)
}

/// Whether an affine bound maps a disc of radius 1 into itself: its factor is below 1, its centre is displaced by `moved`. Lemmas V6, V8
fn is_inside(factor: &Real, moved: &Real) -> bool {
    let (one, reach) = (Real::int(1, factor.bits()), factor.clone() + moved);
    factor.is_below(&one) && reach.enclosure().sup() <= one.enclosure().inf()
}

/// `M - 1`
fn less_one([[a, b], [c, d]]: &Matrix) -> Matrix {
    let one = Real::int(1, a.bits());
    [[a.clone() - &one, b.clone()], [c.clone(), d.clone() - &one]]
}

/// An upper bound of the norm of all matrices of a set (Lemma Q2).
fn norm(matrix: &Matrix) -> Option<Real> {
    let squares = matrix.iter().flatten().map(Real::square).reduce(|sum, x| sum + &x)?;
    let product = determinant(matrix);
    let apart = (squares.square() - &(product.square() * 4)).sqrt()?;
    (squares + &apart).half().sqrt()
}
