//! Intervals of doubles beside the exact numbers, flights beside those of the walk (V1, V2 in other units and many bits).

use std::collections::HashSet;

use impact_pair_exact::{Dyadic, Exact, Real};
use impact_pair_model::{Harmonic, ImpactPair, Start, Wall};
use proptest::prelude::*;

use super::Law;
use super::beam::{FlightBundle, Quad, State};
use super::entropy::{at_least, exponential};
use super::guess::Guess;
use super::language::{Sets, is_above};
use super::region::Region;
use super::span::{MIN_STEP, Span, step};
use super::trap::mirrored;
use crate::Certificate;
use crate::check::data::{Data, Piece};
use crate::check::walk::Walk;

const BITS: u32 = 192;

fn pair(amplitude: &str, gap: &str, restitution: &str) -> ImpactPair {
    let [amplitude, gap, restitution] = [amplitude, gap, restitution].map(|x| x.parse().unwrap());
    let harmonic = Harmonic::new(amplitude, Exact::pi(), Exact::from(0)).unwrap();
    ImpactPair::new(harmonic, gap, restitution).unwrap()
}

/// Figures 14 and 16, and a pair with a gap wider than the stroke.
fn pairs() -> [ImpactPair; 3] {
    [pair("8", "9.42497", "0.5"), pair("20", "40", "0.6"), pair("1", "3", "0.9")]
}

pub(super) fn figure_14() -> Law {
    Law::of(&pairs()[0]).unwrap()
}

fn exact(x: f64) -> Exact {
    Exact::from_f64(x).unwrap()
}

/// The next impact of one state, mirrored, and whether it is on the far wall.
fn truth(pair: &ImpactPair, [phase, speed]: State) -> Option<(bool, [Real; 2])> {
    let harmonic = pair.harmonic("a test").unwrap();
    // One forcing period takes 2.
    let time = exact(phase).checked_mul(&Exact::from(2)).unwrap();
    let fastest = harmonic.amplitude().checked_mul(harmonic.frequency()).unwrap();
    let velocity = exact(-speed).checked_mul(&fastest).unwrap();
    let start = Start::on_wall(time, Wall::Left, velocity).unwrap();
    let data = Data::new(pair, &start).unwrap();
    let certificate = Certificate::of_start(pair.clone(), start);
    let walk = Walk::new(&certificate, &data, &Piece::default(), BITS);
    let landing = walk.next_landing()?;
    let turn = Real::pi(BITS) * 2;
    let phase = walk.absolute(&landing.phase.hull()).over(&turn)?;
    let velocity = landing.velocity.hull().over(&Real::of(harmonic.amplitude(), BITS))?;
    Some((landing.wall == Wall::Right, mirrored(landing.wall, phase, velocity)))
}

/// Returns whether an interval of doubles contains an exact one.
fn holds(span: Span, x: &Real) -> bool {
    let [low, high] = [span.lo(), span.hi()].map(|end| Dyadic::from_f64(end).expect("a finite end"));
    low <= *x.enclosure().inf() && *x.enclosure().sup() <= high
}

fn real(x: f64) -> Real {
    Real::point(Dyadic::from_f64(x).unwrap(), BITS)
}

#[test]
fn failed_operations_stay_failed() {
    let (none, one) = (Span::new(1.0, f64::INFINITY), Span::point(1.0));
    for span in
        [none + one, none * one, none.hull(one), one.hull(none), none.common(one).unwrap(), one.common(none).unwrap()]
    {
        assert!(span.lo().is_nan() && span.hi().is_nan() && !span.is_positive() && !span.is_negative());
    }
    assert!(Span::point(f64::MAX).scaled(2.0).lo().is_nan() && Span::point(0.0).over(one - one).is_none());
}

#[test]
fn turns_and_radians() {
    let turn = Real::pi(BITS) * 2;
    assert!(holds(Span::point(1.0).turned(), &turn));
    let inverse = Real::int(1, BITS).over(&turn).unwrap();
    assert!(holds(Span::point(1.0).unturned(), &inverse));
}

/// Two words of two impacts: half of log 2. One of one and one of two: the golden mean's logarithm. One word, or two that do not
/// follow one another: no entropy.
#[test]
fn entropies_of_small_graphs() {
    assert_eq!(at_least(&[(0, 0, 2), (0, 0, 2)], 1).unwrap(), "0.3465");
    assert_eq!(at_least(&[(0, 1, 1), (1, 0, 1), (0, 0, 1)], 2).unwrap(), "0.4812");
    assert_eq!(at_least(&[(0, 0, 1)], 1), None);
    assert_eq!(at_least(&[(0, 1, 1), (0, 1, 2)], 2), None);
    assert_eq!(at_least(&[], 3), None);
}

#[test]
fn the_exponential() {
    let e = exponential(&Real::int(1, 256));
    // 2.718281828459045235360287471352662497757 (NIST DLMF 4.2.11)
    let published: Exact = "2.718281828459045235360287471352662497757".parse().unwrap();
    let off = (e - &Real::of(&published, 256)).enclosure().mag();
    assert!(off < Dyadic::power_of_two(-127) && off > Dyadic::power_of_two(-133));
    let [two, five] = [2, 5].map(|n| exponential(&Real::int(n, 256)));
    let seven = exponential(&Real::int(7, 256));
    assert!((two * &five - &seven).is_across());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// V11 (doubles): an end is moved to the next double at least, and hardly farther, of powers of two and subnormal numbers as well.
    #[test]
    fn ends_are_moved_to_the_next_double_at_least(
        bits in any::<u64>(), exponent in 0..2046u64, rest in prop_oneof![Just(0), Just(1), Just((1 << 52) - 1), 0..1u64 << 52],
    ) {
        for x in [f64::from_bits(bits), f64::from_bits(exponent << 52 | rest)] {
            let (below, above) = (x - step(x), x + step(x));
            if x.is_finite() {
                prop_assert!(below <= x.next_down() && x.next_up() <= above, "{x:e}");
                let close = |x: f64| x.abs() * 4.0 * f64::EPSILON + 2.0 * MIN_STEP;
                prop_assert!((above - x).max(x - below) <= close(x), "{x:e}");
            }
        }
    }

    #[test]
    fn sums_products_and_quotients(a in prop::array::uniform2(-9.0..9.0f64), b in prop::array::uniform2(-9.0..9.0f64), s in 0.0..=1.0f64, t in 0.0..=1.0f64) {
        let span = |[x, y]: [f64; 2]| if x < y { Span::new(x, y) } else { Span::new(y, x) };
        let member = |span: Span, t: f64| (span.lo() + t * (span.hi() - span.lo())).clamp(span.lo(), span.hi());
        let (a, b) = (span(a), span(b));
        let (x, y) = (real(member(a, s)), real(member(b, t)));
        prop_assert!(holds(a + b, &(x.clone() + &y)) && holds(a - b, &(x.clone() - &y)) && holds(a * b, &(x.clone() * &y)));
        match a.over(b) {
            Some(quotient) => prop_assert!(holds(quotient, &x.over(&y).unwrap())),
            None => prop_assert!(b.lo() <= 0.0 && b.hi() >= 0.0),
        }
    }

    #[test]
    fn sines_and_cosines(
        middle in prop_oneof![-3.0..3.0f64, (-1024..1024i32).prop_map(|k| f64::from(k) / 512.0), -1e9..1e9f64],
        radius in prop_oneof![Just(0.0), 1e-17..1e-15f64, 1e-6..1e-3f64, 0.0..0.6f64], at in -1.0..=1.0f64,
    ) {
        let span = Span::new(middle - radius, middle + radius);
        let member = (middle + at * radius).clamp(span.lo(), span.hi());
        let angle = real(member) * &(Real::pi(BITS) * 2);
        let (sin, cos) = span.sin_cos();
        prop_assert!(holds(sin, &angle.sin()) && holds(cos, &angle.cos()), "{span:?} {sin:?} {cos:?}");
        // The derivative by the phase is at most 2 pi; the rest is rounding, that of the ends included.
        let width = 4.0 * std::f64::consts::PI * radius + 1e-14 * (1.0 + middle.abs());
        prop_assert!(radius > 1e-15 || sin.hi() - sin.lo() < width);
    }

    /// V11, sets: whatever lands, lands in the image, in all directions, and in time.
    #[test]
    fn images_hold_those_of_their_members(
        which in 0..3usize, phase in 0.0..1.0f64, speed in 0.02..1.6f64,
        size in prop_oneof![Just(1e-6), Just(1e-4), 1e-3..1e-2f64], turned in 0.0..6.3f64, thin in 0.001..1.0f64,
        (a, b) in (0.0..=1.0f64, 0.0..=1.0f64), skew in -0.5..0.5f64, corner in any::<bool>(),
    ) {
        let pair = &pairs()[which];
        let law = Law::of(pair).unwrap();
        let (sin, cos) = turned.sin_cos();
        let state = |end: f64, sign: f64| {
            let half = sign * 0.2 * size * thin * (1.0 + skew * end);
            [phase + size * end * cos - half * sin, speed + size * end * sin + half * cos]
        };
        let states = [state(-1.0, -1.0), state(-1.0, 1.0), state(1.0, -1.0), state(1.0, 1.0)];
        let quad = Quad { corners: states.map(|state| state.map(Span::point)) };
        let (a, b) = if corner { (a.round(), b.round()) } else { (a, b) };
        let mix = |i: usize| (1.0 - a) * ((1.0 - b) * states[0][i] + b * states[1][i]) + a * ((1.0 - b) * states[2][i] + b * states[3][i]);
        let member = [mix(0), mix(1)];
        let landed = Guess::new(&law).map(quad.middle()).and_then(|image| {
            Some((image.is_far, FlightBundle::new(&law, &quad).land(image.is_far, image.time)?))
        });
        if let (Some((is_far, landing)), Some((is_truly_far, [u, w]))) = (landed, truth(pair, member)) {
            prop_assert_eq!(is_far, is_truly_far);
            let lasted = u.clone() - &real(member[0]) - &real(if is_far { 0.5 } else { 0.0 });
            // A member is rounded.
            let near = |span: Span, x: &Real| holds(span + Span::new(-1e-13, 1e-13), x);
            prop_assert!(near(landing.times, &lasted), "{:?} {lasted:?}", landing.times);
            let zero = [0.0; 2].map(Span::point);
            for [n, m] in [[1.0, 0.0], [0.0, 1.0], [cos, sin], [-sin, cos]] {
                let found = landing.along([n, m].map(Span::point), zero);
                let expected = real(n) * &u + &(real(m) * &w);
                prop_assert!(near(found, &expected), "{found:?} {expected:?}");
            }
        }
    }

    /// V16: the box that a flight lands in is among those reached on its wall, however finely boxes are cut.
    #[test]
    fn boxes_that_are_reached_are_named_by_their_wall(
        which in 0..3usize, column in 0..64i64, row in prop_oneof![Just(0), 0..12i64], (a, b) in (0.0..=1.0f64, 0.0..=1.0f64),
        halvings in 0..3u32,
    ) {
        let pair = &pairs()[which];
        let law = Law::of(pair).unwrap();
        let all: Vec<[i64; 2]> = (0..64).flat_map(|column| (0..64).map(move |row| [column, row])).collect();
        let region = Region::new(64, 8, all.iter().copied());
        let Some(reached) = region.reached(&law, &Guess::new(&law), [column, row], halvings) else { return Ok(()) };
        let member = [(column as f64 + a) / 64.0, (row as f64 + b) / 8.0];
        if let Some((is_far, [u, w])) = truth(pair, member) {
            let cell = [((u.to_f64() * 64.0).floor() as i64).rem_euclid(64), (w.to_f64() * 8.0).floor() as i64];
            let number = all.iter().position(|own| *own == cell).unwrap() as u32;
            prop_assert!(reached[usize::from(is_far)].contains(&number), "{member:?} {cell:?}");
        }
    }

    /// V11, closed: the box that a flight lands in cannot be left out.
    #[test]
    fn no_box_that_is_reached_can_be_left_out(
        which in 0..3usize, column in 0..64i64, row in prop_oneof![Just(0), 0..12i64], (a, b) in (0.0..=1.0f64, 0.0..=1.0f64),
    ) {
        let pair = &pairs()[which];
        let law = Law::of(pair).unwrap();
        let guess = Guess::new(&law);
        let all: HashSet<[i64; 2]> = (0..64).flat_map(|column| (0..64).map(move |row| [column, row])).collect();
        let member = [(column as f64 + a) / 64.0, (row as f64 + b) / 8.0];
        let is_closed = |boxes: HashSet<[i64; 2]>| Region::new(64, 8, boxes).times(&law, &guess, [column, row]);
        let Ok(times) = is_closed(all.clone()) else { return Ok(()) };
        if let Some((is_far, [u, w])) = truth(pair, member) {
            let (u, w) = (u.to_f64(), w.to_f64());
            let lasted = u - member[0] - if is_far { 0.5 } else { 0.0 };
            prop_assert!(times.lo() <= lasted + 1e-12 && lasted <= times.hi() + 1e-12, "{times:?} {lasted}");
            let reached = [((u * 64.0).floor() as i64).rem_euclid(64), (w * 8.0).floor() as i64];
            let left: HashSet<[i64; 2]> = all.into_iter().filter(|cell| *cell != reached).collect();
            prop_assert!(is_closed(left).is_err(), "{member:?} {reached:?}");
        }
    }
}

/// V11, closed: an upper end on an edge is in the closed box below, and one beyond it is not.
#[test]
fn an_upper_end_on_an_edge_is_in_the_box_below() {
    let region = Region::new(64, 8, [[3, 5], [63, 5]]);
    let holds =
        |phase: [f64; 2], speed: [f64; 2]| region.holds(Span::new(phase[0], phase[1]), Span::new(speed[0], speed[1]));
    let (phase, speed) = ([3.0 / 64.0, 4.0 / 64.0], [5.0 / 8.0, 6.0 / 8.0]);
    assert!(holds(phase, speed) && holds([1.99, 2.0], speed) && holds([phase[0]; 2], [speed[0]; 2]));
    assert!(!holds([phase[0], phase[1].next_up()], speed) && !holds(phase, [speed[0], speed[1].next_up()]));
    assert!(!holds([phase[0].next_down(), phase[1]], speed) && !holds(phase, [speed[0].next_down(), speed[1]]));
}

proptest! {
    /// V11, doubles: the sum holds the exact one, and ends that are doubles stay.
    #[test]
    fn sums_of_few_bits_are_exact(a in any::<i32>(), b in any::<i32>(), c in -1e3..1e3f64, m in -60..60i32, n in -60..60i32) {
        let exact = |x: f64| num_rational::BigRational::from_float(x).unwrap();
        let (a, b) = (f64::from(a) * 2f64.powi(m), f64::from(b) * 2f64.powi(n));
        for (a, b) in [(a, b), (a, c), (c, b)] {
            let sum = Span::point(a).plus(Span::point(b));
            let whole = exact(a) + exact(b);
            prop_assert!(exact(sum.lo()) <= whole && whole <= exact(sum.hi()));
            prop_assert_eq!(exact(a + b) == whole, sum.lo() == sum.hi());
        }
    }
}

/// V16: no two letters of a kind in a row, whose words are the Fibonacci numbers; a slower growth is not proved, by counts nor by all sets.
#[test]
fn words_grow_by_the_golden_mean() {
    let edges = [[vec![1], vec![0]], [vec![], vec![0]]];
    let sets = Sets::of(&edges).unwrap();
    let counts = sets.counts(30);
    assert_eq!(counts[..5].iter().map(ToString::to_string).collect::<Vec<_>>(), ["2", "3", "5", "8", "13"]);
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let decimal = |x: f64| num_rational::BigRational::from_float(x).unwrap();
    assert!(is_above(&sets, &counts, &decimal(golden.ln() + 1e-9)));
    assert!(!is_above(&sets, &counts, &decimal(golden.ln() - 1e-9)));
    // All words: no growth below that of two letters is proved by fewer of them.
    let all = Sets::of(&[[vec![0], vec![0]]]).unwrap();
    assert!(!is_above(&all, &all.counts(9), &decimal(0.69)) && is_above(&all, &all.counts(9), &decimal(0.694)));
}
