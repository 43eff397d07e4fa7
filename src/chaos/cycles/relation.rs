//! Relation between an impact and the next one, over boxes of their phases: Lemma D20.

use crate::chaos::law::{Law, Side};
use crate::number::interval::Interval;

/// The pair over intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relation {
    gap: Interval,
    /// `e`
    pub restitution: Interval,
}

/// All flights between two boxes of phases, in mean-value form about a member of each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// `a`, the speeds after the first impact.
    pub after: Interval,
    /// `b`, the speeds before the second one.
    pub before: Interval,
    /// Speeds after the first and before the second impact, between the two members.
    pub centre: [Interval; 2],
    /// Derivatives of the two speeds by the two phases.
    pub slopes: [[Interval; 2]; 2],
}

/// `a`, `b`, `a/h` and `b/h`.
struct Speeds {
    after: Interval,
    before: Interval,
    rates: [Interval; 2],
}

impl Relation {
    pub fn new(law: &Law) -> Self {
        let restitution = Interval::from(law.restitution);
        let restitution = Interval::new(restitution.inf().max(0.0), restitution.sup().min(1.0)); // exact: from 0 to 1
        Self { gap: Interval::from(law.gap), restitution }
    }

    /// The flights from a phase to another one that is not earlier; `None` where one may take no time to the far wall.
    fn speeds(&self, side: Side, from: Interval, to: Interval) -> Option<Speeds> {
        let time = (to - from).at_least(0.0)?;
        let middle = (from + to).scaled(0.5);
        let mean = time.sinc() * middle.cos();
        match side {
            Side::Far => {
                let drift = self.gap.checked_div((Interval::PI * time).scaled(2.0))? + mean;
                let (after, before) = (drift - from.cos(), drift - to.cos());
                Some(Speeds { after, before, rates: [after.checked_div(time)?, before.checked_div(time)?] })
            }
            Side::Near => {
                let (after, before) = (mean - from.cos(), to.cos() - mean);
                let (bend, quarter) = (time.bend() * middle.cos(), time.scaled(0.25));
                let swing = |at: Interval| Interval::PI * time.scaled(0.5).sinc() * at.sin();
                let rates = [-(bend + swing(middle - quarter)), bend - swing(middle + quarter)];
                Some(Speeds { after, before, rates })
            }
        }
    }

    /// Encloses the flights to a wall from a box of phases to a box of reduced phases, in mean-value form about `centres`.
    pub fn leg(&self, side: Side, [from, to]: [Interval; 2], centres: [Interval; 2]) -> Option<Leg> {
        let shift = Interval::point(side.shift());
        let offsets = [from - centres[0], to - centres[1]];
        let to = to - shift;
        (centres[1] - shift - centres[0]).inf().is_sign_positive().then_some(())?;
        let at = self.speeds(side, centres[0], centres[1] - shift)?;
        let Speeds { mut after, mut before, mut rates } = self.speeds(side, from, to)?;
        let [first, second] = [from, to].map(|x| (Interval::PI * x.sin()).scaled(2.0));
        let (time, sign) = (to - from, side.sign());
        let mut slopes;
        let mut rounds = 2;
        loop {
            for (rate, speed) in rates.iter_mut().zip([after, before]) {
                *rate = both(*rate, speed.checked_div(time));
            }
            let [by_after, by_before] = rates;
            slopes =
                [[by_after + first, -by_before.signed(sign)], [by_after.signed(sign), second.signed(sign) - by_before]];
            if rounds == 0 {
                return Some(Leg { after, before, centre: [at.after, at.before], slopes });
            }
            rounds -= 1;
            let mean_value = |centre: Interval, row: [Interval; 2]| centre + row[0] * offsets[0] + row[1] * offsets[1];
            after = both(after, Some(mean_value(at.after, slopes[0])));
            before = both(before, Some(mean_value(at.before, slopes[1])));
        }
    }
}

/// Intersection of two enclosures of the same numbers, or the first one where they do not meet.
fn both(x: Interval, y: Option<Interval>) -> Interval {
    y.and_then(|y| x.intersection(y)).unwrap_or(x) // D20: each holds them
}
