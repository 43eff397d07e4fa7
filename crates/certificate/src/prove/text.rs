//! The words of the file, in Coq's notation.

use std::fmt::Write as _;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed};

use super::legs::{Box, Leg};
use crate::{Certificate, Claim};
use impact_pair_exact::{Exact, Operation, decimal_bounds};
use impact_pair_model::Harmonic;
use impact_pair_model::Place;
use impact_pair_model::{Error, EventKind};

/// Beyond N impacts, or so fine a grid, Coq's faster integers are used.
const PLAIN_IMPACTS: usize = 20;
const PLAIN_SCALE: u32 = 100;
/// Bits of a decimal in the place of a time that is none.
const UNTIL_BITS: u32 = 128;
/// Larger powers are not written out.
const LARGEST_POWER: u32 = 64;

/// The file that proves these impacts.
///
/// The last of them comes after `until`, if there is one: it is not listed.
pub(super) fn file(
    certificate: &Certificate,
    claims: &[Claim],
    begin: &Box,
    legs: &[Leg],
    until: Option<&Exact>,
) -> Result<String, Error> {
    let (pair, start) = (certificate.pair(), certificate.start());
    let [gap, restitution, time, velocity] =
        [pair.gap(), pair.restitution(), start.time(), start.velocity()].map(range);
    let tones = pair.excitation().harmonics().iter().map(tone).collect::<Result<Vec<_>, _>>()?;
    let first = match start.place() {
        Place::Wall(wall) => format!("Struck {} {} {}", wall.name(), time?, velocity?),
        Place::Inside(height) => format!("Inside {} {} {}", time?, range(height)?, velocity?),
    };
    let checker = if legs.len() <= PLAIN_IMPACTS && begin.scale <= PLAIN_SCALE { "Plain" } else { "Fast" };
    let printed: Vec<_> = claims.iter().filter_map(bounds).collect();
    let bits = legs.first().map_or(begin.scale, |leg| leg.bits);
    let origin = format!("Start {bits} {} {}", begin.scale, contents(begin));
    let legs: Vec<_> = legs.iter().map(written).collect();
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "\
(* The first impacts of an orbit, as a theorem: for every scene and every launch that `param` and `first` describe there is
   exactly one sequence of impacts, each the first contact after the one before, on these walls and within these bounds.
   Written by impact-pair; check it with coqc -R DIR ImpactPair, DIR the compiled library of validation/coq. *)
From Coq Require Import Reals QArith ZArith List.
From ImpactPair Require Import Model Certificate.
Import ListNotations.

(* A, W, tau of the reference harmonic and of all others, d, e, each one value or an interval of values. *)
Definition param : data := {{|
  leading := {};
  further := [{}];
  gap := {}; restitution := {} |}}%Q.
(* The start: on a wall with its time and the velocity before the impact, or inside the gap with time, y and y'. *)
Definition first : beginning := ({first})%Q.

(* What the certificate prints: wall, bounds of the time, bounds of the velocity before the impact. *)
Definition printed : list bounds := [
  {}
]%Q.

Definition origin : start := {origin}%Z.
Definition legs : list leg := [
  {}
]%Z.

Lemma checked : {checker}.check param first origin legs printed = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem orbit_certified : forall s l, describes param s -> begins first s l -> certified s l printed.
Proof. intros s l. exact ({checker}.orbit_checked _ _ _ _ _ checked s l). Qed.
Print Assumptions orbit_certified.
",
        tones[0],
        tones[1..].join(";\n    "),
        gap?,
        restitution?,
        printed.join(";\n  "),
        legs.join(";\n  "),
    );
    let listed = claims.len() - usize::from(until.is_some());
    if listed == certificate.events().len() {
        let _ = write!(text, "\n{}", outcome(listed, until));
    }
    Ok(text)
}

/// The theorem of the outcome: the number of impacts listed, and the time up to which there is no other.
fn outcome(listed: usize, until: Option<&Exact>) -> String {
    let Some(until) = until else {
        return format!(
            "\
(* The outcome: the number of impacts listed. *)
Theorem all_listed : length printed = {listed}%nat.
Proof. reflexivity. Qed.
"
        );
    };
    // A decimal is itself; another number is below the decimal.
    let decimal = until.as_rational().cloned().unwrap_or_else(|| {
        let [_, upper] = decimal_bounds(&until.enclose(UNTIL_BITS));
        Exact::parse(&upper).ok().and_then(|upper| upper.as_rational().cloned()).expect("a decimal")
    });
    format!(
        "\
(* The outcome: the number of impacts listed, and up to this time, {until}, there is no other; the last of `printed` is the next one. *)
Definition until : Q := {}%Q.
Theorem all_listed : length printed = S {listed} /\\ (until < time_lower (last printed (Impact left 0 0 0 0)))%Q.
Proof. split; reflexivity. Qed.
",
        fraction(&decimal),
    )
}

fn tone(harmonic: &Harmonic) -> Result<String, Error> {
    let [amplitude, frequency, shift] = [harmonic.amplitude(), harmonic.frequency(), harmonic.phase()].map(range);
    Ok(format!("{{| amplitude := {}; frequency := {}; shift := {} |}}", amplitude?, frequency?, shift?))
}

/// The printed bounds of an impact, as a term of Coq.
fn bounds(claim: &Claim) -> Option<String> {
    let EventKind::Impact { velocity, .. } = &claim.kind else { return None };
    let [t0, t1, v0, v1] = [&claim.time[0], &claim.time[1], &velocity[0], &velocity[1]].map(fraction);
    Some(format!("Impact {} {t0} {t1} {v0} {v1}", claim.wall.name()))
}

fn written(leg: &Leg) -> String {
    let Leg { bits, coarse, wall, arrival, depart, approach, tilt } = leg;
    let (scale, wall) = (arrival.scale, wall.name());
    // Coq reads long integers several times faster in hexadecimal.
    format!("Leg {bits} {coarse} {scale} {wall} {} ({depart:#x}) ({approach:#x}) ({tilt:#x})", contents(arrival))
}

fn contents(Box { t, rt, v, rv, .. }: &Box) -> String {
    format!("({t:#x}) {rt} ({v:#x}) {rv}")
}

/// A value or an interval of values.
fn range(x: &Exact) -> Result<String, Error> {
    let ends = x.ends().ok_or_else(|| Error::certificate(format!("{x} holds an interval inside an expression")))?;
    let (low, high) = (number(&ends.0)?, number(&ends.1)?);
    Ok(if x.is_point() { format!("(Exactly ({low}))") } else { format!("(Between ({low}) ({high}))") })
}

/// An expression.
fn number(x: &Exact) -> Result<String, Error> {
    let refused = |what: &str| Error::certificate(format!("{x} has {what}, which Coq's expressions do not hold here"));
    x.fold(&mut |operation: Operation<'_, Result<String, Error>>| {
        Ok(match operation {
            Operation::Rational(x) => rational(x),
            Operation::PiPower(x, n) => {
                let power = power("Pi", n.unsigned_abs()).ok_or_else(|| refused("a large power of pi"))?;
                match (x.is_one(), n > 0) {
                    (true, true) => power,
                    (_, true) => format!("Times ({}) ({power})", rational(x)),
                    (_, false) => format!("Over ({}) ({power})", rational(x)),
                }
            }
            Operation::Interval(..) => return Err(refused("an interval inside")),
            Operation::Negative(a) => format!("Minus (Rational 0) ({})", a?),
            Operation::Sum(a, b) => format!("Plus ({}) ({})", a?, b?),
            Operation::Difference(a, b) => format!("Minus ({}) ({})", a?, b?),
            Operation::Product(a, b) => format!("Times ({}) ({})", a?, b?),
            Operation::Quotient(a, b) => format!("Over ({}) ({})", a?, b?),
            Operation::Power(a, n) => power(&format!("({})", a?), n).ok_or_else(|| refused("a large power"))?,
            Operation::SquareRoot(a) => format!("Root ({})", a?),
            Operation::Sine(a) => format!("Sine ({})", a?),
            Operation::Cosine(a) => format!("Cosine ({})", a?),
        })
    })
}

/// `x^n` written out; `None` for a large one.
fn power(x: &str, n: u32) -> Option<String> {
    let mut product = (1..=LARGEST_POWER).contains(&n).then(|| x.to_owned())?;
    for _ in 1..n {
        product = format!("Times {x} ({product})");
    }
    Some(product)
}

/// A fraction as an expression.
fn rational(x: &BigRational) -> String {
    format!("Rational {}", fraction(x))
}

/// A fraction as Coq's Q reads it.
fn fraction(x: &BigRational) -> String {
    let plain = if x.denom().is_one() {
        x.numer().to_string()
    } else {
        decimal(x).unwrap_or(format!("{} # {}", x.numer(), x.denom()))
    };
    if x.is_negative() || plain.contains('#') { format!("({plain})") } else { plain }
}

/// A fraction as a decimal, if it is one of moderate length.
fn decimal(x: &BigRational) -> Option<String> {
    const LONGEST: u32 = 2000;
    let mut digits = x.denom().bits() as u32 / 3;
    let mut scaled = x * BigRational::from_integer(BigInt::from(10).pow(digits.min(LONGEST)));
    while !scaled.is_integer() {
        digits += 1;
        scaled *= BigInt::from(10);
        if digits > LONGEST {
            return None;
        }
    }
    let sign = if x.is_negative() { "-" } else { "" };
    let digits = digits as usize;
    let all = format!("{:0>1$}", scaled.to_integer().abs().to_string(), digits + 1);
    let (whole, part) = all.split_at(all.len() - digits);
    Some(format!("{sign}{whole}.{}", part.trim_end_matches('0')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_coq_reads_them() {
        let written = |text: &str| number(&Exact::parse(text).unwrap()).unwrap();
        assert_eq!(written("9.42497"), "Rational 9.42497");
        assert_eq!(written("-0.5"), "Rational (-0.5)");
        assert_eq!(written("1/3"), "Rational (1 # 3)");
        assert_eq!(written("pi"), "Pi");
        assert_eq!(written("2*pi^2"), "Times (Rational 2) (Times Pi (Pi))");
        assert_eq!(written("sqrt(2)+sin(1)"), "Plus (Root (Rational 2)) (Sine (Rational 1))");
        assert_eq!(
            range(&Exact::parse("[9.42, 3*pi]").unwrap()).unwrap(),
            "(Between (Rational 9.42) (Times (Rational 3) (Pi)))"
        );
    }
}
