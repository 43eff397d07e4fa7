//! The curves of figures 10 and 11: `A_N` over W or over v, with the parts that are admissible and those that are stable.
//!
//! On all of them `sin th0`, first contacts and stability depend on `x = d W/|v|` alone (Lemma W8), so the marks between
//! which they do not change are known, and the properties of a part hold for every point of it. Bounds are in the bits of the
//! requested digits, as doubles are not.

use std::cmp::Ordering;
use std::ops::RangeInclusive;

use impact_pair_model::vocabulary::ManifoldAxis;
pub use impact_pair_model::vocabulary::Mark;

use crate::Error;
use crate::exact::{Enclosure, Exact, whole_bits, working_bits};
use crate::pair::{ImpactPair, Wall, within};
use crate::watch::{Latched, Watch};

use super::closed_forms::{self, grazing_angle};
use super::problem::{NEEDS_ONE_HARMONIC, SHOWN_BITS};
use crate::exact::Real;
use crate::periodic::Stability;

/// The parameter of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The angular frequency W: figure 10.
    Frequency,
    /// The velocity v before the impact on this wall: figure 11.
    Velocity(Wall),
}

impl Axis {
    /// `frequency` or `velocity`.
    pub fn kind(self) -> ManifoldAxis {
        match self {
            Self::Frequency => ManifoldAxis::Frequency,
            Self::Velocity(_) => ManifoldAxis::Velocity,
        }
    }
}

/// The properties proved at every point between one listed point of a curve and the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// True if `sin th0 > 0`: solid in the figures; else it is negative.
    pub is_solid: bool,
    /// True if no wall is touched between the impacts.
    pub is_physical: bool,
    /// Stability.
    pub stability: Stability,
}

/// A point of a curve.
#[derive(Clone, Debug)]
pub struct Point {
    /// W \[rad/time\] or v \[length/time\].
    pub at: Enclosure,
    /// `A_N` \[length\]
    pub amplitude: Enclosure,
    /// The change at this point; `None` for a point of the grid.
    pub mark: Option<Mark>,
    /// The properties from here to the next point; `None` for the last one.
    pub after: Option<Part>,
}

/// `A_N` of one N over a range. **Equations** (68), (69), (73)
///
/// **Enclosure**: between two listed points `A_N` lies between their amplitudes (Lemma W8).
#[derive(Clone, Debug)]
pub struct Manifold {
    /// N
    pub cycles: u32,
    /// The points in the order of W or v.
    pub points: Vec<Point>,
}

/// The data of the curves: `d` and `e` of a pair, and the range.
#[derive(Clone, Debug)]
pub struct Range<'p> {
    /// Pair: its amplitude is not used; its frequency is used only over v.
    pub pair: &'p ImpactPair,
    /// `|v|`; not used over v.
    pub speed: Exact,
    /// The parameter of the curves.
    pub axis: Axis,
    /// Lower end of the range of W \[rad/time\] or v \[length/time\].
    pub from: Exact,
    /// Upper end of the range.
    pub to: Exact,
    /// Number of equidistant points, endpoints included.
    pub count: usize,
}

/// Accepted numbers of points of a grid.
pub const COUNTS: std::ops::RangeInclusive<usize> = 2..=100_000;

/// A point of a curve, by `x = d W/|v|`.
struct Place {
    x: Real,
    at: Real,
    mark: Option<Mark>,
}

impl Range<'_> {
    /// Parameter manifolds of some `N`, until the watch stops them, and whether all were computed; none is empty.
    ///
    /// Even `N` have no equispaced motion (65): a range gives the odd ones only.
    ///
    /// # Errors
    /// As [`Range::manifold`].
    pub fn manifolds(
        &self,
        cycles: RangeInclusive<u32>,
        digits: u32,
        watch: &dyn Watch,
    ) -> Result<(Vec<Manifold>, bool), Error> {
        let is_one = cycles.start() == cycles.end();
        let watch = Latched::new(watch);
        let mut curves: Vec<Manifold> = cycles
            .filter(|n| is_one || n % 2 == 1)
            .take_while(|_| watch.goes_on())
            .map(|n| self.manifold(n, digits, &watch))
            .collect::<Result<_, _>>()?;
        curves.retain(|curve| !curve.points.is_empty());
        Ok((curves, !watch.is_stopped()))
    }

    /// The curve of `cycles` cycles, an odd number; if the watch stops it, the points computed before.
    ///
    /// # Errors
    /// If there are several harmonics, if e is not below 1, if N is even (65), if a number is an interval of values, if the range is empty or
    /// holds 0, or if two marks cannot be distinguished.
    pub fn manifold(&self, cycles: u32, digits: u32, watch: &dyn Watch) -> Result<Manifold, Error> {
        self.check(cycles)?;
        let bits = working_bits(digits);
        let marks = self.marks(cycles, bits)?;
        let mut places = self.grid(bits, watch)?;
        places.retain(|place| marks.iter().all(|(_, x)| order(&place.x, x).is_some()));
        let ends = [places.first(), places.last()].map(|place| place.map(|place| place.x.clone()));
        for (mark, x) in &marks {
            // One end on either side, whichever way the axis runs.
            let sides = ends.clone().map(|end| end.and_then(|end| order(x, &end)));
            if let [Some(a), Some(b)] = sides
                && a == b.reverse()
            {
                places.push(Place { x: x.clone(), at: self.at(x), mark: Some(*mark) });
            }
        }
        places.sort_by(|a, b| order(&a.x, &b.x).unwrap_or(Ordering::Equal)); // W8: places that cannot be distinguished keep their order
        let mut parts: Vec<Option<Part>> = places.windows(2).map(|ends| Some(part(&ends[0], &marks))).collect();
        if self.runs_down() {
            places.reverse();
            parts.reverse();
        }
        parts.push(None);
        let shown = whole_bits(digits) + SHOWN_BITS;
        let point = |(place, after): (Place, Option<Part>)| Point {
            amplitude: self.amplitude(cycles, &place.x).enclosure().rounded(shown),
            at: place.at.enclosure().rounded(shown),
            mark: place.mark,
            after,
        };
        let mut points: Vec<Point> = places.into_iter().zip(parts).take_while(|_| watch.goes_on()).map(point).collect();
        if let Some(last) = points.last_mut() {
            last.after = None;
        }
        Ok(Manifold { cycles, points })
    }

    fn check(&self, cycles: u32) -> Result<(), Error> {
        self.pair.harmonic(NEEDS_ONE_HARMONIC)?;
        let (gap, e) = (self.pair.gap(), self.pair.restitution());
        if e.compare(&Exact::from(1)) != Some(Ordering::Less) {
            return Err(Error::range(
                "pair.restitution",
                e,
                "must be below 1 for the parameter manifolds of figures 10 and 11",
            ));
        }
        if cycles.is_multiple_of(2) {
            let accepted = "must be odd: with N even and e < 1 no equispaced motion exists (65)";
            return Err(Error::range("cycles", &Exact::from(i64::from(cycles)), accepted));
        }
        let (key, needed) = match self.axis {
            Axis::Frequency => ("start.velocity", &self.speed),
            Axis::Velocity(_) => ("excitation.frequency", self.pair.excitation().reference().frequency()),
        };
        Error::require_positive(key, needed)?;
        let single = "must be a single number, not an interval";
        for (key, value) in
            [(key, needed), ("pair.gap", gap), ("pair.restitution", e), ("from", &self.from), ("to", &self.to)]
        {
            if !value.is_point() {
                return Err(Error::range(key, value, single));
            }
        }
        match self.axis {
            Axis::Velocity(Wall::Left) if self.to.sign() != Some(Ordering::Less) => {
                return Err(Error::range("to", &self.to, "velocities on the left wall must be below 0"));
            }
            Axis::Velocity(Wall::Left) => {}
            Axis::Frequency | Axis::Velocity(Wall::Right) => Error::require_positive("from", &self.from)?,
        }
        if self.from.compare(&self.to) != Some(Ordering::Less) {
            return Err(Error::range("to", &self.to, &format!("must be greater than {}", self.from)));
        }
        if !COUNTS.contains(&self.count) {
            let accepted = format!("must be from {} to {}", COUNTS.start(), COUNTS.end());
            return Err(Error::range("count", &Exact::from(self.count as i64), &accepted)); // shown
        }
        Ok(())
    }

    /// Whether `x` falls along the axis.
    fn runs_down(&self) -> bool {
        self.axis == Axis::Velocity(Wall::Right)
    }

    /// The marks of Lemma W8 by `x`, no two of which may be the same.
    fn marks(&self, cycles: u32, bits: u32) -> Result<Vec<(Mark, Real)>, Error> {
        let e = Real::of(self.pair.restitution(), bits);
        let period = Real::pi(bits) * i64::from(cycles);
        let below = Real::int(1, bits) - &e;
        let level = (&period * (&e + 1)).half();
        // (1 - e) tan th0 at the ends of stability: -2 (1 + e)/(N pi) and 2 (1 - e)^2/((1 + e) N pi).
        let pitchfork = ((&e + 1) * 2).over(&period).map(|step| &level - step);
        let fold = (below.square() * 2).over(&(&period * (&e + 1))).map(|step| &level + step);
        let graze = || grazing_angle(&e).and_then(|b| (&below * b.sin()).over(&b.cos())).map(|step| &level - step);
        let mut all = vec![(Mark::Pitchfork, pitchfork), (Mark::Level, Some(level.clone())), (Mark::Fold, fold)];
        // With perfectly plastic impacts (e = 0) the ball sticks to the wall where sin th0 < 0: it has no graze but the level.
        if self.pair.restitution().sign() != Some(Ordering::Equal) {
            all.push((Mark::Graze, graze()));
        }
        let marks: Option<Vec<_>> = all.into_iter().map(|(mark, x)| Some((mark, x?))).collect();
        let are_apart = |marks: &Vec<(Mark, Real)>| {
            marks.iter().enumerate().all(|(i, (_, x))| marks[..i].iter().all(|(_, other)| order(x, other).is_some()))
        };
        marks.filter(are_apart).ok_or_else(|| {
            let accepted = "its marks cannot be distinguished at the requested digits";
            Error::range("pair.restitution", self.pair.restitution(), accepted)
        })
    }

    /// The grid, by `x`, until the watch stops it.
    fn grid(&self, bits: u32, watch: &dyn Watch) -> Result<Vec<Place>, Error> {
        let step = |index: usize| {
            let part = Exact::from(index as i64).checked_div(&Exact::from(self.count as i64 - 1))?; // exact: a count
            self.from.checked_add(&self.to.checked_sub(&self.from)?.checked_mul(&part)?)
        };
        let place = |index: usize| {
            let at = Real::of(&within("to", &self.to, step(index))?, bits);
            let gap = Real::of(self.pair.gap(), bits);
            let x = match self.axis {
                Axis::Frequency => (gap * &at).over(&Real::of(&self.speed, bits)),
                Axis::Velocity(wall) => {
                    let speed = if wall == Wall::Left { -&at } else { at.clone() };
                    (gap * Real::of(self.pair.excitation().reference().frequency(), bits)).over(&speed)
                }
            };
            Ok(Place { x: x.expect("checked not to be 0"), at, mark: None })
        };
        (0..self.count).take_while(|_| watch.goes_on()).map(place).collect()
    }

    /// W or v at `x`.
    fn at(&self, x: &Real) -> Real {
        let gap = Real::of(self.pair.gap(), x.bits());
        match self.axis {
            Axis::Frequency => (x * Real::of(&self.speed, x.bits())).over(&gap).expect("d > 0"),
            Axis::Velocity(wall) => {
                let frequency = Real::of(self.pair.excitation().reference().frequency(), x.bits());
                let speed = (gap * frequency).over(x).expect("inside the range");
                if wall == Wall::Left { -speed } else { speed }
            }
        }
    }

    /// (68), with `|v|/W = d/x`.
    fn amplitude(&self, cycles: u32, x: &Real) -> Real {
        let (gap, e) = (Real::of(self.pair.gap(), x.bits()), Real::of(self.pair.restitution(), x.bits()));
        let length = gap.over(x).expect("inside the range");
        closed_forms::amplitude(&closed_forms::vector(&gap, cycles, &e, &length))
    }
}

/// The proved order of two different places.
fn order(a: &Real, b: &Real) -> Option<Ordering> {
    (a - b).sign().filter(|order| order.is_ne())
}

/// Properties from here to the next place: no mark is between them.
fn part(left: &Place, marks: &[(Mark, Real)]) -> Part {
    let is_beyond = |mark: Mark| {
        marks.iter().any(|(other, x)| {
            *other == mark && (left.mark == Some(mark) || order(&left.x, x) == Some(Ordering::Greater))
        })
    };
    let has_graze = marks.iter().any(|(mark, _)| *mark == Mark::Graze);
    let is_stable = is_beyond(Mark::Pitchfork) && !is_beyond(Mark::Fold);
    Part {
        is_solid: is_beyond(Mark::Level),
        is_physical: is_beyond(if has_graze { Mark::Graze } else { Mark::Level }),
        stability: if is_stable { Stability::Stable } else { Stability::Unstable },
    }
}
