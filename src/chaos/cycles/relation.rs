//! What two neighbouring impacts have to do with one another, over boxes of phases: smooth at grazes as well.

use super::super::flights::{Law, Side};
use crate::periodic::Interval;

/// The pair over intervals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relation {
    gap: Interval,
    pub restitution: Interval,
}

/// The flights between two boxes of phases, told about a state of each.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// The speed after the first impact, and before the last one.
    pub after: Interval,
    pub before: Interval,
    /// Both between the two centres.
    pub centre: [Interval; 2],
    /// Their derivatives by both phases, over the box.
    pub slopes: [[Interval; 2]; 2],
}

const PI: Interval = Interval::new(std::f64::consts::PI, std::f64::consts::PI.next_up());

/// Half a turn where the walls change.
pub(super) fn shift(side: Side) -> f64 {
    if side == Side::Far { 0.5 } else { 0.0 }
}

/// Speeds after and before, and both over the time.
struct Speeds {
    after: Interval,
    before: Interval,
    rates: [Interval; 2],
}

impl Relation {
    pub fn new(law: &Law) -> Self {
        let restitution = Interval::of(law.restitution);
        let restitution = Interval::new(restitution.lo.max(0.0), restitution.hi.min(1.0)); // exact: from 0 to 1
        Self { gap: Interval::of(law.gap), restitution }
    }

    /// The flights between two phases, each in a box, as they come from the formulas; `None` where there may be none.
    fn speeds(&self, side: Side, from: Interval, to: Interval, cosines: [Interval; 2]) -> Option<Speeds> {
        let time = to - from;
        let time = Interval::new(time.lo.max(0.0), time.hi);
        if time.lo > time.hi {
            return None;
        }
        let middle = (from + to).times(0.5);
        let mean = time.sinc() * middle.cos();
        match side {
            Side::Far => {
                let drift = self.gap.over((PI * time).times(2.0))? + mean;
                let after = drift - cosines[0];
                let before = drift - cosines[1];
                Some(Speeds { after, before, rates: [after.over(time)?, before.over(time)?] })
            }
            Side::Near => {
                let (after, before) = (mean - cosines[0], cosines[1] - mean);
                let bend = time.bend() * middle.cos();
                let swing = |at: Interval| PI * time.times(0.5).sinc() * at.sin();
                let quarter = time.times(0.25);
                let mut rates = [-(bend + swing(middle - quarter)), bend - swing(middle + quarter)];
                for (rate, speed) in rates.iter_mut().zip([after, before]) {
                    if let Some(direct) = speed.over(time) {
                        *rate = rate.cut(direct).unwrap_or(*rate);
                    }
                }
                Some(Speeds { after, before, rates })
            }
        }
    }

    /// The flights from a box of phases to a box of reduced phases, about these members.
    pub fn leg(&self, side: Side, [from, to]: [Interval; 2], centres: [Interval; 2]) -> Option<Leg> {
        let shift = Interval::point(shift(side));
        let offsets = [from - centres[0], to - centres[1]];
        let (to, centres) = (to - shift, [centres[0], centres[1] - shift]);
        let sign = if side == Side::Far { 1.0 } else { -1.0 };
        let at = self.speeds(side, centres[0], centres[1], centres.map(Interval::cos))?;
        let Speeds { mut after, mut before, mut rates } = self.speeds(side, from, to, [from.cos(), to.cos()])?;
        let [sine, other] = [from, to].map(|x| (PI * x.sin()).times(2.0));
        let time = to - from;
        let mut slopes = [[Interval::point(0.0); 2]; 2];
        for _ in 0..2 {
            slopes = [
                [rates[0] + sine, -rates[1].signed(sign)],
                [rates[0].signed(sign), other.signed(sign) - rates[1]],
            ];
            let told = |centre: Interval, row: [Interval; 2]| centre + row[0] * offsets[0] + row[1] * offsets[1];
            let (a, b) = (told(at.after, slopes[0]), told(at.before, slopes[1]));
            after = after.cut(a).unwrap_or(after);
            before = before.cut(b).unwrap_or(before);
            for (rate, speed) in rates.iter_mut().zip([after, before]) {
                if let Some(direct) = speed.over(time) {
                    *rate = rate.cut(direct).unwrap_or(*rate);
                }
            }
        }
        Some(Leg { after, before, centre: [at.after, at.before], slopes })
    }
}
