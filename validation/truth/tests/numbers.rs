//! Numbers that the scenes of the reference simulator are read from.

use std::panic::catch_unwind;

use impact_pair_truth::{Number, pi_times};
use rug::Rational;

#[test]
fn text_is_read_exactly_and_pi_is_rounded_once() {
    for (text, numerator, denominator) in
        [("9.42497", 942497, 100000), ("-1/3", -1, 3), ("1.5e-3", 3, 2000), (".5E2", 50, 1)]
    {
        assert_eq!(Number::from(text), Rational::from((numerator, denominator)).into());
    }
    assert_eq!(Number::from("-3*pi/2"), Number::pi_times(Rational::from((-3, 2))));
    assert_eq!(pi_times(300, "1/3"), Number::from("pi/3").to_float(300));
    assert_eq!(pi_times(53, 1), std::f64::consts::PI);
}

#[test]
fn text_that_is_no_number_is_refused() {
    for text in ["", "-", "pi*pi", "1/pi", "1/0", "0x1", "1..2", "--1", "nan", "1e"] {
        assert!(catch_unwind(|| Number::from(text)).is_err(), "{text}");
    }
}
