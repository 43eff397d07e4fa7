//! Curves across an h-set that move with the parameters (Lemma V39).

use impact_pair_document::{Decimal, MovedDocument};

use super::super::Law;
use super::super::bases::HSet;
use super::super::cones::Frame;
use super::super::span::Span;

/// A curve across an h-set, in the coordinates of its parallelogram: for powers of `D` and `e`, each from -1 to 1, a polynomial of the height.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    /// That of no parameter, coefficients from the constant on.
    still: Vec<Span>,
    moved: Vec<([u32; 2], Vec<Span>)>,
}

/// Heights from one to another, both dyadic fractions of the whole height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heights {
    pub low: f64,
    pub high: f64,
}

/// Some of all values of `D` and of `e`: for each from which fraction to which, all being from -1 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values([[f64; 2]; 2]);

/// For `D` and for `e` the numbers `a` and `b` for which `a + b x` is what it is among all values, where `x` is what it is among some.
pub(super) type Shift = [[Span; 2]; 2];

/// Coefficients of a polynomial at most, powers of parameters, and the greatest exponents.
const MAX_COEFFICIENTS: usize = 32;
const MAX_MOVES: usize = 32;
const MAX_EXPONENT: u32 = 8;
/// The topmost height is `1 + 2^-30` at least, since corners are rounded.
const HIGHEST: i32 = 30;
/// Halvings of the whole height where two curves are compared, and of parameters.
const MAX_HALVINGS: u32 = 16;
const MAX_CUTS: u32 = 4;

impl Heights {
    /// Those up to the least number `1 + 2^-k`, `k` at most 30, that is beyond all corners of an h-set; `None` if there is none.
    pub fn of(frame: &Frame, base: &HSet) -> Option<Self> {
        let corners = [base.left.bottom, base.left.top, base.right.bottom, base.right.top];
        let heights = corners.map(|corner| frame.place(corner.map(Span::point), 0.0).map(|[_, eta]| eta));
        let is_beyond = |top: &f64| {
            let top = Span::point(*top);
            heights.iter().all(|eta| eta.is_some_and(|eta| (top - eta).is_positive() && (top + eta).is_positive()))
        };
        let top = (0..=HIGHEST).rev().map(|k| 1.0 + f64::powi(0.5, k)).find(is_beyond)?; // V39: exact
        Some(Self { low: -top, high: top })
    }

    /// Holds all of them.
    pub fn all(&self) -> Span {
        Span::new(self.low, self.high)
    }

    /// Returns the lower and the upper half.
    pub fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.low + self.high); // V39: exact
        [Self { high: middle, ..*self }, Self { low: middle, ..*self }]
    }
}

impl Values {
    pub const ALL: Self = Self([[-1.0, 1.0]; 2]);

    /// Returns both halves of those of one parameter.
    pub fn halves(&self, parameter: usize) -> [Self; 2] {
        let Self(ends) = self;
        let [from, to] = ends[parameter];
        let middle = 0.5 * (from + to); // V39: exact
        [[from, middle], [middle, to]].map(|half| {
            let mut ends = *ends;
            ends[parameter] = half;
            Self(ends)
        })
    }

    /// Returns these values of a law, and what they are among all.
    pub fn of(&self, law: &Law) -> (Law, Shift) {
        let one = |all: Span, [from, to]: [f64; 2]| {
            if [from, to] == [-1.0, 1.0] {
                return (all, [Span::point(0.0), Span::point(1.0)]); // V39: all of them
            }
            let (middle, around) = all.centred_parts();
            let radius = Span::point(around.hi());
            let some = middle + radius * Span::new(from, to);
            let (own, own_around) = some.centred_parts();
            // No curve moves with a number.
            let part = |x: Span| x.over(radius).unwrap_or(Span::point(0.0)); // V39: any function of a number
            (some, [part(own - middle), part(Span::point(own_around.hi()))])
        };
        let Self([gap, restitution]) = *self;
        let ((gap, by_gap), (restitution, by_restitution)) = (one(law.gap, gap), one(law.restitution, restitution));
        (Law { gap, restitution }, [by_gap, by_restitution])
    }
}

/// Holds a polynomial at some heights.
fn value(parts: &[Span], height: Span) -> Span {
    parts.iter().rev().fold(Span::point(0.0), |sum, &part| sum * height + part)
}

/// Holds its second derivative there.
fn bend(parts: &[Span], height: Span) -> Span {
    let twice = |(k, &part): (usize, &Span)| Span::point((k * k - k) as f64) * part; // exact: small numbers
    parts.iter().enumerate().skip(2).map(twice).rev().fold(Span::point(0.0), |sum, part| sum * height + part)
}

/// Adds the coefficients of one polynomial to those of another one, each times a number.
fn add(sum: &mut Vec<Span>, parts: &[Span], factor: Span) {
    let count = sum.len().max(parts.len()); // exact: of two numbers
    sum.resize(count, Span::point(0.0));
    sum.iter_mut().zip(parts).for_each(|(sum, &part)| *sum = *sum + part * factor);
}

/// Returns the coefficients of `(a + b x)^power`.
fn power([a, b]: [Span; 2], power: u32) -> Vec<Span> {
    (0..power).fold(vec![Span::point(1.0)], |all, _| {
        let mut next = vec![Span::point(0.0)];
        add(&mut next, &all, a);
        next.push(Span::point(0.0));
        all.iter().zip(&mut next[1..]).for_each(|(&part, sum)| *sum = *sum + part * b);
        next
    })
}

impl Curve {
    /// Reads a curve; `None` if a coefficient is no finite double, or if there are none, or too many, or too great exponents.
    pub fn read<'d>(
        still: &[Decimal],
        moved: impl Iterator<Item = (&'d MovedDocument, &'d Vec<Decimal>)>,
    ) -> Option<Self> {
        let parts = |document: &[Decimal]| -> Option<Vec<Span>> {
            // V39: the nearest doubles
            let coefficient =
                |part: &Decimal| part.text().parse().ok().filter(|part: &f64| part.is_finite()).map(Span::point);
            let is_sound = (1..=MAX_COEFFICIENTS).contains(&document.len());
            is_sound.then(|| document.iter().map(coefficient).collect()).flatten()
        };
        let moves = |(MovedDocument { by, .. }, side): (&MovedDocument, &Vec<Decimal>)| {
            let is_sound = *by != [0, 0] && by.iter().all(|&power| power <= MAX_EXPONENT); // V39: any power
            Some((*by, parts(side)?)).filter(|_| is_sound)
        };
        let moved: Vec<_> = moved.map(moves).collect::<Option<_>>()?;
        let is_sound =
            moved.len() <= MAX_MOVES && (1..moved.len()).all(|k| moved[..k].iter().all(|own| own.0 != moved[k].0));
        Some(Self { still: parts(still)?, moved }).filter(|_| is_sound)
    }

    /// The curve that is at one place at all heights, for all parameters.
    pub fn upright(place: f64) -> Self {
        Self { still: vec![Span::point(place)], moved: Vec::new() }
    }

    /// Holds its places at some heights for the middle parameters.
    pub fn at(&self, height: Span) -> Span {
        value(&self.still, height)
    }

    fn by(&self, powers: [u32; 2], height: Span) -> Span {
        self.moved.iter().find(|(by, _)| *by == powers).map_or(Span::point(0.0), |(_, parts)| value(parts, height)) // V39: there is none
    }

    /// About how far `D`, and `e`, move its place at a height, each by its radius.
    pub fn moves(&self, height: f64) -> [f64; 2] {
        [[1, 0], [0, 1]].map(|by| self.by(by, Span::point(height)).mid())
    }

    /// Holds what is left of its place at a height without those of the middle parameters and of these moves.
    pub fn rest(&self, height: f64, moves: [f64; 2]) -> Span {
        let height = Span::point(height);
        let linear = [0, 1].map(|k| self.by([[1, 0], [0, 1]][k], height) - Span::point(moves[k]));
        let others = self.moved.iter().filter(|(by, _)| by[0] + by[1] > 1).map(|(_, parts)| value(parts, height));
        linear.into_iter().chain(others).fold(Span::point(0.0), |sum, x| sum + x.around())
    }

    /// Bounds how far it is from the straight line between its places at two heights, for all parameters.
    pub fn bulge(&self, heights: &Heights) -> Span {
        let bends = self.moved.iter().map(|(_, parts)| bend(parts, heights.all()).around());
        let all = bends.fold(bend(&self.still, heights.all()), |sum, bend| sum + bend);
        let height = Span::point(heights.high) - Span::point(heights.low);
        (all * height * height).scaled(0.125).around()
    }

    /// Returns the curve for some of the parameters.
    pub fn of(&self, [gap, restitution]: Shift) -> Self {
        let mut curve = Self { still: self.still.clone(), moved: Vec::new() };
        for (by, parts) in &self.moved {
            let [a, b] = [power(gap, by[0]), power(restitution, by[1])];
            for (i, j) in (0..=by[0]).flat_map(|i| (0..=by[1]).map(move |j| (i, j))) {
                add(curve.part([i, j]), parts, a[i as usize] * b[j as usize]); // exact: small numbers
            }
        }
        curve
    }

    /// The polynomial of these powers.
    fn part(&mut self, by: [u32; 2]) -> &mut Vec<Span> {
        if by == [0, 0] {
            return &mut self.still;
        }
        let number = self.moved.iter().position(|(own, _)| *own == by).unwrap_or_else(|| {
            self.moved.push((by, Vec::new()));
            self.moved.len() - 1
        });
        &mut self.moved[number].1
    }

    /// Returns whether it is left of another curve at some heights, for all parameters.
    pub fn is_before(&self, other: &Self, heights: &Heights) -> bool {
        let mut away = other.clone();
        add(&mut away.still, &self.still, Span::point(-1.0));
        self.moved.iter().for_each(|(by, parts)| add(away.part(*by), parts, Span::point(-1.0)));
        let mut open = vec![(Values::ALL, 0)];
        let law = Law { gap: Span::new(-1.0, 1.0), restitution: Span::new(-1.0, 1.0) };
        while let Some((values, cuts)) = open.pop() {
            if away.of(values.of(&law).1).is_positive(heights) {
                continue;
            }
            let moving = (0..2).map(|k| (k + cuts as usize) % 2).find(|&k| away.moved.iter().any(|(by, _)| by[k] > 0)); // exact: a small number
            let Some(parameter) = moving.filter(|_| cuts < MAX_CUTS) else { return false };
            open.extend(values.halves(parameter).map(|half| (half, cuts + 1)));
        }
        true
    }

    /// Returns whether it is positive at all of some heights, whatever the parameters.
    fn is_positive(&self, heights: &Heights) -> bool {
        let mut open = vec![(*heights, 0)];
        while let Some((heights, halvings)) = open.pop() {
            let all = self.moved.iter().map(|(_, parts)| value(parts, heights.all()).around());
            if all.fold(self.at(heights.all()), |sum, x| sum + x).is_positive() {
                continue;
            }
            if halvings == MAX_HALVINGS {
                return false;
            }
            open.extend(heights.halves().map(|half| (half, halvings + 1)));
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: Heights = Heights { low: -1.5, high: 1.5 };

    fn curve(still: &[f64], moved: &[([u32; 2], &[f64])]) -> Curve {
        let parts = |parts: &[f64]| parts.iter().map(|&part| Span::point(part)).collect();
        Curve { still: parts(still), moved: moved.iter().map(|(by, own)| (*by, parts(own))).collect() }
    }

    /// The curve is within its bulge of the chord at places in between, and a parabola is that far in the middle.
    #[test]
    fn a_curve_is_within_its_bulge() {
        let bent = curve(&[0.3, -0.2, 0.7, 0.4, -0.1], &[]);
        let mut open = vec![WHOLE];
        while let Some(heights) = open.pop() {
            let at = |height: f64| bent.at(Span::point(height)).mid();
            for part in [0.1, 0.35, 0.5, 0.8] {
                let chord = at(heights.low) + part * (at(heights.high) - at(heights.low));
                let own = at(heights.low + part * (heights.high - heights.low));
                assert!((own - chord).abs() <= bent.bulge(&heights).hi() + 1e-15, "{heights:?} {part}");
            }
            if heights.high - heights.low > 0.1 {
                open.extend(heights.halves());
            }
        }
        let parabola = curve(&[0.0, 0.0, 1.0], &[]);
        assert!((parabola.bulge(&WHOLE).hi() - 2.25).abs() < 1e-12);
        let moved = curve(&[0.0], &[([0, 1], &[0.0, 0.0, 1.0])]);
        assert!((moved.bulge(&WHOLE).hi() - 2.25).abs() < 1e-12);
    }

    /// Places of a curve for some of the parameters are those of all, and within what moves and the rest say.
    #[test]
    fn a_curve_is_the_same_for_some_of_the_parameters() {
        let moved: [([u32; 2], &[f64]); 4] =
            [([1, 0], &[0.1, 0.02]), ([0, 1], &[-0.05]), ([1, 1], &[0.01, 0.0, 0.03]), ([3, 0], &[0.004])];
        let all = curve(&[0.2, 0.1], &moved);
        let law = Law { gap: Span::new(1.0, 1.5), restitution: Span::new(0.25, 0.75) };
        let among = |x: f64, all: Span| (x - all.mid()) / (0.5 * (all.hi() - all.lo()));
        let place = |height: f64, [s, t]: [f64; 2]| -> f64 {
            let polynomial = |parts: &[f64]| parts.iter().rev().fold(0.0, |sum, part| sum * height + part);
            let by = |(by, parts): &([u32; 2], &[f64])| s.powi(by[0] as i32) * t.powi(by[1] as i32) * polynomial(parts);
            polynomial(&[0.2, 0.1]) + moved.iter().map(by).sum::<f64>()
        };
        for values in Values::ALL.halves(0).iter().flat_map(|half| half.halves(1)) {
            let (own, shift) = values.of(&law);
            let some = all.of(shift);
            for (height, x, y) in [(-1.0, -1.0, 1.0), (0.3, 0.5, -0.25), (1.0, 1.0, 1.0), (0.0, -0.75, -1.0)] {
                let member = |all: Span, x: f64| all.mid() + x * 0.5 * (all.hi() - all.lo());
                let at = [among(member(own.gap, x), law.gap), among(member(own.restitution, y), law.restitution)];
                let moves = some.moves(height);
                let about = some.at(Span::point(height)).mid() + moves[0] * x + moves[1] * y;
                let rest = some.rest(height, moves);
                assert!((place(height, at) - about).abs() <= rest.hi() + 1e-14, "{height} {x} {y}");
            }
        }
    }

    /// What moves by more than is between two curves moves both, or not.
    #[test]
    fn curves_that_move_together_are_in_order() {
        let at = |place: f64, by: &[f64], and: &[f64]| curve(&[place, 0.02], &[([1, 0], by), ([0, 1], and)]);
        let one = at(0.0, &[0.4, 0.1], &[-0.2]);
        let is_before = |other: Curve| one.is_before(&other, &WHOLE);
        assert!(is_before(at(0.01, &[0.4, 0.1], &[-0.2])) && is_before(at(0.01, &[0.403, 0.1], &[-0.203])));
        assert!(!is_before(at(0.01, &[0.4, 0.11], &[-0.2])) && !is_before(at(0.01, &[0.4, 0.1], &[-0.21])));
        assert!(!is_before(one.clone()) && !is_before(at(0.01, &[0.4, 0.1], &[0.2])));
        // (1/2 + x)^2 + 1/10
        assert!(Curve::upright(0.0).is_before(&curve(&[0.35], &[([1, 0], &[1.0]), ([2, 0], &[1.0])]), &WHOLE));
    }
}
