//! The sweep JSON Lines: what is certified at a point.

use impact_pair::json::{
    ArithmeticDocument, Between, ClaimName, ExtendedBounds, OutcomeDocument, PROGRAM, SWEEP_SCHEMA, SceneDocument,
    SweepExponent, SweepHead, SweepImpact, SweepPeriod, SweepRecord,
};

use impact_pair::Scene;
use impact_pair::exact::{Enclosure, Exact, decimal_bounds, decimal_bounds_f64};
use impact_pair::json::vocabulary::PointOutcome;
use impact_pair::lyapunov::Exponent;
use impact_pair::number::Ball;
use impact_pair::orbit::{Arithmetic, Outcome, Period};
use impact_pair::scene::Key;

use super::{Point, PointSettings};
use crate::grid::{Grid, written};

/// Head of a sweep: its scene, grid and settings; a shard is given by its number and the number of shards.
pub(super) fn head(scene: &Scene, grid: &Grid, requested: &PointSettings, shard: Option<[u64; 2]>) -> SweepHead {
    SweepHead {
        schema: SWEEP_SCHEMA.to_owned(),
        program: PROGRAM.to_owned(),
        title: scene.title().map(str::to_owned),
        scene: SceneDocument::new(scene.pair(), scene.start()),
        over: grid.axes().iter().map(written).collect(),
        points: grid.points(),
        transient: requested.transient,
        impacts: requested.impacts,
        digits: requested.settings.digits,
        certified: requested.settings.arithmetic.is_certified(),
        claim: (requested.settings.arithmetic == Arithmetic::Shadow).then_some(ClaimName::Shadowed),
        arithmetic: ArithmeticDocument::requested(&requested.settings),
        reference: requested.reference.map(|term| term as u64 + 1), // exact: a number of terms
        summary: requested.summary,
        shard,
    }
}

/// Record of the certified results at the point of this number and these values.
pub(super) fn record(number: u64, values: &[(Key, Exact)], point: &Point) -> SweepRecord {
    // Chaos is never claimed: of a motion that is not proved to be attracted only the limit is undecided.
    let outcome = PointOutcome::of(point.outcome.kind());
    let lasting = point.lasting.clone().unwrap_or_default();
    let duration = lasting.time.as_ref().map(extended);
    let period = match (&point.outcome, &point.attraction) {
        (Outcome::Periodic(Period { impacts, .. }), _) => Some(SweepPeriod {
            word: None,
            impacts: *impacts,
            cycles: lasting.cycles,
            duration,
            from: None,
            first: None,
        }),
        (_, Some(attraction)) => Some(SweepPeriod {
            word: Some(attraction.word.to_string()),
            impacts: attraction.word.mappings().len() as u64,
            cycles: lasting.cycles,
            duration,
            from: Some(attraction.from),
            first: attraction.first.as_ref().map(impact),
        }),
        _ => None,
    };
    let is_lost = matches!(point.exponent, Exponent::Unknown(unknown) if !unknown.is_definite());
    let reason = point.conclusion.reason();
    SweepRecord {
        point: number,
        values: values.iter().map(|(_, value)| value.text()).collect(),
        outcome,
        reason,
        message: message(point),
        claim: point.shadow.as_ref().map(|_| ClaimName::Shadowed),
        complete: reason.is_none() && point.first_wide.is_none() && !is_lost,
        bits: point.bits,
        impacts: point.impacts,
        wide_from: point.first_wide,
        impacts_per_cycle: point.impacts_per_cycle.map(of_ball),
        exponent: exponent(point.exponent),
        exponent_limit: point.attraction.as_ref().and_then(|attraction| attraction.limit).map(limit),
        period,
        states: point.states.iter().map(impact).collect(),
    }
}

/// The outcome in words, its cycles those of the reference.
fn message(point: &Point) -> String {
    let own = point.conclusion.document();
    let Some(lasting) = &point.lasting else { return own.message };
    let Some(cycles) = lasting.cycles else {
        let cycles = own.cycles.map(u64::from).or(own.period.map(|period| period.cycles)).unwrap_or_default();
        let every = if cycles == 1 { "every cycle".to_owned() } else { format!("every {cycles} cycles") };
        return own.message.replacen(&every, "in each period", 1);
    };
    let outcome = OutcomeDocument {
        cycles: own.cycles.and_then(|_| u32::try_from(cycles).ok()),
        period: own.period.map(|period| Period { cycles, ..period }),
        ..own.clone()
    };
    outcome.words().unwrap_or(own.message)
}

fn impact(state: &SweepImpact<Enclosure>) -> SweepImpact {
    state.map(extended)
}

fn extended(x: &Enclosure) -> ExtendedBounds {
    Between::computed(decimal_bounds(x))
}

fn of_ball(ball: Ball) -> ExtendedBounds {
    match ball.enclosure() {
        Some(enclosure) => extended(&enclosure),
        None => Between::computed(decimal_bounds_f64(ball.mid() - ball.rad(), ball.mid() + ball.rad())),
    }
}

/// Bounds of an exponent in the limit; an upper bound alone has some ten digits.
pub(crate) fn limit([low, high]: [f64; 2]) -> ExtendedBounds {
    if low.is_finite() || !high.is_finite() {
        return Between::computed(decimal_bounds_f64(low, high));
    }
    // Bounds are rounded outward by less than what is between them.
    let [_, high] = decimal_bounds_f64(high - 1e-9 * high.abs(), high);
    Between::computed(["-inf".to_owned(), high])
}

/// Bounds of an exponent per impact and per forcing period, or the reason why there are none.
pub(crate) fn exponent(exponent: Exponent) -> SweepExponent {
    let rest = || Some(Between::computed(["-inf".to_owned(), "-inf".to_owned()]));
    match exponent {
        Exponent::Finite { per_impact, per_cycle } => {
            SweepExponent { per_impact: Some(of_ball(per_impact)), per_cycle: Some(of_ball(per_cycle)), reason: None }
        }
        Exponent::Forgets => SweepExponent { per_impact: rest(), per_cycle: rest(), reason: None },
        Exponent::Unknown(unknown) => SweepExponent { per_impact: None, per_cycle: None, reason: Some(unknown) },
    }
}
