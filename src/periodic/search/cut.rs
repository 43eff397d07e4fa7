//! Cutting a box of phases down to what an orbit needs: Lemma T9.

use super::interval::Interval;
use crate::number::Ball;
use crate::pair::Reduced;
use crate::pair::Wall;
use crate::periodic::chain::Chain;

/// The word, the parameters and the bounds of Lemma T8.
#[derive(Clone, Debug)]
pub(super) struct Terms<'c> {
    pub chain: &'c Chain,
    beta: Interval,
    pub restitution: Interval,
    /// `1 + e`, and `(1 + e) 2 pi beta`.
    lossy: Interval,
    pub swing: Interval,
    /// `|c|` is at most this.
    drift: f64,
    /// The least time of a crossing.
    crossing: f64,
}

/// A box of phases, with what is known of its flights and impacts.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub phases: Vec<Interval>,
    /// Time and drift of each flight.
    pub times: Vec<Interval>,
    pub drifts: Vec<Interval>,
    /// The velocity of the box at each impact.
    pub speeds: Vec<Interval>,
    /// `w_i/h_i` and `v_{i+1}/h_i` of each flight.
    pub ratios: Vec<[Interval; 2]>,
}

/// Anything.
const ALL: Interval = Interval::new(f64::MIN, f64::MAX);
/// Fractions of a flight at which the ball has to be in the gap.
const LOOKS: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// The least part of a box that a pass takes off for another one to be made.
const WORTH: f64 = 0.1;

impl<'c> Terms<'c> {
    pub fn new(chain: &'c Chain, pair: &Reduced<Ball>) -> Self {
        let [alpha, beta, restitution] = [pair.alpha, pair.beta, pair.restitution].map(Interval::of);
        let one = Interval::point(1.0);
        let (alpha, beta) = (Interval::new(alpha.lo.max(0.0), alpha.hi), Interval::new(beta.lo.max(0.0), beta.hi));
        let restitution = Interval::new(restitution.lo.max(0.0), restitution.hi.min(1.0));
        let lossy = one + restitution;
        // Lemma T8.
        let impacts = Interval::point(chain.impacts() as f64);
        let cycles = Interval::point(f64::from(chain.cycles()));
        let longest = (one + alpha.times(2.0)) * impacts;
        let longest = longest.over(cycles).map_or(f64::MAX, |drift| drift.hi);
        let kicks = (lossy * (impacts - one) * beta).hi;
        let general = (Interval::point(longest) + Interval::point(kicks)).hi;
        let lost = (lossy * beta).over(one - restitution).map_or(f64::MAX, |drift| drift.hi);
        let drift = general.min(lost);
        let crossing = one.over(Interval::point(drift) + beta).map_or(f64::MAX, |time| time.lo);
        let swing = (PI * beta * lossy).times(2.0);
        Self { chain, beta, restitution, lossy, swing, drift, crossing }
    }

    /// How wide intervals among the parameters are, relative to `A/d`: boxes much narrower say no more.
    pub fn spread(&self) -> f64 {
        let relative = self.beta.width() / self.beta.hi.max(f64::MIN_POSITIVE);
        relative.max(self.restitution.width())
    }

    /// The velocity of the box over these phases.
    pub fn speed(&self, phase: Interval) -> Interval {
        self.beta * phase.cos()
    }

    /// The whole state space.
    pub fn all(&self) -> Part {
        let count = self.chain.impacts();
        let reach = 1.0 + f64::from(self.chain.cycles());
        let phase = |i: usize| Interval::new(0.0, if i == 0 { 1.0 } else { reach });
        Part {
            phases: (0..count).map(phase).collect(),
            times: vec![Interval::new(0.0, reach); count],
            drifts: vec![Interval::new(-self.drift, self.drift); count],
            speeds: vec![ALL; count],
            ratios: vec![[ALL; 2]; count],
        }
    }

    /// Cuts the part while that is worth it; `None` when nothing is left.
    pub fn cut(&self, mut part: Part) -> Option<Part> {
        loop {
            let before = part.size();
            self.cut_once(&mut part)?;
            let after = part.size();
            if after > (1.0 - WORTH) * before {
                return Some(part);
            }
        }
    }

    fn cut_once(&self, part: &mut Part) -> Option<()> {
        let count = part.phases.len();
        for i in 0..count {
            self.cut_time(part, i)?;
            self.cut_drift(part, i)?;
        }
        for i in 0..count {
            self.cut_impact(part, i)?;
        }
        for i in 0..count {
            self.cut_ratios(part, i)?;
            self.look(part, i)?;
        }
        Some(())
    }

    /// `h_i = u_{i+1} - u_i`, and its least value.
    fn cut_time(&self, part: &mut Part, i: usize) -> Option<()> {
        let j = self.chain.next(i);
        let shift = Interval::point(if j == 0 { f64::from(self.chain.cycles()) } else { 0.0 });
        let least = if self.chain.displacement(i) == 0.0 { 0.0 } else { self.crossing };
        let (from, to) = (part.phases[i], part.phases[j] + shift);
        let time = part.times[i].cut(to - from)?.from(least)?;
        part.times[i] = time;
        part.phases[j] = part.phases[j].cut(from + time - shift)?;
        part.phases[i] = from.cut(part.phases[j] + shift - time)?;
        Some(())
    }

    /// `c_i = D_i/h_i + beta S(h_i) cos 2 pi m_i`
    fn cut_drift(&self, part: &mut Part, i: usize) -> Option<()> {
        let time = part.times[i];
        let wave = self.beta * time.sinc() * self.middle(part, i).cos();
        let displacement = self.chain.displacement(i);
        if displacement == 0.0 {
            part.drifts[i] = part.drifts[i].cut(wave)?;
            return Some(());
        }
        let way = Interval::point(displacement);
        if let Some(straight) = way.over(time) {
            part.drifts[i] = part.drifts[i].cut(straight + wave)?;
        }
        if let Some(time) = way.over(part.drifts[i] - wave) {
            part.times[i] = part.times[i].cut(time)?;
        }
        Some(())
    }

    /// `m_i`: half way between both phases of a flight.
    fn middle(&self, part: &Part, i: usize) -> Interval {
        let j = self.chain.next(i);
        let shift = Interval::point(if j == 0 { f64::from(self.chain.cycles()) } else { 0.0 });
        let ends = (part.phases[i] + part.phases[j] + shift).times(0.5);
        let half = part.times[i].times(0.5);
        let narrower = |x: Interval, y: Interval| x.cut(y).unwrap_or(x);
        narrower(narrower(ends, part.phases[i] + half), part.phases[j] + shift - half)
    }

    /// The impact law and the directions before and after it.
    fn cut_impact(&self, part: &mut Part, i: usize) -> Option<()> {
        let p = self.chain.previous(i);
        let mut speed = part.speeds[i].cut(self.speed(part.phases[i]))?;
        let (mut to, mut from) = (part.drifts[p], part.drifts[i]);
        // (15): c_i + e c_{i-1} = (1 + e) V_i
        from = from.cut(self.lossy * speed - self.restitution * to)?;
        speed = cut_if(speed, (from + self.restitution * to).over(self.lossy))?;
        to = cut_if(to, (self.lossy * speed - from).over(self.restitution))?;
        // sigma_i w_i >= 0 >= sigma_i v_i
        (to, speed, from) = match self.chain.walls()[i] {
            Wall::Left => in_order(to, speed, from)?,
            Wall::Right => {
                let (from, speed, to) = in_order(from, speed, to)?;
                (to, speed, from)
            }
        };
        if let Some(cos) = speed.over(self.beta) {
            part.phases[i] = part.phases[i].where_cos(cos)?;
        }
        (part.drifts[p], part.drifts[i], part.speeds[i]) = (to, from, speed);
        Some(())
    }

    /// `w_i/h_i` and `v_{i+1}/h_i`, with their signs.
    fn cut_ratios(&self, part: &mut Part, i: usize) -> Option<()> {
        let j = self.chain.next(i);
        let (walls, time) = (self.chain.walls(), part.times[i]);
        let by_time = |speed: Interval| (part.drifts[i] - speed).over(time).unwrap_or(ALL);
        let mut ratios = [by_time(part.speeds[i]), by_time(part.speeds[j])];
        if self.chain.displacement(i) == 0.0 {
            let middle = self.middle(part, i);
            let quarter = time.times(0.25);
            let bend = time.bend() * middle.cos();
            let wave = |at: Interval| PI * time.times(0.5).sinc() * at.sin();
            ratios[0] = ratios[0].cut(-(self.beta * (bend + wave(middle - quarter))))?;
            ratios[1] = ratios[1].cut(-(self.beta * (bend - wave(middle + quarter))))?;
        }
        // The signs, told away from the walls.
        ratios[0] = ratios[0].signed(walls[i].sign()).from(0.0)?.signed(walls[i].sign());
        ratios[1] = ratios[1].signed(walls[j].sign()).up_to(0.0)?.signed(walls[j].sign());
        part.ratios[i] = ratios;
        Some(())
    }

    /// The ball is in the gap on its way: `D` so far is `g (c - beta S(g) cos 2 pi(u + g/2))` after a time `g`.
    fn look(&self, part: &Part, i: usize) -> Option<()> {
        let wall = self.chain.walls()[i];
        for fraction in LOOKS {
            let since = part.times[i].times(fraction);
            let at = part.phases[i] + since.times(0.5);
            let way = since * (part.drifts[i] - self.beta * since.sinc() * at.cos());
            way.signed(wall.sign()).cut(Interval::new(0.0, 1.0))?;
        }
        Some(())
    }
}

/// Bounds of pi.
const PI: Interval = Interval::new(std::f64::consts::PI, std::f64::consts::PI.next_up());

/// Cuts with what is known, if anything is.
fn cut_if(x: Interval, known: Option<Interval>) -> Option<Interval> {
    known.map_or(Some(x), |known| x.cut(known))
}

/// Cuts three numbers to what allows `a <= b <= c`.
fn in_order(a: Interval, b: Interval, c: Interval) -> Option<(Interval, Interval, Interval)> {
    let b = b.from(a.lo)?.up_to(c.hi)?;
    Some((a.up_to(b.hi)?, b, c.from(b.lo)?))
}

impl Part {
    /// How much there is: the sum of the widths of the phases and times.
    pub fn size(&self) -> f64 {
        self.phases.iter().chain(&self.times).map(|x| x.width()).sum()
    }

    /// The width of the widest phase.
    pub fn width(&self) -> f64 {
        self.phases.iter().map(|x| x.width()).fold(0.0, f64::max)
    }
}
