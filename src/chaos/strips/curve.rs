//! Curves across an h-set that move with the parameters: Lemma D34 of `docs/proofs/chaos.md#D34`.

use crate::chaos::flights::is_positive;
use crate::chaos::law::Law;
use crate::number::{Ball, Number, UNIT, up};

/// Halvings of the height, and of the parameters, within which two curves are told apart.
const APART_HALVINGS: [u32; 2] = [12, 3];

/// Heights of a strip from one to another: dyadic fractions of its whole height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Heights {
    pub low: f64,
    pub high: f64,
}

/// A part of all pairs of `D` and `e`: for both a middle and a radius, those of all being 0 and 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    at: [f64; 2],
    radius: [f64; 2],
}

/// What `D` and `e` are in a part: `a + r x` for `x` from -1 to 1, by those of all pairs.
pub(super) type Shift = [[Ball; 2]; 2];

/// A place along an h-set for each height and all parameters: a sum of powers of the parameters, each times a polynomial of the height.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    terms: Vec<Term>,
}

/// A power of `D` times one of `e`, each from -1 to 1, times a polynomial: its coefficients from the constant on.
#[derive(Clone, Debug)]
struct Term {
    by: [usize; 2],
    parts: Vec<Ball>,
}

impl Heights {
    /// All heights of a strip that is so tall: a number whose fractions by powers of two are exact.
    pub fn of(tall: f64) -> Self {
        Self { low: -tall, high: tall }
    }

    pub fn all(&self) -> Ball {
        Ball::new(0.5 * (self.low + self.high), up(0.5 * (self.high - self.low))) // D34: dyadic fractions of the whole height
    }

    pub fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.low + self.high); // D34: exact
        [Self { low: self.low, high: middle }, Self { low: middle, high: self.high }]
    }
}

impl Part {
    pub const ALL: Self = Self { at: [0.0; 2], radius: [1.0; 2] };

    /// Both halves of one parameter, 0 or 1.
    pub fn halves(&self, parameter: usize) -> [Self; 2] {
        [-0.5, 0.5].map(|half| {
            let mut part = *self;
            part.at[parameter] += half * self.radius[parameter]; // exact: dyadic
            part.radius[parameter] *= 0.5;
            part
        })
    }

    /// Holds the pairs of this part, and what they are among all.
    pub fn of(&self, law: &Law) -> (Law, Shift) {
        let part = |k: usize, all: Ball| {
            // exact: all of it
            if self.radius[k] == 1.0 {
                return (all, [Ball::exact(0.0), Ball::exact(1.0)]); // exact: all of it
            }
            let middle = all.mid() + self.at[k] * all.rad();
            let error = 2.0 * UNIT * (all.mid().abs() + all.rad());
            let radius = up(self.radius[k] * all.rad() + error); // D34: the middle is rounded
            let over = |x: Ball| x.checked_div(Ball::exact(all.rad())).unwrap_or(Ball::exact(0.0)); // D34: no curve moves with a point
            let shift = [over(Ball::exact(middle) - Ball::exact(all.mid())), over(Ball::exact(radius))];
            (Ball::new(middle, radius), shift)
        };
        let [(gap, by_gap), (restitution, by_restitution)] = [part(0, law.gap), part(1, law.restitution)];
        (Law { gap, restitution }, [by_gap, by_restitution])
    }
}

/// Holds the value of a polynomial at a height.
fn value(parts: &[Ball], height: Ball) -> Ball {
    parts.iter().rev().fold(Ball::exact(0.0), |sum, &part| sum * height + part)
}

/// Holds its second derivative there.
fn bend(parts: &[Ball], height: Ball) -> Ball {
    let weighted = |(k, &part): (usize, &Ball)| Ball::exact((k * (k - 1)) as f64) * part; // exact: small numbers
    parts.iter().enumerate().skip(2).map(weighted).rev().fold(Ball::exact(0.0), |sum, part| sum * height + part)
}

impl Curve {
    /// The curve of these powers, each with its coefficients; the first ones are those of the middle of all parameters.
    pub fn new<'t>(terms: impl Iterator<Item = ([usize; 2], &'t [f64])>) -> Self {
        let term =
            |(by, parts): ([usize; 2], &[f64])| Term { by, parts: parts.iter().map(|&x| Ball::exact(x)).collect() };
        Self { terms: terms.map(term).collect() }
    }

    /// A place that is the same for all heights and parameters.
    pub fn still(place: f64) -> Self {
        Self::new([([0, 0], &[place][..])].into_iter())
    }

    fn term(&self, by: [usize; 2]) -> Option<&Term> {
        self.terms.iter().find(|term| term.by == by)
    }

    /// Holds its place at a height in the middle of the parameters.
    pub fn at(&self, height: Ball) -> Ball {
        self.term([0, 0]).map_or(Ball::exact(0.0), |term| value(&term.parts, height)) // exact: there is none
    }

    /// About how far `D` and `e` displace it at a height, each by its radius.
    pub fn moved(&self, height: f64) -> [f64; 2] {
        let by = |power: [usize; 2]| self.term(power).map_or(0.0, |term| value(&term.parts, Ball::exact(height)).mid());
        [by([1, 0]), by([0, 1])]
    }

    /// Bounds how far it is at a height from the place in the middle of the parameters, displaced by `moved` for each of them.
    pub fn rest(&self, height: f64, moved: [f64; 2]) -> f64 {
        let height = Ball::exact(height);
        let of = |term: &Term| value(&term.parts, height);
        let linear = [[1, 0], [0, 1]];
        let first = [0, 1].map(|k| {
            let own = self.term(linear[k]).map_or(Ball::exact(0.0), of); // exact: there is none
            (own - Ball::exact(moved[k])).mag()
        });
        let is_other = |term: &&Term| term.by != [0, 0] && !linear.contains(&term.by);
        self.terms.iter().filter(is_other).fold(up(first[0] + first[1]), |sum, term| up(sum + of(term).mag()))
    }

    /// Bounds how far it is from the straight line between its ends at some heights, for all parameters.
    pub fn bulge(&self, heights: &Heights) -> f64 {
        let height = up(heights.high - heights.low);
        let bends = self.terms.iter().fold(0.0, |sum, term| up(sum + bend(&term.parts, heights.all()).mag()));
        up(0.125 * bends * up(height * height))
    }

    /// The curve by the parameters of a part.
    pub fn on(&self, shift: Shift) -> Self {
        let mut terms: Vec<Term> = Vec::new();
        for Term { by, parts } in &self.terms {
            let [a, b] = [0, 1].map(|k| power(shift[k], by[k]));
            for (i, x) in a.iter().enumerate() {
                for (j, y) in b.iter().enumerate() {
                    let scaled: Vec<Ball> = parts.iter().map(|&part| part * *x * *y).collect();
                    add(&mut terms, Term { by: [i, j], parts: scaled });
                }
            }
        }
        Self { terms }
    }

    /// Whether it is proved to be on the left of another one at all these heights, for each parameter. Lemma D34
    pub fn is_left_of(&self, other: &Self, heights: Heights) -> bool {
        let mut terms = other.terms.clone();
        for Term { by, parts } in &self.terms {
            add(&mut terms, Term { by: *by, parts: parts.iter().map(|&part| -part).collect() });
        }
        Self { terms }.is_positive(heights, APART_HALVINGS[1])
    }

    /// Whether it is positive at all these heights, for all parameters, halved so often at most.
    fn is_positive(&self, all: Heights, halvings: u32) -> bool {
        let least = |heights: &Heights| {
            let of = |term: &Term| value(&term.parts, heights.all());
            let moved = self.terms.iter().filter(|term| term.by != [0, 0]);
            moved.fold(self.at(heights.all()), |sum, term| sum.widened(of(term).mag()))
        };
        let is_above = || {
            let mut open = vec![(all, 0)];
            while let Some((heights, halved)) = open.pop() {
                if is_positive(least(&heights)) {
                    continue;
                }
                if halved == APART_HALVINGS[0] {
                    return false;
                }
                open.extend(heights.halves().map(|half| (half, halved + 1)));
            }
            true
        };
        let is_still = |k: usize| self.terms.iter().all(|term| term.by[k] == 0);
        if is_above() {
            return true;
        }
        let moving = [halvings, halvings + 1].map(|k| k as usize % 2).into_iter().find(|&k| !is_still(k)); // proposes: any of both
        let Some(k) = moving.filter(|_| halvings > 0) else { return false };
        [-0.5, 0.5].into_iter().all(|half| {
            let mut shift = [[Ball::exact(0.0), Ball::exact(1.0)]; 2];
            shift[k] = [half, 0.5].map(Ball::exact);
            self.on(shift).is_positive(all, halvings - 1)
        })
    }
}

/// Holds the coefficients of `(a + r x)^power`.
fn power([a, r]: [Ball; 2], power: usize) -> Vec<Ball> {
    let times = |all: Vec<Ball>, _| {
        let part = |k: usize| all.get(k).copied().unwrap_or(Ball::exact(0.0)); // exact: there is none
        (0..=all.len()).map(|k| if k == 0 { a * part(0) } else { a * part(k) + r * part(k - 1) }).collect()
    };
    (0..power).fold(vec![Ball::exact(1.0)], times)
}

/// Adds a term to a sum.
fn add(terms: &mut Vec<Term>, more: Term) {
    let Some(own) = terms.iter_mut().find(|term| term.by == more.by) else { return terms.push(more) };
    let length = own.parts.len().max(more.parts.len()); // exact: of two lengths
    own.parts.resize(length, Ball::exact(0.0));
    own.parts.iter_mut().zip(more.parts).for_each(|(part, more)| *part = *part + more);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still(parts: &[f64]) -> Curve {
        Curve::new([([0, 0], parts)].into_iter())
    }

    #[test]
    fn a_curve_is_left_of_another_one_at_all_heights() {
        let is_left = |one: &[f64], two: &[f64]| still(one).is_left_of(&still(two), Heights::of(1.0));
        assert!(is_left(&[0.0, 0.1], &[0.2]) && is_left(&[0.0], &[0.2, 0.1, -0.05]));
        assert!(!is_left(&[0.0, 0.1], &[0.1]) && !is_left(&[0.0, 0.0, 1.0], &[0.9]) && !is_left(&[0.2], &[0.1]));
    }

    /// Two curves that move by more than what is between them, with `D` and with `e`, alike or not.
    #[test]
    fn curves_that_move_alike_are_apart() {
        let moved = |place: f64, by: [f64; 2]| {
            let terms = [([0, 0], vec![place, 0.01]), ([1, 0], vec![by[0], 0.02]), ([0, 1], vec![by[1]])];
            Curve::new(terms.iter().map(|(by, parts)| (*by, &parts[..])))
        };
        let one = moved(0.0, [0.5, -0.3]);
        let is_left = |other: Curve| one.is_left_of(&other, Heights::of(1.5));
        assert!(is_left(moved(0.02, [0.5, -0.3])) && is_left(moved(0.02, [0.508, -0.308])));
        assert!(!is_left(moved(0.02, [0.52, -0.3])) && !is_left(moved(0.02, [0.5, -0.33])));
        // The difference is (1/2 + x)^2 + 1/10, which is positive, but not its parts one by one.
        let square = [([0, 0], vec![0.35]), ([1, 0], vec![1.0]), ([2, 0], vec![1.0])];
        let square = Curve::new(square.iter().map(|(by, parts)| (*by, &parts[..])));
        assert!(Curve::still(0.0).is_left_of(&square, Heights::of(1.5)));
    }

    /// A parabola is as far from its chord in the middle.
    #[test]
    fn bulges_bound_how_far_curves_are_from_their_chords() {
        let curve = still(&[0.1, -0.4, 0.25]);
        for heights in Heights::of(1.25).halves() {
            let Heights { low, high } = heights;
            let at = |height: f64| curve.at(Ball::exact(height)).mid();
            let away = (at(0.5 * (low + high)) - 0.5 * (at(low) + at(high))).abs();
            let bulge = curve.bulge(&heights);
            assert!(away <= bulge && bulge < away + 1e-9, "{away} {bulge}");
        }
    }

    /// A part of a curve has the places of the whole one, each parameter taken for itself; and they are within the bounds of what moves it.
    #[test]
    fn a_part_of_the_parameters_has_the_same_places() {
        let terms = [
            ([0, 0], vec![0.2, -0.1, 0.05]),
            ([1, 0], vec![0.04, 0.01]),
            ([0, 1], vec![-0.03]),
            ([1, 1], vec![0.007, -0.002]),
            ([2, 0], vec![0.006]),
            ([0, 3], vec![0.0, 0.004]),
        ];
        let curve = Curve::new(terms.iter().map(|(by, parts)| (*by, &parts[..])));
        let place = |height: f64, [s, t]: [f64; 2]| -> f64 {
            let of = |parts: &[f64]| parts.iter().rev().fold(0.0, |sum, part| sum * height + part);
            terms.iter().map(|(by, parts)| s.powi(by[0] as i32) * t.powi(by[1] as i32) * of(parts)).sum()
        };
        let law = Law { gap: Ball::new(1.5, 0.25), restitution: Ball::new(0.5, 0.0625) };
        for part in Part::ALL.halves(0).iter().flat_map(|half| half.halves(1)) {
            let (own, shift) = part.of(&law);
            let on = curve.on(shift);
            for height in [-1.0, -0.3, 0.8] {
                let moved = on.moved(height);
                let rest = on.rest(height, moved);
                for [x, y] in [[-1.0, -1.0], [0.5, -0.25], [1.0, 1.0], [-1.0, 0.75]] {
                    let whole = |own: Ball, all: Ball, x: f64| (own.mid() + x * own.rad() - all.mid()) / all.rad();
                    let at = [whole(own.gap, law.gap, x), whole(own.restitution, law.restitution, y)];
                    let linear = on.at(Ball::exact(height)).mid() + moved[0] * x + moved[1] * y;
                    assert!((place(height, at) - linear).abs() <= rest + 1e-15, "{height} {x} {y}");
                }
            }
        }
    }
}
