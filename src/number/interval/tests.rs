//! Lemmas I1 and I4, in exact fractions: ends are zeros of both signs, the least doubles, the greatest, the infinities, neighbours.

use super::*;
use crate::exact::Dyadic;
use num_rational::BigRational;
use num_traits::Zero;
use proptest::prelude::*;

/// A finite double, corners first.
fn end() -> impl Strategy<Value = f64> + Clone {
    let size = prop_oneof![
        2 => Just(0.0),
        2 => (1..64u64).prop_map(f64::from_bits),
        1 => Just(f64::MIN_POSITIVE),
        1 => (0..3u64).prop_map(|below| f64::from_bits(f64::MAX.to_bits() - below)),
        2 => (-1074..1024i32).prop_map(|n| 2f64.powi(n)),
        2 => (-3..4i64).prop_map(|off| f64::from_bits(1f64.to_bits().wrapping_add_signed(off))),
        2 => 0.0..4.0f64,
        2 => (0..f64::INFINITY.to_bits()).prop_map(f64::from_bits),
    ];
    (size, any::<bool>()).prop_map(|(size, is_negative)| if is_negative { -size } else { size })
}

/// An interval and finite members: both ends, where they are finite, and others.
fn members() -> impl Strategy<Value = (Interval, [f64; 4])> {
    let shape = prop_oneof![3 => Just(0), 2 => Just(1), 2 => Just(2), 1 => Just(3), 1 => Just(4), 1 => Just(5)];
    (end(), end(), shape, end()).prop_map(|(a, b, shape, c)| {
        let x = match shape {
            0 => Interval::new(a.min(b), a.max(b)),
            1 => Interval::point(a),
            2 => Interval::new(a, a.next_up()),
            3 => Interval::new(a, f64::INFINITY),
            4 => Interval::new(f64::NEG_INFINITY, a),
            _ => Interval::ENTIRE,
        };
        let finite = |x: f64| x.clamp(f64::MIN, f64::MAX);
        (x, [finite(x.inf), finite(x.sup), x.mid(), finite(c.clamp(x.inf, x.sup))])
    })
}

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("a finite double")
}

/// Returns whether `x` is an interval, and `value` one of its members.
fn holds(x: Interval, value: &BigRational) -> bool {
    let is_interval = x.inf <= x.sup && x.inf < f64::INFINITY && x.sup > f64::NEG_INFINITY;
    let above = x.inf == f64::NEG_INFINITY || exact(x.inf) <= *value;
    is_interval && above && (x.sup == f64::INFINITY || *value <= exact(x.sup))
}

/// Returns whether the ends are no farther out than the doubles next to the rounded `least` and `greatest`.
fn is_tight(x: Interval, least: &BigRational, greatest: &BigRational) -> bool {
    let [inf, sup] = [x.inf.next_up().next_up(), x.sup.next_down().next_down()];
    !(inf.is_finite() && sup.is_finite()) || *least <= exact(inf) && exact(sup) <= *greatest
}

fn is_all(x: Option<Interval>, of: impl Fn(f64) -> bool, members: &[f64]) -> bool {
    members.iter().filter(|&&member| of(member)).all(|&member| x.is_some_and(|x| holds(x, &exact(member))))
}

proptest! {
    /// Lemma I4.
    #[test]
    fn operations_hold_the_results_of_all_members((x, a) in members(), (y, b) in members()) {
        let quotients = x.checked_div(y);
        prop_assert!(quotients.is_none() || !y.contains(0.0));
        for (a, b) in a.iter().flat_map(|a| b.iter().map(move |b| (*a, *b))) {
            let (p, q) = (exact(a), exact(b));
            prop_assert!(holds(x + y, &(&p + &q)), "{x:?} + {y:?}: {:?} {a:e} {b:e}", x + y);
            prop_assert!(holds(x - y, &(&p - &q)), "{x:?} - {y:?}: {:?} {a:e} {b:e}", x - y);
            prop_assert!(holds(x * y, &(&p * &q)), "{x:?} * {y:?}: {:?} {a:e} {b:e}", x * y);
            prop_assert!(holds(x.scaled(b), &(&p * &q)), "{b:e} {x:?}: {:?} {a:e}", x.scaled(b));
            prop_assert!(quotients.is_none_or(|found| holds(found, &(&p / &q))), "{x:?} / {y:?}: {quotients:?}");
            prop_assert!(holds(x.hull(y), &p) && holds(x.hull(y), &q));
        }
        let (xs, ys) = ([x.inf, x.sup], [y.inf, y.sup]);
        if [xs, ys].concat().iter().all(|end| end.is_finite()) {
            let [xs, ys] = [xs, ys].map(|ends| ends.map(exact));
            prop_assert!(is_tight(x + y, &(&xs[0] + &ys[0]), &(&xs[1] + &ys[1])));
            prop_assert!(is_tight(x - y, &(&xs[0] - &ys[1]), &(&xs[1] - &ys[0])));
            let all = |of: &dyn Fn(&BigRational, &BigRational) -> BigRational| {
                let mut all: Vec<_> = xs.iter().flat_map(|x| ys.iter().map(move |y| of(x, y))).collect();
                all.sort();
                [all[0].clone(), all[3].clone()]
            };
            let products = all(&|x, y| x * y);
            prop_assert!(is_tight(x * y, &products[0], &products[1]), "{x:?} * {y:?}: {:?}", x * y);
            if let Some(found) = quotients {
                let quotients = all(&|x, y| x / y);
                prop_assert!(is_tight(found, &quotients[0], &quotients[1]), "{x:?} / {y:?}: {found:?}");
            }
        }
    }

    /// Lemma I4.
    #[test]
    fn functions_hold_the_values_of_all_members((x, a) in members(), (y, b) in members(), cut in end()) {
        let roots = x.sqrt();
        for a in a {
            let p = exact(a);
            prop_assert!(holds(-x, &-&p) && holds(x.signed(-1.0), &-&p) && holds(x.signed(1.0), &p));
            prop_assert!(holds(x.abs(), &exact(a.abs())) && x.abs().inf >= 0.0, "|{x:?}|: {:?}", x.abs());
            prop_assert!(holds(x.sqr(), &(&p * &p)) && x.sqr().inf >= 0.0, "{x:?}: {:?}", x.sqr());
            let square = |x: f64| if x.is_finite() { exact(x) * exact(x) } else { p.clone() };
            let is_root = roots.is_some_and(|root| root.inf >= 0.0 && square(root.inf) <= p && p <= square(root.sup));
            prop_assert!(a < 0.0 || is_root, "{x:?}: {roots:?}");
            prop_assert!(x.contains(a) && a.abs() <= x.mag());
            prop_assert!(x.sign().is_none_or(|sign| a.partial_cmp(&0.0) == Some(sign)));
        }
        prop_assert!(x.sign().is_some() || x.contains(0.0));
        prop_assert!(x.contains(x.mid()) && x.mid().is_finite());
        prop_assert!(!x.is_common_interval() || !x.wid().is_finite() || exact(x.sup) - exact(x.inf) <= exact(x.wid()));
        prop_assert!(x.is_common_interval() == (x.inf.is_finite() && x.sup.is_finite()) && (x.wid() == 0.0) == (x.inf == x.sup));
        let all = [a, b].concat();
        prop_assert!(is_all(x.intersection(y), |m| x.contains(m) && y.contains(m), &all));
        prop_assert!(is_all(x.at_least(cut), |m| x.contains(m) && m >= cut, &all));
        prop_assert!(is_all(x.at_most(cut), |m| x.contains(m) && m <= cut, &all));
        prop_assert!(x.at_least(f64::NAN) == Some(x) && x.at_most(f64::NAN) == Some(x));
        let ball = Ball::from(x);
        prop_assert!(!ball.rad().is_finite() || a.iter().all(|&a| (exact(a) - exact(ball.mid())) <= exact(ball.rad())));
        prop_assert!(!ball.rad().is_finite() || a.iter().all(|&a| (exact(ball.mid()) - exact(a)) <= exact(ball.rad())));
    }

    /// The ends of a ball, in exact fractions.
    #[test]
    fn a_ball_is_held(mid in end(), rad in end()) {
        let x = Interval::from(Ball::new(mid, rad.abs()));
        prop_assert!(holds(x, &(exact(mid) + exact(rad.abs()))) && holds(x, &(exact(mid) - exact(rad.abs()))));
    }

    /// Lemma I1.
    #[test]
    fn waves_hold_those_of_their_members((x, member) in phases()) {
        let angle = Enclosure::pi(200).mul(&Enclosure::point(Dyadic::from_f64(2.0 * member).unwrap()), 400);
        for (found, truth) in [(x.sin(), angle.sin(160)), (x.cos(), angle.cos(160))] {
            let bounds = Enclosure::from_f64_bounds(found.inf, found.sup).unwrap();
            // The truth is known to 2^-160 of itself, or so: its ends are not both outside.
            prop_assert!(bounds.intersection(&truth).is_some(), "{x:?} {member:e}: {found:?}");
            prop_assert!(found.inf >= -1.0 && found.sup <= 1.0 && found.inf <= found.sup);
            prop_assert!(x.wid() > 0.0 || found.wid() < 4.0 * f64::EPSILON, "{x:?}: {found:?}");
        }
    }
}

/// Phases and members: ends at quarter periods and next to them, small or some 2^39 periods away, widths from nothing to periods.
fn phases() -> impl Strategy<Value = (Interval, f64)> {
    let near = prop_oneof![Just(0.0), Just(1e-300), Just(f64::EPSILON), -1e-9..1e-9f64, -0.3..0.3f64];
    let quarter = prop_oneof![3 => -9..9i64, 1 => -(1i64 << 41)..1i64 << 41];
    let width = prop_oneof![Just(0.0), 0.0..1e-12f64, 0.0..0.3f64, Just(0.25), Just(0.5), 0.0..1.1f64];
    (quarter, near, width, prop_oneof![Just(0.0), Just(1.0), 0.0..1.0f64]).prop_map(|(quarter, near, width, at)| {
        let inf = quarter as f64 / 4.0 + near;
        let sup = inf + width;
        (Interval::new(inf, sup), (inf + at * width).clamp(inf, sup))
    })
}

#[test]
fn invalid_ends_give_the_whole_line() {
    let (inf, nan) = (f64::INFINITY, f64::NAN);
    for (a, b) in [(1.0, 0.0), (nan, 0.0), (0.0, nan), (nan, nan), (inf, inf), (-inf, -inf), (inf, -inf)] {
        assert_eq!(Interval::new(a, b), Interval::ENTIRE);
    }
    for x in [nan, inf, -inf] {
        assert_eq!(Interval::point(x), Interval::ENTIRE);
        assert_eq!(Interval::ONE.scaled(x), Interval::ENTIRE);
        assert_eq!(Interval::from(Ball::new(x, 0.0)), Interval::ENTIRE);
    }
    assert_eq!(Interval::within(-1.0), Interval::ENTIRE);
    assert_eq!(Interval::from(Ball::new(1.0, nan)), Interval::ENTIRE);
    assert_eq!(Interval::ZERO * Interval::ENTIRE, Interval::ENTIRE);
    assert_eq!(Interval::ENTIRE.scaled(0.0), Interval::ENTIRE);
    let half_line = Interval::new(0.0, inf);
    assert!((half_line * half_line).contains(f64::MAX) && (half_line * half_line).inf() >= -f64::from_bits(1));
    assert_eq!(half_line.at_least(inf), None);
    assert_eq!(Interval::ENTIRE.mid(), 0.0);
    assert_eq!(Interval::from(Ball::from(Interval::ENTIRE)), Interval::ENTIRE);
}

#[test]
fn nothing_is_known_of_waves_beyond_the_kernel() {
    for far in [2f64.powi(41), f64::MAX, f64::INFINITY] {
        assert_eq!((Interval::new(0.0, far).sin(), Interval::new(-far, 0.0).cos()), (Interval::RANGE, Interval::RANGE));
    }
    assert_eq!(Interval::point(2f64.powi(41)).sin(), Interval::RANGE);
}

#[test]
fn extrema_inside_are_seen() {
    assert_eq!(Interval::new(0.4, 0.6).cos().inf(), -1.0);
    assert_eq!(Interval::new(-0.1, 0.1).cos().sup(), 1.0);
    assert_eq!(Interval::new(0.2, 0.3).sin().sup(), 1.0);
    assert_eq!(Interval::new(-0.3, -0.2).sin().inf(), -1.0);
    assert!(Interval::new(0.1, 0.4).cos().sup() < 1.0 && Interval::new(0.3, 0.7).sin().inf() < 0.0);
}

#[test]
fn constants_hold_what_they_are_called() {
    let held = |x: Interval, truth: Enclosure| Enclosure::from_f64_bounds(x.inf, x.sup).unwrap().hull(&truth);
    let pi = Enclosure::pi(200);
    let tau = pi.mul(&Enclosure::point(Dyadic::from_f64(2.0).unwrap()), 200);
    // The hull with the truth adds nothing.
    assert_eq!(held(Interval::PI, pi).to_f64_bounds(), (Interval::PI.inf, Interval::PI.sup));
    assert_eq!(held(Interval::TAU, tau).to_f64_bounds(), (Interval::TAU.inf, Interval::TAU.sup));
    assert!(exact(0.0).is_zero() && Interval::enclosing(&Enclosure::pi(120)) == Interval::PI);
}

/// Another implementation, which switches the rounding mode and so loses nothing.
#[cfg(all(feature = "inari", target_feature = "fma"))]
mod against_inari {
    use super::*;
    use crate::number::Wave;

    fn inari(x: Interval) -> inari::Interval {
        inari::Interval::try_from((x.inf, x.sup)).unwrap()
    }

    /// Returns whether it holds the least interval of doubles that holds the results, and little more.
    fn is_around(ours: Interval, least: inari::Interval, more: f64) -> bool {
        let unit = least.inf().next_down() - more <= ours.inf && ours.sup <= least.sup().next_up() + more;
        least.subset(inari(ours)) && unit
    }

    proptest! {
        /// One unit in the last place is lost at each end, and in the sine a few.
        #[test]
        fn operations_are_inaris_but_for_a_unit((x, a) in members(), (y, b) in members()) {
            let (p, q) = (inari(x), inari(y));
            prop_assert!(is_around(x + y, p + q, 0.0) && is_around(x - y, p - q, 0.0));
            // Of 0 and the whole line nothing is claimed.
            prop_assert!(is_around(x * y, p * q, 0.0) || x * y == Interval::ENTIRE, "{x:?} {y:?}: {:?} {:?}", x * y, p * q);
            prop_assert!(x.checked_div(y).is_none_or(|found| is_around(found, p / q, 0.0)));
            prop_assert!(is_around(x.sqr(), p.sqr(), 0.0) && x.sqrt().is_none_or(|root| is_around(root, p.sqrt(), 0.0)));
            let cut = inari(Interval::new(b[3], f64::INFINITY));
            let cuts = [(x.intersection(y), p.intersection(q)), (x.at_least(b[3]), p.intersection(cut))];
            prop_assert!(cuts.iter().all(|(ours, least)| ours.map_or(inari::Interval::EMPTY, inari) == *least));
            prop_assert!(inari(x.hull(y)) == p.convex_hull(q) && x.contains(0.0) == p.contains(0.0));
            prop_assert!(inari(x.abs()) == p.abs() && x.mag() == p.mag() && x.wid() >= p.wid() && a.iter().all(|&a| p.contains(a)));
        }

        #[test]
        fn waves_are_inaris_but_for_a_few_units((x, _) in phases()) {
            let (sin, cos) = inari(x).wave();
            let error = 4.0 * f64::EPSILON + 1e-6 * f64::from(x.mag() > 1e6);
            prop_assert!(is_around(x.sin(), sin, error) || x.mag() > 1e6, "{x:?} {:?} {sin:?}", x.sin());
            prop_assert!(is_around(x.cos(), cos, error) || x.mag() > 1e6, "{x:?} {:?} {cos:?}", x.cos());
        }
    }
}
