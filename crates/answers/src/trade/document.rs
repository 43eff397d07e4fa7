//! The trade JSON.

use std::time::Duration;

use impact_pair::json::{
    CrossingDocument, ExtentDocument, LargestError, LargestErrors, Microseconds, PROGRAM, RowDocument, RowOptions,
    SceneDocument, Seconds, TRADE_SCHEMA, TradeDocument, TradeRequest, TradeUnits, TruthDocument, WidthsDocument,
    WordLeft,
};

use super::{Crossing, Divergence, ErrorBounds, Extent, Largest, Measured, Trade, TradeArithmetic};

impl Trade<'_> {
    /// The trade JSON.
    pub fn document(&self) -> TradeDocument {
        let Self { scene, requested, units, interrupted, .. } = self;
        TradeDocument {
            schema: TRADE_SCHEMA.to_owned(),
            program: PROGRAM.to_owned(),
            scene: SceneDocument::new(scene.pair(), scene.start()),
            requested: TradeRequest {
                impacts: requested.impacts,
                until: requested.until.as_ref().map(|until| until.text()),
                max_bits: requested.max_bits,
            },
            units: TradeUnits { time: "2 pi/W".to_owned(), velocity: units.speed.to_string() },
            interrupted: interrupted.map(|arithmetic| arithmetic.to_string()),
            arithmetics: self.rows.iter().map(|measured| row(measured, self)).collect(),
        }
    }
}

/// The row of an arithmetic.
fn row(measured: &Measured, trade: &Trade<'_>) -> RowDocument {
    let Measured { arithmetic, times, .. } = measured;
    let time = |whole: Duration| measured.microseconds(whole);
    let widths =
        measured.widths.map(|widths| WidthsDocument { time: extent(&widths.time), velocity: extent(&widths.velocity) });
    let judgement = trade.judgement.as_ref().filter(|_| *arithmetic == TradeArithmetic::Float);
    RowDocument {
        name: arithmetic.to_string(),
        requested: options_of(*arithmetic),
        arithmetic: measured.computed.clone(),
        certified: measured.is_certified,
        complete: measured.is_complete(),
        impacts: measured.impacts,
        outcome: measured.conclusion.document(),
        seconds: Seconds {
            orbit: times.orbit.as_secs_f64(),
            with_bounds: times.with_bounds.map(|time| time.as_secs_f64()),
            repetitions: times.repetitions,
        },
        microseconds_per_impact: Microseconds {
            orbit: time(times.orbit),
            with_bounds: times.with_bounds.and_then(time),
        },
        impacts_per_second: time(times.orbit).map(|time| 1e6 / time),
        digits: measured.digits().map(|digits| (digits * 100.0).floor() / 100.0),
        widths,
        truth: judgement.map(|judgement| truth(judgement, trade)),
    }
}

/// The arithmetic as the command line names it.
fn options_of(arithmetic: TradeArithmetic) -> RowOptions {
    let (arithmetic, digits) = match arithmetic {
        TradeArithmetic::Float => ("float".to_owned(), None),
        TradeArithmetic::Interval => ("interval".to_owned(), None),
        TradeArithmetic::Inari => ("inari".to_owned(), None),
        TradeArithmetic::Shadow => ("shadow".to_owned(), None),
        TradeArithmetic::Bits(bits) => (bits.to_string(), None),
        TradeArithmetic::Auto(digits) => ("auto".to_owned(), Some(digits)),
    };
    RowOptions { arithmetic, digits }
}

fn extent(extent: &Extent) -> ExtentDocument {
    ExtentDocument { greatest: extent.greatest.decimal_up(), last: extent.last.decimal_up() }
}

fn truth(judgement: &ErrorBounds, trade: &Trade<'_>) -> TruthDocument {
    let largest = |largest: &Largest| {
        (largest.impact > 0).then(|| LargestError {
            bounds: [largest.at_least.decimal_down(), largest.at_most.decimal_up()],
            impact: largest.impact,
        })
    };
    let crossing = |&Crossing { exponent, within, exceeded }: &Crossing| CrossingDocument {
        threshold: format!("1e{exponent}"),
        within,
        exceeded,
    };
    TruthDocument {
        judge: trade.judge(),
        judged: judgement.judged,
        largest_error: LargestErrors { time: largest(&judgement.time), velocity: largest(&judgement.velocity) },
        time_errors: judgement.crossings.iter().map(crossing).collect(),
        leaves_word: judgement.departure.map(|Divergence { impact, truth, judged }| WordLeft {
            impact,
            truth,
            float: judged,
        }),
    }
}
