//! The exact data of a problem, and the motions for them at a given number of bits.

use std::cmp::Ordering;

use crate::Error;
use crate::exact::{Exact, ExactError};
use crate::pair::ImpactPair;

use super::closed_forms;
use super::elastic;
use super::equispaced::{self, Orders, Solutions};
use super::motion::{Motion, Parameters};
use super::unequispaced::Spacing;
use crate::exact::Real;
use crate::units::ratio;
use crate::watch::Watch;

/// A pair and a number of cycles.
#[derive(Clone, Debug)]
pub(super) struct Data {
    pair: ImpactPair,
    cycles: u32,
    is_elastic: bool,
}

/// Motions with their amplitudes \[length\], and undecided parts of `th1 - th0`.
pub(super) struct Found {
    pub motions: Vec<(Motion, Real)>,
    pub doubts: Vec<Real>,
}

impl Found {
    fn none() -> Self {
        Self { motions: Vec::new(), doubts: Vec::new() }
    }
}

impl Data {
    /// # Errors
    /// If e is neither 1 nor proved to be below 1, or `d/A` beyond the range of exact expressions.
    pub fn new(pair: &ImpactPair, cycles: u32) -> Result<Self, Error> {
        let e = pair.restitution();
        let is_elastic = match e.compare(&Exact::from(1)) {
            Some(Ordering::Less) => false,
            Some(Ordering::Equal) => true,
            _ => return Err(Error::range("pair.restitution", e, "must be 1, or proved to be below 1")),
        };
        let data = Self { pair: pair.clone(), cycles, is_elastic };
        if pair.excitation().reference().amplitude().sign() == Some(Ordering::Greater) {
            ratio(pair)?;
        }
        Ok(data)
    }

    pub fn pair(&self) -> &ImpactPair {
        &self.pair
    }

    pub fn cycles(&self) -> u32 {
        self.cycles
    }

    pub fn frequency(&self) -> &Exact {
        self.pair.excitation().reference().frequency()
    }

    pub fn is_elastic(&self) -> bool {
        self.is_elastic
    }

    fn is_odd(&self) -> bool {
        self.cycles % 2 == 1
    }

    /// `N pi (1 + e)`
    fn travel(&self) -> Result<Exact, ExactError> {
        let period = Exact::pi().checked_mul(&Exact::from(i64::from(self.cycles)))?;
        self.pair.restitution().checked_add(&Exact::from(1))?.checked_mul(&period)
    }

    /// Exact orders of `g` and 2, and of `g` and `K`.
    fn orders(&self, ratio: &Exact) -> Orders {
        let slope = || {
            let below = Exact::from(1).checked_sub(self.pair.restitution())?;
            self.travel()?.checked_div(&below)
        };
        let rise = slope().ok().and_then(|slope| ratio.compare(&slope));
        Orders { room: Exact::from(2).compare(ratio), rise }
    }

    fn parameters(&self, ratio: Real) -> Parameters {
        let e = self.pair.restitution();
        let is_dead = e.sign() == Some(Ordering::Equal);
        Parameters { cycles: self.cycles, restitution: Real::of(e, ratio.bits()), ratio, is_dead }
    }

    /// All motions for `A` and `d`, until the watch stops the search.
    pub fn motions(&self, bits: u32, watch: &dyn Watch) -> Found {
        let exact = ratio(&self.pair).expect("proved to exist by `new`");
        let parameters = self.parameters(Real::of(&exact, bits));
        let orders = self.orders(&exact);
        let (mut motions, mut doubts) = match (self.is_elastic, self.is_odd()) {
            (true, _) => elastic::solve(&parameters),
            (false, true) => match equispaced::solve(&parameters, orders) {
                Some(Solutions { motions, is_doubtful: false }) => (motions, Vec::new()),
                Some(Solutions { motions, is_doubtful: true }) => (motions, vec![parameters.half_period()]),
                None => (Vec::new(), vec![parameters.half_period()]),
            },
            // (65)
            (false, false) => (Vec::new(), Vec::new()),
        };
        let (others, open) = Spacing::new(&parameters, orders.room).solve(watch);
        motions.extend(others);
        doubts.extend(open);
        let amplitude = Real::of(self.pair.excitation().reference().amplitude(), bits);
        Found { motions: motions.into_iter().map(|motion| (motion, amplitude.clone())).collect(), doubts }
    }

    /// `|v|/W` \[length\]
    fn length(&self, speed: &Exact, bits: u32) -> Real {
        Real::of(speed, bits).over(&Real::of(self.frequency(), bits)).expect("W > 0")
    }

    /// Equispaced motion for `d` and `|v|`, with its `A_N` (68); none for N even, where e < 1 (65).
    pub fn with_amplitude(&self, speed: &Exact, bits: u32) -> Found {
        if !self.is_odd() {
            return Found::none();
        }
        let (length, gap) = (self.length(speed, bits), Real::of(self.pair.gap(), bits));
        let e = Real::of(self.pair.restitution(), bits);
        let (mut sin, cos) = closed_forms::vector(&gap, self.cycles, &e, &length);
        if self.is_level(speed) {
            sin = Real::int(0, bits);
        }
        let amplitude = closed_forms::amplitude(&(sin.clone(), cos.clone()));
        let motion = || {
            let part = |x: &Real| x.over(&amplitude);
            let parameters = self.parameters(part(&gap)?);
            Motion::symmetric(parameters, (part(&sin)?, part(&cos)?), part(&length)?)
        };
        match motion() {
            Some(motion) => Found { motions: vec![(motion, amplitude)], doubts: Vec::new() },
            // Without excitation there is no motion of this kind.
            None if amplitude.sign() == Some(Ordering::Equal) => Found::none(),
            None => Found { doubts: vec![Real::pi(bits) * i64::from(self.cycles)], ..Found::none() },
        }
    }

    /// Whether `sin th0 = 0` exactly, by (67): `2 d W = (1 + e) N pi |v|`.
    fn is_level(&self, speed: &Exact) -> bool {
        let sides = || {
            let gap = self.pair.gap().checked_mul(self.frequency())?.checked_mul(&Exact::from(2))?;
            Ok::<_, ExactError>((gap, self.travel()?.checked_mul(speed)?))
        };
        sides().is_ok_and(|(gap, travel)| gap.compare(&travel) == Some(Ordering::Equal))
    }

    /// Equispaced motions for `A` and `|v|`, each with its `d` (67); none for N even, where e < 1 (65).
    pub fn with_gaps(&self, speed: &Exact, bits: u32) -> Found {
        let length = self.length(speed, bits);
        let amplitude = Real::of(self.pair.excitation().reference().amplitude(), bits);
        if !self.is_odd() {
            return if self.is_elastic { self.with_even_gap(&length, &amplitude) } else { Found::none() };
        }
        let e = Real::of(self.pair.restitution(), bits);
        let zero = Real::int(0, bits);
        let cos = ((Real::int(1, bits) - &e) * &length).half().over(&amplitude).expect("A > 0");
        let room = Real::int(1, bits) - cos.square();
        let sines = match self.speed_order(speed) {
            Some(Ordering::Greater) => Vec::new(),
            Some(Ordering::Equal) => vec![zero],
            Some(Ordering::Less) if room.is_positive() => {
                let sin = room.sqrt().expect("positive");
                vec![-&sin, sin]
            }
            _ => return Found { doubts: vec![Real::pi(bits) * i64::from(self.cycles)], ..Found::none() },
        };
        let mut found = Found::none();
        for sin in sines {
            let gap = closed_forms::gap(&(&sin * &amplitude), self.cycles, &e, &length);
            if gap.is_negative() {
                continue;
            }
            let motion = || {
                let parameters = self.parameters(gap.over(&amplitude)?);
                let motion = Motion::symmetric(parameters, (sin, cos.clone()), length.over(&amplitude)?)?;
                gap.is_positive().then_some(motion)
            };
            match motion() {
                Some(motion) => found.motions.push((motion, amplitude.clone())),
                None => found.doubts.push(Real::pi(bits) * i64::from(self.cycles)),
            }
        }
        found
    }

    /// The two equispaced motions of N even for e = 1: `d = N pi |v|/W`, whatever `A` is. Lemma W7 (b)
    fn with_even_gap(&self, length: &Real, amplitude: &Real) -> Found {
        let cycles = i64::from(self.cycles);
        let gap = Real::pi(length.bits()) * cycles * length;
        let motions = gap.over(amplitude).and_then(|ratio| elastic::whole_turns(&self.parameters(ratio), cycles / 2));
        match motions {
            Some(motions) => {
                let motions = motions.into_iter().map(|motion| (motion, amplitude.clone())).collect();
                Found { motions, doubts: Vec::new() }
            }
            None => Found { doubts: vec![Real::pi(length.bits()) * cycles], ..Found::none() },
        }
    }

    /// Order of `(1 - e)|v|` and `2 A W`: that of `cos th0` and 1, (66).
    fn speed_order(&self, speed: &Exact) -> Option<Ordering> {
        let sides = || {
            let below = Exact::from(1).checked_sub(self.pair.restitution())?.checked_mul(speed)?;
            let most = self
                .pair
                .excitation()
                .reference()
                .amplitude()
                .checked_mul(self.frequency())?
                .checked_mul(&Exact::from(2))?;
            Ok::<_, ExactError>((below, most))
        };
        let (below, most) = sides().ok()?;
        below.compare(&most)
    }
}
