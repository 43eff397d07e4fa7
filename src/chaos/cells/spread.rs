//! Horseshoes of neighbouring values: their h-sets are followed over the parameter in floating point, and what they lead to is proved
//! of each part of what is undecided by itself. Lemma D14

use super::super::horseshoe::{Horseshoe, bases, problem};
use super::super::law::Law;
use super::super::trials::BUNDLED;
use super::super::words::HSet;
use super::followed::Followed;
use super::{NAME, Stretch, Verdict, Work, join, middle};
use crate::Error;
use crate::exact::Exact;
use crate::number::Ball;
use crate::pair::within;
use crate::threads::each;

/// Numbers of halvings of a cell for the parts in which undecided stretches are looked at: first, and where nothing is proved of such a part.
const PART_HALVINGS: [u32; 2] = [3, 4];
/// Number of parts in a row, with nothing proved of any, that ends a walk.
const MAX_MISSES: usize = 4;
/// Factors by which h-sets are wider than at the value they are from, since an interval of the parameter moves images across; the first
/// one with which they are apart is taken.
const WIDTH_FACTORS: [f64; 3] = [2.0, 1.4, 1.0];
/// The most stretches in which h-sets are searched for, and the narrowest one, a cell being 1.
const MAX_SEARCHES: usize = 8;
const MIN_STRETCH: f64 = 0.25;

/// H-sets of a value.
#[derive(Clone, Debug)]
pub(super) struct Seed {
    pub value: Exact,
    pub bases: Vec<HSet>,
}

/// Neighbouring stretches, and the h-sets of the horseshoes below and above them.
#[derive(Debug, Default)]
struct Gap {
    stretches: Vec<Stretch>,
    seeds: [Option<Seed>; 2],
}

/// Stretches that are passed one after another, upward or downward, and the h-sets followed so far.
struct Walk<'w> {
    work: &'w Work<'w>,
    followed: Option<Followed>,
    is_upward: bool,
    missed: usize,
    passed: Vec<Stretch>,
}

/// A value in a double.
fn double(value: &Exact) -> f64 {
    Ball::of(value).mid()
}

fn is_open(stretch: &Stretch) -> bool {
    stretch.verdict == Verdict::Undecided
}

/// Parts in the order of a walk: the last one first when downward.
fn in_order<const N: usize>(mut parts: [Stretch; N], is_upward: bool) -> [Stretch; N] {
    if !is_upward {
        parts.reverse();
    }
    parts
}

/// Stretches one after another, as one list.
fn joined(stretches: impl IntoIterator<Item = Result<Vec<Stretch>, Error>>) -> Result<Vec<Stretch>, Error> {
    let mut all = Vec::new();
    for some in stretches {
        some?.into_iter().for_each(|stretch| join(&mut all, stretch));
    }
    Ok(all)
}

impl Work<'_> {
    /// Tries the undecided stretches with h-sets of their neighbours, and with h-sets that are searched for within.
    pub(super) fn spread(&self, stretches: Vec<Stretch>) -> Result<Vec<Stretch>, Error> {
        let mut stretches = self.between(stretches)?;
        let searches = if self.requested.halvings < PART_HALVINGS[0] { 0 } else { MAX_SEARCHES }; // proposes: worth it only in narrow parts
        let mut looked_at: Vec<f64> = Vec::new();
        while looked_at.len() < searches && self.watch.goes_on() {
            let Some([low, high]) = self.widest(&stretches, &looked_at) else { break };
            let value = middle(&low, &high)?;
            looked_at.push(double(&value));
            let values = [&value, &middle(&low, &value)?, &middle(&value, &high)?];
            if let Some(seed) = self.seed(values)? {
                stretches = self.beside(&seed, stretches)?;
            }
        }
        Ok(stretches)
    }

    /// The widest stretch that is undecided and in which no value was looked at.
    fn widest(&self, stretches: &[Stretch], looked_at: &[f64]) -> Option<[Exact; 2]> {
        let width = |stretch: &&Stretch| double(&stretch.high) - double(&stretch.low);
        let is_new = |stretch: &&Stretch| {
            let [low, high] = [&stretch.low, &stretch.high].map(double);
            !looked_at.iter().any(|&value| low < value && value < high)
        };
        let open = stretches.iter().filter(|stretch| is_open(stretch) && width(stretch) >= MIN_STRETCH * self.wide(0));
        let widest = open.filter(is_new).max_by(|a, b| width(a).total_cmp(&width(b)))?;
        Some([widest.low.clone(), widest.high.clone()])
    }

    /// Width of a cell after `halved` halvings, in units of the parameter.
    fn wide(&self, halved: u32) -> f64 {
        let over = &self.requested.over;
        (double(over.high()) - double(over.low())) / f64::from(self.requested.cells) / f64::from(1 << halved)
    }

    fn law(&self, [low, high]: [&Exact; 2]) -> Result<Law, Error> {
        Law::of(&self.pair.with(self.requested.over.key(), within(NAME, low, Exact::interval(low, high))?)?)
    }

    /// H-sets about bundles of leaves at the first of some values whose floating-point orbit is chaotic.
    fn seed(&self, values: [&Exact; 3]) -> Result<Option<Seed>, Error> {
        let Some((value, orbit)) = self.looked_at(values, false)? else { return Ok(None) };
        let bases = bases(&orbit, &self.law([&value; 2])?, self.requested.depth, BUNDLED, self.watch);
        Ok((!bases.is_empty()).then_some(Seed { value, bases }))
    }

    /// Tries the undecided stretches between horseshoes with the h-sets below and then with the h-sets above.
    fn between(&self, stretches: Vec<Stretch>) -> Result<Vec<Stretch>, Error> {
        let mut gaps = vec![Gap::default()];
        for stretch in stretches {
            let last = gaps.len() - 1; // exact: there is one at least
            if let Verdict::Horseshoe(horseshoe) = &stretch.verdict {
                let seed = Seed { value: middle(&stretch.low, &stretch.high)?, bases: horseshoe.bases.clone() };
                gaps[last].seeds[1] = Some(seed.clone());
                gaps.push(Gap { stretches: vec![stretch], seeds: [Some(seed), None] });
            } else {
                gaps[last].stretches.push(stretch);
            }
        }
        let filled = |Gap { stretches, seeds: [below, above] }: &Gap| {
            let from = |seed: &Option<Seed>, stretches: Vec<Stretch>, is_upward: bool| match seed {
                Some(seed) => self.walked(seed, stretches, is_upward),
                None => Ok(stretches),
            };
            from(above, from(below, stretches.clone(), true)?, false)
        };
        joined(each(&gaps, &filled))
    }

    /// Tries the undecided stretches on both sides of a value with the h-sets of that value.
    fn beside(&self, seed: &Seed, stretches: Vec<Stretch>) -> Result<Vec<Stretch>, Error> {
        let value = double(&seed.value);
        let mut sides = [(Vec::new(), false), (Vec::new(), true)];
        for stretch in stretches {
            let [low, high] = [&stretch.low, &stretch.high].map(double);
            if is_open(&stretch) && low < value && value < high {
                sides[0].0.push(Stretch { high: seed.value.clone(), ..stretch.clone() }); // D14: both parts have the value
                sides[1].0.push(Stretch { low: seed.value.clone(), ..stretch });
            } else {
                sides[usize::from(low >= value)].0.push(stretch); // exact: whole stretches, in their order
            }
        }
        joined(each(&sides, &|(stretches, is_upward)| self.walked(seed, stretches.clone(), *is_upward)))
    }

    /// Stretches beginning at a value, from there on: parts of those that are undecided are tried by its h-sets.
    pub(super) fn walked(&self, seed: &Seed, stretches: Vec<Stretch>, is_upward: bool) -> Result<Vec<Stretch>, Error> {
        if !stretches.iter().any(is_open) {
            return Ok(stretches); // exact: nothing to prove
        }
        let wider = |factor: f64| seed.bases.iter().map(|base| base.wider(factor)).collect::<Vec<HSet>>();
        let bases = WIDTH_FACTORS.map(wider).into_iter().find(|bases| problem(bases).is_none());
        let law = self.law([&seed.value; 2])?;
        let followed = bases.and_then(|bases| Followed::of(&law, &bases));
        let mut walk = Walk { work: self, followed, is_upward, missed: 0, passed: Vec::new() };
        let mut left = stretches;
        if !is_upward {
            left.reverse();
        }
        for stretch in left {
            if is_open(&stretch) { walk.pass(stretch)? } else { walk.passed.push(stretch) }
        }
        if !is_upward {
            walk.passed.reverse();
        }
        Ok(walk.passed)
    }
}

impl Walk<'_> {
    /// Passes an undecided stretch: as a whole if narrow enough and a horseshoe is proved for all of it, or else its halves.
    fn pass(&mut self, stretch: Stretch) -> Result<(), Error> {
        let width = double(&stretch.high) - double(&stretch.low);
        let is_wider = |than: u32| width > 1.001 * self.work.wide(than.min(self.work.requested.halvings)); // proposes: which parts
        let [is_wide, is_halved] = PART_HALVINGS.map(is_wider);
        if self.followed.is_none() || self.missed >= MAX_MISSES || !self.work.watch.goes_on() {
            self.passed.push(stretch);
            return Ok(());
        }
        let found = if is_wide { None } else { self.proved(&stretch)? };
        match found {
            Some(horseshoe) => {
                self.missed = 0; // proposes: whether to go on
                self.passed.push(stretch.with(Verdict::Horseshoe(horseshoe)));
            }
            None if is_halved => {
                let middle = middle(&stretch.low, &stretch.high)?;
                let lower = Stretch { high: middle.clone(), ..stretch.clone() };
                for half in in_order([lower, Stretch { low: middle, ..stretch }], self.is_upward) {
                    self.pass(half)?;
                }
            }
            None => {
                self.missed += 1; // proposes: whether to go on
                self.passed.push(stretch);
            }
        }
        Ok(())
    }

    /// The horseshoe of the h-sets moved to the middle of a stretch, for all its values.
    fn proved(&mut self, stretch: &Stretch) -> Result<Option<Horseshoe>, Error> {
        let law = self.work.law([&stretch.low, &stretch.high])?;
        self.followed = self.followed.as_ref().and_then(|followed| followed.to(&law));
        let Some(followed) = &self.followed else { return Ok(None) };
        Ok(Horseshoe::quick(&law, followed.bases(), self.work.requested.depth, self.work.watch))
    }
}
