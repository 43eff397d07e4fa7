//! All flights from a quadrilateral of states at once, measured from its centre: Lemmas D1-D3, D12 and D15 of `docs/proofs/chaos.md#D1`.

use std::array;
use std::f64::consts::TAU;

use super::law::{Law, Side};
use super::quad::{Quad, State};
use crate::number::{Ball, Number, TINY, UNIT, up};

/// Changes of a flight's drift, and of its height at a phase of arrival, along one side: `drift`, and `x drift - shift`.
#[derive(Clone, Copy, Debug)]
struct Slope {
    drift: Ball,
    shift: Ball,
    /// Displacement of the far wall, in amplitudes.
    ahead: f64,
}

/// The flights from a quadrilateral, with `M` parameters among their directions: `e`, or `e` and `D`.
pub(crate) struct Flights<const M: usize = 1> {
    gap: Ball,
    start: f64,
    radius: f64,
    /// Sine and cosine over all starts.
    sin: Ball,
    cos: Ball,
    /// `e w`, and a lower bound.
    after: Ball,
    least: f64,
    /// The sine and the drift of the centre, at the middle of all `e`.
    centre_sin: Ball,
    drift: Ball,
    sides: [Slope; 2],
    /// Along the phase and along the speed.
    units: [Slope; 2],
    parameters: [Slope; M],
    /// The radius of `D`, if it is no direction.
    loose: f64,
    /// Bounds of what twist and slack add.
    rest: [f64; 2],
    /// Bounds the drifts' distance from the centre's.
    spread: f64,
}

/// All heights at one phase, in amplitudes, and the velocities there, over `A W`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub height: Ball,
    pub rate: Ball,
    /// `|z''|` there, but for rounding.
    bend: f64,
}

/// Landings of the flights in mean-value form: the image of the quadrilateral. Lemma D3
#[derive(Clone, Copy, Debug)]
pub(crate) struct Landing<const M: usize = 1> {
    /// The centre's image.
    pub phase: Ball,
    pub speed: Ball,
    /// `dw/dth` at a fixed drift, over the bracket, in speeds per forcing period.
    slope: Ball,
    /// The change of phase, and the change of speed at a fixed phase, by side and by parameter.
    along: [[Ball; 2]; 2],
    /// Changes of phase, and of speed at a fixed phase, for a unit of phase, and of speed.
    units: [[Ball; 2]; 2],
    parameters: [[Ball; 2]; M],
    /// Bounds of these changes for twist and slack, and for `D` if it is no direction.
    rest: [f64; 2],
}

fn turn() -> Ball {
    Number::turn(&Ball::exact(0.0))
}

/// Whether all members are positive; `false` for a NaN.
pub(crate) fn is_positive(x: Ball) -> bool {
    x.mid() > x.rad()
}

impl Flights {
    pub fn new(law: &Law, quad: &Quad) -> Self {
        Self::moved(law, quad, [[0.0; 2]])
    }
}

impl<const M: usize> Flights<M> {
    /// Flights of states that are displaced by `moved` for the radius of each parameter.
    pub fn moved(law: &Law, quad: &Quad, moved: [State; M]) -> Self {
        let e = law.restitution;
        let [start, speed] = quad.centre;
        let [radius, speed_radius] = quad.radii(&moved);
        let (centre_sin, centre_cos) = Ball::exact(start).sin_cos();
        let (sin, cos) = Ball::new(start, radius).sin_cos();
        let after = e * Ball::new(speed, speed_radius);
        let least = (e.mid() - e.rad()) * quad.floor * (1.0 - 4.0 * UNIT);
        let drift = Ball::exact(e.mid()) * Ball::exact(speed) + centre_cos;
        let by_phase = -(turn() * sin);
        let turned = turn() * after;
        let slope = |side: State| Slope {
            drift: by_phase * Ball::exact(side[0]) + e * Ball::exact(side[1]),
            shift: turned * Ball::exact(side[0]),
            ahead: 0.0,
        };
        let [along, across, twist] = [slope(quad.sides[0]), slope(quad.sides[1]), slope(quad.twist)];
        let units = [slope([1.0, 0.0]), slope([0.0, 1.0])];
        // Lemmas D12, D15: parameters are directions like the others
        let parameter = |k: usize| match slope(moved[k]) {
            by if k == 0 => Slope { drift: by.drift + Ball::new(speed, speed_radius) * Ball::exact(e.rad()), ..by },
            by => Slope { ahead: law.gap.rad(), ..by },
        };
        let parameters: [Slope; M] = array::from_fn(parameter);
        let loose = if M == 1 { law.gap.rad() } else { 0.0 };
        let [u, w] = quad.slack;
        let rest = [
            up(twist.drift.mag() + by_phase.mag() * u + e.mag() * w + TINY),
            up(twist.shift.mag() + turned.mag() * u + TINY),
        ];
        let by_parameters = parameters.iter().map(|slope| slope.drift.mag()).sum::<f64>();
        let spread = up(along.drift.mag() + across.drift.mag() + by_parameters + rest[0]);
        let sides = [along, across];
        let gap = law.gap;
        Self {
            gap,
            start,
            radius,
            sin,
            cos,
            after,
            least,
            centre_sin,
            drift,
            sides,
            units,
            parameters,
            loose,
            rest,
            spread,
        }
    }

    /// `th1 - th0` of the centre, and of all.
    fn ahead(&self, phase: f64) -> [Ball; 2] {
        let time = Ball::exact(phase) - Ball::exact(self.start);
        [turn() * time, turn() * time.widened(self.radius)]
    }

    /// Encloses height and velocity of all flights at one phase after their starts. Lemma D1
    pub fn at(&self, phase: f64) -> View {
        let (sin, cos) = Ball::exact(phase).sin_cos();
        let [own, all] = self.ahead(phase);
        let centre = own * self.drift - sin + self.centre_sin;
        let change = |slope: &Slope| (all * slope.drift - slope.shift).mag();
        let [along, across] = self.sides.each_ref().map(change);
        let by_parameters = self.parameters.iter().map(change).sum::<f64>();
        let spread = up(along + across + by_parameters + all.mag() * self.rest[0] + self.rest[1]);
        let rate = (self.drift - cos).widened(self.spread);
        View { height: centre.widened(spread), rate, bend: sin.mag() }
    }

    /// Whether all members of a height are between the walls.
    fn is_inside(&self, height: Ball) -> bool {
        is_positive(height) && is_positive(self.gap - height)
    }

    /// Encloses heights and velocities from one phase to another.
    pub fn over(&self, from: f64, to: f64) -> View {
        let middle = 0.5 * (from + to);
        let radius = up((middle - from).max(to - middle)); // D1: the farther end
        let mut view = self.at(middle);
        let angle = up(TAU * radius * (1.0 + UNIT));
        let bend = up(view.bend + angle);
        view.height = view.height.widened(up(view.rate.mag() * angle + 0.5 * bend * angle * angle));
        view.rate = view.rate.widened(up(bend * angle));
        view
    }

    /// Phase up to which all flights are proved to be between the walls, and away from the start. Lemma D2
    ///
    /// The phase is later than all starts; `None` where no such phase is proved.
    pub fn depart(&self) -> Option<f64> {
        let (least, most) = (self.least, self.after.mag());
        let [down, below] = [self.sin, self.cos].map(|x| (x.rad() - x.mid()).max(0.0)); // D2: how far below 0
        let mut angle = 1.0;
        while 0.5 * angle > TAU * self.radius {
            let (half, sixth) = (0.5 * angle, angle * angle / 6.0);
            let rises = least > up(below * sixth + down * half) || least >= 0.0 && down == 0.0 && self.leaves(angle); // D2: no sine below 0
            let stays = is_positive(self.gap - Ball::new(0.0, up(angle * (most + sixth + half))));
            if rises && stays {
                let phase = self.start - self.radius + angle / TAU * (1.0 - 8.0 * UNIT);
                return (phase > self.start + self.radius * (1.0 + 8.0 * UNIT)).then_some(phase);
            }
            angle *= 0.5;
        }
        None
    }

    /// Whether even a ball without velocity leaves, and stays away for this angle, in radians: by a lower bound of `z/x^2`.
    fn leaves(&self, angle: f64) -> bool {
        let least = (self.sin.mid() - self.sin.rad()) * (0.5 - angle * angle / 24.0) * (1.0 - 4.0 * UNIT);
        least > up(self.cos.mag() * angle / 6.0)
    }

    /// Proves that no flight touches a wall before `end`, where all are inside. Lemma D2
    pub fn is_clear(&self, end: f64) -> bool {
        let Some(mut from) = self.depart() else { return false };
        let mut step = 0.0625;
        while from < end {
            let last = from + step >= end;
            let to = if last { end } else { from + step };
            let view = self.over(from, to);
            let is_monotone = is_positive(view.rate) || is_positive(-view.rate);
            if self.is_inside(view.height) || is_monotone && (last || self.is_inside(self.at(to).height)) {
                from = to;
                step *= 2.0;
            } else {
                step *= 0.5;
                if step < 1e-7 {
                    return false; // exact: given up, nothing is certified
                }
            }
        }
        true
    }

    /// Encloses the first contacts of all flights, near a guess, proved to be on one wall and transversal. Lemma D3
    pub fn land(&self, side: Side, guess: f64) -> Option<Landing<M>> {
        let sign = side.sign();
        let (wall, loose) = match side {
            Side::Near => (Ball::exact(0.0), 0.0),
            Side::Far => (self.gap, self.loose),
        };
        let beyond = |view: &View| (view.height - wall).signed(sign);
        let there = self.at(guess);
        let speed = there.rate.mid().abs();
        // proposes: the bracket is proved below
        let mut radius = 1.25 * (there.height - wall).mag() / (TAU * speed) + 1e-14 * (1.0 + guess.abs());
        let mut left = 3;
        let (rate, bracket) = loop {
            let (low, high) = (guess - radius, guess + radius);
            let bracket = Ball::new(guess, up(radius + UNIT * guess.abs()));
            let rate = (self.drift - bracket.sin_cos().1).widened(self.spread).signed(sign);
            if is_positive(rate) && is_positive(beyond(&self.at(high))) && self.is_inside(self.at(low).height) {
                if !self.is_clear(low) {
                    return None;
                }
                break (rate, bracket);
            }
            left -= 1;
            if left == 0 || !is_positive(rate) {
                return None;
            }
            radius *= 1.5;
        };
        let turned = turn() * rate;
        // The centre's contact, at the middle of all `D`: one interval Newton step.
        let middle = Ball::exact(wall.mid());
        let sin = Ball::exact(guess).sin_cos().0;
        let [own, _] = self.ahead(guess);
        let miss = (own * self.drift - sin + self.centre_sin - middle).signed(sign);
        let phase = Ball::exact(guess) - miss.checked_div(turned)?;
        let speed = (self.drift - phase.sin_cos().1).signed(sign);
        let slope = (turn() * bracket.sin_cos().0).signed(sign);
        let inverse = Ball::exact(1.0).checked_div(turned)?;
        let all = turn() * (bracket - Ball::exact(self.start)).widened(self.radius);
        let change = |s: &Slope| {
            let away = match side {
                Side::Near => s.shift,
                Side::Far => s.shift + Ball::exact(s.ahead),
            };
            [-((all * s.drift - away).signed(sign) * inverse), s.drift.signed(sign)]
        };
        let [along, units] = [self.sides, self.units].map(|slopes| slopes.each_ref().map(change));
        let parameters = self.parameters.each_ref().map(change);
        // Lemma D12: the wall moves by its radius
        let rest = [up(up(all.mag() * self.rest[0] + self.rest[1] + loose) * inverse.mag()), self.rest[0]];
        let phase = match side {
            Side::Near => phase,
            Side::Far => phase + Ball::exact(0.5),
        };
        Some(Landing { phase, speed, slope, along, units, parameters, rest })
    }

    /// Holds the drifts `c`.
    pub fn drifts(&self) -> Ball {
        self.drift.widened(self.spread)
    }

    /// `D`
    pub fn gap(&self) -> Ball {
        self.gap
    }

    /// Bounds of the times of flight, in forcing periods, of landings between two phases.
    pub fn times(&self, low: f64, high: f64) -> [f64; 2] {
        let [least, most] = [low - self.start - self.radius, high - self.start + self.radius];
        // D4: a phase is off by at most a unit, four times
        let error = 4.0 * UNIT * (high.abs() + self.start.abs() + self.radius);
        [least - 2.0 * error, most + 2.0 * error]
    }

    /// Holds `z'` of all flights that are at this height between two phases, from both phases: `z' = (z + sin th1 - sin th0)/x - cos th1`. Lemma D4
    pub fn velocity_by_phases(&self, height: Ball, low: f64, high: f64) -> Option<Ball> {
        let arrival = 0.5 * (low + high);
        let radius = up((arrival - low).max(high - arrival)); // D4: the farther end
        let [own, _] = self.ahead(arrival);
        let all = own.widened(up(7.0 * (radius + self.radius)));
        let (sin, cos) = Ball::exact(arrival).sin_cos();
        let centre = (height + sin - self.centre_sin).checked_div(own)? - cos;
        let (sins, coss) = Ball::new(arrival, radius).sin_cos();
        // The drift projected so, over all.
        let drift = (height + sins - self.sin).checked_div(all)?;
        let by_start = (drift - self.cos).checked_div(all)?;
        let by_arrival = (coss - drift).checked_div(all)? + sins;
        Some(centre.widened(up(6.3 * up(by_start.mag() * self.radius + by_arrival.mag() * radius))))
    }
}

impl<const M: usize> Landing<M> {
    /// Holds `n (x - p)` for all images `x`.
    pub fn along(&self, normal: [Ball; 2], point: [Ball; 2]) -> Ball {
        self.projected(normal, point, |_, change| change)
    }

    /// Encloses the image of a vector by the derivative of the map at any of the states. Lemma D24
    pub fn derivative(&self, [u, w]: [Ball; 2]) -> [Ball; 2] {
        let [[delay_u, speed_u], [delay_w, speed_w]] = self.units;
        self.sheared([u * delay_u + w * delay_w, u * speed_u + w * speed_w])
    }

    /// Holds the image of the centre for all parameters. Lemma D24
    pub fn centre(&self) -> [Ball; 2] {
        let moved = |[u, w]: [Ball; 2], by: &[Ball; 2]| {
            let [v, x] = self.sheared(*by);
            [u.widened(v.mag()), w.widened(x.mag())]
        };
        self.parameters.iter().fold([self.phase, self.speed], moved)
    }

    /// A delay, and a change of speed at a fixed phase, as changes of phase and speed.
    fn sheared(&self, [delay, speed]: [Ball; 2]) -> [Ball; 2] {
        [delay, speed + delay * self.slope]
    }

    /// Holds `n (x - p)` for all images `x`, where `moved` displaces `p` for the radius of each parameter. Lemma D15
    pub fn beside(&self, [n, m]: [Ball; 2], point: [Ball; 2], moved: [State; M]) -> Ball {
        let from = |k: usize, change: Ball| {
            let [u, w] = moved[k].map(Ball::exact);
            change - n * u - m * w
        };
        self.projected([n, m], point, from)
    }

    /// Holds `n (x - p)` for all images; `from` turns a parameter's change of `n x` into its change of `n (x - p)`.
    fn projected(&self, [n, m]: [Ball; 2], point: [Ball; 2], from: impl Fn(usize, Ball) -> Ball) -> Ball {
        let centre = n * (self.phase - point[0]) + m * (self.speed - point[1]);
        let sheared = n + m * self.slope;
        let change = |[delay, speed]: [Ball; 2]| delay * sheared + m * speed;
        let [along, across] = self.along.map(|by| change(by).mag());
        let by_parameters = (0..M).map(|k| from(k, change(self.parameters[k])).mag()).sum::<f64>();
        let rest = sheared.mag() * self.rest[0] + m.mag() * self.rest[1];
        centre.widened(up(along + across + by_parameters + rest))
    }
}
