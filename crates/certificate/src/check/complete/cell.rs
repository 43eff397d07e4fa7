//! Boxes of phases, and the equations of a word that cut them (Lemma V41).

use super::super::contact::Doubt;
use super::super::span::Span;
use super::excitation::Excitation;
use impact_pair_model::Wall;

/// The equations of a word that takes a number of forcing periods.
#[derive(Clone, Debug)]
pub(super) struct Equations {
    pub excitation: Excitation,
    pub restitution: Span,
    /// Walls of the impacts, in time order.
    pub walls: Vec<Wall>,
    /// Forcing periods that the word takes.
    pub cycles: f64,
    /// Forcing periods after which the excitation repeats.
    pub period: f64,
}

/// A box of phases, with bounds of the time and of the drift of each flight of the orbits in it.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub phases: Vec<Span>,
    pub times: Vec<Span>,
    pub drifts: Vec<Span>,
}

impl Equations {
    /// Number of impacts.
    pub fn count(&self) -> usize {
        self.walls.len()
    }

    /// Index of the impact after impact `i`.
    pub fn next(&self, i: usize) -> usize {
        (i + 1) % self.count()
    }

    /// Index of the impact before impact `i`.
    pub fn previous(&self, i: usize) -> usize {
        (i + self.count() - 1) % self.count()
    }

    /// Whether flight `i` comes back to the wall that it leaves.
    pub fn is_hop(&self, i: usize) -> bool {
        self.walls[i] == self.walls[self.next(i)]
    }

    /// Displacement of flight `i` in gap widths: 1 to the right, -1 to the left, 0 of a hop.
    pub fn travel(&self, i: usize) -> Span {
        Span::point(match (self.walls[i], self.walls[self.next(i)]) {
            (Wall::Left, Wall::Right) => 1.0,
            (Wall::Right, Wall::Left) => -1.0,
            _ => 0.0,
        })
    }

    /// Forcing periods to add to the phase of the next impact at the end of flight `i`.
    pub fn later(&self, i: usize) -> Span {
        Span::point(if self.next(i) == 0 { self.cycles } else { 0.0 })
    }

    /// Phases at the end of flight `i`.
    pub fn end(&self, phases: &[Span], i: usize) -> Span {
        phases[self.next(i)] + self.later(i)
    }

    /// A box that holds all orbits of the word, up to whole common periods; `None` if the word has none. Lemmas T7, T8
    pub fn everything(&self) -> Result<Option<Cell>, Doubt> {
        if self.walls.iter().all(|&wall| wall == self.walls[0]) {
            return Ok(None); // T7
        }
        let (one, count) = (Span::point(1.0), self.count());
        let [displacement, speed] = self.excitation.greatest();
        let lossy = one + self.restitution;
        let number = |n: usize| Span::point(n as f64); // exact: a length
        let longest = ((one + displacement.scaled(2.0)) * number(count)).over(Span::point(self.cycles));
        let unbounded = || Doubt::open("drifts have no bound in doubles");
        let general = longest.ok_or_else(unbounded)? + lossy * number(count - 1) * speed;
        let lost = (lossy * speed).over(one - self.restitution);
        let drift = lost.and_then(|lost| (lost.hi() < general.hi()).then_some(lost)).unwrap_or(general).hi(); // T8
        let crossing = one.over(Span::point((Span::point(drift) + speed).hi())).ok_or_else(unbounded)?.lo();
        if drift.is_nan() || crossing.is_nan() {
            return Err(unbounded());
        }
        let reach = (self.period + self.cycles).next_up();
        if crossing > reach {
            return Ok(None);
        }
        let time = |i| Span::new(if self.is_hop(i) { 0.0 } else { crossing }, reach);
        let phase = |i| if i == 0 { Span::new(0.0, self.period) } else { Span::new(0.0, reach) };
        Ok(Some(Cell {
            phases: (0..count).map(phase).collect(),
            times: (0..count).map(time).collect(),
            drifts: vec![Span::new(-drift, drift); count],
        }))
    }
}

impl Cell {
    /// Sum of the widths of phases and times: how much of a box is left.
    pub fn size(&self) -> f64 {
        self.phases.iter().chain(&self.times).map(|x| x.hi() - x.lo()).sum()
    }

    /// The middle of the phases.
    pub fn centre(&self) -> Vec<f64> {
        self.phases.iter().map(|x| x.mid()).collect()
    }

    /// The widest phase.
    pub fn widest(&self) -> usize {
        let width = |i: &usize| self.phases[*i].hi() - self.phases[*i].lo();
        (0..self.phases.len()).max_by(|i, j| width(i).total_cmp(&width(j))).unwrap_or(0) // exact: a box has a phase
    }

    /// The parts of the box on both sides of a place of one phase; `None` where a side has no part.
    pub fn halved(self, phase: usize, place: f64) -> [Option<Self>; 2] {
        let whole = self.phases[phase];
        let part = |lo: f64, hi: f64| {
            let mut part = self.clone();
            part.phases[phase] = Span::new(lo, hi);
            part
        };
        if place <= whole.lo() {
            [None, Some(self)]
        } else if place >= whole.hi() {
            [Some(self), None]
        } else {
            [Some(part(whole.lo(), place)), Some(part(place, whole.hi()))]
        }
    }
}
