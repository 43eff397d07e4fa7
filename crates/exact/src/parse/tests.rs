use super::*;
use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;

fn fraction(text: &str) -> String {
    Exact::parse(text).unwrap_or_else(|error| panic!("{text}: {error}")).as_rational().unwrap().to_string()
}

fn message(text: &str) -> String {
    Exact::parse(text).unwrap_err().to_string()
}

#[test]
fn numbers_mean_what_they_say() {
    let cases = [
        ("9.42497", "942497/100000"),
        (".5", "1/2"),
        ("5.", "5"),
        (" +1.50 ", "3/2"),
        ("1_000.5", "2001/2"),
        ("2.5E-1", "1/4"),
        ("1e+2", "100"),
        ("-0.0", "0"),
        ("0e99999999999999999999", "0"),
        ("0.00", "0"),
        ("-2^2", "-4"),
        ("(-2)^2", "4"),
        ("2^-2", "1/4"),
        ("2^(-(2))", "1/4"),
        ("2^3^2", "512"),
        ("2^-2^2", "1/16"),
        ("1/3/2", "1/6"),
        ("1-2-3", "-4"),
        ("2-(-3)*-1", "-1"),
        ("2*(3+4)/7", "2"),
        ("sqrt(9/4)", "3/2"),
        ("sin(pi/6)+cos(2*pi/3)", "0"),
        ("cos(0)^0", "1"),
        ("(10*pi*0 + pi/2)/(2*pi)", "1/4"),
    ];
    for (text, value) in cases {
        assert_eq!(fraction(text), value, "{text}");
    }
}

#[test]
fn errors_name_the_fault_its_place_and_the_accepted_values() {
    let cases = [
        ("", "column 1: found the end, accepted are a number"),
        ("nan", "column 1: found `nan`, accepted are finite"),
        ("-inf", "column 2: found `inf`, accepted are finite"),
        ("2pi", "column 2: found `pi`, accepted are `+`"),
        ("0x10", "column 2: found `x10`"),
        ("1__0", "column 2: found `__0`"),
        ("1e", "column 3: found the end, accepted are the digits"),
        ("3 \u{2212} 1", "column 3: found `\u{2212}`"),
        ("(1", "column 3: found the end, accepted are `+`, `-`, `*`, `/`, `^` or `)`"),
        ("sin 1", "column 5: found `1`, accepted are `(`"),
        ("2^0.5", "column 3: found `0.5`, accepted are an integer"),
        ("2^10001", "column 3: the exponent 10001"),
        ("2^10^5", "column 6: found `5`"),
        ("1 + 1/(1-1)", "column 6: the divisor `0` is zero"),
        ("sqrt(-1)", "column 1: the square root of `-1` needs"),
        ("1e10001", "column 1: found a number of magnitude `1e10001`"),
        ("1.70 +- 0.01", "column 7: found a sign after a sign"),
        ("--1.7", "column 2: found a sign after a sign"),
        ("2*-\t+3", "column 5: found a sign after a sign"),
        ("10^--3", "column 5: found a sign after a sign"),
        ("sin(1 - -2)", "column 9: found a sign after a sign"),
        ("1 + [1, 2]", "column 5: found an interval inside"),
        ("[2, 1]", "column 1: the interval needs a lower bound"),
        ("[1, 2", "column 6: found the end, accepted are `+`, `-`, `*`, `/`, `^` or `]`"),
        ("[1]", "column 3: found `]`"),
        (".", "column 1: found `.`"),
    ];
    for (text, start) in cases {
        assert!(message(text).starts_with(start), "{text}: {}", message(text));
    }
    assert!(Exact::parse("1/0").unwrap_err().undefined().is_some());
}

#[test]
fn deep_long_and_large_texts_are_refused_or_read_but_never_break() {
    let nested = |n: usize, f: &str| format!("{}1{}", f.repeat(n), ")".repeat(n));
    for f in ["(", "sin(", "-(", "1+(1+", "2^("] {
        assert!(Exact::parse(&nested(256, f)).is_ok() || f == "1+(1+" || f == "2^(", "{f}");
        assert!(Exact::parse(&nested(5000, f)).is_err());
    }
    assert!(Exact::parse(&format!("1{}", "^1".repeat(5000))).is_err());
    assert!(Exact::parse(&"-".repeat(20_000)).is_err());
    assert!(Exact::parse(&"9".repeat(9_000)).is_ok());
    assert!(Exact::parse(&format!("0.{}1", "0".repeat(12_000))).is_err());
    assert!(Exact::parse(&vec!["sin(1)"; 2000].join("+")).is_err());
}

proptest! {
    #[test]
    fn any_string_is_read_or_refused(text in "\\PC*") {
        let _ = Exact::parse(&text);
    }

    #[test]
    fn any_string_of_our_alphabet_is_read_or_refused(text in "([-+*/^()., 0-9]|pi|sin\\(|cos\\(|sqrt\\(|\\[|\\]|e|_|é){0,24}") {
        if let Err(error) = Exact::parse(&text) {
            prop_assert!(error.column() <= text.len() + 1);
            prop_assert!(text.is_char_boundary(error.column() - 1));
        }
    }

    #[test]
    fn decimals_are_exact(m: i64, places in 0usize..40) {
        let text = format!("{m}e-{places}");
        let expected = BigRational::new(m.into(), BigInt::from(10u8).pow(places as u32));
        let x = Exact::parse(&text).unwrap();
        prop_assert_eq!(x.as_rational(), Some(&expected));
    }

    #[test]
    fn every_double_reads_back(bits: u64) {
        if let Some(x) = Exact::from_f64(f64::from_bits(bits)) {
            let again = Exact::parse(&x.text()).unwrap();
            prop_assert_eq!(again.as_rational(), x.as_rational());
        }
    }
}

#[test]
fn advice_suggests_the_likely_expression() {
    for (text, meant) in [
        ("2pi", "2*pi"),
        ("3 + 2sqrt(2)", "3 + 2*sqrt(2)"),
        ("2(1+pi)", "2*(1+pi)"),
        ("9,42497", "9.42497"),
        ("20π", "20*pi"),
        ("−2", "-2"),
        ("2**3", "2^3"),
    ] {
        assert_eq!(Exact::parse(text).unwrap_err().meant(), Some(meant), "{text}");
    }
    for text in ["8 mm", "3.2Hz", "90°", "9.81 m/s^2"] {
        assert!(Exact::parse(text).unwrap_err().to_string().contains("no units"), "{text}");
    }
    for text in ["9,424", "", "pie", "1e", "[1, 2", "2pie", "two"] {
        let error = Exact::parse(text).unwrap_err();
        assert!(error.meant().is_none(), "{error}");
    }
}
