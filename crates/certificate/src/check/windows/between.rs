//! The curve of orbits of a window, from the listed orbit to the two ends (Lemma V30).
//!
//! Newton's iteration finds points of the curve, each in a tiny cell in which an orbit is proved. A cell between two successive points is
//! proved to hold one curve of stable orbits or, next to an end, a curve along which the eigenvalue passes 1 or -1 once.

use super::cell::{Cell, Point};
use super::image::{Along, Image};
use super::map::Map;
use crate::bifurcation::ClaimedPoint;
use crate::check::contact::Doubt;
use crate::check::tangency::setting::Setting;
use crate::check::walk::compare;
use impact_pair_exact::{Dyadic, Real};
use impact_pair_model::vocabulary::Bifurcation as Kind;

/// Bits by which a tiny cell is smaller than the bounds of the ends.
pub(super) const TINY_CELL_BITS: i64 = 24;
/// Bits by which a tiny cell is narrower across the curve.
const THINNESS_BITS: i64 = 28;
/// log2 of the ratio of a tiny cell to the last step of Newton's iteration, and greatest number of steps.
const LAST_STEP_BITS: i64 = 8;
const STEPS: u32 = 24;
/// Number of bisections of the path between two points, or to an end.
const BISECTIONS: u32 = 12;
/// First sides of a cell across the curve: log2 of their ratio to the deviation of the curve from its direction.
const WIDTH_EXPONENT: i64 = 3;
/// Number of times that a cell is widened.
const MAX_WIDENINGS: u32 = 4;
/// The coordinate that is the parameter.
const PARAMETER: usize = 2;

/// Turns a refutation into an undecided claim: the refutation may concern another orbit than the document's.
pub(super) fn unproved(doubt: Doubt) -> Doubt {
    match doubt {
        Doubt::False(message) | Doubt::Open(message) => Doubt::Open(message),
    }
}

/// A point of the curve, and the direction of the curve there, both approximate.
struct Spot {
    at: Point,
    direction: Point,
}

/// The curve of orbits of a window.
pub(super) struct Between<'b> {
    pub map: Map<'b>,
    /// Size of the tiny cells, as a power of 2.
    pub size: i64,
}

impl Between<'_> {
    fn power(&self, n: i64) -> Real {
        Real::point(Dyadic::power_of_two(n), self.map.bits())
    }

    fn point(&self, x: &Real) -> Real {
        Real::point(x.mid(), self.map.bits())
    }

    /// The orbit near a guess with the same coordinate `kept`. Non-rigorous.
    fn settled(&mut self, mut at: Point, kept: usize) -> Result<Spot, Doubt> {
        let others = others(kept);
        for _ in 0..STEPS {
            let (thin, unit) = self.map.degenerate(&at);
            let image = self.map.image(&thin)?;
            let step = image.step(others).ok_or_else(lost)?;
            let mut most = None;
            for (k, &i) in others.iter().enumerate() {
                let step = step[k].clone() * &unit;
                at[i] = self.point(&(at[i].clone() + &step));
                most = most.max(step.enclosure().mag().top()); // proposes: when to stop
            }
            // proposes: when to stop
            if most.is_none_or(|top| top < self.size - TINY_CELL_BITS) {
                return Ok(Spot { at, direction: image.direction() });
            }
        }
        Err(lost())
    }

    /// The orbit of the curve near `at` with the eigenvalue 1, or -1 for `which` = 1. Non-rigorous.
    fn critical(&mut self, mut at: Point, which: usize) -> Result<Spot, Doubt> {
        let none = || Doubt::open("no end of the window is found");
        for _ in 0..STEPS {
            let (thin, unit) = self.map.degenerate(&at);
            let image = self.map.image(&thin)?;
            let (direction, critical) = (image.direction(), &image.criticals[which]);
            let slope = (0..3).map(|j| critical.slopes[j].clone() * &direction[j]).reduce(|sum, x| sum + &x);
            let part = critical.value.middle().over(&slope.ok_or_else(none)?.middle()).ok_or_else(none)?;
            let mut step = direction.each_ref().map(|x| -self.point(&(x.clone() * &part * &unit)));
            let most = step.iter().filter_map(|x| x.enclosure().mag().top()).max();
            // proposes: when to stop
            if most.is_none_or(|top| top < self.size - LAST_STEP_BITS) {
                return Ok(Spot { at, direction });
            }
            let next = (0..BISECTIONS).find_map(|_| {
                let there = [0, 1, 2].map(|i| self.point(&(at[i].clone() + &step[i])));
                step = step.each_ref().map(Real::half);
                let main = farther(&there, &at);
                self.settled(there, main).ok()
            });
            at = next.ok_or_else(none)?.at;
        }
        Err(none())
    }

    /// A cell around a point of the curve that reaches `along` in the coordinate `main`, and has no width across.
    fn around(&self, spot: Spot, (main, along): (usize, &Real)) -> Result<Cell, Doubt> {
        let Spot { at, direction } = spot;
        let part = |x: &Real| Some(x.over(&direction[main])? * along);
        let [Some(a), Some(b), Some(c)] = direction.each_ref().map(part) else { return Err(lost()) };
        let zero = || [0, 1, 2].map(|_| Real::zero(self.map.bits()));
        Ok(Cell::new(at, [[a, b, c], zero(), zero()]))
    }

    /// A tiny cell around a point, in which an orbit is proved, with its image and the curve's slopes.
    fn tiny(&mut self, spot: Spot, (main, along): (usize, &Real)) -> Result<(Cell, Image, Along), Doubt> {
        let across = self.power(self.size - THINNESS_BITS);
        let cell = self.around(spot, (main, along))?.with_sides(main, [across.clone(), across]);
        let image = self.map.image(&cell)?;
        let along = image.curve()?;
        Ok((cell, image, along))
    }

    /// The orbit at the value of the parameter of a guess, in a tiny cell, proved to be stable.
    pub fn known(&mut self, guess: Point) -> Result<Cell, Doubt> {
        let spot = self.settled(guess, PARAMETER)?;
        let along = self.power(TINY_CELL_BITS - i64::from(self.map.bits()));
        let (cell, image, _) = self.tiny(spot, (PARAMETER, &along))?;
        if image.criticals.iter().all(|x| x.value.is_positive()) {
            Ok(cell)
        } else {
            Err(Doubt::open("the orbit is not proved to be stable"))
        }
    }

    /// Proves that the curve leads from an orbit to an end, through stable orbits.
    pub fn reaches(&mut self, known: &Cell, end: &ClaimedPoint, setting: &Setting) -> Result<(), Doubt> {
        let which = usize::from(end.kind != Kind::Fold);
        let spot = self.critical(known.centre.clone(), which)?;
        let main = farther(&spot.at, &known.centre);
        let (zero, image, along) = self.tiny(spot, (main, &self.power(self.size)))?;
        let critical = &image.criticals[which];
        // Opposite signs at both ends of the curve.
        let slope = along.slope(critical).ok_or_else(lost)?;
        let slope = Real::point(slope.enclosure().mig(), self.map.bits());
        let (thin, _) = self.map.degenerate(&zero.centre);
        let middle = Real::point(self.map.image(&thin)?.criticals[which].value.enclosure().mag(), self.map.bits());
        let middle = middle + &critical.across();
        if !middle.is_below(&slope) {
            return Err(Doubt::open("no eigenvalue is proved to pass 1 or -1 at an end of the window"));
        }
        let parameter = setting.parameter(&zero.hull()[PARAMETER]);
        let parameter = parameter.ok_or_else(|| Doubt::open("the parameter is not proved to be positive"))?;
        compare("parameter", &parameter, &end.parameter).map_err(unproved)?;
        let mut from = known.clone();
        let mut answer = Err(Doubt::open("nothing is tried"));
        for _ in 0..BISECTIONS {
            answer = self.is_last(&from, &zero, which);
            if answer.is_ok() {
                break;
            }
            let middle = self.between(&from, &zero)?;
            self.are_stable(&from, &middle, BISECTIONS)?;
            from = middle;
        }
        answer
    }

    /// A tiny cell approximately halfway between two tiny cells.
    fn between(&mut self, from: &Cell, to: &Cell) -> Result<Cell, Doubt> {
        let main = farther(&from.centre, &to.centre);
        let at = [0, 1, 2].map(|i| self.point(&(from.centre[i].clone() + &to.centre[i]).half()));
        let spot = self.settled(at, main)?;
        let along = self.power(self.size);
        Ok(self.tiny(spot, (main, &along))?.0)
    }

    /// A cell that is proved to hold one curve between two tiny cells.
    fn over(&mut self, from: &Cell, to: &Cell) -> Result<(Image, Along), Doubt> {
        let main = farther(&from.centre, &to.centre);
        let middle = [0, 1, 2].map(|i| self.point(&(from.centre[i].clone() + &to.centre[i]).half()));
        let spot = self.settled(middle, main)?;
        let at = spot.at.clone();
        let half = (to.centre[main].clone() - &from.centre[main]).half();
        let half = Real::point(half.enclosure().mag(), self.map.bits());
        let along = half.clone() + &(half * &self.power(-4)); // proposes: a size to try
        let thin = self.around(spot, (main, &along))?;
        // The distance of an end from the direction of the curve.
        let strays = |end: &Point, i: usize| {
            let part = (end[main].clone() - &at[main]).over(&along)?;
            Some((end[i].clone() - &at[i] - &(part * &thin.frame[0][i])).enclosure().mag())
        };
        let across = others(main).map(|i| {
            let most = strays(&from.centre, i).max(strays(&to.centre, i))?; // proposes: a size to try
            Some(Real::point(most.scaled(WIDTH_EXPONENT), self.map.bits()) + &self.power(self.size + WIDTH_EXPONENT))
        });
        let [Some(a), Some(b)] = across else { return Err(lost()) };
        let mut cell = thin.with_sides(main, [a, b]);
        for _ in 0..MAX_WIDENINGS {
            if !(cell.holds(&from.hull()) && cell.holds(&to.hull())) {
                return Err(Doubt::open("a cell does not hold the orbits that it is to join"));
            }
            let image = self.map.image(&cell)?;
            if let Ok(along) = image.curve() {
                return Ok((image, along));
            }
            let stretch = image.stretch().ok_or_else(lost)?;
            cell = cell.widened(stretch.map(|x| x * 2 + &self.power(1 - WIDTH_EXPONENT)));
        }
        Err(Doubt::open("the orbits are not proved to be one curve"))
    }

    /// Proves that all orbits of the curve between two tiny cells are stable.
    fn are_stable(&mut self, from: &Cell, to: &Cell, depth: u32) -> Result<(), Doubt> {
        let joined = self.over(from, to).and_then(|(image, _)| {
            let is_stable = image.criticals.iter().all(|x| x.value.is_positive());
            if is_stable {
                Ok(())
            } else {
                Err(Doubt::open("the orbits in the middle of the window are not proved to be stable"))
            }
        });
        match joined {
            Err(Doubt::Open(_)) if depth > 0 => {
                let middle = self.between(from, to)?;
                self.are_stable(from, &middle, depth - 1)?;
                self.are_stable(&middle, to, depth - 1)
            }
            answer => answer,
        }
    }

    /// Proves that all orbits from a stable orbit to the end are stable.
    fn is_last(&mut self, from: &Cell, zero: &Cell, which: usize) -> Result<(), Doubt> {
        let (image, along) = self.over(from, zero)?;
        let is_monotone = along.slope(&image.criticals[which]).is_some_and(|slope| !slope.is_across());
        if is_monotone && image.criticals[1 - which].value.is_positive() {
            Ok(())
        } else {
            Err(Doubt::open("the orbits next to an end of the window are not proved to be stable"))
        }
    }
}

/// The coordinate of the state, 0 or 1, in which two points are farther apart.
fn farther(a: &Point, b: &Point) -> usize {
    let apart = |i: usize| (a[i].clone() - &b[i]).enclosure().mag();
    usize::from(apart(1) > apart(0))
}

fn others(kept: usize) -> [usize; 2] {
    [(kept + 1) % 3, (kept + 2) % 3]
}

fn lost() -> Doubt {
    Doubt::open("the curve of the orbits is lost")
}
