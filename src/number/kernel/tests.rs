//! Tests of the fast kernel: exact values, and Lemmas K1, K2, K3 against big integers.

use super::*;
use crate::exact::{Dyadic, Enclosure};

fn point(x: f64) -> Enclosure {
    Enclosure::from_f64_bounds(x, x).unwrap()
}

/// The angle of `u` forcing periods.
fn angle(u: &Enclosure, bits: u32) -> Enclosure {
    Enclosure::pi(bits).mul(u, bits).mul(&point(2.0), bits)
}

/// How far a value is from the truth, in units of a scale.
fn error(value: f64, truth: &Enclosure, scale: &Enclosure, bits: u32) -> f64 {
    point(value).sub(truth, bits).div(scale, bits).unwrap().mag().to_f64_up()
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
    let corners = [0.125, 0.375, 0.125_f64.next_down(), 0.125_f64.next_up(), 1e-300, (1_u64 << 40) as f64];
    let inputs = draws(8_000).flat_map(|v| [v, v * 200.0, v * (1_u64 << 40) as f64, v.powi(9) / 8.0]);
    let worst = inputs.chain(corners).fold([0.0_f64; 2], |worst, u| {
        let (angle, (sine, cosine)) = (angle(&point(u), 192), sin_cos(u));
        let one = point(1.0);
        [worst[0].max(error(sine, &angle.sin(192), &one, 192)), worst[1].max(error(cosine, &angle.cos(192), &one, 192))]
    });
    assert_honest("K1 sine", worst[0], SIN_COS_ERROR);
    assert_honest("K1 cosine", worst[1], SIN_COS_ERROR);
}

#[test]
fn k2_departures_keep_their_relative_bound() {
    // 1100 bits: at h = 2^-300 the excess is 2^-897 and must still have its 53 bits.
    for (bits, count, exponents) in [(320, 6_000, 0..40), (1100, 300, 40..300)] {
        let mut worst = [0.0_f64; 3];
        let inputs = draws(count).zip(exponents.cycle()).map(|(v, e)| 0.125 * v.abs() * 0.5_f64.powi(e));
        for h in inputs.chain([0.125, 0.125_f64.next_down()]).filter(|&h| h >= 0.5_f64.powi(300)) {
            let SmallAngle { versine, excess, sine } = departure(h);
            let angle = angle(&point(h), bits);
            let sin = angle.sin(bits);
            let truths = [point(1.0).sub(&angle.cos(bits), bits), angle.sub(&sin, bits), sin];
            for ((value, truth), worst) in [versine, excess, sine].into_iter().zip(truths).zip(&mut worst) {
                *worst = worst.max(error(value, &truth, &truth, bits));
            }
        }
        for (name, worst) in ["K2 versine", "K2 excess", "K2 sine"].into_iter().zip(worst) {
            assert_honest(name, worst, DEPARTURE_ERROR);
        }
    }
}

#[test]
fn k3_the_coarse_angle_keeps_its_bound() {
    // cos decreases on [0, 1/2]: compare q with the cosine at both ends of angle -+ bound.
    let half = Dyadic::power_of_two(-1);
    let within = |q: f64, bound: f64| {
        let [low, high] = [-bound, bound].map(|off| point(acos_coarse(q)).add(&point(off), 192));
        let (q, cosine) = (Dyadic::from_f64(q).unwrap(), |turns: &Enclosure| angle(turns, 192).cos(192));
        (*high.sup() > half || *cosine(&high).inf() <= q) && (low.inf().sign().is_lt() || q <= *cosine(&low).sup())
    };
    let inputs = draws(5_000).flat_map(|v| [v, (1.0 - v.abs().powi(9)).copysign(v)]);
    for q in inputs.chain([0.0, 1.0, -1.0, 1.0_f64.next_down(), -1.0_f64.next_down(), 1e-300]) {
        assert!(within(q, ACOS_ERROR), "at {q:e}");
        assert!((0.0..=0.5).contains(&acos_coarse(q)), "at {q:e}");
    }
    assert!(draws(500).any(|q| !within(q, ACOS_ERROR / 8.0)));
}
