//! The flights of a set of states up to their first contacts (Lemma V11, sets).

use super::Law;
use super::span::Span;

/// A phase in forcing periods and a speed over `A W`.
pub(super) type State = [f64; 2];
pub(super) type Spot = [Span; 2];

/// A quadrilateral of states by its corners: left bottom, left top, right bottom, right top. Its parts are bilinear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quad {
    pub corners: [Spot; 4],
}

fn mean(a: Spot, b: Spot) -> Spot {
    [0, 1].map(|i| (a[i] + b[i]).scaled(0.5))
}

impl Quad {
    /// Returns the rectangle between two states.
    pub fn rectangle(low: State, high: State) -> Self {
        let corner = |u: f64, w: f64| [Span::point(u), Span::point(w)];
        let corners = [(low[0], low[1]), (low[0], high[1]), (high[0], low[1]), (high[0], high[1])];
        Self { corners: corners.map(|(u, w)| corner(u, w)) }
    }

    /// Some state about its middle.
    pub fn middle(&self) -> State {
        [0, 1].map(|i| self.centre()[i].mid())
    }

    pub fn centre(&self) -> Spot {
        let [p, q, r, s] = self.corners;
        mean(mean(p, q), mean(r, s))
    }

    /// Half of its length, its width, and its twist.
    pub fn sides(&self) -> [Spot; 3] {
        let [p, q, r, s] = self.corners;
        let side = |f: &dyn Fn(usize) -> Span| [0, 1].map(|i| f(i).scaled(0.25));
        [
            side(&|i| (r[i] - p[i]) + (s[i] - q[i])),
            side(&|i| (q[i] - p[i]) + (s[i] - r[i])),
            side(&|i| (s[i] - r[i]) - (q[i] - p[i])),
        ]
    }
}

/// Heights and velocities of all flights at a time, or over some times.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub height: Span,
    /// `z'`, an angle
    pub rate: Span,
}

/// All flights from a quadrilateral.
pub(super) struct FlightBundle {
    gap: Span,
    /// Bounds of the states.
    pub phase: Span,
    pub speed: Span,
    centre: Spot,
    /// Sine and cosine at the starts.
    sin: Span,
    cos: Span,
    centre_sin: Span,
    /// `p + cos th0` of the centre.
    drift: Span,
    /// `e w`
    after: Span,
    /// `2 pi` times each side's phase, and `e` times its speed; the last one is that of `e` itself.
    sides: [Spot; 4],
    restitution: Span,
}

/// A departure is proved for this time at first, and for no shorter one than the other.
const FIRST_DEPARTURE: f64 = 0.125;
const SHORTEST_DEPARTURE: f64 = 1e-6;
/// Parts of a flight are this long at most, and no shorter than the other.
const LONGEST_PART: f64 = 0.125;
const SHORTEST_PART: f64 = 1e-7;

/// The first contacts of all flights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Landing {
    /// The centre's state, mirrored to the left wall.
    pub centre: Spot,
    /// `epsilon sin th1`
    bend: Span,
    /// Changes of the phase of arrival \[rad\], and of the speed at a fixed one, by each side, by `e` and by `D`.
    changes: [Spot; 5],
    /// The same changes by a unit of phase, and of speed.
    units: [Spot; 2],
    /// Times of flight \[forcing periods\].
    pub times: Span,
}

impl FlightBundle {
    pub fn new(law: &Law, quad: &Quad) -> Self {
        let hull = |i: usize| {
            let [p, q, r, s] = quad.corners;
            p[i].hull(q[i]).hull(r[i].hull(s[i]))
        };
        Self::of(law, [hull(0), hull(1)], quad.centre(), quad.sides())
    }

    /// Returns the flights from states within bounds, whose differences from a centre are sums of parts of sides.
    pub fn of(law: &Law, bounds: Spot, centre: Spot, sides: [Spot; 3]) -> Self {
        Self::moved(law, bounds, centre, sides, [Span::point(0.0); 2])
    }

    /// The same where `e` moves the states by a direction as well (V36).
    pub fn moved(law: &Law, [phase, speed]: Spot, centre: Spot, sides: [Spot; 3], by: Spot) -> Self {
        let e = law.restitution;
        let (sin, cos) = phase.sin_cos();
        let (centre_sin, centre_cos) = centre[0].sin_cos();
        // V36: the centre's `e` is the middle one, and `e` a direction like the others
        let (middle, around) = e.centred_parts();
        let drift = middle * centre[1] + centre_cos;
        let [a, b, c, [ahead, faster]] = [sides[0], sides[1], sides[2], by].map(|[u, w]| [u.turned(), e * w]);
        let sides = [a, b, c, [ahead, faster + Span::point(around.hi()) * speed]];
        let (gap, after) = (law.gap, e * speed);
        Self { gap, phase, speed, centre, sin, cos, centre_sin, drift, after, sides, restitution: e }
    }

    /// Returns the level of a wall.
    pub fn level(&self, is_far: bool) -> Span {
        if is_far { self.gap } else { Span::point(0.0) }
    }

    fn spread(&self, change: impl Fn(Spot) -> Span) -> Span {
        let [a, b, c, e] = self.sides.map(|side| change(side).around());
        a + b + c + e
    }

    /// Returns all flights at one time.
    pub fn at(&self, time: f64) -> View {
        let time = Span::point(time);
        let angle = time.turned();
        let (sin, cos) = (self.phase + time).sin_cos();
        let (centre_sin, centre_cos) = (self.centre[0] + time).sin_cos();
        let lean = self.cos - cos;
        let height = self.drift * angle - centre_sin + self.centre_sin;
        View {
            height: height + self.spread(|[u, w]| lean * u + angle * (w - self.sin * u)),
            rate: self.drift - centre_cos + self.spread(|[u, w]| (sin - self.sin) * u + w),
        }
    }

    /// Returns all flights from one time to another.
    pub fn over(&self, from: f64, to: f64) -> View {
        let middle = 0.5 * (from + to);
        let times = Span::new(from, to);
        let away = (times - Span::point(middle)).turned().around();
        let View { height, rate } = self.at(middle);
        let bend = (self.phase + times).sin_cos().0;
        let curved = bend * Span::new(0.0, (away * away).scaled(0.5).hi());
        View { height: height + rate * away + curved, rate: rate + bend * away }
    }

    /// Returns the velocities of all flights that are at this height at some of these times, measured from the height.
    pub fn rate_at(&self, height: Span, times: Span) -> Option<Span> {
        let (sin, cos) = (self.phase + times).sin_cos();
        Some((height + sin - self.sin).over(times.turned())? - cos)
    }

    pub fn is_inside(&self, height: Span) -> bool {
        height.is_positive() && (self.gap - height).is_positive()
    }

    /// Holds `e w` of all states.
    pub fn after(&self) -> Span {
        self.after
    }

    /// Holds the drifts `e w + cos th0` of all states.
    pub fn drifts(&self) -> Span {
        self.after + self.cos
    }

    /// Returns whether all flights are proved to be away from the wall that they left until this time.
    pub fn leaves(&self, time: f64) -> bool {
        self.leaves_at(Span::point(time).turned(), time).0
    }

    /// Returns whether all are away from the wall until `time` \[forcing periods\], `angle` in radians, and the mean velocity until then.
    fn leaves_at(&self, angle: Span, time: f64) -> (bool, Span) {
        let bend = (self.phase + Span::new(0.0, time)).sin_cos().0;
        let mean = self.after + bend * angle.scaled(0.5);
        // No speed is negative if none of the states has a negative one, as no `e` is.
        (self.speed.lo() >= 0.0 && (bend.is_positive() || mean.is_positive()), mean) // V11: V1's departure
    }

    /// Returns a time up to which all flights are proved to be between the walls once they have left.
    pub fn depart(&self) -> Option<f64> {
        let mut time = FIRST_DEPARTURE;
        while time >= SHORTEST_DEPARTURE {
            let angle = Span::point(time).turned();
            let (leaves, mean) = self.leaves_at(angle, time);
            let stays = (self.gap - angle * mean.hull(self.after)).is_positive();
            if leaves && stays {
                return Some(time);
            }
            time *= 0.5;
        }
        None
    }

    /// Proves that no wall is touched before `end`, where all flights are between the walls.
    fn is_clear(&self, end: f64) -> bool {
        let Some(mut from) = self.depart() else { return false };
        let mut step = LONGEST_PART;
        while from < end {
            let is_last = from + step >= end;
            let to = if is_last { end } else { from + step };
            let View { height, rate } = self.over(from, to);
            let is_monotone = rate.is_positive() || rate.is_negative();
            if self.is_inside(height) || is_monotone && (is_last || self.is_inside(self.at(to).height)) {
                from = to;
                step = (2.0 * step).min(LONGEST_PART); // proposes: any part
            } else {
                step *= 0.5;
                if step < SHORTEST_PART {
                    return false; // exact: given up, nothing is certified
                }
            }
        }
        true
    }

    /// Returns the first contacts near a time, proved to be with one wall and transversal.
    pub fn land(&self, is_far: bool, guess: f64) -> Option<Landing> {
        let level = self.level(is_far);
        let there = self.at(guess);
        // proposes: a bracket, which is proved below
        let mut radius = 1.25 * (there.height - level).most() / (std::f64::consts::TAU * there.rate.mid().abs())
            + f64::EPSILON * (64.0 + self.phase.most());
        for _ in 0..3 {
            let (low, high) = (guess - radius, guess + radius);
            let rate = self.over(low, high).rate.signed(is_far);
            if !rate.is_positive() {
                return None;
            }
            let is_beyond = (self.at(high).height - level).signed(is_far).is_positive();
            if low > 0.0 && is_beyond && self.is_inside(self.at(low).height) {
                // V1: after the departure
                return if self.is_clear(low) { self.landing(is_far, guess, Span::new(low, high), rate) } else { None };
            }
            radius *= 1.5;
        }
        None
    }

    /// Encloses the first contacts in a bracket of times \[forcing periods\], with velocities `rate` towards the wall there.
    fn landing(&self, is_far: bool, guess: f64, bracket: Span, rate: Span) -> Option<Landing> {
        let guess = Span::point(guess);
        let (centre_sin, _) = (self.centre[0] + guess).sin_cos();
        // V36: the centre's wall is the middle one
        let (level, around) = self.level(is_far).centred_parts();
        let miss = self.drift * guess.turned() - centre_sin + self.centre_sin - level;
        let time = guess - miss.signed(is_far).over(rate.turned())?;
        let phase = self.centre[0] + time;
        let speed = (self.drift - phase.sin_cos().1).signed(is_far);
        let angle = bracket.turned();
        let bend = (self.phase + bracket).sin_cos().0.signed(is_far);
        let rate = rate.signed(is_far);
        let mut changes = [[Span::point(0.0); 2]; 5];
        changes[4][0] = Span::point(around.hi()).over(rate)?;
        let mut times = time + changes[4][0].unturned().around();
        let by = |[u, w]: Spot| {
            // The change of the drift counts once, so that the bounds show it if a side is contracted.
            let drift = w - self.sin * u;
            Some([(self.after * u - angle * drift).over(rate)?, drift.signed(is_far)])
        };
        for (side, change) in self.sides.into_iter().zip(&mut changes) {
            *change = by(side)?;
            times = times + (change[0] - side[0]).unturned().around();
        }
        let zero = Span::point(0.0);
        let units = [by([Span::point(1.0).turned(), zero])?, by([zero, self.restitution])?];
        let phase = if is_far { phase + Span::point(0.5) } else { phase };
        Some(Landing { centre: [phase, speed], bend, changes, units, times: times.common(bracket)? })
    }
}

impl Landing {
    /// Holds what the derivative at any of the states makes of a vector (V14).
    pub fn derivative(&self, [u, w]: Spot) -> Spot {
        let [[delay_u, speed_u], [delay_w, speed_w]] = self.units;
        self.sheared([u * delay_u + w * delay_w, u * speed_u + w * speed_w])
    }

    /// Holds the number and the slope that the image of the vector `(1, slope)` is a multiple of `(1, slope)` with; `None` where its phase may not change.
    /// (V14)
    pub fn direction(&self, slope: Span) -> Option<[Span; 2]> {
        let [[delay_u, speed_u], [delay_w, speed_w]] = self.units;
        let (delay, speed) = (delay_u + slope * delay_w, speed_u + slope * speed_w);
        Some([delay.unturned(), (self.bend + speed.over(delay)?).turned()])
    }

    /// Holds the image of the centre for all parameters (V14).
    pub fn image(&self) -> Spot {
        let [.., e, gap] = self.changes.map(|change| self.sheared(change).map(Span::around));
        [0, 1].map(|i| self.centre[i] + e[i] + gap[i])
    }

    /// A delay, an angle, and a change of speed at a fixed phase, as changes of phase and speed.
    fn sheared(&self, [delay, speed]: Spot) -> Spot {
        [delay.unturned(), speed + self.bend * delay]
    }

    /// Holds `n (x - q)` for all images `x` of a set that moves with `e` and `D`, the third side being that of `D`, where `q` moves as well (V36).
    pub fn beside(&self, [n, m]: Spot, [u, w]: Spot, moved: [Spot; 2]) -> Span {
        let sheared = n.unturned() + m * self.bend;
        let [a, b, gap, e, own_gap] = self.changes.map(|[delay, speed]| sheared * delay + m * speed);
        let [by_e, by_gap] = moved.map(|[u, w]| n * u + m * w);
        let centre = n * (self.centre[0] - u) + m * (self.centre[1] - w);
        [a, b, e - by_e, gap + own_gap - by_gap].into_iter().fold(centre, |sum, change| sum + change.around())
    }

    /// Holds `n (x - q)` for all images `x`.
    pub fn along(&self, [n, m]: Spot, [u, w]: Spot) -> Span {
        let sheared = n.unturned() + m * self.bend;
        let changes = self.changes.map(|[delay, speed]| (sheared * delay + m * speed).around());
        let centre = n * (self.centre[0] - u) + m * (self.centre[1] - w);
        changes.into_iter().fold(centre, |sum, change| sum + change)
    }
}
