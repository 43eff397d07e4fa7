//! Intervals of doubles, and sine and cosine over them (Lemma V11, doubles).

use std::ops::{Add, Mul, Neg, Sub};
use std::sync::OnceLock;

use impact_pair_exact::{Enclosure, Real};

/// Bits of what is rounded to doubles.
const BITS: u32 = 128;

/// All numbers between two finite doubles; where an operation fails both are NaN, which no comparison passes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    lo: f64,
    hi: f64,
}

/// `2 pi` lies between these: `PI` is the double below pi.
const TWO_PI: Span = Span { lo: std::f64::consts::TAU, hi: std::f64::consts::TAU.next_up() };
/// `1/(2 pi)` lies between these.
const INVERSE_TWO_PI: Span = Span { lo: 0.159_154_943_091_895_35_f64.next_down(), hi: 0.159_154_943_091_895_35 };
/// Bounds the errors of sine and cosine at a double.
const WAVE_ERROR: f64 = 1.0 / (1_u64 << 51) as f64; // exact: a power of two
/// Phases beyond these are not measured from their neighbours' quarters.
const LARGEST_PHASE: f64 = (1_u64 << 40) as f64; // exact: a power of two
/// Parts of a forcing period in the table of sines and cosines.
const TABLE_SIZE: usize = 256;

/// The least by which an end is moved, `2^-500`: products of two such are normal numbers, which processors are fast with.
pub(crate) const MIN_STEP: f64 = f64::from_bits((1023 - 500) << 52); // exact: a power of two

/// More than half of the way from a double to the next one. Lemma V11 (doubles)
#[inline(always)]
pub(crate) fn step(end: f64) -> f64 {
    const HALF_UNIT: f64 = f64::EPSILON / 2.0 * (1.0 + f64::EPSILON);
    end.abs() * HALF_UNIT + MIN_STEP
}

impl Span {
    pub const fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// Returns the numbers between two doubles.
    #[inline]
    pub fn new(lo: f64, hi: f64) -> Self {
        let is_finite = f64::MIN <= lo && lo <= hi && hi <= f64::MAX;
        if is_finite { Self { lo, hi } } else { Self { lo: f64::NAN, hi: f64::NAN } }
    }

    /// Ends that were rounded to nearest, each moved outward to the next double or beyond. Lemma V11 (doubles)
    fn outward(lo: f64, hi: f64) -> Self {
        Self::new(lo - step(lo), hi + step(hi))
    }

    /// Encloses what an exact number's enclosure does.
    pub fn of(x: &Enclosure) -> Self {
        let (lo, hi) = x.to_f64_bounds();
        Self::new(lo, hi)
    }

    /// `[-r, r]` for the greatest magnitude of its members.
    pub fn around(self) -> Self {
        let most = self.most();
        Self { lo: -most, hi: most }
    }

    /// Returns its middle, and `[-r, r]` for the others' distance from it.
    pub fn centred_parts(self) -> (Self, Self) {
        let middle = Self::point(self.mid());
        (middle, (self - middle).around())
    }

    pub fn lo(self) -> f64 {
        self.lo
    }

    pub fn hi(self) -> f64 {
        self.hi
    }

    /// Some number about the middle.
    pub fn mid(self) -> f64 {
        0.5 * (self.lo + self.hi)
    }

    /// Returns the greatest magnitude.
    pub fn most(self) -> f64 {
        self.lo.abs().max(self.hi.abs()) // V11: the farther end
    }

    pub fn is_positive(self) -> bool {
        self.lo > 0.0 // V11: not both are NaN
    }

    pub fn is_negative(self) -> bool {
        self.hi < 0.0 // V11: not both are NaN
    }

    pub fn hull(self, other: Self) -> Self {
        if other.lo.is_nan() {
            return other;
        }
        // V11: the outer ends; a comparison with NaN leaves it
        let lo = if other.lo < self.lo { other.lo } else { self.lo };
        Self { lo, hi: if other.hi > self.hi { other.hi } else { self.hi } }
    }

    /// Returns what is in both; `None` if nothing is.
    pub fn common(self, other: Self) -> Option<Self> {
        if self.lo.is_nan() || other.lo.is_nan() {
            // Not known is not nothing.
            return Some(Self { lo: f64::NAN, hi: f64::NAN });
        }
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi)); // V11: the inner ends, neither of them NaN
        (lo <= hi).then_some(Self { lo, hi })
    }

    /// The sum, of whose ends those that are doubles stay where they are. Lemma V11 (doubles)
    pub fn plus(self, other: Self) -> Self {
        let end = |a: f64, b: f64, outward: f64| {
            let sum = a + b;
            // V11: one of these differences is exact, so that the sum is
            if sum - a == b && sum - b == a { sum } else { sum + outward * step(sum) }
        };
        Self::new(end(self.lo, other.lo, -1.0), end(self.hi, other.hi, 1.0))
    }

    pub fn scaled(self, factor: f64) -> Self {
        self * Self::point(factor)
    }

    /// Returns the angle in radians of one in forcing periods.
    pub fn turned(self) -> Self {
        self * TWO_PI
    }

    /// Returns the angle in forcing periods of one in radians.
    pub fn unturned(self) -> Self {
        self * INVERSE_TWO_PI
    }

    /// `None` if the divisor may be 0.
    pub fn over(self, divisor: Self) -> Option<Self> {
        if !(divisor.is_positive() || divisor.is_negative()) {
            return None;
        }
        Some(Self::corners([self.lo / divisor.lo, self.lo / divisor.hi, self.hi / divisor.lo, self.hi / divisor.hi]))
    }

    pub fn signed(self, is_positive: bool) -> Self {
        if is_positive { self } else { -self }
    }

    /// Sine and cosine of a phase in forcing periods.
    pub fn waves_at(phase: f64) -> (Self, Self) {
        let whole = Self { lo: -1.0, hi: 1.0 };
        if phase.is_nan() || phase.abs() > LARGEST_PHASE {
            return (whole, whole);
        }
        let (sin, cos) = waves(phase);
        let near = |x: f64| Self::outward(x - WAVE_ERROR, x + WAVE_ERROR).common(whole).unwrap_or(whole); // V11: both hold it
        (near(sin), near(cos))
    }

    fn corners([a, b, c, d]: [f64; 4]) -> Self {
        // V11: the outer corners; either all are NaN or, their ends being finite, none is
        let least = |x: f64, y: f64| if x < y { x } else { y };
        let greatest = |x: f64, y: f64| if x > y { x } else { y }; // V11: the same
        Self::outward(least(least(a, b), least(c, d)), greatest(greatest(a, b), greatest(c, d)))
    }

    /// Sine and cosine of N forcing periods.
    pub fn sin_cos(self) -> (Self, Self) {
        let middle = self.mid();
        let whole = Self { lo: -1.0, hi: 1.0 };
        if middle.abs() > LARGEST_PHASE || self.lo.is_nan() {
            return (whole, whole);
        }
        let (sin, cos) = waves(middle);
        let radius = (self.hi - middle).max(middle - self.lo).next_up(); // V11: the farther end
        let angle = Self { lo: -radius, hi: radius }.turned();
        let bend = (angle * angle).around().scaled(0.5) + Self { lo: -WAVE_ERROR, hi: WAVE_ERROR };
        let near = |value: f64, slope: f64| {
            let slope = Self::point(slope.abs()) + Self::point(WAVE_ERROR);
            let spread = Self::point(value) + slope * angle + bend;
            spread.common(whole).unwrap_or(whole) // V11: both hold it
        };
        (near(sin, cos), near(cos, sin))
    }
}

impl Add for Span {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Add<&Self> for Span {
    type Output = Self;

    fn add(self, other: &Self) -> Self {
        self + *other
    }
}

impl Sub for Span {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::outward(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Sub<&Self> for Span {
    type Output = Self;

    fn sub(self, other: &Self) -> Self {
        self - *other
    }
}

impl Neg for Span {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl Mul for Span {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::corners([self.lo * other.lo, self.lo * other.hi, self.hi * other.lo, self.hi * other.hi])
    }
}

impl Mul<&Self> for Span {
    type Output = Self;

    fn mul(self, other: &Self) -> Self {
        self * *other
    }
}

/// Sine and cosine of `k/256` of a forcing period.
fn table() -> &'static [[f64; 2]; TABLE_SIZE] {
    static TABLE: OnceLock<[[f64; 2]; TABLE_SIZE]> = OnceLock::new();
    TABLE.get_or_init(|| {
        std::array::from_fn(|k| {
            let part = Real::pi(BITS) * k as i64 * &Real::point(impact_pair_exact::Dyadic::power_of_two(-7), BITS); // exact: an index
            [part.sin(), part.cos()].map(|x| x.to_f64())
        })
    })
}

/// Sine and cosine of `2 pi u`, `|u| <= 2^40`, each with an error below `WAVE_ERROR`.
fn waves(u: f64) -> (f64, f64) {
    let parts = TABLE_SIZE as f64; // exact: a power of two
    let nearest = (u * parts).round_ties_even(); // V11: the nearest of the table
    let rest = u - nearest / parts;
    let [sin, cos] = table()[(nearest as i64).rem_euclid(TABLE_SIZE as i64) as usize]; // exact: below 2^48, an index
    let y = std::f64::consts::TAU * rest;
    let square = y * y;
    let sine = y * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    let departure = 0.5 * square * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    (sin + (cos * sine - sin * departure), cos - (sin * sine + cos * departure))
}
