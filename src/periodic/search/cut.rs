//! Contraction of a box of phases to the phases of orbits: Lemma T9.

use std::ops::Range;

use crate::number::Ball;
use crate::number::interval::Interval;
use crate::pair::Reduced;
use crate::pair::Wall;
use crate::periodic::chain::Chain;
use crate::periodic::chained::Rate;

/// Consecutive flights of a chain and impacts between them: each impact lies between two flights that are known.
#[derive(Clone, Debug)]
pub(super) struct Stretch {
    pub flights: Range<usize>,
    pub impacts: Range<usize>,
}

/// The word, the parameters and the bounds of Lemma T8.
#[derive(Clone, Debug)]
pub(super) struct Terms<'c> {
    pub chain: &'c Chain,
    /// `beta`, of several harmonics their sum.
    beta: Interval,
    /// The fastest first.
    harmonics: Vec<Harmonic>,
    pub restitution: Interval,
    /// `1 + e`
    lossy: Interval,
    /// `|c|` is at most this.
    drift: f64,
    /// The least time of a crossing.
    crossing: f64,
}

/// A harmonic of the excitation. Lemma H14
#[derive(Clone, Copy, Debug)]
struct Harmonic {
    beta: Interval,
    /// `(1 + e) 2 pi r beta`
    acceleration: Interval,
    /// `r` and `s`: the harmonic's phase is `r u + s`; `None` for the harmonic whose periods are the forcing periods.
    own: Option<[Interval; 2]>,
}

impl Harmonic {
    fn new(Rate { beta, own }: Rate, lossy: Interval) -> Self {
        let beta = Interval::from(beta);
        let beta = Interval::new(beta.inf().max(0.0), beta.sup()); // exact: not negative
        let own = own.map(|own| own.map(Interval::from));
        let harmonic = Self { beta, acceleration: (Interval::PI * beta * lossy).scaled(2.0), own };
        Self { acceleration: harmonic.rate(harmonic.acceleration), ..harmonic }
    }

    /// Phase of the harmonic.
    fn phase(&self, phase: Interval) -> Interval {
        self.own.map_or(phase, |[ratio, shift]| ratio * phase + shift)
    }

    /// Converts a number of forcing periods, or a rate in them, into the harmonic's own periods.
    fn rate(&self, time: Interval) -> Interval {
        self.own.map_or(time, |[ratio, _]| {
            let own = ratio * time;
            // H14: of numbers that are not negative
            if time.inf() >= 0.0 { Interval::new(own.inf().max(0.0), own.sup()) } else { own }
        })
    }

    /// Velocity of the harmonic.
    fn speed(&self, phase: Interval) -> Interval {
        self.beta * self.phase(phase).cos()
    }

    /// Mean velocity of the harmonic over a time around a phase.
    fn mean(&self, time: Interval, middle: Interval) -> Interval {
        self.beta * self.rate(time).sinc() * self.phase(middle).cos()
    }

    /// Terms of the harmonic in `-w/h` and `-v/h` of a hop. Lemma T9
    fn hop(&self, time: Interval, middle: Interval) -> [Interval; 2] {
        let (time, middle) = (self.rate(time), self.phase(middle));
        let quarter = time.scaled(0.25);
        let bend = time.bend() * middle.cos();
        let acceleration = |at: Interval| Interval::PI * time.scaled(0.5).sinc() * at.sin();
        [bend + acceleration(middle - quarter), bend - acceleration(middle + quarter)].map(|x| self.rate(self.beta) * x)
    }
}

/// A box of phases, with bounds of its flights and impacts.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub phases: Vec<Interval>,
    /// Time and drift of each flight.
    pub times: Vec<Interval>,
    pub drifts: Vec<Interval>,
    /// The velocity of the box at each impact.
    pub speeds: Vec<Interval>,
}

/// All numbers.
const ALL: Interval = Interval::new(f64::MIN, f64::MAX);
/// Fractions of a flight at which the ball has to be in the gap.
const FLIGHT_FRACTIONS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// Least relative gain of a pass for another pass to be made.
const MIN_GAIN: f64 = 0.1;

impl<'c> Terms<'c> {
    pub fn new(chain: &'c Chain, pair: &Reduced<Ball>, rates: Vec<Rate>) -> Self {
        let [alpha, beta, restitution] = [pair.alpha, pair.beta, pair.restitution].map(Interval::from);
        let one = Interval::ONE;
        // exact: neither is negative
        let (alpha, beta) =
            (Interval::new(alpha.inf().max(0.0), alpha.sup()), Interval::new(beta.inf().max(0.0), beta.sup()));
        let restitution = Interval::new(restitution.inf().max(0.0), restitution.sup().min(1.0)); // exact: from 0 to 1
        let lossy = one + restitution;
        // Lemma T8.
        let impacts = Interval::point(chain.impacts() as f64);
        let cycles = Interval::point(f64::from(chain.cycles()));
        let longest = (one + alpha.scaled(2.0)) * impacts;
        let longest = longest.checked_div(cycles).map_or(f64::MAX, |drift| drift.sup());
        let kicks = (lossy * (impacts - one) * beta).sup();
        let general = (Interval::point(longest) + Interval::point(kicks)).sup();
        let lost = (lossy * beta).checked_div(one - restitution).map_or(f64::MAX, |drift| drift.sup());
        let drift = general.min(lost); // T8: the smaller of two bounds
        let crossing = one.checked_div(Interval::point(drift) + beta).map_or(f64::MAX, |time| time.inf());
        let harmonics = rates.into_iter().map(|rate| Harmonic::new(rate, lossy)).collect();
        Self { chain, beta, harmonics, restitution, lossy, drift, crossing }
    }

    /// Width of intervals among the parameters, relative to `A/d`: much narrower boxes add nothing.
    pub fn spread(&self) -> f64 {
        let relative = self.beta.wid() / self.beta.sup().max(f64::MIN_POSITIVE); // proposes: when to stop
        relative.max(self.restitution.wid()) // proposes
    }

    /// Sum of a function over all harmonics; `None` if there are none.
    fn sum(harmonics: &[Harmonic], of: impl Fn(&Harmonic) -> Interval) -> Option<Interval> {
        harmonics.iter().map(of).reduce(|a, b| a + b)
    }

    /// Velocity of the box over these phases.
    pub fn speed(&self, phase: Interval) -> Interval {
        Self::sum(&self.harmonics, |harmonic| harmonic.speed(phase)).expect("a harmonic")
    }

    /// `(1 + e) S` over these phases.
    pub fn acceleration(&self, phase: Interval) -> Interval {
        Self::sum(&self.harmonics, |harmonic| harmonic.acceleration * harmonic.phase(phase).sin()).expect("a harmonic")
    }

    /// The mean velocity of the box over a time around a phase.
    fn mean(&self, time: Interval, middle: Interval) -> Interval {
        Self::sum(&self.harmonics, |harmonic| harmonic.mean(time, middle)).expect("a harmonic")
    }

    /// All flights and impacts of the chain.
    pub fn whole(&self) -> Stretch {
        let count = self.chain.impacts();
        Stretch { flights: 0..count, impacts: 0..count }
    }

    /// Part of the state space with the first impact in `first`. T8
    pub fn all(&self, first: Interval) -> Part {
        let count = self.chain.impacts();
        let reach = f64::from(self.chain.period()) + f64::from(self.chain.cycles());
        // T10: no orbit has a phase that is an end of these bounds.
        let rest = Interval::new(first.inf().next_down(), reach.next_up());
        Part {
            phases: (0..count).map(|i| if i == 0 { first } else { rest }).collect(),
            times: vec![Interval::new(0.0, reach); count],
            drifts: vec![Interval::new(-self.drift, self.drift); count],
            speeds: vec![ALL; count],
        }
    }

    /// Cuts the part until a pass gains little; `None` when nothing is left.
    pub fn cut(&self, mut part: Part, stretch: &Stretch) -> Option<Part> {
        loop {
            let before = part.size();
            self.cut_once(&mut part, stretch)?;
            let after = part.size();
            if after > (1.0 - MIN_GAIN) * before {
                return Some(part);
            }
        }
    }

    fn cut_once(&self, part: &mut Part, stretch: &Stretch) -> Option<()> {
        for i in stretch.flights.clone() {
            self.cut_time(part, i)?;
            self.cut_drift(part, i)?;
        }
        for i in stretch.impacts.clone() {
            self.cut_impact(part, i)?;
        }
        for i in stretch.flights.clone() {
            self.cut_ratios(part, i)?;
            self.look(part, i)?;
        }
        Some(())
    }

    /// `h_i = u_{i+1} - u_i`, and its least value.
    fn cut_time(&self, part: &mut Part, i: usize) -> Option<()> {
        let (j, shift) = (self.chain.next(i), self.shift(i));
        let least = if self.chain.displacement(i) == 0.0 { 0.0 } else { self.crossing }; // T8: -1, 0 or 1, exact
        let (from, to) = (part.phases[i], part.phases[j] + shift);
        let time = part.times[i].intersection(to - from)?.at_least(least)?;
        part.times[i] = time;
        part.phases[j] = part.phases[j].intersection(from + time - shift)?;
        part.phases[i] = from.intersection(part.phases[j] + shift - time)?;
        Some(())
    }

    /// `c_i = D_i/h_i + beta S(h_i) cos 2 pi m_i`
    fn cut_drift(&self, part: &mut Part, i: usize) -> Option<()> {
        let time = part.times[i];
        let wave = self.wave(&part.phases, i, time);
        let displacement = self.chain.displacement(i);
        // T9: -1, 0 or 1, exact
        if displacement == 0.0 {
            part.drifts[i] = part.drifts[i].intersection(wave)?;
            return Some(());
        }
        let travel = Interval::point(displacement);
        part.drifts[i] = cut_if(part.drifts[i], travel.checked_div(time).map(|straight| straight + wave))?;
        part.times[i] = cut_if(time, travel.checked_div(part.drifts[i] - wave))?;
        Some(())
    }

    /// `beta S(h_i) cos 2 pi m_i`, of several harmonics the sum: the mean velocity of the box during flight `i`, over phases with these times.
    fn wave(&self, phases: &[Interval], i: usize, time: Interval) -> Interval {
        self.mean(time, self.middle(phases, i, time))
    }

    /// `m_i`: half way between both phases of a flight.
    fn middle(&self, phases: &[Interval], i: usize, time: Interval) -> Interval {
        let end = phases[self.chain.next(i)] + self.shift(i);
        let half = time.scaled(0.5);
        let narrower = |x: Interval, y: Interval| x.intersection(y).unwrap_or(x); // T9: the first holds it anyway
        narrower(narrower((phases[i] + end).scaled(0.5), phases[i] + half), end - half)
    }

    /// Forcing periods that are added to the phase at the end of flight `i`: the chain's cycles for the last flight, else 0.
    pub fn shift(&self, i: usize) -> Interval {
        Interval::point(if self.chain.next(i) == 0 { f64::from(self.chain.cycles()) } else { 0.0 })
    }

    /// `w_i/h_i` and `v_{i+1}/h_i` at *all* phases of a box with these times, whether orbits or not.
    pub fn ratios(&self, phases: &[Interval], i: usize, time: Interval) -> [Interval; 2] {
        let displacement = self.chain.displacement(i);
        let straight =
            // T9: -1, 0 or 1, exact
            if displacement == 0.0 { Some(Interval::ZERO) } else { Interval::point(displacement).checked_div(time) };
        let drift = straight.map(|straight| straight + self.wave(phases, i, time));
        // T9: nothing is known
        let by_time =
            |phase: Interval| drift.and_then(|drift| (drift - self.speed(phase)).checked_div(time)).unwrap_or(ALL);
        let ratios = [by_time(phases[i]), by_time(phases[self.chain.next(i)])];
        // T9: -1, 0 or 1, exact
        if displacement != 0.0 {
            return ratios;
        }
        let middle = self.middle(phases, i, time);
        let hops = self.harmonics.iter().map(|harmonic| harmonic.hop(time, middle));
        let hop = hops.reduce(|a, b| [a[0] + b[0], a[1] + b[1]]).expect("a harmonic").map(|x| -x);
        [0, 1].map(|end| ratios[end].intersection(hop[end]).unwrap_or(hop[end])) // T9: the second holds it anyway
    }

    /// Cuts by Newton's impact law and by the directions before and after the impact.
    fn cut_impact(&self, part: &mut Part, i: usize) -> Option<()> {
        let p = self.chain.previous(i);
        let mut speed = part.speeds[i].intersection(self.speed(part.phases[i]))?;
        let (mut to, mut from) = (part.drifts[p], part.drifts[i]);
        // (15): c_i + e c_{i-1} = (1 + e) V_i
        from = from.intersection(self.lossy * speed - self.restitution * to)?;
        speed = cut_if(speed, (from + self.restitution * to).checked_div(self.lossy))?;
        to = cut_if(to, (self.lossy * speed - from).checked_div(self.restitution))?;
        // sigma_i w_i >= 0 >= sigma_i v_i
        (to, speed, from) = match self.chain.walls()[i] {
            Wall::Left => in_order(to, speed, from)?,
            Wall::Right => {
                let (from, speed, to) = in_order(from, speed, to)?;
                (to, speed, from)
            }
        };
        let (fastest, others) = self.harmonics.split_first().expect("a harmonic");
        let others = Self::sum(others, |harmonic| harmonic.speed(part.phases[i]));
        if let Some(cos) = others.map_or(speed, |others| speed - others).checked_div(fastest.beta) {
            part.phases[i] = part.phases[i].where_cos(cos)?;
        }
        (part.drifts[p], part.drifts[i], part.speeds[i]) = (to, from, speed);
        Some(())
    }

    /// Cuts by the signs of `w_i/h_i` and `v_{i+1}/h_i`, positive away from the walls; hops of no time have these signs, too.
    fn cut_ratios(&self, part: &Part, i: usize) -> Option<()> {
        let [after, before] = self.ratios(&part.phases, i, part.times[i]);
        let [from, to] = [i, self.chain.next(i)].map(|impact| self.chain.walls()[impact].sign());
        after.signed(from).at_least(0.0)?;
        before.signed(to).at_most(0.0)?;
        Some(())
    }

    /// The ball is in the gap on its way.
    fn look(&self, part: &Part, i: usize) -> Option<()> {
        FLIGHT_FRACTIONS.iter().all(|&fraction| self.may_be_in_gap(part, i, fraction)).then_some(())
    }

    /// Whether the ball may be in the gap after a fraction of flight `i`: its displacement is `g (c - beta S(g) cos 2 pi(u + g/2))` after
    /// a time `g`.
    fn may_be_in_gap(&self, part: &Part, i: usize, fraction: f64) -> bool {
        let since = part.times[i].scaled(fraction);
        let at = part.phases[i] + since.scaled(0.5);
        let travel = since * (part.drifts[i] - self.mean(since, at));
        travel.signed(self.chain.walls()[i].sign()).intersection(Interval::new(0.0, 1.0)).is_some()
    }

    /// Whether all flights of a part may be in the gap at each of so many equal parts of their times.
    pub fn stays_in_gap(&self, part: &Part, parts: u32) -> bool {
        let fractions = || (1..parts).map(|n| f64::from(n) / f64::from(parts)); // T9: any fractions
        (0..self.chain.impacts()).all(|i| fractions().all(|fraction| self.may_be_in_gap(part, i, fraction)))
    }
}

/// Intersection with `known`, if there is one.
fn cut_if(x: Interval, known: Option<Interval>) -> Option<Interval> {
    known.map_or(Some(x), |known| x.intersection(known))
}

/// Cuts three numbers to what allows `a <= b <= c`.
fn in_order(a: Interval, b: Interval, c: Interval) -> Option<(Interval, Interval, Interval)> {
    let b = b.at_least(a.inf())?.at_most(c.sup())?;
    Some((a.at_most(b.sup())?, b, c.at_least(b.inf())?))
}

impl Part {
    /// Sum of the widths of the phases and times.
    pub fn size(&self) -> f64 {
        self.phases.iter().chain(&self.times).map(|x| x.wid()).sum()
    }

    /// Whether this part overlaps another part at these impacts.
    pub fn touches(&self, other: &Self, impacts: &Range<usize>) -> bool {
        impacts.clone().all(|i| self.phases[i].intersection(other.phases[i]).is_some())
    }

    /// Pairs of the bounds of two parts, flight by flight and impact by impact.
    fn pairs<'p>(&'p mut self, other: &'p Self) -> impl Iterator<Item = (&'p mut Interval, Interval)> {
        let mine = [&mut self.phases, &mut self.times, &mut self.drifts, &mut self.speeds];
        let its = [&other.phases, &other.times, &other.drifts, &other.speeds];
        mine.into_iter().flatten().zip(its.into_iter().flatten().copied())
    }

    /// Extends this part to the hull of itself and another part.
    pub fn add(&mut self, other: &Self) {
        self.pairs(other).for_each(|(x, y)| *x = x.hull(y));
    }

    /// Intersection of two parts; `None` if empty.
    pub fn both(&self, other: &Self) -> Option<Self> {
        let mut both = self.clone();
        for (x, y) in both.pairs(other) {
            *x = x.intersection(y)?;
        }
        Some(both)
    }

    /// Both sides of a place within one phase.
    pub fn halved(self, phase: usize, place: f64) -> [Self; 2] {
        let (lo, hi) = (self.phases[phase].inf(), self.phases[phase].sup());
        let (mut lower, mut upper) = (self.clone(), self);
        lower.phases[phase] = Interval::new(lo, place);
        upper.phases[phase] = Interval::new(place, hi);
        [lower, upper]
    }

    /// Middle of the phases.
    pub fn centre(&self) -> Vec<f64> {
        self.phases.iter().map(|x| x.mid()).collect()
    }

    /// Width of the widest phase.
    pub fn wid(&self) -> f64 {
        self.phases.iter().map(|x| x.wid()).fold(0.0, f64::max) // proposes: when to stop
    }
}
