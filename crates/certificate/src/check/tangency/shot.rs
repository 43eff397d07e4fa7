//! Single shooting from the unstable manifold along the word to the stable manifold, for all values of a box (Lemma V19).

use super::flights::{Launch, Letter, across, fly, guess};
use super::jet::{self, scaled};
use super::local::{Domain, PARAMETER_RADIUS_EXPONENT, Side};
use super::saddle::{Family, Law, Saddle};
use super::series::{Series, State};
use crate::check::affine::Affine;
use crate::check::budget::Budget;
use crate::check::contact::Doubt;
use impact_pair_exact::{Dyadic, Real};

/// `sigma_u`, `sigma_s`, and the parameter, `D` or `e`
pub(super) type Unknowns = [Real; 3];

/// Data that do not depend on the box: the domains of the manifolds, the word, and approximate durations of its flights.
pub(super) struct Range<'b> {
    pub letters: Vec<Letter>,
    pub budget: Budget<'b>,
    /// A phase near the phase of the saddle.
    pub near: Real,
    guesses: Vec<Real>,
    /// A real value of the parameter, and the domains of both manifolds around it.
    around: Option<(Real, [Domain; 2])>,
}

/// The result over a box.
pub(super) struct Shot {
    pub saddle: Saddle,
    /// `F^n P_u` and `P_s`.
    pub ends: [State; 2],
    /// The states before all impacts of the word, from the state of `P_u` on.
    pub states: Vec<[Real; 2]>,
    /// The speeds of these states and of the states near the saddle.
    speeds: Vec<Real>,
    /// The durations of all flights, including flights near the saddle.
    times: Vec<Real>,
    bits: u32,
}

/// The data, if they are proved to be admissible.
pub(super) fn known(law: Option<Law>) -> Result<Law, Doubt> {
    law.ok_or_else(|| Doubt::open("a coefficient of restitution between 0 and 1 and a positive gap are needed"))
}

impl<'b> Range<'b> {
    pub fn new(letters: Vec<Letter>, near: Real, budget: Budget<'b>) -> Self {
        Self { letters, budget, near, guesses: Vec::new(), around: None }
    }

    /// The saddle for all values of the parameter.
    pub fn saddle(&self, law: &Law) -> Result<Saddle, Doubt> {
        law.saddle(&self.near.at(law.bits()))
            .ok_or_else(|| Doubt::open("the equispaced orbit is not proved to be a saddle for this parameter"))
    }

    /// Domains in which the manifolds are proved to be analytic, once for all values of the parameter near the first value. Lemma V18
    fn domains(&mut self, family: &Family, parameter: &Real) -> Result<[Domain; 2], Doubt> {
        let bits = family.bits();
        if self.around.is_none() {
            let middle = parameter.middle();
            self.around = Some((middle.clone(), self.domains_over(family, &middle)?));
        }
        let (middle, domains) = self.around.as_ref().expect("it is proved above");
        let off = Real::point((parameter.clone() - middle).enclosure().mag(), bits);
        let half = Real::point(Dyadic::power_of_two(PARAMETER_RADIUS_EXPONENT - 1), bits);
        if off.is_below(&half) {
            Ok(domains.clone())
        } else {
            Err(Doubt::open("the bounds of the parameter are too wide"))
        }
    }

    /// Domains in which the manifolds are proved to be analytic for all given values of the parameter, each with a complex disc. Lemma V18
    pub fn domains_over(&self, family: &Family, parameter: &Real) -> Result<[Domain; 2], Doubt> {
        let law = known(family.law_over(parameter))?;
        let own = self.saddle(&law)?;
        let [phase, unstable, stable] = [&own.phase, &own.unstable, &own.stable].map(|x| x.value(law.bits()).hull());
        let real = [&law.gap_hull(), &law.e_hull(), &phase, &unstable, &stable];
        let domain = |side| {
            Domain::new(real, family.is_restitution, side)
                .ok_or_else(|| Doubt::open("the invariant manifolds are not proved to be analytic near the saddle"))
        };
        Ok([domain(Side::Unstable)?, domain(Side::Stable)?])
    }

    /// The orbits of all values of a box; derivatives are enclosed over the box, values around its middle.
    pub fn shot(&mut self, family: &Family, box_: &Unknowns) -> Result<Shot, Doubt> {
        let bits = family.bits();
        // Most quantities depend on the parameter alone: it is the first deviation.
        let varied = |j: usize| {
            let middle = box_[j].middle();
            let off = (box_[j].clone() - &middle).enclosure().mag();
            if off.is_zero() { Affine::fixed(middle) } else { Affine::varied(middle, off, 2 - j) }
        };
        let [u, s, d] = [0, 1, 2].map(varied);
        let domains = self.domains(family, &d.hull())?;
        let law = &known(family.law(&d))?;
        let saddle = self.saddle(law)?;
        let manifold = |side, domain: &Domain, sigma: &Affine| {
            let most = Real::point(sigma.hull().enclosure().mag(), bits);
            let series = Series::new(law, &saddle, (side, domain.clone()), &most);
            let found = series.and_then(|series| Some((series.at(law, sigma)?, series)));
            found.ok_or_else(|| Doubt::open("the parameter of an invariant manifold is too far from the saddle"))
        };
        let (mut state, unstable) = manifold(Side::Unstable, &domains[0], &u)?;
        let (end, stable) = manifold(Side::Stable, &domains[1], &s)?;
        let passed = |state: &State| [&state.phase, &state.speed].map(|x| x.value(bits).hull());
        let (mut states, mut times) = (vec![passed(&state)], Vec::new());
        for (k, letter) in self.letters.iter().enumerate() {
            if self.guesses.len() == k {
                let middle = [&state.phase, &state.speed].map(|x| x.value(bits).centre.to_f64());
                self.guesses.push(guess([&law.gap, &law.e].map(|x| x.value(bits).centre.to_f64()), middle));
            }
            let at = |doubt| match doubt {
                Doubt::False(message) => Doubt::False(format!("flight {}: {message}", k + 1)),
                Doubt::Open(message) => Doubt::Open(format!("flight {}: {message}", k + 1)),
            };
            let flown = fly(law, &state, (*letter, &self.guesses[k]), &self.budget).map_err(at)?;
            self.budget.allow(bits, 1);
            state = flown.state;
            states.push(passed(&state));
            times.push(flown.time);
        }
        let mut speeds: Vec<Real> = states.iter().map(|[_, speed]| speed.clone()).collect();
        for (series, sigma) in [(&unstable, &u), (&stable, &s)] {
            let most = Real::point(sigma.hull().enclosure().mag(), bits);
            let [speed, time] = self.flies_near(law, &saddle, series, &most)?;
            speeds.push(speed);
            times.push(time);
        }
        Ok(Shot { saddle, ends: [state, end], states, speeds, times, bits })
    }

    /// Proves that flights from the local manifold end at the impacts of the invariance equation: the first contact is with the
    /// far wall, and no other contact comes before that impact; returns the flights' speeds and durations. Lemma V19
    pub fn flies_near(&self, law: &Law, saddle: &Saddle, series: &Series, most: &Real) -> Result<[Real; 2], Doubt> {
        let (bits, lost) =
            (law.bits(), || Doubt::open("the flights near the saddle are not proved to be first contacts"));
        let off = series.deviation(most).ok_or_else(lost)?;
        let (d, e) = (law.gap_hull(), law.e_hull());
        let centre = saddle.phase.value(bits).hull();
        let phase = centre.clone() + &Real::within(off.enclosure().sup(), bits);
        // Both ends of each flight are phases of the local manifold.
        let time = law.pi.clone() + &(phase.clone() - &phase);
        let slope = (d.clone() - &(phase.sin() * 2)).over(&time).ok_or_else(lost)?;
        let speed = (slope - &phase.cos()).over(&e).ok_or_else(lost)?;
        let launch = Launch::new([&d, &e], [&phase, &speed], &self.budget);
        let contact = launch.first(Letter::Far, &law.pi).map_err(|_| lost())?;
        if launch.is_only(&contact, &time) { Ok([speed, time]) } else { Err(lost()) }
    }
}

/// The coefficient of a power, for both components of a state.
fn part(state: &State, power: usize, bits: u32) -> [Affine; 2] {
    [&state.phase, &state.speed].map(|x| x.at(power, bits))
}

/// The determinant of two vectors.
fn determinant(a: &[Affine; 2], b: &[Affine; 2]) -> Affine {
    across(a.each_ref(), b.each_ref())
}

impl Shot {
    /// The speeds before all impacts of the orbit.
    pub fn all_speeds(&self) -> &[Real] {
        &self.speeds
    }

    /// The durations of all flights of the orbit \[rad\].
    pub fn all_times(&self) -> &[Real] {
        &self.times
    }

    fn parts(&self, power: usize) -> [[Affine; 2]; 2] {
        self.ends.each_ref().map(|state| part(state, power, self.bits))
    }

    /// The difference of both ends, without whole periods of the phase, and the determinant of both tangents.
    pub fn residual(&self) -> [Real; 3] {
        let [flown, end] = self.parts(jet::ONE);
        let [theta, w] = [0, 1].map(|i| flown[i].hull() - &end[i].hull());
        let turn = Real::pi(self.bits) * 2;
        let turns = (theta.to_f64() / std::f64::consts::TAU).round() as i64; // proposes: a whole number
        let [one, other] = self.parts(jet::X);
        [theta - &(turn * turns), w, determinant(&one, &other).hull()]
    }

    /// The derivatives of the residual by the unknowns.
    pub fn slopes(&self) -> [[Real; 3]; 3] {
        let two = Real::int(2, self.bits);
        let ([flown_x, end_x], [flown_d, end_d]) = (self.parts(jet::X), self.parts(jet::D));
        let ([flown_xx, end_xx], [flown_xd, end_xd]) = (self.parts(jet::XX), self.parts(jet::XD));
        let row = |i: usize| [flown_x[i].hull(), -end_x[i].hull(), flown_d[i].hull() - &end_d[i].hull()];
        let twice = |x: Affine| scaled(&x, &two).hull();
        let by_parameter = determinant(&flown_xd, &end_x).hull() + &determinant(&flown_x, &end_xd).hull();
        let tangents = [twice(determinant(&flown_xx, &end_x)), twice(determinant(&flown_x, &end_xx)), by_parameter];
        [row(0), row(1), tangents]
    }

    /// `q = det(t, Phi_uu - a^2 P_s'')` and `m = det(t, Phi_D - P_s,D)` with `t = P_s'/abs(P_s')`, `Phi_u = a P_s'`; `None` where `P_s'`
    /// may be 0.
    pub fn tangency(&self) -> Option<[Real; 2]> {
        let two = Real::int(2, self.bits);
        let hulls = |power: usize| self.parts(power).map(|pair| pair.map(|x| x.hull()));
        let ([flown_x, end_x], [flown_d, end_d]) = (hulls(jet::X), hulls(jet::D));
        let [flown_xx, end_xx] = hulls(jet::XX).map(|pair| pair.map(|x| x * &two));
        unfolding([&flown_x, &end_x], [&flown_xx, &end_xx], [&flown_d, &end_d])
    }
}

/// `q` and `m` from the first and second derivatives of `Phi` and `P_s` by their own parameters, and the derivatives of these by `D`; `None`
/// where `P_s'` may be 0.
pub(super) fn unfolding(
    [flown, end]: [&[Real; 2]; 2],
    [bent, end_bent]: [&[Real; 2]; 2],
    [moved, end_moved]: [&[Real; 2]; 2],
) -> Option<[Real; 2]> {
    let square = end[0].square() + &end[1].square();
    let along = flown[0].clone() * &end[0] + &(flown[1].clone() * &end[1]);
    let factor = along.over(&square)?.square();
    let size = square.sqrt()?;
    let off = |vector: [Real; 2]| (end[0].clone() * &vector[1] - &(end[1].clone() * &vector[0])).over(&size);
    let curved = [0, 1].map(|i| bent[i].clone() - &(end_bent[i].clone() * &factor));
    Some([off(curved)?, off([0, 1].map(|i| moved[i].clone() - &end_moved[i]))?])
}
