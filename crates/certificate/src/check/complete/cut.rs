//! Cuts of a box by the relations that every orbit in it satisfies (Lemma V41).

use super::super::span::Span;
use super::cell::{Cell, Equations};
use impact_pair_model::Wall;

/// Parts of a flight at whose ends the ball is looked for in the gap.
const PARTS: u32 = 8;
/// Slices of a phase that are compared with the speed of the box at an impact.
const SLICES: u32 = 8;
/// The least part of a box that a pass takes off for another pass to be made.
const MIN_GAIN: f64 = 0.1;
/// The least part of a box that Newton's equation takes off for the box to be cut again.
const MIN_STEP_GAIN: f64 = 0.3;
/// Rounds of passes and of Newton's equation, each, at most.
const MOST_ROUNDS: u32 = 32;

/// The excitation along a flight.
pub(super) struct Along {
    time: Span,
    /// Change of the displacement.
    change: Span,
    /// Speeds and accelerations of the box at the begin, in the middle and at the end.
    speeds: [Span; 3],
    accelerations: [Span; 3],
    /// The speed over the whole flight, and the derivatives of orders 5 and 6 of the displacement.
    whole: [Span; 3],
}

impl Equations {
    /// Cuts a box until little is gained; `None` when no orbit is left in it.
    pub fn contracted(&self, mut cell: Cell) -> Option<Cell> {
        for _ in 0..MOST_ROUNDS {
            cell = self.cut(cell)?;
            let before = cell.size();
            cell = self.stepped(cell)?;
            if cell.size() >= (1.0 - MIN_STEP_GAIN) * before {
                break;
            }
        }
        Some(cell)
    }

    /// Cuts a box by the relations of single flights and impacts.
    fn cut(&self, mut cell: Cell) -> Option<Cell> {
        for _ in 0..MOST_ROUNDS {
            let before = cell.size();
            (0..self.count()).try_for_each(|i| self.cut_flight(&mut cell, i))?;
            (0..self.count()).try_for_each(|i| self.cut_impact(&mut cell, i))?;
            if cell.size() >= (1.0 - MIN_GAIN) * before {
                break;
            }
        }
        self.is_in_gap(&cell, PARTS).then_some(cell)
    }

    /// Encloses the excitation along flight `i` of those members of a box whose flight takes such a time.
    pub fn along(&self, phases: &[Span], i: usize, time: Span) -> Along {
        let (from, to, half) = (phases[i], self.end(phases, i), time.scaled(0.5));
        let middle = narrower(narrower((from + to).scaled(0.5), from + half), to - half);
        let whole = self.excitation.derivatives([1, 5, 6], from.hull(to));
        let change = self.excitation.change(middle, time);
        let [from, middle, to] = [from, middle, to].map(|phases| self.excitation.derivatives([0, 1, 2], phases));
        let change = narrower(to[0] - from[0], change);
        let [speeds, accelerations] = [1, 2].map(|order| [from[order], middle[order], to[order]]);
        Along { time, change, speeds, accelerations, whole }
    }

    /// Cuts times, phases and drift by the equation of flight `i`.
    fn cut_flight(&self, cell: &mut Cell, i: usize) -> Option<()> {
        let (next, later) = (self.next(i), self.later(i));
        let time = both(cell.times[i], self.end(&cell.phases, i) - cell.phases[i])?;
        cell.phases[next] = both(cell.phases[next], cell.phases[i] + time - later)?;
        cell.phases[i] = both(cell.phases[i], self.end(&cell.phases, i) - time)?;
        cell.times[i] = time;
        let along = self.along(&cell.phases, i, time);
        let mean = along.mean()?;
        if self.is_hop(i) {
            cell.drifts[i] = both(cell.drifts[i], mean)?;
            let [after, before] = along.hop();
            let inward = self.walls[i] == Wall::Left;
            let may = |x: Span| !x.signed(inward).is_negative();
            return (may(after) && may(-before)).then_some(());
        }
        let travel = self.travel(i);
        cell.drifts[i] = both_if(cell.drifts[i], travel.over(time).map(|straight| straight + mean))?;
        cell.times[i] = both_if(time, travel.over(cell.drifts[i] - mean))?;
        Some(())
    }

    /// Cuts drifts and phase by Newton's impact law and by the directions before and after impact `i`.
    fn cut_impact(&self, cell: &mut Cell, i: usize) -> Option<()> {
        let (p, e) = (self.previous(i), self.restitution);
        let lossy = Span::point(1.0) + e;
        let [speed, acceleration] = self.excitation.derivatives([1, 2], cell.phases[i]);
        let (before, after) = (cell.drifts[p], cell.drifts[i]);
        let speed = both_if(speed, (after + e * before).over(lossy))?;
        let after = both(after, lossy * speed - e * before)?;
        let before = both_if(before, (lossy * speed - after).over(e))?;
        // The ball comes from inside the gap and leaves to its inside.
        let (before, speed, after) = match self.walls[i] {
            Wall::Left => ordered(before, speed, after)?,
            Wall::Right => {
                let (after, speed, before) = ordered(after, speed, before)?;
                (before, speed, after)
            }
        };
        (cell.drifts[p], cell.drifts[i]) = (before, after);
        cell.phases[i] = self.where_speed(cell.phases[i], (speed, acceleration))?;
        Some(())
    }

    /// The phases at which the box may have such a speed, with this acceleration over all of them.
    fn where_speed(&self, phases: Span, (speed, acceleration): (Span, Span)) -> Option<Span> {
        let middle = Span::point(phases.mid());
        if let Some(off) = (speed - self.excitation.speed(middle)).over(acceleration) {
            return both(phases, middle + off);
        }
        // Slices at both ends in which the box has other speeds are taken off.
        let part = |n: u32| (phases.hi() - phases.lo()) * f64::from(n) / f64::from(SLICES); // V41: any places in order
        let line = |n: u32| if n == SLICES { phases.hi() } else { (phases.lo() + part(n)).min(phases.hi()) }; // V41: likewise
        let may_be = |n: &u32| self.excitation.speed(Span::new(line(*n), line(n + 1))).common(speed).is_some();
        let first = (0..SLICES).find(may_be)?;
        let last = (first..SLICES).rev().find(may_be)?;
        Some(Span::new(line(first), line(last + 1)))
    }

    /// Whether each flight of the box may be in the gap at these parts of its time.
    pub fn is_in_gap(&self, cell: &Cell, parts: u32) -> bool {
        let gap = Span::new(0.0, 1.0);
        (0..self.count()).all(|i| {
            let (from, to) = (cell.phases[i], self.end(&cell.phases, i));
            let [first, last] = [from, to].map(|at| self.excitation.displacement(at));
            (1..parts).all(|part| {
                let passed = Span::point(f64::from(part) / f64::from(parts)); // exact: parts are a power of two
                let left = Span::point(1.0) - passed;
                let here = self.excitation.displacement(left * from + passed * to);
                let chord = passed * (self.travel(i) + last) + left * first - here;
                let since = passed * cell.times[i];
                let change = self.excitation.change(from + since.scaled(0.5), since);
                let drifted = since * cell.drifts[i] - narrower(change, here - first);
                let height = both(chord, drifted).map(|height| height.signed(self.walls[i] == Wall::Left));
                height.and_then(|height| both(gap, height)).is_some()
            })
        })
    }
}

impl Along {
    /// Speeds of the box at both ends.
    pub fn ends(&self) -> [Span; 2] {
        [self.speeds[0], self.speeds[2]]
    }

    /// Encloses the mean speed of the box over the time of the flight; `None` where its enclosures have nothing in common.
    pub fn mean(&self) -> Option<Span> {
        let Self { time, change, speeds: [from, middle, to], whole: [speed, fifth, _], .. } = *self;
        let square = time * time;
        let simpson = (from + middle.scaled(4.0) + to) * ratio(6.0) - square * square * fifth * ratio(2880.0);
        both_if(both(speed, simpson)?, change.over(time))
    }

    /// Encloses the velocities after the first and before the last impact of a hop, over its time.
    pub fn hop(&self) -> [Span; 2] {
        let Self { time, accelerations: [from, middle, to], whole: [_, fifth, sixth], .. } = *self;
        let cube = time * time * time;
        let (short, long) = (cube * fifth.scaled(4.0), Span::new(0.0, 1.0) * time * cube * sixth);
        let [end, third, rest] = [6.0, 3.0, 2880.0].map(ratio);
        let after = from * end + middle * third - (long - short) * rest;
        let before = to * end + middle * third - (long + short) * rest;
        [after, -before]
    }
}

/// Encloses `1/n`.
fn ratio(n: f64) -> Span {
    let nearest = 1.0 / n;
    Span::new(nearest.next_down(), nearest.next_up())
}

/// What two enclosures of a number have in common; `None` if nothing. What is not known cuts nothing.
pub(super) fn both(x: Span, y: Span) -> Option<Span> {
    if y.lo().is_nan() { Some(x) } else { x.common(y) }
}

/// What two enclosures of a number that exists have in common.
fn narrower(x: Span, y: Span) -> Span {
    both(x, y).unwrap_or(x) // V41: the first holds it anyway
}

/// As [`both`], where the second enclosure may be missing.
fn both_if(x: Span, y: Option<Span>) -> Option<Span> {
    y.map_or(Some(x), |y| both(x, y))
}

/// Cuts three numbers `a <= b <= c` to what their order allows; `None` if it allows nothing.
fn ordered(a: Span, b: Span, c: Span) -> Option<(Span, Span, Span)> {
    let b = both(b, Span::new(a.lo(), f64::MAX))?;
    let b = both(b, Span::new(f64::MIN, c.hi()))?;
    Some((both(a, Span::new(f64::MIN, b.hi()))?, b, both(c, Span::new(b.lo(), f64::MAX))?))
}
