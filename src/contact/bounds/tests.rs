//! Lemmas C1, C2 and C4: each bound holds the distance of the truth from the doubles.

use super::*;
use crate::contact::extrema::Extrema;
use crate::contact::tests::{Case, TrueFlight, cases};
use crate::number::tests::{Truth, powers};
use crate::number::{Kernel, kernel};
use crate::pair::Inward;
use proptest::prelude::*;

/// Asserts that the computed value is within its bound of the truth; the slack is what the bound's own roundings lose.
fn assert_within(what: &str, truth: Truth, computed: f64, bound: f64) -> Result<(), TestCaseError> {
    let off = (truth - computed).abs();
    prop_assert!(!off.exceeds(SLACK * bound), "{what}: off by {:?}, bound {bound:e}", off.0.to_f64_bounds());
    Ok(())
}

/// The times of the extrema of the member next to computed ones, and all around it.
fn around(truth: &TrueFlight, time: f64, margin: f64) -> Vec<Truth> {
    let near = Truth::from(time);
    let ends = [-1.0, 1.0, 0.3].map(|part| &near + Truth::from(margin) * part);
    let extremum = truth.extremum(&near);
    let is_near = !(&extremum - &near).abs().exceeds(margin);
    ends.into_iter().chain(is_near.then_some(extremum)).collect()
}

fn assert_bounds<const WIDE: bool>(case: &Case, time: f64, hop: f64, target: f64) -> Result<(), TestCaseError> {
    let (flight, margins) = (case.flight(), case.margins());
    let truth = case.truth();
    let bounds = Bounds::<WIDE>::new(&flight, &margins, case.radii);
    // At any phase, counted from the forcing period next to it.
    let turns = (case.phase + time).round();
    let at = (case.phase + time) - turns;
    let (sin, cos) = flight.wall.mirror(kernel::sin_cos(at));
    let elapsed = UNIT.mul_add(turns.abs(), (turns + (at - flight.phase)).abs());
    let since = Truth::from(at) + turns - &truth.phase;
    if elapsed > 0.124 {
        let residual = flight.height_above(target, turns, at, sin);
        let bound = bounds.height(elapsed, turns, sin, residual);
        assert_within("height", truth.height_at(&since) - target, residual, bound)?;
    }
    let velocity = flight.velocity_at(cos);
    assert_within("velocity", truth.velocity_at(&since), velocity, bounds.velocity(velocity))?;
    let bend = flight.acceleration_at(sin);
    assert_within("acceleration", truth.acceleration_at(&since), bend, margins.bend)?;
    assert_within("drift", truth.drift(), flight.drift, bounds.slope())?;
    assert_within("beta", truth.beta(), flight.beta, bounds.beta_radius())?;
    prop_assert!(!truth.velocity.abs().exceeds(SLACK * bounds.speed()) && !truth.beta().exceeds(margins.beta));
    prop_assert!(!Truth::from(margins.least_beta).exceeds(truth.beta()));
    prop_assert!(!truth.acceleration_at(&since).abs().exceeds(margins.acceleration));
    // A short flight from the wall, at a fixed time.
    if bounds.is_on_wall() {
        let departure = kernel::departure(hop);
        let kernel::SmallAngle { versine, excess, sine } = departure;
        let since = Truth::from(hop);
        let residual = flight.hop_height(hop, versine, excess) - target;
        let bound = bounds.hop_height(hop, versine + excess, residual);
        assert_within("hop", truth.height_at(&since) - target, residual, bound)?;
        let velocity = flight.hop_velocity(versine, sine);
        assert_within(
            "hop's velocity",
            truth.velocity_at(&since),
            velocity,
            bounds.hop_velocity(versine + sine, velocity),
        )?;
        let (sin, _) = flight.hop_sin_cos(&departure);
        let turned = Truth::from(TAU) * bounds.phase_radius();
        assert_within("hop's sine", truth.sin_cos(&since).0, sin, (turned + HOP_SINE_ERROR).0.to_f64_bounds().1)?;
    }
    assert_extrema(case, &bounds, &truth)
}

/// Lemmas E1, E2 and C4: the times and heights of the flight's extrema.
fn assert_extrema<const WIDE: bool>(
    case: &Case,
    bounds: &Bounds<'_, WIDE>,
    truth: &TrueFlight,
) -> Result<(), TestCaseError> {
    let flight = &case.flight();
    let margin = bounds.critical_phase();
    prop_assert!(!bounds.is_narrow() || margin <= NARROW);
    let is_certain = flight.velocity.abs() > case.radii.velocity || (flight.velocity == 0.0 && flight.sin.abs() > 1e-3);
    let inner = flight.drift.abs() < flight.beta * (1.0 - 1e-3) && is_certain && margin < 1e-2;
    // Members that start on another piece turn elsewhere.
    let place = (flight.phase + flight.wall.mirror_phase()).rem_euclid(0.5).min(0.5 - (flight.phase).rem_euclid(0.5));
    if !inner || place <= 2.0 * case.radii.phase + 1e-9 {
        return Ok(());
    }
    let mut extrema = Extrema::new::<Kernel>(flight);
    for refined in [false, true] {
        for (first, height) in [(extrema.first_max, extrema.max), (extrema.first_min, extrema.min)] {
            let acos = if refined {
                20.0 * ACOS_ERROR * ACOS_ERROR * bounds.pair.alpha
            } else {
                ACOS_ERROR * flight.drift.abs()
            };
            let bound = bounds.extremum(first.abs() + margin) + acos + bounds.pair.alpha * SIN_COS_ERROR;
            let sign = if first == extrema.first_max { 1.0 } else { -1.0 };
            for time in around(truth, first, margin + case.radii.phase) {
                let beyond = (truth.height_at(&time) - height) * sign;
                prop_assert!(
                    !beyond.exceeds(SLACK * bound),
                    "refined {refined}: {:?}, {bound:e}",
                    beyond.0.to_f64_bounds()
                );
            }
            // The velocity's sign changes within the margin.
            let [before, after] = [-1.0, 1.0].map(|side| {
                let ends = Truth::from(margin * 1.0001 + 2.0 * case.radii.phase) * side;
                truth.velocity_at(&(Truth::from(first) + ends)) * sign
            });
            prop_assert!(
                !(-before).exceeds(0.0) && !after.exceeds(0.0),
                "{first} is not the {sign} extremum within {margin:e}"
            );
        }
        extrema.refine::<Kernel>(flight);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn bounds_hold_the_distance_of_every_member_from_the_doubles(
        case in cases(), time in powers(-3.0, 6.0), hop in powers(-40.0, -0.91), target in prop_oneof![Just(0.0), Just(1.0)],
    ) {
        assert_bounds::<true>(&case, time, hop, target)?;
        let case = Case { radii: Radii { phase: 0.0, ..case.radii }, ..case };
        assert_bounds::<false>(&case, time, hop, target)?;
    }
}
