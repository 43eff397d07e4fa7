//! Tests of the fast kernel: exact values, and Lemmas K1, K2, K3 against big integers.

use super::*;
use num_bigint::BigInt;

/// Fixed point with `bits` fractional bits: an oracle that shares nothing with the code above.
struct Oracle {
    bits: usize,
    tau: BigInt,
}

impl Oracle {
    fn new(bits: usize) -> Self {
        // Machin: pi/4 = 4 atan(1/5) - atan(1/239).
        let atan_of_inverse = |n: u32| {
            let mut power = (BigInt::from(1) << bits) / n;
            let mut sum = power.clone();
            for i in (3_u32..).step_by(2) {
                power = -power / (n * n);
                if power == BigInt::ZERO {
                    break;
                }
                sum += &power / i;
            }
            sum
        };
        let tau = (atan_of_inverse(5) * 4 - atan_of_inverse(239)) * 8;
        Self { bits, tau }
    }

    fn exact(&self, value: f64) -> BigInt {
        if value == 0.0 {
            return BigInt::ZERO;
        }
        let exponent = (value.to_bits() >> 52 & 0x7ff) as i64;
        let significand = BigInt::from((value.to_bits() & ((1 << 52) - 1)) | 1 << 52);
        let shift = self.bits as i64 + exponent - 1075;
        let size = if shift < 0 { significand >> -shift } else { significand << shift };
        if value < 0.0 { -size } else { size }
    }

    /// `(sin 2 pi u, cos 2 pi u)`, by Taylor's series after taking off whole periods.
    fn sin_cos(&self, u: &BigInt) -> (BigInt, BigInt) {
        let one = BigInt::from(1) << self.bits;
        let whole: BigInt = (u * 2 + &one) >> (self.bits + 1);
        let angle = ((u - (whole << self.bits)) * &self.tau) >> self.bits;
        let (mut term, mut sin, mut cos) = (one.clone(), BigInt::ZERO, one);
        for i in 1_u32.. {
            term = ((term * &angle) >> self.bits) / i;
            if i > 20 && term.bits() < 4 {
                return (sin, cos);
            }
            match i % 4 {
                0 => cos += &term,
                1 => sin += &term,
                2 => cos -= &term,
                _ => sin -= &term,
            }
        }
        unreachable!()
    }

    fn ratio(&self, error: &BigInt, scale: &BigInt) -> f64 {
        let ratio = (error.magnitude().clone() << 100_u32) / scale.magnitude().clone();
        ratio.to_string().parse::<f64>().unwrap() / 2.0_f64.powi(100)
    }
}

fn draws(count: usize) -> impl Iterator<Item = f64> {
    // A fixed linear congruence (Knuth's MMIX); values in [-1, 1).
    let step = |s: &u64| Some(s.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407));
    std::iter::successors(Some(2026), step).map(|s| (s as i64 >> 10) as f64 / (1_u64 << 53) as f64).take(count)
}

/// The bound holds, and is not silly: some error exceeds an eighth of it.
fn assert_honest(name: &str, worst: f64, bound: f64) {
    println!("{name}: worst error {:.3} of the bound", worst / bound);
    assert!(bound / 8.0 < worst && worst <= bound, "{name}: worst error {worst:e}, bound {bound:e}");
}

#[test]
fn quarter_periods_and_symmetries_are_exact() {
    let far = (1_u64 << 40) as f64;
    for whole in [0.0, 1.0, -1.0, 12345.0, far - 1.0, 1.0 - far] {
        let corners = [0.0, 0.25, 0.5, 0.75].map(|quarter| sin_cos(whole + quarter));
        assert_eq!(corners, [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)]);
    }
    for u in draws(20_000).flat_map(|v| [v, v * 100.0, v * far]).chain([0.125, 0.375, 0.625, 2.125]) {
        let (s, c) = sin_cos(u);
        assert_eq!(sin_cos(-u), (-s, c), "at {u}");
        assert!(s.abs() <= 1.0 && c.abs() <= 1.0, "at {u}");
    }
    assert_eq!(departure(0.0), SmallAngle { versine: 0.0, excess: 0.0, sine: 0.0 });
    assert_eq!([1.0, -1.0].map(acos_coarse), [0.0, 0.5]);
}

#[test]
fn k1_sine_and_cosine_keep_their_bound() {
    let oracle = Oracle::new(192);
    let one = BigInt::from(1) << 192;
    let corners = [0.125, 0.375, 0.125_f64.next_down(), 0.125_f64.next_up(), 1e-300, (1_u64 << 40) as f64];
    let inputs = draws(8_000).flat_map(|v| [v, v * 200.0, v * (1_u64 << 40) as f64, v.powi(9) / 8.0]);
    let worst = inputs.chain(corners).fold([0.0_f64; 2], |worst, u| {
        let (s, c) = oracle.sin_cos(&oracle.exact(u));
        let (sine, cosine) = sin_cos(u);
        let error = |value: f64, truth: BigInt| oracle.ratio(&(oracle.exact(value) - truth), &one);
        [worst[0].max(error(sine, s)), worst[1].max(error(cosine, c))]
    });
    assert_honest("K1 sine", worst[0], SIN_COS_ERROR);
    assert_honest("K1 cosine", worst[1], SIN_COS_ERROR);
}

#[test]
fn k2_departures_keep_their_relative_bound() {
    // 1100 bits: at h = 2^-300 the excess is 2^-897 and must still have its 53 bits.
    for (bits, count, exponents) in [(320, 6_000, 0..40), (1100, 300, 40..300)] {
        let oracle = Oracle::new(bits);
        let mut worst = [0.0_f64; 3];
        let inputs = draws(count).zip(exponents.cycle()).map(|(v, e)| 0.125 * v.abs() * 0.5_f64.powi(e));
        for h in inputs.chain([0.125, 0.125_f64.next_down()]).filter(|&h| h >= 0.5_f64.powi(300)) {
            let SmallAngle { versine, excess, sine } = departure(h);
            let turns = oracle.exact(h);
            let (s, c) = oracle.sin_cos(&turns);
            let truths = [(BigInt::from(1) << bits) - c, ((turns * &oracle.tau) >> bits) - &s, s];
            for ((value, truth), worst) in [versine, excess, sine].into_iter().zip(truths).zip(&mut worst) {
                *worst = worst.max(oracle.ratio(&(oracle.exact(value) - &truth), &truth));
            }
        }
        for (name, worst) in ["K2 versine", "K2 excess", "K2 sine"].into_iter().zip(worst) {
            assert_honest(name, worst, DEPARTURE_ERROR);
        }
    }
}

#[test]
fn k3_the_coarse_angle_keeps_its_bound() {
    let oracle = Oracle::new(192);
    // cos decreases on [0, 1/2]: compare q with the cosine at both ends of angle -+ bound.
    let within = |q: f64, bound: f64| {
        let (angle, bound, q) = (oracle.exact(acos_coarse(q)), oracle.exact(bound), oracle.exact(q));
        let half: BigInt = BigInt::from(1) << 191;
        let cosine = |turns: BigInt| oracle.sin_cos(&turns.clamp(BigInt::ZERO, half.clone())).1;
        let slack = BigInt::from(1) << 40;
        cosine(&angle + &bound) <= &q + &slack && q <= cosine(angle - bound) + slack
    };
    let inputs = draws(5_000).flat_map(|v| [v, (1.0 - v.abs().powi(9)).copysign(v)]);
    for q in inputs.chain([0.0, 1.0, -1.0, 1.0_f64.next_down(), -1.0_f64.next_down(), 1e-300]) {
        assert!(within(q, ACOS_ERROR), "at {q:e}");
        assert!((0.0..=0.5).contains(&acos_coarse(q)), "at {q:e}");
    }
    assert!(draws(500).any(|q| !within(q, ACOS_ERROR / 8.0)));
}
