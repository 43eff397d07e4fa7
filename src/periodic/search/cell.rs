//! The orbits whose first impact lies in a cell of phases: Lemmas T9, T10.

use super::cut::{Part, Stretch, Terms};
use super::newton::{Rows, Step};
use crate::contact::Reason;
use crate::exact::Enclosure;
use crate::number::Ball;
use crate::number::interval::Interval;
use crate::periodic::census::Region;
use crate::periodic::chained::Chained;
use crate::periodic::identity::{Identity, is_one_orbit};
use crate::periodic::krawczyk::Proved;
use crate::periodic::newton::{is_plausible, polish};
use crate::periodic::orbit::{PeriodicImpact, PeriodicOrbit};
use crate::periodic::{Precision, Problem};
use crate::watch::Watch;

/// Width in forcing periods below which boxes are tested for a near orbit.
const KNOWN_ORBIT_WIDTH: f64 = 1.0 / 16.0;
/// The least part of a box that Newton's equation takes off for the box to be cut again.
const MIN_GAIN: f64 = 0.3;
/// Parts left undecided at which a cell is given up: there is a continuum of orbits, or nearly one.
const MOST_UNDECIDED: usize = 64;
/// Relative to the widest phase: least width of the phase that the equations determine least, for a box to be halved there.
const RELATIVE_WIDTH: f64 = 0.5;

/// The problem of a search, and its settings.
pub(super) struct Task<'p, S> {
    pub problem: &'p Problem,
    pub shaken: &'p S,
    pub terms: Terms<'p>,
    pub precision: Precision,
    /// Width below which a box is not halved, in forcing periods.
    pub narrowest: f64,
    /// Orbits known before.
    pub known: &'p [PeriodicOrbit],
    /// May stop the search.
    pub watch: &'p dyn Watch,
}

/// A cell, as far as it is searched.
pub(super) struct Cell<'t, 'p, S> {
    task: &'t Task<'p, S>,
    pub terms: &'t Terms<'p>,
    first: Interval,
    /// Boxes that may still be looked at.
    pub left: u64,
    /// Parts that are not searched yet, the next one last; none before the cell is begun.
    open: Option<Vec<Part>>,
    /// Orbits found that were not known before, virtual ones included.
    pub found: Vec<PeriodicOrbit>,
    undecided: Vec<Region>,
}

/// A box cut by all equations.
pub(super) struct Narrow {
    pub part: Part,
    rows: Rows,
    weakest: usize,
    is_regular: bool,
}

impl<'t, 'p, S: Chained> Cell<'t, 'p, S> {
    pub fn new(task: &'t Task<'p, S>, first: Interval) -> Self {
        let (found, undecided) = (Vec::new(), Vec::new());
        Self { task, terms: &task.terms, first, left: 0, open: None, found, undecided }
    }

    /// The part of the state space that the cell covers.
    pub fn all(&self) -> Part {
        self.terms.all(self.first)
    }

    /// Takes a box from the budget; false where there is none.
    pub fn look(&mut self) -> bool {
        let looks = self.left > 0 && self.task.watch.goes_on();
        self.left -= u64::from(looks);
        looks
    }

    /// Whether nothing is left to search, or the rest is given up.
    pub fn is_done(&self) -> bool {
        self.undecided.len() >= MOST_UNDECIDED || self.open.as_ref().is_some_and(Vec::is_empty)
    }

    /// Searches on, depth first, so that little is kept, until the budget ends.
    pub fn search(&mut self) {
        if self.open.is_none() {
            self.open = self.chains();
        }
        let Some(mut open) = self.open.take() else { return };
        while self.undecided.len() < MOST_UNDECIDED && !open.is_empty() && self.look() {
            let Some(narrow) = open.pop().and_then(|part| self.narrow(part, &self.terms.whole())) else { continue };
            if self.holds_known(&narrow) {
                continue;
            }
            if self.is_last(&narrow) {
                self.undecided.push(self.region(&narrow.part, Reason::Precision));
                continue;
            }
            let across = narrow.across();
            let middle = narrow.part.phases[across].mid();
            open.extend(narrow.part.halved(across, middle));
        }
        self.open = Some(open);
    }

    /// Regions that the search leaves undecided.
    pub fn undecided(&self) -> Vec<Region> {
        let all = [self.all()];
        let open = self.open.as_deref().unwrap_or(&all); // T10: nothing of it is searched
        let open = open.iter().map(|part| self.region(part, Reason::Budget));
        self.undecided.iter().cloned().chain(open).collect()
    }

    /// Cuts a part by all equations of a stretch; `None` when nothing is left.
    pub fn narrow(&self, part: Part, stretch: &Stretch) -> Option<Narrow> {
        let (terms, shaking) = (self.terms, self.task.shaken.balls());
        let all = terms.chain.impacts();
        let mut part = terms.cut(part, stretch)?;
        loop {
            let rows = terms.rows(&part, stretch.impacts.clone());
            let before = part.size();
            let Step { part: cut, weakest, is_regular } = terms.newton(shaking, part, &rows)?;
            part = cut;
            // Near a bifurcation the others follow from the phase that is determined least, though it follows from none.
            if stretch.impacts.len() == all {
                part = terms.newton(shaking, part.clone(), &terms.rows(&part, weakest + 1..weakest + all))?.part;
            }
            if part.size() > (1.0 - MIN_GAIN) * before {
                return Some(Narrow { part, rows, weakest, is_regular });
            }
            part = terms.cut(part, stretch)?;
        }
    }

    /// Whether a narrow part holds no orbit but a known one; an orbit that is found there is known from then on.
    pub fn holds_known(&mut self, narrow: &Narrow) -> bool {
        let looks = narrow.is_regular || self.is_last(narrow);
        narrow.part.wid() <= KNOWN_ORBIT_WIDTH && self.is_known(&narrow.part, looks)
    }

    /// Whether a part is too narrow to be halved.
    pub fn is_last(&self, narrow: &Narrow) -> bool {
        narrow.part.wid() <= self.task.narrowest
    }

    /// Whether a known orbit is the only one in the part; if none is known and `looks` is set, an orbit is searched for first.
    fn is_known(&mut self, part: &Part, looks: bool) -> bool {
        let balls: Vec<Ball> = part.phases.iter().map(|&x| x.into()).collect();
        let whole = Proved { domain: balls.clone(), at: balls };
        let chain = &self.task.problem.chain;
        let is_inside = |known: &PeriodicOrbit| is_one_orbit(chain, &whole, &known.proved) == Some(true);
        if self.task.known.iter().chain(&self.found).any(is_inside) {
            return true;
        }
        let Some((orbit, identity)) = looks.then(|| self.orbit_near(part)).flatten() else { return false };
        // An orbit that may be a known one stays a question.
        let is_known = identity != Identity::Open && is_inside(&orbit);
        if identity == Identity::New {
            self.found.push(orbit);
        }
        is_known
    }

    /// Proves the orbit in or beside the part that Newton's iteration leads to; also whether the orbit is known.
    fn orbit_near(&self, part: &Part) -> Option<(PeriodicOrbit, Identity)> {
        let (chain, floats) = (&self.task.problem.chain, self.task.shaken.floats());
        let phases = polish(chain, floats, part.centre())?;
        let is_near = |(x, part): (&f64, &Interval)| (x - part.mid()).abs() <= part.wid();
        if !(phases.iter().zip(&part.phases).all(is_near) && is_plausible(chain, floats, &phases)) {
            return None;
        }
        let known = self.task.known.iter().chain(&self.found);
        self.task.problem.prove_beside(&phases, self.task.precision, known)
    }

    /// Region of a part that stays undecided.
    fn region(&self, part: &Part, reason: Reason) -> Region {
        let chain = self.terms.chain;
        let enclosure = |x: Interval| Enclosure::from_f64_bounds(x.inf(), x.sup()).expect("finite intervals");
        let impact = |i: usize| PeriodicImpact {
            wall: chain.walls()[i],
            phase: enclosure(part.phases[i]),
            velocity: enclosure(part.drifts[chain.previous(i)] - self.terms.speed(part.phases[i])),
        };
        Region { impacts: (0..part.phases.len()).map(impact).collect(), reason }
    }
}

impl Narrow {
    /// Phase to halve the part at: the one that the equations determine least or, if that is narrow, the one they depend on most.
    pub fn across(&self) -> usize {
        let Self { part, rows, weakest, .. } = self;
        let weights = rows.weights(part.phases.len());
        let weight = |j: &usize| weights[*j] * part.phases[*j].wid();
        let heaviest = (0..weights.len()).max_by(|a, b| weight(a).total_cmp(&weight(b))).unwrap_or(0); // proposes
        if part.phases[*weakest].wid() >= RELATIVE_WIDTH * part.wid() { *weakest } else { heaviest }
    }
}
