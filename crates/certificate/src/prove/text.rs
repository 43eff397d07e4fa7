//! The text of the file, in Coq's notation.

use super::legs::{Box, Leg};
use super::number::{fraction, range};
use crate::{Certificate, Claim};
use impact_pair_exact::{Exact, decimal_bounds};
use impact_pair_model::Harmonic;
use impact_pair_model::Place;
use impact_pair_model::vocabulary::OutcomeKind;
use impact_pair_model::{Error, EventKind};

/// Number of impacts, and scale of the grid, beyond which Coq's faster integers are used.
const PLAIN_IMPACTS: usize = 20;
const PLAIN_SCALE: u32 = 100;
/// Bits of the decimal that stands for a time that is not a fraction.
const PLACEHOLDER_BITS: u32 = 128;

/// The first lines of each file.
const PREAMBLE: &str = "\
(* The first impacts of an orbit, as a theorem: for every scene and every launch that `param` and `first` describe there is
   exactly one sequence of impacts, each the first contact after the one before, on these walls and within these bounds.
   Written by impact-pair; check it with coqc -R DIR ImpactPair, DIR the compiled library of validation/coq. *)
From Coq Require Import Reals QArith ZArith List.
From ImpactPair Require Import Model Certificate.
Import ListNotations.
";

/// The file that proves the given impacts.
///
/// With `until`, the last impact comes after that time and is not listed. The outcome is left out where the list contradicts it.
pub(super) fn file(
    certificate: &Certificate,
    claims: &[Claim],
    begin: &Box,
    legs: &[Leg],
    (is_stated, until): (bool, Option<&Exact>),
) -> Result<String, Error> {
    let mut text = format!("{PREAMBLE}\n{}\n{}", scene(certificate)?, theorem(claims, begin, legs));
    let listed = claims.len() - usize::from(until.is_some());
    if is_stated && listed == certificate.events().len() {
        text.push('\n');
        let later = certificate.ended().may_be_later.unwrap_or(0); // exact: absent where there are none
        text.push_str(&outcome(certificate.outcome(), (listed, later), until));
    }
    Ok(text)
}

/// The definitions of the scene: data and start.
fn scene(certificate: &Certificate) -> Result<String, Error> {
    let (pair, start) = (certificate.pair(), certificate.start());
    let [gap, restitution, time, velocity] =
        [pair.gap(), pair.restitution(), start.time(), start.velocity()].map(range);
    let tones = pair.excitation().harmonics().iter().map(tone).collect::<Result<Vec<_>, _>>()?;
    let first = match start.place() {
        Place::Wall(wall) => format!("Struck {} {} {}", wall.name(), time?, velocity?),
        Place::Inside(height) => format!("Inside {} {} {}", time?, range(height)?, velocity?),
    };
    Ok(format!(
        "\
(* A, W, tau of the reference harmonic and of all others, d, e, each one value or an interval of values. Values stand in their simplest exact form
   (sin(pi/6) as 0.5), and a term whose amplitude is 0, which moves nothing, is left out. *)
Definition param : data := {{|
  leading := {};
  further := [{}];
  gap := {}; restitution := {} |}}%Q.
(* The start: on a wall with its time and the velocity before the impact, or inside the gap with time, y and y'. *)
Definition first : beginning := ({first})%Q.
",
        tones[0],
        tones[1..].join(";\n    "),
        gap?,
        restitution?,
    ))
}

/// The definitions of the bounds and of the legs, and the theorem about them.
fn theorem(claims: &[Claim], begin: &Box, legs: &[Leg]) -> String {
    let checker = if legs.len() <= PLAIN_IMPACTS && begin.scale <= PLAIN_SCALE { "Plain" } else { "Fast" };
    let printed: Vec<_> = claims.iter().filter_map(bounds).collect();
    let bits = legs.first().map_or(begin.scale, |leg| leg.bits);
    let origin = format!("Start {bits} {} {}", begin.scale, contents(begin));
    let legs: Vec<_> = legs.iter().map(written).collect();
    format!(
        "\
(* The printed impacts: wall, bounds of the time, bounds of the velocity before the impact. *)
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
        printed.join(";\n  "),
        legs.join(";\n  "),
    )
}

/// The theorem of the outcome: the number of listed impacts, and the time before which there is no other impact. For an outcome that
/// claims more, a comment says that this is not stated. Impacts that may come later than that time are counted apart.
fn outcome(kind: OutcomeKind, (listed, later): (usize, u64), until: Option<&Exact>) -> String {
    let besides = match kind {
        OutcomeKind::ImpactsReached | OutcomeKind::TimeReached => String::new(),
        _ => format!(" What `{kind}` says besides is not stated here."),
    };
    let Some(until) = until else {
        return format!(
            "\
(* The outcome: the number of impacts listed.{besides} *)
Theorem all_listed : length printed = {listed}%nat.
Proof. reflexivity. Qed.
"
        );
    };
    // A decimal stands for itself; for another number there is a decimal above it.
    let decimal = until.as_rational().cloned().unwrap_or_else(|| {
        let [_, upper] = decimal_bounds(&until.enclose(PLACEHOLDER_BITS));
        Exact::parse(&upper).ok().and_then(|upper| upper.as_rational().cloned()).expect("a decimal")
    });
    let time = fraction(&decimal);
    let next = format!("length printed = S {listed} /\\ (until < time_lower (last printed (Impact left 0 0 0 0)))%Q");
    let (counted, statement, proof) = match later {
        0 => (String::new(), next, "split; reflexivity."),
        later => {
            let certain = (listed as u64).saturating_sub(later); // exact: a length, and a part of it
            let in_time = "length (filter (fun x => Qle_bool (time_upper x) until) printed)";
            (
                format!(", of which {later} may come later than `until`"),
                format!("{next} /\\\n  Nat.leb {certain} ({in_time}) = true"),
                "split; [reflexivity | split; reflexivity].",
            )
        }
    };
    format!(
        "\
(* The outcome: the number of impacts listed{counted}, and up to this time, {until}, there is no other; the last of `printed` is the next one.{besides} *)
Definition until : Q := {time}%Q.
Theorem all_listed : {statement}.
Proof. {proof} Qed.
"
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
