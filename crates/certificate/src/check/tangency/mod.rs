//! Check of a JSON of tangencies: single shooting in multiprecision encloses each tangency again, from manifolds as power series of a
//! scalar equation with proved remainders (Lemmas V17-V19, V29). Claims about boxes of states are proved by the equations of all
//! flights (Lemmas V31, V32).
//!
//! In reading order: [`jet`] and [`disc`] (arithmetic), [`saddle`], [`local`] (where the manifolds are analytic), [`series`],
//! [`flights`], [`shot`] (from one manifold to the other), [`newton`] (zeros); [`chain`] (all flights), [`krawczyk`], [`beside`] (common
//! points on either side), [`intervals`] (of the other datum).

mod area;
mod beside;
mod chain;
mod disc;
pub(super) mod flights;
mod intervals;
pub(super) mod jet;
mod krawczyk;
mod local;
mod newton;
mod rows;
pub(super) mod saddle;
pub(super) mod series;
pub(super) mod setting;
mod shot;

use num_rational::BigRational;
use num_traits::Signed;

use super::budget::Budget;
use super::clock::{SetPosition, beside};
use super::contact::Doubt;
use super::frame::hull;
use super::walk::compare;
use super::{DocumentCheck, Limits, Verdict};
use crate::attraction::Bounds;
use crate::tangency::{ClaimedTangency, TangencyCertificate};
use flights::Letter;
use impact_pair_exact::{Real, compare_rational};
use impact_pair_model::watch::Watch;
use impact_pair_model::{Error, ImpactPair};
use newton::{Zeros, polished, zeros};
use saddle::{Family, Law, Saddle};
use setting::Setting;
use shot::{Range, Shot, Unknowns, known};

/// Bits of the arithmetic beyond those of the box in which a tangency is found.
const SPARE_BITS: i64 = 112;
/// Numbers of bits, tried in turn, by which the box of a tangency is narrower than the claimed bounds.
const BOX_BITS_INSIDE: [i64; 3] = [20, 72, 160];
/// Greatest precision of the arithmetic, in bits.
const MAX_BITS: i64 = 1 << 11;
/// The highest order of resonances that is checked.
const MAX_RESONANCE_ORDER: u32 = 1024;

impl TangencyCertificate {
    /// Proves every tangency again, or names a tangency that is refuted or undecided. The watch can stop the check and receives the
    /// number of tangencies checked so far.
    ///
    /// # Errors
    /// None: a value beyond the range of exact expressions leaves a tangency undecided.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        let whole = DocumentCheck {
            contradiction: self.contradiction.as_deref(),
            alike: (!self.are_different()).then_some("two tangencies may be one"),
            count: self.count(),
            nothing: "there is no tangency to check",
        };
        let claims = self.tangencies.iter().enumerate();
        Ok(whole.judged(claims, limits, watch, |claim, budget, _| claim.judged(&self.pair, (limits, budget))))
    }
}

impl ClaimedTangency {
    /// Proves that the claim is a tangency with the claimed properties, and returns the bits used.
    fn judged(&self, pair: &ImpactPair, (limits, budget): (&Limits, &Budget<'_>)) -> Result<u32, Doubt> {
        if let Some(message) = self.contradiction() {
            return Err(Doubt::False(message));
        }
        if let Some(states) = &self.states {
            return match &self.beside {
                Some(_) => Err(Doubt::open("common points beside tangencies for an interval are not counted")),
                None => self.is_for_each(states, (&Setting::of_all(pair, self.key)?, self.letters()), budget),
            };
        }
        let setting = Setting::new(pair, self.key)?;
        let near = Real::rational(&self.phase[0], 128);
        let mut range = Range::new(self.letters(), near, budget.clone());
        let mut answer = Err(Doubt::open("nothing is tried"));
        for inside in BOX_BITS_INSIDE {
            answer = self.judged_inside(&setting, &mut range, inside);
            match &answer {
                Err(Doubt::Open(_)) if !budget.is_spent() => {}
                _ => break,
            }
        }
        let (bits, at, shot) = answer?;
        if let Some(sides) = &self.beside {
            self.compare_sides(&setting, [&sides.two, &sides.none])?;
            budget.add(limits.work);
            self.has_sides(sides, (&setting, &range.letters), (&at, &shot), budget)?;
        }
        Ok(bits)
    }

    fn letters(&self) -> Vec<Letter> {
        self.flights.iter().map(|is_far| if *is_far { Letter::Far } else { Letter::Near }).collect()
    }

    /// The bits used, the box, and the shot over the box, for a box that is `inside` bits narrower than the claimed bounds.
    fn judged_inside(
        &self,
        setting: &Setting,
        range: &mut Range<'_>,
        inside: i64,
    ) -> Result<(u32, Unknowns, Shot), Doubt> {
        let widths = [&self.unstable, &self.stable, &self.parameter].map(|[low, high]| high - low);
        let widths = widths.map(|width| Real::rational(&width, 64).enclosure().mag().top());
        let narrowest = widths.into_iter().map(|top| top.ok_or_else(|| Doubt::open("the bounds have no width")));
        let narrowest = narrowest.collect::<Result<Vec<_>, _>>()?.into_iter().fold(0, i64::min); // proposes: a size
        let bits = SPARE_BITS + inside - narrowest;
        let bits = u32::try_from(bits.min(MAX_BITS + 1)).ok().filter(|bits| i64::from(*bits) <= MAX_BITS); // proposes
        let bits = bits.ok_or_else(|| Doubt::open("the bounds are too narrow"))?;
        let family = setting.family(bits);
        let claimed = self.claimed(setting, bits)?;
        let law = known(family.law_over(&claimed[2]))?;
        self.is_saddle(&law)?;
        self.compare_saddle(&law, range)?;
        let (at, here) = polished(range, &family, &claimed, narrowest - inside - 8).or_else(|doubt| {
            // There is no tangency near the bounds, and perhaps none in them.
            self.none(range, &family, &claimed).and(Err(unproved(doubt)))
        })?;
        let small = [0, 1, 2].map(|i| {
            let mut width = claimed[i].clone() - &claimed[i].middle();
            (0..inside).for_each(|_| width = width.half());
            at[i].clone() + &Real::within(&width.enclosure().mag(), bits)
        });
        let is_in = |i: usize| claimed[i].enclosure().contains_enclosure(small[i].enclosure());
        if !(0..3).all(is_in) {
            self.none(range, &family, &claimed)?;
            return Err(Doubt::open("the tangency that is found is not proved to be inside the bounds"));
        }
        let over = range.shot(&family, &small).map_err(unproved)?;
        if !matches!(zeros(&small, (&at, &here), &over), Zeros::One) {
            return Err(Doubt::open("a tangency is not proved to exist"));
        }
        let whole = range.shot(&family, &claimed)?;
        if !matches!(zeros(&claimed, (&at, &here), &whole), Zeros::One | Zeros::AtMostOne) {
            return Err(Doubt::open("the bounds are too wide to prove that there is only one tangency"));
        }
        self.compare(setting, &small, &over)?;
        Ok((bits, small, over))
    }

    /// The claimed values of the three unknowns.
    fn claimed(&self, setting: &Setting, bits: u32) -> Result<Unknowns, Doubt> {
        let all = |bounds: &Bounds| hull(&bounds.each_ref().map(|bound| Real::rational(bound, bits)));
        Ok([all(&self.unstable), all(&self.stable), setting.reduced(&all(&self.parameter))?])
    }

    /// Refutes the claim where no value of the bounds is a tangency.
    fn none(&self, range: &mut Range<'_>, family: &Family, claimed: &Unknowns) -> Result<(), Doubt> {
        let middle = claimed.clone().map(|x| x.middle());
        let over = range.shot(family, claimed)?;
        let here = range.shot(family, &middle).map_err(unproved)?;
        match zeros(claimed, (&middle, &here), &over) {
            Zeros::None => Err(Doubt::False("there is no tangency within the bounds".into())),
            _ => Ok(()),
        }
    }

    /// Proves that the only fixed point with the claimed phase, for these parameters, is the equispaced orbit with `N = 1`: a fixed point has
    /// `D = N pi kappa cos(theta) + 2 sin(theta)` with an odd `N` (Lemma V17).
    fn is_saddle(&self, law: &Law) -> Result<(), Doubt> {
        let phase = hull(&self.phase.each_ref().map(|bound| Real::rational(bound, law.bits())));
        let (s, c) = phase.sin_cos();
        let pi_kappa = law.pi_kappa().ok_or_else(|| Doubt::open("a coefficient of restitution below 1 is needed"))?;
        let periods = (law.gap_hull() - &(s * 2)).over(&(pi_kappa * &c));
        let Some(periods) = periods.filter(|x| x.enclosure().wid().top().is_none_or(|top| top <= 0)) else {
            return Err(Doubt::open("the bounds of the saddle are too wide"));
        };
        let near = periods.to_f64() as i64; // V17: a width of at most 1, so within 3 of all odd numbers that it may be
        let may_be = |n: &i64| *n > 0 && n % 2 == 1 && !periods.is_apart_from(&Real::int(*n, law.bits()));
        match (near - 3..=near + 3).filter(may_be).collect::<Vec<_>>()[..] {
            [] => Err(Doubt::False("no fixed point has this phase".into())),
            [1] => Ok(()),
            _ => Err(Doubt::open(
                "the saddle is not proved to be the equispaced orbit of N = 1; no other one is checked",
            )),
        }
    }

    /// Proves the claims about the saddle and its eigenvalues for all values of the parameter. Lemma V17
    fn compare_saddle(&self, law: &Law, range: &Range<'_>) -> Result<(), Doubt> {
        let saddle = range.saddle(law)?;
        let bits = law.bits();
        let phase = saddle.phase.value(bits).hull();
        let speed = law.speed(&phase).ok_or_else(|| Doubt::open("a coefficient of restitution below 1 is needed"))?;
        let [unstable, stable] = [&saddle.unstable, &saddle.stable].map(|x| x.value(bits).hull());
        let found = [
            ("phase of the saddle", &(phase.clone() + &self.turns(law, &phase)), &self.phase),
            ("speed", &speed, &self.speed),
            ("unstable eigenvalue", &unstable, &self.eigenvalues[0]),
            ("stable eigenvalue", &stable, &self.eigenvalues[1]),
        ];
        for (what, found, claimed) in found {
            if let SetPosition::Outside = beside(found, claimed) {
                compare(what, found, claimed)?;
            }
        }
        no_resonance([&unstable, &stable], self.resonances)
    }

    /// The whole forcing periods between a phase and the claimed phase.
    fn turns(&self, law: &Law, phase: &Real) -> Real {
        let off = Real::rational(&self.phase[0], law.bits()) - phase;
        let turns = (off.to_f64() / std::f64::consts::TAU).round() as i64; // proposes: a whole number
        law.pi.clone() * 2 * turns
    }

    /// Proves that all numbers of the tangency in a box are as claimed.
    fn compare(&self, setting: &Setting, found: &Unknowns, shot: &Shot) -> Result<(), Doubt> {
        let bits = found[2].bits();
        let law = known(setting.family(bits).law_over(&found[2]))?;
        let parameter =
            setting.parameter(&found[2]).ok_or_else(|| Doubt::open("the parameter is not proved to be positive"))?;
        compare("parameter", &parameter, &self.parameter)?;
        compare("parameter of the unstable manifold", &found[0], &self.unstable)?;
        compare("parameter of the stable manifold", &found[1], &self.stable)?;
        self.compare_fixed_point(&law, &shot.saddle)?;
        let [quadratic, unfolding] =
            shot.tangency().ok_or_else(|| Doubt::open("the tangent of the stable manifold may be 0"))?;
        self.compare_unfolding([&quadratic, &unfolding])?;
        at_least("speed", shot.all_speeds(), &self.least_speed)?;
        at_least("flight", shot.all_times(), &self.least_flight)
    }

    /// Proves the claims about the saddle's state; returns its eigenvalues.
    fn compare_fixed_point(&self, law: &Law, saddle: &Saddle) -> Result<[Real; 2], Doubt> {
        let bits = law.bits();
        let phase = saddle.phase.value(bits).hull();
        compare("phase of the saddle", &(phase.clone() + &self.turns(law, &phase)), &self.phase)?;
        let speed = law.speed(&phase).ok_or_else(|| Doubt::open("a coefficient of restitution below 1 is needed"))?;
        compare("speed of the saddle", &speed, &self.speed)?;
        let eigenvalues = [&saddle.unstable, &saddle.stable].map(|x| x.value(bits).hull());
        compare("unstable eigenvalue", &eigenvalues[0], &self.eigenvalues[0])?;
        compare("stable eigenvalue", &eigenvalues[1], &self.eigenvalues[1])?;
        Ok(eigenvalues)
    }

    /// Proves that `q` and `m` are as claimed, and not 0.
    fn compare_unfolding(&self, [quadratic, unfolding]: [&Real; 2]) -> Result<(), Doubt> {
        for (what, found, claimed) in
            [("quadratic coefficient", quadratic, &self.quadratic), ("speed of unfolding", unfolding, &self.unfolding)]
        {
            if found.is_across() {
                return Err(Doubt::Open(format!("the {what} may be 0")));
            }
            compare(what, found, claimed)?;
        }
        Ok(())
    }

    /// Proves that two common points are on the side of `(D - D*) q/m < 0`, and that neither range holds the tangency. Lemma V21
    fn compare_sides(&self, setting: &Setting, [two, none]: [&Bounds; 2]) -> Result<(), Doubt> {
        let is_positive = |[low, _]: &Bounds| low.is_positive();
        let is_alike = is_positive(&self.quadratic) == is_positive(&self.unfolding);
        let is_below = is_alike != setting.is_falling();
        let (lower, upper) = if is_below { (two, none) } else { (none, two) };
        let is_range = |[low, high]: &Bounds| low < high;
        if is_range(two) && is_range(none) && lower[1] < self.parameter[0] && self.parameter[1] < upper[0] {
            return Ok(());
        }
        Err(Doubt::open("the ranges beside the tangency are not on the sides that its unfolding has"))
    }
}

/// Turns a refutation for only some values of the bounds into an undecided claim.
fn unproved(doubt: Doubt) -> Doubt {
    match doubt {
        Doubt::False(message) | Doubt::Open(message) => Doubt::Open(message),
    }
}

/// Proves that all quantities are at least the claimed bound.
fn at_least(what: &str, found: &[Real], claimed: &BigRational) -> Result<(), Doubt> {
    for (k, found) in found.iter().enumerate() {
        if compare_rational(found.enclosure().sup(), claimed).is_lt() {
            return Err(Doubt::False(format!("the {what} number {k} of the orbit is less than the least one")));
        }
        if compare_rational(found.enclosure().inf(), claimed).is_lt() {
            return Err(Doubt::Open(format!("the {what} number {k} of the orbit is not proved to be as large")));
        }
    }
    Ok(())
}

/// Proves that no product of powers of the eigenvalues, of an order from 2 to `highest`, is an eigenvalue.
fn no_resonance(eigenvalues: [&Real; 2], highest: u32) -> Result<(), Doubt> {
    if highest > MAX_RESONANCE_ORDER {
        return Err(Doubt::Open(format!("resonances of orders above {MAX_RESONANCE_ORDER} are not checked")));
    }
    let powers = eigenvalues.map(|x| {
        let one = Real::int(1, x.bits());
        (0..highest).fold(vec![one], |mut all, _| {
            all.push(all[all.len() - 1].clone() * x);
            all
        })
    });
    // exact: a count
    for order in 2..=highest as usize {
        for j in 0..=order {
            let product = powers[0][j].clone() * &powers[1][order - j];
            if eigenvalues.iter().any(|x| !product.is_apart_from(x)) {
                return Err(Doubt::Open(format!("a resonance of order {order} is not excluded")));
            }
        }
    }
    Ok(())
}
