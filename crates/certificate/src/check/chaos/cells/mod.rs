//! Check of the verdicts on the values of a parameter: each is proved again for all values of its subinterval, as a whole or
//! part by part (Lemma V35).

mod moving;
mod orbit;
mod said;

use std::cmp::Ordering;

use impact_pair_exact::Exact;
use impact_pair_model::vocabulary::StretchVerdict;
use impact_pair_model::watch::{Latched, Stage, Watch};
use impact_pair_model::{Error, ImpactPair, Start};

use super::allowance::{Allowance, End};
use super::horseshoe::Horseshoe;
use super::span::Span;
use super::{Law, STEPS_PER_PLACE};
use crate::cells::CellsCertificate;
use crate::check::contact::Doubt;
use crate::check::{Finding, Limits, Verdict};
use impact_pair_document::{PeriodDocument, StretchDocument};
use orbit::{Found, Period};

/// Bits of the arithmetic.
const DOUBLE_BITS: u32 = f64::MANTISSA_DIGITS;
/// The periodic orbit of a subinterval may take one in N parts of what a document of another kind may.
const WORK_DIVISOR: u64 = 1 << 2;
/// Most halvings of a subinterval, and most cuts of a cell of two parameters into quarters.
const MAX_HALVINGS: u32 = 16;
const MAX_QUARTERINGS: u32 = 4;

/// The finding for some values of the parameter, or why there is none; an error where they are beyond exact expressions.
type Answer = Result<Result<Found, End>, Error>;

impl CellsCertificate {
    /// Proves the verdict on each subinterval again, or says of which it is not true or not proved, until the watch stops it, which
    /// receives the subintervals checked so far.
    ///
    /// # Errors
    /// Returns an error if the scene's values are beyond the range of exact expressions, or if it has several harmonics.
    pub fn check_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<Verdict, Error> {
        Ok(self.judge_within(limits, watch)?.0)
    }

    /// Returns the verdict, and how many subintervals are confirmed one after another from the first one on.
    pub(crate) fn judge_within(&self, limits: &Limits, watch: &dyn Watch) -> Result<(Verdict, usize), Error> {
        let watch = Latched::new(watch);
        if let Err((event, doubt)) = self.says_one_thing() {
            return Ok((doubt.on(event), 0));
        }
        let (mut open, mut confirmed, mut certain) = (None, 0, 0);
        for (event, stretch) in self.document.stretches.iter().enumerate() {
            if stretch.verdict != StretchVerdict::Undecided {
                let allowed = limits.work.saturating_mul(STEPS_PER_PLACE); // proposes: when to give up
                match self.judged(stretch, (allowed, &watch))? {
                    Err(Doubt::Open(_)) if watch.is_stopped() => {
                        return Ok((Verdict::Interrupted { events: confirmed }, certain));
                    }
                    Err(Doubt::False(message)) => return Ok((Verdict::Refuted(Finding { event, message }), certain)),
                    Err(Doubt::Open(message)) => open = open.or(Some(Finding { event, message })),
                    Ok(()) => confirmed += 1,
                }
            }
            certain += usize::from(open.is_none()); // exact: a count
            watch.note(Stage::Claims(event + 1));
        }
        let verdict = match open {
            Some(Finding { event, message }) => {
                let message = format!("{message}; {confirmed} of {} subintervals confirmed", self.claimed());
                Verdict::Undecided(Finding { event, message })
            }
            None if confirmed == 0 => {
                let message = "nothing is claimed of any value of the parameter".to_owned();
                Verdict::Undecided(Finding { event: self.count(), message })
            }
            None => Verdict::Confirmed { bits: DOUBLE_BITS, pieces: 1 },
        };
        Ok((verdict, certain))
    }

    /// The verdict on a subinterval holds for all its values.
    fn judged(
        &self,
        stretch: &StretchDocument,
        (allowed, watch): (u64, &dyn Watch),
    ) -> Result<Result<(), Doubt>, Error> {
        let work = &Allowance::new(allowed / WORK_DIVISOR, watch); // proposes: when to give up
        if let Some(period) = &stretch.period {
            let period = match Period::of(period) {
                Ok(period) => period,
                Err(doubt) => return Ok(Err(doubt)),
            };
            let is_own = stretch.verdict == StretchVerdict::Attracted;
            let proved = self.for_all(stretch, &mut |pair, law| {
                let requested = (pair, &self.start);
                if is_own { period.attracts(requested, law, work) } else { period.exists(requested, law, work) }
            })?;
            if let Err(doubt) = said_of_period(proved, is_own) {
                return Ok(Err(doubt));
            }
        }
        self.holds_horseshoe(stretch, (allowed, watch))
    }

    /// All values of a subinterval have the horseshoe that is claimed, if one is: each part of it has, by its witness.
    fn holds_horseshoe(&self, stretch: &StretchDocument, work: (u64, &dyn Watch)) -> Result<Result<(), Doubt>, Error> {
        let Some(entropy) = &stretch.entropy else { return Ok(Ok(())) };
        let horseshoe = match Horseshoe::claimed(&stretch.bases, entropy, self.document.depth) {
            Ok(horseshoe) => horseshoe,
            Err(doubt) => return Ok(Err(doubt)),
        };
        let mut from = &stretch.low.0;
        for part in &stretch.witness {
            let to = &part.high.0;
            if from.compare(to) != Some(Ordering::Less) {
                return Ok(Err(Doubt::open("the parts of its witness are not in order")));
            }
            let law = Law::of(&self.pair([from, to])?)?;
            if let Err(doubt) = horseshoe.is_proved(&law, (&part.words, &part.strips), work) {
                return Ok(Err(doubt));
            }
            from = to;
        }
        let is_whole = from.compare(&stretch.high.0) == Some(Ordering::Equal);
        let why = if stretch.witness.is_empty() {
            "its horseshoe has no witness"
        } else {
            "its witness is not one of all its values"
        };
        Ok(if is_whole { Ok(()) } else { Err(Doubt::open(why)) })
    }

    /// The finding for all values of a subinterval: for all of them at once, or else for one half after the other.
    fn for_all(&self, stretch: &StretchDocument, look: &mut dyn FnMut(&ImpactPair, &Law) -> Answer) -> Answer {
        let mut open = vec![([stretch.low.0.clone(), stretch.high.0.clone()], 0)];
        while let Some(([low, high], halvings)) = open.pop() {
            let pair = self.pair([&low, &high])?;
            match look(&pair, &Law::of(&pair)?)? {
                Ok(Found::Proved) => {}
                Ok(Found::Nothing) if halvings < MAX_HALVINGS => {
                    let Ok(middle) = low.checked_add(&high).and_then(|sum| sum.checked_div(&Exact::from(2))) else {
                        return Ok(Ok(Found::Nothing));
                    };
                    open.push(([middle.clone(), high], halvings + 1));
                    open.push(([low, middle], halvings + 1));
                }
                found => return Ok(found),
            }
        }
        Ok(Ok(Found::Proved))
    }
}

/// Proves that each pair of intervals has a stable periodic orbit of a claimed word, or its mirror image. Lemmas V36, V38
pub(in crate::check) fn has_stable_orbit(
    (pair, start): (&ImpactPair, &Start),
    claimed: &PeriodDocument,
    limits: &Limits,
    watch: &dyn Watch,
) -> Result<Result<(), Doubt>, Error> {
    let period = match Period::of(claimed) {
        Ok(period) => period,
        Err(doubt) => return Ok(Err(doubt)),
    };
    let work = Allowance::new(limits.work.saturating_mul(STEPS_PER_PLACE) / WORK_DIVISOR, watch); // proposes: when to give up
    let mut open = vec![(Law::of(pair)?, 0)];
    while let Some((law, quartered)) = open.pop() {
        match period.exists((pair, start), &law, &work)? {
            Ok(Found::Proved) => {}
            Ok(Found::Nothing) if quartered < MAX_QUARTERINGS => {
                open.extend(quarters(&law).map(|part| (part, quartered + 1)));
            }
            found => return Ok(said_of_period(found, false)),
        }
    }
    Ok(Ok(()))
}

/// Each of several stable periodic orbits is listed once. Lemma V38
pub(in crate::check) fn are_distinct(claimed: &[PeriodDocument]) -> Result<(), Doubt> {
    let periods: Vec<Period> = claimed.iter().map(Period::of).collect::<Result<_, _>>()?;
    let is_known = |j: usize| periods[..j].iter().any(|other| periods[j].may_be(other));
    match (0..periods.len()).find(|j| is_known(*j)) {
        Some(j) => Err(Doubt::Open(format!("stable[{j}] is not proved to be another orbit than those before"))),
        None => Ok(()),
    }
}

/// The laws of both halves of the interval of `D` with both halves of that of `e`: all members are in one of them.
fn quarters(law: &Law) -> [Law; 4] {
    let halves = |x: Span| [Span::new(x.lo(), x.mid()), Span::new(x.mid(), x.hi())];
    let [gaps, restitutions] = [law.gap, law.restitution].map(halves);
    [0, 1, 2, 3].map(|k| Law { gap: gaps[k / 2], restitution: restitutions[k % 2] })
}

/// The verdict on a claimed periodic orbit, of the scene's own orbit (`is_own`) or of any.
fn said_of_period(found: Result<Found, End>, is_own: bool) -> Result<(), Doubt> {
    match found {
        Ok(Found::Proved) => Ok(()),
        Ok(Found::Other) if is_own => Err(Doubt::False("the scene's orbit converges to another periodic orbit".into())),
        Ok(Found::Fewer) => Err(Doubt::open("period: the orbit repeats after fewer impacts")),
        Err(End::Spent) => Err(Doubt::open("the work allowed is spent on its periodic orbit")),
        Ok(Found::Other | Found::Nothing) | Err(End::Stopped) => {
            Err(Doubt::open("its periodic orbit is not proved again"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_pair_model::watch::Unwatched;
    use impact_pair_model::{Harmonic, Wall};

    fn pair([amplitude, restitution]: [&str; 2]) -> ImpactPair {
        let exact = |text: &str| text.parse::<Exact>().unwrap();
        let harmonic = Harmonic::new(exact(amplitude), Exact::pi(), Exact::from(0)).unwrap();
        ImpactPair::new(harmonic, exact("1"), exact(restitution)).unwrap()
    }

    fn start(velocity: i64) -> Start {
        Start::on_wall(Exact::from(0), Wall::Left, Exact::from(velocity)).unwrap()
    }

    fn claimed(word: &str, cycles: u32) -> PeriodDocument {
        PeriodDocument { word: word.to_owned(), cycles, impacts: word.split(' ').count() as u32 }
    }

    /// Returns whether a stable orbit of a word in `cycles` forcing periods is proved for all amplitudes and restitutions of intervals.
    fn is_proved(values: [&str; 2], word: &str, cycles: u32) -> bool {
        let requested = (&pair(values), &start(-1));
        has_stable_orbit(requested, &claimed(word, cycles), &Limits::default(), &Unwatched).unwrap().is_ok()
    }

    /// The equispaced motion of (66)-(69), whose eigenvalues are complex at the first pair: a set lies in one of many impacts before only.
    #[test]
    fn v36_sets_are_compared_with_those_of_many_impacts_before() {
        for pair in [["0.3", "0.5"], ["[0.3, 0.3001]", "[0.5, 0.5001]"], ["0.36", "0.8"]] {
            assert!(is_proved(pair, "P1 P2", 1), "{pair:?}");
            assert!(!is_proved(pair, "P1 P2", 3) && !is_proved(pair, "P4 P2 P1", 1), "{pair:?}");
        }
    }

    /// The word of an orbit repeated is not that of another orbit.
    #[test]
    fn v36_several_rounds_of_an_orbit_are_not_another_one() {
        for pair in [["0.3", "0.5"], ["0.36", "0.8"], ["1/(3*pi)", "0.5"]] {
            for rounds in 2..=6 {
                assert!(!is_proved(pair, &vec!["P1 P2"; rounds].join(" "), rounds as u32), "{pair:?} {rounds}");
            }
        }
    }

    /// Beyond the doubling at 0.46276, and before the one at 0.48999, the orbit takes two cycles: rounds of many impacts do not prove half of it.
    #[test]
    fn v36_a_doubled_orbit_is_not_the_one_that_has_doubled() {
        let doubled = ["0.475", "0.8"];
        assert!(is_proved(doubled, "P1 P2 P1 P2", 2));
        assert!(!is_proved(doubled, "P1 P2", 1));
        assert!(!is_proved(["0.492", "0.8"], "P1 P2 P1 P2", 2));
    }

    /// The same of the scene's own orbit, which is followed from its start on and not from where a floating-point orbit has settled: it converges to the
    /// doubled orbit, another one of the pair has three impacts.
    #[test]
    fn v36_an_orbit_that_converges_to_a_doubled_one_does_not_converge_to_half_of_it() {
        let (pair, start) = (pair(["0.475", "0.8"]), start(-5));
        let found = |word: &str, cycles: u32| {
            let work = Allowance::new(STEPS_PER_PLACE * Limits::default().work, &Unwatched);
            let period = Period::of(&claimed(word, cycles)).unwrap();
            period.attracts((&pair, &start), &Law::of(&pair).unwrap(), &work).unwrap().unwrap()
        };
        assert_eq!(found("P1 P2 P1 P2", 2), Found::Proved);
        assert_eq!(found("P1 P2", 1), Found::Nothing);
        assert_eq!(found("P1 P2 P4", 1), Found::Other);
        assert_eq!(found("P1 P2 P4 P4", 2), Found::Other);
        assert_eq!(found("P1 P2 P1 P2", 3), Found::Other);
    }

    /// Each gap is in a quarter with each restitution.
    #[test]
    fn v38_quarters_hold_all_members() {
        let law = Law { gap: Span::new(1.0, 1.7), restitution: Span::new(0.3, 0.5) };
        let members = |x: Span| [x.lo(), 0.5 * (x.lo() + x.mid()), x.mid(), 0.5 * (x.mid() + x.hi()), x.hi()];
        let holds = |x: Span, member: f64| x.lo() <= member && member <= x.hi();
        for gap in members(law.gap) {
            for restitution in members(law.restitution) {
                let is_in = |part: &Law| holds(part.gap, gap) && holds(part.restitution, restitution);
                assert!(quarters(&law).iter().any(is_in), "{gap} {restitution}");
            }
        }
    }
}
