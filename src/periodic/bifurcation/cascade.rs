//! All the branches that the orbits of a word lie on, and those that leave them: the bifurcation diagram.

use std::cmp::Ordering;
use std::collections::VecDeque;

use super::super::chain::Chain;
use super::super::of_word;
use super::claim::{Setting, prove};
use super::diagram::{Branch, BranchEnd, Diagram, DiagramSettings, Unproved};
use super::family::{Family, Varied};
use super::follow::{Change, Path, Stop, follow};
use super::over::Parameter;
use super::point::{Kind, Point};
use super::ring::Ring;
use super::starts::{is_same, seeds};
use super::trace::{Station, correct, null_vector, tangent};
use super::tube::is_one_curve;
use crate::Error;
use crate::exact::Dyadic;
use crate::mapping::Word;
use crate::pair::ImpactPair;
use crate::scene::Key;
use crate::shaken::under;
use crate::watch::{Latched, Watch};
use impact_pair_model::{Start, require_digits};

/// A branch to be followed.
struct Lead {
    ring: Ring,
    start: Station,
    /// The first step.
    step: f64,
    doublings: u32,
    /// The bifurcation at which it leaves another branch, if it does: then it goes one way only.
    leaves: Option<Kind>,
}

/// Distance from a bifurcation at which the branch that leaves there is entered, in forcing periods; smaller where that fails.
const ENTRY_DISTANCE: f64 = 1e-3;

/// Least height in gap widths, and least speed in gap widths per forcing period, of an orbit that begins a branch: hops of no time are none.
const MIN_ORBIT_SIZE: f64 = 1e-6;

/// The survey as it goes on.
struct Survey<'w, S: Varied> {
    diagram_settings: &'w DiagramSettings,
    chain: &'w Chain,
    setting: Setting<'w, S>,
    floats: Family<S, f64>,
    range: [f64; 2],
    followed: Vec<(Ring, Path)>,
    leads: VecDeque<Lead>,
    diagram: Diagram,
    watch: &'w dyn Watch,
}

/// Finds the bifurcations on the branches of the orbits of a word, and on those that leave them.
///
/// Each point is proved. That there are no others is not: branches are found and followed in floating point. Where the watch stops it,
/// what was found until then is kept.
///
/// # Errors
/// If the word is not closed, the cycles are too many, or the range is not one of the parameter's. With several harmonics also if their
/// frequencies are not proved to be commensurate, the cycles are no multiple of the common period, or a frequency varies.
pub fn survey(
    pair: &ImpactPair,
    start: &Start,
    (word, cycles): (&Word, u32),
    diagram_settings: &DiagramSettings,
    watch: &dyn Watch,
) -> Result<Diagram, Error> {
    require_digits(diagram_settings.precision.digits)?;
    let parameter = Parameter::new(pair, &diagram_settings.over)?;
    let base = parameter.base()?;
    let (shaken, chain) = of_word(&base, word, cycles)?;
    under!(&shaken, shaken => survey_under(&**shaken, (&chain, &parameter), start, diagram_settings, watch))
}

fn survey_under<S: Varied>(
    base: &S,
    (chain, parameter): (&Chain, &Parameter),
    start: &Start,
    diagram_settings: &DiagramSettings,
    watch: &dyn Watch,
) -> Result<Diagram, Error> {
    let diagram = Diagram::new(parameter.clone());
    // Lemma T7: on one wall there is none.
    let Some(unknown) = parameter.unknown.filter(|_| chain.crosses()) else { return Ok(diagram) };
    let range = parameter.ends()?;
    let setting = Setting { unknown, base, parameter };
    let watch = Latched::new(watch);
    let mut survey = Survey {
        diagram_settings,
        chain,
        floats: setting.floats(),
        setting,
        range,
        followed: Vec::new(),
        leads: VecDeque::new(),
        diagram,
        watch: &watch,
    };
    for seed in seeds::<S>(chain, (parameter, start), &watch)? {
        survey.enqueue_branch(&seed.ring, seed.x);
        survey.follow_leads();
    }
    let mut diagram = survey.diagram;
    diagram.points.sort_by(|a, b| compare(a, b, diagram_settings.over.key()));
    diagram.interrupted = watch.is_stopped();
    Ok(diagram)
}

/// The order of the parameter: `d` falls as `A/d` rises.
fn compare(a: &Point, b: &Point, key: Key) -> Ordering {
    let order = a.parameter.inf().cmp(b.parameter.inf());
    if key == Key::Gap { order.reverse() } else { order }
}

impl<S: Varied> Survey<'_, S> {
    /// Takes up the branch through an orbit, unless it is followed already or the orbit is none of a motion.
    fn enqueue_branch(&mut self, ring: &Ring, x: Vec<f64>) {
        let mut along = vec![0.0; x.len()];
        along[x.len() - 1] = 1.0;
        // At a value where one of the harmonics vanishes, the orbit is that of the others, whose phases are counted otherwise.
        let on_branch = correct(ring, &self.floats, &x, &along);
        let Some(start) = on_branch.and_then(|x| Station::new(ring, &self.floats, x, &along)) else { return };
        let is_motion = start.tests.room.distance > MIN_ORBIT_SIZE && start.tests.arrival.0 > MIN_ORBIT_SIZE;
        if is_motion && !self.is_followed(ring, &start.x) {
            self.leads.push_back(Lead { ring: ring.clone(), start, step: 1e-3, doublings: 0, leaves: None });
        }
    }

    /// Whether an orbit lies on a path that was followed.
    fn is_followed(&self, ring: &Ring, x: &[f64]) -> bool {
        let p = x[x.len() - 1];
        let mut across = vec![0.0; x.len()];
        across[x.len() - 1] = 1.0;
        let passes = |pair: &[Station]| {
            let (a, b) = (&pair[0], &pair[1]);
            let part = (p - a.parameter()) / (b.parameter() - a.parameter());
            if !(-0.01..=1.01).contains(&part) {
                return false;
            }
            let mut guess: Vec<f64> = a.x.iter().zip(&b.x).map(|(a, b)| part.mul_add(b - a, *a)).collect();
            *guess.last_mut().expect("a parameter") = p;
            correct(ring, &self.floats, &guess, &across).is_some_and(|there| {
                let phases = |x: &[f64]| ring.lift(&x[..x.len() - 1]);
                is_same(ring.chain(), &phases(&there), &phases(x))
            })
        };
        self.followed.iter().filter(|(its, _)| its == ring).any(|(_, path)| path.stations.windows(2).any(passes))
    }

    /// Follows all open leads.
    fn follow_leads(&mut self) {
        while let Some(lead) = self.leads.pop_front().filter(|_| self.watch.goes_on()) {
            if lead.leaves.is_some() && self.is_followed(&lead.ring, &lead.start.x) {
                continue;
            }
            let back = lead.start.reversed();
            let mut ends = [BranchEnd::Lost; 2];
            let mut range = [f64::INFINITY, f64::NEG_INFINITY];
            let mut both_starts = vec![lead.start.clone()];
            match lead.leaves {
                Some(kind) => ends[1] = BranchEnd::at(kind),
                None => both_starts.push(back),
            }
            // All the way from one end to the other.
            let mut whole: Vec<Station> = Vec::new();
            for (end, from) in ends.iter_mut().zip(both_starts) {
                let path = follow(&lead.ring, &self.floats, (from, lead.step), self.range, self.watch);
                whole.reverse();
                whole.extend(path.stations.iter().skip(usize::from(!whole.is_empty())).cloned());
                let (its_end, met) = self.prove_changes(&lead, &path);
                *end = its_end;
                for p in path.within().iter().map(Station::parameter).chain(met) {
                    range = [range[0].min(p), range[1].max(p)]; // shown
                }
                self.followed.push((lead.ring.clone(), path));
                if *end == BranchEnd::Closed {
                    break;
                }
            }
            if ends[0] == BranchEnd::Closed {
                ends[1] = BranchEnd::Closed;
            }
            let is_proved = is_one_curve(&lead.ring, (&self.floats, &self.setting.doubles()), &whole, self.watch);
            let range = [range[0].max(self.range[0]), range[1].min(self.range[1])]; // shown
            let (word, cycles, symmetric) = (lead.ring.word(), lead.ring.chain().cycles(), lead.ring.is_mirrored());
            self.diagram.branches.push(Branch { word, cycles, symmetric, range, ends, is_proved });
        }
    }

    /// Proves the changes of a path, and takes up the branches that leave there. Returns the end of the path, and the parameter at each change.
    fn prove_changes(&mut self, lead: &Lead, path: &Path) -> (BranchEnd, Vec<f64>) {
        let (mut last, mut met) = (None, Vec::new());
        for (change, x) in &path.changes {
            let joined = match change {
                Change::Join => half_of(&lead.ring, x),
                _ => None,
            };
            let (ring, x, change) = match joined {
                Some((half, x)) => (half, x, Change::Flip),
                None => (lead.ring.clone(), x.clone(), *change),
            };
            let kind = kind_of(&ring, &change);
            last = Some(kind);
            // The branch that is doubled there has one doubling less, but for a pitchfork.
            let joins = ring != lead.ring;
            let doublings = match (kind, joins) {
                (Kind::PeriodDoubling, false) => lead.doublings + 1,
                _ => lead.doublings,
            };
            let proved = self
                .watch
                .goes_on()
                .then(|| prove(&self.setting, &ring, (change, &x), self.diagram_settings.precision));
            match proved.flatten() {
                Some(point) => {
                    met.push(point.parameter.mid_rad().0);
                    self.enter(Point { doublings, ..point });
                }
                None => {
                    let near = x[x.len() - 1];
                    met.push(near);
                    self.diagram.unproved.push(Unproved { kind, near, word: ring.word() });
                }
            }
            let is_flip = matches!(change, Change::Flip) && !joins;
            if is_flip && (kind == Kind::Pitchfork || doublings < self.diagram_settings.doublings) {
                self.take_up(&ring, &x, kind, doublings);
            }
        }
        let end = match path.stop {
            Stop::Range => BranchEnd::Range,
            Stop::Loop => BranchEnd::Closed,
            Stop::Change => last.map_or(BranchEnd::Lost, BranchEnd::at),
            Stop::Lost => BranchEnd::Lost,
            Stop::Interrupted => BranchEnd::Interrupted,
        };
        (end, met)
    }

    /// Lists a point once, if it may lie in the range.
    fn enter(&mut self, point: Point) {
        let end = |x: f64| Dyadic::from_f64(x).expect("a finite number");
        let [low, high] = self.range;
        if *point.parameter.sup() < end(low) || *point.parameter.inf() > end(high) {
            return;
        }
        let is_known = |known: &Point| {
            known.kind == point.kind
                && known.word == point.word
                && known.parameter.intersection(&point.parameter).is_some()
                && is_same_orbit(self.chain, known, &point)
        };
        if !self.diagram.points.iter().any(is_known) {
            self.diagram.points.push(point);
        }
    }

    /// Takes up the branch that leaves at an eigenvalue -1. Lemma Y4
    fn take_up(&mut self, ring: &Ring, x: &[f64], kind: Kind, doublings: u32) {
        let lead = ring.doubled().zip(null_vector(ring, &self.floats, x, -1.0)).and_then(|(doubled, w)| {
            let (p, phases) = x.split_last()?;
            let later: Vec<f64> = phases.iter().map(|u| u + ring.turns()).collect();
            let along: Vec<f64> = w.iter().copied().chain(w.iter().map(|w| -w)).chain([0.0]).collect();
            let at = [phases, &later, &[*p]].concat();
            [1.0, 0.1, 0.01].into_iter().find_map(|part| {
                let guess: Vec<f64> =
                    at.iter().zip(&along).map(|(x, t)| (part * ENTRY_DISTANCE).mul_add(*t, *x)).collect();
                let there = correct(&doubled, &self.floats, &guess, &along)?;
                let towards: Vec<f64> = there.iter().zip(&at).map(|(a, b)| a - b).collect();
                let towards = tangent(&doubled, &self.floats, &there, &towards)?;
                let start = Station::new(&doubled, &self.floats, there, &towards)?;
                let step = 0.2 * part * ENTRY_DISTANCE;
                Some(Lead { ring: doubled.clone(), start, step, doublings, leaves: Some(kind) })
            })
        });
        match lead {
            Some(lead) => self.leads.push_back(lead),
            None => self.diagram.unproved.push(Unproved { kind, near: x[x.len() - 1], word: ring.word() }),
        }
    }
}

/// Kind of bifurcation that a change of sign on a ring may be.
fn kind_of(ring: &Ring, change: &Change) -> Kind {
    match change {
        Change::Turn => Kind::Fold,
        Change::Flip | Change::Join if ring.is_mirrored() => Kind::Pitchfork,
        Change::Flip | Change::Join => Kind::PeriodDoubling,
        Change::Graze(_) | Change::Vanish(_) | Change::Release(_) => Kind::Graze,
    }
}

/// Half of a ring that the ring meets at `x`, and the phases and parameter there.
fn half_of(ring: &Ring, x: &[f64]) -> Option<(Ring, Vec<f64>)> {
    let (p, phases) = x.split_last()?;
    let distance = |half: &Ring| {
        let apart = |i: usize| (phases[i + half.unknowns()] - phases[i] - half.turns()).abs();
        (0..half.unknowns()).map(apart).fold(0.0, f64::max) // proposes
    };
    let half = ring.halves().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let middle = |i: usize| 0.5 * (phases[i] + phases[i + half.unknowns()] - half.turns());
    let x = (0..half.unknowns()).map(middle).chain([*p]).collect();
    Some((half, x))
}

/// Whether two points with one parameter show one orbit, or mirror images, up to the accuracy of doubles; `chain` is of their excitation.
fn is_same_orbit(chain: &Chain, one: &Point, other: &Point) -> bool {
    let phases = |point: &Point| -> Vec<f64> { point.impacts.iter().map(|impact| impact.phase.mid_rad().0).collect() };
    chain.another(&one.word, one.cycles).is_ok_and(|chain| is_same(&chain, &phases(one), &phases(other)))
}
